(** What one integer vector shows: a bound of lambda2, a step that stretches, a control that grows. *)
From Coq Require Import Reals ZArith List Bool Lia Lra.
From Fomas Require Import Model.Vectors Model.Kernel Model.Graph Model.Loop Statements.
From Fomas Require Import Facts.Sums Facts.Vectors Facts.Kernel Facts.Resolvent Facts.Graph Facts.Phi.
From Fomas Require Import Results.ClosedLoop Results.Soundness Design.Integers Design.Weights.
Open Scope R_scope.

Section Certificate.
Variables (N : nat) (W : zmat) (d : Z).
Hypothesis Hd : (0 < d)%Z.
Let A := weighted W d.

Definition vector (e : list Z) : vec := fun i => IZR (nth i e 0%Z).
Definition size (e : list Z) : Z := zsum N (fun i => nth i e 0 * nth i e 0)%Z.
Definition moved (e : list Z) (i : nat) : Z :=
  zsum N (fun j => entry (laplacian_table N W) i j * nth j e 0)%Z.
Definition turn (e : list Z) : Z := zsum N (fun i => nth i e 0 * moved e i)%Z.
Definition speed (e : list Z) : Z := zsum N (fun i => moved e i * moved e i)%Z.
Definition sums_to_zero (e : list Z) : bool := (zsum N (fun i => nth i e 0) =? 0)%Z.

Lemma size_real e : dot N (vector e) (vector e) = IZR (size e).
Proof. unfold size. rewrite zsum_real. apply sum_ext. intros. rewrite mult_IZR. reflexivity. Qed.

Lemma moved_real e i : (i < N)%nat -> IZR (moved e i) = IZR d * mv N (laplacian N A) (vector e) i.
Proof.
  intros Hi. unfold moved. rewrite zsum_real.
  transitivity (mv N (real (laplacian_table N W)) (vector e) i);
    [|apply mv_laplacian_table; assumption].
  apply sum_ext. intros. apply mult_IZR.
Qed.

Lemma turn_real e : IZR d * form N (laplacian N A) (vector e) = IZR (turn e).
Proof.
  unfold turn. rewrite zsum_real. unfold form, dot. rewrite <- sum_scal. apply sum_ext. intros i Hi.
  rewrite mult_IZR, moved_real by exact Hi. unfold vector. ring.
Qed.

Lemma speed_real e : IZR d * IZR d *
  dot N (mv N (laplacian N A) (vector e)) (mv N (laplacian N A) (vector e)) = IZR (speed e).
Proof.
  unfold speed. rewrite zsum_real. unfold dot. rewrite <- sum_scal. apply sum_ext. intros i Hi.
  rewrite mult_IZR, moved_real by exact Hi. ring.
Qed.

Lemma sums_to_zero_sound e : sums_to_zero e = true -> zero_sum N (vector e).
Proof.
  intros H. apply Z.eqb_eq, (f_equal IZR) in H. rewrite zsum_real in H. exact H.
Qed.

(** |P e| > (sp/sq) |e| for every mu from lo/m to hi/m. *)
Definition stretch_check (e : list Z) (lo hi m sp sq : Z) : bool :=
  (sums_to_zero e && (0 <=? lo) && (0 <? m) && (0 <=? sp) && (0 <? sq) && (0 <=? turn e)
   && (sp * sp * (size e * (d * d) * (m * m))
       <? sq * sq * (size e * (d * d) * (m * m) - 2 * hi * m * d * turn e
                     + lo * lo * speed e)))%Z%bool.

Lemma stretch_sound e lo hi m sp sq mu : stretch_check e lo hi m sp sq = true ->
  IZR lo / IZR m <= mu <= IZR hi / IZR m ->
  zero_sum N (vector e) /\
  IZR sp / IZR sq * norm N (vector e) < norm N (mv N (perron N A mu) (vector e)).
