(** Inhabited hypotheses of the peak lemma, of Lyapunov certificates and of residual factors;
    the peak bound fails without its second hypothesis. *)
From Coq Require Import Reals Arith Lia Lra.
From Fomas Require Import Model.Vectors Model.Kernel Model.Graph Model.Loop Model.Examples Statements.
From Fomas Require Import Facts.Sums Facts.Vectors Facts.Kernel Facts.Resolvent Facts.Graph Facts.Phi.
From Fomas Require Import Results.Soundness Results.NormBound Instances.PairGraph.
Open Scope R_scope.

(** At mu = 1/2 a pair agrees in one step: P vanishes on 1perp. *)
Lemma pair_half_powers n e : zero_sum 2 e -> (1 <= n)%nat ->
  norm 2 (iter n (mv 2 (perron 2 pair_graph (/ 2))) e) = 0.
Proof.
  intros He Hn. apply norm_zero. destruct n as [|n]; [lia|]. intros i Hi. simpl.
  rewrite pair_perron; [field| |exact Hi].
  apply zero_sum_iter; [apply pair_assumption1|exact He].
Qed.

Theorem peak_inhabited : forall alpha, 0 < alpha < 1 ->
  let P := perron 2 pair_graph (/ 2) in
  (forall k, (k <= 0)%nat -> bounded_on_1perp 2 (Phi alpha 2 P k) 1) /\
  (forall n, (0 < n)%nat -> bounded_on_1perp 2 (iter n (mv 2 P)) (1 * ck alpha n)) /\
  bounded_on_1perp 2 (iter 1 (mv 2 P)) (ck alpha 2 / ck alpha 1).
Proof.
  intros alpha Ha P.
  assert (C : forall n, (1 <= n)%nat -> forall c, 0 <= c -> bounded_on_1perp 2 (iter n (mv 2 P)) c).
  { intros n Hn c Hc e He. unfold P. rewrite pair_half_powers by assumption.
    apply Rmult_le_pos; [exact Hc|apply norm_nonneg]. }
  split; [|split].
  - intros k Hk e He. replace k with 0%nat by lia.
    rewrite (norm_ext 2 _ e) by (intros; apply phi_0). lra.
  - intros n Hn. apply C; [lia|]. assert (Q := ck_pos alpha Ha n). lra.
  - apply C; [lia|]. apply Rmult_le_pos; [left; apply ck_pos, Ha|].
    left. apply Rinv_0_lt_compat, ck_pos, Ha.
Qed.

(** Without decay the peak bound fails: at mu = 2 a pair's P is -3 on 1perp, and Phi_1
    exceeds every bound that Phi_0 meets with M = 1. *)
Theorem peak_fails_without_decay : forall alpha, 0 < alpha < 1 ->
  let P := perron 2 pair_graph 2 in
  bounded_on_1perp 2 (Phi alpha 2 P 0) 1 /\ ~ bounded_on_1perp 2 (Phi alpha 2 P 1) 1.
Proof.
  intros alpha Ha P. split.
  - intros e He. rewrite (norm_ext 2 _ e) by (intros; apply phi_0). lra.
  - intros H. set (e := of_list (1 :: -1 :: nil)%list).
    assert (He : zero_sum 2 e) by (unfold zero_sum, e, of_list; simpl; lra).
    specialize (H e He). unfold P in H.
    rewrite (norm_ext 2 _ _ (fun i Hi => pair_phi alpha 2 1 e i He Hi)), norm_scal in H.
    assert (Ne : 0 < norm 2 e).
    { apply sqrt_lt_R0. unfold dot, e, of_list. simpl. lra. }
    apply Rmult_le_reg_r in H; [|exact Ne].
    assert (R1 := rk_le_1 alpha Ha 1). assert (R0 := rk_pos alpha Ha 1).
    simpl in H. rewrite rk_0 in H. rewrite Rabs_left in H by lra. lra.
Qed.

(** A Lyapunov certificate: Q = I, rho = 0 at mu = 1/2. *)
Theorem lyapunov_inhabited :
  (forall x, zero_sum 2 x -> 1 * dot 2 x x <= form 2 id_mat x <= 1 * dot 2 x x) /\
  (forall x, zero_sum 2 x ->
     form 2 id_mat (mv 2 (perron 2 pair_graph (/ 2)) x) <= 0 ^ 2 * form 2 id_mat x).
Proof.
  assert (F : forall x, form 2 id_mat x = dot 2 x x).
  { intros x. unfold form. apply dot_ext; [reflexivity|]. intros i Hi. apply id_mat_sum, Hi. }
  split; intros x Hx; rewrite !F; [lra|].
  rewrite (dot_ext 2 _ _ _ _ (fun i Hi => pair_perron (/ 2) x i Hx Hi)
             (fun i Hi => pair_perron (/ 2) x i Hx Hi)).
  rewrite dot_scal_l, dot_scal_r. assert (P := dot_nonneg 2 x). nra.
Qed.

(** A factor with a residual that is not zero: [[2, 1], [1, 2]] - (1/4) I = R R^T + E. *)
Theorem residual_factor_inhabited : forall x,
  0 <= form 2 (fun i j => if Nat.eqb i j then 2 else 1) x.
Proof.
  set (Q := fun i j : nat => if Nat.eqb i j then 2 else 1).
  set (R := fun i k : nat => match i, k with
    | 0%nat, 0%nat => 5 / 4 | 1%nat, 0%nat => 4 / 5 | 1%nat, 1%nat => 1 | _, _ => 0 end).
  set (E := fun i j : nat => Q i j - / 4 * id_mat i j - \sum_(k < 2) (R i k * R j k)).
  apply (residual_factor 2%nat 2%nat Q R E (/ 4)).
  - intros i j _ _. unfold E. ring.
  - intros i j Hi Hj. unfold E. below2 i; below2 j; unfold Q, R, id_mat; simpl; ring.
  - intros i Hi. below2 i; unfold E, Q, R, id_mat; simpl; unfold Rabs;
      repeat destruct Rcase_abs; lra.
Qed.
