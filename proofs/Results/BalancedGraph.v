(** Balanced graphs: the quadratic form, lambda2, and the contraction factor. *)
From Coq Require Import Reals Arith Lia Lra.
From Coquelicot Require Import Coquelicot.
From Fomas Require Import Model.Vectors Model.Kernel Model.Gamma Model.Graph Model.Loop Statements.
From Fomas Require Import Facts.Sums Facts.Vectors Facts.Kernel Facts.Resolvent Facts.Graph.
From Fomas Require Import Facts.Lambda2 Facts.Contraction.
Open Scope R_scope.

Theorem quadratic_form : quadratic_form_statement.
Proof.
  intros N A x bal. split; [apply form_sym|].
  rewrite form_sym. apply form_laplacian, bal.
Qed.

Theorem laplacian_norm_bound : laplacian_norm_bound_statement.
Proof.
  intros N A x dig bal. rewrite norm_pow2, form_sym. apply laplacian_norm; assumption.
Qed.

Theorem invariant_mean : invariant_mean_statement.
Proof.
  intros N A mu x bal. split; [apply zero_sum_laplacian|apply sum_perron]; exact bal.
Qed.

Theorem lambda2_exists : lambda2_exists_statement.
Proof.
  intros N A HN. split.
  - apply rayleigh_minimum; [exact HN|]. apply laplacian_sym_sym.
  - assert (le : forall s t, is_lambda2 N A s -> is_lambda2 N A t -> s <= t).
    { intros s t [Hs _] [_ [v [Hv [Pv Ev]]]]. specialize (Hs v Hv). rewrite Ev in Hs.
      apply Rmult_le_reg_r with (dot N v v); assumption. }
    intros s t Hs Ht. apply Rle_antisym; apply le; assumption.
Qed.

(** L_s maps into 1perp. *)
Lemma zero_sum_laplacian_sym N A v : balanced N A -> zero_sum N (mv N (laplacian_sym N A) v).
Proof.
  intros bal. unfold zero_sum.
  rewrite (sum_ext N _ (fun i => / 2 * (mv N (laplacian N A) v i
             + \sum_(j < N) (laplacian N A j i * v j)))).
  - rewrite sum_scal, sum_plus.
    assert (Z := zero_sum_laplacian N A bal v). unfold zero_sum in Z.
    change (\sum_(i < N) mv N (laplacian N A) v i) with (sum_lt N (mv N (laplacian N A) v)).
    rewrite Z, sum_swap, sum_zero; [ring|].
    intros j Hj. rewrite sum_scal_r.
    assert (O := laplacian_ones N A j Hj). unfold mv, ones in O.
    rewrite (sum_ext N (fun i => laplacian N A j i * 1) (laplacian N A j)) in O
      by (intros; ring).
    change (sum_lt N (fun i => laplacian N A j i)) with (sum_lt N (laplacian N A j)).
    rewrite O. ring.
  - intros i _. unfold mv. rewrite <- sum_plus, <- sum_scal. apply sum_ext.
    intros j _. unfold laplacian_sym. field.
Qed.

