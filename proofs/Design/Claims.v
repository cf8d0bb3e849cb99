(** The claims about one design, and what a certificate has to show for each. *)
From Coq Require Export Reals ZArith List Lia Lra.
From Coq Require Import Bool.
From Coquelicot Require Import Coquelicot.
From Fomas Require Export Model.Vectors Model.Kernel Model.Gamma Model.Graph Model.Loop Statements.
From Fomas Require Import Facts.Sums Facts.Vectors Facts.Kernel Facts.Resolvent Facts.Graph Facts.Contraction Facts.Phi.
From Fomas Require Import Results.EqT2 Results.BalancedGraph Results.Perron Results.Consensus.
From Fomas Require Import Results.NormBound Results.Soundness Results.Equivalence.
From Fomas Require Export Design.Integers Design.Weights.
Open Scope R_scope.

(** * The statements *)

(** The controls are bounded by a multiple of the first, and vanish. *)
Definition control_bounded (N : nat) (A : mat) (alpha gamma h : R) : Prop :=
  exists B, forall x0 x u, closed_loop N A alpha gamma h x0 x u ->
  (forall k, norm N (u k) <= B * norm N (u 0%nat)) /\
  (forall i, (i < N)%nat -> is_lim_seq (fun k => u k i) 0).
(** Every state tends to the mean of the initial ones, between the samples too. *)
Definition average_consensus (N : nat) (A : mat) (alpha gamma h : R) : Prop :=
  forall x0 x u, closed_loop N A alpha gamma h x0 x u ->
  forall i, (i < N)%nat -> is_lim (fun t => x t i) p_infty (mean N x0).
(** (14) for the beta of the graph; lambda2 exists, and only one (lambda2_exists). *)
Definition memory_claim (N : nat) (A : mat) (alpha mu : R) : Prop :=
  forall lambda2, is_lambda2 N A lambda2 -> memory_inequality alpha (1 - mu * lambda2).
Definition memory_refuted (N : nat) (A : mat) (alpha mu : R) : Prop :=
  forall lambda2, is_lambda2 N A lambda2 -> ~ memory_inequality alpha (1 - mu * lambda2).
(** One vector that P shrinks by less than beta. *)
Definition beta_contraction_refuted (N : nat) (A : mat) (mu : R) : Prop :=
  exists e, zero_sum N e /\ forall lambda2, is_lambda2 N A lambda2 ->
  (1 - mu * lambda2) * norm N e < norm N (mv N (perron N A mu) e).
Definition repaired_condition (N : nat) (A : mat) (alpha mu : R) : Prop :=
  contracts N A mu (Rpower 2 alpha - 1).
Definition repaired_refuted (N : nat) (A : mat) (alpha mu : R) : Prop :=
  exists e, zero_sum N e /\
  (Rpower 2 alpha - 1) * norm N e < norm N (mv N (perron N A mu) e).

(** eqL3 for one initial state, given by integers over a common denominator. *)
Definition trajectory_norm_bound (N : nat) (A : mat) (alpha gamma h : R) (x0 : list Z) (m : Z)
  : Prop := forall x u, closed_loop N A alpha gamma h (fun i => IZR (nth i x0 0%Z) / IZR m) x u ->
  forall k, norm N (u k) <= norm N (u 0%nat).

(** * From decay of the powers of P *)

Definition decays (N : nat) (A : mat) (mu : R) : Prop := exists C rho,
  0 <= C /\ 0 <= rho < 1 /\ decays_on_1perp N (mv N (perron N A mu)) C rho.

Lemma gain_decays N A mu : assumption1 N A -> gain_bound N A mu -> decays N A mu.
Proof.
  intros H1 HG. destruct (gain_bound_decay N A mu H1 HG) as [s [Hs Hd]].
  exists 1, s. split; [lra|]. split; assumption.
Qed.

Lemma fixed_vector_zero N A mu y : decays N A mu -> zero_sum N y ->
  (forall i, (i < N)%nat -> mv N (perron N A mu) y i = y i) -> forall i, (i < N)%nat -> y i = 0.
Proof.
  intros [C [rho [HC [Hr Hd]]]] Hy E. apply norm_zero_inv.
  assert (I : forall n i, (i < N)%nat -> iter n (mv N (perron N A mu)) y i = y i).
  { induction n as [|n IH]; intros i Hi; simpl; [reflexivity|].
    rewrite (mv_ext N _ _ y) by exact IH. apply E, Hi. }
  apply Rle_antisym; [|apply norm_nonneg].
  apply (geometric_limit _ 0 (C * norm N y) rho Hr). intros n.
  rewrite <- (norm_ext N _ _ (I n)). eapply Rle_trans; [apply Hd, Hy|]. right.
  rewrite (norm_ext N _ _ (I n)). ring.
