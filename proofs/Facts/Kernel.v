(** Powers, the step response c_n and the kernel f(j). *)
From Coq Require Import Reals Arith Lia Lra.
From Coquelicot Require Import Coquelicot.
From Fomas Require Import Model.Vectors Model.Kernel Facts.Sums.
Open Scope R_scope.

Lemma rpow_pos x a : 0 < x -> rpow x a = Rpower x a.
Proof. intros H. unfold rpow. destruct (Rlt_dec 0 x); [reflexivity|lra]. Qed.

Lemma rpow_nonpos x a : x <= 0 -> rpow x a = 0.
Proof. intros H. unfold rpow. destruct (Rlt_dec 0 x); [lra|reflexivity]. Qed.

Lemma rpow_1 a : rpow 1 a = 1.
Proof. rewrite rpow_pos by lra. unfold Rpower. rewrite ln_1, Rmult_0_r. apply exp_0. Qed.

Lemma rpow_gt_0 x a : 0 < x -> 0 < rpow x a.
Proof. intros H. rewrite rpow_pos by exact H. apply exp_pos. Qed.

Lemma rpow_nonneg x a : 0 <= rpow x a.
Proof. unfold rpow. destruct (Rlt_dec 0 x); [left; apply exp_pos|lra]. Qed.

Lemma rpow_mult x y a : 0 < x -> 0 <= y -> rpow (x * y) a = rpow x a * rpow y a.
Proof.
  intros Hx Hy. destruct (Req_dec y 0) as [->|Z].
  - rewrite Rmult_0_r, (rpow_nonpos 0) by lra. ring.
  - rewrite !rpow_pos by nra. symmetry. apply Rpower_mult_distr; lra.
Qed.

Lemma rpow_lt x y a : 0 < a -> 0 <= x < y -> rpow x a < rpow y a.
Proof.
  intros Ha H. destruct (Req_dec x 0) as [->|Z].
  - rewrite rpow_nonpos by lra. apply rpow_gt_0. lra.
  - rewrite !rpow_pos by lra. unfold Rpower. apply exp_increasing.
    apply Rmult_lt_compat_l; [exact Ha|]. apply ln_increasing; lra.
Qed.

Lemma rpow_le x y a : 0 < a -> 0 <= x <= y -> rpow x a <= rpow y a.
Proof.
  intros Ha [H0 [H1| ->]]; [left; apply rpow_lt; lra|right; reflexivity].
Qed.

Lemma rpow_derive x a : 0 < x -> is_derive (fun y => rpow y a) x (a * Rpower x (a - 1)).
Proof.
  intros Hx. apply is_derive_ext_loc with (fun y => Rpower y a).
  - exists (mkposreal x Hx). intros y Hy.
    assert (0 < y).
    { unfold ball, AbsRing_ball, abs, minus, plus, opp in Hy; simpl in Hy.
      unfold ball in Hy; simpl in Hy. unfold AbsRing_ball in Hy. simpl in Hy.
      unfold abs, minus, plus, opp in Hy; simpl in Hy.
      apply Rabs_def2 in Hy. lra. }
    symmetry. apply rpow_pos. assumption.
  - apply is_derive_Reals. apply derivable_pt_lim_power. exact Hx.
Qed.

(** rpow is continuous, at 0 too. *)
Lemma rpow_continuous x a : 0 < a -> 0 <= x -> continuity_pt (fun y => rpow y a) x.
Proof.
  intros Ha [Hx| <-].
  - apply derivable_continuous_pt. exists (a * Rpower x (a - 1)).
    apply is_derive_Reals, rpow_derive, Hx.
  - intros eps He. exists (Rpower eps (/ a)). split; [apply exp_pos|].
    intros y [_ Hy]. simpl in *. unfold R_dist in *.
    rewrite (rpow_nonpos 0), Rminus_0_r by lra. rewrite Rminus_0_r in Hy.
    rewrite Rabs_right by (apply Rle_ge, rpow_nonneg).
    destruct (Rle_dec y 0) as [N0|P0]; [rewrite rpow_nonpos; assumption|].
    rewrite rpow_pos by lra. rewrite Rabs_right in Hy by lra.
    apply Rlt_le_trans with (Rpower (Rpower eps (/ a)) a).
    + unfold Rpower at 1 2. apply exp_increasing. apply Rmult_lt_compat_l; [exact Ha|].
      apply ln_increasing; lra.
    + rewrite Rpower_mult, Rinv_l, Rpower_1 by lra. lra.
Qed.

