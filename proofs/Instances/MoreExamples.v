(** Inhabited hypotheses of the peak lemma, of Lyapunov certificates, of residual factors and of
    Remark 1; boundedness, the peak bound and Remark 1 fail without theirs. *)
From Coq Require Import Reals Arith Lia Lra.
From Coquelicot Require Import Coquelicot.
From Fomas Require Import Model.Vectors Model.Kernel Model.Gamma Model.Graph Model.Loop Model.Examples Statements.
From Fomas Require Import Facts.Sums Facts.Vectors Facts.Kernel Facts.Resolvent Facts.Gamma.
From Fomas Require Import Facts.Graph Facts.Loop Facts.Phi.
From Fomas Require Import Results.ClosedLoop Results.Soundness Results.NormBound Results.Remark1.
From Fomas Require Import Instances.PairGraph Instances.Examples.
Open Scope R_scope.

(** At mu = 1/2 a pair agrees in one step: P vanishes on 1perp. *)
Lemma pair_half_powers n e : zero_sum 2 e -> (1 <= n)%nat ->
  norm 2 (iter n (mv 2 (perron 2 pair_graph (/ 2))) e) = 0.
Proof.
  intros He Hn. apply norm_zero. destruct n as [|n]; [lia|]. intros i Hi. simpl.
  rewrite pair_perron; [field| |exact Hi].
  apply zero_sum_iter; [apply pair_assumption1|exact He].
Qed.

Theorem peak_inhabited : forall alpha, 0 < alpha < 1 ->
  let P := perron 2 pair_graph (/ 2) in
  (forall k, (k <= 0)%nat -> bounded_on_1perp 2 (Phi alpha 2 P k) 1) /\
  (forall n, (0 < n)%nat -> bounded_on_1perp 2 (iter n (mv 2 P)) (1 * ck alpha n)) /\
  bounded_on_1perp 2 (iter 1 (mv 2 P)) (ck alpha 2 / ck alpha 1).
Proof.
  intros alpha Ha P.
  assert (C : forall n, (1 <= n)%nat -> forall c, 0 <= c -> bounded_on_1perp 2 (iter n (mv 2 P)) c).
  { intros n Hn c Hc e He. unfold P. rewrite pair_half_powers by assumption.
    apply Rmult_le_pos; [exact Hc|apply norm_nonneg]. }
  split; [|split].
  - intros k Hk e He. replace k with 0%nat by lia.
    rewrite (norm_ext 2 _ e) by (intros; apply phi_0). lra.
  - intros n Hn. apply C; [lia|]. assert (Q := ck_pos alpha Ha n). lra.
  - apply C; [lia|]. apply Rmult_le_pos; [left; apply ck_pos, Ha|].
    left. apply Rinv_0_lt_compat, ck_pos, Ha.
Qed.

(** Without decay the peak bound fails: at mu = 2 a pair's P is -3 on 1perp, and Phi_1
    exceeds every bound that Phi_0 meets with M = 1. *)
Theorem peak_fails_without_decay : forall alpha, 0 < alpha < 1 ->
  let P := perron 2 pair_graph 2 in
  bounded_on_1perp 2 (Phi alpha 2 P 0) 1 /\ ~ bounded_on_1perp 2 (Phi alpha 2 P 1) 1.
Proof.
  intros alpha Ha P. split.
  - intros e He. rewrite (norm_ext 2 _ e) by (intros; apply phi_0). lra.
  - intros H. set (e := of_list (1 :: -1 :: nil)%list).
    assert (He : zero_sum 2 e) by (unfold zero_sum, e, of_list; simpl; lra).
    specialize (H e He). unfold P in H.
    rewrite (norm_ext 2 _ _ (fun i Hi => pair_phi alpha 2 1 e i He Hi)), norm_scal in H.
    assert (Ne : 0 < norm 2 e).
    { apply sqrt_lt_R0. unfold dot, e, of_list. simpl. lra. }
    apply Rmult_le_reg_r in H; [|exact Ne].
    assert (R1 := rk_le_1 alpha Ha 1). assert (R0 := rk_pos alpha Ha 1).
    simpl in H. rewrite rk_0 in H. rewrite Rabs_left in H by lra. lra.
Qed.

(** A Lyapunov certificate: Q = I, rho = 0 at mu = 1/2. *)
Theorem lyapunov_inhabited :
  (forall x, zero_sum 2 x -> 1 * dot 2 x x <= form 2 id_mat x <= 1 * dot 2 x x) /\
  (forall x, zero_sum 2 x ->
     form 2 id_mat (mv 2 (perron 2 pair_graph (/ 2)) x) <= 0 ^ 2 * form 2 id_mat x).
