(** A real matrix M whose eigenvalues all have modulus below 1: I - z M has a bounded inverse,
    with one bound for all complex z with |z| <= 1.

    w in R^(2n) stands for the complex vector w_i + i w_(n+i), [turned c s] for I - (c + i s) M. *)
From Coq Require Import Reals Arith Lia Lra.
From Coquelicot Require Import Coquelicot.
From Fomas Require Import Model.Vectors Model.Coordinates.
From Fomas Require Import Facts.Sums Facts.Vectors Facts.Lambda2 Facts.Forms.
Open Scope R_scope.

Section Inverse.
Variables (n : nat) (M : mat).
Local Notation T := (mv n M).
Local Notation upper w := (fun i => w (n + i)%nat).

Definition turned (c s : R) : mat := fun i j =>
  if Nat.ltb i n then
    if Nat.ltb j n then id_mat i j - c * M i j else s * M i (j - n)%nat
  else
    if Nat.ltb j n then - s * M (i - n)%nat j
    else id_mat (i - n)%nat (j - n)%nat - c * M (i - n)%nat (j - n)%nat.

Lemma turned_real c s w i : (i < n)%nat ->
  mv (n + n) (turned c s) w i = w i - (c * T w i - s * T (upper w) i).
Proof.
  intros Hi. unfold mv at 1. rewrite sum_split.
  rewrite (sum_ext n _ (fun j => id_mat i j * w j - c * (M i j * w j))).
  2: { intros j Hj. unfold turned. rewrite (proj2 (Nat.ltb_lt i n) Hi), (proj2 (Nat.ltb_lt j n) Hj).
       ring. }
  rewrite (sum_ext n (fun j => turned c s i (n + j)%nat * _) (fun j => s * (M i j * w (n + j)%nat))).
  2: { intros j Hj. unfold turned. rewrite (proj2 (Nat.ltb_lt i n) Hi).
       rewrite (proj2 (Nat.ltb_ge (n + j) n)) by lia. replace (n + j - n)%nat with j by lia. ring. }
  rewrite sum_minus, !sum_scal, id_mat_sum by exact Hi. unfold mv. ring.
Qed.

Lemma turned_imaginary c s w i : (i < n)%nat ->
  mv (n + n) (turned c s) w (n + i)%nat = w (n + i)%nat - (s * T w i + c * T (upper w) i).
Proof.
  intros Hi. unfold mv at 1. rewrite sum_split.
  rewrite (sum_ext n _ (fun j => - s * (M i j * w j))).
  2: { intros j Hj. unfold turned. rewrite (proj2 (Nat.ltb_ge (n + i) n)) by lia.
       rewrite (proj2 (Nat.ltb_lt j n) Hj). replace (n + i - n)%nat with i by lia. ring. }
  rewrite (sum_ext n (fun j => turned c s (n + i)%nat (n + j)%nat * _)
             (fun j => id_mat i j * w (n + j)%nat - c * (M i j * w (n + j)%nat))).
  2: { intros j Hj. unfold turned. rewrite !(proj2 (Nat.ltb_ge _ n)) by lia.
       replace (n + i - n)%nat with i by lia. replace (n + j - n)%nat with j by lia. ring. }
  rewrite sum_minus, !sum_scal, (id_mat_sum n i (fun j => w (n + j)%nat)) by exact Hi.
  unfold mv. ring.
Qed.

Lemma dot_halves w v : dot (n + n) w v = dot n w v + dot n (upper w) (upper v).
Proof. unfold dot. apply sum_split. Qed.

(** Every eigenvalue a + b i has modulus below 1. *)
Hypothesis inside : forall a b x y, 0 < dot n x x + dot n y y ->
  (forall i, (i < n)%nat -> T x i = a * x i - b * y i) ->
  (forall i, (i < n)%nat -> T y i = b * x i + a * y i) -> a ^ 2 + b ^ 2 < 1.

