(** c_n is log-convex. *)
From Coq Require Import Reals Arith Lia Lra.
From Coquelicot Require Import Coquelicot.
From Fomas Require Import Model.Vectors Model.Kernel Statements Facts.Sums Facts.Kernel.
Open Scope R_scope.

Theorem log_convexity : log_convexity_statement.
Proof.
  intros alpha Ha. repeat split.
  - intros n. assert (H := ck_log_convex alpha Ha n). simpl. lra.
  - intros n k m H. assert (R := ck_ratio_le_gen alpha Ha n k m H).
    assert (Pn := ck_pos alpha Ha n). assert (Pk := ck_pos alpha Ha k).
    apply Rmult_le_reg_r with (ck alpha n * ck alpha k); [nra|].
    replace (ck alpha (n + m) / ck alpha n * (ck alpha n * ck alpha k))
      with (ck alpha (n + m) * ck alpha k) by (field; lra).
    replace (ck alpha (k + m) / ck alpha k * (ck alpha n * ck alpha k))
      with (ck alpha n * ck alpha (k + m)) by (field; lra).
    exact R.
  - intros m n. apply ck_supermult, Ha.
Qed.
