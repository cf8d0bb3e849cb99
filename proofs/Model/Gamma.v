(** Euler's Gamma function as its integral, and the kernel of the fractional integral. *)
From Coq Require Import Reals.
From Coquelicot Require Import Coquelicot.
Open Scope R_scope.

(** Gamma z = integral over (0, oo) of t^(z-1) e^(-t) dt. *)
Definition Gamma_integrand (z t : R) : R := Rpower t (z - 1) * exp (- t).
Definition Gamma (z : R) : R :=
  RInt_gen (Gamma_integrand z) (at_right 0) (Rbar_locally p_infty).

(** The integral of (t - tau)^(alpha-1) for tau over (a, b), a < b <= t; improper
    at b when b = t. *)
Definition kernel_integral (alpha t a b : R) : R :=
  RInt_gen (fun tau => Rpower (t - tau) (alpha - 1)) (at_point a) (at_left b).

(** The series of the incomplete Gamma function, n terms:
    sum_{k<n} T^k / (z (z+1) ... (z+k)), and the bound of what it leaves out. *)
Fixpoint gamma_series (n : nat) (z T : R) : R :=
  match n with O => 0 | S m => (1 + T * gamma_series m (z + 1) T) / z end.
Fixpoint gamma_remainder (n : nat) (z T : R) : R :=
  match n with O => / z | S m => T * gamma_remainder m (z + 1) T / z end.