Lemma no_kernel c s w : c * c + s * s <= 1 -> 0 < dot (n + n) w w ->
  0 < dot (n + n) (mv (n + n) (turned c s) w) (mv (n + n) (turned c s) w).
Proof.
  intros Hc Hw. destruct (Rle_lt_or_eq_dec _ _ (dot_nonneg (n + n) (mv (n + n) (turned c s) w)))
    as [L|E]; [exact L|]. exfalso. symmetry in E. assert (Z := dot_zero _ _ E).
  assert (X : forall i, (i < n)%nat -> w i = c * T w i - s * T (upper w) i).
  { intros i Hi. specialize (Z i ltac:(lia)). rewrite turned_real in Z by exact Hi. lra. }
  assert (Y : forall i, (i < n)%nat -> w (n + i)%nat = s * T w i + c * T (upper w) i).
  { intros i Hi. specialize (Z (n + i)%nat ltac:(lia)). rewrite turned_imaginary in Z by exact Hi. lra. }
  rewrite dot_halves in Hw. set (p := c * c + s * s) in *.
  destruct (Req_dec p 0) as [P|P].
  - assert (c = 0 /\ s = 0) as [-> ->] by (unfold p in P; split; nra).
    assert (dot n w w = 0) by (apply sum_zero; intros i Hi; rewrite (X i Hi); ring).
    assert (dot n (upper w) (upper w) = 0) by (apply sum_zero; intros i Hi; rewrite (Y i Hi); ring).
    lra.
  - assert (P0 : 0 < p) by (unfold p in *; nra).
    assert (I := inside (c / p) (- s / p) w (upper w) Hw).
    assert (I1 : (c / p) ^ 2 + (- s / p) ^ 2 < 1).
    { apply I; intros i Hi; simpl; rewrite (X i Hi), (Y i Hi); unfold p; field; fold p; lra. }
    replace ((c / p) ^ 2 + (- s / p) ^ 2) with (/ p) in I1 by (unfold p; field; fold p; lra).
    apply Rinv_lt_contravar in I1; [|rewrite Rmult_1_r; apply Rinv_0_lt_compat, P0].
    rewrite Rinv_1, Rinv_inv in I1. lra.
Qed.

Lemma dot_gram N Q w : form N (gram N Q) w = dot N (mv N Q w) (mv N Q w).
Proof.
  rewrite <- form_identity, <- form_congruence. apply form_mat_ext. intros i j Hi Hj.
  apply sum_ext. intros k Hk. f_equal. symmetry. apply (id_mat_sum N k (fun l => Q l j) Hk).
Qed.

(** A lower bound at each z of the disc. *)
Definition inverse_bound (c s e : R) : Prop := forall w,
  e * dot (n + n) w w <= dot (n + n) (mv (n + n) (turned c s) w) (mv (n + n) (turned c s) w).

Lemma below_somewhere c s : c * c + s * s <= 1 -> exists e, 0 < e <= 1 /\ inverse_bound c s e.
Proof.
  intros Hc. destruct (positive_form_bounded (n + n) (gram (n + n) (turned c s))) as [e [He H]].
  - intros i j. apply sum_ext. intros k _. ring.
  - intros w Hw. rewrite dot_gram. apply no_kernel; assumption.
  - exists (Rmin e 1). assert (R1 := Rmin_l e 1). assert (R2 := Rmin_r e 1).
    split; [split; [apply Rmin_glb_lt; lra|lra]|]. intros w. rewrite <- dot_gram.
    eapply Rle_trans; [|apply H]. apply Rmult_le_compat_r; [apply dot_nonneg|exact R1].
Qed.

(** Half the greatest bound at most 1. *)
Definition best (c s : R) : R := real (Lub_Rbar (fun e => e <= 1 /\ inverse_bound c s e)) / 2.

