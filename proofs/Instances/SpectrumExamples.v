(** perron-eigenvalues on two agents: where it holds, where not, and what it does not say. *)
From Coq Require Import Reals Arith List Lia Lra.
From Coquelicot Require Import Coquelicot.
From Fomas Require Import Model.Vectors Model.Graph Model.Loop Model.Coordinates Model.Examples Statements.
From Fomas Require Import Facts.Sums Facts.Vectors Facts.Graph.
From Fomas Require Import Results.Stability Results.Refutation Results.Spectrum Results.Step.
From Fomas Require Import Instances.PairGraph Instances.Examples Instances.TestExamples.
Open Scope R_scope.

(** On a pair L has the eigenvalues 0 and 2, so perron-eigenvalues is mu < 1; beyond, controls do
    not vanish. *)
Theorem spectrum_inhabited :
  (forall mu, 0 < mu -> (perron_spectrum 2 pair_graph mu <-> mu < 1)) /\
  (forall alpha gamma h, design alpha gamma h -> 1 <= mu_of alpha gamma h ->
   ~ forall x0 x u, closed_loop 2 pair_graph alpha gamma h x0 x u ->
     forall i, (i < 2)%nat -> is_lim_seq (fun k => u k i) 0).
Proof.
  assert (E : forall mu, 0 < mu -> (perron_spectrum 2 pair_graph mu <-> mu < 1)).
  { intros mu Hmu. split.
    - intros H. apply Rnot_le_lt. intros C.
      apply (persistence_test 1%nat pair_graph unit_form 1 mu); [| | | |lra|exact H].
      + intros i j _ _. reflexivity.
      + apply semidefinite_1. unfold unit_form. lra.
      + exists 0%nat, 0%nat. unfold unit_form. repeat split; try lia. lra.
      + apply semidefinite_1. rewrite pair_stein. lra.
    - intros H. apply (lyapunov_test 1%nat pair_graph unit_form mu mu); [| | |lra].
      + intros i j _ _. reflexivity.
      + apply definite_1. unfold unit_form. lra.
      + apply definite_1. rewrite pair_stein. nra. }
  split; [exact E|]. intros alpha gamma h D Hm C.
  apply (claims_are_one 2%nat pair_graph alpha gamma h (le_n 2) pair_assumption1 D) in C.
  apply E in C; lra.
Qed.

(** Without balance it does not make P^k vanish on 1perp, only the differences. *)
Theorem spectrum_needs_balance :
  perron_spectrum 2 unbalanced_pair (/ 4) /\ ~ vanishes_on_1perp 2 unbalanced_pair (/ 4).
Proof.
  split; [apply lyapunov_test_inhabited|]. intros V. set (v := of_list (1 :: -1 :: nil)%list).
  assert (Hv : zero_sum 2 v) by (unfold zero_sum, v, of_list; simpl; lra).
  assert (K : forall k, 2 * iter k (mv 2 (perron 2 unbalanced_pair (/ 4))) v 0%nat
                        + iter k (mv 2 (perron 2 unbalanced_pair (/ 4))) v 1%nat = 1).
  { induction k as [|k IH]; [unfold v, of_list; simpl; ring|]. simpl iter.
    rewrite !perron_entry, !laplacian_entry by lia.
    revert IH. generalize (iter k (mv 2 (perron 2 unbalanced_pair (/ 4))) v). intros y IH.
    transitivity (2 * y 0%nat + y 1%nat); [simpl; field|exact IH]. }
  assert (L := is_lim_seq_plus' _ _ _ _
            (is_lim_seq_scal_l _ 2 _ (V v Hv 0%nat ltac:(lia))) (V v Hv 1%nat ltac:(lia))).
  apply is_lim_seq_ext with (v := fun _ => 1) in L; [|exact K].
  apply is_lim_seq_unique in L. rewrite Lim_seq_const in L. apply (f_equal real) in L. simpl in L. lra.
Qed.

(** The step on a pair: true at mu = 1/2, where lambda2 = lambda_N = 2; false at mu = 3/4, where
    mu lambda2 > 1. *)
Theorem symmetric_step_inhabited :
  bounded_on_1perp 2 (mv 2 (perron 2 pair_graph (/ 2))) (1 - / 2 * 2) /\
  ~ bounded_on_1perp 2 (mv 2 (perron 2 pair_graph (3 / 4))) (1 - 3 / 4 * 2).
Proof.
  split.
  - apply (symmetric_step 2%nat pair_graph (/ 2) 2 2); [lia|lra| |exact pair_lambda2| |lra|lra].
    + intros i j _ _. unfold pair_graph. rewrite Nat.eqb_sym. reflexivity.
    + intros x Hx. unfold zero_sum in Hx. simpl in Hx.
      unfold form, dot, mv, laplacian_sym, laplacian, degree, pair_graph. simpl.
      replace (x 1%nat) with (- x 0%nat) by lra. right. field.
  - intros H. set (v := of_list (1 :: -1 :: nil)%list).
    assert (Hv : zero_sum 2 v) by (unfold zero_sum, v, of_list; simpl; lra). specialize (H v Hv).
    assert (N0 := norm_nonneg 2 (mv 2 (perron 2 pair_graph (3 / 4)) v)).
    assert (Np : 0 < norm 2 v) by (apply sqrt_lt_R0; unfold dot, v, of_list; simpl; lra). lra.
Qed.

(** On a pair eqL3 holds for 1/2 <= mu <= 1, and perron-eigenvalues at every smaller gain; at
    mu = 1 itself it does not. *)
Theorem eqL3_needs_spectrum_inhabited : forall alpha gamma h, design alpha gamma h ->
  let mu := mu_of alpha gamma h in
  / 2 <= mu <= 1 -> control_norm_bound 2 pair_graph alpha gamma h /\
  (forall t, 0 < t < mu -> perron_spectrum 2 pair_graph t) /\
  (mu = 1 -> ~ perron_spectrum 2 pair_graph mu).
Proof.
  intros alpha gamma h D mu Hmu.
  assert (B : control_norm_bound 2 pair_graph alpha gamma h)
    by (apply (eqT2_not_necessary alpha gamma h D Hmu)).
  split; [exact B|]. split.
  - intros t Ht. apply (eqL3_needs_spectrum 2%nat pair_graph alpha gamma h t (le_n 2) pair_assumption1 D B Ht).
  - intros E C. apply (proj1 spectrum_inhabited) in C; lra.
Qed.