Lemma Rpower_le_base_neg x y a : a <= 0 -> 0 < x <= y -> Rpower y a <= Rpower x a.
Proof.
  intros Ha H. unfold Rpower. destruct (Rle_lt_dec y x) as [E|L].
  - replace y with x by lra. lra.
  - assert (ln x < ln y) by (apply ln_increasing; lra).
    destruct (Req_dec (a * ln y) (a * ln x)) as [->|NE]; [lra|].
    left. apply exp_increasing. nra.
Qed.

Lemma Rpower_lt_base_neg x y a : a < 0 -> 0 < x < y -> Rpower y a < Rpower x a.
Proof.
  intros Ha H. unfold Rpower. apply exp_increasing.
  assert (ln x < ln y) by (apply ln_increasing; lra). nra.
Qed.

(** x^a -> 0 as x -> oo for a < 0, along the integers. *)
Lemma Rpower_neg_lim a : a < 0 -> is_lim_seq (fun n => Rpower (INR n + 1) a) 0.
Proof.
  intros Ha. apply is_lim_seq_spec. intros eps.
  assert (He := cond_pos eps).
  destruct (nfloor_ex (Rpower eps (/ a))) as [n [_ Hn]]; [left; apply exp_pos|].
  exists n. intros k Hk. apply le_INR in Hk.
  rewrite Rminus_0_r, Rabs_right by (apply Rle_ge; left; apply exp_pos).
  apply Rlt_le_trans with (Rpower (Rpower eps (/ a)) a).
  - apply Rpower_lt_base_neg; [exact Ha|]. split; [apply exp_pos|lra].
  - rewrite Rpower_mult, Rinv_l, Rpower_1 by lra. lra.
Qed.

Section Step.
Variable alpha : R.
Hypothesis Halpha : 0 < alpha < 1.

Lemma ck_0 : ck alpha 0 = 1.
Proof.
  unfold ck. simpl. rewrite Rplus_0_l, rpow_1, rpow_nonpos by lra. ring.
Qed.

Lemma ck_1 : ck alpha 1 = Rpower 2 alpha - 1.
Proof. unfold ck. simpl. rewrite rpow_1, rpow_pos by lra. do 2 f_equal. Qed.

Lemma ck_2 : ck alpha 2 = Rpower 3 alpha - Rpower 2 alpha.
Proof.
  unfold ck. simpl. rewrite !rpow_pos by lra. f_equal. f_equal. ring.
Qed.

Lemma ck_pos n : 0 < ck alpha n.
Proof.
  unfold ck. assert (0 <= INR n) by apply pos_INR.
  assert (rpow (INR n) alpha < rpow (INR n + 1) alpha) by (apply rpow_lt; lra). lra.
Qed.

Lemma ck_sum n : \sum_(i < n) ck alpha i = rpow (INR n) alpha.
Proof.
  induction n as [|n IH]; [simpl; rewrite rpow_nonpos; lra|].
  rewrite S_INR. simpl. rewrite IH. unfold ck. ring.
Qed.

(** f(j) = c_j - c_{j-1}. *)
Lemma fk_ck j : fk alpha (S j) = ck alpha (S j) - ck alpha j.
Proof.
  unfold fk, ck. rewrite S_INR. replace (INR j + 1 - 1) with (INR j) by ring. ring.
Qed.

