(** The relations of the paper's proof that rest on its step fail on its own example. *)
From Coq Require Import Reals Arith Lia Lra.
From Interval Require Import Tactic.
From Fomas Require Import Model.Vectors Model.Kernel Model.Graph Model.Loop Model.Examples Statements.
From Fomas Require Import Facts.Sums Facts.Vectors Facts.Kernel Facts.Graph Facts.Loop.
From Fomas Require Import Results.ClosedLoop Instances.Gamma19 Instances.PaperExample.
Open Scope R_scope.

(** |f(1)| and |f(2)| at alpha = 0.9. *)
Lemma paper_f_bounds :
  13393 / 100000 < Rabs (fk paper_alpha 1) < 13394 / 100000 /\
  4425 / 100000 < Rabs (fk paper_alpha 2) < 4426 / 100000.
Proof.
  assert (Ha := proj1 paper_design). rewrite !fk_abs by exact Ha. rewrite ck_0, ck_1, ck_2.
  unfold paper_alpha. split; split; interval with (i_prec 90).
Qed.

(** e_1, e_2 and e_3 from (0, -1, -1, -1, 1), as polynomials in mu. *)
Definition counter_e1 (m : R) : vec := of_list
  (2 * m :: m - 1 :: m - 1 :: - 2 * m :: 2 - 2 * m :: nil)%list.
Definition counter_e2 (m : R) : vec := of_list
  (- 8 * m ^ 2 + 4 * m :: m ^ 2 + 2 * m - 1 :: m ^ 2 + 2 * m - 1 :: 6 * m ^ 2 - 4 * m
   :: 2 - 4 * m :: nil)%list.
Definition counter_e3 (m : R) : vec := of_list
  (22 * m ^ 3 - 24 * m ^ 2 + 6 * m :: - 9 * m ^ 3 + 3 * m ^ 2 + 3 * m - 1
   :: - 9 * m ^ 3 + 3 * m ^ 2 + 3 * m - 1 :: - 10 * m ^ 3 + 18 * m ^ 2 - 6 * m
   :: 6 * m ^ 3 - 6 * m + 2 :: nil)%list.

Section Chain.
Variables (x : R -> vec) (u : nat -> vec).
Hypothesis H : closed_loop 5 paper_graph paper_alpha paper_gamma paper_h counter_x0 x u.

Ltac next k e := intros i Hi;
  rewrite (error_step 5%nat paper_graph paper_alpha paper_gamma paper_h counter_x0 x u paper_design H k i Hi);
  rewrite (mv_ext 5 _ _ e) by assumption;
  fold paper_mu; rewrite paper_step_correct by exact Hi;
  below5 i; unfold paper_step, fiedler, counter_e1, counter_e2, counter_e3, of_list;
  cbn -[pow Rmult Rplus Rminus Ropp Rdiv IZR]; ring.

Lemma counter_errors :
  (forall i, (i < 5)%nat -> error 5 paper_graph paper_h x 0 i = fiedler i) /\
  (forall i, (i < 5)%nat -> error 5 paper_graph paper_h x 1 i = counter_e1 paper_mu i) /\
  (forall i, (i < 5)%nat -> error 5 paper_graph paper_h x 2 i = counter_e2 paper_mu i) /\
  (forall i, (i < 5)%nat -> error 5 paper_graph paper_h x 3 i = counter_e3 paper_mu i).
Proof.
  assert (E0 : forall i, (i < 5)%nat -> error 5 paper_graph paper_h x 0 i = fiedler i).
  { intros i Hi. rewrite (loop_error 5 paper_graph paper_alpha paper_gamma paper_h counter_x0
      paper_design x u H 0 i Hi). apply counter_laplacian, Hi. }
  assert (E1 : forall i, (i < 5)%nat -> error 5 paper_graph paper_h x 1 i = counter_e1 paper_mu i)
    by next 0%nat fiedler.
  assert (E2 : forall i, (i < 5)%nat -> error 5 paper_graph paper_h x 2 i = counter_e2 paper_mu i)
    by next 1%nat (counter_e1 paper_mu).
  split; [exact E0|]. split; [exact E1|]. split; [exact E2|].
  next 2%nat (counter_e2 paper_mu).
Qed.

(** u_k = -gamma v_k. *)
Lemma counter_controls : let f l := Rabs (fk paper_alpha l) in
  let v1 i := counter_e1 paper_mu i + f 1%nat * fiedler i in
  norm 5 (u 0%nat) = paper_gamma * norm 5 fiedler /\
  norm 5 (u 1%nat) = paper_gamma * norm 5 v1 /\
  norm 5 (u 2%nat) = paper_gamma * norm 5 (fun i =>
    counter_e2 paper_mu i + f 1%nat * v1 i + f 2%nat * fiedler i).
Proof.
  intros f v1. destruct counter_errors as [E0 [E1 [E2 _]]].
  assert (G : Rabs (- paper_gamma) = paper_gamma)
    by (rewrite Rabs_Ropp; apply Rabs_right; unfold paper_gamma; lra).
  destruct (equ1 5%nat paper_graph paper_alpha paper_gamma paper_h counter_x0 x u paper_design H) as [_ U].
  assert (U0 : forall i, (i < 5)%nat -> u 0%nat i = - paper_gamma * fiedler i).
  { intros i Hi. rewrite (U 0%nat i Hi), (E0 i Hi). simpl. ring. }
  assert (U1 : forall i, (i < 5)%nat -> u 1%nat i = - paper_gamma * v1 i).
  { intros i Hi. rewrite (U 1%nat i Hi), (E1 i Hi). simpl sum_lt. simpl Nat.sub.
    rewrite (U0 i Hi). unfold v1, f. ring. }
  assert (U2 : forall i, (i < 5)%nat -> u 2%nat i = - paper_gamma *
            (counter_e2 paper_mu i + f 1%nat * v1 i + f 2%nat * fiedler i)).
  { intros i Hi. rewrite (U 2%nat i Hi), (E2 i Hi). simpl sum_lt. simpl Nat.sub.
    rewrite (U0 i Hi), (U1 i Hi). unfold f. ring. }
  rewrite <- G at 1 2 3. rewrite <- !norm_scal.
  split; [apply norm_ext, U0|split; [apply norm_ext, U1|apply norm_ext, U2]].
Qed.
End Chain.

Ltac by_interval m := unfold norm, dot, fiedler, counter_e1, counter_e2, counter_e3, of_list;
  simpl sum_lt; cbn [List.nth]; interval with (i_prec 60, i_bisect m, i_taylor m).

Theorem paper_chain_false : paper_chain_false_statement.
Proof.
  intros x u H beta f e U. unfold e, U.
  destruct (counter_errors x u H) as [E0 [_ [E2 E3]]].
  destruct (counter_controls x u H) as [V0 [V1 V2]].
  rewrite (norm_ext 5 _ _ E0), (norm_ext 5 _ _ E2), (norm_ext 5 _ _ E3), V0, V1, V2.
  assert (M := paper_mu_bounds). destruct paper_f_bounds as [F1 F2]. fold (f 1%nat) in F1 |- *.
  fold (f 2%nat) in F2 |- *. unfold beta. clear - M F1 F2.
  assert (G : 0 < paper_gamma) by (unfold paper_gamma; lra).
  revert M F1 F2 G. generalize paper_mu (f 1%nat) (f 2%nat) paper_gamma.
  intros m f1 f2 g M F1 F2 G.
  assert (scale : forall a b, 0 < b - a -> g * a < g * b) by (intros; apply Rmult_lt_compat_l; lra).
  repeat split.
  - replace ((1 - m * 1 + f1) * (g * norm 5 fiedler)) with (g * ((1 - m + f1) * norm 5 fiedler))
      by ring.
    apply scale. by_interval m.
  - match goal with |- ?x < g * ?y => replace x with (g * ((1 - m) ^ 2 * norm 5 fiedler
      + (f1 * norm 5 (fun i => counter_e1 m i + f1 * fiedler i) + f2 * norm 5 fiedler))) by ring end.
    apply scale. by_interval m.
  - match goal with |- ?x < g * ?y =>
      replace x with (g * (((1 - m) ^ 2 + (f1 + f2)) * norm 5 fiedler)) by ring end.
    apply scale. by_interval m.
  - rewrite Rmult_assoc. apply scale. rewrite Rmult_1_r. by_interval m.
  - rewrite Rmult_assoc. apply scale. rewrite Rmult_1_r. by_interval m.
Qed.