Qed.

Lemma decays_spectrum N A mu : (1 <= N)%nat -> balanced N A -> decays N A mu ->
  perron_spectrum N A mu.
Proof.
  intros HN bal HD. unfold perron_spectrum.
  set (P := mv N (perron N A mu)).
  assert (one : forall i, (i < N)%nat -> P ones i = 1).
  { intros i Hi. unfold P. rewrite perron_entry, laplacian_ones by exact Hi. unfold ones. ring. }
  split; [exact one|]. split.
  - intros x Hx.
    assert (F : forall i, (i < N)%nat -> P x i - x i = 0).
    { apply (fixed_vector_zero N A mu (fun i => P x i - x i) HD).
      - unfold zero_sum. rewrite sum_minus. unfold P.
        change (\sum_(i < N) mv N (perron N A mu) x i)
          with (sum_lt N (mv N (perron N A mu) x)).
        change (\sum_(i < N) x i) with (sum_lt N x). rewrite sum_perron by exact bal. ring.
      - intros i Hi. rewrite mv_minus. specialize (Hx i Hi). unfold P in *. lra. }
    assert (Z : forall i, (i < N)%nat -> x i - mean N x = 0).
    { apply (fixed_vector_zero N A mu _ HD (zero_sum_deviation N x HN)).
      intros i Hi. rewrite mv_minus. specialize (F i Hi). specialize (one i Hi).
      rewrite (mv_ext N _ (fun _ => mean N x) (fun j => mean N x * ones j))
        by (intros; unfold ones; ring).
      rewrite mv_scal. unfold P in *. rewrite one. lra. }
    intros i Hi. assert (Z0 := Z 0%nat ltac:(lia)). specialize (Z i Hi). lra.
  - intros a b x y Hxy Ex Ey Hne. destruct HD as [C [rho [HC [Hr Hd]]]].
    assert (M := eigenvalues_from_decay N A mu C rho a b x y bal HC (proj1 Hr) Hd Hxy Ex Ey Hne).
    nra.
Qed.

Lemma decays_control N A alpha gamma h : (1 <= N)%nat -> balanced N A -> design alpha gamma h ->
  decays N A (mu_of alpha gamma h) -> control_bounded N A alpha gamma h.
Proof.
  intros HN bal D [C [rho [HC [Hr Hd]]]]. exists (C / (1 - rho)). intros x0 x u H.
  destruct (consensus_from_decay N A alpha gamma h C rho HN bal D HC Hr Hd x0 x u H) as [B [V _]].
  split; assumption.
Qed.

Lemma decays_consensus N A alpha gamma h : (1 <= N)%nat -> balanced N A -> design alpha gamma h ->
  decays N A (mu_of alpha gamma h) -> average_consensus N A alpha gamma h.
Proof.
  intros HN bal D [C [rho [HC [Hr Hd]]]] x0 x u H.
  apply (consensus_from_decay N A alpha gamma h C rho HN bal D HC Hr Hd x0 x u H).
Qed.

(** * From bounds of mu and lambda2 *)

Lemma unbalanced_sound N W d (Hd : (0 < d)%Z) i : (i < N)%nat ->
  (row_sum N W i =? column_sum N W i)%Z = false -> ~ assumption1 N (weighted W d).
Proof. intros Hi H [_ [_ bal]]. apply (imbalance_sound N W d Hd i Hi H bal). Qed.

Lemma unreachable_sound N W d (Hd : (0 < d)%Z) s i j : separated_check N W s i j = true ->
  ~ assumption1 N (weighted W d).
Proof. intros H [_ [con _]]. apply (separated_sound N W d Hd s i j H con). Qed.

Lemma gain_bound_sound N A mu D lo hi : degree_max N A = D -> 0 < D ->
  lo <= mu <= hi -> 0 < lo -> hi * D < 1 -> gain_bound N A mu.
Proof.
  intros E HD Hmu Hlo Hhi. unfold gain_bound. rewrite E. split; [lra|].
  apply Rmult_lt_reg_r with D; [exact HD|]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l by lra.
  nra.
Qed.

Lemma gain_bound_false N A mu D lo : degree_max N A = D -> 0 < D ->
  lo <= mu -> 1 <= lo * D -> ~ gain_bound N A mu.
Proof.
  intros E HD Hmu Hlo [_ H]. rewrite E in H.
  apply Rmult_lt_compat_r with (r := D) in H; [|exact HD]. unfold Rdiv in H.
  rewrite Rmult_assoc, Rinv_l in H by lra. nra.
Qed.

