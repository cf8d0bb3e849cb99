(** The checker's tests on two agents: their hypotheses hold, and their conclusions fail without. *)
From Coq Require Import Reals Arith Lia Lra.
From Coquelicot Require Import Coquelicot.
From Fomas Require Import Model.Vectors Model.Graph Model.Loop Model.Coordinates Model.Examples Statements.
From Fomas Require Import Facts.Sums Facts.Vectors Facts.Graph Facts.Forms.
From Fomas Require Import Results.Coordinates Results.Stability Results.Refutation Instances.PairGraph Instances.Examples.
Open Scope R_scope.

(** With n = 1 every matrix is a number. *)
Lemma form_1 Q y : form 1 Q y = Q 0%nat 0%nat * y 0%nat ^ 2.
Proof. unfold form, dot, mv. simpl. ring. Qed.

Lemma dot_1 y : dot 1 y y = y 0%nat ^ 2.
Proof. unfold dot. simpl. ring. Qed.

Lemma definite_1 Q : 0 < Q 0%nat 0%nat -> positive_definite 1 Q.
Proof. intros H y Py. rewrite form_1. rewrite dot_1 in Py. nra. Qed.

Lemma semidefinite_1 Q : 0 <= Q 0%nat 0%nat -> positive_semidefinite 1 Q.
Proof. intros H y. rewrite form_1. apply Rmult_le_pos; [exact H|apply pow2_ge_0]. Qed.

Definition unit_form : mat := fun _ _ => 1.

(** On a pair Pc(t) is the number 1 - 2 t. *)
Lemma pair_stein t :
  stein_form 1 unit_form (differences_step 1 pair_graph t) 0%nat 0%nat = 1 - (1 - 2 * t) ^ 2.
Proof.
  unfold stein_form, differences_step, differences_laplacian, unit_form, laplacian, degree, pair_graph,
    id_mat. simpl. ring.
Qed.

(** V y = x needs x in 1perp. *)
Theorem basis_fails_off_1perp : embed 1 ones 1%nat <> ones 1%nat.
Proof. unfold embed, ones. simpl. lra. Qed.

(** A test that is not strict has no margin. *)
Theorem margin_needs_definite : exists Q, positive_semidefinite 1 Q /\
  ~ exists eps, 0 < eps /\ forall y, eps * dot 1 y y <= form 1 Q y.
Proof.
  exists (fun _ _ => 0). split; [apply semidefinite_1; lra|]. intros [eps [He H]].
  specialize (H ones). rewrite form_1, dot_1 in H. unfold ones in H. lra.
Qed.

(** The strict test of sigma on a pair at mu = 1/2, s = 1/2; it fails at mu = 1, where sigma = 1. *)
Theorem contraction_test_inhabited :
  let tested mu := on_basis 1 (fun i j =>
    (/ 2) ^ 2 * id_mat i j - gram 2 (perron 2 pair_graph mu) i j) in
  positive_definite 1 (tested (/ 2)) /\ ~ positive_semidefinite 1 (tested 1) /\
  ~ contracts 2 pair_graph 1 (/ 2).
Proof.
  intros tested.
  assert (E : forall mu, tested mu 0%nat 0%nat = 2 * (/ 2) ^ 2 - 2 * (1 - 2 * mu) ^ 2).
  { intros mu. unfold tested, on_basis, gram, perron, laplacian, degree, pair_graph, id_mat. simpl.
    ring. }
  assert (F : ~ positive_semidefinite 1 (tested 1)).
  { intros H. specialize (H ones). rewrite form_1, E in H. unfold ones in H. lra. }
  split; [apply definite_1; rewrite E; lra|]. split; [exact F|].
  intros C. apply F, (contraction_test 1%nat pair_graph 1 (/ 2) ltac:(lra)), C.
Qed.

(** The strict test of lambda2 = 2 on a pair at s = 1; it fails at s = 3. *)
Theorem lambda2_test_inhabited :
  let tested s := on_basis 1 (fun i j => laplacian_sym 2 pair_graph i j - s * id_mat i j) in
  positive_definite 1 (tested 1) /\ ~ positive_semidefinite 1 (tested 3).
Proof.
  intros tested.
  assert (E : forall s, tested s 0%nat 0%nat = 4 - 2 * s).
  { intros s. unfold tested, on_basis, laplacian_sym, laplacian, degree, pair_graph, id_mat. simpl.
    field. }
  split; [apply definite_1; rewrite E; lra|]. intros H. specialize (H ones).
  rewrite form_1, E in H. unfold ones in H. lra.
Qed.

(** A Lyapunov matrix on an unbalanced pair: Q = 1 at t = 1/3. *)
Theorem lyapunov_test_inhabited :
  symmetric 1 unit_form /\ positive_definite 1 unit_form /\
  positive_definite 1 (stein_form 1 unit_form (differences_step 1 unbalanced_pair (/ 3))) /\
  perron_spectrum 2 unbalanced_pair (/ 4).
Proof.
  assert (S : symmetric 1 unit_form) by (intros i j _ _; reflexivity).
  assert (P : positive_definite 1 unit_form) by (apply definite_1; unfold unit_form; lra).
  assert (F : positive_definite 1 (stein_form 1 unit_form (differences_step 1 unbalanced_pair (/ 3)))).
  { apply definite_1. unfold stein_form, differences_step, differences_laplacian, unit_form,
      laplacian, degree, unbalanced_pair, id_mat. simpl. lra. }
  split; [exact S|]. split; [exact P|]. split; [exact F|].
  apply (lyapunov_test 1%nat unbalanced_pair unit_form (/ 3) (/ 4) S P F). lra.
Qed.

(** It has to be strict: at mu = 1 a pair has Q - Pc^T Q Pc = 0 and the eigenvalue -1. *)
Theorem lyapunov_test_needs_strictness :
  positive_semidefinite 1 (stein_form 1 unit_form (differences_step 1 pair_graph 1)) /\
  ~ perron_spectrum 2 pair_graph 1.
Proof.
  split; [apply semidefinite_1; rewrite pair_stein; lra|].
  intros [_ [_ H]]. set (v := of_list (1 :: -1 :: nil)%list).
  assert (Hv : zero_sum 2 v) by (unfold zero_sum, v, of_list; simpl; lra).
  assert (T : (-1) ^ 2 + 0 ^ 2 < 1); [|lra].
  apply (H (-1) 0 v (fun _ => 0)).
  - unfold dot, v, of_list. simpl. lra.
  - intros i Hi. rewrite pair_perron by assumption. ring.
  - intros i Hi. unfold mv. simpl. ring.
  - intros [C _]. lra.
Qed.

(** A pair at mu = 1: Y = 1 shows that it does not agree. *)
Theorem persistence_test_inhabited :
  positive_semidefinite 1
    (fun i j => - stein_form 1 unit_form (differences_step 1 pair_graph 1) i j) /\
  forall alpha gamma h, design alpha gamma h -> 1 <= mu_of alpha gamma h ->
  exists x0 x u i, closed_loop 2 pair_graph alpha gamma h x0 x u /\ (i < 2)%nat /\
    ~ is_lim_seq (fun k => u k i) 0.
Proof.
  assert (F : positive_semidefinite 1
    (fun i j => - stein_form 1 unit_form (differences_step 1 pair_graph 1) i j))
    by (apply semidefinite_1; rewrite pair_stein; lra).
  split; [exact F|]. intros alpha gamma h D Hm.
  apply (persistence_test 1%nat pair_graph unit_form 1 (mu_of alpha gamma h)) with (alpha := alpha)
    (gamma := gamma) (h := h).
  - intros i j _ _. reflexivity.
  - apply semidefinite_1. unfold unit_form. lra.
  - exists 0%nat, 0%nat. unfold unit_form. repeat split; try lia. lra.
  - exact F.
  - lra.
  - exact D.
  - reflexivity.
  - exact pair_assumption1.
Qed.

(** Y = 0 shows nothing: at mu = 1/2 it meets the other hypotheses, and a pair agrees. *)
Theorem persistence_test_needs_nonzero :
  positive_semidefinite 1
    (fun i j => - stein_form 1 (fun _ _ => 0) (differences_step 1 pair_graph (/ 2)) i j) /\
  forall alpha gamma h x0 x u, design alpha gamma h -> mu_of alpha gamma h = / 2 ->
  closed_loop 2 pair_graph alpha gamma h x0 x u ->
  is_lim_seq (fun k => x (INR k * h) 0%nat - x (INR k * h) 1%nat) 0.
Proof.
  split.
  - apply semidefinite_1. unfold stein_form. simpl. lra.
  - intros alpha gamma h x0 x u D E H.
    apply (lyapunov_test 1%nat pair_graph unit_form (/ 2) (/ 2)) with (alpha := alpha)
      (gamma := gamma) (x0 := x0) (u := u); try assumption; try lia; try lra.
    + intros i j _ _. reflexivity.
    + apply definite_1. unfold unit_form. lra.
    + apply definite_1. rewrite pair_stein. lra.
Qed.

(** A pair at mu >= 2: Pc(2) = -3 has a trace beyond 1. At mu = 1/2, where a pair agrees, no
    power has. *)
Theorem trace_test_inhabited :
  let trace t m := \sum_(i < 1) iter m (mv 1 (differences_step 1 pair_graph t)) (id_mat i) i in
  INR 1 < Rabs (trace 2 1%nat) /\ (forall mu, 2 <= mu -> disagreement 1 pair_graph mu) /\
  (forall m, Rabs (trace (/ 2) (S m)) <= INR 1) /\ ~ disagreement 1 pair_graph (/ 2).
Proof.
  intros trace.
  assert (E : forall t y, mv 1 (differences_step 1 pair_graph t) y 0%nat = (1 - 2 * t) * y 0%nat).
  { intros t y. unfold mv, differences_step, differences_laplacian, laplacian, degree, pair_graph, id_mat.
    simpl. ring. }
  assert (T : INR 1 < Rabs (trace 2 1%nat)).
  { unfold trace. simpl sum_lt. simpl iter. rewrite E. unfold id_mat. simpl.
    rewrite Rabs_left; lra. }
  split; [exact T|]. split; [|split].
  - intros mu Hm. apply (trace_test 1%nat pair_graph 2 mu 1%nat T). lra.
  - intros m. unfold trace. simpl sum_lt. simpl iter. rewrite E.
    replace (0 + (1 - 2 * / 2) * _) with 0 by field. rewrite Rabs_R0. simpl. lra.
  - intros C. destruct (design_for_mu (/ 2) (/ 2) ltac:(lra) ltac:(lra)) as [D Em].
    destruct (C _ _ _ D Em) as [[x0 [x [u [i [H [Hi NL]]]]]] _]. apply NL.
    replace i with 0%nat by lia. apply (proj2 persistence_test_needs_nonzero _ _ _ x0 x u D Em H).
Qed.
