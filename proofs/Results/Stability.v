(** The checker's stability tests: matrices of quadratic forms in the differences from one agent. *)
From Coq Require Import Reals Arith Lia Lra.
From Coquelicot Require Import Coquelicot.
From Fomas Require Import Model.Vectors Model.Graph Model.Loop Model.Coordinates Statements.
From Fomas Require Import Facts.Sums Facts.Vectors Facts.Graph Facts.Lambda2 Facts.Forms.
From Fomas Require Import Facts.Contraction Facts.Loop Facts.Phi.
From Fomas Require Import Results.ClosedLoop Results.Consensus Results.Soundness.
From Fomas Require Import Results.Equivalence Results.Coordinates.
Open Scope R_scope.

(** Geometric decay of the powers of a map on R^n. *)
Definition powers_decay (n : nat) (T : vec -> vec) : Prop := exists C rho,
  0 <= C /\ 0 <= rho < 1 /\ forall k y, norm n (iter k T y) <= C * rho ^ k * norm n y.

(** * Q > 0 and Q - M^T Q M > 0 *)

Lemma stein_decay n Q M : positive_definite n Q -> positive_definite n (stein_form n Q M) ->
  powers_decay n (mv n M).
Proof.
  intros HQ HS. destruct (definite_bounded n Q HQ) as [lo [Hlo low]].
  destruct (definite_bounded n _ HS) as [eps [He fall]].
  destruct (form_bounded n Q) as [B [B0 HB]].
  set (hi := B + eps). assert (Hhi : 0 < hi) by (unfold hi; lra).
  assert (high : forall y, form n Q y <= hi * dot n y y).
  { intros y. assert (T := Rle_trans _ _ _ (Rle_abs _) (HB y)). assert (P := dot_nonneg n y).
    unfold hi. nra. }
  set (r := 1 - eps / hi).
  assert (E1 : eps / hi <= 1).
  { apply Rmult_le_reg_r with hi; [exact Hhi|]. unfold Rdiv.
    rewrite Rmult_assoc, Rinv_l by lra. unfold hi. lra. }
  assert (E0 : 0 < eps / hi) by (apply Rdiv_lt_0_compat; lra).
  assert (R : 0 <= r < 1) by (unfold r; lra).
  exists (sqrt (hi / lo)), (sqrt r). split; [apply sqrt_pos|]. split.
  { split; [apply sqrt_pos|]. rewrite <- sqrt_1. apply sqrt_lt_1_alt. lra. }
  intros k y. apply (lyapunov_powers n (fun _ => True) (mv n M) Q lo hi (sqrt r)); auto.
  - apply sqrt_pos.
  - intros x _. rewrite pow2_sqrt by lra. specialize (fall x). rewrite form_stein_form in fall.
    assert (eps / hi * form n Q x <= eps * dot n x x); [|unfold r; lra].
    apply Rle_trans with (eps / hi * (hi * dot n x x)).
    + apply Rmult_le_compat_l; [lra|apply high].
    + right. field. lra.
Qed.

(** * The same for a smaller gain *)

Lemma iter_mat_ext n M M' : (forall i j, (i < n)%nat -> (j < n)%nat -> M i j = M' i j) ->
  forall k x i, (i < n)%nat -> iter k (mv n M) x i = iter k (mv n M') x i.
Proof.
  intros E k x. induction k as [|k IH]; intros i Hi; simpl; [reflexivity|].
  rewrite (mv_ext n M _ _ i IH). apply sum_ext. intros j Hj. rewrite E; auto.
Qed.

(** If the powers of M decay, so do those of (1 - theta) I + theta M. *)
Lemma lazy_decay n M T theta : 0 < theta <= 1 ->
  (forall y i, (i < n)%nat -> T y i = (1 - theta) * y i + theta * mv n M y i) ->
  (forall k y z i, (i < n)%nat -> iter k T (fun j => y j - z j) i = iter k T y i - iter k T z i) ->
  (forall k a y i, (i < n)%nat -> iter k T (fun j => a * y j) i = a * iter k T y i) ->
  (forall k y z, (forall i, (i < n)%nat -> y i = z i) ->
     forall i, (i < n)%nat -> iter k T y i = iter k T z i) ->
  powers_decay n (mv n M) -> powers_decay n T.
Proof.
  intros Ht HT sub scal ext [C [rho [HC [Hr Hd]]]]. set (r := 1 - theta + theta * rho).
  exists C, r. split; [exact HC|]. split; [unfold r; nra|].
  assert (G : forall k j y, norm n (iter k T (iter j (mv n M) y))
              <= C * rho ^ j * r ^ k * norm n y).
  { induction k as [|k IH]; intros j y.
    - simpl. eapply Rle_trans; [apply Hd|]. right. ring.
    - set (z := iter j (mv n M) y). rewrite iter_S.
      rewrite (norm_ext n _ (fun i => (1 - theta) * iter k T z i + theta * iter k T (mv n M z) i)).
      + eapply Rle_trans; [apply norm_triangle|]. rewrite !norm_scal, !Rabs_right by lra.
        assert (I0 := IH j y). fold z in I0. assert (I1 := IH (S j) y). simpl iter in I1.
        fold z in I1. simpl pow in I1 |- *.
        apply Rmult_le_compat_l with (r := 1 - theta) in I0; [|lra].
        apply Rmult_le_compat_l with (r := theta) in I1; [|lra].
        eapply Rle_trans; [apply Rplus_le_compat; [exact I0|exact I1]|].
        right. unfold r. ring.
      + intros i Hi.
        rewrite (ext k (T z) (fun i => (1 - theta) * z i - (- theta) * mv n M z i))
          by (try exact Hi; intros; rewrite HT by assumption; ring).
        rewrite (sub k (fun i => (1 - theta) * z i) (fun i => - theta * mv n M z i)) by exact Hi.
        rewrite !scal by exact Hi. ring. }
  intros k y. assert (T0 := G k 0%nat y). simpl in T0. rewrite Rmult_1_r in T0. exact T0.
Qed.

Lemma smaller_step_decay n A t mu : 0 < mu <= t ->
  powers_decay n (mv n (differences_step n A t)) ->
  powers_decay n (mv n (differences_step n A mu)).
Proof.
  intros Hmu. set (theta := mu / t).
  assert (Ht : 0 < theta <= 1).
  { unfold theta. split; [apply Rdiv_lt_0_compat; lra|].
    apply Rmult_le_reg_r with t; [lra|]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l by lra. lra. }
  apply (lazy_decay n _ _ theta Ht).
  - intros y i Hi. unfold differences_step, mv.
    rewrite <- (id_mat_sum n i y Hi) at 1. rewrite <- !sum_scal, <- sum_plus.
    apply sum_ext. intros j _. unfold theta. field. lra.
  - intros. apply iter_minus. assumption.
  - intros. apply iter_scal. assumption.
  - intros. apply iter_mv_ext; assumption.
Qed.

(** * What the decay of the differences says about the loop *)

Lemma differences_iter n A t k x i : (i < n)%nat ->
  differences n (iter k (mv (S n) (perron (S n) A t)) x) i
  = iter k (mv n (differences_step n A t)) (differences n x) i.
Proof.
  revert i. induction k as [|k IH]; intros i Hi; simpl; [reflexivity|].
  rewrite (proj2 (differences_evolve n A t _ i Hi)). apply mv_ext, IH.
Qed.

Lemma decay_lim n T y i : (i < n)%nat -> powers_decay n T ->
  is_lim_seq (fun k => iter k T y i) 0.
Proof.
  intros Hi [C [rho [HC [Hr Hd]]]].
  apply dominated_vanishes with (b := fun k => rho ^ k) (c := C * norm n y).
  - intros k. eapply Rle_trans; [apply (entry_le_norm n _ i Hi)|].
    eapply Rle_trans; [apply Hd|]. right. ring.
  - apply is_lim_seq_geom. rewrite Rabs_right; lra.
Qed.

Lemma decay_fixed n M y : powers_decay n (mv n M) ->
  (forall i, (i < n)%nat -> mv n M y i = y i) -> forall i, (i < n)%nat -> y i = 0.
Proof.
  intros D F i Hi.
  assert (I : forall k j, (j < n)%nat -> iter k (mv n M) y j = y j).
  { induction k as [|k IH]; intros j Hj; simpl; [reflexivity|].
    rewrite (mv_ext n M _ y) by exact IH. apply F, Hj. }
  assert (L := decay_lim n (mv n M) y i Hi D).
  apply is_lim_seq_ext with (v := fun _ => y i) in L; [|intros; apply I, Hi].
  apply is_lim_seq_unique in L. rewrite Lim_seq_const in L.
  injection L. auto.
Qed.

Lemma differences_zero n x : (forall i, (i < n)%nat -> differences n x i = 0) ->
  forall i, (i < S n)%nat -> x i = x n.
Proof.
  intros H i Hi. destruct (Nat.eq_dec i n) as [->|Ne]; [reflexivity|].
  specialize (H i ltac:(lia)). unfold differences in H. lra.
Qed.

Lemma decay_spectrum n A mu : powers_decay n (mv n (differences_step n A mu)) ->
  perron_spectrum (S n) A mu.
Proof.
  intros D. unfold perron_spectrum. set (P := mv (S n) (perron (S n) A mu)).
  set (Pc := mv n (differences_step n A mu)) in *.
  assert (CP : forall x i, (i < n)%nat -> differences n (P x) i = Pc (differences n x) i)
    by (intros x i Hi; apply (proj2 (differences_evolve n A mu x i Hi))).
  assert (one : forall c x, (forall i, (i < S n)%nat -> x i = c) ->
            forall i, (i < S n)%nat -> P x i = c).
  { intros c x Hx i Hi. unfold P. rewrite (mv_ext (S n) _ x (fun j => c * ones j))
      by (intros; rewrite Hx by assumption; unfold ones; ring).
    rewrite mv_scal, perron_entry, laplacian_ones by exact Hi. unfold ones. ring. }
  split; [intros i Hi; apply one; [reflexivity|exact Hi]|]. split.
  - intros x Hx.
    set (y := differences n x). set (z := fun i => Pc y i - y i).
    assert (Z : forall i, (i < n)%nat -> z i = 0).
    { apply (decay_fixed n _ z D). intros i Hi. fold Pc.
      assert (E : Pc z i = Pc (differences n (P x)) i - Pc y i).
      { unfold Pc, z. rewrite mv_minus. f_equal. apply mv_ext. intros j Hj. symmetry.
        apply CP, Hj. }
      rewrite E. unfold z, y. rewrite <- !CP by exact Hi. unfold differences.
      assert (X1 := Hx i ltac:(lia)). assert (X2 := Hx n ltac:(lia)). lra. }
    assert (Y : forall i, (i < n)%nat -> y i = 0).
    { apply (decay_fixed n _ y D). intros i Hi. specialize (Z i Hi). unfold z in Z.
      fold Pc. lra. }
    intros i Hi. rewrite (differences_zero n x Y i Hi), (differences_zero n x Y 0%nat) by lia.
    reflexivity.
  - intros a b x y Pxy Ex Ey Hne. destruct D as [C [rho [HC [Hr Hd]]]].
    set (dx := differences n x). set (dy := differences n y).
    assert (Fx : forall i, (i < n)%nat -> Pc dx i = a * dx i - b * dy i).
    { intros i Hi. unfold dx at 1. rewrite <- CP by exact Hi. unfold dx, dy, differences.
      rewrite !Ex by lia. ring. }
    assert (Fy : forall i, (i < n)%nat -> Pc dy i = b * dx i + a * dy i).
    { intros i Hi. unfold dy at 1. rewrite <- CP by exact Hi. unfold dx, dy, differences.
      rewrite !Ey by lia. ring. }
    assert (X0 := dot_nonneg n dx). assert (Y0 := dot_nonneg n dy).
    destruct (Req_dec (dot n dx dx + dot n dy dy) 0) as [Z|Z].
    + (* both parts are constant vectors, which P fixes *)
      exfalso. apply Hne.
      assert (Cx := differences_zero n x (dot_zero n dx ltac:(lra))).
      assert (Cy := differences_zero n y (dot_zero n dy ltac:(lra))).
      assert (E1 := Ex n ltac:(lia)). assert (E2 := Ey n ltac:(lia)).
      fold P in E1, E2. rewrite (one (x n) x Cx n) in E1 by lia.
      rewrite (one (y n) y Cy n) in E2 by lia.
      assert (Q : dot (S n) x x + dot (S n) y y = INR (S n) * (x n ^ 2 + y n ^ 2)).
      { unfold dot. rewrite (sum_ext (S n) (fun i => x i * x i) (fun _ => x n ^ 2))
          by (intros; rewrite Cx by assumption; ring).
        rewrite (sum_ext (S n) (fun i => y i * y i) (fun _ => y n ^ 2))
          by (intros; rewrite Cy by assumption; ring).
        rewrite !sum_const. ring. }
      rewrite Q in Pxy. assert (Np : 0 < INR (S n)) by (apply lt_0_INR; lia).
      assert (W : 0 < x n ^ 2 + y n ^ 2).
      { apply Rmult_lt_reg_l with (INR (S n)); [exact Np|]. lra. }
      assert (K : ((1 - a) ^ 2 + b ^ 2) * (x n ^ 2 + y n ^ 2) = 0).
      { replace (((1 - a) ^ 2 + b ^ 2) * (x n ^ 2 + y n ^ 2))
          with ((x n - (a * x n - b * y n)) ^ 2 + (y n - (b * x n + a * y n)) ^ 2) by ring.
        rewrite <- E1, <- E2. ring. }
      apply Rmult_integral in K. destruct K as [K|K]; [|lra].
      assert (Q1 := pow2_ge_0 (1 - a)). assert (Q2 := pow2_ge_0 b). split; nra.
    + apply Rle_lt_trans with (rho ^ 2); [|nra].
      apply (modulus_from_decay n (differences_step n A mu) C rho a b dx dy); auto; lra.
Qed.

Lemma decay_disagreement n A alpha gamma h x0 x u : design alpha gamma h ->
  powers_decay n (mv n (differences_step n A (mu_of alpha gamma h))) ->
  closed_loop (S n) A alpha gamma h x0 x u ->
  forall i j, (i < S n)%nat -> (j < S n)%nat ->
  is_lim_seq (fun k => x (INR k * h) i - x (INR k * h) j) 0.
Proof.
  intros D Dec H.
  assert (L : forall i, (i < S n)%nat ->
            is_lim_seq (fun k => x (INR k * h) i - x (INR k * h) n) 0).
  { intros i Hi. destruct (Nat.eq_dec i n) as [->|Ne].
    - apply is_lim_seq_ext with (fun _ => 0); [intros; ring|apply is_lim_seq_const].
    - assert (Hn : (i < n)%nat) by lia.
      apply is_lim_seq_ext with (fun k => iter k (mv n (differences_step n A
        (mu_of alpha gamma h))) (differences n x0) i).
      + intros k. rewrite <- differences_iter by exact Hn. unfold differences.
        rewrite !(loop_sample (S n) A alpha gamma h x0 D x u H k) by lia. reflexivity.
      + apply (decay_lim n); assumption. }
  intros i j Hi Hj. apply is_lim_seq_ext with
    (fun k => (x (INR k * h) i - x (INR k * h) n) - (x (INR k * h) j - x (INR k * h) n));
    [intros; ring|].
  replace (Finite 0) with (Finite (0 - 0)) by (f_equal; ring). apply is_lim_seq_minus'; auto.
Qed.

(** On 1perp the differences are as large as the vector, up to factors. *)
Lemma differences_norm n x : zero_sum (S n) x ->
  dot n (differences n x) (differences n x) = dot (S n) x x + INR (S n) * x n ^ 2.
Proof.
  intros Hx. unfold dot.
  rewrite <- (Rplus_0_r (sum_lt n _)).
  replace 0 with (differences n x n * differences n x n) by (unfold differences; ring).
  rewrite <- (sum_last n (fun i => differences n x i * differences n x i)).
  rewrite (sum_ext (S n) _ (fun i => x i * x i - 2 * x n * x i + x n ^ 2))
    by (intros; unfold differences; ring).
  rewrite sum_plus, sum_minus, sum_scal, sum_const.
  change (\sum_(i < S n) x i) with (sum_lt (S n) x). unfold zero_sum in Hx. rewrite Hx. ring.
Qed.

Lemma decay_1perp n A mu : balanced (S n) A -> powers_decay n (mv n (differences_step n A mu)) ->
  exists C rho, 0 <= C /\ 0 <= rho < 1 /\
  decays_on_1perp (S n) (mv (S n) (perron (S n) A mu)) C rho.
Proof.
  intros bal [C [rho [HC [Hr Hd]]]].
  assert (Np : 0 < INR (S n)) by (apply lt_0_INR; lia).
  set (K := 1 + INR (S n)).
  exists (C * K), rho. split; [unfold K; nra|]. split; [exact Hr|]. intros k e He.
  set (z := iter k (mv (S n) (perron (S n) A mu)) e).
  assert (Hz : zero_sum (S n) z) by (apply zero_sum_iter; assumption).
  assert (A1 : norm (S n) z <= norm n (differences n z)).
  { apply norm_le_bound; [apply norm_nonneg|].
    rewrite norm_pow2, (differences_norm n z Hz). assert (Q := pow2_ge_0 (z n)). nra. }
  assert (A2 : norm n (differences n e) <= K * norm (S n) e).
  { apply norm_le_bound; [apply Rmult_le_pos; [unfold K; lra|apply norm_nonneg]|].
    rewrite (differences_norm n e He), Rpow_mult_distr, norm_pow2.
    assert (Q := sum_ge_term (S n) (fun i => e i * e i) n (fun i _ => Rle_0_sqr (e i)) ltac:(lia)).
    cbv beta in Q. fold (dot (S n) e e) in Q. assert (P := dot_nonneg (S n) e).
    assert (INR (S n) * (e n * e n) <= INR (S n) * dot (S n) e e)
      by (apply Rmult_le_compat_l; lra).
    apply Rle_trans with (K * dot (S n) e e); [unfold K; lra|].
    apply Rmult_le_compat_r; [exact P|]. unfold K. nra. }
  eapply Rle_trans; [exact A1|]. unfold z.
  rewrite (norm_ext n _ _ (fun i Hi => differences_iter n A mu k e i Hi)).
  eapply Rle_trans; [apply Hd|].
  replace (C * K * rho ^ k * norm (S n) e) with (C * rho ^ k * (K * norm (S n) e)) by ring.
  apply Rmult_le_compat_l; [|exact A2]. apply Rmult_le_pos; [exact HC|apply pow_le; lra].
Qed.

Theorem lyapunov_test : lyapunov_test_statement.
Proof.
  intros n A Q t mu _ HQ HS Hmu.
  assert (D := smaller_step_decay n A t mu Hmu (stein_decay n Q _ HQ HS)).
  split; [|split].
  - apply decay_spectrum, D.
  - intros alpha gamma h x0 x u Ds E H. rewrite <- E in D.
    apply (decay_disagreement n A alpha gamma h x0 x u Ds D H).
  - intros bal. apply decay_1perp; assumption.
Qed.
