(** A real matrix whose eigenvalues all have modulus below 1 has powers that vanish, without
    the fundamental theorem of algebra: Parseval's identity turns a bound of the inverse of
    I - z M on the unit disc (Inverse.v) into one of the powers. *)
From Coq Require Import Reals Arith Lia Lra.
From Coquelicot Require Import Coquelicot.
From Fomas Require Import Model.Vectors.
From Fomas Require Import Facts.Sums Facts.Vectors Facts.Lambda2 Facts.Fourier Facts.Inverse.
Open Scope R_scope.

Lemma above x : exists m, x < INR m.
Proof.
  destruct (nfloor_ex (Rmax x 0) (Rmax_r _ _)) as [m [_ Hm]]. exists (S m). rewrite S_INR.
  assert (H := Rmax_l x 0). lra.
Qed.

Section Spectrum.
Variables (n : nat) (M : mat).
Local Notation T := (mv n M).
Local Notation upper w := (fun i => w (n + i)%nat).

(** * The powers, scaled by r <= 1 *)

Definition scaled (r : R) (v : vec) (k : nat) : vec := fun i => r ^ k * iter k T v i.
Local Notation size x := (dot n x x).

Lemma scaled_0 r v i : scaled r v 0 i = v i.
Proof. unfold scaled. simpl. ring. Qed.

Lemma scaled_plus r v a b i : (i < n)%nat -> scaled r v (b + a) i = scaled r (scaled r v a) b i.
Proof.
  intros Hi. unfold scaled. rewrite iter_plus, iter_scal, pow_add by exact Hi. ring.
Qed.

Section Bound.
Variable e : R.
Hypothesis He : 0 < e.
Hypothesis bound : forall c s, c * c + s * s <= 1 -> inverse_bound n M c s e.

(** The sums of cos (k theta) x_k and sin (k theta) x_k, one above the other. *)
Definition transform (m : nat) (theta : R) (x : nat -> vec) : vec := fun i =>
  if Nat.ltb i n then \sum_(k < m) (cos (INR k * theta) * x k i)
  else \sum_(k < m) (sin (INR k * theta) * x k (i - n)%nat).

Lemma transform_real m theta x i : (i < n)%nat ->
  transform m theta x i = \sum_(k < m) (cos (INR k * theta) * x k i).
Proof. intros Hi. unfold transform. rewrite (proj2 (Nat.ltb_lt i n) Hi). reflexivity. Qed.

Lemma transform_imaginary m theta x i : (i < n)%nat ->
  transform m theta x (n + i)%nat = \sum_(k < m) (sin (INR k * theta) * x k i).
Proof.
  intros Hi. unfold transform. rewrite (proj2 (Nat.ltb_ge (n + i) n)) by lia.
  replace (n + i - n)%nat with i by lia. reflexivity.
Qed.

Lemma map_sum m (a : nat -> R) (x : nat -> vec) i :
  T (fun j => \sum_(k < m) (a k * x k j)) i = \sum_(k < m) (a k * T (x k) i).
Proof.
  rewrite mv_sum. apply sum_ext. intros k _. apply mv_scal.
Qed.

Lemma shifted m (g : nat -> R) : \sum_(k < m) g (S k) = sum_lt m g + g m - g 0%nat.
Proof. assert (E := sum_first m g). rewrite sum_last in E. lra. Qed.

Lemma energy_at r v m j : 0 <= r <= 1 -> (0 < m)%nat -> let x := scaled r v in
  e * dot (n + n) (transform m (angle m j) x) (transform m (angle m j) x)
  <= size (fun i => x 0%nat i - x m i).
