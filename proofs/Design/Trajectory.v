(** eqL3 for the initial state of the design: the samples of one vector, v = L x_0, and the decay
    of the powers of P. *)
From Coq Require Import Reals ZArith List Bool Lia Lra.
From Coquelicot Require Import Coquelicot.
From Fomas Require Import Model.Vectors Model.Kernel Model.Gamma Model.Graph Model.Loop Statements.
From Fomas Require Import Facts.Sums Facts.Vectors Facts.Kernel Facts.Resolvent Facts.Graph Facts.Loop Facts.Phi.
From Fomas Require Import Results.Telescoping Results.LogConvexity Results.ClosedLoop Results.NormBound.
From Fomas Require Import Design.Integers Design.Weights Design.Claims.
From Fomas Require Import Design.Directions Design.Samples Design.Tail.
Open Scope R_scope.

(** The peak lemma for one vector. *)
Lemma vector_peak N M alpha v K : 0 < alpha < 1 ->
  (forall k, (k <= K)%nat -> norm N (Phi alpha N M k v) <= norm N v) ->
  (forall n, (K < n)%nat -> norm N (iter n (mv N M) v) <= ck alpha n * norm N v) ->
  forall k, norm N (Phi alpha N M k v) <= norm N v.
Proof.
  intros Ha H0 H1 k. induction k as [k IH] using lt_wf_ind.
  destruct (le_lt_dec k K) as [L|L]; [apply H0, L|].
  rewrite (norm_ext N _ _ (fun i Hi => proj2 (phi_recursion N M alpha v k i Ha Hi))).
  eapply Rle_trans; [apply norm_triangle|]. assert (T1 := H1 k L).
  assert (T2 : norm N (fun i => \sum_(l < k) (Rabs (fk alpha (S l)) * Phi alpha N M (k - S l) v i))
               <= (1 - ck alpha k) * norm N v).
  { eapply Rle_trans; [apply norm_combination|]. rewrite <- (proj1 (telescoping alpha Ha)), <- sum_scal_r.
    apply sum_le. intros l Hl. rewrite Rabs_Rabsolu.
    apply Rmult_le_compat_l; [apply Rabs_pos|]. apply IH. lia. }
  lra.
Qed.

Lemma vector_tail N A mu alpha v K p : 0 < alpha < 1 -> (1 <= p)%nat -> balanced N A -> zero_sum N v ->
  let P := perron N A mu in
  (forall n, (K < n <= K + p)%nat -> norm N (iter n (mv N P) v) <= ck alpha n * norm N v) ->
  bounded_on_1perp N (iter p (mv N P)) (ck alpha (K + 1 + p) / ck alpha (K + 1)) ->
  forall n, (K < n)%nat -> norm N (iter n (mv N P) v) <= ck alpha n * norm N v.
Proof.
  intros Ha Hp bal Hv P H0 H1 n. induction n as [n IH] using lt_wf_ind. intros Hn.
  destruct (le_lt_dec n (K + p)) as [L|L]; [apply H0; lia|].
  replace n with (p + (n - p))%nat at 1 by lia. rewrite iter_plus.
  assert (B := H1 _ (zero_sum_iter N A bal mu (n - p) v Hv)). fold P in B.
  assert (I := IH (n - p)%nat ltac:(lia) ltac:(lia)).
  assert (C := proj1 (proj2 (log_convexity alpha Ha)) (K + 1)%nat (n - p)%nat p ltac:(lia)).
  replace (n - p + p)%nat with n in C by lia.
  assert (P1 := ck_pos alpha Ha (K + 1 + p)). assert (P2 := ck_pos alpha Ha (n - p)).
  assert (P3 := ck_pos alpha Ha (K + 1)). assert (N0 := norm_nonneg N v).
  assert (Q : ck alpha (K + 1 + p) / ck alpha (K + 1) * ck alpha (n - p) <= ck alpha n).
  { apply Rle_trans with (ck alpha n / ck alpha (n - p) * ck alpha (n - p)).
    - apply Rmult_le_compat_r; lra.
    - right. field. lra. }
  assert (R0 : 0 <= ck alpha (K + 1 + p) / ck alpha (K + 1)) by (apply Rle_mult_inv_pos; lra).
  eapply Rle_trans; [exact B|].
  apply Rle_trans with (ck alpha (K + 1 + p) / ck alpha (K + 1) * (ck alpha (n - p) * norm N v)).
  - apply Rmult_le_compat_l; assumption.
  - rewrite <- Rmult_assoc. apply Rmult_le_compat_r; assumption.
