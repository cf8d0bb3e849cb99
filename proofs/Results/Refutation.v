(** The checker's refutations: differences that do not tend to 0. *)
From Coq Require Import Reals Arith Lia Lra Classical.
From Coquelicot Require Import Coquelicot.
From Fomas Require Import Model.Vectors Model.Graph Model.Loop Model.Coordinates Statements.
From Fomas Require Import Facts.Sums Facts.Vectors Facts.Lambda2 Facts.Forms Facts.Loop Facts.Phi Facts.Trace.
From Fomas Require Import Results.ClosedLoop Results.Consensus Results.Equivalence Results.Stability Results.Spectrum.
Open Scope R_scope.

Lemma no_decay_disagreement n A t mu : (1 <= n)%nat -> 0 < t <= mu ->
  ~ powers_decay n (mv n (differences_step n A t)) -> disagreement n A mu.
Proof.
  intros Hn Ht NDt alpha gamma h D E.
  assert (ND : ~ powers_decay n (mv n (differences_step n A mu)))
    by (intros C; apply NDt, (smaller_step_decay n A mu t); assumption).
  assert (exists y i, (i < n)%nat /\
            ~ is_lim_seq (fun k => iter k (mv n (differences_step n A mu)) y i) 0)
    as [y [i [Hi NL]]].
  { apply NNPP. intros C. apply ND, vanishing_decay. intros y i Hi. apply NNPP. intros F.
    apply C. exists y, i. auto. }
  (* the start with these differences *)
  set (x0 := fun j => if Nat.eqb j n then 0 else y j).
  destruct (proj1 (closed_loop_exists (S n) A alpha gamma h x0 D)) as [x [u H]].
  assert (NX : ~ is_lim_seq (fun k => x (INR k * h) i - x (INR k * h) n) 0).
  { intros L. apply NL.
    apply is_lim_seq_ext with (fun k => x (INR k * h) i - x (INR k * h) n); [|exact L].
    intros k. rewrite !(loop_sample (S n) A alpha gamma h x0 D x u H k) by lia. rewrite E.
    change (differences n (iter k (mv (S n) (perron (S n) A mu)) x0) i
            = iter k (mv n (differences_step n A mu)) y i).
    rewrite differences_iter by exact Hi. apply iter_mv_ext; [|exact Hi].
    intros j Hj. unfold differences, x0. rewrite Nat.eqb_refl.
    destruct (Nat.eqb_spec j n); [lia|ring]. }
  split; [exists x0, x, u, i; auto|]. intros H1. apply NNPP. intros C. apply NX.
  assert (V : vanishes_on_1perp (S n) A (mu_of alpha gamma h)).
  { apply (proj1 (claims_equivalent (S n) A alpha gamma h ltac:(lia) H1 D)).
    intros y0 y1 v Hv j Hj. apply NNPP. intros F. apply C. exists y0, y1, v, j. auto. }
  assert (bal : balanced (S n) A) by apply H1.
  destruct (decay_from_vanishing (S n) A _ ltac:(lia) bal V) as [K [rho [HK [Hr Hd]]]].
  assert (L := fun j Hj => sample_consensus (S n) A alpha gamma h K rho ltac:(lia) D Hr Hd
                             x0 x u H j Hj).
  replace (Finite 0) with (Finite (mean (S n) x0 - mean (S n) x0)) by (f_equal; ring).
  apply is_lim_seq_minus'; apply L; lia.
Qed.

Lemma no_decay_spectrum n A t mu : 0 < t <= mu ->
  ~ powers_decay n (mv n (differences_step n A t)) -> ~ perron_spectrum (S n) A mu.
Proof.
  intros Ht ND H. apply ND, (smaller_step_decay n A mu t Ht), spectrum_decay, H.
Qed.

(** * Y >= 0, Y not 0 and M^T Y M - Y >= 0 *)

Lemma persistent_form n Y M : symmetric n Y -> positive_semidefinite n Y ->
  (exists i j, (i < n)%nat /\ (j < n)%nat /\ Y i j <> 0) ->
  positive_semidefinite n (fun i j => - stein_form n Y M i j) -> ~ powers_decay n (mv n M).
Proof.
  intros sym HY [i [j [Hi [Hj Ne]]]] HS D.
  assert (exists y, form n Y y <> 0) as [y Hy].
  { apply NNPP. intros C. apply Ne, (zero_form n Y sym); [|exact Hi|exact Hj].
    intros y. apply NNPP. intros F. apply C. exists y. exact F. }
  assert (grow : forall k, form n Y y <= form n Y (iter k (mv n M) y)).
  { induction k as [|k IH]; [simpl; lra|]. simpl iter. eapply Rle_trans; [exact IH|].
    specialize (HS (iter k (mv n M) y)).
    rewrite (form_mat_ext n _ (fun i j => (-1) * stein_form n Y M i j + 0 * Y i j)) in HS
      by (intros; ring).
    rewrite form_linear, form_stein_form in HS. lra. }
  destruct (form_bounded n Y) as [B [B0 HB]].
  assert (V : is_lim_seq (fun k => B * dot n (iter k (mv n M) y) (iter k (mv n M) y)) 0).
  { replace (Finite 0) with (Rbar_mult B 0) by (simpl; f_equal; ring).
    apply is_lim_seq_scal_l.
    apply (sum_vanishes n (fun i k => iter k (mv n M) y i * iter k (mv n M) y i)).
    intros l Hl. replace (Finite 0) with (Finite (0 * 0)) by (f_equal; ring).
    apply is_lim_seq_mult'; apply (decay_lim n); assumption. }
  assert (P := HY y).
  assert (T : Rbar_le (form n Y y) 0).
  { apply (is_lim_seq_le (fun _ => form n Y y) _ (form n Y y) 0) with (2 := is_lim_seq_const _)
      (3 := V).
    intros k. eapply Rle_trans; [apply grow|]. eapply Rle_trans; [apply Rle_abs|apply HB]. }
  simpl in T. lra.
Qed.

Theorem persistence_test : persistence_test_statement.
Proof.
  intros n A Y t mu sym HY Hne HS Ht.
  assert (ND : ~ powers_decay n (mv n (differences_step n A t)))
    by (apply (persistent_form n Y); assumption).
  split; [exact (no_decay_spectrum n A t mu Ht ND)|].
  apply (no_decay_disagreement n A t mu); [|exact Ht|exact ND].
  destruct Hne as [i [j [Hi _]]]. lia.
Qed.

(** * A trace beyond the dimension *)

Lemma decay_trace n M k : powers_decay n (mv n M) ->
  Rabs (\sum_(i < n) iter k (mv n M) (id_mat i) i) <= INR n.
Proof.
  intros [C [rho [HC [Hr Hd]]]]. destruct k as [|k].
  - simpl. rewrite (sum_ext n _ (fun _ => 1)).
    + rewrite sum_const, Rmult_1_r, Rabs_right by apply Rle_ge, pos_INR. apply Rle_refl.
    + intros i _. unfold id_mat. rewrite Nat.eqb_refl. reflexivity.
  - assert (G : is_lim_seq (fun j => C * rho ^ j) 0).
    { replace (Finite 0) with (Rbar_mult C 0) by (simpl; f_equal; ring).
      apply is_lim_seq_scal_l, is_lim_seq_geom. rewrite Rabs_right; lra. }
    apply is_lim_seq_spec in G. destruct (G (mkposreal 1 Rlt_0_1)) as [m Hm]. simpl in Hm.
    apply (trace_bounded n M (S k) (S m)); [lia|]. intros x.
    rewrite <- !norm_sq. assert (Nx := norm_nonneg n x).
    assert (B : norm n (iter (S m * S k) (mv n M) x) <= norm n x).
    { eapply Rle_trans; [apply Hd|]. rewrite <- (Rmult_1_l (norm n x)) at 2.
      apply Rmult_le_compat_r; [exact Nx|]. specialize (Hm (S m * S k)%nat ltac:(nia)).
      rewrite Rminus_0_r in Hm. apply Rabs_def2 in Hm. lra. }
    apply Rmult_le_compat; try apply norm_nonneg; exact B.
Qed.

Theorem trace_test : trace_test_statement.
Proof.
  intros n A t mu m H Ht.
  assert (ND : ~ powers_decay n (mv n (differences_step n A t)))
    by (intros D; assert (B := decay_trace n _ m D); lra).
  split; [exact (no_decay_spectrum n A t mu Ht ND)|].
  apply (no_decay_disagreement n A t mu); [|exact Ht|exact ND].
  destruct n as [|n]; [|lia]. simpl in H. rewrite Rabs_R0 in H. lra.
Qed.
