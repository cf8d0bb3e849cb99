(** Bounds of Gamma(1.9) and of the paper's numbers; Gamma is its integral. *)
From Coq Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
From Interval Require Import Tactic.
From Fomas Require Import Model.Vectors Model.Kernel Model.Gamma Model.Loop Model.Examples Statements.
From Fomas Require Import Facts.Kernel Facts.Gamma.
Open Scope R_scope.

Lemma integrand_19 t : Gamma_integrand (19 / 10) t = Rpower t (9 / 10) * exp (- t).
Proof. unfold Gamma_integrand. do 2 f_equal. field. Qed.

Lemma integral_19 a b : RInt (Gamma_integrand (19 / 10)) a b
  = RInt (fun t => Rpower t (9 / 10) * exp (- t)) a b.
Proof. apply RInt_ext. intros. apply integrand_19. Qed.

(** The piece next to zero: the integrand is at most 1 there. *)
Lemma head_19 a : 0 < a <= 1 / 1000 -> RInt (Gamma_integrand (19 / 10)) a (1 / 1000) <= 1 / 1000.
Proof.
  intros Ha. apply Rle_trans with (RInt (fun _ => 1) a (1 / 1000)).
  - apply RInt_le; [lra|apply Gamma_integrand_ex; lra|apply ex_RInt_const|].
    intros t Ht. rewrite integrand_19.
    assert (E : exp (- t) < 1) by (rewrite <- exp_0; apply exp_increasing; lra).
    assert (P : Rpower t (9 / 10) <= 1).
    { rewrite <- (rpow_1 (9 / 10)), <- rpow_pos by lra. apply rpow_le; lra. }
    assert (Q : 0 < exp (- t)) by apply exp_pos.
    assert (Z : 0 < Rpower t (9 / 10)) by apply exp_pos. nra.
  - rewrite RInt_const. unfold scal; simpl; unfold mult; simpl. lra.
Qed.

(** The tail: the integrand is at most t e^(-t) there. *)
Lemma tail_19 b : 12 <= b -> RInt (Gamma_integrand (19 / 10)) 12 b <= 13 * exp (- 12).
Proof.
  intros Hb.
  assert (I : is_RInt (fun t => t * exp (- t)) 12 b
                (- (b + 1) * exp (- b) - - (12 + 1) * exp (- 12))).
  { apply (is_RInt_derive (fun t => - (t + 1) * exp (- t))).
    - intros t _. auto_derive; [exact I|ring].
    - intros t _. apply (ex_derive_continuous (fun t => t * exp (- t))). auto_derive. exact I. }
  apply Rle_trans with (RInt (fun t => t * exp (- t)) 12 b).
  - apply RInt_le; [lra|apply Gamma_integrand_ex; lra|eexists; exact I|].
    intros t Ht. rewrite integrand_19. apply Rmult_le_compat_r; [left; apply exp_pos|].
    rewrite <- (Rpower_1 t) at 2 by lra. apply Rle_Rpower; lra.
  - rewrite (is_RInt_unique _ _ _ _ I).
    assert (0 < exp (- b)) by apply exp_pos. nra.
Qed.

Lemma middle_19 : RInt (fun t => Rpower t (9 / 10) * exp (- t)) (1 / 1000) 12 <= 9645 / 10000.
Proof. integral with (i_prec 40, i_relwidth 12, i_degree 8). Qed.

Theorem gamma_19 : gamma_19_statement.
Proof.
  split.
  - eapply Rle_trans; [|apply (Gamma_lower (19 / 10) (1 / 1000) 10); lra].
    rewrite integral_19. integral with (i_prec 40, i_relwidth 12, i_degree 8).
  - apply Gamma_upper; [lra|]. intros a b Ha Hb.
    set (a' := Rmin a (1 / 1000)). set (b' := Rmax b 12).
    assert (A1 : a' <= a) by apply Rmin_l. assert (A2 : a' <= 1 / 1000) by apply Rmin_r.
    assert (A3 : 0 < a') by (apply Rmin_glb_lt; lra).
    assert (B1 : b <= b') by apply Rmax_l. assert (B2 : 12 <= b') by apply Rmax_r.
    eapply Rle_trans; [apply (Gamma_integrand_mono (19 / 10) a b a' b'); lra|].
    rewrite <- (RInt_Chasles (Gamma_integrand (19 / 10)) a' (1 / 1000) b')
      by (apply Gamma_integrand_ex; lra).
    rewrite <- (RInt_Chasles (Gamma_integrand (19 / 10)) (1 / 1000) 12 b')
      by (apply Gamma_integrand_ex; lra).
    assert (H := head_19 a' ltac:(lra)). assert (M := middle_19).
    rewrite <- integral_19 in M. assert (T := tail_19 b' B2).
    assert (E : exp (- 12) <= 1 / 100000) by interval with (i_prec 90).
    unfold plus; simpl. lra.
Qed.

(** 0.134 < mu < 0.1358 and 0.86606 < c_1 < 0.86607. *)
Lemma paper_mu_bounds : 134 / 1000 < paper_mu < 1358 / 10000.
Proof.
  unfold paper_mu, mu_of, paper_alpha, paper_gamma, paper_h. rewrite rpow_pos by lra.
  destruct gamma_19 as [L U]. replace (9 / 10 + 1) with (19 / 10) by field.
  set (G := Gamma (19 / 10)) in *.
  assert (B : 8639 / 10000 <= Rpower (85 / 100) (9 / 10) <= 8640 / 10000)
    by (split; interval with (i_prec 90)).
  split.
  - apply Rmult_lt_reg_r with G; [lra|].
    replace (15 / 100 * (Rpower (85 / 100) (9 / 10) / G) * G)
      with (15 / 100 * Rpower (85 / 100) (9 / 10)) by (field; lra). lra.
  - apply Rmult_lt_reg_r with G; [lra|].
    replace (15 / 100 * (Rpower (85 / 100) (9 / 10) / G) * G)
      with (15 / 100 * Rpower (85 / 100) (9 / 10)) by (field; lra). lra.
Qed.

Lemma paper_c1_bounds : 86606 / 100000 < Rpower 2 paper_alpha - 1 < 86607 / 100000.
Proof. unfold paper_alpha. split; interval with (i_prec 90). Qed.
