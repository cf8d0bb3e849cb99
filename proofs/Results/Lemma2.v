(** Lemma 2 of the paper. *)
From Coq Require Import Reals Arith Lia Lra.
From Coquelicot Require Import Coquelicot.
From Fomas Require Import Model.Vectors Model.Kernel Statements Facts.Sums Facts.Kernel.
Open Scope R_scope.

Theorem lemma2 : lemma2_statement.
Proof.
  intros alpha Ha. split.
  - intros [|j] Hj; [lia|]. assert (N := fk_neg alpha Ha j).
    assert (E := fk_abs alpha Ha j). assert (P := ck_pos alpha Ha (S j)).
    assert (B := ck_le_1 alpha Ha j). assert (D := fk_decreasing alpha Ha j).
    repeat split; auto; rewrite ?E; lra || (rewrite <- E; apply Rabs_pos_lt; lra).
  - apply is_lim_seq_incr_1. apply is_lim_seq_ext with (fun n => ck alpha n - ck alpha (S n)).
    + intros n. symmetry. apply fk_abs, Ha.
    + replace (Finite 0) with (Finite (0 - 0)) by (f_equal; ring).
      apply is_lim_seq_minus'; [|apply -> is_lim_seq_incr_1]; apply ck_lim, Ha.
Qed.
