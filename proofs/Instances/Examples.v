(** Each set of hypotheses is inhabited, and conclusions fail where a hypothesis is dropped. *)
From Coq Require Import Reals Arith Lia Lra List.
From Coquelicot Require Import Coquelicot.
From Fomas Require Import Model.Vectors Model.Kernel Model.Gamma Model.Graph Model.Loop Model.Examples Statements.
From Fomas Require Import Facts.Sums Facts.Vectors Facts.Kernel Facts.Gamma Facts.Graph.
From Fomas Require Import Facts.Contraction Facts.Loop.
From Fomas Require Import Results.EqT2 Results.BalancedGraph Results.NormBound Results.Soundness.
From Fomas Require Import Instances.PairGraph.
Open Scope R_scope.

(** Every mu > 0 is the integrated gain of a design. *)
Lemma design_for_mu alpha mu : 0 < alpha < 1 -> 0 < mu ->
  design alpha (mu * Gamma (alpha + 1)) 1 /\ mu_of alpha (mu * Gamma (alpha + 1)) 1 = mu.
Proof.
  intros Ha Hm. assert (G := Gamma_pos (alpha + 1) ltac:(lra)). split.
  - unfold design. split; [exact Ha|split; [nra|lra]].
  - unfold mu_of. rewrite rpow_1. field. lra.
Qed.

(** Lemma 2 needs alpha < 1: at alpha = 1 f vanishes. *)
Theorem lemma2_fails_at_one : fk 1 1 = 0.
Proof. unfold fk. simpl. rewrite !rpow_pos, rpow_nonpos, !Rpower_1 by lra. ring. Qed.

(** The hypotheses of the repaired Theorem 1, in closed form, hold for a pair at mu = 1/2. *)
Theorem repaired_inhabited : forall alpha, 0 < alpha < 1 -> exists gamma h,
  design alpha gamma h /\ gain_bound 2 pair_graph (mu_of alpha gamma h) /\
  1 - 2 * mu_of alpha gamma h * 2 * (1 - mu_of alpha gamma h * degree_max 2 pair_graph)
  <= (Rpower 2 alpha - 1) ^ 2 /\
  control_norm_bound 2 pair_graph alpha gamma h.
Proof.
  intros alpha Ha. destruct (design_for_mu alpha (/ 2) Ha ltac:(lra)) as [D E].
  exists (/ 2 * Gamma (alpha + 1)), 1. rewrite E, pair_degree.
  assert (G : gain_bound 2 pair_graph (/ 2)) by (unfold gain_bound; rewrite pair_degree; lra).
  assert (B : 1 - 2 * / 2 * 2 * (1 - / 2 * 1) <= (Rpower 2 alpha - 1) ^ 2).
  { assert (P := pow2_ge_0 (Rpower 2 alpha - 1)). lra. }
  split; [exact D|split; [exact G|split; [exact B|]]].
  apply (theorem1_repaired_closed_form 2%nat pair_graph alpha _ 1 2);
    try exact D; try exact pair_lambda2; try apply pair_assumption1.
  - rewrite E. exact G.
  - rewrite E, pair_degree. exact B.
Qed.

(** Every hypothesis of eqT2_not_necessary and (15) hold at some gain: eqL3 holds there and (14)
    fails, for every alpha. *)
Theorem eqT2_not_necessary_inhabited : forall alpha, 0 < alpha < 1 -> exists gamma h,
  design alpha gamma h /\ / 2 <= mu_of alpha gamma h <= 1 /\
  1 - mu_of alpha gamma h * 2 < - sqrt (Rpower 3 alpha - Rpower 2 alpha) /\
  gain_bound 2 pair_graph (mu_of alpha gamma h) /\
  control_norm_bound 2 pair_graph alpha gamma h /\
  ~ memory_inequality alpha (1 - mu_of alpha gamma h * 2).
Proof.
  intros alpha Ha. set (q := sqrt (Rpower 3 alpha - Rpower 2 alpha)).
  assert (Q : 0 <= q < 1).
  { split; [apply sqrt_pos|]. unfold q. rewrite <- ck_2, <- sqrt_1.
    apply sqrt_lt_1_alt. split; [left; apply ck_pos, Ha|apply ck_lt_1; [exact Ha|lia]]. }
  destruct (design_for_mu alpha ((3 + q) / 4) Ha ltac:(lra)) as [D E].
  exists ((3 + q) / 4 * Gamma (alpha + 1)), 1.
  assert (T := eqT2_not_necessary alpha _ 1 D). cbv zeta in T. rewrite E in *.
  destruct (T ltac:(lra)) as [_ [_ [_ [B F]]]].
  split; [exact D|]. split; [lra|]. split; [fold q; lra|].
  split; [unfold gain_bound; rewrite pair_degree; lra|].
  split; [exact B|]. apply F. fold q. lra.
