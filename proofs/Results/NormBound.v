(** The norm bound eqL3: the repaired Theorem 1, the peak lemma, and necessity. *)
From Coq Require Import Reals Arith Lia Lra.
From Coquelicot Require Import Coquelicot.
From Fomas Require Import Model.Vectors Model.Kernel Model.Gamma Model.Graph Model.Loop Statements.
From Fomas Require Import Facts.Sums Facts.Vectors Facts.Kernel Facts.Resolvent Facts.Gamma.
From Fomas Require Import Results.EqT2 Facts.Graph Facts.Lambda2 Facts.Contraction Facts.Loop Facts.Phi Facts.Between.
Open Scope R_scope.

Theorem peak_lemma : peak_lemma_statement.
Proof. intros N A mu alpha M K Ha HM P H0 H1. apply (phi_peak N P alpha Ha M K HM H0 H1). Qed.

Theorem peak_tail : peak_tail_statement.
Proof.
  intros N A mu alpha M K m Ha HM Hm bal P H0 H1 n.
  induction n as [n IH] using lt_wf_ind. intros Hn.
  destruct (le_lt_dec n (K + m)) as [L|L]; [apply H0; lia|]. intros e He.
  replace n with ((n - m) + m)%nat at 1 by lia. rewrite iter_plus.
  assert (Hz : zero_sum N (iter m (mv N P) e)) by (apply zero_sum_iter; assumption).
  eapply Rle_trans; [apply (IH (n - m)%nat); [lia|lia|exact Hz]|].
  assert (B := H1 e He).
  assert (C := ck_ratio_le_gen alpha Ha (K + 1) (n - m) m ltac:(lia)).
  replace (n - m + m)%nat with n in C by lia.
  assert (P1 := ck_pos alpha Ha (K + 1)). assert (P2 := ck_pos alpha Ha (n - m)).
  assert (Q : ck alpha (n - m) * (ck alpha (K + 1 + m) / ck alpha (K + 1)) <= ck alpha n).
  { apply Rmult_le_reg_r with (ck alpha (K + 1)); [exact P1|].
    replace (ck alpha (n - m) * (ck alpha (K + 1 + m) / ck alpha (K + 1)) * ck alpha (K + 1))
      with (ck alpha (K + 1 + m) * ck alpha (n - m)) by (field; lra). lra. }
  apply Rle_trans with (M * ck alpha (n - m)
    * (ck alpha (K + 1 + m) / ck alpha (K + 1) * norm N e)).
  - apply Rmult_le_compat_l; [nra|exact B].
  - replace (M * ck alpha (n - m) * (ck alpha (K + 1 + m) / ck alpha (K + 1) * norm N e))
      with (M * norm N e * (ck alpha (n - m) * (ck alpha (K + 1 + m) / ck alpha (K + 1)))) by ring.
    replace (M * ck alpha n * norm N e) with (M * norm N e * ck alpha n) by ring.
    apply Rmult_le_compat_l; [|exact Q]. apply Rmult_le_pos; [lra|apply norm_nonneg].
Qed.

(** c_n falls no faster than 1/n, so it outlives every geometric sequence. *)
Lemma ck_lower alpha n : 0 < alpha < 1 -> (1 <= n)%nat -> ck alpha 1 / INR n <= ck alpha n.
Proof.
  intros Ha Hn. assert (Pn : 1 <= INR n) by (apply (le_INR 1); exact Hn).
  assert (S1 : \sum_(i < n) ck alpha (n + i) <= INR n * ck alpha n).
  { rewrite <- sum_const. apply sum_le. intros i _. apply ck_le; [exact Ha|lia]. }
  assert (S2 := ck_sum alpha (n + n)). rewrite sum_split, ck_sum in S2.
  assert (S3 : rpow (INR (n + n)) alpha = rpow 2 alpha * rpow (INR n) alpha).
  { rewrite <- rpow_mult by lra. f_equal. rewrite plus_INR. ring. }
  assert (S4 : 1 <= rpow (INR n) alpha).
  { rewrite <- (rpow_1 alpha). apply rpow_le; lra. }
  assert (C1 := ck_1 alpha). rewrite <- rpow_pos in C1 by lra.
  assert (P1 := ck_pos alpha Ha 1).
  apply Rmult_le_reg_l with (INR n); [lra|].
  replace (INR n * (ck alpha 1 / INR n)) with (ck alpha 1) by (field; lra).
  rewrite S3 in S2. nra.
