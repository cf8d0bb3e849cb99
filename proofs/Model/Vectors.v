(** Vectors, matrices and finite sums.

    A vector of dimension N is a function [nat -> R] read at 0..N-1, a matrix a
    function of two indices read below N; nothing outside that range matters.
    Agent i of the paper is index i - 1 here. *)
From Coq Require Import Reals Arith.
Open Scope R_scope.

Definition vec := nat -> R.
Definition mat := nat -> nat -> R.

(** [sum_lt n F] = F 0 + ... + F (n - 1). *)
Fixpoint sum_lt (n : nat) (F : nat -> R) : R :=
  match n with O => 0 | S m => sum_lt m F + F m end.

Notation "\sum_ ( i < n ) F" := (sum_lt n (fun i => F))
  (at level 35, F at level 35, i at level 0, n at level 50,
   format "\sum_ ( i  <  n )  F") : R_scope.

(** Inner product and Euclidean norm. *)
Definition dot (N : nat) (x y : vec) : R := \sum_(i < N) (x i * y i).
Definition norm (N : nat) (x : vec) : R := sqrt (dot N x x).

(** Matrix times vector, and the identity matrix. *)
Definition mv (N : nat) (M : mat) (x : vec) : vec := fun i => \sum_(j < N) (M i j * x j).
Definition id_mat : mat := fun i j => if Nat.eqb i j then 1 else 0.

(** The k-fold application of a map. *)
Fixpoint iter (k : nat) (T : vec -> vec) (x : vec) : vec :=
  match k with O => x | S m => T (iter m T x) end.

Definition ones : vec := fun _ => 1.
Definition mean (N : nat) (x : vec) : R := sum_lt N x / INR N.

(** The subspace 1perp: the entries sum to zero. *)
Definition zero_sum (N : nat) (e : vec) : Prop := sum_lt N e = 0.

(** The norm of the map T restricted to 1perp is at most s. *)
Definition bounded_on_1perp (N : nat) (T : vec -> vec) (s : R) : Prop :=
  forall e, zero_sum N e -> norm N (T e) <= s * norm N e.

(** The powers of T on 1perp decay geometrically: ||T^n|| <= C rho^n. *)
Definition decays_on_1perp (N : nat) (T : vec -> vec) (C rho : R) : Prop :=
  forall n, bounded_on_1perp N (iter n T) (C * rho ^ n).

(** The quadratic form x^T Q x. *)
Definition form (N : nat) (Q : mat) (x : vec) : R := dot N x (mv N Q x).
