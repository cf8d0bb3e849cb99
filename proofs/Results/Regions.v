(** Bounds of the eigenvalues of P, ends of regions of mu, and lambda2 as a semidefinite test. *)
From Coq Require Import Reals Arith Lia Lra.
From Fomas Require Import Model.Vectors Model.Kernel Model.Gamma Model.Graph Model.Loop Statements.
From Fomas Require Import Facts.Sums Facts.Vectors Facts.Graph Facts.Contraction.
From Fomas Require Import Results.Perron Results.Soundness.
Open Scope R_scope.

Theorem eigenvalue_bounds : eigenvalue_bounds_statement.
Proof.
  intros N A mu l s a b x y dig bal Hl Hm Hc P Pxy Ex Ey Hne.
  destruct (eigenvector_zero_sum N A mu a b x y bal Ex Ey Hne) as [Zx Zy].
  set (S2 := dot N x x + dot N y y) in *.
  set (Lx := mv N (laplacian N A) x). set (Ly := mv N (laplacian N A) y).
  assert (Vx : forall i, (i < N)%nat -> Lx i = ((1 - a) / mu) * x i - (- (b / mu)) * y i).
  { intros i Hi. assert (E := Ex i Hi). unfold P in E. rewrite perron_entry in E by exact Hi.
    fold Lx in E. apply Rmult_eq_reg_l with mu; [|lra].
    replace (mu * ((1 - a) / mu * x i - - (b / mu) * y i))
      with (x i - (a * x i - b * y i)) by (field; lra). lra. }
  assert (Vy : forall i, (i < N)%nat -> Ly i = (- (b / mu)) * x i - (- ((1 - a) / mu)) * y i).
  { intros i Hi. assert (E := Ey i Hi). unfold P in E. rewrite perron_entry in E by exact Hi.
    fold Ly in E. apply Rmult_eq_reg_l with mu; [|lra].
    replace (mu * (- (b / mu) * x i - - ((1 - a) / mu) * y i))
      with (y i - (b * x i + a * y i)) by (field; lra). lra. }
  assert (Nrm : dot N Lx Lx + dot N Ly Ly = (((1 - a) / mu) ^ 2 + (b / mu) ^ 2) * S2).
  { rewrite (dot_ext N _ _ _ _ Vx Vx), (dot_ext N _ _ _ _ Vy Vy).
    rewrite !dot_minus_l, !dot_minus_r, !dot_scal_l, !dot_scal_r, (dot_comm N y x).
    unfold S2. ring. }
  assert (Frm : form N (laplacian N A) x + form N (laplacian N A) y = ((1 - a) / mu) * S2).
  { unfold form. fold Lx Ly.
    rewrite (dot_ext N x Lx x _ (fun _ _ => eq_refl) Vx).
    rewrite (dot_ext N y Ly y _ (fun _ _ => eq_refl) Vy).
    rewrite !dot_minus_r, !dot_scal_r, (dot_comm N y x). unfold S2. ring. }
  assert (G : ((1 - a) / mu) ^ 2 + (b / mu) ^ 2 <= 2 * degree_max N A * ((1 - a) / mu)).
  { assert (Bx := laplacian_norm N A bal dig x). assert (By := laplacian_norm N A bal dig y).
    fold Lx in Bx. fold Ly in By.
    apply Rmult_le_reg_r with S2; [exact Pxy|]. rewrite <- Nrm.
    replace (2 * degree_max N A * ((1 - a) / mu) * S2)
      with (2 * degree_max N A * (((1 - a) / mu) * S2)) by ring.
    rewrite <- Frm. lra. }
  split; [exact G|]. split; [|split].
  - assert (G2 : mu ^ 2 * (((1 - a) / mu) ^ 2 + (b / mu) ^ 2)
                 <= mu ^ 2 * (2 * degree_max N A * ((1 - a) / mu)))
      by (apply Rmult_le_compat_l; [apply pow2_ge_0|exact G]).
    replace (mu ^ 2 * (((1 - a) / mu) ^ 2 + (b / mu) ^ 2)) with ((1 - a) ^ 2 + b ^ 2) in G2
      by (field; lra).
    replace (mu ^ 2 * (2 * degree_max N A * ((1 - a) / mu)))
      with (2 * (mu * degree_max N A) * (1 - a)) in G2 by (field; lra).
    nra.
  - destruct Hl as [low _]. assert (Bx := low x Zx). assert (By := low y Zy).
    rewrite form_sym in Bx, By.
    assert (F : l * S2 <= (1 - a) / mu * S2) by (rewrite <- Frm; unfold S2; lra).
    apply Rmult_le_reg_r in F; [|exact Pxy].
    apply Rmult_le_compat_l with (r := mu) in F; [|lra].
    replace (mu * ((1 - a) / mu)) with (1 - a) in F by (field; lra). lra.
  - assert (Cx := contracts_dot N A mu s x Hc Zx). assert (Cy := contracts_dot N A mu s y Hc Zy).
    fold P in Cx, Cy.
    rewrite (dot_ext N _ _ _ _ Ex Ex) in Cx. rewrite (dot_ext N _ _ _ _ Ey Ey) in Cy.
    rewrite dot_minus_l, !dot_minus_r, !dot_scal_l, !dot_scal_r, (dot_comm N y x) in Cx.
    rewrite dot_plus_l, !dot_plus_r, !dot_scal_l, !dot_scal_r, (dot_comm N y x) in Cy.
    apply Rmult_le_reg_r with S2; [exact Pxy|]. unfold S2. lra.
