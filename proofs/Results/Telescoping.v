(** The kernel's absolute values sum to 1 - c_n, and in all to 1. *)
From Coq Require Import Reals Arith Lia Lra.
From Coquelicot Require Import Coquelicot.
From Fomas Require Import Model.Vectors Model.Kernel Statements Facts.Sums Facts.Kernel.
Open Scope R_scope.

Lemma sum_n_sum_lt (a : nat -> R) n : sum_n a n = sum_lt (S n) a.
Proof.
  induction n as [|n IH]; [rewrite sum_O; simpl; ring|].
  rewrite sum_Sn, IH. reflexivity.
Qed.

Theorem telescoping : telescoping_statement.
Proof.
  intros alpha Ha. split; [apply fk_sum, Ha|].
  split; [intros n; split; [apply ck_pos|apply ck_lt]; exact Ha|].
  split; [apply ck_lim, Ha|].
  change (is_lim_seq (sum_n (fun l => Rabs (fk alpha (S l)))) 1).
  apply is_lim_seq_ext with (fun n => 1 - ck alpha (S n)).
  - intros n. rewrite sum_n_sum_lt, fk_sum by exact Ha. reflexivity.
  - replace (Finite 1) with (Finite (1 - 0)) by (f_equal; ring).
    apply is_lim_seq_minus'; [apply is_lim_seq_const|].
    apply -> is_lim_seq_incr_1. apply ck_lim, Ha.
Qed.