Qed.

Section Trajectory.
Variables (N : nat) (W : zmat) (d : Z).
Hypothesis Hd : (0 < d)%Z.
Let A := weighted W d.

(** |y| <= (t / scale) |v|. *)
Definition within_check (scale : Z) (v : list Z) (c : cell) (t : Z) : bool :=
  ((0 <=? t) && (zsum N (fun i => let x := Z.abs (nth i (fst c) 0) + snd c in x * x) <=? t * t * size N v))%Z%bool.

Lemma within_sound scale v c t y : (0 < scale)%Z -> holds N scale c y -> within_check scale v c t = true ->
  norm N y <= IZR t / IZR scale * norm N (vector v).
Proof.
  intros Hs H B. apply andb_prop in B. destruct B as [T B]. apply Z.leb_le, IZR_le in T, B.
  rewrite !mult_IZR, <- size_real, zsum_real in B. assert (S0 := IZR_lt _ _ Hs).
  apply norm_le_bound; [apply Rmult_le_pos; [apply Rle_mult_inv_pos; assumption|apply norm_nonneg]|].
  rewrite Rpow_mult_distr, norm_pow2. apply Rmult_le_reg_l with (IZR scale * IZR scale); [nra|].
  replace (IZR scale * IZR scale * ((IZR t / IZR scale) ^ 2 * dot N (vector v) (vector v)))
    with (IZR t * IZR t * dot N (vector v) (vector v)) by (field; lra).
  eapply Rle_trans; [|exact B]. unfold dot. rewrite <- sum_scal. apply sum_le. intros i Hi.
  specialize (H i Hi). cbv zeta. rewrite mult_IZR, plus_IZR, abs_IZR.
  set (c0 := IZR (nth i (fst c) 0%Z)) in *.
  assert (X : IZR scale * Rabs (y i) <= Rabs c0 + IZR (snd c)).
  { assert (Q := Rabs_triang_inv (IZR scale * y i) c0). rewrite Rabs_mult, (Rabs_right (IZR scale)) in Q by lra. lra. }
  assert (X0 : 0 <= IZR scale * Rabs (y i)) by (apply Rmult_le_pos; [lra|apply Rabs_pos]).
  replace (IZR scale * IZR scale * (y i * y i)) with ((IZR scale * Rabs (y i)) * (IZR scale * Rabs (y i)))
    by (assert (Q := Rsqr_abs (y i)); unfold Rsqr in Q; rewrite Q; ring).
  apply Rmult_le_compat; assumption.
Qed.

(** v is L x_0, times d and the denominator of x_0. *)
Definition disagreement_of (x0 v : list Z) : bool :=
  (sums_to_zero N v && below N (fun i => nth i v 0 =? moved N W x0 i)%Z)%bool.

(** u_k is Phi_k v but for a factor. *)
Lemma control_of alpha gamma h x0 v q x u : design alpha gamma h -> (0 < q)%Z ->
  disagreement_of x0 v = true -> closed_loop N A alpha gamma h (fun i => IZR (nth i x0 0%Z) / IZR q) x u ->
  exists f, 0 < f /\ forall k,
  norm N (u k) = f * norm N (Phi alpha N (perron N A (mu_of alpha gamma h)) k (vector v)).
