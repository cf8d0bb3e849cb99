(** Agents with states in R^n: the loop on A (x) I_n is n copies of the loop on A. *)
From Coq Require Import Reals Arith Lia Lra.
From Coquelicot Require Import Coquelicot.
From Fomas Require Import Model.Vectors Model.Kernel Model.Gamma Model.Graph Model.Loop Statements.
From Fomas Require Import Facts.Sums Facts.Vectors Facts.Graph Facts.Phi Results.Consensus.
Open Scope R_scope.

Lemma sum_blocks N n F : \sum_(p < N * n) F p = \sum_(i < N) \sum_(d < n) F (i * n + d)%nat.
Proof.
  induction N as [|N IH]; [reflexivity|].
  replace (S N * n)%nat with (N * n + n)%nat by lia. rewrite sum_split, IH. reflexivity.
Qed.

Lemma block_index n i d : (d < n)%nat ->
  ((i * n + d) / n = i)%nat /\ ((i * n + d) mod n = d)%nat.
Proof.
  intros Hd. rewrite Nat.div_add_l by lia. rewrite (Nat.add_comm (i * n)), Nat.mod_add by lia.
  rewrite (Nat.div_small d), (Nat.mod_small d) by exact Hd. split; lia.
Qed.

Lemma block_below N n i d : (i < N)%nat -> (d < n)%nat -> (i * n + d < N * n)%nat.
Proof. nia. Qed.

(** Every index of R^(N n) is that of one agent and one coordinate. *)
Lemma block_split N n p : (p < N * n)%nat ->
  exists i d, (i < N)%nat /\ (d < n)%nat /\ p = (i * n + d)%nat.
Proof.
  intros Hp. assert (Hn : n <> 0%nat) by lia. exists (p / n)%nat, (p mod n)%nat.
  split; [apply Nat.div_lt_upper_bound; lia|]. split; [apply Nat.mod_upper_bound, Hn|].
  assert (E := Nat.div_mod p n Hn). lia.
Qed.

Lemma kron_row N n A (g : vec) i d : (d < n)%nat ->
  \sum_(q < N * n) (kron_id n A (i * n + d)%nat q * g q)
  = \sum_(j < N) (A i j * coordinate n d g j).