Qed.

Lemma iter_fixed N M x : (forall i, (i < N)%nat -> mv N M x i = x i) ->
  forall k i, (i < N)%nat -> iter k (mv N M) x i = x i.
Proof.
  intros H k. induction k as [|k IH]; intros i Hi; simpl; [reflexivity|].
  rewrite (mv_ext N M _ x) by exact IH. apply H, Hi.
Qed.

(** At mu = 1 a pair only swaps its states. *)
Lemma pair_swaps alpha gamma h x0 x u : design alpha gamma h -> mu_of alpha gamma h = 1 ->
  closed_loop 2 pair_graph alpha gamma h x0 x u -> x0 0%nat = 1 -> x0 1%nat = -1 ->
  ~ is_lim_seq (fun k => x (INR k * h) 0%nat) (mean 2 x0).
Proof.
  intros D E HL X0 X1 L.
  assert (Z : zero_sum 2 x0) by (unfold zero_sum; simpl; lra).
  apply is_lim_seq_spec in L. destruct (L (mkposreal (/ 2) ltac:(lra))) as [n Hn].
  specialize (Hn n (le_n n)). simpl pos in Hn.
  rewrite (loop_sample 2 pair_graph alpha gamma h x0 D x u HL n 0 ltac:(lia)), E in Hn.
  rewrite pair_iter, X0 in Hn by (assumption || lia). unfold mean in Hn.
  unfold zero_sum in Z. rewrite Z in Hn.
  replace ((1 - 1 * 2) ^ n * 1 - 0 / INR 2) with ((-1) ^ n) in Hn
    by (replace (1 - 1 * 2) with (-1) by ring; unfold Rdiv; ring).
  rewrite pow_1_abs in Hn. lra.
Qed.

(** Consensus fails at the end mu = 1/D of (15). *)
Theorem consensus_fails_at_gain_limit : forall alpha, 0 < alpha < 1 -> exists gamma h x0 x u,
  design alpha gamma h /\ mu_of alpha gamma h * degree_max 2 pair_graph = 1 /\
  closed_loop 2 pair_graph alpha gamma h x0 x u /\
  ~ is_lim_seq (fun k => x (INR k * h) 0%nat) (mean 2 x0).
Proof.
  intros alpha Ha. destruct (design_for_mu alpha 1 Ha ltac:(lra)) as [D E].
  set (x0 := of_list (1 :: -1 :: nil)).
  assert (HL := exact_loop 2 pair_graph alpha _ 1 x0 D).
  eexists. exists 1, x0. eexists. eexists.
  split; [exact D|]. split; [rewrite E, pair_degree; ring|]. split; [exact HL|].
  apply (pair_swaps alpha _ 1 x0 _ _ D E HL); reflexivity.
Qed.

(** Consensus fails without strong connectivity: two pairs that do not hear each other. *)
Definition two_pairs : mat := fun i j =>
  match i, j with
  | 0%nat, 1%nat | 1%nat, 0%nat | 2%nat, 3%nat | 3%nat, 2%nat => 1
  | _, _ => 0
  end.

Theorem consensus_fails_disconnected : forall alpha gamma h, design alpha gamma h ->
  digraph 4 two_pairs /\ balanced 4 two_pairs /\ exists x0 x u,
  closed_loop 4 two_pairs alpha gamma h x0 x u /\
  ~ is_lim_seq (fun k => x (INR k * h) 0%nat) (mean 4 x0).
Proof.
  intros alpha gamma h D. split; [|split].
  - split.
    + intros i j Hi Hj. destruct i as [|[|[|[|i]]]], j as [|[|[|[|j]]]]; simpl; try lia; lra.
    + intros i Hi. destruct i as [|[|[|[|i]]]]; simpl; try lia; reflexivity.
  - intros i Hi. destruct i as [|[|[|[|i]]]]; simpl; try lia; lra.
  - set (x0 := of_list (1 :: 1 :: 0 :: 0 :: nil)).
    assert (HL := exact_loop 4 two_pairs alpha gamma h x0 D).
    exists x0. eexists. eexists. split; [exact HL|]. intros L.
    apply is_lim_seq_ext with (v := fun _ => 1) in L.
    + apply is_lim_seq_unique in L. rewrite Lim_seq_const in L. apply (f_equal real) in L.
      unfold mean, x0, of_list in L. simpl in L. lra.
    + intros k. rewrite (loop_sample 4 two_pairs alpha gamma h x0 D _ _ HL k 0 ltac:(lia)).
      rewrite iter_fixed; [reflexivity| |lia]. intros i Hi.
      rewrite perron_entry, laplacian_entry by exact Hi.
      destruct i as [|[|[|[|i]]]]; [| | | |lia]; unfold x0, of_list; simpl; ring.
