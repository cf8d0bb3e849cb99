(** What the norm bound eqL3 needs: the peak of the controls, and (14). *)
From Coq Require Import Reals Arith List.
From Coquelicot Require Import Coquelicot.
From Fomas Require Import Model.Vectors Model.Kernel Model.Gamma Model.Graph Model.Loop Model.Examples Statements.Balanced.
Open Scope R_scope.

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

(** The controls of the loop: ||u_k|| <= M ||u_0|| for every x_0 is the same as ||Phi_k|| <= M on
    1perp; and with the peak lemma, a bound M >= 1 of u_0 .. u_K bounds every control. *)
Definition control_peak_statement : Prop := forall N A alpha gamma h M,
  (2 <= N)%nat -> assumption1 N A -> design alpha gamma h -> 0 <= M ->
  let P := perron N A (mu_of alpha gamma h) in
  let reaches_at_most k := forall x0 x u, closed_loop N A alpha gamma h x0 x u ->
    norm N (u k) <= M * norm N (u 0%nat) in
  (forall k, reaches_at_most k <-> bounded_on_1perp N (Phi alpha N P k) M) /\
  (forall K, 1 <= M -> (forall k, (k <= K)%nat -> reaches_at_most k) ->
     (forall n, (K < n)%nat -> bounded_on_1perp N (iter n (mv N P)) (M * ck alpha n)) ->
     forall k, reaches_at_most k).

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

(** eqL3 implies perron-eigenvalues for every smaller gain: an eigenvalue of P outside the closed
    unit disc refutes it. *)
Definition eqL3_needs_spectrum_statement : Prop := forall N A alpha gamma h t,
  (2 <= N)%nat -> assumption1 N A -> design alpha gamma h ->
  control_norm_bound N A alpha gamma h -> 0 < t < mu_of alpha gamma h -> perron_spectrum N A t.

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