Proof.
  intros Hr Hm x. set (th := angle m j). set (w := transform m th x).
  assert (cm : cos (INR m * th) = 1) by (unfold th; rewrite turn_angle by exact Hm; apply cos_turns).
  assert (sm : sin (INR m * th) = 0) by (unfold th; rewrite turn_angle by exact Hm; apply sin_turns).
  assert (CS := sin2_cos2 th). unfold Rsqr in CS.
  assert (H := bound (r * cos th) (r * sin th) ltac:(nra) w).
  assert (step : forall k i, r * T (x k) i = x (S k) i).
  { intros k i. unfold x, scaled. rewrite mv_scal. simpl. ring. }
  assert (Tw : forall i, (i < n)%nat -> T w i = \sum_(k < m) (cos (INR k * th) * T (x k) i)).
  { intros i Hi. rewrite <- map_sum. apply mv_ext. intros l Hl. apply transform_real, Hl. }
  assert (Tu : forall i, (i < n)%nat -> T (upper w) i = \sum_(k < m) (sin (INR k * th) * T (x k) i)).
  { intros i Hi. rewrite <- map_sum. apply mv_ext. intros l Hl. apply transform_imaginary, Hl. }
  assert (E1 : forall i, (i < n)%nat ->
            mv (n + n) (turned n M (r * cos th) (r * sin th)) w i = x 0%nat i - x m i).
  { intros i Hi. rewrite turned_real, Tw, Tu by exact Hi.
    replace (r * cos th * \sum_(k < m) (cos (INR k * th) * T (x k) i)
             - r * sin th * \sum_(k < m) (sin (INR k * th) * T (x k) i))
      with (\sum_(k < m) (cos (INR (S k) * th) * x (S k) i)).
    - rewrite (shifted m (fun k => cos (INR k * th) * x k i)).
      unfold w. rewrite transform_real by exact Hi. rewrite cm, Rmult_0_l, cos_0. ring.
    - rewrite <- !sum_scal, <- sum_minus. apply sum_ext. intros k _. rewrite <- step, S_INR.
      replace ((INR k + 1) * th) with (INR k * th + th) by ring. rewrite cos_plus. ring. }
  assert (E2 : forall i, (i < n)%nat ->
            mv (n + n) (turned n M (r * cos th) (r * sin th)) w (n + i)%nat = 0).
  { intros i Hi. rewrite turned_imaginary, Tw, Tu by exact Hi.
    replace (r * sin th * \sum_(k < m) (cos (INR k * th) * T (x k) i)
             + r * cos th * \sum_(k < m) (sin (INR k * th) * T (x k) i))
      with (\sum_(k < m) (sin (INR (S k) * th) * x (S k) i)).
    - rewrite (shifted m (fun k => sin (INR k * th) * x k i)).
      unfold w. rewrite transform_imaginary by exact Hi. rewrite sm. simpl INR. rewrite !Rmult_0_l, sin_0. ring.
    - rewrite <- !sum_scal, <- sum_plus. apply sum_ext. intros k _. rewrite <- step, S_INR.
      replace ((INR k + 1) * th) with (INR k * th + th) by ring. rewrite sin_plus. ring. }
  eapply Rle_trans; [exact H|]. right. rewrite dot_halves.
  rewrite (dot_ext n _ _ _ _ E1 E1), (dot_ext n _ _ (fun _ => 0) (fun _ => 0) E2 E2).
  unfold dot at 2. rewrite (sum_zero n) by (intros; ring). ring.
Qed.

Lemma energy r v m : 0 <= r <= 1 -> (0 < m)%nat -> let x := scaled r v in
  e * \sum_(k < m) size (x k) <= size (fun i => x 0%nat i - x m i).
Proof.
  intros Hr Hm x. assert (m0 : 0 < INR m) by (apply lt_0_INR; lia).
  apply Rmult_le_reg_l with (INR m); [exact m0|].
  replace (INR m * (e * \sum_(k < m) size (x k)))
    with (\sum_(j < m) (e * dot (n + n) (transform m (angle m j) x) (transform m (angle m j) x))).
  - rewrite <- sum_const. apply sum_le. intros j _. apply energy_at; assumption.
  - rewrite sum_scal. rewrite (sum_ext m _ (fun j => \sum_(i < n)
      ((\sum_(k < m) (cos (INR k * angle m j) * x k i)) ^ 2
       + (\sum_(k < m) (sin (INR k * angle m j) * x k i)) ^ 2))).
    + rewrite sum_swap, (sum_ext n _ (fun i => INR m * \sum_(k < m) (x k i ^ 2)))
        by (intros; apply parseval).
      rewrite sum_scal, sum_swap. rewrite (sum_ext m (fun k => \sum_(i < n) (x k i ^ 2)) (fun k => size (x k))).
      * ring.
      * intros k _. apply sum_ext. intros; ring.
    + intros j _. rewrite dot_halves. unfold dot. rewrite <- sum_plus. apply sum_ext. intros i Hi.
      rewrite transform_real, transform_imaginary by exact Hi. ring.
Qed.

