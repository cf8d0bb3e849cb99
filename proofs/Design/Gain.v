(** Enclosing Gamma(alpha+1) and mu = gamma h^alpha / Gamma(alpha+1) for rational alpha, gamma, h. *)
From Coq Require Import Reals ZArith Lia Lra.
From Coquelicot Require Import Coquelicot.
From Interval Require Import Tactic.
From Fomas Require Import Model.Kernel Model.Gamma Model.Loop Statements Facts.Kernel Facts.Gamma.
From Fomas Require Import Results.Plant.
Open Scope R_scope.

(** * The series at z = p/q in fixed point: S times its value, rounded down and up. *)

Definition up_div (a b : Z) : Z := (- ((- a) / b))%Z.
Fixpoint series_lower (n : nat) (p q T S : Z) : Z :=
  match n with O => 0 | S m => (S + T * series_lower m (p + q) q T S) * q / p end%Z.
Fixpoint series_upper (n : nat) (p q T S : Z) : Z :=
  match n with O => 0 | S m => up_div ((S + T * series_upper m (p + q) q T S) * q) p end%Z.
Fixpoint remainder_upper (n : nat) (p q T S : Z) : Z :=
  match n with
  | O => up_div (S * q) p
  | S m => up_div (T * remainder_upper m (p + q) q T S * q) p
  end%Z.

Lemma div_below a b : (0 < b)%Z -> IZR (a / b) <= IZR a / IZR b.
Proof.
  intros Hb. assert (P := IZR_lt _ _ Hb). apply Rmult_le_reg_r with (IZR b); [exact P|].
  unfold Rdiv. rewrite Rmult_assoc, Rinv_l, Rmult_1_r, <- mult_IZR by lra. apply IZR_le.
  rewrite Z.mul_comm. apply Z.mul_div_le, Hb.
Qed.

Lemma div_above a b : (0 < b)%Z -> IZR a / IZR b <= IZR (up_div a b).
Proof.
  intros Hb. assert (D := div_below (- a) b Hb). unfold up_div. rewrite opp_IZR in *. lra.
Qed.

Section Series.
Variables (q T S : Z).
Hypotheses (Hq : (0 < q)%Z) (HT : (0 < T)%Z).

Lemma next_ratio p : IZR p / IZR q + 1 = IZR (p + q) / IZR q.
Proof. rewrite plus_IZR. field. apply IZR_lt in Hq. lra. Qed.

Lemma series_lower_sound n p : (0 < p)%Z ->
  IZR (series_lower n p q T S) <= IZR S * gamma_series n (IZR p / IZR q) (IZR T).
Proof.
  revert p. induction n as [|n IH]; intros p Hp;
    cbn [series_lower series_upper gamma_series]; [lra|].
  eapply Rle_trans; [apply div_below, Hp|]. rewrite next_ratio.
  specialize (IH (p + q)%Z ltac:(lia)). apply IZR_lt in Hp, Hq, HT.
  rewrite mult_IZR, (plus_IZR S), mult_IZR.
  replace (IZR S * ((1 + IZR T * gamma_series n (IZR (p + q) / IZR q) (IZR T)) / (IZR p / IZR q)))
    with ((IZR S + IZR T * (IZR S * gamma_series n (IZR (p + q) / IZR q) (IZR T))) * IZR q / IZR p)
    by (field; lra).
  apply Rmult_le_compat_r; [apply Rlt_le, Rinv_0_lt_compat; exact Hp|].
  apply Rmult_le_compat_r; [lra|]. apply Rplus_le_compat_l, Rmult_le_compat_l; lra.
Qed.

Lemma series_upper_sound n p : (0 < p)%Z ->
  IZR S * gamma_series n (IZR p / IZR q) (IZR T) <= IZR (series_upper n p q T S).
Proof.
  revert p. induction n as [|n IH]; intros p Hp;
    cbn [series_lower series_upper gamma_series]; [lra|].
  eapply Rle_trans; [|apply div_above, Hp]. rewrite next_ratio.
  specialize (IH (p + q)%Z ltac:(lia)). apply IZR_lt in Hp, Hq, HT.
  rewrite mult_IZR, (plus_IZR S), mult_IZR.
  replace (IZR S * ((1 + IZR T * gamma_series n (IZR (p + q) / IZR q) (IZR T)) / (IZR p / IZR q)))
    with ((IZR S + IZR T * (IZR S * gamma_series n (IZR (p + q) / IZR q) (IZR T))) * IZR q / IZR p)
    by (field; lra).
  apply Rmult_le_compat_r; [apply Rlt_le, Rinv_0_lt_compat; exact Hp|].
  apply Rmult_le_compat_r; [lra|]. apply Rplus_le_compat_l, Rmult_le_compat_l; lra.
Qed.

Lemma remainder_upper_sound n p : (0 < p)%Z ->
  IZR S * gamma_remainder n (IZR p / IZR q) (IZR T) <= IZR (remainder_upper n p q T S).
Proof.
  revert p. induction n as [|n IH]; intros p Hp; cbn [remainder_upper gamma_remainder].
  - eapply Rle_trans; [|apply div_above, Hp]. apply IZR_lt in Hp, Hq. rewrite mult_IZR.
    right. field. lra.
  - eapply Rle_trans; [|apply div_above, Hp]. rewrite next_ratio.
    specialize (IH (p + q)%Z ltac:(lia)). apply IZR_lt in Hp, Hq, HT. rewrite !mult_IZR.
    replace (IZR S * (IZR T * gamma_remainder n (IZR (p + q) / IZR q) (IZR T) / (IZR p / IZR q)))
      with (IZR T * (IZR S * gamma_remainder n (IZR (p + q) / IZR q) (IZR T)) * IZR q / IZR p)
      by (field; lra).
    apply Rmult_le_compat_r; [apply Rlt_le, Rinv_0_lt_compat; exact Hp|].
    apply Rmult_le_compat_r; [lra|]. apply Rmult_le_compat_l; lra.