Proof.
  intros Hd. rewrite sum_blocks. apply sum_ext. intros j _.
  destruct (block_index n i d Hd) as [Q R].
  rewrite (sum_single n d); [|exact Hd|].
  - unfold kron_id. destruct (block_index n j d Hd) as [Q' R'].
    rewrite Q, R, Q', R', Nat.eqb_refl. reflexivity.
  - intros c Hc Ne. unfold kron_id. destruct (block_index n j c Hc) as [_ R'].
    rewrite R, R'. destruct (Nat.eqb_spec d c); [congruence|ring].
Qed.

Lemma coordinate_loop N n A alpha gamma h x0 x u :
  closed_loop (N * n) (kron_id n A) alpha gamma h x0 x u -> forall d, (d < n)%nat ->
  closed_loop N A alpha gamma h (coordinate n d x0)
    (fun t => coordinate n d (x t)) (fun k => coordinate n d (u k)).
Proof.
  intros [[X0 X] C] d Hd. split; [split|].
  - intros i Hi. apply X0, block_below; assumption.
  - intros k s i Hi Hs. apply (X k s (i * n + d)%nat); [apply block_below|]; assumption.
  - intros k i Hi. unfold coordinate at 1.
    rewrite (C k (i * n + d)%nat) by (apply block_below; assumption).
    rewrite (kron_row N n A (fun q => x (INR k * h) q - x (INR k * h) (i * n + d)%nat) i d Hd).
    reflexivity.
Qed.

Lemma dot_blocks N n x y :
  dot (N * n) x y = \sum_(d < n) dot N (coordinate n d x) (coordinate n d y).
Proof. unfold dot. rewrite sum_blocks, sum_swap. reflexivity. Qed.

Theorem remark1 : remark1_statement.
Proof.
  intros N n A alpha gamma h x0 x u H.
  assert (L := coordinate_loop N n A alpha gamma h x0 x u H). split; [exact L|].
  intros B k. apply norm_le_sq. rewrite !dot_blocks. apply sum_le. intros d Hd.
  assert (T := B _ _ _ (L d Hd) k). cbv beta in T. rewrite <- !norm_sq.
  apply Rmult_le_compat; try apply norm_nonneg; exact T.
Qed.

(** Entries that tend to 0 make the norm tend to 0. *)
Lemma norm_lim n (y : R -> vec) :
  (forall d, (d < n)%nat -> is_lim (fun t => y t d) p_infty 0) ->
  is_lim (fun t => norm n (y t)) p_infty 0.
Proof.
  intros H.
  apply (is_lim_le_le_loc (fun _ => 0) (fun t => \sum_(d < n) Rabs (y t d))).
  - apply filter_forall. intros t. split; [apply norm_nonneg|apply norm_le_sum].
  - apply is_lim_const.
  - induction n as [|n IH]; [exact (is_lim_const 0 p_infty)|].
    replace (Finite 0) with (Finite (0 + 0)) by (f_equal; ring).
    apply (is_lim_plus' (fun t => \sum_(d < n) Rabs (y t d)) (fun t => Rabs (y t n))); [auto|].
    rewrite <- Rabs_R0. apply (is_lim_Rabs (fun t => y t n) p_infty 0). auto.
Qed.

Theorem remark1_consensus : remark1_consensus_statement.
Proof.
  intros N n A alpha gamma h x0 x u HN H1 D HG H.
  assert (T : forall d (Hd : (d < n)%nat), _) by
    exact (fun d Hd => theorem1_from_gain_bound N A alpha gamma h HN H1 D HG _ _ _
      (coordinate_loop N n A alpha gamma h x0 x u H d Hd)).
  split; [|split; [|split]].
  - destruct (finite_bound n (fun d K =>
      (forall t i, 0 <= t -> (i < N)%nat -> Rabs (x t (i * n + d)%nat) <= K) /\
      (forall k i, (i < N)%nat -> Rabs (u k (i * n + d)%nat) <= K))) as [K [_ HK]].
    + intros d K K' [Bx Bu] Hle. split; intros.
      * eapply Rle_trans; [apply Bx; assumption|exact Hle].
      * eapply Rle_trans; [apply Bu; assumption|exact Hle].
    + intros d Hd. destruct (T d Hd) as [[B [Bx Bu]] _]. exists B. split; [|split; assumption].
      eapply Rle_trans; [apply Rabs_pos|apply (Bu 0%nat 0%nat); lia].
    + assert (S1 : forall y : vec, (forall i d, (i < N)%nat -> (d < n)%nat ->
                Rabs (y (i * n + d)%nat) <= K) -> norm (N * n) y <= INR (N * n) * K).
      { intros y Hy. eapply Rle_trans; [apply norm_le_sum|]. rewrite <- sum_const.
        apply sum_le. intros p Hp. destruct (block_split N n p Hp) as [i [d [Hi [Hd ->]]]].
        apply Hy; assumption. }
      exists (INR (N * n) * K). split.
      * intros t Ht. apply S1. intros i d Hi Hd. apply (proj1 (HK d Hd)); assumption.
      * intros k. apply S1. intros i d Hi Hd. apply (proj2 (HK d Hd)); assumption.
  - apply norm_vanishes. intros p Hp. destruct (block_split N n p Hp) as [i [d [Hi [Hd ->]]]].
    apply (proj1 (proj2 (T d Hd)) i Hi).
  - intros i j Hi Hj. apply norm_lim. intros d Hd. unfold agent.
    assert (L := proj2 (proj2 (proj2 (T d Hd)))).
    replace (Finite 0) with (Finite (mean N (coordinate n d x0) - mean N (coordinate n d x0)))
      by (f_equal; ring).
    apply is_lim_minus'; [apply (L i Hi)|apply (L j Hj)].
  - intros i d Hi Hd. apply (proj2 (proj2 (proj2 (T d Hd))) i Hi).
Qed.