Theorem lambda2_eigenvalue : lambda2_eigenvalue_statement.
Proof.
  intros N A l bal [low [v [Hv [Pv Ev]]]]. split.
  - exists v. split; [exact Hv|split; [exact Pv|]].
    set (z := fun i => mv N (laplacian_sym N A) v i - l * v i).
    assert (Hz : zero_sum N z).
    { unfold zero_sum, z. rewrite sum_minus, sum_scal.
      assert (Z := zero_sum_laplacian_sym N A v bal). unfold zero_sum in Z, Hv.
      change (\sum_(i < N) mv N (laplacian_sym N A) v i)
        with (sum_lt N (mv N (laplacian_sym N A) v)).
      change (\sum_(i < N) v i) with (sum_lt N v). rewrite Z, Hv. ring. }
    (* the quotient is least at v, so its derivative along z vanishes *)
    assert (T : forall t, 0 <= 2 * t * dot N z z
                + t ^ 2 * (form N (laplacian_sym N A) z - l * dot N z z)).
    { intros t. assert (L := low (fun i => v i + t * z i)
        (zero_sum_plus N v _ Hv (zero_sum_scal N t z Hz))).
      rewrite form_plus in L by (intros; apply laplacian_sym_sym).
      rewrite form_scal, dot_plus_l, !dot_plus_r, !dot_scal_l, !dot_scal_r, Ev in L.
      rewrite (dot_comm N z v) in L.
      rewrite (dot_ext N v (mv N (laplacian_sym N A) (fun i => t * z i)) v
                 (fun i => t * mv N (laplacian_sym N A) z i)) in L
        by (intros; try apply mv_scal; reflexivity).
      rewrite dot_scal_r, (dot_mv_sym N (laplacian_sym N A) v z) in L
        by (intros; apply laplacian_sym_sym).
      assert (E : dot N z z = dot N z (mv N (laplacian_sym N A) v) - l * dot N v z).
      { unfold z at 2. rewrite dot_minus_r, dot_scal_r, (dot_comm N z v). reflexivity. }
      assert (2 * t * dot N z z = 2 * t * dot N z (mv N (laplacian_sym N A) v)
                - 2 * t * l * dot N v z) by (rewrite E; ring).
      lra. }
    assert (Z0 := dot_nonneg N z).
    set (C := form N (laplacian_sym N A) z - l * dot N z z) in T.
    assert (Z1 : dot N z z = 0).
    { destruct (Req_dec (dot N z z) 0) as [E|NE]; [exact E|exfalso].
      assert (C0 : 0 <= C) by (specialize (low z Hz); unfold C; lra).
      specialize (T (- (dot N z z / (C + dot N z z)))).
      assert (Zp : 0 < dot N z z) by lra. assert (Cp : 0 < C + dot N z z) by lra.
      replace (2 * - (dot N z z / (C + dot N z z)) * dot N z z
               + (- (dot N z z / (C + dot N z z))) ^ 2 * C)
        with (- (dot N z z ^ 2 * (C + 2 * dot N z z) / (C + dot N z z) ^ 2)) in T
        by (field; lra).
      assert (0 < dot N z z ^ 2 * (C + 2 * dot N z z) / (C + dot N z z) ^ 2); [|lra].
      apply Rdiv_lt_0_compat; [apply Rmult_lt_0_compat; [apply pow_lt|]; lra|apply pow_lt; lra]. }
    intros i Hi. assert (E := dot_zero N z Z1 i Hi). unfold z in E. lra.
  - intros w s Hw Pw Ew. specialize (low w Hw).
    unfold form in low. rewrite (dot_ext N w _ w (fun i => s * w i) (fun _ _ => eq_refl) Ew) in low.
    rewrite dot_scal_r in low. apply Rmult_le_reg_r with (dot N w w); assumption.
Qed.

Theorem lambda2_positive : lambda2_positive_statement.
Proof.
  intros N A H1. destruct (form_lower_bound N A H1) as [kappa [Hk H]]. split.
  - exists kappa. split; [exact Hk|]. intros x Hx. rewrite form_sym. apply H, Hx.
  - intros l [_ [v [Hv [Pv Ev]]]]. specialize (H v Hv). rewrite form_sym in Ev.
    rewrite Ev in H. apply Rmult_le_reg_r in H; [lra|exact Pv].
Qed.

Theorem sigma_ge_beta : sigma_ge_beta_statement.
Proof.
  intros N A mu. split; [apply sigma_exists|].
  intros l s bal [_ [v [Hv [Pv Ev]]]] [[_ Hs] _]. specialize (Hs v Hv).
  assert (F := fiedler_perron N A mu l v Ev).
  assert (C := dot_le_norm N v (mv N (perron N A mu) v)).
  rewrite F, Rabs_mult, (Rabs_right (dot N v v)), <- norm_sq in C by lra.
  assert (Np : 0 < norm N v) by (apply sqrt_lt_R0, Pv).
  apply Rmult_le_reg_r with (norm N v * norm N v); [nra|].
  eapply Rle_trans; [exact C|]. nra.
Qed.

Theorem betahat : betahat_statement.
Proof.
  intros N A mu l s dig bal Hl Hs Hm HD b2. split.
  - destruct (Rle_dec 0 b2) as [B|B].
    + assert (Hc : contracts N A mu (sqrt (Rmax 0 b2))).
      { split; [apply sqrt_pos|]. apply bounded_squared. intros e He.
        apply perron_contracts; try assumption; [lra|]. rewrite <- form_sym. apply Hl, He. }
      apply Hs in Hc. assert (S0 : 0 <= s) by apply Hs.
      assert (Q := sqrt_sqrt (Rmax 0 b2) (Rmax_l _ _)).
      rewrite (Rmax_right 0 b2) in * by exact B. nra.
    + (* impossible: it would make |P v|^2 negative at a Fiedler vector *)
      exfalso. destruct Hl as [Hl [v [Hv [Pv _]]]].
      assert (H := perron_contracts N A bal dig mu l v ltac:(lra) HD).
      rewrite <- form_sym in H. specialize (H (Hl v Hv)).
      assert (G := dot_nonneg N (mv N (perron N A mu) v)). fold b2 in H. nra.
  - intros con HD1. assert (L := proj2 (lambda2_positive N A (conj dig (conj con bal))) l Hl).
    unfold b2. assert (0 < mu * l * (1 - mu * degree_max N A)); [|lra].
    apply Rmult_lt_0_compat; [nra|lra].
Qed.
