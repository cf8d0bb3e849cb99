(** The Laplacian of a balanced graph, the contraction of P on 1perp. *)
From Coq Require Import Reals Arith Lia Lra.
From Fomas Require Import Model.Vectors Model.Graph Facts.Sums Facts.Vectors.
Open Scope R_scope.

Section Laplacian.
Variables (N : nat) (A : mat).
Let L := laplacian N A.
Let Ls := laplacian_sym N A.

(** (L x)_i = sum_j a_ij (x_i - x_j). *)
Lemma laplacian_entry x i : (i < N)%nat -> mv N L x i = \sum_(j < N) (A i j * (x i - x j)).
Proof.
  intros Hi. unfold mv, L, laplacian.
  rewrite (sum_ext N _ (fun j => id_mat i j * (degree N A i * x j) - A i j * x j)).
  - rewrite sum_minus, (id_mat_sum N i (fun j => degree N A i * x j)) by exact Hi.
    unfold degree. rewrite <- sum_scal_r, <- sum_minus. apply sum_ext. intros; ring.
  - intros j _. unfold id_mat. destruct (Nat.eqb i j); ring.
Qed.

Lemma perron_entry mu x i : (i < N)%nat -> mv N (perron N A mu) x i = x i - mu * mv N L x i.
Proof.
  intros Hi. unfold mv, perron.
  rewrite (sum_ext N _ (fun j => id_mat i j * x j - mu * (laplacian N A i j * x j)))
    by (intros; ring).
  rewrite sum_minus, sum_scal, id_mat_sum by exact Hi. reflexivity.
Qed.

Lemma laplacian_ones i : (i < N)%nat -> mv N L ones i = 0.
Proof.
  intros Hi. rewrite laplacian_entry by exact Hi. apply sum_zero. intros. unfold ones. ring.
Qed.

(** L commutes with P. *)
Lemma laplacian_perron mu x i : (i < N)%nat ->
  mv N L (mv N (perron N A mu) x) i = mv N (perron N A mu) (mv N L x) i.
Proof.
  intros Hi. rewrite perron_entry by exact Hi.
  rewrite (mv_ext N L _ (fun j => x j - mu * mv N L x j))
    by (intros; apply perron_entry; assumption).
  rewrite mv_minus, mv_scal. reflexivity.
Qed.

Lemma laplacian_iter mu k x i : (i < N)%nat ->
  mv N L (iter k (mv N (perron N A mu)) x) i = iter k (mv N (perron N A mu)) (mv N L x) i.
Proof.
  revert i. induction k as [|k IH]; intros i Hi; simpl; [reflexivity|].
  rewrite laplacian_perron by exact Hi. apply mv_ext. exact IH.
Qed.

Lemma form_sym x : form N Ls x = form N L x.
Proof.
  rewrite !form_double_sum. unfold Ls, laplacian_sym.
  rewrite (sum_ext N _ (fun i => \sum_(j < N) (/ 2 * (L i j * x i * x j))
                               + \sum_(j < N) (/ 2 * (L j i * x j * x i)))).
  - rewrite sum_plus, (sum_swap N N (fun i j => / 2 * (L j i * x j * x i))).
    rewrite <- sum_plus. apply sum_ext. intros i _. rewrite <- sum_plus.
    apply sum_ext. intros j _. field.
  - intros i _. rewrite <- sum_plus. apply sum_ext. intros j _. unfold L. field.
Qed.

Lemma laplacian_sym_sym i j : Ls i j = Ls j i.
Proof. unfold Ls, laplacian_sym. f_equal. apply Rplus_comm. Qed.

Hypothesis bal : balanced N A.

(** 1^T L = 0. *)
Lemma zero_sum_laplacian x : zero_sum N (mv N L x).
Proof.
  unfold zero_sum.
  rewrite (sum_ext N _ (fun i => \sum_(j < N) (A i j * x i) - \sum_(j < N) (A i j * x j))).
  - rewrite sum_minus, (sum_swap N N (fun i j => A i j * x j)), <- sum_minus.
    apply sum_zero. intros i Hi. rewrite !sum_scal_r, bal by exact Hi.
    change (sum_lt N (A i)) with (\sum_(j < N) A i j). ring_simplify.
    unfold zero_sum. ring.
  - intros i Hi. rewrite laplacian_entry, <- sum_minus by exact Hi.
    apply sum_ext. intros; ring.
Qed.

