(** Boundedness, vanishing controls and average consensus. *)
From Coq Require Import Reals Arith Lia Lra.
From Coquelicot Require Import Coquelicot.
From Fomas Require Import Model.Vectors Model.Kernel Model.Gamma Model.Graph Model.Loop Statements.
From Fomas Require Import Facts.Sums Facts.Vectors Facts.Kernel Facts.Resolvent Facts.Gamma.
From Fomas Require Import Facts.Graph Facts.Lambda2 Facts.Contraction Facts.Loop Facts.Phi Facts.Between.
Open Scope R_scope.

(** The deviation from the mean evolves with P. *)
Lemma deviation_iter N A mu k x0 i : (i < N)%nat ->
  iter k (mv N (perron N A mu)) x0 i - mean N x0
  = iter k (mv N (perron N A mu)) (fun j => x0 j - mean N x0) i.
Proof.
  intros Hi. rewrite (iter_minus N (perron N A mu) k x0 (fun _ => mean N x0)) by exact Hi.
  f_equal. revert i Hi. induction k as [|k IH]; intros i Hi; simpl; [reflexivity|].
  rewrite <- (mv_ext N (perron N A mu) (fun _ => mean N x0)) by exact IH.
  rewrite perron_entry, laplacian_entry by exact Hi.
  rewrite sum_zero by (intros; ring). ring.
Qed.

Section Decay.
Variables (N : nat) (A : mat) (alpha gamma h C rho : R).
Context (HN : (1 <= N)%nat) (bal : balanced N A) (D : design alpha gamma h).
Context (HC : 0 <= C) (Hr : 0 <= rho < 1).
Let P := perron N A (mu_of alpha gamma h).
Context (Hd : decays_on_1perp N (mv N P) C rho).
Variables (x0 : vec) (x : R -> vec) (u : nat -> vec).
Context (H : closed_loop N A alpha gamma h x0 x u).

Lemma control_bound k : norm N (u k)
  <= C * \sum_(j < S k) (rk alpha (k - j) * rho ^ j) * norm N (u 0%nat).
Proof.
  rewrite (norm_ext N _ _ (loop_phi N A alpha gamma h x0 D x u H k)).
  apply (phi_decay N _ alpha (proj1 D) C rho k HC (proj1 Hr) Hd).
  apply (loop_u0_zero_sum N A alpha gamma h x0 D x u bal H).
Qed.

Lemma control_bounded k : norm N (u k) <= C / (1 - rho) * norm N (u 0%nat).
Proof.
  eapply Rle_trans; [apply control_bound|].
  apply Rmult_le_compat_r; [apply norm_nonneg|].
  apply Rmult_le_compat_l; [exact HC|]. apply resolvent_geom_bound; [apply D|exact Hr].
Qed.

Lemma control_vanishes i : (i < N)%nat -> is_lim_seq (fun k => u k i) 0.
Proof.
  intros Hi. apply dominated_vanishes with
    (b := fun k => \sum_(j < S k) (rk alpha (k - j) * rho ^ j)) (c := C * norm N (u 0%nat)).
  - intros k. eapply Rle_trans; [apply entry_le_norm, Hi|].
    eapply Rle_trans; [apply control_bound|]. right. ring.
  - apply resolvent_geom_lim; [apply D|exact Hr].
Qed.

Lemma sample_deviation k i : (i < N)%nat ->
  Rabs (x (INR k * h) i - mean N x0) <= C * norm N (fun j => x0 j - mean N x0) * rho ^ k.
Proof.
  intros Hi. rewrite (loop_sample N A alpha gamma h x0 D x u H k i Hi).
  rewrite deviation_iter by exact Hi.
  eapply Rle_trans; [apply (entry_le_norm N _ i Hi)|].
  eapply Rle_trans; [apply Hd, zero_sum_deviation, HN|]. right. ring.
Qed.

Lemma sample_consensus i : (i < N)%nat -> is_lim_seq (fun k => x (INR k * h) i) (mean N x0).
Proof.
  intros Hi.
  assert (L : is_lim_seq (fun k => x (INR k * h) i - mean N x0) 0).
  { apply dominated_vanishes with (b := fun k => rho ^ k)
      (c := C * norm N (fun j => x0 j - mean N x0)).
    - intros k. apply sample_deviation, Hi.
    - apply is_lim_seq_geom. rewrite Rabs_right; lra. }
  apply is_lim_seq_ext with (fun k => (x (INR k * h) i - mean N x0) + mean N x0);
    [intros k; ring|].
  replace (Finite (mean N x0)) with (Finite (0 + mean N x0)) by (f_equal; ring).
  apply is_lim_seq_plus'; [exact L|apply is_lim_seq_const].