Lemma best_spec c s : c * c + s * s <= 1 -> 0 < best c s <= 1 /\ inverse_bound c s (best c s).
Proof.
  intros Hc. destruct (below_somewhere c s Hc) as [e [He H]]. unfold best.
  destruct (Lub_Rbar_correct (fun e => e <= 1 /\ inverse_bound c s e)) as [U L].
  assert (U1 := U e (conj (proj2 He) H)). assert (L1 := L (Finite 1) (fun x Hx => proj1 Hx)).
  set (l := Lub_Rbar _) in *. destruct l as [l| |]; simpl in *; try contradiction.
  split; [lra|]. destruct (Classical_Prop.classic (exists e', l / 2 <= e' /\ inverse_bound c s e'))
    as [[e' [E1 E2]]|N].
  - intros w. eapply Rle_trans; [|apply E2]. apply Rmult_le_compat_r; [apply dot_nonneg|exact E1].
  - exfalso. assert (B : Rbar_le l (l / 2)).
    { apply (L (Finite (l / 2))). intros x [_ Hx]. simpl. apply Rnot_lt_le. intros C. apply N.
      exists x. split; [lra|exact Hx]. }
    simpl in B. lra.
Qed.

Lemma moved_below B c s c' s' e d : 0 <= B -> (forall x, norm n (T x) <= B * norm n x) ->
  inverse_bound c s e -> Rabs (c' - c) <= d -> Rabs (s' - s) <= d -> 0 <= d ->
  inverse_bound c' s' (e / 2 - 2 * d ^ 2 * B ^ 2).
Proof.
  intros HB HT H Hc Hs Hd w. specialize (H w).
  set (a := mv (n + n) (turned c s) w) in *. set (b := mv (n + n) (turned c' s') w).
  set (p := fun i => b i - a i).
  assert (A : dot (n + n) a a <= 2 * dot (n + n) b b + 2 * dot (n + n) p p).
  { unfold dot. rewrite <- !sum_scal, <- sum_plus. apply sum_le. intros i _. unfold p.
    assert (Q := pow2_ge_0 (a i - 2 * b i)). lra. }
  assert (P : dot (n + n) p p <= 2 * d ^ 2 * B ^ 2 * dot (n + n) w w).
  { assert (E : dot (n + n) p p = ((c' - c) ^ 2 + (s' - s) ^ 2)
                * (dot n (T w) (T w) + dot n (T (upper w)) (T (upper w)))).
    { rewrite dot_halves.
      rewrite (dot_ext n p p (fun i => (s' - s) * T (upper w) i - (c' - c) * T w i)
                             (fun i => (s' - s) * T (upper w) i - (c' - c) * T w i)).
      2, 3: intros i Hi; unfold p, a, b; rewrite !turned_real by exact Hi; ring.
      rewrite (dot_ext n (upper p) (upper p)
                 (fun i => - (s' - s) * T w i - (c' - c) * T (upper w) i)
                 (fun i => - (s' - s) * T w i - (c' - c) * T (upper w) i)).
      2, 3: intros i Hi; unfold p, a, b; rewrite !turned_imaginary by exact Hi; ring.
      rewrite !dot_minus_l, !dot_minus_r, !dot_scal_l, !dot_scal_r.
      rewrite (dot_comm n (T w) (T (upper w))). ring. }
    assert (sq : forall x, Rabs x <= d -> x ^ 2 <= d ^ 2).
    { intros x Hx. rewrite <- (pow2_abs x). apply pow_incr. split; [apply Rabs_pos|exact Hx]. }
    assert (TB : forall x, dot n (T x) (T x) <= B ^ 2 * dot n x x).
    { intros x. rewrite <- !norm_sq. assert (Q := HT x). assert (Q0 := norm_nonneg n (T x)).
      assert (Q1 := norm_nonneg n x). replace (B ^ 2 * (norm n x * norm n x))
        with ((B * norm n x) * (B * norm n x)) by ring. apply Rmult_le_compat; assumption. }
    rewrite E, (dot_halves w w). assert (T1 := TB w). assert (T2 := TB (upper w)).
    assert (S1 := sq _ Hc). assert (S2 := sq _ Hs).
    replace (2 * d ^ 2 * B ^ 2 * (dot n w w + dot n (upper w) (upper w)))
      with (2 * d ^ 2 * (B ^ 2 * dot n w w + B ^ 2 * dot n (upper w) (upper w))) by ring.
    apply Rmult_le_compat; try lra.
    - assert (Q1 := pow2_ge_0 (c' - c)). assert (Q2 := pow2_ge_0 (s' - s)). lra.
    - assert (Q1 := dot_nonneg n (T w)). assert (Q2 := dot_nonneg n (T (upper w))). lra. }
  lra.
Qed.

Lemma below_disc : exists e, 0 < e /\ forall c s, c * c + s * s <= 1 -> inverse_bound c s e.
Proof.
  destruct (mv_bounded n M) as [B [HB HT]].
  set (k := 8 * (1 + B ^ 2)). assert (B2 := pow2_ge_0 B). assert (K : 8 <= k) by (unfold k; lra).
  assert (pos : forall c s, 0 < (if Rle_dec (c * c + s * s) 1 then best c s / k
                                 else (c * c + s * s - 1) / 8)).
  { intros c s. destruct (Rle_dec (c * c + s * s) 1) as [L|L]; [|lra].
    destruct (best_spec c s L) as [P _]. apply Rdiv_lt_0_compat; lra. }
  destruct (compactness_value_2d (-1) 1 (-1) 1 (fun c s => mkposreal _ (pos c s))) as [d Hd].
  exists d. split; [apply cond_pos|]. intros c s Hc w. apply Rnot_lt_le. intros C.
  apply (Hd c s); [split; nra|split; nra|]. intros [u [v [Hu [Hv [D1 [D2 D3]]]]]].
  simpl in D1, D2, D3. destruct (Rle_dec (u * u + v * v) 1) as [L|L].
  - destruct (best_spec u v L) as [P Q]. set (e := best u v) in *.
    assert (K1 : 0 < e / k) by (apply Rdiv_lt_0_compat; lra).
    assert (R := moved_below B u v c s e (e / k) HB HT Q ltac:(lra) ltac:(lra) ltac:(lra) w).
    assert (E : d <= e / 2 - 2 * (e / k) ^ 2 * B ^ 2).
    { assert (K2 : e / k <= e / 8).
      { unfold Rdiv. apply Rmult_le_compat_l; [lra|]. apply Rinv_le_contravar; lra. }
      assert (K3 : e / k * B ^ 2 <= e / 8).
      { replace (e / 8) with (e / k * (1 + B ^ 2)) by (unfold k; field; lra).
        apply Rmult_le_compat_l; lra. }
      assert (K4 : 2 * (e / k) ^ 2 * B ^ 2 <= 2 * (e / 8) * (e / 8)).
      { replace (2 * (e / k) ^ 2 * B ^ 2) with (2 * (e / k) * (e / k * B ^ 2)) by ring.
        apply Rmult_le_compat; lra || (apply Rmult_le_pos; lra). }
      assert (2 * (e / 8) * (e / 8) <= e / 4) by nra. lra. }
    assert (W := dot_nonneg (n + n) w).
    assert (d * dot (n + n) w w <= (e / 2 - 2 * (e / k) ^ 2 * B ^ 2) * dot (n + n) w w)
      by (apply Rmult_le_compat_r; assumption). lra.
  - apply Rabs_def2 in D1. apply Rabs_def2 in D2. assert (X : -1 <= c <= 1) by nra.
    assert (Y : -1 <= s <= 1) by nra. set (g := (u * u + v * v - 1) / 8) in *.
    assert (u * u - c * c <= 2 * g) by nra. assert (v * v - s * s <= 2 * g) by nra.
    unfold g in *. lra.
Qed.

End Inverse.
