(** Enclosure of Gamma on (0, 2] by the series of the incomplete Gamma function. *)
From Coq Require Import Reals Arith Lia Lra.
From Coquelicot Require Import Coquelicot.
From Fomas Require Import Model.Kernel Model.Gamma Facts.Kernel Facts.Gamma.
Open Scope R_scope.

Lemma is_RInt_Rpower z a b : 0 < z -> 0 < a <= b ->
  is_RInt (fun t => Rpower t (z - 1)) a b (Rpower b z / z - Rpower a z / z).
Proof.
  intros Hz Hab. apply (is_RInt_derive (fun t => Rpower t z / z)); intros t Ht;
    rewrite Rmin_left in Ht by lra.
  - rewrite Rpower_pred by lra. unfold Rpower. auto_derive; [lra|field; lra].
  - apply (ex_derive_continuous (fun t => Rpower t (z - 1))). unfold Rpower. auto_derive. lra.
Qed.

(** Integration by parts over (a, b). *)
Lemma Gamma_integrand_parts z a b : 0 < z -> 0 < a <= b ->
  RInt (Gamma_integrand (z + 1)) a b
  = z * RInt (Gamma_integrand z) a b - (Rpower b z * exp (- b) - Rpower a z * exp (- a)).
Proof.
  intros Hz Hab.
  assert (H : is_RInt (fun t => z * Gamma_integrand z t - Gamma_integrand (z + 1) t) a b
                (Rpower b z * exp (- b) - Rpower a z * exp (- a))).
  { apply (is_RInt_derive (fun t => Rpower t z * exp (- t))); intros t Ht;
      rewrite Rmin_left in Ht by lra.
    - unfold Gamma_integrand. replace (z + 1 - 1) with z by ring.
      rewrite Rpower_pred by lra. unfold Rpower. auto_derive; [lra|field; lra].
    - apply (continuous_minus (V := R_NormedModule)
               (fun t => z * Gamma_integrand z t) (Gamma_integrand (z + 1))).
      + apply (continuous_scal_r (V := R_NormedModule) z), Gamma_integrand_continuous. lra.
      + apply Gamma_integrand_continuous. lra. }
  assert (I : is_RInt (fun t => z * Gamma_integrand z t - Gamma_integrand (z + 1) t) a b
                (z * RInt (Gamma_integrand z) a b - RInt (Gamma_integrand (z + 1)) a b)).
  { apply (is_RInt_minus (V := R_NormedModule) (fun t => z * Gamma_integrand z t)
             (Gamma_integrand (z + 1))).
    - apply (is_RInt_scal (V := R_NormedModule) (Gamma_integrand z) a b z).
      apply (RInt_correct (V := R_CompleteNormedModule)), Gamma_integrand_ex. exact Hab.
    - apply (RInt_correct (V := R_CompleteNormedModule)), Gamma_integrand_ex. exact Hab. }
  assert (E := is_RInt_unique _ _ _ _ H). rewrite (is_RInt_unique _ _ _ _ I) in E. lra.
Qed.

Lemma Rpower_S t z : 0 < t -> Rpower t (z + 1) = t * Rpower t z.
Proof. intros H. rewrite Rpower_plus, Rpower_1 by exact H. ring. Qed.

Lemma gamma_series_nonneg T n : forall z, 0 < z -> 0 <= T -> 0 <= gamma_series n z T.
Proof.
  induction n as [|n IH]; intros z Hz HT; simpl; [lra|].
  assert (P := IH (z + 1) ltac:(lra) HT).
  apply Rmult_le_pos; [nra|left; apply Rinv_0_lt_compat, Hz].
Qed.

Lemma incomplete_lower a T n : 0 < a <= T -> forall z, 0 < z ->
  (Rpower T z * exp (- T) - Rpower a z) * gamma_series n z T <= RInt (Gamma_integrand z) a T.
Proof.
  intros Ha. induction n as [|n IH]; intros z Hz; simpl.
  - rewrite Rmult_0_r. apply RInt_ge_0; [lra|apply Gamma_integrand_ex, Ha|].
    intros. left. apply Gamma_integrand_pos.
  - specialize (IH (z + 1) ltac:(lra)).
    rewrite (Gamma_integrand_parts z a T Hz Ha), !Rpower_S in IH by lra.
    assert (S0 := gamma_series_nonneg T n (z + 1) ltac:(lra) ltac:(lra)).
    set (S := gamma_series n (z + 1) T) in *. set (X := RInt (Gamma_integrand z) a T) in *.
    assert (A0 : 0 < Rpower a z) by apply exp_pos.
    assert (A1 : exp (- a) <= 1).
    { left. rewrite <- exp_0. apply exp_increasing. lra. }
    apply Rmult_le_reg_l with z; [exact Hz|].
    replace (z * ((Rpower T z * exp (- T) - Rpower a z) * ((1 + T * S) / z)))
      with ((Rpower T z * exp (- T) - Rpower a z) * (1 + T * S)) by (field; lra).
    assert (B1 : Rpower a z * exp (- a) <= Rpower a z) by nra.
    assert (B2 : a * Rpower a z * S <= T * Rpower a z * S).
    { apply Rmult_le_compat_r; [exact S0|]. apply Rmult_le_compat_r; lra. }
    lra.
Qed.

Lemma incomplete_upper a T n : 0 < a <= T -> forall z, 0 < z ->
  RInt (Gamma_integrand z) a T
  <= Rpower T z * (exp (- T) * gamma_series n z T + gamma_remainder n z T).