Qed.

Lemma state_consensus i : (i < N)%nat -> is_lim (fun t => x t i) p_infty (mean N x0).
Proof.
  intros Hi. destruct D as [Ha [Hg Hh]]. apply is_lim_spec. intros eps. simpl.
  assert (He := cond_pos eps).
  assert (L := sample_consensus i Hi). apply is_lim_seq_spec in L.
  destruct (L (mkposreal (eps / 2) ltac:(lra))) as [K1 H1]. simpl in H1.
  destruct (between_vanishes N alpha h x0 u x Ha Hh (proj1 H) i Hi (control_vanishes i Hi)
              (eps / 3) ltac:(lra)) as [K2 H2].
  exists (INR (S (K1 + K2)) * h). intros t Ht.
  assert (T0 : 0 < t).
  { assert (Q := pos_INR (S (K1 + K2))). nra. }
  destruct (sampling_interval h t Hh T0) as [k [s [Hs ->]]].
  assert (Hk : (K1 + K2 < S k)%nat).
  { apply INR_lt. assert (B : INR (K1 + K2) * h < INR (S k) * h).
    { rewrite S_INR in *. nra. }
    apply Rmult_lt_reg_r with h; assumption. }
  specialize (H1 k ltac:(lia)). specialize (H2 k s ltac:(lia) ltac:(lra)).
  replace (x (INR k * h + s) i - mean N x0)
    with ((x (INR k * h + s) i - x (INR k * h) i) + (x (INR k * h) i - mean N x0)) by ring.
  eapply Rle_lt_trans; [apply Rabs_triang|]. lra.
Qed.

(** Every signal is bounded, between the samples too. *)
Lemma signals_bounded : exists B,
  (forall t i, 0 <= t -> (i < N)%nat -> Rabs (x t i) <= B) /\
  (forall k i, (i < N)%nat -> Rabs (u k i) <= B).
Proof.
  destruct D as [Ha [Hg Hh]].
  set (U := C / (1 - rho) * norm N (u 0%nat)).
  set (V := 2 * rpow h alpha / Gamma (alpha + 1) * U).
  set (W := C * norm N (fun j => x0 j - mean N x0)).
  assert (U0 : 0 <= U).
  { eapply Rle_trans; [apply (norm_nonneg N (u 0%nat))|apply (control_bounded 0)]. }
  assert (G : 0 < / Gamma (alpha + 1)) by (apply Rinv_0_lt_compat, Gamma_pos; lra).
  assert (V0 : 0 <= V).
  { apply Rmult_le_pos; [|exact U0]. assert (Q := rpow_nonneg h alpha). unfold Rdiv. nra. }
  assert (W0 : 0 <= W) by (apply Rmult_le_pos; [exact HC|apply norm_nonneg]).
  assert (S0 : forall k i, (i < N)%nat -> Rabs (x (INR k * h) i) <= Rabs (mean N x0) + W).
  { intros k i Hi.
    replace (x (INR k * h) i) with (mean N x0 + (x (INR k * h) i - mean N x0)) by ring.
    eapply Rle_trans; [apply Rabs_triang|]. apply Rplus_le_compat_l.
    eapply Rle_trans; [apply sample_deviation, Hi|]. fold W.
    assert (Q : rho ^ k <= 1).
    { rewrite <- (pow1 k). apply pow_incr. lra. }
    nra. }
  assert (M0 := Rabs_pos (mean N x0)).
  exists (Rabs (mean N x0) + W + V + U). split.
  - intros t i [Ht| <-] Hi.
    + destruct (sampling_interval h t Hh Ht) as [k [s [Hs ->]]].
      replace (x (INR k * h + s) i)
        with ((x (INR k * h + s) i - x (INR k * h) i) + x (INR k * h) i) by ring.
      eapply Rle_trans; [apply Rabs_triang|].
      assert (O : Rabs (x (INR k * h + s) i - x (INR k * h) i) <= V).
      { eapply Rle_trans; [apply (entry_le_norm N (fun i => x (INR k * h + s) i - x (INR k * h) i) i Hi)|].
        eapply Rle_trans; [apply (overshoot_norm N alpha h x0 u x Ha Hh (proj1 H) U k s)|].
        - lra.
        - intros j _. apply control_bounded.
        - apply Rmult_le_compat_r; [exact U0|]. unfold Rdiv.
          apply Rmult_le_compat_r; [lra|]. apply Rmult_le_compat_l; [lra|].
          apply rpow_le; lra. }
      specialize (S0 k i Hi). lra.
    + specialize (S0 0%nat i Hi). simpl in S0. rewrite Rmult_0_l in S0. lra.
  - intros k i Hi. eapply Rle_trans; [apply entry_le_norm, Hi|].
    eapply Rle_trans; [apply control_bounded|]. fold U. lra.