Lemma sum_perron mu x : sum_lt N (mv N (perron N A mu) x) = sum_lt N x.
Proof.
  rewrite (sum_ext N _ (fun i => x i - mu * mv N L x i)) by (intros; apply perron_entry; auto).
  rewrite sum_minus, sum_scal. assert (H := zero_sum_laplacian x). unfold zero_sum in H.
  change (\sum_(i < N) mv N L x i) with (sum_lt N (mv N L x)). rewrite H.
  change (\sum_(i < N) x i) with (sum_lt N x). ring.
Qed.

Lemma zero_sum_perron mu x : zero_sum N x -> zero_sum N (mv N (perron N A mu) x).
Proof. unfold zero_sum. rewrite sum_perron. auto. Qed.

Lemma zero_sum_iter mu k x : zero_sum N x -> zero_sum N (iter k (mv N (perron N A mu)) x).
Proof. intros H. induction k; simpl; [exact H|]. apply zero_sum_perron. assumption. Qed.

Lemma form_laplacian x :
  form N L x = / 2 * \sum_(i < N) \sum_(j < N) (A i j * (x i - x j) ^ 2).
Proof.
  assert (E1 : form N L x = \sum_(i < N) \sum_(j < N) (A i j * x i * x i)
                          - \sum_(i < N) \sum_(j < N) (A i j * x i * x j)).
  { unfold form, dot. rewrite <- sum_minus. apply sum_ext. intros i Hi.
    rewrite laplacian_entry by exact Hi. rewrite <- sum_scal, <- sum_minus.
    apply sum_ext. intros; ring. }
  assert (E2 : \sum_(i < N) \sum_(j < N) (A i j * x j * x j)
             = \sum_(i < N) \sum_(j < N) (A i j * x i * x i)).
  { rewrite sum_swap. apply sum_ext. intros i Hi.
    rewrite (sum_ext N (fun j => A j i * x i * x i) (fun j => A j i * (x i * x i)))
      by (intros; ring).
    rewrite (sum_ext N (fun j => A i j * x i * x i) (fun j => A i j * (x i * x i)))
      by (intros; ring).
    rewrite !sum_scal_r, bal by exact Hi. reflexivity. }
  rewrite (sum_ext N (fun i => \sum_(j < N) (A i j * (x i - x j) ^ 2))
             (fun i => \sum_(j < N) (A i j * x i * x i)
                       + \sum_(j < N) (A i j * x j * x j)
                       - 2 * \sum_(j < N) (A i j * x i * x j))).
  - rewrite sum_minus, sum_plus, sum_scal, E2, E1. field.
  - intros i _. rewrite <- sum_scal, <- sum_plus, <- sum_minus. apply sum_ext. intros; ring.
Qed.

Hypothesis dig : digraph N A.

Lemma form_nonneg x : 0 <= form N L x.
Proof.
  rewrite form_laplacian. apply Rmult_le_pos; [lra|].
  apply sum_nonneg. intros i Hi. apply sum_nonneg. intros j Hj.
  apply Rmult_le_pos; [apply dig; assumption|apply pow2_ge_0].
Qed.

Lemma max_lt_ge n F i : (i < n)%nat -> F i <= max_lt n F.
Proof.
  induction n as [|n IH]; intros Hi; [lia|]. simpl.
  destruct (Nat.eq_dec i n) as [->|Hn]; [apply Rmax_r|].
  eapply Rle_trans; [apply IH; lia|apply Rmax_l].
Qed.

Lemma max_lt_nonneg n F : 0 <= max_lt n F.
Proof. induction n as [|n IH]; simpl; [lra|]. eapply Rle_trans; [exact IH|apply Rmax_l]. Qed.

(** Cauchy-Schwarz with weights: (sum a_j y_j)^2 <= (sum a_j) (sum a_j y_j^2). *)
Lemma weighted_cauchy_schwarz n a y : (forall j, (j < n)%nat -> 0 <= a j) ->
  (\sum_(j < n) (a j * y j)) ^ 2 <= sum_lt n a * \sum_(j < n) (a j * y j ^ 2).
