(** Where the paper's proof fails: its example (section IV), its step, its region. *)
From Coq Require Import Reals Arith List.
From Coquelicot Require Import Coquelicot.
From Fomas Require Import Model.Vectors Model.Kernel Model.Gamma Model.Graph Model.Loop Model.Examples.
Open Scope R_scope.

Definition gamma_19_statement : Prop := 955 / 1000 <= Gamma (19 / 10) <= 967 / 1000.

(** All hypotheses of Theorem 1 hold: Assumption 1, D = 2, lambda2 = 1, (15) and (14). *)
Definition paper_hypotheses_statement : Prop :=
  assumption1 5 paper_graph /\ degree_max 5 paper_graph = 2 /\ is_lambda2 5 paper_graph 1 /\
  gain_bound 5 paper_graph paper_mu /\
  memory_inequality paper_alpha (1 - paper_mu * 1).

(** Yet the step ||e_{k+1}|| <= beta ||e_k|| of equ1u0 and equk+1u0_1 fails: at k = 4 on the
    paper's own trajectory, and at k = 0 from x_0 = (0, -1, -1, -1, 1). *)
Definition paper_step_false_statement : Prop :=
  (forall x u,
     closed_loop 5 paper_graph paper_alpha paper_gamma paper_h paper_x0 x u ->
     (1 - paper_mu * 1) * norm 5 (error 5 paper_graph paper_h x 4)
     < norm 5 (error 5 paper_graph paper_h x 5)) /\
  (forall x u,
     closed_loop 5 paper_graph paper_alpha paper_gamma paper_h counter_x0 x u ->
     (1 - paper_mu * 1) * norm 5 (error 5 paper_graph paper_h x 0)
     < norm 5 (error 5 paper_graph paper_h x 1)).

(** So do the relations built on that step, from x_0 = (0, -1, -1, -1, 1): equ1u0; equk+1u0_1 and
    equk+1u0_2 from their first line to their last at k = 1; and the last step of equk+1u0_1 at
    k = 1 and k = 2. *)
Definition paper_chain_false_statement : Prop := forall x u,
  closed_loop 5 paper_graph paper_alpha paper_gamma paper_h counter_x0 x u ->
  let beta := 1 - paper_mu * 1 in
  let f l := Rabs (fk paper_alpha l) in
  let e k := norm 5 (error 5 paper_graph paper_h x k) in
  let U k := norm 5 (u k) in
  (beta + f 1%nat) * U 0%nat < U 1%nat /\
  paper_gamma * beta ^ 2 * e 0%nat + (f 1%nat * U 1%nat + f 2%nat * U 0%nat) < U 2%nat /\
  (beta ^ 2 + (f 1%nat + f 2%nat)) * U 0%nat < U 2%nat /\
  paper_gamma * beta ^ 2 * e 0%nat < paper_gamma * e 2%nat /\
  paper_gamma * beta ^ 3 * e 0%nat < paper_gamma * e 3%nat.

(** And eqL3 fails, at k = 1, from x_0 = (0, -1, -1, -1, 1). *)
Definition paper_eqL3_false_statement : Prop :=
  (forall x u,
     closed_loop 5 paper_graph paper_alpha paper_gamma paper_h counter_x0 x u ->
     norm 5 (u 0%nat) < norm 5 (u 1%nat)) /\
  ~ control_norm_bound 5 paper_graph paper_alpha paper_gamma paper_h.

(** * The paper's step, and the paper's region *)

(** beta^2 |e|^2 - |P e|^2 = mu [2 (e^T L_s e - lambda2 |e|^2) - mu (|L e|^2 - lambda2^2 |e|^2)];
    the step ||P e|| <= beta ||e|| holds on 1perp iff beta >= 0 and the bracket is nonnegative
    there. *)
Definition step_bracket (N : nat) (A : mat) (mu lambda2 : R) (e : vec) : R :=
  2 * (form N (laplacian_sym N A) e - lambda2 * dot N e e)
  - mu * (dot N (mv N (laplacian N A) e) (mv N (laplacian N A) e) - lambda2 ^ 2 * dot N e e).
Definition step_decided_statement : Prop := forall N A mu lambda2, (2 <= N)%nat -> 0 < mu ->
  (forall e, (1 - mu * lambda2) ^ 2 * dot N e e
             - dot N (mv N (perron N A mu) e) (mv N (perron N A mu) e)
             = mu * step_bracket N A mu lambda2 e) /\
  (bounded_on_1perp N (mv N (perron N A mu)) (1 - mu * lambda2) <->
   0 <= 1 - mu * lambda2 /\ forall e, zero_sum N e -> 0 <= step_bracket N A mu lambda2 e).

(** On a symmetric graph it holds where mu lambda2 <= 1 and mu (lambda2 + r) <= 2, r at least
    every eigenvalue of L. *)
Definition symmetric_step_statement : Prop := forall N A mu lambda2 r, (2 <= N)%nat -> 0 < mu ->
  (forall i j, (i < N)%nat -> (j < N)%nat -> A i j = A j i) -> is_lambda2 N A lambda2 ->
  (forall x, zero_sum N x -> form N (laplacian_sym N A) x <= r * dot N x x) ->
  mu * lambda2 <= 1 -> mu * (lambda2 + r) <= 2 ->
  bounded_on_1perp N (mv N (perron N A mu)) (1 - mu * lambda2).

(** Where a Fiedler vector of L_s is no eigenvector of L, the step fails for every mu > 0:
    no choice of gain and period repairs it on that graph. *)
Definition step_fails_statement : Prop := forall N A mu lambda2 v,
  is_lambda2 N A lambda2 -> 0 < mu -> zero_sum N v ->
  form N (laplacian_sym N A) v = lambda2 * dot N v v ->
  (exists i, (i < N)%nat /\ mv N (laplacian N A) v i <> lambda2 * v i) ->
  ~ bounded_on_1perp N (mv N (perron N A mu)) (1 - mu * lambda2).

(** The region of (14) in mu, and when it meets (15): iff lambda2 > D (2 - 2^alpha). *)
Definition region_as_stated_statement : Prop := forall alpha lambda2 D,
  0 < alpha < 1 -> 0 < lambda2 -> 0 < D ->
  (forall mu, memory_inequality alpha (1 - mu * lambda2) <->
     (2 - Rpower 2 alpha) / lambda2 <= mu
     <= (1 + sqrt (Rpower 3 alpha - Rpower 2 alpha)) / lambda2) /\
  ((exists mu, 0 < mu < 1 / D /\ memory_inequality alpha (1 - mu * lambda2)) <->
   D * (2 - Rpower 2 alpha) < lambda2).

(** The memory-free law u_k = -gamma L x_k on the same plant:
    x_{k+1} = x_0 - mu sum_{j<=k} c_{k-j} L x_j. *)
Definition memoryless_law_statement : Prop := forall N A alpha gamma h x0 x u,
  design alpha gamma h -> plant N alpha h x0 u x ->
  (forall k i, (i < N)%nat -> u k i = - gamma * error N A h x k i) ->
  forall k i, (i < N)%nat ->
  x (INR (S k) * h) i
  = x0 i - mu_of alpha gamma h * \sum_(j < S k) (ck alpha (k - j) * error N A h x j i).