Qed.
End Decay.

Theorem consensus_from_decay : consensus_from_decay_statement.
Proof.
  intros N A alpha gamma h C rho HN bal D HC Hr Hd x0 x u H.
  split; [|split].
  - apply (control_bounded N A alpha gamma h C rho bal D HC Hr Hd x0 x u H).
  - apply (control_vanishes N A alpha gamma h C rho bal D HC Hr Hd x0 x u H).
  - apply (state_consensus N A alpha gamma h C rho HN bal D HC Hr Hd x0 x u H).
Qed.

(** (15) and Assumption 1 give the decay. *)
Lemma gain_bound_decay N A mu : assumption1 N A -> gain_bound N A mu -> exists s,
  0 <= s < 1 /\ decays_on_1perp N (mv N (perron N A mu)) 1 s.
Proof.
  intros H1 HG. destruct (gain_bound_lt N A mu HG) as [Hm HD].
  destruct (strict_contraction N A mu H1 Hm HD) as [s [Hs Hc]]. exists s.
  split; [split; [apply Hc|exact Hs]|]. apply contracts_decay; [apply H1|exact Hc].
Qed.

Theorem consensus_at_samples : consensus_at_samples_statement.
Proof.
  intros N A alpha gamma h HN H1 D HG.
  destruct (gain_bound_decay N A _ H1 HG) as [s [Hs Hd]].
  assert (bal : balanced N A) by apply H1. exists (1 / (1 - s)). intros x0 x u H.
  split; [|split].
  - apply (control_bounded N A alpha gamma h 1 s bal D Rle_0_1 Hs Hd x0 x u H).
  - apply (control_vanishes N A alpha gamma h 1 s bal D Rle_0_1 Hs Hd x0 x u H).
  - intros i Hi.
    apply (sample_consensus N A alpha gamma h 1 s ltac:(lia) D Hs Hd x0 x u H i Hi).
Qed.

Theorem consensus_between_samples : consensus_between_samples_statement.
Proof.
  intros N A alpha gamma h HN H1 D HG x0 x u H i Hi.
  destruct (gain_bound_decay N A _ H1 HG) as [s [Hs Hd]].
  apply (state_consensus N A alpha gamma h 1 s ltac:(lia) (proj2 (proj2 H1)) D Rle_0_1 Hs Hd
           x0 x u H i Hi).
Qed.

Theorem overshoot : overshoot_statement.
Proof.
  intros N alpha h x0 u x M k s Ha Hh Hx Hs HM.
  apply (overshoot_norm N alpha h x0 u x Ha Hh Hx M k s Hs HM).
Qed.

Theorem theorem1_from_gain_bound : theorem1_from_gain_bound_statement.
Proof.
  intros N A alpha gamma h HN H1 D HG x0 x u H.
  destruct (gain_bound_decay N A _ H1 HG) as [s [Hs Hd]].
  assert (bal : balanced N A) by apply H1.
  assert (cons := consensus_between_samples N A alpha gamma h HN H1 D HG x0 x u H).
  split; [|split; [|split; [|exact cons]]].
  - apply (signals_bounded N A alpha gamma h 1 s ltac:(lia) bal D Rle_0_1 Hs Hd x0 x u H).
  - apply (control_vanishes N A alpha gamma h 1 s bal D Rle_0_1 Hs Hd x0 x u H).
  - intros i j Hi Hj.
    replace (Finite 0) with (Rbar_abs (Finite (mean N x0 - mean N x0)))
      by (simpl; f_equal; rewrite Rminus_eq_0; apply Rabs_R0).
    apply is_lim_Rabs. apply is_lim_minus'; auto.
