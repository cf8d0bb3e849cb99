(** Parseval's identity for a finite sequence of reals at the roots of unity. *)
From Coq Require Import Reals Arith Lia Lra.
From Fomas Require Import Model.Vectors Facts.Sums.
Open Scope R_scope.

(** The angles 2 pi j / m. *)
Definition angle (m j : nat) : R := INR j * (2 * PI / INR m).

Lemma cos_turns k : cos (2 * PI * INR k) = 1.
Proof.
  induction k as [|k IH]; [rewrite Rmult_0_r; apply cos_0|].
  rewrite S_INR. replace (2 * PI * (INR k + 1)) with (2 * PI * INR k + 2 * PI) by ring.
  rewrite cos_plus, cos_2PI, sin_2PI, IH. ring.
Qed.

Lemma sin_turns k : sin (2 * PI * INR k) = 0.
Proof.
  induction k as [|k IH]; [rewrite Rmult_0_r; apply sin_0|].
  rewrite S_INR. replace (2 * PI * (INR k + 1)) with (2 * PI * INR k + 2 * PI) by ring.
  rewrite sin_plus, cos_2PI, sin_2PI, IH. ring.
Qed.

Lemma turn_angle m j : (0 < m)%nat -> INR m * angle m j = 2 * PI * INR j.
Proof. intros Hm. unfold angle. field. apply not_0_INR. lia. Qed.

(** cos (l theta) sums to 0 over the angles, 0 < l < m: times sin (a/2) the sum telescopes. *)
Lemma cos_sum m l : (0 < l < m)%nat -> \sum_(j < m) cos (INR l * angle m j) = 0.
Proof.
  intros Hl. set (a := INR l * (2 * PI / INR m)).
  assert (M : 0 < INR m) by (apply lt_0_INR; lia).
  assert (half : 0 < sin (a / 2)).
  { apply sin_gt_0; unfold a.
    - assert (P := PI_RGT_0). assert (L : 0 < INR l) by (apply lt_0_INR; lia).
      replace (INR l * (2 * PI / INR m) / 2) with (INR l * PI * / INR m) by (field; lra).
      apply Rmult_lt_0_compat; [nra|apply Rinv_0_lt_compat, M].
    - assert (P := PI_RGT_0). assert (L : INR l < INR m) by (apply lt_INR; lia).
      apply Rmult_lt_reg_r with (INR m); [exact M|].
      replace (INR l * (2 * PI / INR m) / 2 * INR m) with (INR l * PI) by (field; lra). nra. }
  assert (T : forall n, 2 * sin (a / 2) * \sum_(j < n) cos (INR j * a)
              = sin (INR n * a - a / 2) + sin (a / 2)).
  { induction n as [|n IH].
    - simpl. replace (0 * a - a / 2) with (- (a / 2)) by lra. rewrite sin_neg. ring.
    - rewrite sum_last, Rmult_plus_distr_l, IH, S_INR.
      replace ((INR n + 1) * a - a / 2) with (INR n * a + a / 2) by lra.
      rewrite sin_minus, sin_plus. ring. }
  apply Rmult_eq_reg_l with (2 * sin (a / 2)); [|lra]. rewrite Rmult_0_r.
  rewrite (sum_ext m _ (fun j => cos (INR j * a)))
    by (intros; unfold angle, a; f_equal; field; lra).
  rewrite T. replace (INR m * a - a / 2) with (- (a / 2) + 2 * PI * INR l) by (unfold a; field; lra).
  rewrite sin_plus, cos_turns, sin_turns, sin_neg. ring.
Qed.

Lemma cos_difference m k l : (k < m)%nat -> (l < m)%nat ->
  \sum_(j < m) (cos (INR k * angle m j) * cos (INR l * angle m j)
                + sin (INR k * angle m j) * sin (INR l * angle m j))
  = if Nat.eqb k l then INR m else 0.
Proof.
  assert (W : forall k l, (k < l < m)%nat ->
    \sum_(j < m) (cos (INR k * angle m j) * cos (INR l * angle m j)
                  + sin (INR k * angle m j) * sin (INR l * angle m j)) = 0).
  { intros p q H. rewrite <- (cos_sum m (q - p)) by lia. apply sum_ext. intros j _.
    rewrite minus_INR by lia. rewrite Rmult_minus_distr_r, cos_minus. ring. }
  intros Hk Hl. destruct (Nat.eqb_spec k l) as [->|Ne].
  - rewrite (sum_ext m _ (fun _ => 1)), sum_const; [ring|]. intros j _.
    assert (Q := sin2_cos2 (INR l * angle m j)). unfold Rsqr in Q. lra.
  - destruct (Nat.lt_ge_cases k l) as [H|H].
    + apply W. lia.
    + rewrite <- (W l k) by lia. apply sum_ext. intros j _. ring.
Qed.

Lemma parseval m (a : nat -> R) :
  \sum_(j < m) ((\sum_(k < m) (cos (INR k * angle m j) * a k)) ^ 2
                + (\sum_(k < m) (sin (INR k * angle m j) * a k)) ^ 2)
  = INR m * \sum_(k < m) (a k ^ 2).
Proof.
  assert (square : forall F : nat -> R, sum_lt m F ^ 2 = \sum_(k < m) \sum_(l < m) (F k * F l)).
  { intros F. rewrite (sum_ext m (fun k => \sum_(l < m) (F k * F l)) (fun k => F k * sum_lt m F))
      by (intros; apply sum_scal). rewrite sum_scal_r. ring. }
  rewrite (sum_ext m _ (fun j => \sum_(k < m) \sum_(l < m) (a k * a l *
      (cos (INR k * angle m j) * cos (INR l * angle m j)
       + sin (INR k * angle m j) * sin (INR l * angle m j))))).
  2: { intros j _. rewrite !square, <- sum_plus. apply sum_ext. intros k _. rewrite <- sum_plus.
       apply sum_ext. intros l _. ring. }
  rewrite sum_swap, <- sum_scal. apply sum_ext. intros k Hk. rewrite sum_swap.
  rewrite (sum_single m k); [|exact Hk|].
  - rewrite sum_scal, cos_difference, Nat.eqb_refl by exact Hk. ring.
  - intros l Hl Ne. rewrite sum_scal, cos_difference by assumption.
    destruct (Nat.eqb_spec k l); [lia|ring].
Qed.
