(** The headline statements, without proofs. Each [foo_statement] is proved as
    [Theorem foo : foo_statement] in Results/ or Instances/; what is not proved is listed as
    open in index.toml. Labels such as eqT2 are the paper's. *)
(** The memory kernel, (14) [eqT2] in closed form, the resolvent. *)
From Fomas Require Export Statements.Kernel.
(** The plant, the controller, the closed loop: eqxi1_1 to eqxik_3. *)
From Fomas Require Export Statements.Loop.
(** Balanced graphs: lambda2, contraction, the eigenvalues of P. *)
From Fomas Require Export Statements.Balanced.
(** The conclusions of Theorem 1: boundedness and consensus. *)
From Fomas Require Export Statements.Consensus.
(** What eqL3 needs. *)
From Fomas Require Export Statements.NormBound.
(** Where the paper's proof fails. *)
From Fomas Require Export Statements.Paper.
(** Soundness of the exact tests, and the coordinates in which they are made. *)
From Fomas Require Export Statements.Tests.
