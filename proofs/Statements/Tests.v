(** Soundness of the exact tests. *)
From Coq Require Import Reals Arith List.
From Coquelicot Require Import Coquelicot.
From Fomas Require Import Model.Vectors Model.Kernel Model.Gamma Model.Graph Model.Loop.
From Fomas Require Import Model.Coordinates Statements.Balanced Statements.Consensus.
Open Scope R_scope.

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

(** Convexity: for a symmetric Q >= 0 on 1perp, the maps T of 1perp to itself with
    T^T Q T <= rho2 Q there form a convex set. For T = P(mu) both ends of an interval suffice. *)
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

(** * Coordinates *)

(** V is a basis of 1perp with Gram matrix I + 1 1^T, and V^T M V is M there: what is shown of
    V^T M V on R^n is shown of M on 1perp. *)
Definition basis_statement : Prop := forall n,
  (forall y, zero_sum (S n) (embed n y)) /\
  (forall x i, zero_sum (S n) x -> (i < S n)%nat -> embed n x i = x i) /\
  (forall i j, (i < n)%nat -> (j < n)%nat -> on_basis n id_mat i j = id_mat i j + 1) /\
  (forall M y, form n (on_basis n M) y = form (S n) M (embed n y)) /\
  (forall M, positive_semidefinite n (on_basis n M) <->
     forall x, zero_sum (S n) x -> 0 <= form (S n) M x) /\
  (forall M, positive_definite n (on_basis n M) <->
     forall x, zero_sum (S n) x -> 0 < dot (S n) x x -> 0 < form (S n) M x).

(** A strict test has a margin, on R^n and on 1perp. *)
Definition definite_margin_statement : Prop := forall n,
  (forall Q, positive_definite n Q ->
     exists eps, 0 < eps /\ forall y, eps * dot n y y <= form n Q y) /\
  (forall M, positive_definite n (on_basis n M) ->
     exists eps, 0 < eps /\ forall x, zero_sum (S n) x -> eps * dot (S n) x x <= form (S n) M x).

(** sigma <= s as it is tested, V^T (s^2 I - P^T P) V >= 0; where that is definite, some s' < s
    contracts too. *)
