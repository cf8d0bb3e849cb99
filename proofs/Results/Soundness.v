(** The exact tests of the checker prove what they are taken to prove. *)
From Coq Require Import Reals Arith Lia Lra.
From Coquelicot Require Import Coquelicot.
From Fomas Require Import Model.Vectors Model.Kernel Model.Gamma Model.Graph Model.Loop Statements.
From Fomas Require Import Facts.Sums Facts.Vectors Facts.Graph Facts.Lambda2 Facts.Contraction Facts.Phi.
Open Scope R_scope.

(** * Positive definiteness *)

Theorem ldlt : ldlt_statement.
Proof.
  intros N Q T d HT HQ.
  assert (E : forall x, form N Q x = \sum_(k < N) (d k * (\sum_(i < N) (T i k * x i)) ^ 2)).
  { intros x. rewrite form_double_sum.
    transitivity (\sum_(i < N) \sum_(k < N) (d k * (\sum_(j < N) (T j k * x j)) * (T i k * x i))).
    - apply sum_ext. intros i Hi.
      rewrite (sum_ext N _ (fun j => \sum_(k < N) (d k * (T i k * x i) * (T j k * x j))))
        by (intros j Hj; rewrite HQ, Rmult_assoc, <- sum_scal_r by assumption;
            apply sum_ext; intros; ring).
      rewrite sum_swap. apply sum_ext. intros k _. rewrite sum_scal. ring.
    - rewrite sum_swap. apply sum_ext. intros k _. rewrite sum_scal. ring. }
  split.
  - intros Hd x Px. rewrite E.
    assert (nn : forall k, (k < N)%nat -> 0 <= d k * (\sum_(i < N) (T i k * x i)) ^ 2).
    { intros k Hk. apply Rmult_le_pos; [left; apply Hd, Hk|apply pow2_ge_0]. }
    destruct (Req_dec (\sum_(k < N) (d k * (\sum_(i < N) (T i k * x i)) ^ 2)) 0) as [Z|Z].
    2: { assert (S0 := sum_nonneg N _ nn). lra. }
    (* all T^T x vanish, so x does, from the last entry up *)
    exfalso.
    assert (Y : forall k, (k < N)%nat -> \sum_(i < N) (T i k * x i) = 0).
    { intros k Hk. assert (Zk := sum_zero_terms N _ k nn Z Hk). cbv beta in Zk.
      specialize (Hd k Hk). apply Rmult_integral in Zk. destruct Zk as [Zk|Zk]; [lra|].
      apply Rsqr_0_uniq. unfold Rsqr. simpl in Zk. lra. }
    assert (X : forall m i, (N <= i + m)%nat -> (i < N)%nat -> x i = 0).
    { induction m as [|m IH]; intros i H1 Hi; [lia|].
      specialize (Y i Hi). rewrite (sum_single N i) in Y; [|exact Hi|].
      - rewrite (proj1 (HT i i Hi Hi) eq_refl) in Y. lra.
      - intros j Hj Hne. destruct (lt_eq_lt_dec j i) as [[L|L]|L]; [|lia|].
        + rewrite (proj2 (HT j i Hj Hi) L). ring.
        + rewrite (IH j) by lia. ring. }
    unfold dot in Px. rewrite sum_zero in Px; [lra|].
    intros i Hi. rewrite (X N i) by lia. ring.
  - intros Hd x. rewrite E. apply sum_nonneg. intros k Hk.
    apply Rmult_le_pos; [apply Hd, Hk|apply pow2_ge_0].
Qed.

