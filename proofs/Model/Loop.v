(** The sampled plant in Volterra form, the distributed controller, the closed loop. *)
From Coq Require Import Reals Arith.
From Fomas Require Import Model.Vectors Model.Kernel Model.Gamma Model.Graph.
Open Scope R_scope.

(** mu = gamma h^alpha / Gamma(alpha + 1), the integrated gain. *)
Definition mu_of (alpha gamma h : R) : R := gamma * (rpow h alpha / Gamma (alpha + 1)).

(** x(t), t >= 0, solves the Volterra equation of Lemma 1 (eqL1_2) for the input
    that is held at u_k on the k-th sampling interval, with t_0 = 0 and t_k = k h:
    x(t) = x_0 + 1/Gamma(alpha) * integral over (0,t) of (t - tau)^(alpha-1) u(tau).
    The sampling intervals (k h, (k+1) h] cover every t > 0. *)
Definition plant (N : nat) (alpha h : R) (x0 : vec) (u : nat -> vec) (x : R -> vec) : Prop :=
  (forall i, (i < N)%nat -> x 0 i = x0 i) /\
  (forall k s i, (i < N)%nat -> 0 < s <= h ->
     let t := INR k * h + s in
     x t i = x0 i + / Gamma alpha *
       (\sum_(j < k) (u j i * kernel_integral alpha t (INR j * h) (INR (S j) * h))
        + u k i * kernel_integral alpha t (INR k * h) t)).

(** The controller of agent i at sample k (paper: equ0i and equki). *)
Definition controller (N : nat) (A : mat) (alpha gamma h : R) (x : R -> vec) (u : nat -> vec)
  : Prop :=
  forall k i, (i < N)%nat ->
    u k i = gamma * \sum_(j < N) (A i j * (x (INR k * h) j - x (INR k * h) i))
            - \sum_(l < k) (fk alpha (S l) * u (k - S l)%nat i).

Definition closed_loop (N : nat) (A : mat) (alpha gamma h : R) (x0 : vec)
    (x : R -> vec) (u : nat -> vec) : Prop :=
  plant N alpha h x0 u x /\ controller N A alpha gamma h x u.

(** e_k = L x_k (paper: eqek). *)
Definition error (N : nat) (A : mat) (h : R) (x : R -> vec) (k : nat) : vec :=
  mv N (laplacian N A) (x (INR k * h)).

(** Phi_k(M) y = sum_{j<=k} r_{k-j} M^j y. *)
Definition Phi (alpha : R) (N : nat) (M : mat) (k : nat) (y : vec) : vec :=
  fun i => \sum_(j < S k) (rk alpha (k - j) * iter j (mv N M) y i).

(** A design: order, gain and sampling period in their ranges. *)
Definition design (alpha gamma h : R) : Prop := 0 < alpha < 1 /\ 0 < gamma /\ 0 < h.

(** (15) [eqh]: 0 < mu < 1/Delta_max. *)
Definition gain_bound (N : nat) (A : mat) (mu : R) : Prop := 0 < mu < 1 / degree_max N A.

(** eqL3 for every initial state: ||u_k|| <= ||u_0||. *)
Definition control_norm_bound (N : nat) (A : mat) (alpha gamma h : R) : Prop :=
  forall x0 x u, closed_loop N A alpha gamma h x0 x u ->
  forall k, norm N (u k) <= norm N (u 0%nat).

(** Agents with states in R^n (Remark 1): coordinate d of agent i is entry i n + d, and the graph
    is A (x) I_n, so that the loop is the paper's with L (x) I_n in place of L. *)
Definition kron_id (n : nat) (A : mat) : mat := fun p q =>
  if Nat.eqb (p mod n) (q mod n) then A (p / n)%nat (q / n)%nat else 0.
Definition coordinate (n d : nat) (x : vec) : vec := fun i => x (i * n + d)%nat.
Definition agent (n i : nat) (x : vec) : vec := fun d => x (i * n + d)%nat.
