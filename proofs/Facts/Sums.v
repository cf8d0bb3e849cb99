(** Finite sums. *)
From Coq Require Import Reals Arith Lia Lra.
From Fomas Require Import Model.Vectors.
Open Scope R_scope.

Lemma sum_ext n F G : (forall i, (i < n)%nat -> F i = G i) -> sum_lt n F = sum_lt n G.
Proof.
  induction n as [|n IH]; intros H; simpl; [reflexivity|].
  rewrite IH, H; auto.
Qed.

Lemma sum_plus n F G : \sum_(i < n) (F i + G i) = sum_lt n F + sum_lt n G.
Proof. induction n as [|n IH]; simpl; [|rewrite IH]; ring. Qed.

Lemma sum_minus n F G : \sum_(i < n) (F i - G i) = sum_lt n F - sum_lt n G.
Proof. induction n as [|n IH]; simpl; [|rewrite IH]; ring. Qed.

Lemma sum_opp n F : \sum_(i < n) (- F i) = - sum_lt n F.
Proof. induction n as [|n IH]; simpl; [|rewrite IH]; ring. Qed.

Lemma sum_scal n a F : \sum_(i < n) (a * F i) = a * sum_lt n F.
Proof. induction n as [|n IH]; simpl; [|rewrite IH]; ring. Qed.

Lemma sum_scal_r n a F : \sum_(i < n) (F i * a) = sum_lt n F * a.
Proof. induction n as [|n IH]; simpl; [|rewrite IH]; ring. Qed.

Lemma sum_const n a : \sum_(i < n) a = INR n * a.
Proof. induction n as [|n IH]; [simpl|rewrite S_INR; simpl; rewrite IH]; ring. Qed.

Lemma sum_zero n F : (forall i, (i < n)%nat -> F i = 0) -> sum_lt n F = 0.
Proof. intros H. rewrite (sum_ext n F (fun _ => 0) H), sum_const. ring. Qed.

Lemma sum_le n F G : (forall i, (i < n)%nat -> F i <= G i) -> sum_lt n F <= sum_lt n G.
Proof.
  induction n as [|n IH]; intros H; simpl; [lra|].
  apply Rplus_le_compat; auto.
Qed.

Lemma sum_nonneg n F : (forall i, (i < n)%nat -> 0 <= F i) -> 0 <= sum_lt n F.
Proof.
  intros H. rewrite <- (sum_zero n (fun _ => 0)) by auto. apply sum_le; auto.
Qed.

Lemma sum_ge_term n F i : (forall j, (j < n)%nat -> 0 <= F j) -> (i < n)%nat -> F i <= sum_lt n F.
Proof.
  induction n as [|n IH]; intros H Hi; [lia|]. simpl.
  destruct (Nat.eq_dec i n) as [->|Hn].
  - assert (0 <= sum_lt n F) by (apply sum_nonneg; auto). lra.
  - assert (F i <= sum_lt n F) by (apply IH; [auto|lia]).
    assert (0 <= F n) by auto. lra.
Qed.

Lemma sum_pos_term n F : 0 < sum_lt n F -> exists i, (i < n)%nat /\ 0 < F i.
Proof.
  induction n as [|n IH]; simpl; intros H; [lra|].
  destruct (Rlt_dec 0 (F n)) as [Hp|Hn].
  - exists n. split; [lia|exact Hp].
  - destruct IH as [i [Hi Hp]]; [lra|]. exists i. split; [lia|exact Hp].
Qed.

Lemma sum_zero_terms n F i : (forall j, (j < n)%nat -> 0 <= F j) -> sum_lt n F = 0 ->
  (i < n)%nat -> F i = 0.
Proof.
  intros H H0 Hi. apply Rle_antisym; [rewrite <- H0; apply sum_ge_term; auto|auto].
Qed.

Lemma sum_abs n F : Rabs (sum_lt n F) <= \sum_(i < n) Rabs (F i).
Proof.
  induction n as [|n IH]; simpl; [rewrite Rabs_R0; lra|].
  eapply Rle_trans; [apply Rabs_triang|lra].
