(** The plant under a held input, the controller, and the closed loop; enclosing Gamma. *)
From Coq Require Import Reals Arith List.
From Coquelicot Require Import Coquelicot.
From Fomas Require Import Model.Vectors Model.Kernel Model.Gamma Model.Graph Model.Loop.
Open Scope R_scope.

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

(** e_{k+1} = P e_k. *)
Definition error_step_statement : Prop := forall N A alpha gamma h x0 x u,
  design alpha gamma h -> closed_loop N A alpha gamma h x0 x u ->
  forall k i, (i < N)%nat ->
  error N A h x (S k) i = mv N (perron N A (mu_of alpha gamma h)) (error N A h x k) i.

(** equ1, and the first line of equk+1u0_1: u_k = -gamma e_k + sum_{l=1}^{k} |f(l)| u_{k-l}. *)
Definition equ1_statement : Prop := forall N A alpha gamma h x0 x u,
  design alpha gamma h -> closed_loop N A alpha gamma h x0 x u ->
  (forall i, (i < N)%nat ->
     u 1%nat i = - gamma * error N A h x 1 i + Rabs (fk alpha 1) * u 0%nat i) /\
  (forall k i, (i < N)%nat ->
     u k i = - gamma * error N A h x k i
             + \sum_(l < k) (Rabs (fk alpha (S l)) * u (k - S l)%nat i)).

(** The controls: u_0 = -gamma e_0 (equ0), F * u = P^k u_0,
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

(** * Enclosing Gamma *)

(** For 0 < z <= 2 and T > 1, with n terms of the incomplete series:
    T^z e^(-T) S_n <= Gamma z <= T^z (e^(-T) S_n + W_n) + (T + 1) e^(-T). *)
Definition gamma_enclosure_statement : Prop := forall z T n, 0 < z <= 2 -> 1 < T ->
  Rpower T z * exp (- T) * gamma_series n z T <= Gamma z
  <= Rpower T z * (exp (- T) * gamma_series n z T + gamma_remainder n z T)
     + (T + 1) * exp (- T).
