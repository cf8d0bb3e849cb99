(** Contraction of P on 1perp. *)
From Coq Require Import Reals Arith Lia Lra.
From Fomas Require Import Model.Vectors Model.Graph Model.Loop.
From Fomas Require Import Facts.Sums Facts.Vectors Facts.Graph Facts.Lambda2.
Open Scope R_scope.

Lemma bounded_weaken N T s t : s <= t -> bounded_on_1perp N T s -> bounded_on_1perp N T t.
Proof.
  intros H B e He. specialize (B e He). assert (P := norm_nonneg N e). nra.
Qed.

Lemma bounded_squared N T s2 : (forall e, zero_sum N e -> dot N (T e) (T e) <= s2 * dot N e e) ->
  bounded_on_1perp N T (sqrt (Rmax 0 s2)).
Proof.
  intros H e He. set (q := sqrt (Rmax 0 s2)).
  assert (Q : q * q = Rmax 0 s2) by (apply sqrt_sqrt, Rmax_l).
  assert (q0 : 0 <= q) by apply sqrt_pos. assert (P := norm_nonneg N e).
  apply norm_le_bound; [nra|]. eapply Rle_trans; [apply H, He|].
  replace ((q * norm N e) ^ 2) with (q * q * (norm N e * norm N e)) by ring.
  rewrite Q, norm_sq. apply Rmult_le_compat_r; [apply dot_nonneg|apply Rmax_r].
Qed.

Lemma contracts_dot N A mu s e : contracts N A mu s -> zero_sum N e ->
  dot N (mv N (perron N A mu) e) (mv N (perron N A mu) e) <= s ^ 2 * dot N e e.
Proof.
  intros [s0 H] He. specialize (H e He). rewrite <- !norm_sq.
  assert (P := norm_nonneg N e). assert (Q := norm_nonneg N (mv N (perron N A mu) e)). nra.
Qed.

Lemma contracts_decay N A mu s : balanced N A -> contracts N A mu s ->
  decays_on_1perp N (mv N (perron N A mu)) 1 s.
Proof.
  intros bal [s0 H] n. rewrite Rmult_1_l. induction n as [|n IH]; intros e He; simpl; [lra|].
  rewrite Rmult_assoc. eapply Rle_trans; [apply H, zero_sum_iter; assumption|].
  apply Rmult_le_compat_l; [exact s0|apply IH, He].
Qed.

Lemma contracts_exists N A mu : exists s, contracts N A mu s.
Proof.
  destruct (mv_bounded N (perron N A mu)) as [B [B0 H]].
  exists B. split; [exact B0|]. intros e _. apply H.
Qed.

Lemma gain_bound_lt N A mu : gain_bound N A mu -> 0 < mu /\ mu * degree_max N A < 1.
Proof.
  intros [H0 H1]. split; [exact H0|].
  assert (D0 := max_lt_nonneg N (degree N A)). fold (degree_max N A) in D0.
  destruct (Req_dec (degree_max N A) 0) as [Z|Z]; [rewrite Z; lra|].
  replace 1 with (1 / degree_max N A * degree_max N A) by (field; exact Z).
  apply Rmult_lt_compat_r; lra.
Qed.

(** Under Assumption 1 and mu D < 1, P is a strict contraction on 1perp. *)
Lemma strict_contraction N A mu : assumption1 N A -> 0 < mu -> mu * degree_max N A < 1 ->
  exists s, s < 1 /\ contracts N A mu s.
Proof.
  intros H1 Hm HD. destruct (form_lower_bound N A H1) as [kappa [Hk H]].
  destruct H1 as [dig [_ bal]].
  set (s2 := 1 - 2 * mu * kappa * (1 - mu * degree_max N A)).
  assert (S1 : s2 < 1).
  { unfold s2. assert (0 < mu * kappa * (1 - mu * degree_max N A)); [|lra].
    apply Rmult_lt_0_compat; [nra|lra]. }
  exists (sqrt (Rmax 0 s2)). split.
  - rewrite <- sqrt_1. apply sqrt_lt_1_alt. split; [apply Rmax_l|]. apply Rmax_lub_lt; lra.
  - split; [apply sqrt_pos|]. apply bounded_squared. intros e He.
    apply perron_contracts; try assumption; [lra|lra|apply H, He].
Qed.

(** The infimum of the contraction factors is one. *)
Lemma sigma_exists N A mu : exists sigma, is_sigma N A mu sigma.
Proof.
  destruct (completeness (fun y => contracts N A mu (- y))) as [l [UB LUB]].
  - exists 0. intros y [H _]. lra.
  - destruct (contracts_exists N A mu) as [s Hs]. exists (- s). rewrite Ropp_involutive. exact Hs.
  - assert (low : forall s, contracts N A mu s -> - l <= s).
    { intros s Hs. assert (- s <= l); [|lra]. apply UB. rewrite Ropp_involutive. exact Hs. }
    exists (- l). split; [|exact low]. split.
    + assert (l <= 0); [|lra]. apply LUB. intros y [H _]. lra.
    + intros e He. assert (P := norm_nonneg N e).
      destruct (Req_dec (norm N e) 0) as [Z|Z].
      * destruct (contracts_exists N A mu) as [s [_ Hs]]. specialize (Hs e He).
        rewrite Z, Rmult_0_r in *. exact Hs.
      * set (y := norm N (mv N (perron N A mu) e)).
        assert (l <= - (y / norm N e)).
        { apply LUB. intros t [_ Ht]. specialize (Ht e He). fold y in Ht.
          assert (y / norm N e <= - t); [|lra].
          apply Rmult_le_reg_r with (norm N e); [lra|].
          replace (y / norm N e * norm N e) with y by (field; exact Z). exact Ht. }
        apply Rle_trans with (y / norm N e * norm N e); [right; field; exact Z|].
        apply Rmult_le_compat_r; lra.
Qed.

(** v^T P v = (1 - mu lambda2) |v|^2 for a Fiedler vector v. *)
Lemma fiedler_perron N A mu lambda2 v : form N (laplacian_sym N A) v = lambda2 * dot N v v ->
  dot N v (mv N (perron N A mu) v) = (1 - mu * lambda2) * dot N v v.
Proof.
  rewrite form_sym. intros H.
  rewrite (dot_ext N v _ v (fun i => v i - mu * mv N (laplacian N A) v i));
    [|auto|intros; apply perron_entry; assumption].
  rewrite dot_minus_r, dot_scal_r. change (dot N v (mv N (laplacian N A) v))
    with (form N (laplacian N A) v). rewrite H. ring.
Qed.