Theorem residual_factor : residual_factor_statement.
Proof.
  intros N n Q R E eps HQ HE Heps x.
  assert (S : form N Q x = eps * dot N x x + \sum_(k < n) ((\sum_(i < N) (R i k * x i)) ^ 2)
                           + form N E x).
  { assert (E1 : form N Q x - eps * dot N x x - form N E x
                 = \sum_(i < N) \sum_(j < N) ((\sum_(k < n) (R i k * R j k)) * x i * x j)).
    { rewrite !form_double_sum. unfold dot. rewrite <- sum_scal, <- !sum_minus.
      apply sum_ext. intros i Hi.
      replace (eps * (x i * x i)) with (\sum_(j < N) (id_mat i j * (eps * (x i * x j))))
        by (apply (id_mat_sum N i (fun j => eps * (x i * x j))); exact Hi).
      rewrite <- !sum_minus. apply sum_ext. intros j Hj.
      assert (T := HQ i j Hi Hj).
      replace (\sum_(k < n) (R i k * R j k)) with (Q i j - eps * id_mat i j - E i j) by lra.
      ring. }
    assert (E2 : \sum_(k < n) ((\sum_(i < N) (R i k * x i)) ^ 2)
                 = \sum_(i < N) \sum_(j < N) ((\sum_(k < n) (R i k * R j k)) * x i * x j)).
    { transitivity (\sum_(k < n) \sum_(i < N) (\sum_(j < N) (R j k * x j) * (R i k * x i))).
      - apply sum_ext. intros k _. rewrite sum_scal. ring.
      - rewrite sum_swap. apply sum_ext. intros i _.
        transitivity (\sum_(k < n) \sum_(j < N) (R i k * R j k * x i * x j)).
        + apply sum_ext. intros k _. rewrite <- sum_scal_r. apply sum_ext. intros; ring.
        + rewrite sum_swap. apply sum_ext. intros j _.
          rewrite Rmult_assoc, <- sum_scal_r. apply sum_ext. intros; ring. }
    lra. }
  assert (S1 : 0 <= \sum_(k < n) ((\sum_(i < N) (R i k * x i)) ^ 2))
    by (apply sum_nonneg; intros; apply pow2_ge_0).
  assert (S2 : Rabs (form N E x) <= eps * dot N x x).
  { rewrite form_double_sum.
    apply Rle_trans with (\sum_(i < N) \sum_(j < N)
                            (/ 2 * (Rabs (E i j) * (x i * x i)) + / 2 * (Rabs (E i j) * (x j * x j)))).
    - eapply Rle_trans; [apply sum_abs|]. apply sum_le. intros i _.
      eapply Rle_trans; [apply sum_abs|]. apply sum_le. intros j _.
      rewrite Rmult_assoc, Rabs_mult. assert (P := Rabs_pos (E i j)).
      assert (M : Rabs (x i * x j) <= / 2 * (x i * x i) + / 2 * (x j * x j)).
      { assert (Z1 := pow2_ge_0 (x i - x j)). assert (Z2 := pow2_ge_0 (x i + x j)).
        apply Rabs_le. split; lra. }
      nra.
    - rewrite (sum_ext N _ (fun i => \sum_(j < N) (/ 2 * (Rabs (E i j) * (x i * x i)))
                 + \sum_(j < N) (/ 2 * (Rabs (E i j) * (x j * x j)))))
        by (intros; apply sum_plus).
      rewrite sum_plus, (sum_swap N N (fun i j => / 2 * (Rabs (E i j) * (x j * x j)))).
      rewrite <- sum_plus. unfold dot. rewrite <- sum_scal. apply sum_le. intros i Hi.
      rewrite (sum_ext N (fun j => / 2 * (Rabs (E j i) * (x i * x i)))
                 (fun j => / 2 * (Rabs (E i j) * (x i * x i))))
        by (intros j Hj; rewrite (HE j i) by assumption; reflexivity).
      rewrite sum_scal, sum_scal_r. specialize (Heps i Hi).
      assert (0 <= x i * x i) by nra. nra. }
  assert (S3 := Rle_abs (- form N E x)). rewrite Rabs_Ropp in S3. lra.
Qed.

(** * Convexity *)