Qed.
End Series.

Lemma gamma_fixed_point n p q T S lo up rest :
  (0 < q)%Z -> (0 < p <= 2 * q)%Z -> (1 < T)%Z -> (0 < S)%Z ->
  (lo <=? series_lower n p q T S)%Z = true -> (series_upper n p q T S <=? up)%Z = true ->
  (remainder_upper n p q T S <=? rest)%Z = true ->
  Rpower (IZR T) (IZR p / IZR q) * exp (- IZR T) * (IZR lo / IZR S) <= Gamma (IZR p / IZR q)
  <= Rpower (IZR T) (IZR p / IZR q) * (exp (- IZR T) * (IZR up / IZR S) + IZR rest / IZR S)
     + (IZR T + 1) * exp (- IZR T).
Proof.
  intros Hq Hp HT HS HL HU HR. apply Z.leb_le, IZR_le in HL, HU, HR.
  assert (T0 : (0 < T)%Z) by lia.
  assert (L := series_lower_sound q T S Hq T0 n p ltac:(lia)).
  assert (U := series_upper_sound q T S Hq T0 n p ltac:(lia)).
  assert (R := remainder_upper_sound q T S Hq T0 n p ltac:(lia)).
  assert (Z : 0 < IZR p / IZR q <= 2).
  { destruct Hp as [P1 P2]. apply IZR_lt in P1, Hq. apply IZR_le in P2. rewrite mult_IZR in P2.
    split; [apply Rdiv_lt_0_compat; assumption|].
    apply Rmult_le_reg_r with (IZR q); [exact Hq|]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l by lra.
    lra. }
  apply IZR_lt in HT, HS.
  destruct (gamma_enclosure (IZR p / IZR q) (IZR T) n Z HT) as [G1 G2].
  assert (PT : 0 < Rpower (IZR T) (IZR p / IZR q)) by apply exp_pos.
  assert (PE : 0 < exp (- IZR T)) by apply exp_pos.
  assert (scale : forall a b, a <= IZR S * b -> a / IZR S <= b).
  { intros a b H. apply Rmult_le_reg_r with (IZR S); [exact HS|].
    unfold Rdiv. rewrite Rmult_assoc, Rinv_l by lra. lra. }
  assert (scale' : forall a b, IZR S * b <= a -> b <= a / IZR S).
  { intros a b H. apply Rmult_le_reg_r with (IZR S); [exact HS|].
    unfold Rdiv. rewrite Rmult_assoc, Rinv_l by lra. lra. }
  split.
  - eapply Rle_trans; [|exact G1]. apply Rmult_le_compat_l; [|apply scale; lra].
    apply Rlt_le, Rmult_lt_0_compat; assumption.
  - eapply Rle_trans; [exact G2|]. apply Rplus_le_compat_r, Rmult_le_compat_l; [lra|].
    apply Rplus_le_compat; [apply Rmult_le_compat_l; [lra|]|]; apply scale'; lra.
Qed.

(** lo <= Gamma (p/q) <= hi, to 25 digits. *)
Ltac enclose_gamma p q :=
  let S := eval vm_compute in (2 ^ 256)%Z in
  let lo := eval vm_compute in (series_lower 256 p q 64 S) in
  let up := eval vm_compute in (series_upper 256 p q 64 S) in
  let rest := eval vm_compute in (remainder_upper 256 p q 64 S) in
  let H := fresh in
  assert (H := gamma_fixed_point 256 p q 64 S lo up rest eq_refl
                 ltac:(lia) eq_refl eq_refl
                 ltac:(vm_compute; reflexivity) ltac:(vm_compute; reflexivity)
                 ltac:(vm_compute; reflexivity));
  split; [eapply Rle_trans; [|apply H]|eapply Rle_trans; [apply H|]]; clear H;
  interval with (i_prec 150).

(** lo <= mu <= hi from bounds of Gamma. *)
Lemma mu_enclosed alpha gamma h Glo Ghi lo hi : 0 < gamma -> 0 < h -> 0 < Glo -> 0 <= lo ->
  Glo <= Gamma (alpha + 1) <= Ghi ->
  lo * Ghi <= gamma * Rpower h alpha -> gamma * Rpower h alpha <= hi * Glo ->
  lo <= mu_of alpha gamma h <= hi.
Proof.
  intros Hg Hh HG Hlo [G1 G2] L U. unfold mu_of. rewrite rpow_pos by exact Hh.
  set (G := Gamma (alpha + 1)) in *. assert (P : 0 < Rpower h alpha) by apply exp_pos.
  assert (0 < G) by lra.
  assert (E : gamma * (Rpower h alpha / G) * G = gamma * Rpower h alpha) by (field; lra).
  assert (hi0 : 0 < hi).
  { apply Rmult_lt_reg_r with Glo; [exact HG|]. rewrite Rmult_0_l.
    eapply Rlt_le_trans; [|exact U]. apply Rmult_lt_0_compat; assumption. }
  split; apply Rmult_le_reg_r with G; try assumption; rewrite E.
  - eapply Rle_trans; [|exact L]. apply Rmult_le_compat_l; assumption.
  - eapply Rle_trans; [exact U|]. apply Rmult_le_compat_l; lra.
Qed.
