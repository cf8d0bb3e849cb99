(** eqL3 proved by samples: ||Phi_k|| <= 1 for k <= K, ||P^n|| <= c_n for K < n <= K + m, and
    ||P^m|| <= c_(K+1+m) / c_(K+1), each from the cells of the N unit vectors. *)
From Coq Require Import Reals ZArith List Bool Lia Lra.
From Fomas Require Import Model.Vectors Model.Kernel Model.Graph Model.Loop Statements.
From Fomas Require Import Facts.Sums Facts.Vectors Facts.Kernel Facts.Graph Facts.Contraction Facts.Phi.
From Fomas Require Import Results.NormBound Design.Integers Design.Weights Design.Claims.
From Fomas Require Import Design.Directions Design.Samples.
Open Scope R_scope.

Definition unit (N j : nat) : list Z := map (fun i => if Nat.eqb j i then 1 else 0)%Z (seq 0 N).
Definition linear (N : nat) (T : vec -> vec) : Prop := forall e i, (i < N)%nat ->
  T e i = \sum_(j < N) (e j * T (vector (unit N j)) i).

Lemma unit_vector N j i : (i < N)%nat -> vector (unit N j) i = id_mat j i.
Proof.
  intros Hi. unfold vector, unit. rewrite nth_seq by exact Hi. unfold id_mat.
  destruct (Nat.eqb j i); reflexivity.
Qed.

Lemma iter_linear N M k : linear N (iter k (mv N M)).
Proof.
  induction k as [|k IH]; intros e i Hi.
  - simpl. rewrite <- (id_mat_sum N i e Hi) at 1. apply sum_ext. intros j _.
    rewrite unit_vector by exact Hi. unfold id_mat. rewrite Nat.eqb_sym. ring.
  - simpl. rewrite (mv_ext N M _ (fun q => \sum_(j < N) (e j * iter k (mv N M) (vector (unit N j)) q)) i)
      by (intros q Hq; apply IH, Hq).
    rewrite mv_sum. apply sum_ext. intros j _. apply mv_scal.
Qed.

Lemma phi_linear N alpha M k : linear N (Phi alpha N M k).
Proof.
  intros e i Hi. unfold Phi.
  rewrite (sum_ext N _ (fun j => \sum_(q < S k) (e j * (rk alpha (k - q) * iter q (mv N M) (vector (unit N j)) i))))
    by (intros; symmetry; apply sum_scal).
  rewrite sum_swap. apply sum_ext. intros q _.
  rewrite (iter_linear N M q e i Hi), <- sum_scal. apply sum_ext. intros; ring.
Qed.

(** An error, a bound of the matrix, and the factor that shows it. *)
Record bound := { error : Z; most : Z; weight : Z; factor : zmat; times : Z; eps : Z }.
Definition no_bound : bound := {| error := 0; most := 0; weight := 0; factor := nil; times := 0; eps := 0 |}%Z.
Definition gathered (N : nat) (all : list (list cell)) (k : nat) : zmat :=
  table N (fun i j => nth i (fst (cell_at (nth j all nil) k)) 0%Z).
Definition bound_check (N : nat) (all : list (list cell)) (k : nat) (b : bound) (t : Z) : bool :=
  (below N (fun j => snd (cell_at (nth j all nil) k) <=? error b)%Z && (0 <=? most b)%Z && (0 <=? error b)%Z
   && nonnegative N (stein N (identity N) (gathered N all k) (most b * most b) 1 0 (weight b))
        (factor b) (times b) (eps b)
   && (most b + Z.of_nat N * Z.of_nat N * error b <=? t)%Z)%bool.

Lemma bound_sound N scale all k b t T : (0 < scale)%Z -> linear N T ->
  (forall j, (j < N)%nat -> holds N scale (cell_at (nth j all nil) k) (T (vector (unit N j)))) ->
  bound_check N all k b t = true -> bounded_on_1perp N T (IZR t / IZR scale).