Proof.
  assert (F : forall x, form 2 id_mat x = dot 2 x x).
  { intros x. unfold form. apply dot_ext; [reflexivity|]. intros i Hi. apply id_mat_sum, Hi. }
  split; intros x Hx; rewrite !F; [lra|].
  rewrite (dot_ext 2 _ _ _ _ (fun i Hi => pair_perron (/ 2) x i Hx Hi)
             (fun i Hi => pair_perron (/ 2) x i Hx Hi)).
  rewrite dot_scal_l, dot_scal_r. assert (P := dot_nonneg 2 x). nra.
Qed.

(** A factor with a residual that is not zero: [[2, 1], [1, 2]] - (1/4) I = R R^T + E. *)
Theorem residual_factor_inhabited : forall x,
  0 <= form 2 (fun i j => if Nat.eqb i j then 2 else 1) x.
Proof.
  set (Q := fun i j : nat => if Nat.eqb i j then 2 else 1).
  set (R := fun i k : nat => match i, k with
    | 0%nat, 0%nat => 5 / 4 | 1%nat, 0%nat => 4 / 5 | 1%nat, 1%nat => 1 | _, _ => 0 end).
  set (E := fun i j : nat => Q i j - / 4 * id_mat i j - \sum_(k < 2) (R i k * R j k)).
  apply (residual_factor 2%nat 2%nat Q R E (/ 4)).
  - intros i j _ _. unfold E. ring.
  - intros i j Hi Hj. unfold E. below2 i; below2 j; unfold Q, R, id_mat; simpl; ring.
  - intros i Hi. below2 i; unfold E, Q, R, id_mat; simpl; unfold Rabs;
      repeat destruct Rcase_abs; lra.
Qed.

(** The peak lemma with M > 1: where c_1 < beta < 1 on a pair, eqL3 fails at k = 1 and yet
    M = 1/(1 - beta) bounds every control. *)
Theorem peak_above_one_inhabited : forall alpha, 0 < alpha < 1 -> exists mu M K,
  let P := perron 2 pair_graph mu in
  0 < mu /\ 1 < M /\
  (forall k, (k <= K)%nat -> bounded_on_1perp 2 (Phi alpha 2 P k) M) /\
  (forall n, (K < n)%nat -> bounded_on_1perp 2 (iter n (mv 2 P)) (M * ck alpha n)) /\
  ~ bounded_on_1perp 2 (Phi alpha 2 P 1) 1.
Proof.
  intros alpha Ha. assert (C1 := ck_pos alpha Ha 1). assert (C2 := ck_lt_1 alpha Ha 1 (le_n 1)).
  set (b := (1 + ck alpha 1) / 2). assert (Hb : 0 < b < 1 /\ ck alpha 1 < b) by (unfold b; lra).
  destruct (geometric_below_ck alpha 1 b Ha ltac:(lra) ltac:(lra)) as [K HK].
  exists ((1 - b) / 2), (/ (1 - b)), K. intros P.
  assert (M1 : 1 < / (1 - b)) by (rewrite <- Rinv_1 at 1; apply Rinv_lt_contravar; lra).
  assert (B : 1 - (1 - b) / 2 * 2 = b) by field.
  assert (Pn : forall n, bounded_on_1perp 2 (iter n (mv 2 P)) (b ^ n)).
  { intros n e He. unfold P. rewrite (norm_ext 2 _ _ (fun i Hi => pair_iter _ n e i He Hi)), B.
    rewrite norm_scal, Rabs_right; [lra|]. apply Rle_ge, pow_le. lra. }
  split; [lra|]. split; [exact M1|]. split; [|split].
  - intros k _ e He.
    assert (D : decays_on_1perp 2 (mv 2 P) 1 b).
    { intros n y Hy. rewrite Rmult_1_l. apply Pn, Hy. }
    eapply Rle_trans; [apply (phi_decay 2 P alpha Ha 1 b k ltac:(lra) ltac:(lra) D e He)|].
    apply Rmult_le_compat_r; [apply norm_nonneg|]. rewrite Rmult_1_l.
    apply resolvent_geom_bound; [exact Ha|lra].
  - intros n Hn e He. eapply Rle_trans; [apply Pn, He|].
    apply Rmult_le_compat_r; [apply norm_nonneg|]. specialize (HK n Hn).
    assert (Q := ck_pos alpha Ha n). nra.
  - intros F. set (e := of_list (1 :: -1 :: nil)%list).
    assert (He : zero_sum 2 e) by (unfold zero_sum, e, of_list; simpl; lra).
    specialize (F e He). unfold P in F.
    rewrite (norm_ext 2 _ _ (fun i Hi => pair_phi alpha _ 1 e i He Hi)), norm_scal, B in F.
    assert (Ne : 0 < norm 2 e) by (apply sqrt_lt_R0; unfold dot, e, of_list; simpl; lra).
    apply Rmult_le_reg_r in F; [|exact Ne]. simpl in F.
    rewrite rk_0, rk_S in F. simpl in F. rewrite rk_0, fk_ck, ck_0 in F.
    rewrite Rabs_right in F; lra.
