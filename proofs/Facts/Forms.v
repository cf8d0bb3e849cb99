(** Quadratic forms as functions of their matrix, and forms that are positive off zero. *)
From Coq Require Import Reals Arith Lia Lra.
From Fomas Require Import Model.Vectors Model.Coordinates Facts.Sums Facts.Vectors Facts.Lambda2.
Open Scope R_scope.

Lemma form_linear N Q1 Q2 a b x :
  form N (fun i j => a * Q1 i j + b * Q2 i j) x = a * form N Q1 x + b * form N Q2 x.
Proof.
  rewrite !form_double_sum, <- !sum_scal, <- sum_plus. apply sum_ext. intros i _.
  rewrite <- !sum_scal, <- sum_plus. apply sum_ext. intros j _. ring.
Qed.

Lemma form_mat_ext N Q1 Q2 x :
  (forall i j, (i < N)%nat -> (j < N)%nat -> Q1 i j = Q2 i j) -> form N Q1 x = form N Q2 x.
Proof.
  intros H. rewrite !form_double_sum. apply sum_ext. intros i Hi. apply sum_ext. intros j Hj.
  rewrite H by assumption. reflexivity.
Qed.

Lemma form_congruence N Q B x :
  form N (fun i j => \sum_(k < N) (B k i * \sum_(l < N) (Q k l * B l j))) x
  = form N Q (mv N B x).
Proof.
  unfold form at 2, dot.
  transitivity (\sum_(k < N) \sum_(i < N) ((B k i * x i) * mv N Q (mv N B x) k)).
  2: { apply sum_ext. intros k _. apply sum_scal_r. }
  rewrite sum_swap. unfold form, dot. apply sum_ext. intros i _.
  rewrite (sum_ext N (fun k => B k i * x i * mv N Q (mv N B x) k)
             (fun k => x i * (B k i * mv N Q (mv N B x) k))) by (intros; ring).
  rewrite sum_scal. f_equal. unfold mv at 1.
  rewrite (sum_ext N _ (fun j => \sum_(k < N) (B k i * (\sum_(l < N) (Q k l * B l j)) * x j)))
    by (intros; symmetry; apply sum_scal_r).
  rewrite sum_swap. apply sum_ext. intros k _.
  rewrite (sum_ext N _ (fun j => B k i * ((\sum_(l < N) (Q k l * B l j)) * x j)))
    by (intros; ring).
  rewrite sum_scal. f_equal. unfold mv.
  rewrite (sum_ext N (fun l => Q k l * _)
             (fun l => \sum_(j < N) (Q k l * (B l j * x j))))
    by (intros; symmetry; apply sum_scal).
  rewrite sum_swap. apply sum_ext. intros j _. rewrite <- sum_scal_r. apply sum_ext.
  intros; ring.
Qed.

Lemma form_identity N x : form N id_mat x = dot N x x.
Proof. unfold form. apply dot_ext; [auto|]. intros i Hi. unfold mv. apply id_mat_sum, Hi. Qed.

Lemma form_gram N M x : form N (gram N M) x = dot N (mv N M x) (mv N M x).
Proof.
  rewrite <- (form_identity N (mv N M x)), <- form_congruence. apply form_mat_ext.
  intros i j Hi Hj. apply sum_ext. intros k Hk. f_equal. symmetry.
  apply (id_mat_sum N k (fun l => M l j)), Hk.
Qed.

Lemma form_stein_form n Q M y :
  form n (stein_form n Q M) y = form n Q y - form n Q (mv n M y).
Proof.
  rewrite <- form_congruence.
  rewrite (form_mat_ext n _ (fun i j => 1 * Q i j + (-1) *
    \sum_(k < n) (M k i * \sum_(l < n) (Q k l * M l j)))) by (intros; unfold stein_form; ring).
  rewrite form_linear. ring.
Qed.

(** A form is that of its symmetric part. *)
Definition symmetric_part (Q : mat) : mat := fun i j => / 2 * Q i j + / 2 * Q j i.

Lemma form_symmetric_part n Q x : form n (symmetric_part Q) x = form n Q x.
Proof.
  unfold symmetric_part. rewrite (form_linear n Q (fun i j => Q j i)).
  replace (form n (fun i j => Q j i) x) with (form n Q x); [field|].
  rewrite !form_double_sum, sum_swap. apply sum_ext. intros i _. apply sum_ext. intros; ring.
Qed.

Lemma symmetric_part_sym Q i j : symmetric_part Q i j = symmetric_part Q j i.
Proof. unfold symmetric_part. ring. Qed.

Lemma definite_bounded n Q : positive_definite n Q ->
  exists eps, 0 < eps /\ forall y, eps * dot n y y <= form n Q y.
Proof.
  intros H. destruct (positive_form_bounded n (symmetric_part Q) (symmetric_part_sym Q))
    as [e [He B]].
  - intros x Px. rewrite form_symmetric_part. apply H, Px.
  - exists e. split; [exact He|]. intros y. rewrite <- form_symmetric_part. apply B.
Qed.

Lemma definite_bounded_1perp n Q :
  (forall x, zero_sum (S n) x -> 0 < dot (S n) x x -> 0 < form (S n) Q x) ->
  exists eps, 0 < eps /\ forall x, zero_sum (S n) x -> eps * dot (S n) x x <= form (S n) Q x.
Proof.
  intros H. destruct (positive_form_bounded_1perp n (symmetric_part Q) (symmetric_part_sym Q))
    as [e [He B]].
  - intros x Hx Px. rewrite form_symmetric_part. apply H; assumption.
  - exists e. split; [exact He|]. intros y Hy. rewrite <- form_symmetric_part. apply B, Hy.
Qed.

(** A symmetric form that vanishes everywhere has no entry but zero. *)
Lemma zero_form n Q : symmetric n Q -> (forall y, form n Q y = 0) ->
  forall i j, (i < n)%nat -> (j < n)%nat -> Q i j = 0.
Proof.
  intros sym Z i j Hi Hj. assert (U := Z (fun l => id_mat i l + id_mat j l)).
  rewrite form_plus in U by exact sym. rewrite (Z (id_mat i)), (Z (id_mat j)) in U.
  unfold dot in U. rewrite id_mat_sum in U by exact Hi.
  unfold mv in U.
  rewrite (sum_ext n _ (fun l => id_mat j l * Q i l)) in U by (intros; ring).
  rewrite id_mat_sum in U by exact Hj. lra.
Qed.