Lemma form_convex N Q a b theta : (forall i j, (i < N)%nat -> (j < N)%nat -> Q i j = Q j i) ->
  0 <= theta <= 1 -> 0 <= form N Q (fun i => a i - b i) ->
  form N Q (fun i => (1 - theta) * a i + theta * b i)
  <= (1 - theta) * form N Q a + theta * form N Q b.
Proof.
  intros sym Ht Hp.
  assert (X : form N Q (fun i => (1 - theta) * a i + theta * b i)
              = (1 - theta) ^ 2 * form N Q a + theta ^ 2 * form N Q b
                + 2 * ((1 - theta) * theta * dot N a (mv N Q b))).
  { rewrite (form_plus N Q (fun i => (1 - theta) * a i) (fun i => theta * b i)) by exact sym.
    rewrite !form_scal, dot_scal_l.
    rewrite (dot_ext N a (mv N Q (fun i => theta * b i)) a (fun i => theta * mv N Q b i)
               (fun _ _ => eq_refl) (fun i _ => mv_scal N Q theta b i)).
    rewrite dot_scal_r. ring. }
  assert (Y : form N Q (fun i => a i - b i)
              = form N Q a + form N Q b - 2 * dot N a (mv N Q b)).
  { rewrite (form_ext N Q _ (fun i => a i + (-1) * b i)) by (intros; ring).
    rewrite (form_plus N Q a (fun i => (-1) * b i)) by exact sym. rewrite form_scal.
    rewrite (dot_ext N a (mv N Q (fun i => (-1) * b i)) a (fun i => (-1) * mv N Q b i)
               (fun _ _ => eq_refl) (fun i _ => mv_scal N Q (-1) b i)).
    rewrite dot_scal_r. ring. }
  rewrite X. rewrite Y in Hp.
  assert (0 <= theta * (1 - theta) * (form N Q a + form N Q b - 2 * dot N a (mv N Q b)))
    by (apply Rmult_le_pos; [nra|exact Hp]).
  nra.
Qed.

Theorem convexity : convexity_statement.
Proof.
  intros N Q T1 T2 rho2 theta sym pos Ht Z1 Z2 B1 B2 T x Hx.
  rewrite (form_ext N Q (mv N T x) (fun i => (1 - theta) * mv N T1 x i + theta * mv N T2 x i)).
  - eapply Rle_trans; [apply form_convex; [exact sym|exact Ht|]|].
    + apply pos. apply zero_sum_ext with (fun i => mv N T1 x i + (-1) * mv N T2 x i).
      * intros; ring.
      * apply zero_sum_plus; [|apply zero_sum_scal]; auto.
    + specialize (B1 x Hx). specialize (B2 x Hx). nra.
  - intros i _. unfold mv, T. rewrite <- !sum_scal, <- sum_plus. apply sum_ext. intros; ring.
Qed.

Theorem convexity_in_mu : convexity_in_mu_statement.
Proof.
  intros N A Q rho2 mu1 mu2 mu bal sym pos Hmu B1 B2 x Hx.
  destruct (Req_dec mu1 mu2) as [E|NE].
  - replace mu with mu1 by lra. apply B1, Hx.
  - set (theta := (mu - mu1) / (mu2 - mu1)).
    assert (Ht : 0 <= theta <= 1).
    { unfold theta. split.
      - apply Rmult_le_pos; [lra|left; apply Rinv_0_lt_compat; lra].
      - apply Rmult_le_reg_r with (mu2 - mu1); [lra|].
        unfold Rdiv. rewrite Rmult_assoc, Rinv_l by lra. lra. }
    rewrite (form_ext N Q _ (mv N (fun i j => (1 - theta) * perron N A mu1 i j
                                              + theta * perron N A mu2 i j) x)).
    + apply (convexity N Q (perron N A mu1) (perron N A mu2) rho2 theta); try assumption;
        intros; apply zero_sum_perron; assumption.
    + intros i _. apply sum_ext. intros j _. f_equal. unfold perron, theta. field. lra.
Qed.