Proof.
  intros Ha. assert (H := cauchy_schwarz n (fun j => sqrt (a j)) (fun j => sqrt (a j) * y j)).
  unfold dot in H.
  rewrite (sum_ext n _ (fun j => a j * y j)) in H
    by (intros j Hj; rewrite <- Rmult_assoc, sqrt_sqrt; auto).
  rewrite (sum_ext n (fun j => sqrt (a j) * sqrt (a j)) a) in H
    by (intros j Hj; apply sqrt_sqrt; auto).
  rewrite (sum_ext n (fun j => sqrt (a j) * y j * (sqrt (a j) * y j)) (fun j => a j * y j ^ 2)) in H.
  - exact H.
  - intros j Hj.
    replace (sqrt (a j) * y j * (sqrt (a j) * y j)) with (sqrt (a j) * sqrt (a j) * y j ^ 2) by ring.
    rewrite sqrt_sqrt; auto.
Qed.

Lemma laplacian_norm x : dot N (mv N L x) (mv N L x) <= 2 * degree_max N A * form N L x.
Proof.
  rewrite form_laplacian.
  replace (2 * degree_max N A * (/ 2 * \sum_(i < N) \sum_(j < N) (A i j * (x i - x j) ^ 2)))
    with (\sum_(i < N) (degree_max N A * \sum_(j < N) (A i j * (x i - x j) ^ 2)))
    by (rewrite sum_scal; field).
  apply sum_le. intros i Hi. rewrite laplacian_entry by exact Hi.
  replace (\sum_(j < N) (A i j * (x i - x j)) * \sum_(j < N) (A i j * (x i - x j)))
    with ((\sum_(j < N) (A i j * (x i - x j))) ^ 2) by ring.
  eapply Rle_trans; [apply weighted_cauchy_schwarz; intros; apply dig; assumption|].
  apply Rmult_le_compat_r.
  - apply sum_nonneg. intros j Hj.
    apply Rmult_le_pos; [apply dig; assumption|apply pow2_ge_0].
  - apply (max_lt_ge N (degree N A) i Hi).
Qed.

Lemma perron_dot mu x : dot N (mv N (perron N A mu) x) (mv N (perron N A mu) x)
  = dot N x x - 2 * mu * form N L x + mu ^ 2 * dot N (mv N L x) (mv N L x).
Proof.
  rewrite (dot_ext N _ _ (fun i => x i - mu * mv N L x i) (fun i => x i - mu * mv N L x i))
    by (intros; apply perron_entry; assumption).
  unfold form. rewrite dot_minus_l, !dot_minus_r.
  rewrite !dot_scal_l, !dot_scal_r, (dot_comm N (mv N L x) x). ring.
Qed.

(** betahat^2 with any lower bound kappa of the form in place of lambda2. *)
Lemma perron_contracts mu kappa x : 0 <= mu -> mu * degree_max N A <= 1 ->
  kappa * dot N x x <= form N L x ->
  dot N (mv N (perron N A mu) x) (mv N (perron N A mu) x)
  <= (1 - 2 * mu * kappa * (1 - mu * degree_max N A)) * dot N x x.
Proof.
  intros Hm HD Hk. rewrite perron_dot. assert (H := laplacian_norm x).
  assert (mu ^ 2 * dot N (mv N L x) (mv N L x) <= mu ^ 2 * (2 * degree_max N A * form N L x))
    by (apply Rmult_le_compat_l; [apply pow2_ge_0|exact H]).
  assert (mu * (1 - mu * degree_max N A) * (kappa * dot N x x)
          <= mu * (1 - mu * degree_max N A) * form N L x)
    by (apply Rmult_le_compat_l; [nra|exact Hk]).
  nra.
Qed.
End Laplacian.

(** Along a path, (x_i - x_j)^2 is at most a multiple of the form. *)
Lemma path_bound N A i j : balanced N A -> digraph N A -> (i < N)%nat -> reaches N A i j ->
  exists K, 0 <= K /\ forall x, (x i - x j) ^ 2 <= K * form N (laplacian N A) x.