Proof.
  intros H Hmu. unfold stretch_check in H. repeat (apply andb_prop in H; destruct H as [H ?H]).
  split; [apply sums_to_zero_sound, H|].
  apply Z.leb_le, IZR_le in H5, H3, H1. apply Z.ltb_lt, IZR_lt in H4, H2.
  apply Z.ltb_lt, IZR_lt in H0. assert (D := IZR_lt _ _ Hd).
  rewrite !mult_IZR, plus_IZR, minus_IZR, !mult_IZR in H0.
  assert (E : norm N (mv N (perron N A mu) (vector e)) ^ 2
    = IZR (size e) - 2 * mu * (IZR (turn e) / IZR d) + mu ^ 2 * (IZR (speed e) / (IZR d * IZR d))).
  { rewrite norm_pow2, perron_dot, size_real, <- turn_real, <- speed_real. field. lra. }
  assert (S0 : 0 <= IZR (speed e)).
  { rewrite <- speed_real. apply Rmult_le_pos; [nra|apply dot_nonneg]. }
  set (M := IZR m) in *. set (d' := IZR d) in *. set (a := IZR (size e)) in *.
  set (b := IZR (turn e)) in *. set (c := IZR (speed e)) in *.
  set (s := IZR sp / IZR sq).
  assert (s0 : 0 <= s) by (apply Rle_mult_inv_pos; assumption).
  assert (L : IZR lo <= mu * M).
  { replace (IZR lo) with (IZR lo / M * M) by (field; lra). apply Rmult_le_compat_r; lra. }
  assert (U : mu * M <= IZR hi).
  { replace (IZR hi) with (IZR hi / M * M) by (field; lra). apply Rmult_le_compat_r; lra. }
  assert (L2 : IZR lo * IZR lo <= mu * M * (mu * M)) by (apply Rmult_le_compat; lra).
  assert (Q1 : IZR lo * IZR lo * c <= mu * M * (mu * M) * c) by (apply Rmult_le_compat_r; lra).
  assert (Q2 : 2 * (mu * M) * M * d' * b <= 2 * IZR hi * M * d' * b).
  { repeat (apply Rmult_le_compat_r; [lra|]). lra. }
  assert (K : s ^ 2 * a < a - 2 * mu * (b / d') + mu ^ 2 * (c / (d' * d'))).
  { apply Rmult_lt_reg_l with (IZR sq * IZR sq * (d' * d' * (M * M))).
    { repeat apply Rmult_lt_0_compat; assumption. }
    replace (IZR sq * IZR sq * (d' * d' * (M * M)) * (s ^ 2 * a))
      with (IZR sp * IZR sp * (a * (d' * d') * (M * M))) by (unfold s; field; lra).
    replace (IZR sq * IZR sq * (d' * d' * (M * M))
             * (a - 2 * mu * (b / d') + mu ^ 2 * (c / (d' * d'))))
      with (IZR sq * IZR sq * (a * (d' * d') * (M * M) - 2 * (mu * M) * M * d' * b
                               + mu * M * (mu * M) * c)) by (field; lra).
    eapply Rlt_le_trans; [exact H0|]. apply Rmult_le_compat_l; [nra|]. lra. }
  rewrite <- E in K. apply Rnot_le_lt. intros C.
  assert (Z := norm_nonneg N (mv N (perron N A mu) (vector e))).
  assert (C2 := pow_incr _ _ 2 (conj Z C)). rewrite Rpow_mult_distr, (norm_pow2 N (vector e)), size_real in C2.
  fold a in C2. lra.
Qed.

(** |Phi_1 e| > |e|, Phi_1 = P + r_1 I, for every mu from lo/m to hi/m and every r_1 >= rp/rq. *)
Definition growth_check (e : list Z) (lo hi m rp rq : Z) : bool :=
  (sums_to_zero e && (0 <=? lo) && (0 <? m) && (0 <=? rp) && (0 <? rq) && (0 <=? turn e)
   && (hi * turn e <=? m * d * size e)
   && (0 <? lo * lo * speed e * (rq * rq) + (2 * rp * rq + rp * rp) * size e * (m * m) * (d * d)
            - 2 * hi * turn e * d * m * (rq * rq + rp * rq)))%Z%bool.

Lemma growth_sound e lo hi m rp rq alpha mu : growth_check e lo hi m rp rq = true ->
  0 < alpha < 1 -> IZR lo / IZR m <= mu <= IZR hi / IZR m -> IZR rp / IZR rq <= 2 - Rpower 2 alpha ->
  ~ bounded_on_1perp N (Phi alpha N (perron N A mu) 1) 1.
Proof.
  intros H Ha Hmu Hr B. unfold growth_check in H. repeat (apply andb_prop in H; destruct H as [H ?H]).
  specialize (B _ (sums_to_zero_sound e H)). rewrite Rmult_1_l in B.
  apply Z.leb_le, IZR_le in H6, H4, H2, H1. apply Z.ltb_lt, IZR_lt in H5, H3, H0.
  assert (D := IZR_lt _ _ Hd). rewrite !mult_IZR in H1.
  repeat rewrite ?minus_IZR, ?plus_IZR, ?mult_IZR in H0.
  assert (B2 := pow_incr _ _ 2 (conj (norm_nonneg _ _) B)). rewrite !norm_pow2 in B2. clear B.
  set (r := 2 - Rpower 2 alpha) in *. set (v := vector e) in *. set (P := perron N A mu) in *.
  rewrite (dot_ext N (Phi alpha N P 1 v) _ (fun i => mv N P v i + r * v i)
             (fun i => mv N P v i + r * v i)) in B2.
  2, 3: intros i Hi; rewrite (proj1 (phi_recursion N P alpha v 0%nat i Ha Hi)); unfold r;
    rewrite (mv_ext N P _ v) by (intros; apply phi_0);
    rewrite rk_S; simpl; rewrite rk_0, fk_ck, ck_0, ck_1; ring.
  assert (E : dot N (mv N P v) (mv N P v)
    = IZR (size e) - 2 * mu * (IZR (turn e) / IZR d) + mu ^ 2 * (IZR (speed e) / (IZR d * IZR d))).
  { unfold P. rewrite perron_dot. unfold v. rewrite size_real, <- turn_real, <- speed_real. field. lra. }
  assert (F : dot N v (mv N P v) = IZR (size e) - mu * (IZR (turn e) / IZR d)).
  { rewrite (dot_ext N v _ v (fun i => v i - mu * mv N (laplacian N A) v i))
      by (auto; intros; apply perron_entry; assumption).
    rewrite dot_minus_r, dot_scal_r. change (dot N v (mv N (laplacian N A) v)) with (form N (laplacian N A) v).
    unfold v. rewrite size_real, <- turn_real. field. lra. }
  rewrite dot_plus_l, !dot_plus_r, !dot_scal_l, !dot_scal_r, (dot_comm N (mv N P v) v), E, F in B2.
  unfold v in B2. rewrite size_real in B2. clear E F.
  assert (S0 : 0 <= IZR (speed e)).
  { rewrite <- speed_real. apply Rmult_le_pos; [nra|apply dot_nonneg]. }
  assert (A0 : 0 <= IZR (size e)) by (rewrite <- size_real; apply dot_nonneg).
  clearbody r. set (M := IZR m) in *. set (d' := IZR d) in *. set (a := IZR (size e)) in *.
  set (b := IZR (turn e)) in *. set (c := IZR (speed e)) in *.
  set (s := IZR rp / IZR rq) in *.
  assert (s0 : 0 <= s) by (apply Rle_mult_inv_pos; assumption).
  assert (L : IZR lo <= mu * M).
  { replace (IZR lo) with (IZR lo / M * M) by (field; lra). apply Rmult_le_compat_r; lra. }
  assert (U : mu * M <= IZR hi).
  { replace (IZR hi) with (IZR hi / M * M) by (field; lra). apply Rmult_le_compat_r; lra. }
  set (t := mu * M) in *.
  replace mu with (t / M) in B2 by (unfold t; field; lra). clearbody t.
  (* times M^2 d^2, the difference is at least its value at s, hi and lo *)
  assert (L2 : IZR lo * IZR lo * c <= t * t * c).
  { apply Rmult_le_compat_r; [exact S0|]. apply Rmult_le_compat; lra. }
  assert (U2 : t * b <= IZR hi * b) by (apply Rmult_le_compat_r; lra).
  assert (G : 0 <= M * d' * a - t * b) by lra.
  assert (MD : 0 < M * d') by (apply Rmult_lt_0_compat; assumption).
  assert (B3 : t * t * c + (2 * r + r * r) * a * (M * M) * (d' * d')
               - 2 * t * b * d' * M * (1 + r) <= 0).
  { apply Rmult_le_compat_r with (r := M * M * (d' * d')) in B2; [|nra].
    match type of B2 with ?X <= ?Y =>
      replace X with (Y + (t * t * c + (2 * r + r * r) * a * (M * M) * (d' * d')
        - 2 * t * b * d' * M * (1 + r))) in B2 by (field; split; lra) end. lra. }
  assert (K : t * t * c + (2 * s + s * s) * a * (M * M) * (d' * d')
               - 2 * t * b * d' * M * (1 + s) <= 0).
  { eapply Rle_trans; [|exact B3].
    assert (X1 : 0 <= (r - s) * (M * d') * (M * d' * a - t * b))
      by (apply Rmult_le_pos; [apply Rmult_le_pos; lra|exact G]).
    assert (X2 : 0 <= (r - s) * (r + s) * (a * (M * d' * (M * d')))).
    { repeat apply Rmult_le_pos; lra. }
    lra. }
  assert (U3 : 2 * t * b * d' * M * (1 + s) <= 2 * IZR hi * b * d' * M * (1 + s)).
  { assert (0 <= d' * M * (1 + s)) by (repeat apply Rmult_le_pos; lra).
    replace (2 * t * b * d' * M * (1 + s)) with (2 * (t * b) * (d' * M * (1 + s))) by ring.
    replace (2 * IZR hi * b * d' * M * (1 + s)) with (2 * (IZR hi * b) * (d' * M * (1 + s))) by ring.
    apply Rmult_le_compat_r; lra. }
  assert (Z : IZR lo * IZR lo * c + (2 * s + s * s) * a * (M * M) * (d' * d')
               - 2 * IZR hi * b * d' * M * (1 + s) <= 0) by lra.
  apply Rmult_le_compat_r with (r := IZR rq * IZR rq) in Z; [|nra].
  rewrite Rmult_0_l in Z. apply Rlt_not_le in H0. apply H0. clear H0.
  match type of Z with ?X <= _ => match goal with |- ?Y <= _ => replace Y with X; [exact Z|] end end.
  unfold s. field. lra.
Qed.

(** lambda2 <= p/q by the Rayleigh quotient of e. *)
Lemma lambda2_upper e p q lambda2 :
  (sums_to_zero e && (0 <? q) && (0 <? size e) && (q * turn e <=? p * d * size e))%Z%bool = true ->
  is_lambda2 N A lambda2 -> lambda2 <= IZR p / IZR q.
Proof.
  intros H Hl. repeat (apply andb_prop in H; destruct H as [H ?H]).
  apply Z.ltb_lt, IZR_lt in H2, H1. apply Z.leb_le, IZR_le in H0. rewrite !mult_IZR in H0.
  assert (D := IZR_lt _ _ Hd).
  apply (rayleigh N A lambda2 (vector e) _ Hl (sums_to_zero_sound e H)).
  - rewrite size_real. exact H1.
  - rewrite form_sym, size_real. rewrite <- turn_real in H0.
    apply Rmult_le_reg_l with (IZR q * IZR d); [nra|].
    replace (IZR q * IZR d * (IZR p / IZR q * IZR (size e))) with (IZR p * IZR d * IZR (size e))
      by (field; lra). lra.
Qed.
End Certificate.