Theorem sigma_convex : sigma_convex_statement.
Proof.
  intros N A mu1 mu2 s1 s2 theta Ht [P1 B1] [P2 B2]. split; [nra|]. intros e He.
  rewrite (norm_ext N _ (fun i => (1 - theta) * mv N (perron N A mu1) e i
                                  + theta * mv N (perron N A mu2) e i)).
  - eapply Rle_trans; [apply norm_triangle|]. rewrite !norm_scal, !Rabs_right by lra.
    specialize (B1 e He). specialize (B2 e He). nra.
  - intros i Hi. rewrite !perron_entry by exact Hi. ring.
Qed.

(** * Lyapunov matrices *)

Lemma lyapunov_powers N (Z : vec -> Prop) (T : vec -> vec) Q lo hi rho :
  (forall x, Z x -> Z (T x)) -> 0 < lo -> 0 <= rho ->
  (forall x, Z x -> lo * dot N x x <= form N Q x <= hi * dot N x x) ->
  (forall x, Z x -> form N Q (T x) <= rho ^ 2 * form N Q x) ->
  forall n x, Z x -> norm N (iter n T x) <= sqrt (hi / lo) * rho ^ n * norm N x.
Proof.
  intros HZ Hlo Hr Hb HP n x Hx.
  assert (zs : forall n, Z (iter n T x)) by (induction n0; simpl; auto).
  assert (G : form N Q (iter n T x) <= (rho ^ n) ^ 2 * form N Q x).
  { induction n as [|n IH]; simpl iter; [simpl; lra|].
    eapply Rle_trans; [apply HP, zs|].
    replace ((rho ^ S n) ^ 2) with (rho ^ 2 * (rho ^ n) ^ 2) by (simpl; ring).
    rewrite Rmult_assoc. apply Rmult_le_compat_l; [apply pow2_ge_0|exact IH]. }
  assert (L := proj1 (Hb _ (zs n))). assert (U := proj2 (Hb x Hx)).
  assert (R0 : 0 <= rho ^ n) by (apply pow_le, Hr).
  set (y := iter n T x) in *.
  destruct (Req_dec (dot N x x) 0) as [E|E].
  - assert (L0 := proj1 (Hb x Hx)). rewrite E, Rmult_0_r in *.
    assert (dot N y y <= 0) by nra. assert (Y0 := dot_nonneg N y).
    assert (norm N y = 0) by (unfold norm; replace (dot N y y) with 0 by lra; apply sqrt_0).
    rewrite H0. apply Rmult_le_pos; [|apply norm_nonneg].
    apply Rmult_le_pos; [apply sqrt_pos|exact R0].
  - assert (X0 := dot_nonneg N x). assert (Hhi : lo <= hi).
    { assert (L0 := proj1 (Hb x Hx)). apply Rmult_le_reg_r with (dot N x x); lra. }
    assert (H0 : 0 <= hi / lo)
      by (apply Rmult_le_pos; [lra|left; apply Rinv_0_lt_compat, Hlo]).
    apply norm_le_bound.
    { apply Rmult_le_pos; [|apply norm_nonneg].
      apply Rmult_le_pos; [apply sqrt_pos|exact R0]. }
    rewrite !Rpow_mult_distr, norm_pow2.
    replace (sqrt (hi / lo) ^ 2) with (hi / lo) by (rewrite pow2_sqrt; [reflexivity|exact H0]).
    apply Rmult_le_reg_l with lo; [exact Hlo|].
    replace (lo * (hi / lo * (rho ^ n) ^ 2 * dot N x x))
      with ((rho ^ n) ^ 2 * (hi * dot N x x)) by (field; lra).
    eapply Rle_trans; [exact L|]. eapply Rle_trans; [exact G|].
    apply Rmult_le_compat_l; [apply pow2_ge_0|exact U].
Qed.

Theorem lyapunov : lyapunov_statement.
Proof.
  intros N A mu Q lo hi rho bal Hlo Hr Hb HP n x.
  apply (lyapunov_powers N (zero_sum N) (mv N (perron N A mu)) Q lo hi rho); try assumption.
  intros y. apply zero_sum_perron, bal.