(** Cauchy's mean value theorem for (x+1)^alpha against x^alpha on [n, n+1]. *)
Lemma ck_ratio n : exists xi, INR n < xi < INR n + 1 /\
  ck alpha (S n) = ck alpha n * Rpower ((xi + 1) / xi) (alpha - 1).
Proof.
  set (F := fun x => rpow (x + 1) alpha). set (G := fun x => rpow x alpha).
  assert (H0 : 0 <= INR n) by apply pos_INR.
  assert (dF : forall x, 0 < x -> is_derive F x (alpha * Rpower (x + 1) (alpha - 1))).
  { intros x Hx. unfold F.
    evar_last. apply (is_derive_comp (fun y => rpow y alpha) (fun y => y + 1)).
    apply rpow_derive; lra. auto_derive; [exact I|reflexivity].
    unfold scal; simpl; unfold mult; simpl. ring. }
  assert (dG : forall x, 0 < x -> is_derive G x (alpha * Rpower x (alpha - 1)))
    by (intros; apply rpow_derive; assumption).
  assert (pF : forall x, INR n < x < INR n + 1 -> derivable_pt F x).
  { intros x Hx. exists (alpha * Rpower (x + 1) (alpha - 1)).
    apply is_derive_Reals, dF. lra. }
  assert (pG : forall x, INR n < x < INR n + 1 -> derivable_pt G x).
  { intros x Hx. exists (alpha * Rpower x (alpha - 1)). apply is_derive_Reals, dG. lra. }
  destruct (MVT F G (INR n) (INR n + 1) pF pG) as [xi [Hxi E]]; [lra| | |].
  - intros x Hx. unfold F. apply (continuity_pt_comp (fun y => y + 1) (fun y => rpow y alpha)).
    + apply continuity_pt_plus; [apply derivable_continuous_pt, derivable_pt_id|].
      apply continuity_pt_const. intros a b. reflexivity.
    + apply rpow_continuous; lra.
  - intros x Hx. apply rpow_continuous; lra.
  - exists xi. split; [exact Hxi|].
    rewrite !Derive_Reals in E.
    rewrite (is_derive_unique F xi _ (dF xi ltac:(lra))) in E.
    rewrite (is_derive_unique G xi _ (dG xi ltac:(lra))) in E.
    unfold F, G in E.
    assert (Hpow : Rpower ((xi + 1) / xi) (alpha - 1) * Rpower xi (alpha - 1)
                   = Rpower (xi + 1) (alpha - 1)).
    { rewrite Rpower_mult_distr; [f_equal; field; lra| |lra].
      apply Rdiv_lt_0_compat; lra. }
    rewrite <- Hpow in E. fold (ck alpha n) in E.
    unfold ck at 1. rewrite S_INR.
    assert (0 < Rpower xi (alpha - 1)) by apply exp_pos.
    apply Rmult_eq_reg_r with (alpha * Rpower xi (alpha - 1)); [|nra].
    unfold ck in E |- *. lra.
Qed.

Lemma ratio_lt x y : 0 < x < y ->
  Rpower ((x + 1) / x) (alpha - 1) < Rpower ((y + 1) / y) (alpha - 1).
Proof.
  intros H. apply Rpower_lt_base_neg; [lra|]. split.
  - apply Rdiv_lt_0_compat; lra.
  - replace ((y + 1) / y) with (1 + / y) by (field; lra).
    replace ((x + 1) / x) with (1 + / x) by (field; lra).
    apply Rplus_lt_compat_l, Rinv_lt_contravar; nra.
Qed.

(** c decreases strictly. *)
Lemma ck_lt n : ck alpha (S n) < ck alpha n.
Proof.
  destruct (ck_ratio n) as [xi [Hxi ->]]. assert (H := ck_pos n).
  assert (0 <= INR n) by apply pos_INR.
  assert (Rpower ((xi + 1) / xi) (alpha - 1) < 1).
  { assert (1 < (xi + 1) / xi).
    { apply Rmult_lt_reg_r with xi; [lra|].
      unfold Rdiv. rewrite Rmult_assoc, Rinv_l by lra. lra. }
    assert (E : Rpower ((xi + 1) / xi) 0 = 1) by (apply Rpower_O; lra).
    apply Rlt_le_trans with (Rpower ((xi + 1) / xi) 0); [apply Rpower_lt; lra|lra]. }
  nra.
Qed.

Lemma ck_le n m : (n <= m)%nat -> ck alpha m <= ck alpha n.
Proof.
  induction 1 as [|m _ IH]; [lra|]. assert (H := ck_lt m). lra.
Qed.

Lemma ck_le_1 n : ck alpha n <= 1.
Proof. rewrite <- ck_0. apply ck_le. lia. Qed.

Lemma ck_lt_1 n : (1 <= n)%nat -> ck alpha n < 1.
Proof.
  intros H. assert (H1 := ck_le 1 n H). assert (H2 := ck_lt 0). rewrite ck_0 in H2. lra.
Qed.

(** Log-convexity, strictly. *)
Lemma ck_log_convex n : ck alpha (S n) * ck alpha (S n) < ck alpha n * ck alpha (S (S n)).
Proof.
  destruct (ck_ratio n) as [x [Hx E1]]. destruct (ck_ratio (S n)) as [y [Hy E2]].
  rewrite S_INR in Hy. assert (Hn : 0 <= INR n) by apply pos_INR.
  assert (H := ratio_lt x y ltac:(lra)).
  assert (H0 := ck_pos n). assert (H1 := ck_pos (S n)).
  rewrite E2. rewrite E1 at 2.
  replace (ck alpha n * (ck alpha (S n) * Rpower ((y + 1) / y) (alpha - 1)))
    with (ck alpha (S n) * ck alpha n * Rpower ((y + 1) / y) (alpha - 1)) by ring.
  rewrite <- Rmult_assoc. apply Rmult_lt_compat_l; nra.
Qed.

(** The ratio c_{n+m}/c_n is nondecreasing in n, without division. *)
Lemma ck_ratio_le n k : (n <= k)%nat ->
  ck alpha (S n) * ck alpha k <= ck alpha n * ck alpha (S k).
Proof.
  induction 1 as [|k _ IH]; [lra|].
  assert (H := ck_log_convex k). assert (Hk := ck_pos k). assert (HS := ck_pos (S k)).
  assert (Hn := ck_pos n).
  apply Rmult_le_reg_r with (ck alpha k); [exact Hk|].
  apply Rle_trans with (ck alpha n * ck alpha (S k) * ck alpha (S k)); nra.
Qed.

Lemma ck_ratio_le_gen n k m : (n <= k)%nat ->
  ck alpha (n + m) * ck alpha k <= ck alpha n * ck alpha (k + m).
Proof.
  intros H. induction m as [|m IH]; [rewrite !Nat.add_0_r; lra|].
  rewrite !Nat.add_succ_r. assert (R := ck_ratio_le (n + m) (k + m) ltac:(lia)).
  assert (P1 := ck_pos (n + m)). assert (P2 := ck_pos (k + m)). assert (P3 := ck_pos k).
  assert (P4 := ck_pos (S (n + m))). assert (P5 := ck_pos (S (k + m))). assert (P6 := ck_pos n).
  apply Rmult_le_reg_r with (ck alpha (k + m)); [exact P2|].
  apply Rle_trans with (ck alpha k * (ck alpha (n + m) * ck alpha (S (k + m)))); [nra|].
  nra.
Qed.

Lemma ck_supermult m n : ck alpha m * ck alpha n <= ck alpha (m + n).
Proof.
  assert (H := ck_ratio_le_gen 0 n m ltac:(lia)). rewrite ck_0, Rmult_1_l in H.
  simpl in H. rewrite Nat.add_comm. exact H.
Qed.

Lemma ck_pow s n m : 0 <= s -> s <= ck alpha m -> s ^ n <= ck alpha (n * m).
Proof.
  intros Hs H. induction n as [|n IH]; [simpl; rewrite ck_0; lra|].
  simpl. eapply Rle_trans; [|apply ck_supermult].
  apply Rmult_le_compat; auto. apply pow_le, Hs.
Qed.

Lemma ck_bound n : ck alpha n <= Rpower (INR n + 1) (alpha - 1).
Proof.
  assert (P := pos_INR n).
  assert (H : INR (S n) * ck alpha n <= rpow (INR (S n)) alpha).
  { rewrite <- ck_sum, <- sum_const. apply sum_le. intros i Hi. apply ck_le. lia. }
  rewrite S_INR, rpow_pos in H by lra.
  apply Rmult_le_reg_l with (INR n + 1); [lra|].
  eapply Rle_trans; [exact H|]. right.
  rewrite <- (Rpower_1 (INR n + 1)) at 2 by lra. rewrite <- Rpower_plus. f_equal. ring.
Qed.

Lemma ck_lim : is_lim_seq (ck alpha) 0.
Proof.
  apply is_lim_seq_le_le with (fun _ => 0) (fun n => Rpower (INR n + 1) (alpha - 1)).
  - intros n. split; [left; apply ck_pos|apply ck_bound].
  - apply is_lim_seq_const.
  - apply Rpower_neg_lim. lra.
Qed.

Lemma fk_neg j : fk alpha (S j) < 0.
Proof. rewrite fk_ck. assert (H := ck_lt j). lra. Qed.

Lemma fk_abs j : Rabs (fk alpha (S j)) = ck alpha j - ck alpha (S j).
Proof. rewrite Rabs_left by apply fk_neg. rewrite fk_ck. ring. Qed.

Lemma fk_decreasing j : Rabs (fk alpha (S (S j))) < Rabs (fk alpha (S j)).
Proof.
  rewrite !fk_abs. assert (H := ck_log_convex j). assert (H0 := ck_pos j).
  assert (H1 := ck_pos (S j)). assert (H2 := ck_pos (S (S j))).
  assert (H3 := ck_lt j). assert (H4 := ck_lt (S j)). nra.
Qed.

Lemma fk_sum n : \sum_(l < n) Rabs (fk alpha (S l)) = 1 - ck alpha n.
Proof.
  induction n as [|n IH]; simpl; [rewrite ck_0; ring|]. rewrite IH, fk_abs. ring.
Qed.
End Step.