Qed.

(** Average consensus fails without balance: agent 2 hears agent 1 twice as loudly. *)
Definition unbalanced_pair : mat := fun i j =>
  match i, j with 0%nat, 1%nat => 1 | 1%nat, 0%nat => 2 | _, _ => 0 end.

Theorem average_fails_unbalanced : forall alpha gamma h, design alpha gamma h ->
  digraph 2 unbalanced_pair /\ strongly_connected 2 unbalanced_pair /\ exists x0 x u,
  closed_loop 2 unbalanced_pair alpha gamma h x0 x u /\
  ~ (forall i, (i < 2)%nat -> is_lim_seq (fun k => x (INR k * h) i) (mean 2 x0)).
Proof.
  intros alpha gamma h D. split; [|split].
  - split.
    + intros i j Hi Hj. below2 i; below2 j; simpl; lra.
    + intros i Hi. below2 i; reflexivity.
  - intros i j Hi Hj. below2 i; below2 j; try apply reaches_self;
      (eapply reaches_edge; [apply reaches_self|lia|lia|cbn; lra]).
  - set (x0 := of_list (1 :: 0 :: nil)). set (mu := mu_of alpha gamma h).
    assert (HL := exact_loop 2 unbalanced_pair alpha gamma h x0 D).
    exists x0. eexists. eexists. split; [exact HL|]. intros L.
    (* 2 x_1 + x_2 is constant *)
    assert (K : forall k, 2 * iter k (mv 2 (perron 2 unbalanced_pair mu)) x0 0%nat
                          + iter k (mv 2 (perron 2 unbalanced_pair mu)) x0 1%nat = 2).
    { induction k as [|k IH]; [unfold x0, of_list; simpl; ring|]. simpl iter.
      rewrite !perron_entry, !laplacian_entry by lia.
      revert IH. generalize (iter k (mv 2 (perron 2 unbalanced_pair mu)) x0). intros y IH.
      transitivity (2 * y 0%nat + y 1%nat); [simpl; ring|exact IH]. }
    assert (L2 := is_lim_seq_plus' _ _ _ _
              (is_lim_seq_scal_l _ 2 _ (L 0%nat ltac:(lia))) (L 1%nat ltac:(lia))).
    apply is_lim_seq_ext with (v := fun _ => 2) in L2.
    + apply is_lim_seq_unique in L2. rewrite Lim_seq_const in L2. apply (f_equal real) in L2.
      unfold mean, x0, of_list in L2. simpl in L2. lra.
    + intros k. rewrite !(loop_sample 2 unbalanced_pair alpha gamma h x0 D _ _ HL k) by lia.
      apply K.
Qed.

(** The path of three agents. *)
Definition path3 : mat := fun i j =>
  match i, j with
  | 0%nat, 1%nat | 1%nat, 0%nat | 1%nat, 2%nat | 2%nat, 1%nat => 1
  | _, _ => 0
  end.
Ltac below3 i := destruct i as [|[|[|i]]]; [| | |lia].

Lemma path3_balanced : balanced 3 path3.
Proof. intros i Hi. below3 i; simpl; lra. Qed.

Lemma path3_lambda2 : is_lambda2 3 path3 1.
Proof.
  assert (F : forall x, form 3 (laplacian_sym 3 path3) x
                        = (x 0%nat - x 1%nat) ^ 2 + (x 1%nat - x 2%nat) ^ 2).
  { intros x. rewrite (proj2 (quadratic_form 3%nat path3 x path3_balanced)). cbn. field. }
  split.
  - intros x Hx. rewrite F. unfold zero_sum in Hx. simpl in Hx. unfold dot. simpl sum_lt.
    replace (x 1%nat) with (- (x 0%nat + x 2%nat)) by lra.
    assert (S := pow2_ge_0 (x 0%nat + x 2%nat)). lra.
  - exists (of_list (1 :: 0 :: -1 :: nil)). rewrite F. unfold zero_sum, dot, of_list.
    simpl. split; [|split]; lra.
Qed.

Lemma path3_degree : degree_max 3 path3 = 2.
Proof.
  unfold degree_max, degree. cbn. rewrite !Rplus_0_l, !Rplus_0_r.
  unfold Rmax. repeat destruct Rle_dec; lra.
Qed.

