(** Gamma, the kernel's integral, and the plant at and between the samples. *)
From Coq Require Import Reals Arith Lia Lra.
From Coquelicot Require Import Coquelicot.
From Fomas Require Import Model.Vectors Model.Kernel Model.Gamma Model.Graph Model.Loop Statements.
From Fomas Require Import Facts.Sums Facts.Vectors Facts.Kernel Facts.Resolvent Facts.Gamma Facts.GammaSeries.
From Fomas Require Import Facts.Graph Facts.Loop.
Open Scope R_scope.

Theorem gamma_function : gamma_function_statement.
Proof.
  intros z Hz. split; [apply Gamma_correct|split; [apply Gamma_pos|apply Gamma_succ]]; exact Hz.
Qed.

Theorem kernel_integral_formula : kernel_integral_formula_statement.
Proof.
  intros alpha t a b Ha H. split; [apply kernel_integral_correct|apply kernel_integral_value];
    assumption.
Qed.

Theorem eqxik_1 : eqxik_1_statement.
Proof.
  intros N alpha h x0 u x Ha Hh Hx k i Hi m. split.
  - apply (plant_sample N alpha h x0 u x Ha Hh Hx k i Hi).
  - apply (plant_step N alpha h x0 u x Ha Hh Hx k i Hi).
Qed.

Theorem between_samples : between_samples_statement.
Proof.
  intros N alpha h x0 u x Ha Hh Hx k s i Hi Hs.
  apply (plant_between N alpha h x0 u x Ha Hh Hx k s i Hi Hs).
Qed.

Theorem gamma_enclosure : gamma_enclosure_statement.
Proof.
  intros z T n Hz HT. split; [apply Gamma_series_lower|apply Gamma_series_upper]; lra.
Qed.
