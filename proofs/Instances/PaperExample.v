(** The paper's example (section IV): its hypotheses hold, and two steps of its proof fail. *)
From Coq Require Import Reals Arith Lia Lra.
From Coquelicot Require Import Coquelicot.
From Interval Require Import Tactic.
From Fomas Require Import Model.Vectors Model.Kernel Model.Gamma Model.Graph Model.Loop Model.Examples Statements.
From Fomas Require Import Facts.Sums Facts.Vectors Facts.Kernel Facts.Resolvent Facts.Graph Facts.Loop.
From Fomas Require Import Results.EqT2 Results.BalancedGraph Results.Step Instances.Gamma19.
Open Scope R_scope.

(** Case analysis on an index below 5. *)
Ltac below5 i := destruct i as [|[|[|[|[|i]]]]]; [| | | | |lia].

(** The walk 1 -> 2 -> 3 -> 4 -> 5 -> 1 joins every pair of agents. *)
Ltac walk := lazymatch goal with
  | |- reaches _ _ ?i ?i => apply reaches_self
  | |- reaches _ _ _ 0%nat =>
      apply (reaches_edge _ _ _ 4); [walk|lia|lia|cbn; lra]
  | |- reaches _ _ _ (S ?j) =>
      apply (reaches_edge _ _ _ j); [walk|lia|lia|cbn; lra]
  end.

Lemma paper_assumption1 : assumption1 5 paper_graph.
Proof.
  split; [split|split].
  - intros i j Hi Hj. below5 i; below5 j; cbn; lra.
  - intros i Hi. below5 i; reflexivity.
  - intros i j Hi Hj. below5 i; below5 j; walk.
  - intros i Hi. below5 i; cbn; lra.
Qed.

Lemma paper_degree : degree_max 5 paper_graph = 2.
Proof.
  unfold degree_max, degree. cbn.
  repeat (rewrite ?Rplus_0_l, ?Rplus_0_r).
  unfold Rmax. repeat destruct Rle_dec; lra.
Qed.

(** x^T L_s x for the paper's graph. *)
Lemma paper_form x : form 5 (laplacian_sym 5 paper_graph) x = / 2 *
  ((x 0%nat - x 3%nat) ^ 2 + (x 0%nat - x 4%nat) ^ 2 + (x 1%nat - x 0%nat) ^ 2 + (x 1%nat - x 2%nat) ^ 2 + (x 2%nat - x 0%nat) ^ 2
   + (x 2%nat - x 1%nat) ^ 2 + (x 3%nat - x 1%nat) ^ 2 + (x 3%nat - x 2%nat) ^ 2 + (x 4%nat - x 3%nat) ^ 2).
Proof.
  rewrite (proj2 (quadratic_form 5%nat paper_graph x (proj2 (proj2 paper_assumption1)))).
  unfold paper_graph. cbn -[pow]. ring.
Qed.

Lemma paper_lambda2 : is_lambda2 5 paper_graph 1.
Proof.
  split.
  - intros x Hx. unfold zero_sum in Hx. simpl in Hx. rewrite paper_form. unfold dot. simpl sum_lt.
    revert Hx. generalize (x 0%nat) (x 1%nat) (x 2%nat) (x 3%nat) (x 4%nat).
    intros a b c d e Hx. replace e with (- (a + b + c + d)) by lra.
    assert (S1 := pow2_ge_0 (a + d / 4)). assert (S2 := pow2_ge_0 (b - c)).
    assert (S3 := pow2_ge_0 d). apply Rminus_le_0.
    match goal with |- 0 <= ?G =>
      replace G with (2 * (a + d / 4) ^ 2 + (b - c) ^ 2 + 15 / 8 * d ^ 2) by field end.
    lra.
  - exists (of_list (0 :: -1 :: -1 :: 0 :: 2 :: nil)%list).
    rewrite paper_form. unfold zero_sum, dot, of_list. simpl. split; [|split]. all: lra.
Qed.

Theorem paper_hypotheses : paper_hypotheses_statement.
Proof.
  assert (M := paper_mu_bounds). assert (C := paper_c1_bounds).
  split; [exact paper_assumption1|]. split; [exact paper_degree|].
  split; [exact paper_lambda2|]. split.
  - unfold gain_bound. rewrite paper_degree. lra.
  - apply eqT2_closed_form; [unfold paper_alpha; lra|].
    assert (S := sqrt_pos (Rpower 3 paper_alpha - Rpower 2 paper_alpha)). lra.
Qed.

Lemma paper_design : design paper_alpha paper_gamma paper_h.
Proof. unfold design, paper_alpha, paper_gamma, paper_h. lra. Qed.

(** One step e |-> P e on the paper's graph, written out. *)
Definition paper_step (mu : R) (e : vec) : vec := of_list
  (e 0%nat - mu * (2 * e 0%nat - e 3%nat - e 4%nat) :: e 1%nat - mu * (2 * e 1%nat - e 0%nat - e 2%nat)
   :: e 2%nat - mu * (2 * e 2%nat - e 0%nat - e 1%nat) :: e 3%nat - mu * (2 * e 3%nat - e 1%nat - e 2%nat)
   :: e 4%nat - mu * (e 4%nat - e 3%nat) :: nil)%list.

Lemma paper_step_correct mu e i : (i < 5)%nat ->
  mv 5 (perron 5 paper_graph mu) e i = paper_step mu e i.
Proof.
  intros Hi. rewrite perron_entry, laplacian_entry by exact Hi.
  below5 i; unfold paper_graph; cbn; ring.
Qed.

(** e_0 = L x_0 on the paper's trajectory, and e_1 .. e_4 as polynomials in mu. *)
Definition paper_e0 : vec := of_list (17 / 2 :: -1 / 2 :: 5 / 2 :: -8 :: -5 / 2 :: nil)%list.
Definition paper_e1 (m : R) : vec := of_list
  (17 / 2 - 55 / 2 * m :: 12 * m - 1 / 2 :: 3 * m + 5 / 2 :: 18 * m - 8
   :: - 11 / 2 * m - 5 / 2 :: nil)%list.
Definition paper_e2 (m : R) : vec := of_list
  (135 / 2 * m ^ 2 - 55 * m + 17 / 2 :: - 97 / 2 * m ^ 2 + 24 * m - 1 / 2
   :: - 43 / 2 * m ^ 2 + 6 * m + 5 / 2 :: - 21 * m ^ 2 + 36 * m - 8
   :: 47 / 2 * m ^ 2 - 11 * m - 5 / 2 :: nil)%list.
Definition paper_e3 (m : R) : vec := of_list
  (- 265 / 2 * m ^ 3 + 405 / 2 * m ^ 2 - 165 / 2 * m + 17 / 2
   :: 143 * m ^ 3 - 291 / 2 * m ^ 2 + 36 * m - 1 / 2
   :: 62 * m ^ 3 - 129 / 2 * m ^ 2 + 9 * m + 5 / 2
   :: - 28 * m ^ 3 - 63 * m ^ 2 + 54 * m - 8
   :: - 89 / 2 * m ^ 3 + 141 / 2 * m ^ 2 - 33 / 2 * m - 5 / 2 :: nil)%list.
Definition paper_e4 (m : R) : vec := of_list
  (385 / 2 * m ^ 4 - 530 * m ^ 3 + 405 * m ^ 2 - 110 * m + 17 / 2
   :: - 713 / 2 * m ^ 4 + 572 * m ^ 3 - 291 * m ^ 2 + 48 * m - 1 / 2
   :: - 227 / 2 * m ^ 4 + 248 * m ^ 3 - 129 * m ^ 2 + 12 * m + 5 / 2
   :: 261 * m ^ 4 - 112 * m ^ 3 - 126 * m ^ 2 + 72 * m - 8
   :: 33 / 2 * m ^ 4 - 178 * m ^ 3 + 141 * m ^ 2 - 22 * m - 5 / 2 :: nil)%list.

Lemma paper_laplacian_x0 i : (i < 5)%nat ->
  mv 5 (laplacian 5 paper_graph) paper_x0 i = paper_e0 i.
Proof.
  intros Hi. rewrite laplacian_entry by exact Hi.
  below5 i; unfold paper_graph, paper_x0, paper_e0; cbn; lra.
Qed.

Ltac poly_step := let j := fresh in intros j ?; below5 j;
  unfold paper_step, paper_e0, paper_e1, paper_e2, paper_e3, paper_e4, of_list;
  cbn -[pow Rmult Rplus Rminus Ropp Rdiv IZR]; field.

Lemma paper_e4_correct m i : (i < 5)%nat ->
  iter 4 (mv 5 (perron 5 paper_graph m)) (mv 5 (laplacian 5 paper_graph) paper_x0) i
  = paper_e4 m i.
Proof.
  set (T := mv 5 (perron 5 paper_graph m)). set (e := mv 5 (laplacian 5 paper_graph) paper_x0).
  assert (step : forall k y z, (forall i, (i < 5)%nat -> iter k T e i = y i) ->
            (forall i, (i < 5)%nat -> paper_step m y i = z i) ->
            forall i, (i < 5)%nat -> iter (S k) T e i = z i).
  { intros k y z H Z j Hj. rewrite <- Z, <- paper_step_correct by exact Hj.
    apply mv_ext, H. }
  apply (step 3%nat (paper_e3 m)); [|poly_step].
  apply (step 2%nat (paper_e2 m)); [|poly_step].
  apply (step 1%nat (paper_e1 m)); [|poly_step].
  apply (step 0%nat paper_e0); [|poly_step].
  exact paper_laplacian_x0.
Qed.

Lemma sq_lt_norm N x y b : 0 <= b -> b ^ 2 * dot N x x < dot N y y ->
  b * norm N x < norm N y.
Proof.
  intros Hb H. rewrite <- !norm_sq in H.
  assert (P := norm_nonneg N x). assert (Q := norm_nonneg N y).
  apply Rnot_le_lt. intros C. nra.
Qed.

Lemma step_false_on_trajectory x u :
  closed_loop 5 paper_graph paper_alpha paper_gamma paper_h paper_x0 x u ->
  (1 - paper_mu * 1) * norm 5 (error 5 paper_graph paper_h x 4)
  < norm 5 (error 5 paper_graph paper_h x 5).
Proof.
  intros H. assert (M := paper_mu_bounds).
  set (e := fun k => iter k (mv 5 (perron 5 paper_graph paper_mu))
                       (mv 5 (laplacian 5 paper_graph) paper_x0)).
  assert (E : forall k i, (i < 5)%nat -> error 5 paper_graph paper_h x k i = e k i)
    by (intros k i Hi; apply (loop_error 5 paper_graph paper_alpha paper_gamma paper_h paper_x0
                                paper_design x u H k i Hi)).
  rewrite (norm_ext 5 _ _ (E 4%nat)), (norm_ext 5 _ _ (E 5%nat)).
  assert (E4 : forall i, (i < 5)%nat -> e 4%nat i = paper_e4 paper_mu i)
    by (intros i Hi; apply paper_e4_correct, Hi).
  assert (E5 : forall i, (i < 5)%nat -> e 5%nat i = paper_step paper_mu (paper_e4 paper_mu) i).
  { intros i Hi. rewrite <- paper_step_correct by exact Hi. apply mv_ext, E4. }
  rewrite (norm_ext 5 _ _ E4), (norm_ext 5 _ _ E5).
  apply sq_lt_norm; [lra|].
  revert M. generalize paper_mu. intros m M.
  apply Rminus_gt_0_lt.
  unfold dot, paper_step, paper_e4, of_list. simpl sum_lt. cbn [List.nth].
  interval with (i_prec 60, i_bisect m, i_taylor m, i_degree 6).
Qed.

(** L maps (0, -1, -1, -1, 1) to a Fiedler vector that is not an eigenvector of L. *)
Definition fiedler : vec := of_list (0 :: -1 :: -1 :: 0 :: 2 :: nil)%list.

Lemma counter_laplacian i : (i < 5)%nat ->
  mv 5 (laplacian 5 paper_graph) counter_x0 i = fiedler i.
Proof.
  intros Hi. rewrite laplacian_entry by exact Hi.
  below5 i; unfold paper_graph, counter_x0, fiedler; cbn; lra.
Qed.

Lemma step_false_at_start x u :
  closed_loop 5 paper_graph paper_alpha paper_gamma paper_h counter_x0 x u ->
  (1 - paper_mu * 1) * norm 5 (error 5 paper_graph paper_h x 0)
  < norm 5 (error 5 paper_graph paper_h x 1).
Proof.
  intros H. assert (M := paper_mu_bounds).
  rewrite (norm_ext 5 _ fiedler), (norm_ext 5 (error _ _ _ _ 1) (paper_step paper_mu fiedler)).
  - apply sq_lt_norm; [lra|]. unfold dot, paper_step, fiedler, of_list. simpl. nra.
  - intros i Hi. rewrite (loop_error 5 paper_graph paper_alpha paper_gamma paper_h counter_x0
      paper_design x u H 1 i Hi). simpl. rewrite <- paper_step_correct by exact Hi.
    apply mv_ext, counter_laplacian.
  - intros i Hi. rewrite (loop_error 5 paper_graph paper_alpha paper_gamma paper_h counter_x0
      paper_design x u H 0 i Hi). apply counter_laplacian, Hi.
Qed.

Theorem paper_step_false : paper_step_false_statement.
Proof. split; [exact step_false_on_trajectory|exact step_false_at_start]. Qed.

(** No gain and no period make the paper's step true on the paper's graph. *)
Theorem paper_step_never : forall mu, 0 < mu ->
  ~ bounded_on_1perp 5 (mv 5 (perron 5 paper_graph mu)) (1 - mu * 1).
Proof.
  intros mu Hmu. apply (step_fails 5%nat paper_graph mu 1 fiedler paper_lambda2 Hmu).
  - unfold zero_sum, fiedler, of_list. simpl. lra.
  - rewrite paper_form. unfold dot, fiedler, of_list. simpl. lra.
  - exists 0%nat. split; [lia|]. rewrite laplacian_entry by lia.
    unfold paper_graph, fiedler. cbn. lra.
Qed.

Theorem paper_eqL3_false : paper_eqL3_false_statement.
Proof.
  assert (F : forall x u,
     closed_loop 5 paper_graph paper_alpha paper_gamma paper_h counter_x0 x u ->
     norm 5 (u 0%nat) < norm 5 (u 1%nat)).
  { intros x u H. assert (M := paper_mu_bounds). assert (C := paper_c1_bounds).
    assert (Ha := proj1 paper_design).
    assert (W := counter_laplacian). set (w := fiedler) in *.
    assert (U0 : forall i, (i < 5)%nat -> u 0%nat i = - paper_gamma * w i).
    { intros i Hi. rewrite <- W by exact Hi.
      apply (loop_u0 5 paper_graph paper_alpha paper_gamma paper_h counter_x0 paper_design x u H i Hi). }
    set (c := Rpower 2 paper_alpha - 1) in *.
    assert (U1 : forall i, (i < 5)%nat ->
              u 1%nat i = - paper_gamma * (paper_step paper_mu w i + (1 - c) * w i)).
    { intros i Hi.
      assert (V := loop_convolution 5 paper_graph paper_alpha paper_gamma paper_h counter_x0
                     paper_design x u H 1 i Hi). simpl in V.
      rewrite fk_ck, ck_0, ck_1 in V. fold c in V.
      rewrite (mv_ext 5 _ _ (fun i => - paper_gamma * w i)) in V by exact U0.
      rewrite mv_scal, paper_step_correct, (U0 i Hi) in V by exact Hi.
      fold paper_mu in V. lra. }
    rewrite (norm_ext 5 _ _ U0), (norm_ext 5 _ _ U1), !norm_scal.
    assert (G : 0 < Rabs (- paper_gamma)) by (apply Rabs_pos_lt; unfold paper_gamma; lra).
    apply Rmult_lt_compat_l; [exact G|].
    rewrite <- (Rmult_1_l (norm 5 w)). apply sq_lt_norm; [lra|].
    revert M C. generalize paper_mu c. intros m d M C. apply Rminus_gt_0_lt.
    unfold dot, paper_step, w, fiedler, of_list. simpl sum_lt. cbn [List.nth].
    interval with (i_prec 60, i_bisect m, i_taylor m). }
  split; [exact F|]. intros B.
  assert (HL := exact_loop 5 paper_graph paper_alpha paper_gamma paper_h counter_x0 paper_design).
  specialize (F _ _ HL). specialize (B _ _ _ HL 1%nat). lra.
Qed.