Qed.

(** Beyond (15) the states need not stay bounded: a pair at mu = 2 triples its disagreement. *)
Theorem signals_unbounded_beyond_gain_bound : forall alpha, 0 < alpha < 1 ->
  exists gamma h x0 x u, design alpha gamma h /\
  closed_loop 2 pair_graph alpha gamma h x0 x u /\
  ~ exists B, forall t i, 0 <= t -> (i < 2)%nat -> Rabs (x t i) <= B.
Proof.
  intros alpha Ha. destruct (design_for_mu alpha 2 Ha ltac:(lra)) as [D E].
  set (x0 := of_list (1 :: -1 :: nil)%list).
  assert (Z : zero_sum 2 x0) by (unfold zero_sum, x0, of_list; simpl; lra).
  assert (HL := exact_loop 2 pair_graph alpha _ 1 x0 D).
  eexists. exists 1, x0. eexists. eexists. split; [exact D|]. split; [exact HL|].
  intros [B HB]. destruct (nfloor_ex (Rmax 0 B)) as [n [_ Hn]]; [apply Rmax_l|].
  assert (MB := Rmax_r 0 B).
  specialize (HB (INR n * 1) 0%nat ltac:(rewrite Rmult_1_r; apply pos_INR) ltac:(lia)).
  rewrite (loop_sample 2 pair_graph alpha _ 1 x0 D _ _ HL n 0 ltac:(lia)), E in HB.
  rewrite pair_iter in HB by (assumption || lia). unfold x0, of_list in HB. simpl List.nth in HB.
  replace (1 - 2 * 2) with (-1 * 3) in HB by ring.
  rewrite Rmult_1_r, Rpow_mult_distr, Rabs_mult, pow_1_abs, Rmult_1_l in HB.
  assert (P := poly n 2 ltac:(lra)). replace (1 + 2) with 3 in P by ring.
  rewrite Rabs_right in HB by (apply Rle_ge, pow_le; lra). assert (N0 := pos_INR n). lra.
Qed.

(** Remark 1: a pair in the plane at mu = 1/2 meets every hypothesis. *)
Theorem remark1_inhabited : forall alpha x0, 0 < alpha < 1 -> exists gamma h x u,
  assumption1 2 pair_graph /\ design alpha gamma h /\
  gain_bound 2 pair_graph (mu_of alpha gamma h) /\ control_norm_bound 2 pair_graph alpha gamma h /\
  closed_loop (2 * 2) (kron_id 2 pair_graph) alpha gamma h x0 x u.
Proof.
  intros alpha x0 Ha. destruct (repaired_inhabited alpha Ha) as [gamma [h [D [G [_ B]]]]].
  destruct (proj1 (closed_loop_exists (2 * 2)%nat (kron_id 2 pair_graph) alpha gamma h x0 D))
    as [x [u H]].
  exists gamma, h, x, u. split; [exact pair_assumption1|]. split; [exact D|].
  split; [exact G|]. split; [exact B|exact H].
Qed.

(** And at mu = 1/D agents in the plane need not agree. *)
Theorem remark1_fails_at_gain_limit : forall alpha, 0 < alpha < 1 -> exists gamma h x0 x u,
  design alpha gamma h /\ mu_of alpha gamma h * degree_max 2 pair_graph = 1 /\
  closed_loop (2 * 2) (kron_id 2 pair_graph) alpha gamma h x0 x u /\
  ~ is_lim_seq (fun k => agent 2 0 (x (INR k * h)) 0%nat) (mean 2 (coordinate 2 0 x0)).
Proof.
  intros alpha Ha. destruct (design_for_mu alpha 1 Ha ltac:(lra)) as [D E].
  set (x0 := of_list (1 :: 5 :: -1 :: 7 :: nil)%list).
  destruct (proj1 (closed_loop_exists (2 * 2)%nat (kron_id 2 pair_graph) alpha _ 1 x0 D)) as [x [u H]].
  eexists. exists 1, x0, x, u. split; [exact D|]. split; [rewrite E, pair_degree; ring|].
  split; [exact H|].
  apply (pair_swaps alpha _ 1 _ _ _ D E (coordinate_loop 2 2 _ _ _ _ _ _ _ H 0 ltac:(lia)));
    reflexivity.
Qed.