Proof.
  intros D Hq E H. apply andb_prop in E. destruct E as [_ E]. set (P := perron N A (mu_of alpha gamma h)).
  assert (D0 := IZR_lt _ _ Hd). assert (Q0 := IZR_lt _ _ Hq). assert (G := proj1 (proj2 D)).
  set (f := gamma / (IZR d * IZR q)).
  assert (F : 0 < f) by (unfold f; apply Rdiv_lt_0_compat; [exact G|apply Rmult_lt_0_compat; assumption]).
  assert (U : forall i, (i < N)%nat -> u 0%nat i = - f * vector v i).
  { intros i Hi. rewrite (loop_u0 N A alpha gamma h _ D x u H i Hi).
    assert (B := below_true N _ E i Hi). apply Z.eqb_eq in B. unfold vector at 1. rewrite B.
    rewrite (moved_real N W d Hd x0 i Hi). fold A.
    rewrite (mv_ext N _ _ (fun j => / IZR q * vector x0 j)) by (intros; unfold vector, Rdiv; ring).
    rewrite mv_scal. unfold f. field. lra. }
  exists f. split; [exact F|]. intros k.
  rewrite (norm_ext N (u k) (fun i => - f * Phi alpha N P k (vector v) i)).
  - rewrite norm_scal, Rabs_Ropp, Rabs_right by lra. reflexivity.
  - intros i Hi. rewrite (loop_phi N A alpha gamma h _ D x u H k i Hi). fold P. unfold Phi.
    rewrite <- sum_scal. apply sum_ext. intros j _.
    rewrite (iter_mv_ext N P j (u 0%nat) (fun i => - f * vector v i) U i Hi), iter_scal by exact Hi. ring.
Qed.

Lemma trajectory_from_phi alpha gamma h x0 v q : design alpha gamma h -> (0 < q)%Z ->
  disagreement_of x0 v = true ->
  (forall k, norm N (Phi alpha N (perron N A (mu_of alpha gamma h)) k (vector v)) <= norm N (vector v)) ->
  trajectory_norm_bound N A alpha gamma h x0 q.
Proof.
  intros D Hq E H x u L k. destruct (control_of alpha gamma h x0 v q x u D Hq E L) as [f [F U]].
  rewrite !U. apply Rmult_le_compat_l; [lra|].
  rewrite (norm_ext N (Phi alpha N _ 0 (vector v)) (vector v)) by (intros; apply phi_0). apply H.
Qed.

Lemma trajectory_false alpha gamma h x0 v q k : design alpha gamma h -> (0 < q)%Z ->
  disagreement_of x0 v = true ->
  norm N (vector v) < norm N (Phi alpha N (perron N A (mu_of alpha gamma h)) k (vector v)) ->
  ~ trajectory_norm_bound N A alpha gamma h x0 q.
Proof.
  intros D Hq E H C.
  destruct (proj1 (closed_loop_exists N A alpha gamma h (fun i => IZR (nth i x0 0%Z) / IZR q) D)) as [x [u L]].
  destruct (control_of alpha gamma h x0 v q x u D Hq E L) as [f [F U]].
  assert (B := C x u L k). rewrite !U in B.
  rewrite (norm_ext N (Phi alpha N _ 0 (vector v)) (vector v)) in B by (intros; apply phi_0). nra.
Qed.

Variables (lo hi m scale : Z) (l r : list (Z * Z)) (v : list Z) (phis along : list cell).
Variables (powers : list (list cell)) (K p : nat) (last_bound : bound) (last : Z).

Definition trajectory_check : bool :=
  ((0 <? m)%Z && (0 <? scale)%Z && (0 <=? lo)%Z && (1 <=? p)%nat && (K + 1 + p <? length l)%nat
   && resolvent_check scale l r K && sums_to_zero N v
   && phi_check N W d lo hi m scale v r phis K && phi_check N W d lo hi m scale v nil along (K + p)
   && below N (fun j => phi_check N W d lo hi m scale (unit N j) nil (nth j powers nil) p)
   && below K (fun k => within_check scale v (cell_at phis (S k)) scale)
   && below p (fun i => within_check scale v (cell_at along (K + 1 + i)) (c_low scale l (K + 1 + i)))
   && bound_check N powers p last_bound last && (0 <=? last)%Z
   && (last * c_high scale l (K + 1) <=? scale * c_low scale l (K + 1 + p))%Z)%bool.

Lemma trajectory_sound alpha mu : balanced N A -> 0 < alpha < 1 ->
  IZR lo / IZR m <= mu <= IZR hi / IZR m -> powers_within scale alpha 1 l -> trajectory_check = true ->
  forall k, norm N (Phi alpha N (perron N A mu) k (vector v)) <= norm N (vector v).
