(** The eigenvalues of the Perron matrix. *)
From Coq Require Import Reals Arith Lia Lra.
From Coquelicot Require Import Coquelicot.
From Fomas Require Import Model.Vectors Model.Kernel Model.Gamma Model.Graph Model.Loop Statements.
From Fomas Require Import Facts.Sums Facts.Vectors Facts.Kernel Facts.Resolvent Facts.Graph.
From Fomas Require Import Facts.Lambda2 Facts.Contraction.
Open Scope R_scope.

(** The parts of an eigenvector for an eigenvalue a + b i other than 1 lie in 1perp. *)
Lemma eigenvector_zero_sum N A mu a b x y : balanced N A ->
  (forall i, (i < N)%nat -> mv N (perron N A mu) x i = a * x i - b * y i) ->
  (forall i, (i < N)%nat -> mv N (perron N A mu) y i = b * x i + a * y i) ->
  ~ (a = 1 /\ b = 0) -> zero_sum N x /\ zero_sum N y.
Proof.
  intros bal Ex Ey Hne.
  assert (Sx : sum_lt N x = a * sum_lt N x - b * sum_lt N y).
  { rewrite <- (sum_perron N A bal mu x) at 1.
    rewrite (sum_ext N _ _ Ex), sum_minus, !sum_scal. reflexivity. }
  assert (Sy : sum_lt N y = b * sum_lt N x + a * sum_lt N y).
  { rewrite <- (sum_perron N A bal mu y) at 1.
    rewrite (sum_ext N _ _ Ey), sum_plus, !sum_scal. reflexivity. }
  assert (K : (1 - a) ^ 2 + b ^ 2 <> 0).
  { intros K. apply Hne. assert (Q1 := pow2_ge_0 (1 - a)). assert (Q2 := pow2_ge_0 b).
    split; nra. }
  split; unfold zero_sum; apply Rmult_eq_reg_l with ((1 - a) ^ 2 + b ^ 2); try exact K.
  - replace (((1 - a) ^ 2 + b ^ 2) * sum_lt N x)
      with ((1 - a) * (sum_lt N x - (a * sum_lt N x - b * sum_lt N y))
            + - b * (sum_lt N y - (b * sum_lt N x + a * sum_lt N y))) by ring.
    rewrite <- Sx, <- Sy. ring.
  - replace (((1 - a) ^ 2 + b ^ 2) * sum_lt N y)
      with (b * (sum_lt N x - (a * sum_lt N x - b * sum_lt N y))
            + (1 - a) * (sum_lt N y - (b * sum_lt N x + a * sum_lt N y))) by ring.
    rewrite <- Sx, <- Sy. ring.
Qed.

Theorem perron_eigenvalues : perron_eigenvalues_statement.
Proof.
  intros N A mu HN H1 HG. unfold perron_spectrum.
  set (P := mv N (perron N A mu)). destruct (gain_bound_lt N A mu HG) as [Hm HD].
  destruct (strict_contraction N A mu H1 Hm HD) as [s [Hs Hc]].
  assert (H1' := H1). destruct H1 as [dig [con bal]].
  assert (fixed : forall y, zero_sum N y -> (forall i, (i < N)%nat -> P y i = y i) ->
            forall i, (i < N)%nat -> y i = 0).
  { intros y Hy E. apply norm_zero_inv. assert (C := proj2 Hc y Hy). fold P in C.
    rewrite (norm_ext N (P y) y E) in C. assert (Q := norm_nonneg N y). nra. }
  split; [|split].
  - intros i Hi. unfold P. rewrite perron_entry, laplacian_ones by exact Hi.
    unfold ones. ring.
  - intros x Hx.
    (* y = (P - I) x lies in 1perp and is fixed by P, so it is zero; so is x - mean *)
    assert (Y : forall i, (i < N)%nat -> P x i - x i = 0).
    { apply fixed.
      - apply zero_sum_ext with (fun i => - mu * mv N (laplacian N A) x i).
        + intros i Hi. unfold P. rewrite perron_entry by exact Hi. ring.
        + apply zero_sum_scal, zero_sum_laplacian, bal.
      - intros i Hi. unfold P at 1. rewrite mv_minus. fold P.
        specialize (Hx i Hi). unfold P at 1 in Hx. unfold P. unfold P in Hx. lra. }
    assert (Z : forall i, (i < N)%nat -> x i - mean N x = 0).
    { apply fixed; [apply zero_sum_deviation; lia|]. intros i Hi. unfold P.
      rewrite perron_entry by exact Hi.
      rewrite (mv_minus N (laplacian N A) x (fun _ => mean N x)).
      rewrite (laplacian_entry N A (fun _ => mean N x)) by exact Hi.
      rewrite (sum_zero N (fun j => A i j * (mean N x - mean N x))) by (intros; ring).
      specialize (Y i Hi). unfold P in Y. rewrite perron_entry in Y by exact Hi. lra. }
    intros i Hi. assert (Z1 := Z i Hi). assert (Z2 := Z 0%nat ltac:(lia)). lra.
  - intros a b x y Pxy Ex Ey Hne.
    (* both parts lie in 1perp, where |P x|^2 + |P y|^2 = (a^2 + b^2) (|x|^2 + |y|^2) *)
    destruct (eigenvector_zero_sum N A mu a b x y bal Ex Ey Hne) as [Zx Zy].
    assert (Cx := contracts_dot N A mu s x Hc Zx). assert (Cy := contracts_dot N A mu s y Hc Zy).
    fold P in Cx, Cy.
    rewrite (dot_ext N _ _ _ _ Ex Ex) in Cx. rewrite (dot_ext N _ _ _ _ Ey Ey) in Cy.
    rewrite dot_minus_l, !dot_minus_r, !dot_scal_l, !dot_scal_r, (dot_comm N y x) in Cx.
    rewrite dot_plus_l, !dot_plus_r, !dot_scal_l, !dot_scal_r, (dot_comm N y x) in Cy.
    assert (E : (a ^ 2 + b ^ 2) * (dot N x x + dot N y y)
                <= s ^ 2 * (dot N x x + dot N y y)) by lra.
    apply Rmult_le_reg_r in E; [|exact Pxy]. destruct Hc as [s0 _]. nra.
Qed.
