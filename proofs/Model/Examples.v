(** The paper's example (section IV), and a pair of agents that hear each other. *)
From Coq Require Import Reals Arith List.
From Fomas Require Import Model.Vectors Model.Loop.
Open Scope R_scope.

(** Two agents, each hearing the other. *)
Definition pair_graph : mat := fun i j => if Nat.eqb i j then 0 else 1.

(** The edges of section IV; agent i of the paper is index i - 1. *)
Definition paper_edges : list (nat * nat) :=
  ((1, 4) :: (1, 5) :: (2, 1) :: (2, 3) :: (3, 1) :: (3, 2) :: (4, 2) :: (4, 3) :: (5, 4) :: nil)%nat.
Definition paper_graph : mat := fun i j =>
  if existsb (fun e => Nat.eqb (fst e) (S i) && Nat.eqb (snd e) (S j))%bool paper_edges
  then 1 else 0.
Definition paper_alpha : R := 9 / 10.
Definition paper_gamma : R := 15 / 100.
Definition paper_h : R := 85 / 100.
Definition paper_mu : R := mu_of paper_alpha paper_gamma paper_h.
Definition of_list (l : list R) : vec := fun i => nth i l 0.
Definition paper_x0 : vec := of_list (9 / 2 :: 5 :: 6 :: 3 / 2 :: -1 :: nil).
Definition counter_x0 : vec := of_list (0 :: -1 :: -1 :: -1 :: 1 :: nil).