Proof.
  intros bal Ha Hmu Hl H. unfold trajectory_check in H. repeat (apply andb_prop in H; destruct H as [H ?C]).
  apply Z.ltb_lt in H, C12. apply Z.leb_le in C11, C, C0. apply Nat.leb_le in C10. apply Nat.ltb_lt in C9.
  set (P := perron N A mu). assert (S0 := IZR_lt _ _ C12).
  assert (Hr := r_within scale alpha C12 l r K Hl C8). assert (Hv := sums_to_zero_sound N v C7).
  apply (vector_peak N P alpha (vector v) K Ha).
  - intros k Hk. destruct k as [|k].
    + rewrite (norm_ext N _ (vector v)) by (intros; apply phi_0). lra.
    + rewrite <- (Rmult_1_l (norm N (vector v))). replace 1 with (IZR scale / IZR scale) by (field; lra).
      apply (within_sound scale v (cell_at phis (S k)) scale _ C12).
      * apply (phi_sound N W d lo hi m scale mu Hd H C11 Hmu alpha v r phis K Ha Hr C6 (S k) Hk).
      * apply (below_true K _ C3 k). lia.
  - apply (vector_tail N A mu alpha (vector v) K p Ha C10 bal Hv).
    + intros n Hn. replace n with (K + 1 + (n - K - 1))%nat by lia. set (i := (n - K - 1)%nat).
      assert (I : (i < p)%nat) by (unfold i; lia).
      assert (X := c_within scale alpha C12 l (K + 1 + i) Hl ltac:(lia)).
      apply Rle_trans with (IZR (c_low scale l (K + 1 + i)) / IZR scale * norm N (vector v)).
      * apply (within_sound scale v (cell_at along (K + 1 + i)) _ _ C12).
        -- apply (power_sound N W d lo hi m scale mu Hd H C11 Hmu v along (K + p) C5). lia.
        -- apply (below_true p _ C2 i I).
      * apply Rmult_le_compat_r; [apply norm_nonneg|]. apply Rmult_le_reg_l with (IZR scale); [exact S0|].
        replace (IZR scale * (IZR (c_low scale l (K + 1 + i)) / IZR scale))
          with (IZR (c_low scale l (K + 1 + i))) by (field; lra). lra.
    + apply (ratio_sound scale alpha l (K + 1) (K + 1 + p) last N _ C12 Ha Hl ltac:(lia) ltac:(lia) C0 C).
      apply (bound_sound N scale powers p last_bound last _ C12 (iter_linear N P p)); [|exact C1].
      intros j Hj. apply (power_sound N W d lo hi m scale mu Hd H C11 Hmu (unit N j) (nth j powers nil) p);
        [|lia]. apply (below_true N _ C4 j Hj).
Qed.

End Trajectory.

(** Phi_K v exceeds v, and with it u_K exceeds u_0. *)
Lemma sample_exceeds N W d lo hi m scale alpha mu l r v cells K :
  (0 < d)%Z -> ((0 <? m) && (0 <? scale) && (0 <=? lo))%Z = true ->
  IZR lo / IZR m <= mu <= IZR hi / IZR m -> 0 < alpha < 1 -> powers_within scale alpha 1 l ->
  resolvent_check scale l r K = true -> phi_check N W d lo hi m scale v r cells K = true ->
  beyond_check N scale v (cell_at cells K) = true ->
  norm N (vector v) < norm N (Phi alpha N (perron N (weighted W d) mu) K (vector v)).
Proof.
  intros Hd H Hmu Ha Hl Hr Hc Hb. apply andb_prop in H. destruct H as [H L]. apply andb_prop in H.
  destruct H as [M S0]. apply Z.ltb_lt in M, S0. apply Z.leb_le in L.
  apply (beyond_sound N scale S0 v (cell_at cells K)); [|exact Hb].
  apply (phi_sound N W d lo hi m scale mu Hd M L Hmu alpha v r cells K Ha); auto.
  apply (r_within scale alpha S0 l r K Hl Hr).
Qed.