Qed.

Theorem outer_end : outer_end_statement.
Proof.
  intros N A mi mo mu t Hi Ho H C. apply Ho.
  set (theta := (mo - mi) / (mu - mi)).
  assert (NZ : mu - mi <> 0) by (destruct H; lra).
  assert (Ht : 0 <= theta <= 1).
  { unfold theta. destruct H as [H|H].
    - split; [apply Rmult_le_pos; [lra|left; apply Rinv_0_lt_compat; lra]|].
      apply Rmult_le_reg_r with (mu - mi); [lra|].
      unfold Rdiv. rewrite Rmult_assoc, Rinv_l by exact NZ. lra.
    - replace ((mo - mi) / (mu - mi)) with ((mi - mo) / (mi - mu)) by (field; lra).
      split; [apply Rmult_le_pos; [lra|left; apply Rinv_0_lt_compat; lra]|].
      apply Rmult_le_reg_r with (mi - mu); [lra|].
      unfold Rdiv. rewrite Rmult_assoc, Rinv_l by lra. lra. }
  assert (S := sigma_convex N A mi mu t t theta Ht Hi C).
  replace ((1 - theta) * mi + theta * mu) with mo in S by (unfold theta; field; exact NZ).
  replace ((1 - theta) * t + theta * t) with t in S by ring. exact S.
Qed.

Theorem consensus_interval : consensus_interval_statement.
Proof.
  intros N A Q rho2 mi mu bal sym pos Hr Hmu H.
  set (theta := mu / mi).
  assert (Ht : 0 < theta <= 1).
  { unfold theta. split; [apply Rdiv_lt_0_compat; lra|].
    apply Rmult_le_reg_r with mi; [lra|]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l by lra. lra. }
  set (r := (1 - theta) + theta * rho2).
  assert (R : 0 <= r < 1) by (unfold r; nra).
  exists (sqrt r). split.
  { split; [apply sqrt_pos|]. rewrite <- sqrt_1. apply sqrt_lt_1_alt. lra. }
  rewrite pow2_sqrt by lra. intros x Hx.
  rewrite (form_ext N Q _ (fun i => (1 - theta) * x i + theta * mv N (perron N A mi) x i)).
  - eapply Rle_trans; [apply form_convex; [exact sym|lra|]|].
    + apply pos. apply zero_sum_ext with (fun i => x i + (-1) * mv N (perron N A mi) x i).
      * intros; ring.
      * apply zero_sum_plus; [exact Hx|]. apply zero_sum_scal, zero_sum_perron; assumption.
    + specialize (H x Hx). unfold r. nra.
  - intros i Hi. rewrite !perron_entry by exact Hi. unfold theta. field. lra.
Qed.

Theorem lambda2_psd : lambda2_psd_statement.
Proof.
  intros N A l s HN bal [low [v [Hv [Pv Ev]]]].
  assert (Np : 0 < INR N) by (apply lt_0_INR; lia).
  assert (E : forall x, form N (fun i j => laplacian_sym N A i j - s * (id_mat i j - / INR N)) x
              = form N (laplacian_sym N A) x - s * (dot N x x - sum_lt N x ^ 2 / INR N)).
  { intros x. unfold form, dot.
    rewrite (sum_ext N _ (fun i => x i * mv N (laplacian_sym N A) x i
               - s * (x i * x i - x i * (sum_lt N x / INR N)))).
    - rewrite sum_minus, sum_scal, sum_minus, sum_scal_r.
      change (\sum_(i < N) x i) with (sum_lt N x). field. lra.
    - intros i Hi. unfold mv.
      rewrite (sum_ext N _ (fun j => laplacian_sym N A i j * x j
                 - s * (id_mat i j * x j - / INR N * x j))) by (intros; ring).
      rewrite sum_minus, sum_scal, sum_minus, id_mat_sum, sum_scal by exact Hi.
      change (\sum_(i < N) x i) with (sum_lt N x). field. lra. }
  split.
  - intros Hs x. rewrite E.
    set (m := mean N x). set (e := fun i => x i - m).
    assert (He : zero_sum N e) by (apply zero_sum_deviation; exact HN).
    assert (F : form N (laplacian_sym N A) x = form N (laplacian_sym N A) e).
    { rewrite !form_sym, !form_laplacian by exact bal. f_equal.
      apply sum_ext. intros i _. apply sum_ext. intros j _. unfold e. ring. }
    assert (Dx : dot N x x - sum_lt N x ^ 2 / INR N = dot N e e).
    { unfold dot, e.
      rewrite (sum_ext N (fun i => (x i - m) * (x i - m)) (fun i => x i * x i - 2 * m * x i + m * m))
        by (intros; ring).
      rewrite sum_plus, sum_minus, sum_scal, sum_const.
      change (\sum_(i < N) x i) with (sum_lt N x). unfold m, mean. field. lra. }
    rewrite F, Dx. assert (B := low e He). assert (P := dot_nonneg N e). nra.
  - intros H. specialize (H v). rewrite E, Ev in H. unfold zero_sum in Hv. rewrite Hv in H.
    replace (0 ^ 2 / INR N) with 0 in H by (field; lra).
    apply Rmult_le_reg_r with (dot N v v); [exact Pv|]. lra.
Qed.