Qed.

Lemma sum_swap n m (F : nat -> nat -> R) :
  \sum_(i < n) \sum_(j < m) F i j = \sum_(j < m) \sum_(i < n) F i j.
Proof.
  induction n as [|n IH]; simpl.
  - symmetry. apply sum_zero. auto.
  - rewrite IH, sum_plus. reflexivity.
Qed.

Lemma sum_last n F : sum_lt (S n) F = sum_lt n F + F n.
Proof. reflexivity. Qed.

Lemma sum_first n F : sum_lt (S n) F = F 0%nat + \sum_(i < n) F (S i).
Proof. induction n as [|n IH]; [simpl; ring|]. simpl in *. rewrite IH. ring. Qed.

Lemma sum_split n m F : sum_lt (n + m) F = sum_lt n F + \sum_(i < m) F (n + i)%nat.
Proof.
  induction m as [|m IH]; [rewrite Nat.add_0_r; simpl; ring|].
  rewrite Nat.add_succ_r. simpl. rewrite IH. ring.
Qed.

Lemma sum_rev n F : \sum_(i < S n) F (n - i)%nat = sum_lt (S n) F.
Proof.
  induction n as [|n IH]; [reflexivity|].
  rewrite sum_first, Nat.sub_0_r.
  rewrite (sum_ext _ (fun i => F (S n - S i)%nat) (fun i => F (n - i)%nat)) by auto.
  rewrite IH. simpl. ring.
Qed.

(** Summing a triangle by rows or by the other rows. *)
Lemma sum_triangle k (T : nat -> nat -> R) :
  \sum_(l < S k) \sum_(j < S (k - l)) T l j = \sum_(j < S k) \sum_(l < S (k - j)) T l j.
Proof.
  set (U := fun l j => if Nat.leb (l + j) k then T l j else 0).
  assert (cut : forall G l, (l <= k)%nat ->
      \sum_(j < S (k - l)) G j =
      \sum_(j < S k) (if Nat.leb (l + j) k then G j else 0)).
  { intros G l Hl. replace (S k) with (S (k - l) + l)%nat by lia. rewrite sum_split.
    rewrite (sum_zero l); [rewrite Rplus_0_r; apply sum_ext|]; intros i Hi; cbv beta.
    - destruct (Nat.leb_spec (l + i) k); [reflexivity|lia].
    - destruct (Nat.leb_spec (l + (S (k - l) + i)) k); [lia|reflexivity]. }
  transitivity (\sum_(l < S k) \sum_(j < S k) U l j).
  - apply sum_ext. intros l Hl. apply cut. lia.
  - rewrite sum_swap. apply sum_ext. intros j Hj. symmetry. rewrite cut by lia.
    apply sum_ext. intros l _. unfold U. rewrite (Nat.add_comm j l). reflexivity.
Qed.

(** A sum with one nonzero term. *)
Lemma sum_single n i F : (i < n)%nat -> (forall j, (j < n)%nat -> j <> i -> F j = 0) ->
  sum_lt n F = F i.
Proof.
  induction n as [|n IH]; intros Hi H; [lia|]. simpl.
  destruct (Nat.eq_dec i n) as [->|Hn].
  - rewrite sum_zero; [ring|]. intros j Hj. apply H; lia.
  - rewrite IH, (H n) by (auto; lia). ring.
Qed.

Lemma sum_geom n x : x <> 1 -> \sum_(i < n) (x ^ i) = (1 - x ^ n) / (1 - x).
Proof.
  intros Hx. induction n as [|n IH]; simpl; [|rewrite IH]; field; lra.
Qed.

Lemma sum_geom_le n x : 0 <= x < 1 -> \sum_(i < n) (x ^ i) <= / (1 - x).
Proof.
  intros Hx. rewrite sum_geom by lra.
  assert (0 <= x ^ n) by (apply pow_le; lra).
  assert (0 < / (1 - x)) by (apply Rinv_0_lt_compat; lra).
  unfold Rdiv. nra.
Qed.
