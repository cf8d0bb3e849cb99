(** The memory kernel of section II: powers, f(j), c_n and the resolvent r_n. *)
From Coq Require Import Reals Arith.
From Fomas Require Import Model.Vectors.
Open Scope R_scope.

(** x^a for x >= 0 and a > 0, with 0^a = 0 (Coq's [Rpower 0 a] is 1). *)
Definition rpow (x a : R) : R := if Rlt_dec 0 x then Rpower x a else 0.

(** c_n = (n+1)^alpha - n^alpha. *)
Definition ck (alpha : R) (n : nat) : R := rpow (INR n + 1) alpha - rpow (INR n) alpha.

(** f(j) = (j+1)^alpha - 2 j^alpha + (j-1)^alpha (paper: eqL2_1), meant for j >= 1. *)
Definition fk (alpha : R) (j : nat) : R :=
  rpow (INR j + 1) alpha - 2 * rpow (INR j) alpha + rpow (INR j - 1) alpha.

(** r_n: r_0 = 1 and r_n = - sum_{l=1}^{n} f(l) r_{n-l}. [resolvent_upto n]
    holds the values r_0 .. r_n. *)
Fixpoint resolvent_upto (alpha : R) (n : nat) : nat -> R :=
  match n with
  | O => fun _ => 1
  | S m => fun i =>
      if Nat.leb i m then resolvent_upto alpha m i
      else - \sum_(l < S m) (fk alpha (S l) * resolvent_upto alpha m (m - l))
  end.
Definition rk (alpha : R) (n : nat) : R := resolvent_upto alpha n n.

(** Inequality (14) [eqT2]: beta^{k+1} + sum_{l=1}^{k+1} |f(l)| <= 1 for all k >= 0. *)
Definition memory_inequality (alpha beta : R) : Prop :=
  forall k : nat, beta ^ S k + \sum_(l < S k) Rabs (fk alpha (S l)) <= 1.