Proof.
  intros Hs lin H C e He. unfold bound_check in C. repeat (apply andb_prop in C; destruct C as [C ?B]).
  apply IZR_lt in Hs. apply Z.leb_le, IZR_le in B2, B1, B. rewrite plus_IZR, !mult_IZR, <- INR_IZR_INZ in B.
  set (G := gathered N all k) in *. set (E := IZR (error b)) in *.
  assert (form0 := nonnegative_sound N _ _ _ _ B0 e). rewrite form_stein, !real_identity in form0 by exact He.
  rewrite mult_IZR in form0.
  set (D := fun i => IZR scale * T e i - mv N (real G) e i).
  assert (HD : forall i, (i < N)%nat -> Rabs (D i) <= INR N * E * norm N e).
  { intros i Hi. unfold D, mv. rewrite (lin e i Hi), <- sum_scal, <- sum_minus.
    eapply Rle_trans; [apply sum_abs|]. rewrite Rmult_assoc, <- sum_const. apply sum_le. intros j Hj.
    replace (IZR scale * (e j * T (vector (unit N j)) i) - real G i j * e j)
      with ((IZR scale * T (vector (unit N j)) i - real G i j) * e j) by ring.
    rewrite Rabs_mult. apply Rmult_le_compat; try apply Rabs_pos; [|apply entry_le_norm, Hj].
    assert (X := below_true N _ C j Hj). apply Z.leb_le, IZR_le in X. eapply Rle_trans; [|exact X].
    unfold real, G, gathered. rewrite entry_table by assumption. apply (H j Hj i Hi). }
  assert (ND : norm N D <= INR N * (INR N * E * norm N e)).
  { eapply Rle_trans; [apply norm_le_sum|]. rewrite <- sum_const. apply sum_le. exact HD. }
  assert (NG : norm N (mv N (real G) e) <= IZR (most b) * norm N e).
  { apply norm_le_bound; [apply Rmult_le_pos; [exact B2|apply norm_nonneg]|].
    rewrite Rpow_mult_distr, norm_pow2. lra. }
  assert (R : IZR scale * norm N (T e) <= IZR t * norm N e).
  { rewrite <- (Rabs_right (IZR scale)), <- norm_scal by lra.
    rewrite (norm_ext N _ (fun i => mv N (real G) e i + D i)) by (intros; unfold D; ring).
    eapply Rle_trans; [apply norm_triangle|].
    apply Rle_trans with ((IZR (most b) + INR N * INR N * E) * norm N e); [lra|].
    apply Rmult_le_compat_r; [apply norm_nonneg|exact B]. }
  apply Rmult_le_reg_l with (IZR scale); [exact Hs|].
  replace (IZR scale * (IZR t / IZR scale * norm N e)) with (IZR t * norm N e) by (field; lra). exact R.
Qed.

(** last / scale <= c_b / c_a. *)
Lemma ratio_sound scale alpha l a b last N T : (0 < scale)%Z -> 0 < alpha < 1 ->
  powers_within scale alpha 1 l -> (a < length l)%nat -> (b < length l)%nat -> (0 <= last)%Z ->
  (last * c_high scale l a <= scale * c_low scale l b)%Z ->
  bounded_on_1perp N T (IZR last / IZR scale) -> bounded_on_1perp N T (ck alpha b / ck alpha a).
Proof.
  intros Hs Ha Hl La Lb C0 C. apply bounded_weaken. assert (S0 := IZR_lt _ _ Hs).
  apply IZR_le in C, C0. rewrite !mult_IZR in C.
  assert (X := c_within scale alpha Hs l a Hl La). assert (Y := c_within scale alpha Hs l b Hl Lb).
  assert (Q : 0 < ck alpha a) by (apply ck_pos, Ha).
  apply Rmult_le_reg_l with (IZR scale * (IZR scale * ck alpha a)); [repeat apply Rmult_lt_0_compat; assumption|].
  replace (IZR scale * (IZR scale * ck alpha a) * (IZR last / IZR scale))
    with (IZR last * (IZR scale * ck alpha a)) by (field; lra).
  replace (IZR scale * (IZR scale * ck alpha a) * (ck alpha b / ck alpha a))
    with (IZR scale * (IZR scale * ck alpha b)) by (field; lra).
  apply Rle_trans with (IZR last * IZR (c_high scale l a)).
  - apply Rmult_le_compat_l; lra.
  - eapply Rle_trans; [exact C|]. apply Rmult_le_compat_l; lra.
Qed.

Section Tail.
Variables (N : nat) (W : zmat) (d lo hi m scale : Z) (l r : list (Z * Z)) (phis powers : list (list cell)).
Variables (K p : nat) (phi_bounds power_bounds : list bound) (last_bound : bound) (last : Z).

Definition tail_check : bool :=
  ((0 <? m)%Z && (0 <? scale)%Z && (0 <=? lo)%Z && (1 <=? p)%nat && (K + 1 + p <? length l)%nat
   && resolvent_check scale l r K
   && below N (fun j => phi_check N W d lo hi m scale (unit N j) r (nth j phis nil) K)
   && below N (fun j => phi_check N W d lo hi m scale (unit N j) nil (nth j powers nil) (K + p))
   && below K (fun k => bound_check N phis (S k) (nth k phi_bounds no_bound) scale)
   && below p (fun i => bound_check N powers (K + 1 + i) (nth i power_bounds no_bound) (c_low scale l (K + 1 + i)))
   && bound_check N powers p last_bound last && (0 <=? last)%Z
   && (last * c_high scale l (K + 1) <=? scale * c_low scale l (K + 1 + p))%Z)%bool.