Section Memory.
Variables (N : nat) (A : mat) (alpha mu lo hi l u : R).
Hypotheses (Ha : 0 < alpha < 1) (Hmu : lo <= mu <= hi) (Hlo : 0 < lo) (Hl : 0 <= l).
Hypothesis low : forall lambda2, is_lambda2 N A lambda2 -> l <= lambda2.
Hypothesis high : forall lambda2, is_lambda2 N A lambda2 -> lambda2 <= u.

Lemma gain_product lambda2 : is_lambda2 N A lambda2 -> lo * l <= mu * lambda2 <= hi * u.
Proof.
  intros H. specialize (low _ H). specialize (high _ H).
  split; apply Rmult_le_compat; lra.
Qed.

Lemma memory_sound : 2 - Rpower 2 alpha <= lo * l ->
  hi * u <= 1 + sqrt (Rpower 3 alpha - Rpower 2 alpha) -> memory_claim N A alpha mu.
Proof.
  intros H1 H2 lambda2 H. apply eqT2_closed_form; [exact Ha|].
  assert (G := gain_product lambda2 H). lra.
Qed.

Lemma memory_false_first : hi * u < 2 - Rpower 2 alpha -> memory_refuted N A alpha mu.
Proof.
  intros H1 lambda2 H C. apply eqT2_closed_form in C; [|exact Ha].
  assert (G := gain_product lambda2 H). lra.
Qed.

Lemma memory_false_second : 1 + sqrt (Rpower 3 alpha - Rpower 2 alpha) < lo * l ->
  memory_refuted N A alpha mu.
Proof.
  intros H1 lambda2 H C. apply eqT2_closed_form in C; [|exact Ha].
  assert (G := gain_product lambda2 H). lra.
Qed.

(** The vector is stretched by more than s >= beta. *)
Lemma beta_refuted e s : zero_sum N e -> 1 - lo * l <= s ->
  s * norm N e < norm N (mv N (perron N A mu) e) -> beta_contraction_refuted N A mu.
Proof.
  intros He Hs H. exists e. split; [exact He|]. intros lambda2 Hl2.
  assert (G := gain_product lambda2 Hl2). eapply Rle_lt_trans; [|exact H].
  apply Rmult_le_compat_r; [apply norm_nonneg|]. lra.
Qed.
End Memory.

Lemma repaired_sound N A alpha mu lo hi s : lo <= mu <= hi ->
  contracts N A lo s -> contracts N A hi s -> s <= Rpower 2 alpha - 1 ->
  repaired_condition N A alpha mu.
Proof.
  intros Hmu C1 C2 Hs. assert (C : contracts N A mu s).
  { destruct (Req_dec lo hi) as [E|NE]; [replace mu with lo by lra; exact C1|].
    set (theta := (mu - lo) / (hi - lo)).
    assert (T : 0 <= theta <= 1).
    { unfold theta. split; [apply Rle_mult_inv_pos; lra|].
      apply Rmult_le_reg_r with (hi - lo); [lra|]. unfold Rdiv.
      rewrite Rmult_assoc, Rinv_l by lra. lra. }
    assert (C := sigma_convex N A lo hi s s theta T C1 C2).
    replace ((1 - theta) * lo + theta * hi) with mu in C by (unfold theta; field; lra).
    replace ((1 - theta) * s + theta * s) with s in C by ring. exact C. }
  destruct C as [s0 C]. split; [lra|]. intros e He. specialize (C e He).
  eapply Rle_trans; [exact C|]. apply Rmult_le_compat_r; [apply norm_nonneg|]. lra.
Qed.

Lemma repaired_false N A alpha mu e s : zero_sum N e -> Rpower 2 alpha - 1 <= s ->
  s * norm N e < norm N (mv N (perron N A mu) e) -> repaired_refuted N A alpha mu.
Proof.
  intros He Hs H. exists e. split; [exact He|]. eapply Rle_lt_trans; [|exact H].
  apply Rmult_le_compat_r; [apply norm_nonneg|exact Hs].
Qed.

Lemma repaired_norm_bound N A alpha gamma h : balanced N A -> design alpha gamma h ->
  repaired_condition N A alpha (mu_of alpha gamma h) -> control_norm_bound N A alpha gamma h.
Proof. apply theorem1_repaired. Qed.

Lemma norm_bound_false N A alpha gamma h : (2 <= N)%nat -> assumption1 N A ->
  design alpha gamma h ->
  ~ bounded_on_1perp N (Phi alpha N (perron N A (mu_of alpha gamma h)) 1) 1 ->
  ~ control_norm_bound N A alpha gamma h.
Proof. intros HN H1 D H C. apply H, (eqL3_characterised N A alpha gamma h HN H1 D), C. Qed.

Lemma norm_bound_trajectory N A alpha gamma h x0 m : control_norm_bound N A alpha gamma h ->
  trajectory_norm_bound N A alpha gamma h x0 m.
Proof. intros H x u. apply H. Qed.
