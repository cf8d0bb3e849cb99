(** The headline statements, without proofs. Each [foo_statement] is proved as
    [Theorem foo : foo_statement] in Results/ or Instances/; what is not proved
    yet is listed as open in index.toml. Labels such as eqT2 are the paper's. *)
From Coq Require Import Reals Arith List.
From Coquelicot Require Import Coquelicot.
From Fomas Require Import Model.Vectors Model.Kernel Model.Gamma Model.Graph Model.Loop Model.Examples.
Open Scope R_scope.

(** * 1. The memory kernel *)

(** Lemma 2: f(j) < 0, 0 < |f(j)| < 1, |f| strictly decreasing, limit 0. *)
Definition lemma2_statement : Prop := forall alpha, 0 < alpha < 1 ->
  (forall j, (1 <= j)%nat ->
     fk alpha j < 0 /\ 0 < Rabs (fk alpha j) < 1 /\
     Rabs (fk alpha (S j)) < Rabs (fk alpha j)) /\
  is_lim_seq (fun j => Rabs (fk alpha j)) 0.

(** sum_{l=1}^{n} |f(l)| = 1 - c_n, c_n > 0 decreases to 0, so the sum of all |f(l)| is 1. *)
Definition telescoping_statement : Prop := forall alpha, 0 < alpha < 1 ->
  (forall n, \sum_(l < n) Rabs (fk alpha (S l)) = 1 - ck alpha n) /\
  (forall n, 0 < ck alpha (S n) < ck alpha n) /\
  is_lim_seq (ck alpha) 0 /\
  is_series (fun l => Rabs (fk alpha (S l))) 1.

(** c_n^2 <= c_{n-1} c_{n+1} for n >= 1; the ratio c_{n+m}/c_n is nondecreasing in n;
    hence c_m c_n <= c_{m+n}. *)
Definition log_convexity_statement : Prop := forall alpha, 0 < alpha < 1 ->
  (forall n, ck alpha (S n) ^ 2 <= ck alpha n * ck alpha (S (S n))) /\
  (forall n k m, (n <= k)%nat ->
     ck alpha (n + m) / ck alpha n <= ck alpha (k + m) / ck alpha k) /\
  (forall m n, ck alpha m * ck alpha n <= ck alpha (m + n)).

(** (14) [eqT2] for all k holds iff -sqrt(c_2) <= beta <= c_1, with c_1 = 2^alpha - 1 and
    c_2 = 3^alpha - 2^alpha. *)
Definition eqT2_closed_form_statement : Prop := forall alpha beta, 0 < alpha < 1 ->
  (memory_inequality alpha beta <->
   - sqrt (Rpower 3 alpha - Rpower 2 alpha) <= beta <= Rpower 2 alpha - 1).

(** For beta = 1 - mu lambda2 >= 0 the sample k = 0 decides: mu lambda2 >= 2 - 2^alpha. *)
Definition eqT2_first_sample_statement : Prop := forall alpha mu lambda2, 0 < alpha < 1 ->
  0 <= 1 - mu * lambda2 ->
  (memory_inequality alpha (1 - mu * lambda2) <-> 2 - Rpower 2 alpha <= mu * lambda2).

(** Kaluza: r is the reciprocal power series of 1 + sum f(l) z^l, with r_0 = 1,
    0 < r_n <= 1, nonincreasing, limit 0, and explicitly r_n <= (n+1)^(-alpha). *)
Definition kaluza_statement : Prop := forall alpha, 0 < alpha < 1 ->
  rk alpha 0 = 1 /\
  (forall n, rk alpha (S n) + \sum_(l < S n) (fk alpha (S l) * rk alpha (n - l)) = 0) /\
  (forall n, \sum_(j < S n) (ck alpha (n - j) * rk alpha j) = 1) /\
  (forall n, 0 < rk alpha n <= 1) /\
  (forall n, rk alpha (S n) <= rk alpha n) /\
  (forall n, rk alpha n <= Rpower (INR n + 1) (- alpha)) /\
  is_lim_seq (rk alpha) 0.

(** * 2. Plant and controller *)

(** The Gamma integral converges for z > 0, is positive, and Gamma(z+1) = z Gamma(z). *)
Definition gamma_function_statement : Prop := forall z, 0 < z ->
  is_RInt_gen (Gamma_integrand z) (at_right 0) (Rbar_locally p_infty) (Gamma z) /\
  0 < Gamma z /\ Gamma (z + 1) = z * Gamma z.

(** The integral of the kernel over an interval. *)
Definition kernel_integral_formula_statement : Prop := forall alpha t a b,
  0 < alpha < 1 -> a < b <= t ->
  is_RInt_gen (fun tau => Rpower (t - tau) (alpha - 1)) (at_point a) (at_left b)
    ((rpow (t - a) alpha - rpow (t - b) alpha) / alpha) /\
  kernel_integral alpha t a b = (rpow (t - a) alpha - rpow (t - b) alpha) / alpha.

(** eqxi1_1 and eqxik_1, for any held input u: with m = h^alpha / Gamma(alpha+1),
    x_{k+1} = x_0 + m sum_{j<=k} c_{k-j} u_j = x_k + m (u_k + sum_{l=1}^{k} f(l) u_{k-l}). *)
Definition eqxik_1_statement : Prop := forall N alpha h x0 u x, 0 < alpha < 1 -> 0 < h ->
  plant N alpha h x0 u x -> forall k i, (i < N)%nat ->
  let m := rpow h alpha / Gamma (alpha + 1) in
  x (INR (S k) * h) i = x0 i + m * \sum_(j < S k) (ck alpha (k - j) * u j i) /\
  x (INR (S k) * h) i =
    x (INR k * h) i + m * (u k i + \sum_(l < k) (fk alpha (S l) * u (k - S l)%nat i)).

(** Between samples, 0 <= s <= h:
    x(kh+s) = x_0 + 1/Gamma(alpha+1) [sum_{j<k} (((k-j)h+s)^alpha - ((k-j-1)h+s)^alpha) u_j
    + s^alpha u_k]. *)
Definition between_samples_statement : Prop := forall N alpha h x0 u x,
  0 < alpha < 1 -> 0 < h -> plant N alpha h x0 u x ->
  forall k s i, (i < N)%nat -> 0 <= s <= h ->
  x (INR k * h + s) i = x0 i + / Gamma (alpha + 1) *
    (\sum_(j < k) ((rpow (INR (k - j) * h + s) alpha
                    - rpow (INR (k - j - 1) * h + s) alpha) * u j i)
     + rpow s alpha * u k i).

(** The closed loop has a solution from every initial state, and only one. *)
Definition closed_loop_exists_statement : Prop := forall N A alpha gamma h x0,
  design alpha gamma h ->
  (exists x u, closed_loop N A alpha gamma h x0 x u) /\
  (forall x u x' u', closed_loop N A alpha gamma h x0 x u ->
     closed_loop N A alpha gamma h x0 x' u' ->
     (forall k i, (i < N)%nat -> u k i = u' k i) /\
     (forall t i, (i < N)%nat -> 0 <= t -> x t i = x' t i)).

(** eqxik_2, eqTh1 and eqxik_3: x_{k+1} = x_k - mu L x_k = P x_k, agent by agent too. *)
Definition eqxik_3_statement : Prop := forall N A alpha gamma h x0 x u,
  design alpha gamma h -> closed_loop N A alpha gamma h x0 x u ->
  forall k i, (i < N)%nat ->
  let mu := mu_of alpha gamma h in
  let xk := x (INR k * h) in
  x (INR (S k) * h) i = xk i - mu * mv N (laplacian N A) xk i /\
  x (INR (S k) * h) i = mv N (perron N A mu) xk i /\
  x (INR (S k) * h) i = xk i + mu * \sum_(j < N) (A i j * (xk j - xk i)).

(** The controls: u_0 = -gamma e_0 (equ0), F * u = P^k u_0 (equ1 is k = 1),
    u_k = -gamma sum_{j<=k} r_{k-j} e_j, and u_k = Phi_k(P) u_0. *)
Definition control_resolvent_statement : Prop := forall N A alpha gamma h x0 x u,
  design alpha gamma h -> closed_loop N A alpha gamma h x0 x u ->
  forall k i, (i < N)%nat ->
  let P := perron N A (mu_of alpha gamma h) in
  u 0%nat i = - gamma * error N A h x 0 i /\
  u k i + \sum_(l < k) (fk alpha (S l) * u (k - S l)%nat i) = iter k (mv N P) (u 0%nat) i /\
  u k i = - gamma * \sum_(j < S k) (rk alpha (k - j) * error N A h x j i) /\
  u k i = Phi alpha N P k (u 0%nat) i.

(** Phi_{k+1} = P Phi_k + r_{k+1} I, and Phi_k = P^k + sum_{l=1}^{k} |f(l)| Phi_{k-l}. *)
Definition phi_recursion_statement : Prop := forall N M alpha y k i,
  0 < alpha < 1 -> (i < N)%nat ->
  Phi alpha N M (S k) y i = mv N M (Phi alpha N M k y) i + rk alpha (S k) * y i /\
  Phi alpha N M k y i = iter k (mv N M) y i
    + \sum_(l < k) (Rabs (fk alpha (S l)) * Phi alpha N M (k - S l) y i).

(** * 3. Balanced graphs and contraction *)

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

(** Repaired Theorem 1: sigma <= 2^alpha - 1 gives eqL3 for every initial state. *)
Definition theorem1_repaired_statement : Prop := forall N A alpha gamma h,
  balanced N A -> design alpha gamma h ->
  contracts N A (mu_of alpha gamma h) (Rpower 2 alpha - 1) ->
  control_norm_bound N A alpha gamma h.

(** Its closed form: under (15), betahat <= 2^alpha - 1 suffices. *)
Definition theorem1_repaired_closed_form_statement : Prop :=
  forall N A alpha gamma h lambda2,
  digraph N A -> balanced N A -> design alpha gamma h -> is_lambda2 N A lambda2 ->
  let mu := mu_of alpha gamma h in
  gain_bound N A mu ->
  1 - 2 * mu * lambda2 * (1 - mu * degree_max N A) <= (Rpower 2 alpha - 1) ^ 2 ->
  control_norm_bound N A alpha gamma h.

(** * 4. Boundedness and consensus *)

(** Under (15) and Assumption 1 alone: the controls are bounded by a multiple of ||u_0||
    and vanish, and the samples reach the average of x_0. (14) is not used. *)
Definition consensus_at_samples_statement : Prop := forall N A alpha gamma h,
  (2 <= N)%nat -> assumption1 N A -> design alpha gamma h ->
  gain_bound N A (mu_of alpha gamma h) ->
  exists B, forall x0 x u, closed_loop N A alpha gamma h x0 x u ->
  (forall k, norm N (u k) <= B * norm N (u 0%nat)) /\
  (forall i, (i < N)%nat -> is_lim_seq (fun k => u k i) 0) /\
  (forall i, (i < N)%nat -> is_lim_seq (fun k => x (INR k * h) i) (mean N x0)).

(** The same from any proof of geometric decay of P on 1perp, e.g. a Lyapunov matrix. *)
Definition consensus_from_decay_statement : Prop := forall N A alpha gamma h C rho,
  (1 <= N)%nat -> balanced N A -> design alpha gamma h -> 0 <= C -> 0 <= rho < 1 ->
  decays_on_1perp N (mv N (perron N A (mu_of alpha gamma h))) C rho ->
  forall x0 x u, closed_loop N A alpha gamma h x0 x u ->
  (forall k, norm N (u k) <= C / (1 - rho) * norm N (u 0%nat)) /\
  (forall i, (i < N)%nat -> is_lim_seq (fun k => u k i) 0) /\
  (forall i, (i < N)%nat -> is_lim (fun t => x t i) p_infty (mean N x0)).

(** Consensus in continuous time: x_i(t) -> mean of x_0, between the samples too. *)
Definition consensus_between_samples_statement : Prop := forall N A alpha gamma h,
  (2 <= N)%nat -> assumption1 N A -> design alpha gamma h ->
  gain_bound N A (mu_of alpha gamma h) ->
  forall x0 x u, closed_loop N A alpha gamma h x0 x u ->
  forall i, (i < N)%nat -> is_lim (fun t => x t i) p_infty (mean N x0).

(** Overshoot between samples: a bound M on the controls up to k bounds the move since the
    last sample. *)
Definition overshoot_statement : Prop := forall N alpha h x0 u x M k s,
  0 < alpha < 1 -> 0 < h -> plant N alpha h x0 u x -> 0 <= s <= h ->
  (forall j, (j <= k)%nat -> norm N (u j) <= M) ->
  norm N (fun i => x (INR k * h + s) i - x (INR k * h) i)
  <= 2 * rpow s alpha / Gamma (alpha + 1) * M.

(** The conclusions of the paper's Theorem 1, under the paper's hypotheses. (14) stands among
    them as the paper has it, although the proof does not need it. *)
Definition theorem1_as_stated_statement : Prop := forall N A alpha gamma h lambda2,
  (2 <= N)%nat -> assumption1 N A -> design alpha gamma h -> is_lambda2 N A lambda2 ->
  let mu := mu_of alpha gamma h in
  gain_bound N A mu -> memory_inequality alpha (1 - mu * lambda2) ->
  forall x0 x u, closed_loop N A alpha gamma h x0 x u ->
  (exists B, (forall t i, 0 <= t -> (i < N)%nat -> Rabs (x t i) <= B) /\
             (forall k i, (i < N)%nat -> Rabs (u k i) <= B)) /\
  (forall i j, (i < N)%nat -> (j < N)%nat -> is_lim (fun t => Rabs (x t i - x t j)) p_infty 0) /\
  (forall i, (i < N)%nat -> is_lim (fun t => x t i) p_infty (mean N x0)).

(** Remark 1: agents with n coordinates are n copies of the loop; eqL3 for one gives it for
    the norm over all coordinates, and consensus holds coordinate by coordinate. *)
Definition remark1_statement : Prop :=
  forall N A alpha gamma h n (x0 : nat -> vec) (x : nat -> R -> vec) (u : nat -> nat -> vec),
  (forall d, (d < n)%nat -> closed_loop N A alpha gamma h (x0 d) (x d) (u d)) ->
  control_norm_bound N A alpha gamma h -> forall k,
  sqrt (\sum_(d < n) (norm N (u d k) ^ 2)) <= sqrt (\sum_(d < n) (norm N (u d 0%nat) ^ 2)).

(** Three claims are one: for a balanced graph, if every control of the loop vanishes then
    so does P^k u_0. *)
Definition control_vanishes_converse_statement : Prop := forall N A alpha gamma h x0 x u,
  design alpha gamma h -> closed_loop N A alpha gamma h x0 x u ->
  (forall i, (i < N)%nat -> is_lim_seq (fun k => u k i) 0) ->
  forall i, (i < N)%nat ->
  is_lim_seq (fun k => iter k (mv N (perron N A (mu_of alpha gamma h))) (u 0%nat) i) 0.

(** Perron: 1 is a simple eigenvalue of P and every other eigenvalue a + b i, with
    eigenvector x + y i, has modulus below 1. Simple: (P - I)^2 x = 0 only for multiples of
    the vector of ones. *)
Definition perron_eigenvalues_statement : Prop := forall N A mu,
  (2 <= N)%nat -> assumption1 N A -> gain_bound N A mu ->
  let P := mv N (perron N A mu) in
  (forall i, (i < N)%nat -> P ones i = 1) /\
  (forall x, (forall i, (i < N)%nat -> P (P x) i - 2 * P x i + x i = 0) ->
     forall i, (i < N)%nat -> x i = x 0%nat) /\
  (forall a b x y, 0 < dot N x x + dot N y y ->
     (forall i, (i < N)%nat -> P x i = a * x i - b * y i) ->
     (forall i, (i < N)%nat -> P y i = b * x i + a * y i) ->
     ~ (a = 1 /\ b = 0) -> a ^ 2 + b ^ 2 < 1).

(** * 5. What the norm bound eqL3 needs *)

(** Peak lemma. M >= 1, ||Phi_k|| <= M for k <= K and ||P^n|| <= M c_n for n > K give
    ||Phi_k|| <= M for all k. *)
Definition peak_lemma_statement : Prop := forall N A mu alpha M K,
  0 < alpha < 1 -> 1 <= M ->
  let P := perron N A mu in
  (forall k, (k <= K)%nat -> bounded_on_1perp N (Phi alpha N P k) M) ->
  (forall n, (K < n)%nat -> bounded_on_1perp N (iter n (mv N P)) (M * ck alpha n)) ->
  forall k, bounded_on_1perp N (Phi alpha N P k) M.

(** Its second hypothesis from finitely many powers: the bound for K < n <= K + m and
    ||P^m|| <= c_{K+1+m} / c_{K+1}, m >= 1. *)
Definition peak_tail_statement : Prop := forall N A mu alpha M K m,
  0 < alpha < 1 -> 1 <= M -> (1 <= m)%nat -> balanced N A ->
  let P := perron N A mu in
  (forall n, (K < n <= K + m)%nat -> bounded_on_1perp N (iter n (mv N P)) (M * ck alpha n)) ->
  bounded_on_1perp N (iter m (mv N P)) (ck alpha (K + 1 + m) / ck alpha (K + 1)) ->
  forall n, (K < n)%nat -> bounded_on_1perp N (iter n (mv N P)) (M * ck alpha n).

(** The peak is attained early: where P decays on 1perp there is K such that any bound
    M >= 1 of Phi_0 .. Phi_K bounds every Phi_k. *)
Definition peak_attained_statement : Prop := forall N A mu alpha C rho,
  0 < alpha < 1 -> 0 <= C -> 0 <= rho < 1 ->
  let P := perron N A mu in
  decays_on_1perp N (mv N P) C rho ->
  exists K, forall M, 1 <= M ->
  (forall k, (k <= K)%nat -> bounded_on_1perp N (Phi alpha N P k) M) ->
  forall k, bounded_on_1perp N (Phi alpha N P k) M.

(** eqL3 from ||P^n|| <= c_n for all n >= 1. *)
Definition eqL3_from_powers_statement : Prop := forall N A alpha gamma h,
  balanced N A -> design alpha gamma h ->
  let P := perron N A (mu_of alpha gamma h) in
  (forall n, (1 <= n)%nat -> bounded_on_1perp N (iter n (mv N P)) (ck alpha n)) ->
  control_norm_bound N A alpha gamma h.

(** eqL3 for every x_0 is the same as ||Phi_k restricted to 1perp|| <= 1 for all k. *)
Definition eqL3_characterised_statement : Prop := forall N A alpha gamma h,
  (2 <= N)%nat -> assumption1 N A -> design alpha gamma h ->
  (control_norm_bound N A alpha gamma h <->
   forall k, bounded_on_1perp N (Phi alpha N (perron N A (mu_of alpha gamma h)) k) 1).

(** eqL3 implies beta <= 2^alpha - 1, the sample k = 0 of (14); so all of (14) where
    beta >= -sqrt(c_2). *)
Definition eqL3_needs_eqT2_statement : Prop := forall N A alpha gamma h lambda2,
  (2 <= N)%nat -> assumption1 N A -> design alpha gamma h -> is_lambda2 N A lambda2 ->
  control_norm_bound N A alpha gamma h ->
  let beta := 1 - mu_of alpha gamma h * lambda2 in
  beta <= Rpower 2 alpha - 1 /\
  (- sqrt (Rpower 3 alpha - Rpower 2 alpha) <= beta -> memory_inequality alpha beta).

(** Where beta < -sqrt(c_2), (14) is not necessary for eqL3: on two agents that hear each
    other, D = 1 and lambda2 = 2, eqL3 holds for every mu from 1/2 to 1, and (14) fails for
    those with 1 - 2 mu < -sqrt(c_2). *)
Definition eqT2_not_necessary_statement : Prop := forall alpha gamma h,
  design alpha gamma h -> let mu := mu_of alpha gamma h in
  / 2 <= mu <= 1 ->
  assumption1 2 pair_graph /\ degree_max 2 pair_graph = 1 /\ is_lambda2 2 pair_graph 2 /\
  control_norm_bound 2 pair_graph alpha gamma h /\
  (1 - mu * 2 < - sqrt (Rpower 3 alpha - Rpower 2 alpha) ->
   ~ memory_inequality alpha (1 - mu * 2)).

(** * 6. The paper's example *)

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

(** And eqL3 fails, at k = 1, from x_0 = (0, -1, -1, -1, 1). *)
Definition paper_eqL3_false_statement : Prop :=
  (forall x u,
     closed_loop 5 paper_graph paper_alpha paper_gamma paper_h counter_x0 x u ->
     norm 5 (u 0%nat) < norm 5 (u 1%nat)) /\
  ~ control_norm_bound 5 paper_graph paper_alpha paper_gamma paper_h.

(** * 7. Soundness of the exact tests *)

(** LDL^T with positive pivots: positive definite. [lower] is unit lower triangular. *)
Definition unit_lower (N : nat) (T : mat) : Prop :=
  forall i j, (i < N)%nat -> (j < N)%nat ->
  (i = j -> T i j = 1) /\ ((i < j)%nat -> T i j = 0).
Definition ldlt_statement : Prop := forall N Q T d, unit_lower N T ->
  (forall i j, (i < N)%nat -> (j < N)%nat ->
     Q i j = \sum_(k < N) (T i k * d k * T j k)) ->
  ((forall i, (i < N)%nat -> 0 < d i) -> forall x, 0 < dot N x x -> 0 < form N Q x) /\
  ((forall i, (i < N)%nat -> 0 <= d i) -> forall x, 0 <= form N Q x).

(** Factor with residual: Q - eps I = R R^T + E, E symmetric with ||E||_inf <= eps, gives
    Q >= 0. *)
Definition residual_factor_statement : Prop := forall N n Q R E eps,
  (forall i j, (i < N)%nat -> (j < N)%nat ->
     Q i j - eps * id_mat i j = \sum_(k < n) (R i k * R j k) + E i j) ->
  (forall i j, (i < N)%nat -> (j < N)%nat -> E i j = E j i) ->
  (forall i, (i < N)%nat -> \sum_(j < N) Rabs (E i j) <= eps) ->
  forall x, 0 <= form N Q x.

(** Convexity: for Q >= 0, the set of maps T with T^T Q T <= rho2 Q is convex; so both ends of
    an interval of mu suffice, and the vertices of a set of graphs. *)
Definition convexity_statement : Prop := forall N Q T1 T2 rho2 theta,
  (forall i j, (i < N)%nat -> (j < N)%nat -> Q i j = Q j i) ->
  (forall x, zero_sum N x -> 0 <= form N Q x) -> 0 <= theta <= 1 ->
  (forall x, zero_sum N x -> zero_sum N (mv N T1 x)) ->
  (forall x, zero_sum N x -> zero_sum N (mv N T2 x)) ->
  (forall x, zero_sum N x -> form N Q (mv N T1 x) <= rho2 * form N Q x) ->
  (forall x, zero_sum N x -> form N Q (mv N T2 x) <= rho2 * form N Q x) ->
  let T := fun i j => (1 - theta) * T1 i j + theta * T2 i j in
  forall x, zero_sum N x -> form N Q (mv N T x) <= rho2 * form N Q x.
Definition convexity_in_mu_statement : Prop := forall N A Q rho2 mu1 mu2 mu,
  balanced N A ->
  (forall i j, (i < N)%nat -> (j < N)%nat -> Q i j = Q j i) ->
  (forall x, zero_sum N x -> 0 <= form N Q x) -> mu1 <= mu <= mu2 ->
  (forall x, zero_sum N x -> form N Q (mv N (perron N A mu1) x) <= rho2 * form N Q x) ->
  (forall x, zero_sum N x -> form N Q (mv N (perron N A mu2) x) <= rho2 * form N Q x) ->
  forall x, zero_sum N x -> form N Q (mv N (perron N A mu) x) <= rho2 * form N Q x.

(** sigma(mu) is convex in mu: a bound at both ends holds between them. *)
Definition sigma_convex_statement : Prop := forall N A mu1 mu2 s1 s2 theta,
  0 <= theta <= 1 -> contracts N A mu1 s1 -> contracts N A mu2 s2 ->
  contracts N A ((1 - theta) * mu1 + theta * mu2) ((1 - theta) * s1 + theta * s2).

(** A Lyapunov matrix Q with lo |x|^2 <= x^T Q x <= hi |x|^2 and P^T Q P <= rho^2 Q on 1perp:
    ||P^n|| <= sqrt(hi/lo) rho^n. *)
Definition lyapunov_statement : Prop := forall N A mu Q lo hi rho,
  balanced N A -> 0 < lo -> 0 <= rho ->
  (forall x, zero_sum N x -> lo * dot N x x <= form N Q x <= hi * dot N x x) ->
  (forall x, zero_sum N x -> form N Q (mv N (perron N A mu) x) <= rho ^ 2 * form N Q x) ->
  decays_on_1perp N (mv N (perron N A mu)) (sqrt (hi / lo)) rho.

(** Refutation: P^T Q P <= Q on 1perp and x^T Q x < 0 for one x of 1perp: P^k x does not tend
    to zero. *)
Definition lyapunov_refutation_statement : Prop := forall N A mu Q x, balanced N A ->
  (forall y, zero_sum N y -> form N Q (mv N (perron N A mu) y) <= form N Q y) ->
  zero_sum N x -> form N Q x < 0 ->
  ~ (forall i, (i < N)%nat -> is_lim_seq (fun k => iter k (mv N (perron N A mu)) x i) 0).

(** Schur complement: sigma(mu) <= rho iff the block form of the LMI is nonnegative on
    1perp x 1perp. *)
Definition schur_complement_statement : Prop := forall N A mu rho,
  balanced N A -> 0 <= rho ->
  (contracts N A mu rho <->
   forall y z, zero_sum N y -> zero_sum N z ->
   0 <= rho * dot N y y + 2 * dot N z (mv N (perron N A mu) y) + rho * dot N z z).

(** Rayleigh upper bound of lambda2. *)
Definition rayleigh_statement : Prop := forall N A lambda2 x t,
  is_lambda2 N A lambda2 -> zero_sum N x -> 0 < dot N x x ->
  form N (laplacian_sym N A) x <= t * dot N x x -> lambda2 <= t.

(** Lower bound of lambda2: the form is >= s on the hyperplane w.x = 0, s > 0, and
    L_s 1 = 0 (the graph is balanced). *)
Definition hyperplane_statement : Prop := forall N A w s lambda2,
  (1 <= N)%nat -> balanced N A -> 0 < s ->
  (forall x, dot N w x = 0 -> s * dot N x x <= form N (laplacian_sym N A) x) ->
  is_lambda2 N A lambda2 -> s <= lambda2.

(** Emptiness: n pairs of vectors u_i, v_i of 1perp. With a = sum u_i.v_i,
    b = sum u_i.(L v_i), nn = sum (|u_i|^2 + |v_i|^2)/2 > 0: every contraction factor at mu is
    at least (a - mu b)/nn; and a > t nn with a - b mu_max > t nn excludes every mu of
    [0, mu_max]. *)
Definition emptiness_statement : Prop := forall N A n (u v : nat -> vec) mu_max t,
  balanced N A ->
  (forall i, (i < n)%nat -> zero_sum N (u i) /\ zero_sum N (v i)) ->
  let a := \sum_(i < n) dot N (u i) (v i) in
  let b := \sum_(i < n) dot N (u i) (mv N (laplacian N A) (v i)) in
  let nn := \sum_(i < n) ((dot N (u i) (u i) + dot N (v i) (v i)) / 2) in
  (forall mu s, contracts N A mu s -> a - mu * b <= s * nn) /\
  (t * nn < a -> t * nn < a - mu_max * b ->
   forall mu s, 0 <= mu <= mu_max -> contracts N A mu s -> t < s).

(** * 8. Three claims are one *)

(** Under Assumption 1, for any mu > 0 of a design, (15) or not: all controls vanish, all
    states reach the average, and P^k v -> 0 on 1perp are the same; and then the decay is
    geometric. *)
Definition vanishes_on_1perp (N : nat) (A : mat) (mu : R) : Prop :=
  forall v, zero_sum N v -> forall i, (i < N)%nat ->
  is_lim_seq (fun k => iter k (mv N (perron N A mu)) v i) 0.
Definition claims_equivalent_statement : Prop := forall N A alpha gamma h,
  (2 <= N)%nat -> assumption1 N A -> design alpha gamma h ->
  let mu := mu_of alpha gamma h in
  ((forall x0 x u, closed_loop N A alpha gamma h x0 x u ->
      forall i, (i < N)%nat -> is_lim_seq (fun k => u k i) 0) <-> vanishes_on_1perp N A mu) /\
  ((forall x0 x u, closed_loop N A alpha gamma h x0 x u ->
      forall i, (i < N)%nat -> is_lim (fun t => x t i) p_infty (mean N x0))
   <-> vanishes_on_1perp N A mu).
Definition decay_from_vanishing_statement : Prop := forall N A mu,
  (1 <= N)%nat -> balanced N A -> vanishes_on_1perp N A mu ->
  exists C rho, 0 <= C /\ 0 <= rho < 1 /\ decays_on_1perp N (mv N (perron N A mu)) C rho.

(** Decay on 1perp bounds every eigenvalue a + b i other than 1 by rho. *)
Definition eigenvalues_from_decay_statement : Prop := forall N A mu C rho a b x y,
  balanced N A -> 0 <= C -> 0 <= rho ->
  let P := mv N (perron N A mu) in
  decays_on_1perp N P C rho ->
  0 < dot N x x + dot N y y ->
  (forall i, (i < N)%nat -> P x i = a * x i - b * y i) ->
  (forall i, (i < N)%nat -> P y i = b * x i + a * y i) ->
  ~ (a = 1 /\ b = 0) -> a ^ 2 + b ^ 2 <= rho ^ 2.

(** * 9. Bounds of eigenvalues, and ends of regions *)

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

(** Outer end of a region: sigma <= t at mu_in and not at mu_out excludes what lies beyond. *)
Definition outer_end_statement : Prop := forall N A mu_in mu_out mu t,
  contracts N A mu_in t -> ~ contracts N A mu_out t ->
  (mu_in < mu_out <= mu \/ mu <= mu_out < mu_in) -> ~ contracts N A mu t.

(** One Lyapunov matrix at mu_in certifies all of (0, mu_in]: at mu = 0 it is an equality. *)
Definition consensus_interval_statement : Prop := forall N A Q rho2 mu_in mu,
  balanced N A ->
  (forall i j, (i < N)%nat -> (j < N)%nat -> Q i j = Q j i) ->
  (forall x, zero_sum N x -> 0 <= form N Q x) -> 0 <= rho2 < 1 -> 0 < mu <= mu_in ->
  (forall x, zero_sum N x -> form N Q (mv N (perron N A mu_in) x) <= rho2 * form N Q x) ->
  exists rho, 0 <= rho < 1 /\
  forall x, zero_sum N x -> form N Q (mv N (perron N A mu) x) <= rho ^ 2 * form N Q x.

(** lambda2 >= s iff L_s - s (I - J) is positive semidefinite. *)
Definition lambda2_psd_statement : Prop := forall N A lambda2 s,
  (1 <= N)%nat -> balanced N A -> is_lambda2 N A lambda2 ->
  (s <= lambda2 <->
   forall x, 0 <= form N (fun i j => laplacian_sym N A i j - s * (id_mat i j - / INR N)) x).

(** * 10. Enclosing Gamma *)

(** For 0 < z <= 2 and T > 1, with n terms of the incomplete series:
    T^z e^(-T) S_n <= Gamma z <= T^z (e^(-T) S_n + W_n) + (T + 1) e^(-T). *)
Definition gamma_enclosure_statement : Prop := forall z T n, 0 < z <= 2 -> 1 < T ->
  Rpower T z * exp (- T) * gamma_series n z T <= Gamma z
  <= Rpower T z * (exp (- T) * gamma_series n z T + gamma_remainder n z T)
     + (T + 1) * exp (- T).

(** * 11. The paper's step, and the paper's region *)

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