(** betahat needs mu <= 1/D: at mu = 1 = 2/D on the path it is exceeded. *)
Theorem betahat_fails_beyond_gain_bound : forall sigma, is_sigma 3 path3 1 sigma ->
  is_lambda2 3 path3 1 /\
  1 - 2 * 1 * 1 * (1 - 1 * degree_max 3 path3) < sigma ^ 2.
Proof.
  intros s [[s0 Hs] _]. split; [exact path3_lambda2|]. rewrite path3_degree.
  set (e := of_list (1 :: -2 :: 1 :: nil)).
  assert (He : zero_sum 3 e) by (unfold zero_sum, e, of_list; simpl; lra).
  assert (C := contracts_dot 3 path3 1 s e (conj s0 Hs) He).
  rewrite (dot_ext 3 _ _ (fun i => -2 * e i) (fun i => -2 * e i)) in C.
  - unfold dot, e, of_list in C. simpl in C. nra.
  - intros i Hi. rewrite perron_entry, laplacian_entry by exact Hi.
    below3 i; unfold e, of_list; simpl; ring.
  - intros i Hi. rewrite perron_entry, laplacian_entry by exact Hi.
    below3 i; unfold e, of_list; simpl; ring.
Qed.

(** One pair of vectors proves that no mu of (15) contracts the path by 2/5. *)
Theorem emptiness_inhabited : forall mu s, 0 <= mu <= 1 / 2 -> contracts 3 path3 mu s ->
  2 / 5 < s.
Proof.
  set (v := of_list (1 :: 0 :: -1 :: nil)).
  assert (Hv : zero_sum 3 v) by (unfold zero_sum, v, of_list; simpl; lra).
  assert (T := emptiness 3%nat path3 1%nat (fun _ => v) (fun _ => v) (1 / 2) (2 / 5)
                 path3_balanced (fun _ _ => conj Hv Hv)).
  cbv zeta in T. destruct T as [_ T]. intros mu s Hmu Hc.
  apply (T ltac:(unfold dot, v, of_list; simpl; lra)
           ltac:(unfold dot, mv, laplacian, degree, v, of_list; simpl; lra) mu s Hmu Hc).
Qed.

(** A refuting Lyapunov form: a pair at mu = 2 > mu* = 1. *)
Theorem lyapunov_refutation_inhabited : exists Q x,
  (forall y, zero_sum 2 y ->
     form 2 Q (mv 2 (perron 2 pair_graph 2) y) <= form 2 Q y) /\
  zero_sum 2 x /\ form 2 Q x < 0.
Proof.
  exists (fun i j => - id_mat i j), (of_list (1 :: -1 :: nil)).
  assert (F : forall y, form 2 (fun i j => - id_mat i j) y = - dot 2 y y).
  { intros y. unfold form, dot, mv, id_mat. simpl. ring. }
  split; [|split].
  - intros y Hy. rewrite !F.
    rewrite (dot_ext 2 _ _ _ _ (fun i Hi => pair_perron 2 y i Hy Hi)
               (fun i Hi => pair_perron 2 y i Hy Hi)).
    rewrite dot_scal_l, dot_scal_r. assert (P := dot_nonneg 2 y). lra.
  - unfold zero_sum, of_list. simpl. lra.
  - rewrite F. unfold dot, of_list. simpl. lra.
Qed.

(** A matrix with its LDL^T factor. *)
Theorem ldlt_inhabited : forall x, 0 < dot 2 x x ->
  0 < form 2 (fun i j => if Nat.eqb i j then 2 else 1) x.
Proof.
  set (T := fun i j : nat => match i, j with
    | 0%nat, 0%nat | 1%nat, 1%nat => 1 | 1%nat, 0%nat => / 2 | _, _ => 0 end).
  set (d := fun i : nat => match i with O => 2 | _ => 3 / 2 end).
  apply (ldlt 2%nat _ T d).
  - intros i j Hi Hj. below2 i; below2 j; split; intros; simpl; reflexivity || lia.
  - intros i j Hi Hj. below2 i; below2 j; unfold T, d; simpl; lra.
  - intros i Hi. below2 i; simpl; lra.
Qed.

(** The hyperplane x_1 + x_2 = 0 shows lambda2 >= 2 on a pair. *)
Theorem hyperplane_inhabited : forall lambda2, is_lambda2 2 pair_graph lambda2 -> 2 <= lambda2.
Proof.
  intros l. apply (hyperplane 2%nat pair_graph ones 2 l); [lia|apply pair_assumption1|lra|].
  intros x Hx. rewrite pair_form. unfold dot, ones in *. simpl in *.
  replace (x 1%nat) with (- x 0%nat) by lra. lra.
Qed.