Lemma tail_sound alpha mu : (0 < d)%Z -> balanced N (weighted W d) -> 0 < alpha < 1 ->
  IZR lo / IZR m <= mu <= IZR hi / IZR m -> powers_within scale alpha 1 l -> tail_check = true ->
  forall k, bounded_on_1perp N (Phi alpha N (perron N (weighted W d) mu) k) 1.
Proof.
  intros Hd bal Ha Hmu Hl H. unfold tail_check in H. repeat (apply andb_prop in H; destruct H as [H ?C]).
  apply Z.ltb_lt in H, C10. apply Z.leb_le in C9, C, C0. apply Nat.leb_le in C8. apply Nat.ltb_lt in C7.
  set (A := weighted W d). set (P := perron N A mu). assert (S0 := IZR_lt _ _ C10).
  assert (Hr := r_within scale alpha C10 l r K Hl C6).
  assert (HP : forall n b t, (n <= K + p)%nat -> bound_check N powers n b t = true ->
            bounded_on_1perp N (iter n (mv N P)) (IZR t / IZR scale)).
  { intros n b t Hn. apply (bound_sound N scale powers n b t _ C10 (iter_linear N P n)). intros j Hj.
    apply (power_sound N W d lo hi m scale mu Hd H C9 Hmu (unit N j) (nth j powers nil) (K + p)); [|exact Hn].
    apply (below_true N _ C4 j Hj). }
  assert (c_pos : forall n, 0 < ck alpha n) by (intros; apply ck_pos, Ha).
  apply (peak_lemma N A mu alpha 1 K Ha (Rle_refl 1)).
  - intros k Hk. destruct k as [|k].
    + intros e He. rewrite (norm_ext N _ e) by (intros; apply phi_0). lra.
    + replace 1 with (IZR scale / IZR scale) by (field; lra).
      apply (bound_sound N scale phis (S k) (nth k phi_bounds no_bound) scale _ C10 (phi_linear N alpha P (S k))).
      * intros j Hj. apply (phi_sound N W d lo hi m scale mu Hd H C9 Hmu alpha (unit N j) r (nth j phis nil) K Ha Hr);
          [|exact Hk]. apply (below_true N _ C5 j Hj).
      * apply (below_true K _ C3 k). lia.
  - apply (peak_tail N A mu alpha 1 K p Ha (Rle_refl 1) C8 bal).
    + intros n Hn. replace n with (K + 1 + (n - K - 1))%nat by lia. set (i := (n - K - 1)%nat).
      assert (I : (i < p)%nat) by (unfold i; lia).
      apply bounded_weaken with (IZR (c_low scale l (K + 1 + i)) / IZR scale).
      * apply Rmult_le_reg_l with (IZR scale); [exact S0|].
        replace (IZR scale * (IZR (c_low scale l (K + 1 + i)) / IZR scale))
          with (IZR (c_low scale l (K + 1 + i))) by (field; lra).
        assert (X := c_within scale alpha C10 l (K + 1 + i) Hl ltac:(lia)). lra.
      * apply (HP _ (nth i power_bounds no_bound)); [lia|]. apply (below_true p _ C2 i I).
    + apply (ratio_sound scale alpha l (K + 1) (K + 1 + p) last N _ C10 Ha Hl ltac:(lia) ltac:(lia) C0 C).
      apply (HP p last_bound last ltac:(lia) C1).
Qed.
End Tail.

Lemma norm_bound_from_phi N A alpha gamma h : balanced N A -> design alpha gamma h ->
  (forall k, bounded_on_1perp N (Phi alpha N (perron N A (mu_of alpha gamma h)) k) 1) ->
  control_norm_bound N A alpha gamma h.
Proof. apply bound_from_phi. Qed.

Lemma norm_bound_false_at N A alpha gamma h k : (2 <= N)%nat -> assumption1 N A ->
  design alpha gamma h ->
  ~ bounded_on_1perp N (Phi alpha N (perron N A (mu_of alpha gamma h)) k) 1 ->
  ~ control_norm_bound N A alpha gamma h.
Proof. intros HN H1 D H C. apply H, (eqL3_characterised N A alpha gamma h HN H1 D), C. Qed.
