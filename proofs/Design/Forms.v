(** What a nonnegative integer form shows: a contraction factor, a lower bound of lambda2, decay. *)
From Coq Require Import Reals ZArith List Bool Lia Lra.
From Fomas Require Import Model.Vectors Model.Graph Statements.
From Fomas Require Import Facts.Sums Facts.Vectors Facts.Graph Results.Soundness Results.Regions.
From Fomas Require Import Design.Integers Design.Weights Design.Claims.
Open Scope R_scope.

Section Certificate.
Variables (N : nat) (W : zmat) (d : Z).
Hypothesis Hd : (0 < d)%Z.
Let A := weighted W d.

(** b^2 (|x|^2 - |P_t x|^2 (sq/sp)^2) >= 0: the factor sp/sq at t = tp/tq. *)
Lemma contracts_form tp tq sp sq w :
  ((0 <? tq) && (0 <=? sp) && (0 <? sq))%Z = true ->
  (forall x, 0 <= form N (real (stein N (identity N) (perron_table N W d tp tq)
     (sp * sp * (tq * d * (tq * d))) (sq * sq) 0 w)) x) ->
  contracts N A (IZR tp / IZR tq) (IZR sp / IZR sq).
Proof.
  intros H M. apply andb_prop in H. destruct H as [H Hs]. apply andb_prop in H. destruct H as [Ht Hp].
  apply Z.ltb_lt in Ht, Hs. apply Z.leb_le in Hp.
  assert (T := IZR_lt _ _ Ht). assert (S := IZR_lt _ _ Hs). assert (P := IZR_le _ _ Hp).
  assert (D := IZR_lt _ _ Hd). split; [apply Rle_mult_inv_pos; assumption|]. intros e He.
  assert (B := M e).
  rewrite form_stein, !real_identity in B by exact He.
  set (Pe := mv N (perron N A (IZR tp / IZR tq)) e).
  rewrite (dot_ext N (mv N (real _) e) _ (fun i => IZR (tq * d) * Pe i) (fun i => IZR (tq * d) * Pe i))
    in B by (intros; apply mv_perron_table; assumption).
  rewrite dot_scal_l, dot_scal_r, !mult_IZR in B.
  apply norm_le_bound.
  { apply Rmult_le_pos; [apply Rle_mult_inv_pos; assumption|apply norm_nonneg]. }
  rewrite Rpow_mult_distr, norm_pow2.
  assert (TD : 0 < IZR tq * IZR d) by (apply Rmult_lt_0_compat; assumption).
  set (td := IZR tq * IZR d) in *.
  apply Rmult_le_reg_l with (td * td * (IZR sq * IZR sq)).
  { repeat apply Rmult_lt_0_compat; assumption. }
  replace (td * td * (IZR sq * IZR sq) * ((IZR sp / IZR sq) ^ 2 * dot N e e))
    with (IZR sp * IZR sp * (td * td) * dot N e e) by (field; lra).
  lra.
Qed.

Lemma contracts_sound tp tq sp sq w F K eps :
  ((0 <? tq) && (0 <=? sp) && (0 <? sq))%Z = true ->
  nonnegative N (stein N (identity N) (perron_table N W d tp tq)
    (sp * sp * (tq * d * (tq * d))) (sq * sq) 0 w) F K eps = true ->
  contracts N A (IZR tp / IZR tq) (IZR sp / IZR sq).
Proof.
  intros H M. apply (contracts_form tp tq sp sq w H), (nonnegative_sound _ _ _ _ _ M).
Qed.

(** Every eigenvalue of L_s on 1perp is at most p/q. *)
Lemma form_upper p q w : (0 <? q)%Z = true ->
  (forall x, 0 <= form N (real (stein N (symmetric_table N W) (identity N)
     (- q) 0 (- (2 * d * p)) w)) x) ->
  forall x, zero_sum N x -> form N (laplacian_sym N A) x <= IZR p / IZR q * dot N x x.