Proof.
  intros Ha. induction n as [|n IH]; intros z Hz; simpl.
  - rewrite Rmult_0_r, Rplus_0_l.
    assert (I := is_RInt_Rpower z a T Hz Ha).
    apply Rle_trans with (RInt (fun t => Rpower t (z - 1)) a T).
    + apply RInt_le; [lra|apply Gamma_integrand_ex, Ha|eexists; exact I|].
      intros t Ht. unfold Gamma_integrand.
      assert (E : exp (- t) < 1) by (rewrite <- exp_0; apply exp_increasing; lra).
      assert (P : 0 < Rpower t (z - 1)) by apply exp_pos. nra.
    + rewrite (is_RInt_unique _ _ _ _ I).
      assert (P : 0 < Rpower a z / z) by (apply Rdiv_lt_0_compat; [apply exp_pos|exact Hz]).
      unfold Rdiv in *. lra.
  - specialize (IH (z + 1) ltac:(lra)).
    rewrite (Gamma_integrand_parts z a T Hz Ha), Rpower_S in IH by lra.
    set (S := gamma_series n (z + 1) T) in *. set (W := gamma_remainder n (z + 1) T) in *.
    set (X := RInt (Gamma_integrand z) a T) in *.
    assert (A0 : 0 < Rpower a z * exp (- a)) by (apply Rmult_lt_0_compat; apply exp_pos).
    apply Rmult_le_reg_l with z; [exact Hz|].
    replace (z * (Rpower T z * (exp (- T) * ((1 + T * S) / z) + T * W / z)))
      with (Rpower T z * (exp (- T) * (1 + T * S) + T * W)) by (field; lra).
    lra.
Qed.

(** The tail, for z <= 2: the integral of t e^(-t). *)
Lemma Gamma_tail z T b : 0 < z <= 2 -> 1 <= T <= b ->
  RInt (Gamma_integrand z) T b <= (T + 1) * exp (- T).
Proof.
  intros Hz HT.
  assert (I : is_RInt (fun t => t * exp (- t)) T b
                (- (b + 1) * exp (- b) - - (T + 1) * exp (- T))).
  { apply (is_RInt_derive (fun t => - (t + 1) * exp (- t))).
    - intros t _. auto_derive; [exact I|ring].
    - intros t _. apply (ex_derive_continuous (fun t => t * exp (- t))). auto_derive. exact I. }
  apply Rle_trans with (RInt (fun t => t * exp (- t)) T b).
  - apply RInt_le; [lra|apply Gamma_integrand_ex; lra|eexists; exact I|].
    intros t Ht. unfold Gamma_integrand. apply Rmult_le_compat_r; [left; apply exp_pos|].
    rewrite <- (Rpower_1 t) at 2 by lra. apply Rle_Rpower; lra.
  - rewrite (is_RInt_unique _ _ _ _ I).
    assert (P : 0 < exp (- b)) by apply exp_pos. nra.
Qed.

Lemma Gamma_series_lower z T n : 0 < z -> 0 < T ->
  Rpower T z * exp (- T) * gamma_series n z T <= Gamma z.
Proof.
  intros Hz HT. assert (S0 := gamma_series_nonneg T n z Hz ltac:(lra)).
  set (S := gamma_series n z T) in *. apply Rnot_lt_le. intros C.
  (* choose a with a^z S below the gap *)
  set (gap := (Rpower T z * exp (- T) * S - Gamma z) / (S + 1)).
  assert (G0 : 0 < gap) by (apply Rdiv_lt_0_compat; lra).
  set (a := Rmin T (Rpower gap (/ z))).
  assert (A : 0 < a <= T).
  { unfold a. split; [apply Rmin_glb_lt; [exact HT|apply exp_pos]|apply Rmin_l]. }
  assert (Az : Rpower a z <= gap).
  { rewrite <- (Rpower_1 gap) by exact G0. rewrite <- (Rinv_l z) by lra.
    rewrite <- Rpower_mult. apply Rle_Rpower_l; [lra|]. split; [apply A|apply Rmin_r]. }
  assert (L := incomplete_lower a T n A z Hz). fold S in L.
  assert (U := Gamma_lower z a T Hz A).
  assert (E : gap * (S + 1) = Rpower T z * exp (- T) * S - Gamma z) by (unfold gap; field; lra).
  assert (Rpower a z * S <= gap * S) by (apply Rmult_le_compat_r; assumption). lra.
Qed.

Lemma Gamma_series_upper z T n : 0 < z <= 2 -> 1 < T ->
  Gamma z <= Rpower T z * (exp (- T) * gamma_series n z T + gamma_remainder n z T)
             + (T + 1) * exp (- T).
Proof.
  intros Hz HT. apply Gamma_upper; [lra|]. intros a b Ha Hb.
  set (b' := Rmax b T). assert (B1 : b <= b') by apply Rmax_l.
  assert (B2 : T <= b') by apply Rmax_r.
  eapply Rle_trans; [apply (Gamma_integrand_mono z a b a b'); lra|].
  rewrite <- (RInt_Chasles (Gamma_integrand z) a T b') by (apply Gamma_integrand_ex; lra).
  assert (L := incomplete_upper a T n ltac:(lra) z ltac:(lra)).
  assert (U := Gamma_tail z T b' Hz ltac:(lra)). unfold plus; simpl. lra.
Qed.
