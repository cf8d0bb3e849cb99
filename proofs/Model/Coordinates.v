(** Coordinates in which the tests are made, for N = n + 1 agents: the basis V = [I; -1^T] of
    1perp and the differences C x from the last agent. *)
From Coq Require Import Reals Arith.
From Fomas Require Import Model.Vectors Model.Graph.
Open Scope R_scope.

(** V y: the entries of y, and minus their sum. *)
Definition embed (n : nat) (y : vec) : vec :=
  fun i => if Nat.eqb i n then - sum_lt n y else y i.

(** C x, C = [I, -1]. *)
Definition differences (n : nat) (x : vec) : vec := fun i => x i - x n.

(** V^T M V, and M^T M. *)
Definition on_basis (n : nat) (M : mat) : mat := fun i j => M i j - M i n - M n j + M n n.
Definition gram (N : nat) (M : mat) : mat := fun i j => \sum_(k < N) (M k i * M k j).

(** Lc and Pc(t) = I - t Lc: L and I - t L as they act on the differences. *)
Definition differences_laplacian (n : nat) (A : mat) : mat :=
  fun i j => laplacian (S n) A i j - laplacian (S n) A n j.
Definition differences_step (n : nat) (A : mat) (t : R) : mat :=
  fun i j => id_mat i j - t * differences_laplacian n A i j.

Definition symmetric (n : nat) (Q : mat) : Prop :=
  forall i j, (i < n)%nat -> (j < n)%nat -> Q i j = Q j i.
Definition positive_definite (n : nat) (Q : mat) : Prop :=
  forall y, 0 < dot n y y -> 0 < form n Q y.
Definition positive_semidefinite (n : nat) (Q : mat) : Prop := forall y, 0 <= form n Q y.

(** Q - M^T Q M. *)
Definition stein_form (n : nat) (Q M : mat) : mat :=
  fun i j => Q i j - \sum_(k < n) (M k i * \sum_(l < n) (Q k l * M l j)).