(** Some power beyond any stretches nothing. *)
Definition tame (r : R) : Prop := forall m, exists m', (m <= m')%nat /\
  forall v, size (scaled r v m') <= size v.

Lemma tame_sum r v m : 0 <= r <= 1 -> tame r -> e * \sum_(k < m) size (scaled r v k) <= 4 * size v.
Proof.
  intros Hr Ht. destruct (Ht (S m)) as [m' [Hm H]].
  assert (E := energy r v m' Hr ltac:(lia)). specialize (H v). simpl in E.
  assert (D : size (fun i => scaled r v 0 i - scaled r v m' i) <= 2 * size v + 2 * size (scaled r v m')).
  { unfold dot. rewrite <- !sum_scal, <- sum_plus. apply sum_le. intros i _. rewrite scaled_0.
    assert (Q := pow2_ge_0 (v i + scaled r v m' i)). lra. }
  replace m' with (m + (m' - m))%nat in E at 1 by lia. rewrite sum_split in E.
  assert (0 <= \sum_(i < m' - m) size (scaled r v (m + i)))
    by (apply sum_nonneg; intros; apply dot_nonneg).
  nra.
Qed.

Lemma tame_power r v m : 0 <= r <= 1 -> tame r -> e ^ 2 * INR m * size (scaled r v m) <= 16 * size v.
Proof.
  intros Hr Ht. assert (each : forall k, (k < m)%nat -> e * size (scaled r v m) <= 4 * size (scaled r v k)).
  { intros k Hk. assert (E := tame_sum r (scaled r v k) (S (m - k)) Hr Ht).
    rewrite sum_last in E.
    assert (0 <= \sum_(i < m - k) size (scaled r (scaled r v k) i))
      by (apply sum_nonneg; intros; apply dot_nonneg).
    rewrite (dot_ext n (scaled r v m) _ (scaled r (scaled r v k) (m - k)) (scaled r (scaled r v k) (m - k))).
    - nra.
    - intros i Hi. rewrite <- scaled_plus by exact Hi. f_equal. lia.
    - intros i Hi. rewrite <- scaled_plus by exact Hi. f_equal. lia. }
  assert (A : INR m * (e * size (scaled r v m)) <= 4 * \sum_(k < m) size (scaled r v k)).
  { rewrite <- sum_const, <- sum_scal. apply sum_le. exact each. }
  assert (S := tame_sum r v m Hr Ht).
  replace (e ^ 2 * INR m * size (scaled r v m)) with (e * (INR m * (e * size (scaled r v m)))) by ring.
  apply Rle_trans with (e * (4 * \sum_(k < m) size (scaled r v k))); [|lra].
  apply Rmult_le_compat_l; lra.
Qed.

Lemma period_tame r m : (1 <= m)%nat -> (forall v, size (scaled r v m) <= size v) -> tame r.
Proof.
  intros Hm H k. exists (k * m)%nat. split; [nia|]. intros v. induction k as [|k IH].
  - simpl. right. apply dot_ext; intros; apply scaled_0.
  - eapply Rle_trans; [|exact IH]. eapply Rle_trans; [|apply (H (scaled r v (k * m)))]. right.
    apply dot_ext; intros i Hi; rewrite <- scaled_plus by exact Hi; f_equal; lia.
Qed.

Lemma size_scaled r v m : size (scaled r v m) = (r ^ m) ^ 2 * size (iter m T v).
Proof. unfold scaled. rewrite dot_scal_l, dot_scal_r. ring. Qed.

Lemma tame_one : tame 1.
Proof.
  destruct (mv_bounded n M) as [B [HB HT]].
  destruct (above (64 / e ^ 2)) as [m Hm].
  assert (E2 : 0 < e ^ 2) by nra.
  assert (M1 : 64 <= e ^ 2 * INR m).
  { apply Rmult_gt_compat_l with (r := e ^ 2) in Hm; [|exact E2].
    replace (e ^ 2 * (64 / e ^ 2)) with 64 in Hm by (field; lra). lra. }
  assert (m1 : (1 <= m)%nat) by (destruct m; [simpl in M1; lra|lia]).
  assert (quarter : forall r v, 0 <= r <= 1 -> tame r -> 4 * size (scaled r v m) <= size v).
  { intros r v Hr Ht. assert (P := tame_power r v m Hr Ht). assert (P0 := dot_nonneg n (scaled r v m)).
    assert (64 * size (scaled r v m) <= e ^ 2 * INR m * size (scaled r v m))
      by (apply Rmult_le_compat_r; assumption). lra. }
  set (q := Rpower 2 (/ INR m)).
  assert (I : 0 < / INR m) by (apply Rinv_0_lt_compat, lt_0_INR; lia).
  assert (q1 : 1 < q).
  { unfold q. rewrite <- (Rpower_O 2) by lra. apply Rpower_lt; lra. }
  assert (qm : q ^ m = 2).
  { unfold q. rewrite <- Rpower_pow by apply exp_pos. rewrite Rpower_mult, Rinv_l.
    - apply Rpower_1. lra.
    - apply not_0_INR. lia. }
  assert (all : forall j r, 0 <= r <= 1 -> r <= / (1 + B) * q ^ j -> tame r).
  { induction j as [|j IH]; intros r Hr Hj.
    - apply (period_tame r 1 (le_n 1)). intros v. rewrite size_scaled. simpl.
      assert (R1 : r * B <= 1).
      { apply Rle_trans with (/ (1 + B) * B).
        - apply Rmult_le_compat_r; [exact HB|]. simpl in Hj. lra.
        - apply Rmult_le_reg_l with (1 + B); [lra|].
          replace ((1 + B) * (/ (1 + B) * B)) with B by (field; lra). lra. }
      specialize (HT v). assert (N0 := norm_nonneg n (T v)). assert (N1 := norm_nonneg n v).
      assert (L : r * norm n (T v) <= norm n v).
      { apply Rle_trans with (r * (B * norm n v)); [apply Rmult_le_compat_l; lra|]. nra. }
      rewrite <- !norm_sq.
      replace (r * 1 * (r * 1 * 1) * (norm n (T v) * norm n (T v)))
        with ((r * norm n (T v)) * (r * norm n (T v))) by ring.
      apply Rmult_le_compat; try exact L; apply Rmult_le_pos; lra.
    - assert (F : r = q * (r / q)) by (field; lra).
      assert (Q : 0 <= r / q <= 1 /\ r / q <= / (1 + B) * q ^ j).
      { assert (D : 0 <= r / q) by (apply Rle_mult_inv_pos; lra). simpl in Hj.
        split; [split; [exact D|nra]|]. apply Rmult_le_reg_l with q; [lra|]. rewrite <- F. lra. }
      destruct Q as [Q1 Q2]. apply (period_tame r m m1). intros v.
      assert (K := quarter (r / q) v Q1 (IH (r / q) Q1 Q2)). rewrite size_scaled in K |- *.
      rewrite F, Rpow_mult_distr, qm. lra. }
  destruct (Pow_x_infinity q ltac:(rewrite Rabs_right; lra) (1 + B)) as [j Hj].
  specialize (Hj j (le_n j)). rewrite Rabs_right in Hj by (left; apply pow_lt; lra).
  apply (all j 1); [lra|]. apply Rmult_le_reg_l with (1 + B); [lra|].
  replace ((1 + B) * (/ (1 + B) * q ^ j)) with (q ^ j) by (field; lra). lra.
Qed.

Lemma bounded_vanish v i : (i < n)%nat -> is_lim_seq (fun k => iter k T v i) 0.
Proof.
  intros Hi. apply is_lim_seq_spec. intros eps. assert (P := cond_pos eps). set (d := pos eps) in *.
  assert (E2 : 0 < e ^ 2 * d ^ 2) by (apply Rmult_lt_0_compat; apply pow_lt; assumption).
  destruct (above (16 * size v / (e ^ 2 * d ^ 2))) as [m Hm]. exists m. intros k Hk.
  rewrite Rminus_0_r. apply Rnot_le_lt. intros C.
  assert (K := tame_power 1 v k ltac:(lra) tame_one). rewrite size_scaled, pow1 in K.
  assert (S := sum_ge_term n (fun j => iter k T v j * iter k T v j) i
                 ltac:(intros; apply Rle_0_sqr) Hi).
  fold (dot n (iter k T v) (iter k T v)) in S. simpl in S.
  assert (D : d ^ 2 <= iter k T v i * iter k T v i).
  { replace (iter k T v i * iter k T v i) with (Rabs (iter k T v i) ^ 2) by (rewrite pow2_abs; ring).
    apply pow_incr. split; [left; exact P|exact C]. }
  apply le_INR in Hk. assert (G : 16 * size v < e ^ 2 * INR k * d ^ 2).
  { apply Rmult_lt_compat_r with (r := e ^ 2 * d ^ 2) in Hm; [|exact E2].
    replace (16 * size v / (e ^ 2 * d ^ 2) * (e ^ 2 * d ^ 2)) with (16 * size v) in Hm
      by (field; split; nra). nra. }
  assert (0 <= e ^ 2 * INR k) by (apply Rmult_le_pos; [nra|apply pos_INR]).
  assert (e ^ 2 * INR k * d ^ 2 <= e ^ 2 * INR k * size (iter k T v))
    by (apply Rmult_le_compat_l; [assumption|lra]). lra.
Qed.
End Bound.

Theorem eigenvalues_inside_vanish :
  (forall a b x y, 0 < dot n x x + dot n y y ->
     (forall i, (i < n)%nat -> T x i = a * x i - b * y i) ->
     (forall i, (i < n)%nat -> T y i = b * x i + a * y i) -> a ^ 2 + b ^ 2 < 1) ->
  forall v i, (i < n)%nat -> is_lim_seq (fun k => iter k T v i) 0.
Proof.
  intros inside v i. destruct (below_disc n M inside) as [e [He bound]].
  apply (bounded_vanish e He bound).
Qed.
End Spectrum.
