(** Bounds on Phi_k, the map from u_0 to u_k. *)
From Coq Require Import Reals Arith Lia Lra.
From Coquelicot Require Import Coquelicot.
From Fomas Require Import Model.Vectors Model.Kernel Model.Graph Model.Loop.
From Fomas Require Import Facts.Sums Facts.Vectors Facts.Kernel Facts.Resolvent.
Open Scope R_scope.

Section Phi.
Variables (N : nat) (M : mat) (alpha : R).
Context (Ha : 0 < alpha < 1).

Lemma phi_step y k i : (i < N)%nat ->
  Phi alpha N M (S k) y i = mv N M (Phi alpha N M k y) i + rk alpha (S k) * y i.
Proof.
  intros Hi. unfold Phi at 1. rewrite sum_first, Nat.sub_0_r. simpl iter.
  unfold Phi. rewrite mv_sum.
  rewrite (sum_ext (S k) (fun l => mv N M (fun j => rk alpha (k - l) * iter l (mv N M) y j) i)
             (fun l => rk alpha (k - l) * mv N M (iter l (mv N M) y) i))
    by (intros; apply mv_scal).
  rewrite Rplus_comm. f_equal.
Qed.

Lemma phi_convolution y k i : (i < N)%nat ->
  Phi alpha N M k y i = iter k (mv N M) y i
    + \sum_(l < k) (Rabs (fk alpha (S l)) * Phi alpha N M (k - S l) y i).
Proof.
  intros Hi.
  assert (E := resolvent_solves alpha (fun j => iter j (mv N M) y i) k). cbv zeta beta in E.
  unfold Phi. rewrite <- E.
  rewrite (sum_ext k (fun l => Rabs (fk alpha (S l)) * _)
             (fun l => - (fk alpha (S l) *
                \sum_(j < S (k - S l)) (rk alpha (k - S l - j) * iter j (mv N M) y i)))).
  - rewrite sum_opp. ring.
  - intros l _. rewrite Rabs_left by (apply fk_neg, Ha). ring.
Qed.

Lemma phi_0 y i : Phi alpha N M 0 y i = y i.
Proof. unfold Phi. simpl. rewrite rk_0. ring. Qed.

Lemma phi_ext k x y : (forall i, (i < N)%nat -> x i = y i) ->
  forall i, (i < N)%nat -> Phi alpha N M k x i = Phi alpha N M k y i.
Proof.
  intros H i Hi. apply sum_ext. intros j _. f_equal. apply iter_mv_ext; assumption.
Qed.

Lemma phi_minus k x y i : (i < N)%nat ->
  Phi alpha N M k (fun j => x j - y j) i = Phi alpha N M k x i - Phi alpha N M k y i.
Proof.
  intros Hi. unfold Phi. rewrite <- sum_minus. apply sum_ext. intros j _.
  rewrite iter_minus by exact Hi. ring.
Qed.

(** ||Phi_k e|| <= sum r_{k-j} ||P^j e||. *)
Lemma phi_norm k e : norm N (Phi alpha N M k e)
  <= \sum_(j < S k) (rk alpha (k - j) * norm N (iter j (mv N M) e)).
Proof.
  unfold Phi. eapply Rle_trans; [apply norm_combination|]. apply sum_le. intros j _.
  rewrite Rabs_right; [apply Rle_refl|]. apply Rle_ge. left. apply rk_pos, Ha.
Qed.

Lemma phi_decay C rho k : 0 <= C -> 0 <= rho -> decays_on_1perp N (mv N M) C rho ->
  bounded_on_1perp N (Phi alpha N M k) (C * \sum_(j < S k) (rk alpha (k - j) * rho ^ j)).
Proof.
  intros HC Hr H e He. eapply Rle_trans; [apply phi_norm|].
  rewrite (Rmult_comm C), Rmult_assoc, <- sum_scal_r. apply sum_le. intros j _.
  assert (R := rk_pos alpha Ha (k - j)). specialize (H j e He). cbv beta.
  replace (rk alpha (k - j) * rho ^ j * (C * norm N e))
    with (rk alpha (k - j) * (C * rho ^ j * norm N e)) by ring.
  apply Rmult_le_compat_l; [lra|exact H].
Qed.

(** The peak lemma. *)
Lemma phi_peak B K : 1 <= B ->
  (forall k, (k <= K)%nat -> bounded_on_1perp N (Phi alpha N M k) B) ->
  (forall n, (K < n)%nat -> bounded_on_1perp N (iter n (mv N M)) (B * ck alpha n)) ->
  forall k, bounded_on_1perp N (Phi alpha N M k) B.
Proof.
  intros HB H0 H1 k. induction k as [k IH] using lt_wf_ind.
  destruct (le_lt_dec k K) as [L|L]; [apply H0, L|]. intros e He.
  rewrite (norm_ext N _ _ (fun i Hi => phi_convolution e k i Hi)).
  eapply Rle_trans; [apply norm_triangle|].
  assert (T1 := H1 k L e He).
  assert (T2 : norm N (fun i => \sum_(l < k) (Rabs (fk alpha (S l)) * Phi alpha N M (k - S l) e i))
               <= (1 - ck alpha k) * (B * norm N e)).
  { eapply Rle_trans; [apply norm_combination|]. rewrite <- fk_sum, <- sum_scal_r by exact Ha.
    apply sum_le. intros l Hl. rewrite Rabs_Rabsolu.
    apply Rmult_le_compat_l; [apply Rabs_pos|]. apply IH; [lia|exact He]. }
  nra.
Qed.
End Phi.