Qed.

Theorem theorem1_as_stated : theorem1_as_stated_statement.
Proof.
  intros N A alpha gamma h l HN H1 D Hl mu HG _ x0 x u H.
  destruct (theorem1_from_gain_bound N A alpha gamma h HN H1 D HG x0 x u H) as [B [_ C]].
  split; assumption.
Qed.

Theorem control_vanishes_converse : control_vanishes_converse_statement.
Proof.
  intros N A alpha gamma h x0 x u D H L i Hi.
  assert (Ha := proj1 D).
  apply is_lim_seq_ext with
    (fun k => u k i + \sum_(l < k) (fk alpha (S l) * u (k - S l)%nat i)).
  { intros k. apply (loop_convolution N A alpha gamma h x0 D x u H k i Hi). }
  replace (Finite 0) with (Finite (0 + 0)) by (f_equal; ring).
  apply is_lim_seq_plus'; [apply L, Hi|].
  (* a summable kernel against a vanishing sequence *)
  apply is_lim_seq_spec. intros eps. assert (He := cond_pos eps).
  assert (Li := L i Hi). apply is_lim_seq_spec in Li.
  destruct (Li (mkposreal 1 Rlt_0_1)) as [n Hn]. simpl in Hn.
  set (U := 1 + \sum_(j < n) Rabs (u j i)).
  assert (S0 : 0 <= \sum_(j < n) Rabs (u j i)) by (apply sum_nonneg; intros; apply Rabs_pos).
  assert (HU : forall j, Rabs (u j i) <= U).
  { intros j. unfold U. destruct (le_lt_dec n j) as [Hj|Hj].
    - specialize (Hn j Hj). rewrite Rminus_0_r in Hn. lra.
    - assert (T := sum_ge_term n (fun j => Rabs (u j i)) j (fun _ _ => Rabs_pos _) Hj).
      cbv beta in T. lra. }
  destruct (Li (mkposreal (eps / 2) ltac:(lra))) as [J HJ]. simpl in HJ.
  assert (E2 : 0 < eps / (2 * U)) by (apply Rdiv_lt_0_compat; unfold U in *; lra).
  assert (C := ck_lim alpha Ha). apply is_lim_seq_spec in C.
  destruct (C (mkposreal _ E2)) as [K HK]. simpl in HK.
  exists (J + K)%nat. intros k Hk. rewrite Rminus_0_r.
  eapply Rle_lt_trans; [apply sum_abs|].
  replace k with ((k - J) + J)%nat at 1 by lia. rewrite sum_split.
  assert (A1 : \sum_(l < k - J) Rabs (fk alpha (S l) * u (k - S l)%nat i)
               <= (1 - ck alpha (k - J)) * (eps / 2)).
  { rewrite <- fk_sum, <- sum_scal_r by exact Ha. apply sum_le. intros l Hl.
    rewrite Rabs_mult. apply Rmult_le_compat_l; [apply Rabs_pos|].
    specialize (HJ (k - S l)%nat ltac:(lia)). rewrite Rminus_0_r in HJ. lra. }
  assert (A2 : \sum_(l < J) Rabs (fk alpha (S (k - J + l)) * u (k - S (k - J + l))%nat i)
               <= ck alpha (k - J) * U).
  { apply Rle_trans with (\sum_(l < J) (Rabs (fk alpha (S (k - J + l))) * U)).
    - apply sum_le. intros l _. rewrite Rabs_mult.
      apply Rmult_le_compat_l; [apply Rabs_pos|apply HU].
    - rewrite sum_scal_r. apply Rmult_le_compat_r; [unfold U; lra|].
      assert (F1 := fk_sum alpha Ha (k - J + J)). rewrite sum_split, fk_sum in F1 by exact Ha.
      assert (P := ck_pos alpha Ha (k - J + J)). lra. }
  specialize (HK (k - J)%nat ltac:(lia)). rewrite Rminus_0_r in HK. apply Rabs_def2 in HK.
  assert (Q := ck_pos alpha Ha (k - J)).
  assert (R : ck alpha (k - J) * U < eps / 2).
  { replace (eps / 2) with (eps / (2 * U) * U) by (field; unfold U; lra).
    apply Rmult_lt_compat_r; [unfold U|]; lra. }
  assert (T : (1 - ck alpha (k - J)) * (eps / 2) <= eps / 2) by nra. lra.
Qed.
