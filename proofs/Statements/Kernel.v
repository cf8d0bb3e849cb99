(** The memory kernel f(j), its tail c_n, inequality (14) in closed form, and the resolvent. *)
From Coq Require Import Reals Arith List.
From Coquelicot Require Import Coquelicot.
From Fomas Require Import Model.Vectors Model.Kernel Model.Gamma Model.Graph Model.Loop.
Open Scope R_scope.

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