(** Convolving r with a geometric sequence: bounded, and vanishing. *)
Lemma resolvent_geom_bound alpha rho k : 0 < alpha < 1 -> 0 <= rho < 1 ->
  \sum_(j < S k) (rk alpha (k - j) * rho ^ j) <= / (1 - rho).
Proof.
  intros Ha Hr. eapply Rle_trans; [|apply (sum_geom_le (S k) rho Hr)].
  apply sum_le. intros j _. assert (P := pow_le rho j (proj1 Hr)).
  assert (Q := rk_le_1 alpha Ha (k - j)). nra.
Qed.

Lemma resolvent_geom_step alpha rho k :
  \sum_(j < S (S k)) (rk alpha (S k - j) * rho ^ j)
  = rho * \sum_(j < S k) (rk alpha (k - j) * rho ^ j) + rk alpha (S k).
Proof.
  rewrite sum_first, Nat.sub_0_r, <- sum_scal, Rplus_comm. simpl pow at 2. f_equal; [|ring].
  apply sum_ext. intros j _. simpl. ring.
Qed.

(** w_{k+1} = rho w_k + r_{k+1} with r -> 0 makes w vanish. *)
Lemma linear_recursion_vanishes (w r : nat -> R) rho : 0 <= rho < 1 ->
  (forall k, 0 <= w k) -> (forall k, w (S k) = rho * w k + r (S k)) ->
  is_lim_seq r 0 -> is_lim_seq w 0.
Proof.
  intros Hr Hw E L. apply is_lim_seq_spec. intros eps. assert (He := cond_pos eps).
  apply is_lim_seq_spec in L.
  destruct (L (mkposreal (eps * (1 - rho) / 2) ltac:(apply Rdiv_lt_0_compat; nra))) as [K HK].
  simpl in HK.
  assert (S1 : forall n, w (K + n)%nat <= rho ^ n * w K + eps / 2).
  { induction n as [|n IH]; [rewrite Nat.add_0_r; simpl; lra|].
    rewrite Nat.add_succ_r, E.
    assert (R := HK (S (K + n)) ltac:(lia)). rewrite Rminus_0_r in R.
    apply Rabs_def2 in R. simpl.
    assert (rho * w (K + n)%nat <= rho * (rho ^ n * w K + eps / 2))
      by (apply Rmult_le_compat_l; lra). lra. }
  assert (G : is_lim_seq (fun n => rho ^ n * w K) 0).
  { replace (Finite 0) with (Rbar_mult 0 (w K)) by (simpl; f_equal; ring).
    apply is_lim_seq_scal_r. apply is_lim_seq_geom. rewrite Rabs_right; lra. }
  apply is_lim_seq_spec in G.
  destruct (G (mkposreal (eps / 2) ltac:(lra))) as [n Hn]. simpl in Hn.
  exists (K + n)%nat. intros k Hk. rewrite Rminus_0_r, Rabs_right by (apply Rle_ge, Hw).
  replace k with (K + (k - K))%nat by lia.
  specialize (Hn (k - K)%nat ltac:(lia)). rewrite Rminus_0_r in Hn. apply Rabs_def2 in Hn.
  specialize (S1 (k - K)%nat). lra.
Qed.

Lemma resolvent_geom_lim alpha rho : 0 < alpha < 1 -> 0 <= rho < 1 ->
  is_lim_seq (fun k => \sum_(j < S k) (rk alpha (k - j) * rho ^ j)) 0.
Proof.
  intros Ha Hr. apply linear_recursion_vanishes with (r := rk alpha) (rho := rho).
  - exact Hr.
  - intros k. apply sum_nonneg. intros j _.
    apply Rmult_le_pos; [left; apply rk_pos, Ha|apply pow_le; lra].
  - intros k. apply resolvent_geom_step.
  - apply rk_lim, Ha.
Qed.

(** A sequence dominated by one that vanishes. *)
Lemma dominated_vanishes (a b : nat -> R) c : (forall k, Rabs (a k) <= c * b k) ->
  is_lim_seq b 0 -> is_lim_seq a 0.
Proof.
  intros H L. apply is_lim_seq_abs_0.
  apply is_lim_seq_le_le with (fun _ => 0) (fun k => c * b k).
  - intros k. split; [apply Rabs_pos|apply H].
  - apply is_lim_seq_const.
  - replace (Finite 0) with (Rbar_mult c 0) by (simpl; f_equal; ring).
    apply is_lim_seq_scal_l, L.
Qed.

Lemma sum_vanishes n (F : nat -> nat -> R) : (forall i, (i < n)%nat -> is_lim_seq (F i) 0) ->
  is_lim_seq (fun k => \sum_(i < n) F i k) 0.
Proof.
  induction n as [|n IH]; intros H; [apply is_lim_seq_const|].
  replace (Finite 0) with (Finite (0 + 0)) by (f_equal; ring).
  apply (is_lim_seq_plus' (fun k => \sum_(i < n) F i k) (F n)); auto.
Qed.

(** The norm of a vector whose entries vanish, vanishes. *)
Lemma norm_vanishes N (y : nat -> vec) :
  (forall i, (i < N)%nat -> is_lim_seq (fun k => y k i) 0) -> is_lim_seq (fun k => norm N (y k)) 0.
Proof.
  intros H. apply dominated_vanishes with (b := fun k => \sum_(i < N) Rabs (y k i)) (c := 1).
  - intros k. rewrite Rabs_right by apply Rle_ge, norm_nonneg. rewrite Rmult_1_l.
    apply norm_le_sum.
  - apply (sum_vanishes N (fun i k => Rabs (y k i))). intros i Hi.
    apply (is_lim_seq_abs_0 (fun k => y k i)). apply H, Hi.
Qed.