Qed.

Theorem lyapunov_refutation : lyapunov_refutation_statement.
Proof.
  intros N A mu Q x bal HP Hx Neg C.
  set (y := fun k => iter k (mv N (perron N A mu)) x).
  assert (G : forall k, form N Q (y k) <= form N Q x).
  { induction k as [|k IH]; [unfold y; simpl; lra|].
    eapply Rle_trans; [apply HP, zero_sum_iter; assumption|exact IH]. }
  destruct (form_bounded N Q) as [B [B0 HB]].
  assert (L : is_lim_seq (fun k => B * dot N (y k) (y k)) 0).
  { replace (Finite 0) with (Rbar_mult B 0) by (simpl; f_equal; ring).
    apply is_lim_seq_scal_l. apply (sum_vanishes N (fun i k => y k i * y k i)). intros i Hi.
    replace (Finite 0) with (Finite (0 * 0)) by (f_equal; ring).
    apply is_lim_seq_mult'; apply C, Hi. }
  assert (T : Rbar_le (- form N Q x) 0).
  { apply (is_lim_seq_le (fun _ => - form N Q x) _ (- form N Q x) 0) with (2 := is_lim_seq_const _)
      (3 := L).
    intros k. specialize (HB (y k)). specialize (G k).
    assert (S := Rle_abs (- form N Q (y k))). rewrite Rabs_Ropp in S. lra. }
  simpl in T. lra.
Qed.

(** * The LMI, lambda2, and emptiness *)

Theorem schur_complement : schur_complement_statement.
Proof.
  intros N A mu rho bal Hr. split.
  - intros [_ H] y z Hy _. specialize (H y Hy).
    assert (C := dot_le_norm N z (mv N (perron N A mu) y)).
    rewrite <- !norm_sq. assert (Py := norm_nonneg N y). assert (Pz := norm_nonneg N z).
    assert (K : norm N z * norm N (mv N (perron N A mu) y) <= norm N z * (rho * norm N y))
      by (apply Rmult_le_compat_l; assumption).
    assert (S := Rle_abs (- dot N z (mv N (perron N A mu) y))). rewrite Rabs_Ropp in S.
    assert (Z := pow2_ge_0 (norm N y - norm N z)). nra.
  - intros H. split; [exact Hr|]. intros y Hy.
    set (w := mv N (perron N A mu) y).
    assert (Hw : zero_sum N w) by (apply zero_sum_perron; assumption).
    assert (Q : forall t, 0 <= rho * dot N y y - 2 * t * dot N w w + rho * t ^ 2 * dot N w w).
    { intros t. assert (T := H y (fun i => - t * w i) Hy (zero_sum_scal N (- t) w Hw)).
      fold w in T. rewrite !dot_scal_l, dot_scal_r in T. lra. }
    apply norm_le_bound; [apply Rmult_le_pos; [exact Hr|apply norm_nonneg]|].
    rewrite Rpow_mult_distr, norm_pow2. destruct (Req_dec rho 0) as [->|Z].
    + specialize (Q 1). lra.
    + specialize (Q (/ rho)).
      replace (rho * dot N y y - 2 * / rho * dot N w w + rho * (/ rho) ^ 2 * dot N w w)
        with (rho * dot N y y - dot N w w / rho) in Q by (field; exact Z).
      apply Rmult_le_reg_r with (/ rho); [apply Rinv_0_lt_compat; lra|].
      replace (rho ^ 2 * dot N y y * / rho) with (rho * dot N y y) by (field; exact Z).
      unfold Rdiv in Q. lra.
Qed.

Theorem rayleigh : rayleigh_statement.
Proof.
  intros N A l x t [low _] Hx Px H. specialize (low x Hx).
  apply Rmult_le_reg_r with (dot N x x); [exact Px|lra].
Qed.

Theorem hyperplane : hyperplane_statement.
Proof.
  intros N A w s l HN bal Hs H [_ [v [Hv [Pv Ev]]]].
  assert (Np : 0 < INR N) by (apply lt_0_INR; lia).
  assert (Z : forall x t, form N (laplacian_sym N A) (fun i => x i + t * ones i)
                          = form N (laplacian_sym N A) x).
  { intros x t. rewrite !form_sym, !form_laplacian by exact bal. f_equal.
    apply sum_ext. intros i _. apply sum_ext. intros j _. unfold ones. ring. }
  assert (Ones : dot N ones ones = INR N).
  { unfold dot, ones. rewrite sum_const. ring. }
  destruct (Req_dec (dot N w ones) 0) as [E|NE].
  - specialize (H ones E). rewrite Ones in H.
    assert (T := Z (fun _ => 0) 1).
    rewrite (form_ext N _ (fun i => 0 + 1 * ones i) ones) in T by (intros; ring).
    rewrite T in H. unfold form, dot in H. rewrite sum_zero in H by (intros; ring).
    assert (0 < s * INR N) by (apply Rmult_lt_0_compat; assumption). lra.
  - set (t := - (dot N w v / dot N w ones)).
    assert (H0 := H (fun i => v i + t * ones i)).
    rewrite dot_plus_r, dot_scal_r in H0.
    replace (dot N w v + t * dot N w ones) with 0 in H0 by (unfold t; field; exact NE).
    specialize (H0 eq_refl). rewrite Z, Ev in H0.
    rewrite dot_plus_l, !dot_plus_r, !dot_scal_l, !dot_scal_r, Ones in H0.
    assert (V1 : dot N v ones = 0).
    { unfold zero_sum in Hv. rewrite <- Hv. apply sum_ext. intros. unfold ones. ring. }
    rewrite (dot_comm N ones v), V1 in H0.
    apply Rmult_le_reg_r with (dot N v v); [exact Pv|].
    assert (0 <= s * (t * t * INR N)).
    { apply Rmult_le_pos; [lra|]. apply Rmult_le_pos; nra. }
    lra.
Qed.

Theorem emptiness : emptiness_statement.
Proof.
  intros N A n u v mu_max t bal Huv a b nn.
  assert (Low : forall mu s, contracts N A mu s -> a - mu * b <= s * nn).
  { intros mu s [s0 Hs]. unfold a, b, nn. rewrite <- !sum_scal, <- sum_minus. apply sum_le.
    intros i Hi. destruct (Huv i Hi) as [_ Hv]. specialize (Hs (v i) Hv).
    assert (E : dot N (u i) (v i) - mu * dot N (u i) (mv N (laplacian N A) (v i))
                = dot N (u i) (mv N (perron N A mu) (v i))).
    { rewrite <- dot_scal_r, <- dot_minus_r. apply dot_ext; [reflexivity|].
      intros j Hj. rewrite perron_entry by exact Hj. reflexivity. }
    rewrite E. assert (C := Rle_trans _ _ _ (Rle_abs _) (dot_le_norm N (u i)
      (mv N (perron N A mu) (v i)))).
    eapply Rle_trans; [exact C|]. rewrite <- !norm_sq.
    assert (Pu := norm_nonneg N (u i)). assert (Pv := norm_nonneg N (v i)).
    apply Rle_trans with (norm N (u i) * (s * norm N (v i))).
    - apply Rmult_le_compat_l; assumption.
    - assert (Z := pow2_ge_0 (norm N (u i) - norm N (v i))). nra. }
  split; [exact Low|]. intros Ha Hb mu s Hmu Hc. specialize (Low mu s Hc).
  assert (N0 : 0 <= nn).
  { apply sum_nonneg. intros i _. assert (P1 := dot_nonneg N (u i)).
    assert (P2 := dot_nonneg N (v i)). lra. }
  assert (M : t * nn < a - mu * b).
  { destruct (Rle_dec b 0) as [B|B]; nra. }
  apply Rnot_le_lt. intros L. nra.
Qed.