Proof.
  intros bal dig Hi. induction 1 as [|j k _ [K [K0 IH]] Hj Hk Hp].
  - exists 0. split; [lra|]. intros x. simpl. lra.
  - exists (2 * K + 4 / A k j). split.
    + assert (0 < / A k j) by (apply Rinv_0_lt_compat; exact Hp). unfold Rdiv. lra.
    + intros x. specialize (IH x).
      assert (E : A k j * (x k - x j) ^ 2 <= 2 * form N (laplacian N A) x).
      { rewrite form_laplacian by exact bal.
        assert (P : forall a b, (a < N)%nat -> (b < N)%nat -> 0 <= A a b * (x a - x b) ^ 2)
          by (intros; apply Rmult_le_pos; [apply dig; assumption|apply pow2_ge_0]).
        assert (T1 := sum_ge_term N (fun b => A k b * (x k - x b) ^ 2) j (fun b => P k b Hk) Hj).
        assert (T2 := sum_ge_term N (fun a => \sum_(b < N) (A a b * (x a - x b) ^ 2)) k
                  (fun a Ha => sum_nonneg N _ (fun b => P a b Ha)) Hk).
        cbv beta in T1, T2. lra. }
      assert (E2 : (x k - x j) ^ 2 <= 2 / A k j * form N (laplacian N A) x).
      { apply Rmult_le_reg_l with (A k j); [exact Hp|].
        replace (A k j * (2 / A k j * form N (laplacian N A) x))
          with (2 * form N (laplacian N A) x) by (field; lra).
        exact E. }
      assert (S0 := pow2_ge_0 ((x i - x j) + (x k - x j))).
      replace (4 / A k j) with (2 * (2 / A k j)) by (field; lra). nra.
Qed.

(** A bound for each of finitely many indices is a bound for all of them. *)
Lemma finite_bound (n : nat) (Q : nat -> R -> Prop) :
  (forall i K K', Q i K -> K <= K' -> Q i K') ->
  (forall i, (i < n)%nat -> exists K, 0 <= K /\ Q i K) ->
  exists K, 0 <= K /\ forall i, (i < n)%nat -> Q i K.
Proof.
  intros mono. induction n as [|n IH]; intros H.
  - exists 0. split; [lra|]. intros; lia.
  - destruct IH as [K [K0 HK]]; [auto|]. destruct (H n) as [K' [K0' HK']]; [lia|].
    exists (K + K'). split; [lra|]. intros i Hi.
    destruct (Nat.eq_dec i n) as [->|Hn]; [apply mono with K'|apply mono with K]; auto; try lra.
    apply HK. lia.
Qed.

(** Strong connectivity: the form is bounded below on 1perp. *)
Lemma form_lower_bound N A : assumption1 N A ->
  exists kappa, 0 < kappa /\ forall x, zero_sum N x ->
    kappa * dot N x x <= form N (laplacian N A) x.
Proof.
  intros [dig [con bal]].
  assert (F0 := form_nonneg N A bal dig).
  destruct (finite_bound N (fun i K => forall j, (j < N)%nat -> forall x,
              (x i - x j) ^ 2 <= K * form N (laplacian N A) x)) as [K [K0 HK]].
  - intros i K K' H Hle j Hj x. specialize (H j Hj x). specialize (F0 x). nra.
  - intros i Hi. apply finite_bound.
    + intros j K K' H Hle x. specialize (H x). specialize (F0 x). nra.
    + intros j Hj. destruct (path_bound N A i j bal dig Hi (con i j Hi Hj)) as [K [K0 H]].
      exists K. auto.
  - exists (/ (INR N * K + 1)). assert (PN := pos_INR N).
    assert (D0 : 0 < INR N * K + 1) by nra.
    split; [apply Rinv_0_lt_compat, D0|]. intros x Hx.
    apply Rmult_le_reg_l with (INR N * K + 1); [exact D0|].
    rewrite <- Rmult_assoc, Rinv_r, Rmult_1_l by lra.
    (* For zero sum, sum_j (x_i - x_j)^2 = N x_i^2 + |x|^2 for each i. *)
    destruct N as [|n]; [unfold dot; simpl; specialize (F0 x); nra|]. set (N := S n) in *.
    assert (E : \sum_(j < N) ((x 0%nat - x j) ^ 2) = INR N * x 0%nat ^ 2 + dot N x x).
    { rewrite (sum_ext N _ (fun j => x 0%nat ^ 2 + x j * x j - 2 * x 0%nat * x j))
        by (intros; ring).
      rewrite sum_minus, sum_plus, sum_const, sum_scal. unfold zero_sum in Hx.
      change (\sum_(i < N) x i) with (sum_lt N x). rewrite Hx. unfold dot. ring. }
    assert (B : \sum_(j < N) ((x 0%nat - x j) ^ 2) <= INR N * (K * form N (laplacian N A) x)).
    { rewrite <- sum_const. apply sum_le. intros j Hj. apply HK; [lia|exact Hj]. }
    specialize (F0 x). assert (0 <= x 0%nat ^ 2) by apply pow2_ge_0. nra.
Qed.