Proof.
  intros Hq M x Hx. apply Z.ltb_lt, IZR_lt in Hq. assert (D := IZR_lt _ _ Hd).
  assert (B := M x). rewrite form_stein, form_symmetric_table with (d := d) in B by assumption.
  fold A in B. rewrite !opp_IZR, !mult_IZR in B.
  apply Rmult_le_reg_l with (2 * IZR d * IZR q); [nra|].
  replace (2 * IZR d * IZR q * (IZR p / IZR q * dot N x x)) with (2 * IZR d * IZR p * dot N x x)
    by (field; lra).
  lra.
Qed.

(** lambda2 >= p/q. *)
Lemma lambda2_lower p q w F K eps lambda2 : (0 <? q)%Z = true ->
  nonnegative N (stein N (symmetric_table N W) (identity N) q 0 (2 * d * p) w) F K eps = true ->
  is_lambda2 N A lambda2 -> IZR p / IZR q <= lambda2.
Proof.
  intros Hq M [_ [v [Hv [Pv Ev]]]]. apply Z.ltb_lt, IZR_lt in Hq. assert (D := IZR_lt _ _ Hd).
  assert (B := nonnegative_sound _ _ _ _ _ M v).
  rewrite form_stein, form_symmetric_table with (d := d) in B by assumption. fold A in B.
  rewrite Ev, !mult_IZR in B.
  apply Rmult_le_reg_r with (2 * IZR d * IZR q * dot N v v).
  { repeat apply Rmult_lt_0_compat; lra. }
  replace (IZR p / IZR q * (2 * IZR d * IZR q * dot N v v)) with (2 * IZR d * IZR p * dot N v v)
    by (field; lra).
  lra.
Qed.

