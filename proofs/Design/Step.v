(** The paper's step, where it is true: beta-contraction from one factor at t >= mu, or from the
    ends of the spectrum of a symmetric graph. *)
From Coq Require Import Reals ZArith List Bool Lia Lra.
From Fomas Require Import Model.Vectors Model.Graph Statements Facts.Sums Facts.Vectors Facts.Graph.
From Fomas Require Import Results.Soundness Results.Step Design.Integers Design.Weights Design.Claims.
Open Scope R_scope.

Definition beta_contraction (N : nat) (A : mat) (mu : R) : Prop := forall lambda2,
  is_lambda2 N A lambda2 -> bounded_on_1perp N (mv N (perron N A mu)) (1 - mu * lambda2).

Lemma contracts_at_zero N A : contracts N A 0 1.
Proof.
  split; [lra|]. intros e He. right. rewrite Rmult_1_l. apply norm_ext. intros i Hi.
  rewrite perron_entry by exact Hi. ring.
Qed.

(** sigma(t) <= 1 - t theta with theta >= lambda2; sigma(0) = 1, and sigma is convex. *)
Lemma factor_step N A mu t s theta : 0 < mu <= t -> contracts N A t s -> s = 1 - t * theta ->
  (forall lambda2, is_lambda2 N A lambda2 -> lambda2 <= theta) -> beta_contraction N A mu.
Proof.
  intros Hmu C Es U lambda2 Hl e He. specialize (U lambda2 Hl). set (k := mu / t).
  assert (K : 0 <= k <= 1).
  { unfold k. split; [apply Rle_mult_inv_pos; lra|]. apply Rmult_le_reg_r with t; [lra|].
    unfold Rdiv. rewrite Rmult_assoc, Rinv_l by lra. lra. }
  assert (E := sigma_convex N A 0 t 1 s k K (contracts_at_zero N A) C).
  replace ((1 - k) * 0 + k * t) with mu in E by (unfold k; field; lra).
  replace ((1 - k) * 1 + k * s) with (1 - mu * theta) in E by (rewrite Es; unfold k; field; lra).
  eapply Rle_trans; [apply E, He|]. apply Rmult_le_compat_r; [apply norm_nonneg|]. nra.
Qed.

Definition symmetric_weights (N : nat) (W : zmat) : bool :=
  below N (fun i => below N (fun j => entry W i j =? entry W j i)%Z).

Lemma symmetric_step_sound N W d mu t s r : (2 <= N)%nat -> symmetric_weights N W = true ->
  0 < mu <= t -> (forall x, zero_sum N x ->
    form N (laplacian_sym N (weighted W d)) x <= r * dot N x x) -> 0 <= s + r ->
  (forall lambda2, is_lambda2 N (weighted W d) lambda2 -> 0 <= lambda2 <= s) ->
  t * s <= 1 -> t * (s + r) <= 2 -> beta_contraction N (weighted W d) mu.
Proof.
  intros HN Sy Hmu Hr Hsr U T1 T2 lambda2 Hl. specialize (U lambda2 Hl).
  apply (symmetric_step N (weighted W d) mu lambda2 r HN (proj1 Hmu)); [|exact Hl|exact Hr| |].
  - intros i j Hi Hj. apply (below_true N _ Sy) in Hi. apply (below_true N _ Hi), Z.eqb_eq in Hj.
    unfold weighted. rewrite Hj. reflexivity.
  - apply Rle_trans with (t * s); [|exact T1]. apply Rmult_le_compat; lra.
  - apply Rle_trans with (t * (s + r)); [|exact T2].
    apply Rle_trans with (mu * (s + r)); [apply Rmult_le_compat_l; lra|apply Rmult_le_compat_r; lra].
Qed.
