(** The resolvent of the kernel. *)
From Coq Require Import Reals Arith Lia Lra.
From Coquelicot Require Import Coquelicot.
From Fomas Require Import Model.Vectors Model.Kernel Statements Facts.Sums Facts.Kernel.
Open Scope R_scope.

From Fomas Require Import Facts.Resolvent.

Theorem kaluza : kaluza_statement.
Proof.
  intros alpha Ha. split; [apply rk_0|].
  split; [intros n; rewrite rk_S; ring|].
  split; [apply ck_rk_sum|].
  split; [intros n; split; [apply rk_pos|apply rk_le_1]; exact Ha|].
  split; [intros n; left; apply rk_decreasing, Ha|].
  split; [intros n; apply rk_bound, Ha|apply rk_lim, Ha].
Qed.
