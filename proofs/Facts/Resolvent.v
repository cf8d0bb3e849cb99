(** The resolvent r_n of the kernel: Kaluza's theorem for the log-convex sequence c. *)
From Coq Require Import Reals Arith Lia Lra.
From Coquelicot Require Import Coquelicot.
From Fomas Require Import Model.Vectors Model.Kernel Facts.Sums Facts.Kernel.
Open Scope R_scope.

Lemma resolvent_upto_stable alpha n i : (i <= n)%nat -> resolvent_upto alpha n i = rk alpha i.
Proof.
  induction n as [|n IH]; intros H.
  - replace i with 0%nat by lia. reflexivity.
  - destruct (Nat.eq_dec i (S n)) as [->|N]; [reflexivity|].
    simpl. destruct (Nat.leb_spec i n); [apply IH; assumption|lia].
Qed.

Lemma rk_0 alpha : rk alpha 0 = 1.
Proof. reflexivity. Qed.

Lemma rk_S alpha n :
  rk alpha (S n) = - \sum_(l < S n) (fk alpha (S l) * rk alpha (n - l)).
Proof.
  unfold rk at 1. unfold resolvent_upto; fold resolvent_upto.
  destruct (Nat.leb_spec (S n) n); [lia|]. f_equal. apply sum_ext.
  intros l Hl. rewrite resolvent_upto_stable by lia. reflexivity.
Qed.

(** Convolution with r inverts convolution with F = 1 + sum f(l) z^l. *)
Lemma resolvent_solves alpha (g : nat -> R) k :
  let w := fun k => \sum_(j < S k) (rk alpha (k - j) * g j) in
  w k + \sum_(l < k) (fk alpha (S l) * w (k - S l)%nat) = g k.
Proof.
  intros w. destruct k as [|k]; [unfold w; simpl; rewrite rk_0; ring|].
  set (F := fun l => match l with O => 1 | S m => fk alpha (S m) end).
  assert (E : w (S k) + \sum_(l < S k) (fk alpha (S l) * w (S k - S l)%nat)
            = \sum_(l < S (S k)) \sum_(j < S (S k - l)) (F l * rk alpha (S k - l - j) * g j)).
  { rewrite (sum_first (S k) (fun l => \sum_(j < S (S k - l)) (F l * rk alpha (S k - l - j) * g j))).
    f_equal.
    - unfold w. rewrite Nat.sub_0_r. apply sum_ext. intros j _. simpl F. ring.
    - apply sum_ext. intros l Hl. unfold w. rewrite <- sum_scal.
      apply sum_ext. intros j _. simpl F. ring. }
  rewrite E, sum_triangle. rewrite (sum_single _ (S k)); [|lia|].
  - rewrite Nat.sub_diag. simpl. rewrite Nat.sub_diag, rk_0. ring.
  - intros j Hj Hne. destruct (S k - j)%nat as [|d] eqn:D; [lia|].
    rewrite (sum_ext _ _ (fun l => F l * rk alpha (S d - l) * g j))
      by (intros l Hl; do 3 f_equal; lia).
    rewrite sum_scal_r.
    assert (Z : \sum_(l < S (S d)) (F l * rk alpha (S d - l)) = 0).
    { rewrite sum_first, Nat.sub_0_r.
      change (1 * rk alpha (S d) + \sum_(l < S d) (fk alpha (S l) * rk alpha (d - l)) = 0).
      rewrite rk_S. ring. }
    rewrite Z. ring.
Qed.

(** A recursion of this kind has one solution. *)
Lemma resolvent_unique alpha (g w : nat -> R) :
  (forall k, w k + \sum_(l < k) (fk alpha (S l) * w (k - S l)%nat) = g k) ->
  forall k, w k = \sum_(j < S k) (rk alpha (k - j) * g j).
Proof.
  intros H. set (v := fun k => \sum_(j < S k) (rk alpha (k - j) * g j)).
  assert (Hv : forall k, v k + \sum_(l < k) (fk alpha (S l) * v (k - S l)%nat) = g k)
    by (intros k; apply (resolvent_solves alpha g k)).
  intros k. change (w k = v k). induction k as [k IH] using lt_wf_ind.
  assert (E : \sum_(l < k) (fk alpha (S l) * w (k - S l)%nat)
            = \sum_(l < k) (fk alpha (S l) * v (k - S l)%nat))
    by (apply sum_ext; intros l Hl; rewrite IH by lia; reflexivity).
  specialize (H k). specialize (Hv k). lra.
Qed.

Section Kaluza.
Variable alpha : R.
Hypothesis Halpha : 0 < alpha < 1.
Let c := ck alpha.
Let r := rk alpha.

(** C * (1/F) = 1/(1 - z). *)
Lemma ck_rk_sum n : \sum_(j < S n) (c (n - j) * r j) = 1.
Proof.
  induction n as [|n IH]; unfold c, r in *.
  - simpl. rewrite ck_0, rk_0. ring.
  - rewrite <- IH.
    assert (E : \sum_(j < S n) (ck alpha (S n - j) * rk alpha j)
                - \sum_(j < S n) (ck alpha (n - j) * rk alpha j)
                = \sum_(l < S n) (fk alpha (S l) * rk alpha (n - l))).
    { rewrite <- sum_minus.
      rewrite <- (sum_rev n (fun l => fk alpha (S l) * rk alpha (n - l))).
      apply sum_ext. intros j Hj. rewrite fk_ck.
      replace (S n - j)%nat with (S (n - j)) by lia.
      replace (n - (n - j))%nat with j by lia. ring. }
    change (\sum_(j < S (S n)) (ck alpha (S n - j) * rk alpha j)) with
      (\sum_(j < S n) (ck alpha (S n - j) * rk alpha j)
       + ck alpha (S n - S n) * rk alpha (S n)).
    rewrite Nat.sub_diag, ck_0, rk_S. lra.
Qed.

(** b_n = r_{n-1} - r_n, the coefficients of 1 - 1/C. *)
Let b n := r n - r (S n).

Lemma ck_b_sum n : c (S n) = \sum_(i < S n) (b i * c (n - i)).
Proof.
  assert (H := ck_rk_sum (S n)). assert (H0 := ck_rk_sum n).
  rewrite sum_first, Nat.sub_0_r in H. unfold b.
  rewrite (sum_ext (S n) (fun i => (r i - r (S i)) * c (n - i))
             (fun i => c (n - i)%nat * r i - c (S n - S i)%nat * r (S i)))
    by (intros i _; simpl; ring).
  rewrite sum_minus. unfold r, c in *. rewrite rk_0 in H. lra.
Qed.

Lemma b_pos n : 0 < b n.
Proof.
  induction n as [n IH] using lt_wf_ind. destruct n as [|n].
  - assert (H := ck_b_sum 0). simpl in H. unfold c in H. rewrite ck_0 in H by assumption.
    assert (H1 := ck_pos alpha Halpha 1). lra.
  - assert (H := ck_b_sum (S n)). assert (H0 := ck_b_sum n).
    change (c (S (S n)) = \sum_(i < S n) (b i * c (S n - i)) + b (S n) * c (S n - S n)) in H.
    rewrite Nat.sub_diag in H. unfold c at 3 in H. rewrite ck_0, Rmult_1_r in H by assumption.
    assert (L : c (S n) * \sum_(i < S n) (b i * c (S n - i))
                <= c (S (S n)) * \sum_(i < S n) (b i * c (n - i))
                   - b 0%nat * (c n * c (S (S n)) - c (S n) * c (S n))).
    { rewrite (sum_first n), (sum_first n (fun i => b i * c (n - i)%nat)), !Nat.sub_0_r.
      assert (\sum_(i < n) (c (S n) * (b (S i) * c (S n - S i)))
              <= \sum_(i < n) (c (S (S n)) * (b (S i) * c (n - S i)))).
      { apply sum_le. intros i Hi.
        assert (R := ck_ratio_le alpha Halpha (n - S i) (S n) ltac:(lia)).
        fold c in R. replace (S (n - S i)) with (S n - S i)%nat in R by lia.
        assert (B := IH (S i) ltac:(lia)). nra. }
      rewrite !sum_scal in H1. lra. }
    rewrite <- H0 in L.
    assert (LC := ck_log_convex alpha Halpha n). fold c in LC.
    assert (B0 := IH 0%nat ltac:(lia)). assert (P := ck_pos alpha Halpha (S n)). fold c in P.
    assert (0 < c (S n) * b (S n)) by nra. nra.
Qed.

Lemma rk_decreasing n : r (S n) < r n.
Proof. assert (H := b_pos n). unfold b in H. lra. Qed.

Lemma rk_antitone n m : (n <= m)%nat -> r m <= r n.
Proof. induction 1 as [|m _ IH]; [lra|]. assert (H := rk_decreasing m). lra. Qed.

Lemma b_sum n : \sum_(i < n) b i = 1 - r n.
Proof. induction n as [|n IH]; simpl; [unfold r; rewrite rk_0|rewrite IH; unfold b]; ring. Qed.

Lemma rk_pos n : 0 < r n.
Proof.
  destruct n as [|n]; [unfold r; rewrite rk_0; lra|].
  assert (H := ck_b_sum n). assert (P := ck_pos alpha Halpha (S n)). fold c in P.
  assert (c (S n) * \sum_(i < S n) b i < \sum_(i < S n) (b i * c (n - i))).
  { rewrite (sum_first n (fun i => b i * c (n - i)%nat)), (sum_first n (fun i => b i)), Nat.sub_0_r.
    rewrite Rmult_plus_distr_l, <- sum_scal.
    assert (\sum_(i < n) (c (S n) * b (S i)) <= \sum_(i < n) (b (S i) * c (n - S i))).
    { apply sum_le. intros i Hi. assert (B := b_pos (S i)).
      assert (C := ck_le alpha Halpha (n - S i) (S n) ltac:(lia)). fold c in C. nra. }
    assert (B := b_pos 0). assert (C := ck_lt alpha Halpha n). fold c in C. nra. }
  rewrite <- H, b_sum in H0. nra.
Qed.

Lemma rk_le_1 n : r n <= 1.
Proof. rewrite <- (rk_0 alpha). apply rk_antitone. lia. Qed.

Lemma rk_bound n : r n <= Rpower (INR n + 1) (- alpha).
Proof.
  assert (P := pos_INR n).
  assert (H : r n * rpow (INR (S n)) alpha <= 1).
  { rewrite <- ck_sum, <- (ck_rk_sum n).
    rewrite <- (sum_rev n (fun i => ck alpha i)), <- sum_scal. apply sum_le. intros j Hj.
    assert (A := rk_antitone j n ltac:(lia)).
    assert (C := ck_pos alpha Halpha (n - j)). unfold c. nra. }
  rewrite S_INR, rpow_pos in H by lra.
  rewrite Rpower_Ropp. assert (Q : 0 < Rpower (INR n + 1) alpha) by apply exp_pos.
  apply Rmult_le_reg_r with (Rpower (INR n + 1) alpha); [exact Q|].
  rewrite Rinv_l by lra. exact H.
Qed.

Lemma rk_lim : is_lim_seq r 0.
Proof.
  apply is_lim_seq_le_le with (fun _ => 0) (fun n => Rpower (INR n + 1) (- alpha)).
  - intros n. split; [left; apply rk_pos|apply rk_bound].
  - apply is_lim_seq_const.
  - apply Rpower_neg_lim. lra.
Qed.
End Kaluza.
