(** Tests in the basis V of 1perp say what is true on 1perp. *)
From Coq Require Import Reals Arith Lia Lra.
From Fomas Require Import Model.Vectors Model.Graph Model.Coordinates Statements.
From Fomas Require Import Facts.Sums Facts.Vectors Facts.Graph Facts.Lambda2 Facts.Forms.
From Fomas Require Import Facts.Contraction.
Open Scope R_scope.

Lemma embed_below n y i : (i < n)%nat -> embed n y i = y i.
Proof. intros Hi. unfold embed. destruct (Nat.eqb_spec i n); [lia|reflexivity]. Qed.

Lemma embed_last n y : embed n y n = - sum_lt n y.
Proof. unfold embed. rewrite Nat.eqb_refl. reflexivity. Qed.

Lemma embed_zero_sum n y : zero_sum (S n) (embed n y).
Proof.
  unfold zero_sum. rewrite sum_last, embed_last, (sum_ext n (embed n y) y).
  - ring.
  - intros i Hi. apply embed_below, Hi.
Qed.

Lemma embed_onto n x i : zero_sum (S n) x -> (i < S n)%nat -> embed n x i = x i.
Proof.
  unfold zero_sum. rewrite sum_last. intros Hx Hi.
  destruct (Nat.eq_dec i n) as [->|Ne]; [rewrite embed_last; lra|apply embed_below; lia].
Qed.

Lemma dot_embed n y : dot (S n) (embed n y) (embed n y) = dot n y y + sum_lt n y ^ 2.
Proof.
  unfold dot. rewrite sum_last, embed_last, (sum_ext n _ (fun i => y i * y i)).
  - ring.
  - intros i Hi. rewrite embed_below by exact Hi. reflexivity.
Qed.

Lemma form_on_basis n M y : form n (on_basis n M) y = form (S n) M (embed n y).
Proof.
  set (z := mv (S n) M (embed n y)).
  assert (Z : forall i, z i = \sum_(j < n) ((M i j - M i n) * y j)).
  { intros i. unfold z, mv. rewrite sum_last, embed_last.
    rewrite (sum_ext n _ (fun j => M i j * y j)) by (intros; rewrite embed_below; auto).
    rewrite (sum_ext n (fun j => (M i j - M i n) * y j) (fun j => M i j * y j - M i n * y j))
      by (intros; ring).
    rewrite sum_minus, sum_scal. change (\sum_(i < n) y i) with (sum_lt n y). ring. }
  unfold form. fold z. unfold dot at 2. rewrite sum_last, embed_last.
  rewrite (sum_ext n (fun i => embed n y i * z i) (fun i => y i * z i))
    by (intros; rewrite embed_below; auto).
  replace (\sum_(i < n) (y i * z i) + - sum_lt n y * z n)
    with (\sum_(i < n) (y i * z i) - \sum_(i < n) (y i * z n)) by (rewrite sum_scal_r; ring).
  rewrite <- sum_minus. apply sum_ext. intros i Hi. rewrite <- Rmult_minus_distr_l. f_equal.
  rewrite !Z, <- sum_minus. apply sum_ext. intros j _. unfold on_basis. ring.
Qed.

Lemma semidefinite_on_basis n M : positive_semidefinite n (on_basis n M) <->
  forall x, zero_sum (S n) x -> 0 <= form (S n) M x.
Proof.
  split.
  - intros H x Hx. rewrite (form_ext (S n) M x (embed n x)).
    + rewrite <- form_on_basis. apply H.
    + intros i Hi. symmetry. apply embed_onto; assumption.
  - intros H y. rewrite form_on_basis. apply H, embed_zero_sum.
Qed.

Lemma definite_on_basis n M : positive_definite n (on_basis n M) <->
  forall x, zero_sum (S n) x -> 0 < dot (S n) x x -> 0 < form (S n) M x.
Proof.
  split.
  - intros H x Hx Px. assert (E := fun i Hi => embed_onto n x i Hx Hi).
    rewrite (form_ext (S n) M x (embed n x)) by (intros; symmetry; apply E; assumption).
    rewrite <- form_on_basis. apply H.
    rewrite <- (dot_ext (S n) _ _ _ _ E E), dot_embed in Px.
    assert (P0 := dot_nonneg n x). destruct (Req_dec (dot n x x) 0) as [Z|Z]; [|lra].
    assert (S0 : sum_lt n x = 0) by (apply sum_zero, dot_zero, Z). rewrite S0, Z in Px. lra.
  - intros H y Py. rewrite form_on_basis. apply H; [apply embed_zero_sum|].
    rewrite dot_embed. assert (Q := pow2_ge_0 (sum_lt n y)). lra.
Qed.

Theorem basis : basis_statement.
Proof.
  intros n. split; [apply embed_zero_sum|]. split; [apply embed_onto|]. split; [|split; [|split]].
  - intros i j Hi Hj. unfold on_basis, id_mat. rewrite Nat.eqb_refl.
    destruct (Nat.eqb_spec i n), (Nat.eqb_spec n j); try lia. ring.
  - apply form_on_basis.
  - apply semidefinite_on_basis.
  - apply definite_on_basis.
