(** Balanced graphs: lambda2, the contraction of P on 1perp, its eigenvalues. *)
From Coq Require Import Reals Arith List.
From Coquelicot Require Import Coquelicot.
From Fomas Require Import Model.Vectors Model.Kernel Model.Gamma Model.Graph Model.Loop.
Open Scope R_scope.

(** x^T L_s x = x^T L x = (1/2) sum_ij a_ij (x_i - x_j)^2. *)
Definition quadratic_form_statement : Prop := forall N A x, balanced N A ->
  form N (laplacian_sym N A) x = form N (laplacian N A) x /\
  form N (laplacian_sym N A) x =
    / 2 * \sum_(i < N) \sum_(j < N) (A i j * (x i - x j) ^ 2).

(** ||L x||^2 <= 2 D x^T L_s x. *)
Definition laplacian_norm_bound_statement : Prop := forall N A x, digraph N A -> balanced N A ->
  norm N (mv N (laplacian N A) x) ^ 2
  <= 2 * degree_max N A * form N (laplacian_sym N A) x.

(** 1^T L = 0: L maps into 1perp, and P keeps the sum (so the mean) of a vector. *)
Definition invariant_mean_statement : Prop := forall N A mu x, balanced N A ->
  zero_sum N (mv N (laplacian N A) x) /\
  sum_lt N (mv N (perron N A mu) x) = sum_lt N x.

(** lambda2 exists on every graph with N >= 2 and is unique; on a balanced graph it is an
    eigenvalue of L_s with eigenvector in 1perp and the least such. *)
Definition lambda2_exists_statement : Prop := forall N A, (2 <= N)%nat ->
  (exists lambda2, is_lambda2 N A lambda2) /\
  (forall s t, is_lambda2 N A s -> is_lambda2 N A t -> s = t).
Definition lambda2_eigenvalue_statement : Prop := forall N A lambda2,
  balanced N A -> is_lambda2 N A lambda2 ->
  (exists v, zero_sum N v /\ 0 < dot N v v /\
     forall i, (i < N)%nat -> mv N (laplacian_sym N A) v i = lambda2 * v i) /\
  (forall v s, zero_sum N v -> 0 < dot N v v ->
     (forall i, (i < N)%nat -> mv N (laplacian_sym N A) v i = s * v i) -> lambda2 <= s).

(** Strong connectivity gives lambda2 > 0. *)
Definition lambda2_positive_statement : Prop := forall N A, assumption1 N A ->
  (exists kappa, 0 < kappa /\ forall x, zero_sum N x ->
     kappa * dot N x x <= form N (laplacian_sym N A) x) /\
  (forall lambda2, is_lambda2 N A lambda2 -> 0 < lambda2).

(** sigma exists and |beta| <= sigma: beta is a lower bound of the contraction factor. *)
Definition sigma_ge_beta_statement : Prop := forall N A mu,
  (exists sigma, is_sigma N A mu sigma) /\
  (forall lambda2 sigma, balanced N A -> is_lambda2 N A lambda2 -> is_sigma N A mu sigma ->
     Rabs (1 - mu * lambda2) <= sigma).

(** For 0 < mu <= 1/D: sigma^2 <= betahat^2 = 1 - 2 mu lambda2 (1 - mu D), and under (15)
    betahat < 1 on a strongly connected graph. *)
Definition betahat_statement : Prop := forall N A mu lambda2 sigma,
  digraph N A -> balanced N A -> is_lambda2 N A lambda2 -> is_sigma N A mu sigma ->
  0 < mu -> mu * degree_max N A <= 1 ->
  let betahat2 := 1 - 2 * mu * lambda2 * (1 - mu * degree_max N A) in
  sigma ^ 2 <= betahat2 /\
  (strongly_connected N A -> mu * degree_max N A < 1 -> betahat2 < 1).

(** * Eigenvalues of P *)

(** 1 is a simple eigenvalue of P and every other eigenvalue a + b i, with eigenvector
    x + y i, has modulus below 1. Simple: (P - I)^2 x = 0 only for multiples of the vector of
    ones. *)
Definition perron_spectrum (N : nat) (A : mat) (mu : R) : Prop :=
  let P := mv N (perron N A mu) in
  (forall i, (i < N)%nat -> P ones i = 1) /\
  (forall x, (forall i, (i < N)%nat -> P (P x) i - 2 * P x i + x i = 0) ->
     forall i, (i < N)%nat -> x i = x 0%nat) /\
  (forall a b x y, 0 < dot N x x + dot N y y ->
     (forall i, (i < N)%nat -> P x i = a * x i - b * y i) ->
     (forall i, (i < N)%nat -> P y i = b * x i + a * y i) ->
     ~ (a = 1 /\ b = 0) -> a ^ 2 + b ^ 2 < 1).

(** Perron: (15) and Assumption 1 suffice for it. *)
Definition perron_eigenvalues_statement : Prop := forall N A mu,
  (2 <= N)%nat -> assumption1 N A -> gain_bound N A mu -> perron_spectrum N A mu.

(** For an eigenvalue lambda = a + b i of P other than 1, with nu = (1 - lambda)/mu:
    |nu|^2 <= 2 D Re nu (Gershgorin: |lambda - (1 - mu D)| <= mu D), Re lambda <= beta, and
    |lambda| <= s for every contraction factor s. *)
Definition eigenvalue_bounds_statement : Prop := forall N A mu lambda2 s a b x y,
  digraph N A -> balanced N A -> is_lambda2 N A lambda2 -> 0 < mu -> contracts N A mu s ->
  let P := mv N (perron N A mu) in
  0 < dot N x x + dot N y y ->
  (forall i, (i < N)%nat -> P x i = a * x i - b * y i) ->
  (forall i, (i < N)%nat -> P y i = b * x i + a * y i) ->
  ~ (a = 1 /\ b = 0) ->
  ((1 - a) / mu) ^ 2 + (b / mu) ^ 2 <= 2 * degree_max N A * ((1 - a) / mu) /\
  (a - (1 - mu * degree_max N A)) ^ 2 + b ^ 2 <= (mu * degree_max N A) ^ 2 /\
  a <= 1 - mu * lambda2 /\
  a ^ 2 + b ^ 2 <= s ^ 2.