(** A Lyapunov matrix Q at t = tp/tq, with Q >= c and Q - P^T Q P >= c' > 0 on 1perp. *)
Lemma lyapunov_sound Q tp tq c w1 F1 K1 eps1 c' w2 F2 K2 eps2 mu : balanced N A ->
  ((0 <? tq) && (0 <? c) && (0 <? c'))%Z = true ->
  below N (fun i => below N (fun j => entry Q i j =? entry Q j i)%Z) = true ->
  nonnegative N (stein N Q (identity N) 1 0 c w1) F1 K1 eps1 = true ->
  nonnegative N (stein N Q (perron_table N W d tp tq) (tq * d * (tq * d)) 1 c' w2)
    F2 K2 eps2 = true ->
  0 < mu <= IZR tp / IZR tq -> decays N A mu.
Proof.
  intros bal H Sy M1 M2 Hmu.
  apply andb_prop in H. destruct H as [H Hc']. apply andb_prop in H. destruct H as [Ht Hc].
  apply Z.ltb_lt in Ht, Hc, Hc'.
  assert (T := IZR_lt _ _ Ht). assert (C := IZR_lt _ _ Hc). assert (C' := IZR_lt _ _ Hc').
  assert (D := IZR_lt _ _ Hd).
  assert (TD : 0 < IZR tq * IZR d) by (apply Rmult_lt_0_compat; assumption).
  set (td := IZR tq * IZR d) in *.
  assert (sym : forall i j, (i < N)%nat -> (j < N)%nat -> real Q i j = real Q j i).
  { intros i j Hi Hj. apply (below_true N _ Sy) in Hi. apply (below_true N _ Hi) in Hj.
    unfold real. f_equal. apply Z.eqb_eq, Hj. }
  assert (low : forall x, zero_sum N x -> IZR c * dot N x x <= form N (real Q) x).
  { intros x Hx. assert (B := nonnegative_sound _ _ _ _ _ M1 x). rewrite form_stein in B by exact Hx.
    lra. }
  assert (dec : forall x, zero_sum N x ->
    form N (real Q) (mv N (perron N A (IZR tp / IZR tq)) x)
    <= form N (real Q) x - IZR c' / (td * td) * dot N x x).
  { intros x Hx. assert (B := nonnegative_sound _ _ _ _ _ M2 x). rewrite form_stein in B by exact Hx.
    rewrite (form_ext N (real Q) (mv N (real _) x)
      (fun i => IZR (tq * d) * mv N (perron N A (IZR tp / IZR tq)) x i)) in B
      by (intros; apply mv_perron_table; assumption).
    rewrite form_scal, !mult_IZR in B. fold td in B.
    apply Rmult_le_reg_l with (td * td); [nra|]. rewrite Rmult_minus_distr_l.
    replace (td * td * (IZR c' / (td * td) * dot N x x)) with (IZR c' * dot N x x) by (field; lra).
    simpl in B. lra. }
  set (hi := \sum_(i < N) \sum_(j < N) Rabs (real Q i j) + IZR c' / (td * td) + IZR c).
  assert (C2 : 0 < IZR c' / (td * td)) by (apply Rdiv_lt_0_compat; nra).
  assert (hi0 : 0 <= \sum_(i < N) \sum_(j < N) Rabs (real Q i j))
    by (apply sum_nonneg; intros; apply sum_nonneg; intros; apply Rabs_pos).
  assert (high : forall x, form N (real Q) x <= hi * dot N x x).
  { intros x. apply Rle_trans with ((\sum_(i < N) \sum_(j < N) Rabs (real Q i j)) * dot N x x).
    2: { apply Rmult_le_compat_r; [apply dot_nonneg|unfold hi; lra]. }
    rewrite form_double_sum, <- sum_scal_r. apply sum_le. intros i Hi. rewrite <- sum_scal_r.
    apply sum_le. intros j Hj.
    assert (X : Rabs (x i) * Rabs (x j) <= dot N x x).
    { rewrite <- norm_sq. apply Rmult_le_compat; try apply Rabs_pos; apply entry_le_norm; assumption. }
    eapply Rle_trans; [apply Rle_abs|]. rewrite Rmult_assoc, !Rabs_mult.
    apply Rmult_le_compat_l; [apply Rabs_pos|exact X]. }
  set (rho2 := 1 - IZR c' / (td * td) / hi).
  assert (R : 0 <= rho2 < 1).
  { assert (0 < IZR c' / (td * td) / hi) by (apply Rdiv_lt_0_compat; unfold hi; lra).
    assert (IZR c' / (td * td) / hi <= 1); [|unfold rho2; lra].
    apply Rmult_le_reg_r with hi; [unfold hi; lra|]. unfold Rdiv at 1.
    rewrite Rmult_assoc, Rinv_l by (unfold hi; lra). unfold hi. lra. }
  destruct (consensus_interval N A (real Q) rho2 (IZR tp / IZR tq) mu bal sym) as [rho [Hr HP]].
  - intros x Hx. eapply Rle_trans; [|apply low, Hx].
    apply Rmult_le_pos; [lra|apply dot_nonneg].
  - exact R.
  - exact Hmu.
  - intros x Hx. eapply Rle_trans; [apply dec, Hx|]. unfold rho2.
    assert (IZR c' / (td * td) / hi * form N (real Q) x <= IZR c' / (td * td) * dot N x x).
    { apply Rle_trans with (IZR c' / (td * td) / hi * (hi * dot N x x)).
      - apply Rmult_le_compat_l; [|apply high]. apply Rlt_le, Rdiv_lt_0_compat; unfold hi; lra.
      - right. field. unfold hi. split; lra. }
    lra.
  - exists (sqrt (hi / IZR c)), rho. split; [apply sqrt_pos|]. split; [exact Hr|].
    apply (lyapunov N A mu (real Q)); try assumption; [lra|]. intros x Hx. split; [apply low, Hx|].
    apply high.
Qed.
End Certificate.
