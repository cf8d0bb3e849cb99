(** Euler's Gamma integral: convergence, positivity, functional equation; the
    integral of the fractional kernel. *)
From Coq Require Import Reals Arith Lia Lra.
From Coquelicot Require Import Coquelicot.
From Fomas Require Import Model.Kernel Model.Gamma Facts.Kernel.
Open Scope R_scope.

(** The improper fundamental theorem of calculus. *)
Lemma is_RInt_gen_antiderivative (F f : R -> R) Fa Fb {FFa : Filter Fa} {FFb : Filter Fb} la lb :
  filter_prod Fa Fb (fun ab => forall x, Rmin (fst ab) (snd ab) <= x <= Rmax (fst ab) (snd ab) ->
    is_derive F x (f x) /\ continuous f x) ->
  filterlim F Fa (locally la) -> filterlim F Fb (locally lb) ->
  is_RInt_gen f Fa Fb (lb - la).
Proof.
  intros D La Lb. unfold is_RInt_gen.
  apply filterlimi_lim_ext_loc with (fun ab => F (snd ab) - F (fst ab)).
  - revert D. apply filter_imp. intros ab H.
    apply (is_RInt_derive F f (fst ab) (snd ab)); intros x Hx; apply H, Hx.
  - apply (filterlim_comp_2 (G := locally lb) (H := locally (- la))
             (fun ab => F (snd ab)) (fun ab => - F (fst ab)) Rplus).
    + eapply filterlim_comp; [apply filterlim_snd|exact Lb].
    + eapply filterlim_comp; [eapply filterlim_comp; [apply filterlim_fst|exact La]|].
      apply (filterlim_opp la).
    + apply (filterlim_plus lb (- la)).
Qed.

Lemma is_derive_Rpower z t : 0 < t -> is_derive (fun t => Rpower t z) t (z * Rpower t (z - 1)).
Proof. intros H. apply is_derive_Reals, derivable_pt_lim_power, H. Qed.

Lemma Rpower_pred z t : 0 < t -> Rpower t (z - 1) = Rpower t z / t.
Proof.
  intros H. unfold Rminus. rewrite Rpower_plus, Rpower_Ropp, Rpower_1 by exact H. reflexivity.
Qed.

Lemma Gamma_integrand_continuous z t : 0 < t -> continuous (Gamma_integrand z) t.
Proof.
  intros H. apply (ex_derive_continuous (Gamma_integrand z)).
  unfold Gamma_integrand, Rpower. auto_derive. exact H.
Qed.

Lemma Gamma_integrand_pos z t : 0 < Gamma_integrand z t.
Proof. apply Rmult_lt_0_compat; apply exp_pos. Qed.

Lemma Gamma_integrand_ex z a b : 0 < a <= b -> ex_RInt (Gamma_integrand z) a b.
Proof.
  intros H. apply (ex_RInt_continuous (V := R_CompleteNormedModule)). intros t Ht.
  rewrite Rmin_left in Ht by lra. apply Gamma_integrand_continuous. lra.
Qed.

(** Larger intervals have larger integrals. *)
Lemma Gamma_integrand_mono z a b a' b' : 0 < a' <= a -> a <= b <= b' ->
  RInt (Gamma_integrand z) a b <= RInt (Gamma_integrand z) a' b'.