Qed.

Lemma geometric_below_ck alpha C rho : 0 < alpha < 1 -> 0 <= C -> 0 <= rho < 1 ->
  exists K, forall n, (K < n)%nat -> C * rho ^ n <= ck alpha n.
Proof.
  intros Ha HC Hr. set (rho' := Rmax rho (/ 4)).
  assert (R1 : rho <= rho') by apply Rmax_l. assert (R2 : / 4 <= rho') by apply Rmax_r.
  assert (R3 : rho' < 1) by (apply Rmax_lub_lt; lra).
  (* with q = sqrt rho', n q^n is bounded by Bernoulli and q^n vanishes *)
  set (q := sqrt rho'). assert (Q : q * q = rho') by (apply sqrt_sqrt; lra).
  assert (Q0 : 0 < q) by (apply sqrt_lt_R0; lra).
  assert (Q1 : q < 1) by (assert (q0 := sqrt_pos rho'); nra).
  set (p := / q - 1).
  assert (Pp : 0 < p).
  { unfold p. assert (1 < / q); [|lra]. rewrite <- Rinv_1. apply Rinv_lt_contravar; lra. }
  assert (B : forall n, INR n * q ^ n <= / p).
  { intros n. assert (T := poly n p Pp). replace (1 + p) with (/ q) in T by (unfold p; ring).
    rewrite pow_inv in T.
    assert (Qn : 0 < q ^ n) by (apply pow_lt, Q0).
    apply Rmult_le_reg_l with p; [exact Pp|]. rewrite Rinv_r by lra.
    apply Rmult_le_compat_r with (r := q ^ n) in T; [|lra].
    rewrite Rinv_l in T by lra. nra. }
  assert (P1 := ck_pos alpha Ha 1).
  assert (G : is_lim_seq (fun n => q ^ n) 0) by (apply is_lim_seq_geom; rewrite Rabs_right; lra).
  assert (E : 0 < ck alpha 1 * p / (C + 1)) by (apply Rdiv_lt_0_compat; nra).
  apply is_lim_seq_spec in G. destruct (G (mkposreal _ E)) as [K HK]. simpl in HK.
  exists K. intros n Hn. eapply Rle_trans; [|apply ck_lower; [exact Ha|lia]].
  assert (Pn : 1 <= INR n) by (apply (le_INR 1); lia).
  apply Rmult_le_reg_l with (INR n); [lra|].
  replace (INR n * (ck alpha 1 / INR n)) with (ck alpha 1) by (field; lra).
  specialize (HK n ltac:(lia)). rewrite Rminus_0_r in HK. apply Rabs_def2 in HK.
  assert (Qn : 0 < q ^ n) by (apply pow_lt, Q0).
  assert (Rn : rho ^ n <= q ^ n * q ^ n).
  { rewrite <- Rpow_mult_distr, Q. apply pow_incr. lra. }
  specialize (B n).
  apply Rle_trans with (C * (INR n * q ^ n) * q ^ n).
  - replace (INR n * (C * rho ^ n)) with (C * INR n * rho ^ n) by ring.
    replace (C * (INR n * q ^ n) * q ^ n) with (C * INR n * (q ^ n * q ^ n)) by ring.
    apply Rmult_le_compat_l; [nra|exact Rn].
  - apply Rle_trans with (C * / p * (ck alpha 1 * p / (C + 1))).
    + apply Rmult_le_compat; [|lra| |lra].
      * apply Rmult_le_pos; [exact HC|]. apply Rmult_le_pos; lra.
      * apply Rmult_le_compat_l; assumption.
    + replace (C * / p * (ck alpha 1 * p / (C + 1))) with (ck alpha 1 * (C / (C + 1)))
        by (field; lra).
      rewrite <- (Rmult_1_r (ck alpha 1)) at 2. apply Rmult_le_compat_l; [lra|].
      apply Rmult_le_reg_r with (C + 1); [lra|]. unfold Rdiv.
      rewrite Rmult_assoc, Rinv_l by lra. lra.
Qed.

Theorem peak_attained : peak_attained_statement.
Proof.
  intros N A mu alpha C rho Ha HC Hr P Hd.
  destruct (geometric_below_ck alpha C rho Ha HC Hr) as [K HK]. exists K.
  intros M HM H0. apply (phi_peak N P alpha Ha M K HM H0).
  intros n Hn. apply bounded_weaken with (C * rho ^ n); [|apply Hd].
  eapply Rle_trans; [apply HK, Hn|]. assert (Q := ck_pos alpha Ha n). nra.
Qed.

Lemma bound_from_phi N A alpha gamma h : balanced N A -> design alpha gamma h ->
  (forall k, bounded_on_1perp N (Phi alpha N (perron N A (mu_of alpha gamma h)) k) 1) ->
  control_norm_bound N A alpha gamma h.
Proof.
  intros bal D H x0 x u HL k.
  rewrite (norm_ext N _ _ (loop_phi N A alpha gamma h x0 D x u HL k)).
  eapply Rle_trans; [apply H, (loop_u0_zero_sum N A alpha gamma h x0 D x u bal HL)|]. lra.
Qed.

Theorem eqL3_from_powers : eqL3_from_powers_statement.
Proof.
  intros N A alpha gamma h bal D P H. apply bound_from_phi; [exact bal|exact D|].
  apply (phi_peak N P alpha (proj1 D) 1 0); [lra| |].
  - intros k Hk e He. replace k with 0%nat by lia.
    rewrite (norm_ext N _ e) by (intros; apply phi_0). lra.
  - intros n Hn e He. rewrite Rmult_1_l. apply H; [lia|exact He].
Qed.

Theorem theorem1_repaired : theorem1_repaired_statement.
Proof.
  intros N A alpha gamma h bal D Hc. apply eqL3_from_powers; [exact bal|exact D|].
  intros n Hn. assert (Hd := contracts_decay N A _ _ bal Hc n). destruct Hc as [s0 _].
  apply bounded_weaken with (1 * (Rpower 2 alpha - 1) ^ n); [|exact Hd].
  rewrite Rmult_1_l. replace n with (n * 1)%nat at 2 by lia.
  apply ck_pow; [apply D|exact s0|]. rewrite ck_1. lra.
Qed.

Theorem theorem1_repaired_closed_form : theorem1_repaired_closed_form_statement.
Proof.
  intros N A alpha gamma h l dig bal D Hl mu HG HB.
  apply theorem1_repaired; [exact bal|exact D|].
  destruct (gain_bound_lt N A _ HG) as [Hm HD]. fold mu in Hm, HD.
  assert (C0 := ck_pos alpha (proj1 D) 1). rewrite ck_1 in C0.
  split; [lra|]. intros e He. fold mu.
  apply norm_le_bound; [apply Rmult_le_pos; [lra|apply norm_nonneg]|].
  rewrite Rpow_mult_distr, norm_pow2.
  eapply Rle_trans; [apply (perron_contracts N A bal dig mu l e)|].
  - lra.
  - lra.
  - rewrite <- form_sym. apply Hl, He.
  - apply Rmult_le_compat_r; [apply dot_nonneg|exact HB].
Qed.

(** * The range of L is dense in 1perp *)

(** From x_0 = -(nu/gamma) sum_{j<n} (I - nu L)^j v the loop starts with
    u_0 = v - (I - nu L)^n v. *)
Lemma reachable_control N A gamma nu v n i : 0 < gamma -> (i < N)%nat ->
  - gamma * mv N (laplacian N A)
      (fun q => \sum_(j < n) (- (nu / gamma) * iter j (mv N (perron N A nu)) v q)) i
  = v i - iter n (mv N (perron N A nu)) v i.
Proof.
  intros Hg Hi. rewrite mv_sum. induction n as [|n IH]; [simpl; ring|].
  rewrite sum_last, Rmult_plus_distr_l, IH, mv_scal. simpl iter.
  rewrite perron_entry by exact Hi. field. lra.
Qed.

(** If a <= b + c s^n for every n, with 0 <= s < 1, then a <= b. *)
Lemma geometric_limit a b c s : 0 <= s < 1 -> (forall n, a <= b + c * s ^ n) -> a <= b.
Proof.
  intros Hs H.
  assert (G : is_lim_seq (fun n => b + c * s ^ n) b).
  { replace (Finite b) with (Finite (b + c * 0)) by (f_equal; ring).
    apply is_lim_seq_plus'; [apply is_lim_seq_const|].
    apply (is_lim_seq_scal_l (fun n => s ^ n) c 0).
    apply is_lim_seq_geom. rewrite Rabs_right; lra. }
  apply (is_lim_seq_le (fun _ => a) (fun n => b + c * s ^ n) a b H); [|exact G].
  apply is_lim_seq_const.
Qed.

Lemma phi_bounded N A mu alpha k : balanced N A -> 0 < alpha < 1 ->
  exists B, 0 <= B /\ bounded_on_1perp N (Phi alpha N (perron N A mu) k) B.
Proof.
  intros bal Ha. destruct (contracts_exists N A mu) as [s Hc].
  exists (1 * \sum_(j < S k) (rk alpha (k - j) * s ^ j)). split.
  - rewrite Rmult_1_l. apply sum_nonneg. intros j _.
    apply Rmult_le_pos; [left; apply rk_pos, Ha|apply pow_le, Hc].
  - apply phi_decay; [exact Ha|lra|apply Hc|apply contracts_decay; assumption].
Qed.

(** A bound of u_k by M ||u_0|| for every x_0 bounds Phi_k on 1perp. *)
Lemma phi_from_control N A alpha gamma h M k : assumption1 N A -> design alpha gamma h ->
  0 <= M -> (forall x0 x u, closed_loop N A alpha gamma h x0 x u ->
    norm N (u k) <= M * norm N (u 0%nat)) ->
  bounded_on_1perp N (Phi alpha N (perron N A (mu_of alpha gamma h)) k) M.
Proof.
  intros H1 D HM HB v Hv. assert (bal : balanced N A) by apply H1.
  set (P := perron N A (mu_of alpha gamma h)).
  (* any nu with nu D < 1 serves to approximate v by starting controls *)
  set (nu := / (1 + degree_max N A)).
  assert (D0 : 0 <= degree_max N A) by apply max_lt_nonneg.
  assert (Nu : 0 < nu) by (apply Rinv_0_lt_compat; lra).
  assert (ND : nu * degree_max N A < 1).
  { apply Rmult_lt_reg_l with (1 + degree_max N A); [lra|]. unfold nu.
    rewrite <- Rmult_assoc, Rinv_r by lra. lra. }
  destruct (strict_contraction N A nu H1 Nu ND) as [s [Hs Hc]].
  assert (Hd := contracts_decay N A nu s bal Hc).
  destruct (phi_bounded N A (mu_of alpha gamma h) alpha k bal (proj1 D)) as [B [B0 HPhi]].
  fold P in HPhi.
  apply (geometric_limit _ _ ((M + B) * norm N v) s); [split; [apply Hc|exact Hs]|]. intros n.
  set (w := iter n (mv N (perron N A nu)) v).
  assert (Hw : zero_sum N w) by (apply zero_sum_iter; assumption).
  assert (Nw : norm N w <= s ^ n * norm N v).
  { assert (T := Hd n v Hv). rewrite Rmult_1_l in T. exact T. }
  set (x0 := fun q => \sum_(j < n) (- (nu / gamma) * iter j (mv N (perron N A nu)) v q)).
  assert (HL := exact_loop N A alpha gamma h x0 D).
  assert (E0 : forall i, (i < N)%nat ->
            exact_control N A alpha gamma h x0 0 i = v i - w i).
  { intros i Hi. rewrite (loop_u0 N A alpha gamma h x0 D _ _ HL i Hi).
    apply reachable_control; [apply D|exact Hi]. }
  assert (T := HB x0 _ _ HL).
  rewrite (norm_ext N _ _ (loop_phi N A alpha gamma h x0 D _ _ HL k)) in T.
  rewrite (norm_ext N _ _ (phi_ext N _ alpha k _ _ E0)) in T.
  rewrite (norm_ext N _ _ E0) in T. fold P in T.
  assert (T1 : norm N (Phi alpha N P k v)
               <= norm N (Phi alpha N P k (fun j => v j - w j)) + norm N (Phi alpha N P k w)).
  { rewrite (norm_ext N (Phi alpha N P k v)
      (fun i => Phi alpha N P k (fun j => v j - w j) i + Phi alpha N P k w i)).
    - apply norm_triangle.
    - intros i Hi. rewrite phi_minus by exact Hi. ring. }
  assert (T2 := HPhi w Hw).
  assert (T3 : norm N (fun j => v j - w j) <= norm N v + norm N w).
  { rewrite (norm_ext N _ (fun j => v j + (-1) * w j)) by (intros; ring).
    eapply Rle_trans; [apply norm_triangle|]. rewrite norm_scal.
    rewrite Rabs_left by lra. lra. }
  assert (T4 : (M + B) * norm N w <= (M + B) * (s ^ n * norm N v))
    by (apply Rmult_le_compat_l; lra).
  assert (T5 : M * norm N (fun j => v j - w j) <= M * (norm N v + norm N w))
    by (apply Rmult_le_compat_l; assumption).
  lra.
Qed.

Theorem control_peak : control_peak_statement.
Proof.
  intros N A alpha gamma h M HN H1 D HM P reaches_at_most.
  assert (bal : balanced N A) by apply H1.
  assert (E : forall k, reaches_at_most k <-> bounded_on_1perp N (Phi alpha N P k) M).
  { intros k. split; [apply phi_from_control; assumption|]. intros B x0 x u HL.
    rewrite (norm_ext N _ _ (loop_phi N A alpha gamma h x0 D x u HL k)).
    apply B, (loop_u0_zero_sum N A alpha gamma h x0 D x u bal HL). }
  split; [exact E|]. intros K HM1 H0 Hp k. apply E.
  apply (phi_peak N P alpha (proj1 D) M K HM1); [|exact Hp]. intros j Hj. apply E, H0, Hj.
Qed.

Theorem eqL3_characterised : eqL3_characterised_statement.
Proof.
  intros N A alpha gamma h HN H1 D.
  split; [|apply bound_from_phi; [apply H1|exact D]].
  intros HB k. apply phi_from_control; [exact H1|exact D|lra|]. intros x0 x u HL.
  rewrite Rmult_1_l. apply (HB x0 x u HL k).
Qed.

Theorem eqL3_needs_eqT2 : eqL3_needs_eqT2_statement.
Proof.
  intros N A alpha gamma h l HN H1 D Hl HB beta. assert (Ha := proj1 D).
  assert (Bd := proj1 (eqL3_characterised N A alpha gamma h HN H1 D) HB 1%nat).
  destruct Hl as [Hlow [v [Hv [Pv Ev]]]]. specialize (Bd v Hv).
  assert (E : dot N v (Phi alpha N (perron N A (mu_of alpha gamma h)) 1 v)
              = (beta + (1 - ck alpha 1)) * dot N v v).
  { rewrite (dot_ext N v _ v
      (fun i => mv N (perron N A (mu_of alpha gamma h)) v i + (1 - ck alpha 1) * v i)).
    - rewrite dot_plus_r, dot_scal_r, (fiedler_perron N A _ l v Ev). unfold beta. ring.
    - reflexivity.
    - intros i _. unfold Phi. simpl. rewrite rk_0, rk_S. simpl.
      rewrite rk_0, fk_ck, ck_0. ring. }
  assert (C := dot_le_norm N v (Phi alpha N (perron N A (mu_of alpha gamma h)) 1 v)).
  rewrite E, <- norm_sq in C. assert (Np : 0 < norm N v) by (apply sqrt_lt_R0, Pv).
  assert (C1 := ck_1 alpha).
  assert (L : beta <= Rpower 2 alpha - 1).
  { rewrite <- C1. assert (T := Rle_trans _ _ _ (Rle_abs _) C).
    apply Rplus_le_reg_r with (1 - ck alpha 1). replace (ck alpha 1 + (1 - ck alpha 1)) with 1 by ring.
    apply Rmult_le_reg_r with (norm N v * norm N v); [nra|].
    eapply Rle_trans; [exact T|]. nra. }
  split; [exact L|]. intros G. apply (eqT2_closed_form alpha beta Ha). lra.
Qed.
