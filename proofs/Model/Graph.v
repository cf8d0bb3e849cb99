(** The communication graph, its Laplacian, and Assumption 1. *)
From Coq Require Import Reals Arith.
From Fomas Require Import Model.Vectors.
Open Scope R_scope.

(** A is a connectivity matrix: a_ij >= 0 (any weight; the paper has 0 and 1), a_ii = 0. *)
Definition digraph (N : nat) (A : mat) : Prop :=
  (forall i j, (i < N)%nat -> (j < N)%nat -> 0 <= A i j) /\
  (forall i, (i < N)%nat -> A i i = 0).

(** Row sum, and the paper's Delta_max, written D. *)
Definition degree (N : nat) (A : mat) (i : nat) : R := \sum_(j < N) A i j.
Fixpoint max_lt (n : nat) (F : nat -> R) : R :=
  match n with O => 0 | S m => Rmax (max_lt m F) (F m) end.
Definition degree_max (N : nat) (A : mat) : R := max_lt N (degree N A).

(** L = diag(A 1) - A, its symmetric part L_s, and P = I - mu L. *)
Definition laplacian (N : nat) (A : mat) : mat :=
  fun i j => (if Nat.eqb i j then degree N A i else 0) - A i j.
Definition laplacian_sym (N : nat) (A : mat) : mat :=
  fun i j => (laplacian N A i j + laplacian N A j i) / 2.
Definition perron (N : nat) (A : mat) (mu : R) : mat :=
  fun i j => id_mat i j - mu * laplacian N A i j.

(** [reaches N A i j]: a directed path leads from agent i to agent j; an edge
    from i to j means a_ji > 0 (j hears i). *)
Inductive reaches (N : nat) (A : mat) (i : nat) : nat -> Prop :=
| reaches_self : reaches N A i i
| reaches_edge : forall j k, reaches N A i j -> (j < N)%nat -> (k < N)%nat ->
    0 < A k j -> reaches N A i k.

Definition strongly_connected (N : nat) (A : mat) : Prop :=
  forall i j, (i < N)%nat -> (j < N)%nat -> reaches N A i j.
Definition balanced (N : nat) (A : mat) : Prop :=
  forall i, (i < N)%nat -> \sum_(j < N) A i j = \sum_(j < N) A j i.

(** Assumption 1. *)
Definition assumption1 (N : nat) (A : mat) : Prop :=
  digraph N A /\ strongly_connected N A /\ balanced N A.

(** lambda2, the second smallest eigenvalue of L_s of a balanced graph, by its
    Rayleigh quotient: the minimum of x^T L_s x / x^T x over the nonzero x of 1perp. *)
Definition is_lambda2 (N : nat) (A : mat) (lambda2 : R) : Prop :=
  (forall x, zero_sum N x -> lambda2 * dot N x x <= form N (laplacian_sym N A) x) /\
  (exists v, zero_sum N v /\ 0 < dot N v v /\
             form N (laplacian_sym N A) v = lambda2 * dot N v v).

(** sigma, the norm of P restricted to 1perp: the least contraction factor. *)
Definition contracts (N : nat) (A : mat) (mu s : R) : Prop :=
  0 <= s /\ bounded_on_1perp N (mv N (perron N A mu)) s.
Definition is_sigma (N : nat) (A : mat) (mu sigma : R) : Prop :=
  contracts N A mu sigma /\ (forall s, contracts N A mu s -> sigma <= s).