Definition contraction_test_statement : Prop := forall n A mu s, 0 <= s ->
  let tested :=
    on_basis n (fun i j => s ^ 2 * id_mat i j - gram (S n) (perron (S n) A mu) i j) in
  (positive_semidefinite n tested <-> contracts (S n) A mu s) /\
  (0 < s -> positive_definite n tested -> exists s', s' < s /\ contracts (S n) A mu s').

(** lambda2 >= s and lambda2 > s as they are tested, by V^T (L_s - s I) V. *)
Definition lambda2_test_statement : Prop := forall n A lambda2 s, is_lambda2 (S n) A lambda2 ->
  let tested := on_basis n (fun i j => laplacian_sym (S n) A i j - s * id_mat i j) in
  (positive_semidefinite n tested <-> s <= lambda2) /\
  (positive_definite n tested <-> s < lambda2).

(** C L = Lc C and C (I - t L) = Pc(t) C, on any graph. *)
Definition differences_evolve_statement : Prop := forall n A t x i, (i < n)%nat ->
  differences n (mv (S n) (laplacian (S n) A) x) i
  = mv n (differences_laplacian n A) (differences n x) i /\
  differences n (mv (S n) (perron (S n) A t) x) i
  = mv n (differences_step n A t) (differences n x) i.

(** Q > 0 and Q - Pc(t)^T Q Pc(t) > 0 for one t >= mu: perron-eigenvalues and vanishing
    disagreement on any graph, and decay on 1perp on a balanced one, from which
    consensus_from_decay has the rest. *)
Definition lyapunov_test_statement : Prop := forall n A Q t mu,
  symmetric n Q -> positive_definite n Q ->
  positive_definite n (stein_form n Q (differences_step n A t)) -> 0 < mu <= t ->
  perron_spectrum (S n) A mu /\
  (forall alpha gamma h x0 x u, design alpha gamma h -> mu_of alpha gamma h = mu ->
     closed_loop (S n) A alpha gamma h x0 x u ->
     forall i j, (i < S n)%nat -> (j < S n)%nat ->
     is_lim_seq (fun k => x (INR k * h) i - x (INR k * h) j) 0) /\
  (balanced (S n) A -> exists C rho, 0 <= C /\ 0 <= rho < 1 /\
     decays_on_1perp (S n) (mv (S n) (perron (S n) A mu)) C rho).

(** perron-eigenvalues is decay of the differences, on any graph, so decay on 1perp on a balanced
    one: no eigenvalue of modulus 1 or more is all that decay needs. *)
Definition eigenvalues_decide_statement : Prop := forall n A mu,
  (perron_spectrum (S n) A mu <->
   exists C rho, 0 <= C /\ 0 <= rho < 1 /\ forall k y,
     norm n (iter k (mv n (differences_step n A mu)) y) <= C * rho ^ k * norm n y) /\
  (balanced (S n) A -> (perron_spectrum (S n) A mu <-> vanishes_on_1perp (S n) A mu)).

(** perron-eigenvalues by the eigenvalues p + q i of L, on any graph: 0 is a simple one, and
    mu |p + q i|^2 < 2 p for every other; so it holds for mu below the least 2 p / |p + q i|^2. *)
Definition stability_limit_statement : Prop := forall N A mu, 0 < mu ->
  let L := mv N (laplacian N A) in
  (perron_spectrum N A mu <->
   (forall x, (forall i, (i < N)%nat -> L (L x) i = 0) -> forall i, (i < N)%nat -> x i = x 0%nat) /\
   (forall p q x y, 0 < dot N x x + dot N y y ->
      (forall i, (i < N)%nat -> L x i = p * x i - q * y i) ->
      (forall i, (i < N)%nat -> L y i = q * x i + p * y i) ->
      ~ (p = 0 /\ q = 0) -> mu * (p ^ 2 + q ^ 2) < 2 * p)).

(** Under Assumption 1 perron-eigenvalues, vanishing controls and average consensus are one claim. *)
Definition claims_are_one_statement : Prop := forall N A alpha gamma h,
  (2 <= N)%nat -> assumption1 N A -> design alpha gamma h ->
  let mu := mu_of alpha gamma h in
  (perron_spectrum N A mu <->
   forall x0 x u, closed_loop N A alpha gamma h x0 x u ->
   forall i, (i < N)%nat -> is_lim_seq (fun k => u k i) 0) /\
  (perron_spectrum N A mu <->
   forall x0 x u, closed_loop N A alpha gamma h x0 x u ->
   forall i, (i < N)%nat -> is_lim (fun t => x t i) p_infty (mean N x0)).

(** At this mu some two agents do not come to agree, from some x_0; under Assumption 1 also some
    controls do not vanish. *)
Definition disagreement (n : nat) (A : mat) (mu : R) : Prop :=
  forall alpha gamma h, design alpha gamma h -> mu_of alpha gamma h = mu ->
  (exists x0 x u i, closed_loop (S n) A alpha gamma h x0 x u /\ (i < n)%nat /\
     ~ is_lim_seq (fun k => x (INR k * h) i - x (INR k * h) n) 0) /\
  (assumption1 (S n) A -> exists x0 x u i, closed_loop (S n) A alpha gamma h x0 x u /\
     (i < S n)%nat /\ ~ is_lim_seq (fun k => u k i) 0).

(** Y >= 0, Y not 0 and Pc(t)^T Y Pc(t) - Y >= 0 for one t <= mu refute perron-eigenvalues and
    agreement, on any graph. *)
Definition persistence_test_statement : Prop := forall n A Y t mu,
  symmetric n Y -> positive_semidefinite n Y ->
  (exists i j, (i < n)%nat /\ (j < n)%nat /\ Y i j <> 0) ->
  positive_semidefinite n (fun i j => - stein_form n Y (differences_step n A t) i j) ->
  0 < t <= mu -> ~ perron_spectrum (S n) A mu /\ disagreement n A mu.

(** So does abs trace(Pc(t)^m) > N - 1 for one t <= mu and one m. *)
Definition trace_test_statement : Prop := forall n A t mu m,
  INR n < Rabs (\sum_(i < n) iter m (mv n (differences_step n A t)) (id_mat i) i) ->
  0 < t <= mu -> ~ perron_spectrum (S n) A mu /\ disagreement n A mu.