Proof.
  intros Ha Hb.
  rewrite <- (RInt_Chasles (Gamma_integrand z) a' a b') by (apply Gamma_integrand_ex; lra).
  rewrite <- (RInt_Chasles (Gamma_integrand z) a b b') by (apply Gamma_integrand_ex; lra).
  assert (P : forall u v, 0 < u <= v -> 0 <= RInt (Gamma_integrand z) u v).
  { intros u v H. apply RInt_ge_0; [lra|apply Gamma_integrand_ex; lra|].
    intros. left. apply Gamma_integrand_pos. }
  assert (P1 := P a' a ltac:(lra)). assert (P2 := P b b' ltac:(lra)).
  unfold plus; simpl. lra.
Qed.

(** For 0 < z <= 1 the integrals are at most 1/z + 1. *)
Lemma Gamma_integrand_bounded z a b : 0 < z <= 1 -> 0 < a < 1 -> 1 < b ->
  RInt (Gamma_integrand z) a b <= / z + 1.
Proof.
  intros Hz Ha Hb.
  rewrite <- (RInt_Chasles (Gamma_integrand z) a 1 b) by (apply Gamma_integrand_ex; lra).
  assert (I1 : is_RInt (fun t => Rpower t (z - 1)) a 1 (Rpower 1 z / z - Rpower a z / z)).
  { apply (is_RInt_derive (fun t => Rpower t z / z)).
    - intros t Ht. rewrite Rmin_left in Ht by lra.
      rewrite Rpower_pred by lra. unfold Rpower. auto_derive; [lra|field; lra].
    - intros t Ht. rewrite Rmin_left in Ht by lra.
      apply (ex_derive_continuous (fun t => Rpower t (z - 1))).
      unfold Rpower. auto_derive. lra. }
  assert (I2 : is_RInt (fun t => exp (- t)) 1 b (- exp (- b) - - exp (- 1))).
  { apply (is_RInt_derive (fun t => - exp (- t))).
    - intros t _. auto_derive; [exact I|ring].
    - intros t _. apply (ex_derive_continuous (fun t => exp (- t))). auto_derive. exact I. }
  assert (B1 : RInt (Gamma_integrand z) a 1 <= Rpower 1 z / z - Rpower a z / z).
  { rewrite <- (is_RInt_unique _ _ _ _ I1).
    apply RInt_le; [lra|apply Gamma_integrand_ex; lra|eexists; exact I1|].
    intros t Ht. unfold Gamma_integrand.
    assert (exp (- t) < 1) by (rewrite <- exp_0; apply exp_increasing; lra).
    assert (0 < Rpower t (z - 1)) by apply exp_pos. nra. }
  assert (B2 : RInt (Gamma_integrand z) 1 b <= - exp (- b) - - exp (- 1)).
  { rewrite <- (is_RInt_unique _ _ _ _ I2).
    apply RInt_le; [lra|apply Gamma_integrand_ex; lra|eexists; exact I2|].
    intros t Ht. unfold Gamma_integrand.
    assert (Q : Rpower t (z - 1) <= 1).
    { assert (E0 : Rpower 1 (z - 1) = 1) by (rewrite <- rpow_pos by lra; apply rpow_1).
      apply Rle_trans with (Rpower 1 (z - 1)); [apply Rpower_le_base_neg; lra|lra]. }
    assert (0 < exp (- t)) by apply exp_pos. nra. }
  assert (E1 : exp (- 1) < 1) by (rewrite <- exp_0; apply exp_increasing; lra).
  assert (E2 := exp_pos (- b)).
  assert (E3 : 0 < Rpower a z / z) by (apply Rdiv_lt_0_compat; [apply exp_pos|lra]).
  assert (E4 : Rpower 1 z = 1) by (rewrite <- rpow_pos by lra; apply rpow_1).
  rewrite E4 in B1. unfold plus; simpl. unfold Rdiv in *. lra.
Qed.

(** A limit of the integrals over (a, b) is their least upper bound. *)
Lemma Gamma_converges_small z : 0 < z <= 1 -> exists G,
  is_RInt_gen (Gamma_integrand z) (at_right 0) (Rbar_locally p_infty) G.
Proof.
  intros Hz.
  destruct (completeness (fun y => exists a b, 0 < a < 1 /\ 1 < b /\
              y = RInt (Gamma_integrand z) a b)) as [G [UB LUB]].
  - exists (/ z + 1). intros y [a [b [Ha [Hb ->]]]]. apply Gamma_integrand_bounded; lra.
  - exists (RInt (Gamma_integrand z) (/ 2) 2), (/ 2), 2. repeat split; lra.
  - exists G. apply filterlimi_locally. intros eps.
    assert (He := cond_pos eps).
    assert (C : ~ forall a b, 0 < a < 1 -> 1 < b -> RInt (Gamma_integrand z) a b <= G - eps).
    { intros C. assert (G <= G - eps); [|lra]. apply LUB.
      intros y [a [b [Ha [Hb ->]]]]. apply C; assumption. }
    assert (C' : exists a b, 0 < a < 1 /\ 1 < b /\ G - eps < RInt (Gamma_integrand z) a b).
    { apply Classical_Prop.NNPP. intros K. apply C. intros a b Ha Hb. apply Rnot_lt_le.
      intros Q. apply K. exists a, b. auto. }
    destruct C' as [a [b [Ha [Hb Q]]]].
    apply (Filter_prod _ _ _ (fun u => 0 < u < a) (fun v => b < v)).
    + exists (mkposreal a (proj1 Ha)). intros y Hy Hy0. split; [exact Hy0|].
      unfold ball in Hy; simpl in Hy. unfold AbsRing_ball, abs, minus, plus, opp in Hy.
      simpl in Hy. apply Rabs_def2 in Hy. lra.
    + exists b. auto.
    + intros u v Hu Hv. simpl. exists (RInt (Gamma_integrand z) u v). split.
      * apply (RInt_correct (V := R_CompleteNormedModule)). apply Gamma_integrand_ex. lra.
      * assert (M := Gamma_integrand_mono z a b u v ltac:(lra) ltac:(lra)).
        assert (U := UB _ (ex_intro _ u (ex_intro _ v
                       (conj (ltac:(lra) : 0 < u < 1) (conj (ltac:(lra) : 1 < v) eq_refl))))).
        unfold ball; simpl. unfold AbsRing_ball, abs, minus, plus, opp. simpl.
        apply Rabs_def1; lra.
Qed.

Lemma at_right_pos (x : R) : at_right x (fun y => x < y).
Proof. unfold at_right, within. apply filter_forall. auto. Qed.

(** t^z e^(-t) vanishes at 0 and at infinity. *)
Lemma Gamma_boundary_0 z : 0 < z ->
  filterlim (fun t => Rpower t z * exp (- t)) (at_right 0) (locally 0).
Proof.
  intros Hz. apply filterlim_ext_loc with (fun t => rpow t z * exp (- t)).
  - generalize (at_right_pos 0). apply filter_imp. intros t Ht. rewrite rpow_pos; auto.
  - apply (filterlim_filter_le_1 (F := locally 0) (G := at_right 0)); [apply filter_le_within|].
    replace 0 with (rpow 0 z * exp (- 0)) at 2 by (rewrite rpow_nonpos by lra; ring).
    assert (C : continuity_pt (fun t => rpow t z * exp (- t)) 0).
    { apply (continuity_pt_mult (fun t => rpow t z) (fun t => exp (- t))).
      - apply rpow_continuous; lra.
      - apply derivable_continuous_pt. exists (- exp (- 0)). apply is_derive_Reals.
        auto_derive; [exact I|ring]. }
    apply continuity_pt_filterlim in C. exact C.
Qed.

Lemma Gamma_boundary_oo z : 0 < z ->
  filterlim (fun t => Rpower t z * exp (- t)) (Rbar_locally p_infty) (locally 0).
Proof.
  intros Hz. apply (is_lim_le_le_loc (fun _ => 0)
    (fun t => exp (z * ln (2 * z)) * exp (- (t / 2))) _ p_infty 0).
  - exists 0. intros t Ht. split; [left; apply Rmult_lt_0_compat; apply exp_pos|].
    unfold Rpower. rewrite <- !exp_plus.
    assert (L : ln t <= ln (2 * z) + (t / (2 * z) - 1)).
    { replace t with (2 * z * (t / (2 * z))) at 1 by (field; lra).
      assert (0 < t / (2 * z)) by (apply Rdiv_lt_0_compat; lra).
      rewrite ln_mult by lra. apply Rplus_le_compat_l.
      assert (X := exp_ineq1_le (ln (t / (2 * z)))). rewrite exp_ln in X by assumption. lra. }
    apply Rmult_le_compat_l with (r := z) in L; [|lra].
    replace (z * (ln (2 * z) + (t / (2 * z) - 1)))
      with (z * ln (2 * z) + t / 2 - z) in L by (field; lra).
    destruct (Req_dec (z * ln t + - t) (z * ln (2 * z) + - (t / 2))) as [->|NE]; [lra|].
    left. apply exp_increasing. lra.
  - apply is_lim_const.
  - replace (Finite 0) with (Rbar_mult (exp (z * ln (2 * z))) 0) by (simpl; f_equal; ring).
    apply is_lim_scal_l. apply (is_lim_comp exp (fun t => - (t / 2)) p_infty 0 m_infty).
    + apply is_lim_exp_m.
    + evar_last; [apply is_lim_opp, (is_lim_scal_r _ (/ 2)), is_lim_id|].
      simpl. destruct (Rle_dec 0 (/ 2)) as [H|H]; [|lra].
      destruct (Rle_lt_or_eq_dec 0 (/ 2) H); [reflexivity|lra].
    + exists 0. intros y _. discriminate.
Qed.

(** Integration by parts. *)
Lemma Gamma_parts z G : 0 < z ->
  is_RInt_gen (Gamma_integrand z) (at_right 0) (Rbar_locally p_infty) G ->
  is_RInt_gen (Gamma_integrand (z + 1)) (at_right 0) (Rbar_locally p_infty) (z * G).
Proof.
  intros Hz HG.
  assert (HD : is_RInt_gen (fun t => z * Gamma_integrand z t - Gamma_integrand (z + 1) t)
                 (at_right 0) (Rbar_locally p_infty) (0 - 0)).
  { apply (is_RInt_gen_antiderivative (fun t => Rpower t z * exp (- t)) _ _ _).
    - apply (Filter_prod _ _ _ (fun u => 0 < u) (fun v => 0 < v)).
      + apply at_right_pos.
      + exists 0. auto.
      + intros u v Hu Hv x [Hx _]. simpl in Hx.
        assert (0 < x) by (eapply Rlt_le_trans; [apply Rmin_glb_lt; [exact Hu|exact Hv]|exact Hx]).
        split.
        * unfold Gamma_integrand. replace (z + 1 - 1) with z by ring.
          unfold Rpower at 1. auto_derive; [assumption|].
          rewrite Rpower_pred by assumption. unfold Rpower. field. lra.
        * apply (continuous_minus (V := R_NormedModule)
                   (fun t => z * Gamma_integrand z t) (Gamma_integrand (z + 1))).
          -- apply (continuous_scal_r (V := R_NormedModule) z), Gamma_integrand_continuous.
             assumption.
          -- apply Gamma_integrand_continuous. assumption.
    - apply Gamma_boundary_0, Hz.
    - apply Gamma_boundary_oo, Hz. }
  assert (S := is_RInt_gen_scal (V := R_NormedModule) _ z _ HG).
  assert (M := is_RInt_gen_minus (V := R_NormedModule) _ _ _ _ S HD).
  replace (z * G) with (minus (scal z G) (0 - 0))
    by (unfold minus, plus, opp, scal; simpl; unfold mult; simpl; ring).
  revert M. apply is_RInt_gen_ext. apply filter_forall. intros ab x _.
  unfold minus, plus, opp, scal; simpl; unfold mult; simpl. ring.
Qed.

Lemma Gamma_converges z : 0 < z -> exists G,
  is_RInt_gen (Gamma_integrand z) (at_right 0) (Rbar_locally p_infty) G.
Proof.
  intros Hz. destruct (nfloor_ex z) as [n [_ Hn]]; [lra|].
  revert z Hz Hn. induction n as [|n IH]; intros z Hz Hn.
  - simpl in Hn. apply Gamma_converges_small. lra.
  - destruct (Rle_dec z 1) as [L|L]; [apply Gamma_converges_small; lra|].
    rewrite S_INR in Hn. destruct (IH (z - 1)) as [G HG]; [lra|lra|].
    exists ((z - 1) * G). replace z with (z - 1 + 1) at 1 by ring.
    apply Gamma_parts; [lra|exact HG].
Qed.

Lemma Gamma_correct z : 0 < z ->
  is_RInt_gen (Gamma_integrand z) (at_right 0) (Rbar_locally p_infty) (Gamma z).
Proof.
  intros Hz. destruct (Gamma_converges z Hz) as [G HG].
  unfold Gamma. rewrite (is_RInt_gen_unique _ _ HG). exact HG.
Qed.

(** Every proper integral is a lower bound, and a common upper bound of them an upper bound. *)
Lemma Gamma_lower z a b : 0 < z -> 0 < a <= b -> RInt (Gamma_integrand z) a b <= Gamma z.
Proof.
  intros Hz Hab. apply Rnot_lt_le. intros C.
  assert (H := proj1 (filterlimi_locally
    (F := filter_prod (at_right 0) (Rbar_locally p_infty))
    (fun ab => is_RInt (Gamma_integrand z) (fst ab) (snd ab)) (Gamma z)) (Gamma_correct z Hz)).
  destruct (H (mkposreal _ (Rlt_Rminus _ _ C))) as [Q S [d Hd] [M HM] HQS].
  assert (Hd0 := cond_pos d).
  set (u := Rmin a (d / 2)). set (v := Rmax b (M + 1)).
  assert (Hu : 0 < u <= a) by (unfold u; split; [apply Rmin_glb_lt; lra|apply Rmin_l]).
  assert (Hv : b <= v) by apply Rmax_l.
  destruct (HQS u v) as [y [Iy By]].
  - apply Hd; [|apply Hu]. unfold ball; simpl. unfold AbsRing_ball, abs, minus, plus, opp; simpl.
    rewrite Ropp_0, Rplus_0_r, Rabs_right by lra.
    assert (u <= d / 2) by apply Rmin_r. lra.
  - apply HM. assert (M + 1 <= v) by apply Rmax_r. lra.
  - simpl in Iy. rewrite <- (is_RInt_unique _ _ _ _ Iy) in By.
    assert (Mo := Gamma_integrand_mono z a b u v Hu ltac:(lra)).
    unfold ball in By; simpl in By. unfold AbsRing_ball, abs, minus, plus, opp in By; simpl in By.
    apply Rabs_def2 in By. lra.
Qed.

Lemma Gamma_upper z B : 0 < z ->
  (forall a b, 0 < a < 1 -> 1 < b -> RInt (Gamma_integrand z) a b <= B) -> Gamma z <= B.
Proof.
  intros Hz HB. apply Rnot_lt_le. intros C.
  assert (H := proj1 (filterlimi_locally
    (F := filter_prod (at_right 0) (Rbar_locally p_infty))
    (fun ab => is_RInt (Gamma_integrand z) (fst ab) (snd ab)) (Gamma z)) (Gamma_correct z Hz)).
  destruct (H (mkposreal _ (Rlt_Rminus _ _ C))) as [Q S [d Hd] [M HM] HQS].
  assert (Hd0 := cond_pos d).
  set (u := Rmin (/ 2) (d / 2)). set (v := Rmax 2 (M + 1)).
  assert (Hu : 0 < u <= / 2) by (unfold u; split; [apply Rmin_glb_lt; lra|apply Rmin_l]).
  assert (Hv : 2 <= v) by apply Rmax_l.
  destruct (HQS u v) as [y [Iy By]].
  - apply Hd; [|apply Hu]. unfold ball; simpl. unfold AbsRing_ball, abs, minus, plus, opp; simpl.
    rewrite Ropp_0, Rplus_0_r, Rabs_right by lra.
    assert (u <= d / 2) by apply Rmin_r. lra.
  - apply HM. assert (M + 1 <= v) by apply Rmax_r. lra.
  - simpl in Iy. rewrite <- (is_RInt_unique _ _ _ _ Iy) in By.
    assert (U := HB u v ltac:(lra) ltac:(lra)).
    unfold ball in By; simpl in By. unfold AbsRing_ball, abs, minus, plus, opp in By; simpl in By.
    apply Rabs_def2 in By. lra.
Qed.

Lemma Gamma_pos z : 0 < z -> 0 < Gamma z.
Proof.
  intros Hz. eapply Rlt_le_trans; [|apply (Gamma_lower z 1 2); lra].
  apply RInt_gt_0; [lra| |]; intros t Ht.
  - apply Gamma_integrand_pos.
  - apply Gamma_integrand_continuous. lra.
Qed.

Lemma Gamma_succ z : 0 < z -> Gamma (z + 1) = z * Gamma z.
Proof.
  intros Hz. unfold Gamma at 1. apply is_RInt_gen_unique.
  apply Gamma_parts; [exact Hz|apply Gamma_correct, Hz].
Qed.

(** * The integral of (t - tau)^(alpha - 1) *)

Lemma kernel_integral_correct alpha t a b : 0 < alpha < 1 -> a < b <= t ->
  is_RInt_gen (fun tau => Rpower (t - tau) (alpha - 1)) (at_point a) (at_left b)
    ((rpow (t - a) alpha - rpow (t - b) alpha) / alpha).
Proof.
  intros Ha Hab. set (F := fun tau => (- / alpha) * rpow (t - tau) alpha).
  replace ((rpow (t - a) alpha - rpow (t - b) alpha) / alpha) with (F b - F a)
    by (unfold F; field; lra).
  apply (is_RInt_gen_antiderivative F _ _ _).
  - apply (Filter_prod _ _ _ (fun u => u = a) (fun v => a < v < b)).
    + reflexivity.
    + exists (mkposreal (b - a) ltac:(lra)). intros y Hy Hyb.
      unfold ball in Hy; simpl in Hy. unfold AbsRing_ball, abs, minus, plus, opp in Hy; simpl in Hy.
      apply Rabs_def2 in Hy. simpl in Hy. lra.
    + intros u v -> Hv x Hx. simpl in Hx. rewrite Rmin_left, Rmax_right in Hx by lra. split.
      * unfold F.
        assert (D := rpow_derive (t - x) alpha ltac:(lra)).
        evar_last.
        -- apply (is_derive_scal (fun tau => rpow (t - tau) alpha)).
           apply (is_derive_comp (fun y => rpow y alpha) (fun tau => t - tau) x _ (-1) D).
           auto_derive; [exact I|ring].
        -- unfold opp, scal; simpl; unfold mult; simpl. field. lra.
      * apply (ex_derive_continuous (fun tau => Rpower (t - tau) (alpha - 1))).
        unfold Rpower. auto_derive. lra.
  - intros P HP. unfold filtermap, at_point. apply locally_singleton in HP. exact HP.
  - apply (filterlim_filter_le_1 (F := locally b) (G := at_left b)); [apply filter_le_within|].
    assert (C : continuity_pt F b).
    { apply (continuity_pt_mult (fun _ => - / alpha) (fun tau => rpow (t - tau) alpha)).
      - apply continuity_pt_const. intros x y. reflexivity.
      - apply (continuity_pt_comp (fun tau => t - tau) (fun y => rpow y alpha)).
        + apply derivable_continuous_pt. exists (-1). apply is_derive_Reals.
          auto_derive; [exact I|ring].
        + apply rpow_continuous; lra. }
    apply continuity_pt_filterlim in C. exact C.
Qed.

Lemma kernel_integral_value alpha t a b : 0 < alpha < 1 -> a < b <= t ->
  kernel_integral alpha t a b = (rpow (t - a) alpha - rpow (t - b) alpha) / alpha.
Proof.
  intros Ha Hab. apply is_RInt_gen_unique. apply kernel_integral_correct; assumption.
Qed.
