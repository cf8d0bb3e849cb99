(** Inequality (14) [eqT2] in closed form. *)
From Coq Require Import Reals Arith Lia Lra.
From Coquelicot Require Import Coquelicot.
From Fomas Require Import Model.Vectors Model.Kernel Statements Facts.Sums Facts.Kernel.
Open Scope R_scope.

(** By telescoping, (14) at k reads beta^(k+1) <= c_(k+1). *)
Lemma memory_inequality_ck alpha beta : 0 < alpha < 1 ->
  (memory_inequality alpha beta <-> forall n, beta ^ S n <= ck alpha (S n)).
Proof.
  intros Ha. unfold memory_inequality.
  split; intros H k; specialize (H k); rewrite fk_sum in * by exact Ha; lra.
Qed.

Theorem eqT2_closed_form : eqT2_closed_form_statement.
Proof.
  intros alpha beta Ha. rewrite memory_inequality_ck, <- ck_1, <- ck_2 by exact Ha.
  assert (P2 := ck_pos alpha Ha 2). split.
  - intros H. assert (H0 := H 0%nat). assert (H1 := H 1%nat). simpl in H0, H1. split; [|lra].
    apply Rnot_lt_le. intros C. assert (Q := sqrt_pos (ck alpha 2)).
    assert (S2 := sqrt_sqrt (ck alpha 2) ltac:(lra)). nra.
  - intros [L U] n. destruct (Rle_dec 0 beta) as [Z|Z].
    + replace (S n) with (S n * 1)%nat at 2 by lia. apply ck_pow; assumption.
    + assert (B : beta * beta <= ck alpha 2).
      { rewrite <- (sqrt_sqrt (ck alpha 2)) by lra. nra. }
      destruct (Nat.Even_or_Odd (S n)) as [[m E]|[m E]]; rewrite E.
      * rewrite pow_mult. rewrite (Nat.mul_comm 2 m).
        replace (beta ^ 2) with (beta * beta) by ring. apply ck_pow; [exact Ha|nra|exact B].
      * rewrite pow_add, pow_mult, pow_1.
        assert (0 <= (beta ^ 2) ^ m) by (apply pow_le, pow2_ge_0).
        assert (P := ck_pos alpha Ha (2 * m + 1)). nra.
Qed.

Theorem eqT2_first_sample : eqT2_first_sample_statement.
Proof.
  intros alpha mu lambda2 Ha Hb. rewrite (eqT2_closed_form alpha _ Ha).
  assert (Q := sqrt_pos (Rpower 3 alpha - Rpower 2 alpha)). split; lra.
Qed.
