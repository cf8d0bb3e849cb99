(** Boundedness and consensus: the conclusions of Theorem 1. *)
From Coq Require Import Reals Arith List.
From Coquelicot Require Import Coquelicot.
From Fomas Require Import Model.Vectors Model.Kernel Model.Gamma Model.Graph Model.Loop.
Open Scope R_scope.

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

(** Theorem 1 without (14): under (15) and Assumption 1 alone x(t) and the controls are bounded,
    the controls vanish, the agents agree, and on the average of x_0. *)
Definition theorem1_from_gain_bound_statement : Prop := forall N A alpha gamma h,
  (2 <= N)%nat -> assumption1 N A -> design alpha gamma h ->
  gain_bound N A (mu_of alpha gamma h) ->
  forall x0 x u, closed_loop N A alpha gamma h x0 x u ->
  (exists B, (forall t i, 0 <= t -> (i < N)%nat -> Rabs (x t i) <= B) /\
             (forall k i, (i < N)%nat -> Rabs (u k i) <= B)) /\
  (forall i, (i < N)%nat -> is_lim_seq (fun k => u k i) 0) /\
  (forall i j, (i < N)%nat -> (j < N)%nat -> is_lim (fun t => Rabs (x t i - x t j)) p_infty 0) /\
  (forall i, (i < N)%nat -> is_lim (fun t => x t i) p_infty (mean N x0)).

(** Theorem 1 as the paper states it, (14) among its hypotheses; it follows from the one above,
    which does without. *)
Definition theorem1_as_stated_statement : Prop := forall N A alpha gamma h lambda2,
  (2 <= N)%nat -> assumption1 N A -> design alpha gamma h -> is_lambda2 N A lambda2 ->
  let mu := mu_of alpha gamma h in
  gain_bound N A mu -> memory_inequality alpha (1 - mu * lambda2) ->
  forall x0 x u, closed_loop N A alpha gamma h x0 x u ->
  (exists B, (forall t i, 0 <= t -> (i < N)%nat -> Rabs (x t i) <= B) /\
             (forall k i, (i < N)%nat -> Rabs (u k i) <= B)) /\
  (forall i j, (i < N)%nat -> (j < N)%nat -> is_lim (fun t => Rabs (x t i - x t j)) p_infty 0) /\
  (forall i, (i < N)%nat -> is_lim (fun t => x t i) p_infty (mean N x0)).

(** Remark 1: agents with states in R^n. Each coordinate obeys the scalar loop, so eqL3 for the
    scalar loop gives it for the norm over all coordinates. *)
Definition remark1_statement : Prop := forall N n A alpha gamma h x0 x u,
  closed_loop (N * n) (kron_id n A) alpha gamma h x0 x u ->
  (forall d, (d < n)%nat ->
     closed_loop N A alpha gamma h (coordinate n d x0)
       (fun t => coordinate n d (x t)) (fun k => coordinate n d (u k))) /\
  (control_norm_bound N A alpha gamma h ->
   forall k, norm (N * n) (u k) <= norm (N * n) (u 0%nat)).

(** Remark 1 for Theorem 1: in R^n too, (15) and Assumption 1 alone bound every signal, make
    the controls vanish, take ||x_i(t) - x_j(t)|| to 0 and each coordinate to its average. *)
Definition remark1_consensus_statement : Prop := forall N n A alpha gamma h x0 x u,
  (2 <= N)%nat -> assumption1 N A -> design alpha gamma h ->
  gain_bound N A (mu_of alpha gamma h) ->
  closed_loop (N * n) (kron_id n A) alpha gamma h x0 x u ->
  (exists B, (forall t, 0 <= t -> norm (N * n) (x t) <= B) /\
             (forall k, norm (N * n) (u k) <= B)) /\
  is_lim_seq (fun k => norm (N * n) (u k)) 0 /\
  (forall i j, (i < N)%nat -> (j < N)%nat ->
     is_lim (fun t => norm n (fun d => agent n i (x t) d - agent n j (x t) d)) p_infty 0) /\
  (forall i d, (i < N)%nat -> (d < n)%nat ->
     is_lim (fun t => agent n i (x t) d) p_infty (mean N (coordinate n d x0))).

(** The converse of vanishing controls, on any graph and for one trajectory: if its controls
    vanish then so does P^k u_0. *)
Definition control_vanishes_converse_statement : Prop := forall N A alpha gamma h x0 x u,
  design alpha gamma h -> closed_loop N A alpha gamma h x0 x u ->
  (forall i, (i < N)%nat -> is_lim_seq (fun k => u k i) 0) ->
  forall i, (i < N)%nat ->
  is_lim_seq (fun k => iter k (mv N (perron N A (mu_of alpha gamma h))) (u 0%nat) i) 0.

(** * Three claims are one *)

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