Qed.

Theorem definite_margin : definite_margin_statement.
Proof.
  intros n. split; [apply definite_bounded|]. intros M H.
  apply definite_bounded_1perp, definite_on_basis, H.
Qed.

Lemma form_shifted N a M x :
  form N (fun i j => a * id_mat i j - M i j) x = a * dot N x x - form N M x.
Proof.
  rewrite (form_mat_ext N _ (fun i j => a * id_mat i j + (-1) * M i j)) by (intros; ring).
  rewrite form_linear, form_identity. ring.
Qed.

Theorem contraction_test : contraction_test_statement.
Proof.
  intros n A mu s Hs tested. set (P := perron (S n) A mu).
  assert (E : forall x, form (S n) (fun i j => s ^ 2 * id_mat i j - gram (S n) P i j) x
              = s ^ 2 * dot (S n) x x - dot (S n) (mv (S n) P x) (mv (S n) P x)).
  { intros x. rewrite form_shifted, form_gram. reflexivity. }
  split.
  - unfold tested. rewrite semidefinite_on_basis. fold P. split.
    + intros H. split; [exact Hs|]. intros x Hx. specialize (H x Hx). rewrite E in H.
      apply norm_le_bound; [apply Rmult_le_pos; [exact Hs|apply norm_nonneg]|].
      rewrite Rpow_mult_distr, norm_pow2. fold P. lra.
    + intros C x Hx. rewrite E. assert (T := contracts_dot (S n) A mu s x C Hx). fold P in T. lra.
  - intros Ps H. destruct (proj2 (definite_margin n) _ H) as [eps [He B]].
    exists (sqrt (Rmax 0 (s ^ 2 - eps))). split.
    + rewrite <- (sqrt_pow2 s Hs) at 2. apply sqrt_lt_1_alt. split; [apply Rmax_l|].
      apply Rmax_lub_lt; [apply pow_lt, Ps|lra].
    + split; [apply sqrt_pos|]. apply bounded_squared. intros x Hx. specialize (B x Hx).
      fold P in B |- *. rewrite E in B. lra.
Qed.

Theorem lambda2_test : lambda2_test_statement.
Proof.
  intros n A l s [low [v [Hv [Pv Ev]]]] tested.
  assert (E : forall x,
    form (S n) (fun i j => laplacian_sym (S n) A i j - s * id_mat i j) x
    = form (S n) (laplacian_sym (S n) A) x - s * dot (S n) x x).
  { intros x. rewrite (form_mat_ext (S n) _
      (fun i j => 1 * laplacian_sym (S n) A i j + (- s) * id_mat i j)) by (intros; ring).
    rewrite form_linear, form_identity. ring. }
  unfold tested. rewrite semidefinite_on_basis, definite_on_basis. split; split.
  - intros H. specialize (H v Hv). rewrite E, Ev in H.
    apply Rmult_le_reg_r with (dot (S n) v v); lra.
  - intros H x Hx. rewrite E. assert (B := low x Hx). assert (P := dot_nonneg (S n) x). nra.
  - intros H. specialize (H v Hv Pv). rewrite E, Ev in H.
    apply Rmult_lt_reg_r with (dot (S n) v v); lra.
  - intros H x Hx Px. rewrite E. assert (B := low x Hx). nra.
Qed.

(** * Differences from the last agent *)

Lemma row_sum_zero n A i : (i < S n)%nat -> \sum_(j < S n) laplacian (S n) A i j = 0.
Proof.
  intros Hi. rewrite <- (laplacian_ones (S n) A i Hi). apply sum_ext. intros. unfold ones. ring.
Qed.

Theorem differences_evolve : differences_evolve_statement.
Proof.
  intros n A t x i Hi.
  assert (E : differences n (mv (S n) (laplacian (S n) A) x) i
              = mv n (differences_laplacian n A) (differences n x) i).
  { unfold differences at 1, mv. rewrite <- sum_minus.
    rewrite (sum_ext (S n) _ (fun j => differences_laplacian n A i j * differences n x j
               + (laplacian (S n) A i j * x n - laplacian (S n) A n j * x n)))
      by (intros; unfold differences_laplacian, differences; ring).
    rewrite sum_plus, sum_minus, !sum_scal_r, !row_sum_zero by lia.
    rewrite sum_last. unfold differences at 2. ring. }
  split; [exact E|].
  transitivity (differences n x i - t * differences n (mv (S n) (laplacian (S n) A) x) i).
  - unfold differences. rewrite !perron_entry by lia. ring.
  - rewrite E. unfold mv at 2, differences_step.
    rewrite (sum_ext n _ (fun j => id_mat i j * differences n x j
               - t * (differences_laplacian n A i j * differences n x j))) by (intros; ring).
    rewrite sum_minus, sum_scal, id_mat_sum by exact Hi. reflexivity.
Qed.
