(** Vanishing controls, average consensus and decay of P on 1perp are one claim. *)
From Coq Require Import Reals Arith Lia Lra.
From Coquelicot Require Import Coquelicot.
From Fomas Require Import Model.Vectors Model.Kernel Model.Gamma Model.Graph Model.Loop Statements.
From Fomas Require Import Facts.Sums Facts.Vectors Facts.Graph Facts.Lambda2 Facts.Contraction Facts.Loop.
From Fomas Require Import Facts.Phi Results.Perron Results.Consensus Results.Soundness.
Open Scope R_scope.

Lemma iter_sum N M k n (x : nat -> vec) i : (i < N)%nat ->
  iter k (mv N M) (fun j => \sum_(l < n) x l j) i = \sum_(l < n) iter k (mv N M) (x l) i.
Proof.
  revert i. induction k as [|k IH]; intros i Hi; simpl; [reflexivity|].
  rewrite (mv_ext N M _ (fun j => \sum_(l < n) iter k (mv N M) (x l) j)) by exact IH.
  apply mv_sum.
Qed.

Lemma iter_S (T : vec -> vec) k x : iter (S k) T x = iter k T (T x).
Proof. induction k as [|k IH]; [reflexivity|]. simpl in *. rewrite IH. reflexivity. Qed.

(** The vectors e_j - e_{N-1} span 1perp. *)
Definition difference (n j : nat) : vec := fun i => id_mat j i - id_mat n i.

Lemma difference_zero_sum n j : (j < n)%nat -> zero_sum (S n) (difference n j).
Proof.
  intros Hj. unfold zero_sum, difference. rewrite sum_minus.
  assert (E : forall l, (l < S n)%nat -> \sum_(i < S n) id_mat l i = 1).
  { intros l Hl. rewrite (sum_ext _ _ (fun i => id_mat l i * 1)) by (intros; ring).
    apply (id_mat_sum (S n) l (fun _ => 1) Hl). }
  change (sum_lt (S n) (id_mat j)) with (\sum_(i < S n) id_mat j i).
  change (sum_lt (S n) (id_mat n)) with (\sum_(i < S n) id_mat n i).
  rewrite !E by lia. ring.
Qed.

Lemma difference_span n x i : zero_sum (S n) x -> (i < S n)%nat ->
  x i = \sum_(j < n) (x j * difference n j i).
Proof.
  intros Hx Hi. unfold zero_sum in Hx. rewrite sum_last in Hx. unfold difference, id_mat.
  destruct (Nat.eq_dec i n) as [->|Hn].
  - rewrite Nat.eqb_refl.
    rewrite (sum_ext n _ (fun j => - x j)).
    + rewrite sum_opp. change (\sum_(i < n) x i) with (sum_lt n x). lra.
    + intros j Hj. destruct (Nat.eqb_spec j n); [lia|ring].
  - rewrite (sum_single n i); [|lia|].
    + rewrite Nat.eqb_refl. destruct (Nat.eqb_spec n i); [lia|ring].
    + intros j Hj Hne. destruct (Nat.eqb_spec j i); [lia|].
      destruct (Nat.eqb_spec n i); [lia|ring].
Qed.

(** Powers that vanish on a subspace Z with spanning vectors b_j decay geometrically there. *)
Lemma geometric_decay N M (Z : vec -> Prop) n (b : nat -> vec) : (n <= N)%nat ->
  (forall j, (j < n)%nat -> Z (b j)) -> (forall x, Z x -> Z (mv N M x)) ->
  (forall x, Z x -> forall i, (i < N)%nat -> x i = \sum_(j < n) (x j * b j i)) ->
  (forall j, (j < n)%nat -> forall i, (i < N)%nat ->
     is_lim_seq (fun k => iter k (mv N M) (b j) i) 0) ->
  exists C rho, 0 <= C /\ 0 <= rho < 1 /\
  forall k x, Z x -> norm N (iter k (mv N M) x) <= C * rho ^ k * norm N x.
Proof.
  intros HN Zb ZM span V. set (P := mv N M) in *.
  set (B := fun k => \sum_(j < n) norm N (iter k P (b j))).
  assert (bound : forall k x, Z x -> norm N (iter k P x) <= B k * norm N x).
  { intros k x Hx. unfold P.
    rewrite (norm_ext N _ (fun i => \sum_(j < n) (x j * iter k P (b j) i))).
    - eapply Rle_trans; [apply norm_combination|]. unfold B. rewrite <- sum_scal_r.
      apply sum_le. intros j Hj. rewrite Rmult_comm.
      apply Rmult_le_compat_l; [apply norm_nonneg|apply entry_le_norm; lia].
    - intros i Hi.
      rewrite (iter_mv_ext N _ k x (fun i => \sum_(j < n) (x j * b j i)))
        by (try exact Hi; apply span, Hx).
      rewrite (iter_sum N _ k n (fun j i => x j * b j i)) by exact Hi.
      apply sum_ext. intros j _. apply iter_scal, Hi. }
  assert (L : is_lim_seq B 0).
  { apply (sum_vanishes n (fun j k => norm N (iter k P (b j)))). intros j Hj.
    apply norm_vanishes. apply V, Hj. }
  apply is_lim_seq_spec in L. destruct (L (mkposreal (/ 2) ltac:(lra))) as [m0 Hm]. simpl in Hm.
  set (m := S m0). assert (Hm1 : B m <= / 2).
  { specialize (Hm m ltac:(unfold m; lia)). rewrite Rminus_0_r in Hm.
    apply Rabs_def2 in Hm. lra. }
  destruct (mv_bounded N M) as [s0 [_ Hs0]].
  set (s := Rmax 1 s0). assert (s1 : 1 <= s) by apply Rmax_l.
  assert (Hs : forall x, norm N (P x) <= s * norm N x).
  { intros x. eapply Rle_trans; [apply Hs0|].
    apply Rmult_le_compat_r; [apply norm_nonneg|apply Rmax_r]. }
  assert (zs : forall k x, Z x -> Z (iter k P x)) by (induction k; simpl; auto).
  assert (Hr : forall r x, norm N (iter r P x) <= s ^ r * norm N x).
  { induction r as [|r IH]; intros x; simpl; [lra|]. rewrite Rmult_assoc.
    eapply Rle_trans; [apply Hs|]. apply Rmult_le_compat_l; [lra|apply IH]. }
  assert (Hq : forall q x, Z x -> norm N (iter (q * m) P x) <= (/ 2) ^ q * norm N x).
  { induction q as [|q IH]; intros x Hx; [simpl; lra|].
    replace (S q * m)%nat with (m + q * m)%nat by lia. rewrite iter_plus. simpl pow.
    rewrite Rmult_assoc. eapply Rle_trans; [apply bound, zs, Hx|].
    assert (T := IH x Hx). assert (Y := norm_nonneg N (iter (q * m) P x)).
    eapply Rle_trans; [apply Rmult_le_compat_r; [exact Y|exact Hm1]|].
    apply Rmult_le_compat_l; lra. }
  set (rho := Rpower (/ 2) (/ INR m)).
  assert (Pm : 0 < INR m) by (apply lt_0_INR; unfold m; lia).
  assert (R0 : 0 < rho) by apply exp_pos.
  assert (Rm : rho ^ m = / 2).
  { rewrite <- Rpower_pow by exact R0. unfold rho. rewrite Rpower_mult, Rinv_l by lra.
    apply Rpower_1. lra. }
  assert (R1 : rho < 1).
  { apply Rnot_le_lt. intros C. assert (T := pow_R1_Rle rho m C). lra. }
  exists (2 * s ^ m), rho. split; [assert (T := pow_R1_Rle s m s1); lra|]. split; [lra|].
  intros k x Hx. assert (Dm := Nat.div_mod k m ltac:(unfold m; lia)).
  assert (Dr := Nat.mod_upper_bound k m ltac:(unfold m; lia)).
  set (q := (k / m)%nat) in *. set (r := (k mod m)%nat) in *.
  replace k with (r + q * m)%nat at 1 by lia. rewrite iter_plus.
  eapply Rle_trans; [apply Hr|].
  assert (T := Hq q x Hx). assert (X0 := norm_nonneg N x).
  apply Rle_trans with (s ^ m * ((/ 2) ^ q * norm N x)).
  - apply Rmult_le_compat; [apply pow_le; lra|apply norm_nonneg| |exact T].
    apply Rle_pow; [exact s1|lia].
  - (* (1/2)^q = rho^(m q), and m q >= k - m *)
    assert (E : (/ 2) ^ q <= 2 * rho ^ k).
    { rewrite Dm, pow_add, pow_mult, Rm.
      assert (W : / 2 <= rho ^ r).
      { rewrite <- Rm. replace m with (r + (m - r))%nat by lia. rewrite pow_add.
        rewrite <- (Rmult_1_r (rho ^ r)) at 2. apply Rmult_le_compat_l; [apply pow_le; lra|].
        rewrite <- (pow1 (m - r)). apply pow_incr. lra. }
      assert (Q0 : 0 <= (/ 2) ^ q) by (apply pow_le; lra). nra. }
    assert (S0 : 0 <= s ^ m) by (apply pow_le; lra).
    replace (2 * s ^ m * rho ^ k * norm N x) with (s ^ m * (2 * rho ^ k * norm N x)) by ring.
    apply Rmult_le_compat_l; [exact S0|]. apply Rmult_le_compat_r; assumption.
Qed.

Theorem decay_from_vanishing : decay_from_vanishing_statement.
Proof.
  intros N A mu HN bal V. destruct N as [|n]; [lia|].
  apply (geometric_decay (S n) _ (zero_sum (S n)) n (difference n)).
  - lia.
  - apply difference_zero_sum.
  - intros x. apply zero_sum_perron, bal.
  - intros x Hx i. apply difference_span, Hx.
  - intros j Hj. apply V, difference_zero_sum, Hj.
Qed.

Theorem claims_equivalent : claims_equivalent_statement.
Proof.
  intros N A alpha gamma h HN H1 D mu. assert (bal : balanced N A) by apply H1.
  assert (from : vanishes_on_1perp N A mu -> forall x0 x u,
    closed_loop N A alpha gamma h x0 x u ->
    (forall i, (i < N)%nat -> is_lim_seq (fun k => u k i) 0) /\
    (forall i, (i < N)%nat -> is_lim (fun t => x t i) p_infty (mean N x0))).
  { intros V x0 x u H.
    destruct (decay_from_vanishing N A mu ltac:(lia) bal V) as [C [rho [HC [Hr Hd]]]].
    apply (consensus_from_decay N A alpha gamma h C rho ltac:(lia) bal D HC Hr Hd x0 x u H). }
  split; split.
  - intros U v Hv.
    assert (HL := exact_loop N A alpha gamma h v D).
    assert (Z := control_vanishes_converse N A alpha gamma h v _ _ D HL (U v _ _ HL)).
    destruct (form_lower_bound N A H1) as [kappa [Hk Hf]].
    assert (G := proj1 (proj2 D)).
    intros i Hi.
    (* |y| <= |L y| / kappa on 1perp, and gamma L P^k v vanishes *)
    apply dominated_vanishes with (c := / kappa)
      (b := fun k => norm N (mv N (laplacian N A) (iter k (mv N (perron N A mu)) v))).
    + intros k. set (y := iter k (mv N (perron N A mu)) v).
      assert (Hy : zero_sum N y) by (apply zero_sum_iter; assumption).
      eapply Rle_trans; [apply (entry_le_norm N y i Hi)|].
      assert (F := Hf y Hy). rewrite <- norm_sq in F.
      assert (C := Rle_trans _ _ _ (Rle_abs _) (dot_le_norm N y (mv N (laplacian N A) y))).
      unfold form in F. assert (Y0 := norm_nonneg N y).
      destruct (Req_dec (norm N y) 0) as [E|E].
      * rewrite E. apply Rmult_le_pos; [left; apply Rinv_0_lt_compat, Hk|apply norm_nonneg].
      * apply Rmult_le_reg_l with (kappa * norm N y); [apply Rmult_lt_0_compat; lra|].
        replace (kappa * norm N y * (/ kappa * norm N (mv N (laplacian N A) y)))
          with (norm N y * norm N (mv N (laplacian N A) y)) by (field; lra). lra.
    + apply (norm_vanishes N (fun k => mv N (laplacian N A) (iter k (mv N (perron N A mu)) v))).
      intros j Hj. apply dominated_vanishes with (c := / gamma)
        (b := fun k => Rabs (iter k (mv N (perron N A mu))
                               (exact_control N A alpha gamma h v 0) j)).
      * intros k.
        rewrite (iter_mv_ext N _ k (exact_control N A alpha gamma h v 0)
                   (fun j => - gamma * mv N (laplacian N A) v j))
          by (try exact Hj; apply (loop_u0 N A alpha gamma h v D _ _ HL)).
        rewrite iter_scal by exact Hj. rewrite laplacian_iter by exact Hj.
        rewrite Rabs_mult, Rabs_Ropp, (Rabs_right gamma) by lra. right. field. lra.
      * apply (is_lim_seq_abs_0 (fun k => iter k (mv N (perron N A mu))
                                  (exact_control N A alpha gamma h v 0) j)). apply Z, Hj.
  - intros V x0 x u H. apply (from V x0 x u H).
  - intros X v Hv i Hi.
    assert (HL := exact_loop N A alpha gamma h v D). specialize (X v _ _ HL i Hi).
    assert (M0 : mean N v = 0).
    { unfold mean. unfold zero_sum in Hv. rewrite Hv. unfold Rdiv. ring. }
    rewrite M0 in X. destruct D as [Ha [Hg Hh]].
    apply is_lim_seq_ext with (fun k => exact_state N A alpha gamma h v (INR k * h) i).
    { intros k. apply (exact_sample N A alpha gamma h v (conj Ha (conj Hg Hh)) k i Hi). }
    apply (is_lim_comp_seq (fun t => exact_state N A alpha gamma h v t i) (fun k => INR k * h)
             p_infty 0 X); [exists 0%nat; discriminate|].
    evar_last; [apply is_lim_seq_scal_r, is_lim_seq_INR|].
    simpl. destruct (Rle_dec 0 h) as [Q|Q]; [|lra].
    destruct (Rle_lt_or_eq_dec 0 h Q); [reflexivity|lra].
  - intros V x0 x u H. apply (from V x0 x u H).
Qed.

(** Where the powers decay on both parts of an eigenvector, the modulus is at most their rate. *)
Lemma modulus_from_decay N M C rho a b x y : 0 <= C -> 0 <= rho -> let P := mv N M in
  (forall n, norm N (iter n P x) <= C * rho ^ n * norm N x) ->
  (forall n, norm N (iter n P y) <= C * rho ^ n * norm N y) ->
  0 < dot N x x + dot N y y ->
  (forall i, (i < N)%nat -> P x i = a * x i - b * y i) ->
  (forall i, (i < N)%nat -> P y i = b * x i + a * y i) -> a ^ 2 + b ^ 2 <= rho ^ 2.
Proof.
  intros HC Hr P Dx Dy Pxy Ex Ey.
  set (S2 := dot N x x + dot N y y) in *. set (m := a ^ 2 + b ^ 2).
  assert (E : forall n, dot N (iter n P x) (iter n P x) + dot N (iter n P y) (iter n P y)
                        = m ^ n * S2).
  { induction n as [|n IH]; [simpl; unfold S2; ring|]. rewrite !iter_S.
    assert (Fx : forall i, (i < N)%nat -> iter n P (P x) i = a * iter n P x i - b * iter n P y i).
    { intros i Hi. unfold P at 1.
      rewrite (iter_mv_ext N _ n (P x) (fun j => a * x j - b * y j) Ex i Hi).
      rewrite (iter_minus N _ n (fun j => a * x j) (fun j => b * y j)) by exact Hi.
      rewrite !iter_scal by exact Hi. reflexivity. }
    assert (Fy : forall i, (i < N)%nat ->
              iter n P (P y) i = b * iter n P x i - (- a) * iter n P y i).
    { intros i Hi. unfold P at 1.
      rewrite (iter_mv_ext N _ n (P y) (fun j => b * x j - (- a) * y j))
        by (try exact Hi; intros j Hj; rewrite (Ey j Hj); ring).
      rewrite (iter_minus N _ n (fun j => b * x j) (fun j => (- a) * y j)) by exact Hi.
      rewrite !iter_scal by exact Hi. reflexivity. }
    rewrite (dot_ext N _ _ _ _ Fx Fx), (dot_ext N _ _ _ _ Fy Fy).
    rewrite !dot_minus_l, !dot_minus_r, !dot_scal_l, !dot_scal_r.
    rewrite (dot_comm N (iter n P y) (iter n P x)). simpl pow. rewrite Rmult_assoc, <- IH.
    unfold m. ring. }
  assert (U : forall n, m ^ n <= C ^ 2 * (rho ^ 2) ^ n).
  { intros n. apply Rmult_le_reg_r with S2; [exact Pxy|]. rewrite <- E.
    assert (Q : forall z, norm N (iter n P z) <= C * rho ^ n * norm N z ->
              dot N (iter n P z) (iter n P z) <= C ^ 2 * (rho ^ 2) ^ n * dot N z z).
    { intros z T. rewrite <- !norm_sq.
      replace (C ^ 2 * (rho ^ 2) ^ n * (norm N z * norm N z))
        with ((C * rho ^ n * norm N z) * (C * rho ^ n * norm N z))
        by (rewrite <- pow_mult, (Nat.mul_comm 2 n), pow_mult; ring).
      apply Rmult_le_compat; try apply norm_nonneg; exact T. }
    assert (Qx := Q x (Dx n)). assert (Qy := Q y (Dy n)). unfold S2. lra. }
  (* powers of m cannot outgrow those of rho^2 *)
  fold m. apply Rnot_lt_le. intros L. assert (r2 := pow2_ge_0 rho).
  destruct (Req_dec (rho ^ 2) 0) as [Z|Z].
  - specialize (U 1%nat). rewrite Z in U, L. simpl in U. lra.
  - set (p := m / rho ^ 2 - 1).
    assert (Pp : 0 < p).
    { unfold p. assert (1 < m / rho ^ 2); [|lra]. apply Rmult_lt_reg_r with (rho ^ 2); [lra|].
      unfold Rdiv. rewrite Rmult_assoc, Rinv_l by exact Z. lra. }
    destruct (nfloor_ex (C ^ 2 / p)) as [n [_ Hn]].
    { apply Rmult_le_pos; [apply pow2_ge_0|left; apply Rinv_0_lt_compat, Pp]. }
    assert (T := poly (S n) p Pp).
    replace (1 + p) with (m / rho ^ 2) in T by (unfold p; ring).
    specialize (U (S n)). unfold Rdiv in T. rewrite Rpow_mult_distr, pow_inv in T.
    assert (Q0 : 0 < (rho ^ 2) ^ S n) by (apply pow_lt; lra).
    assert (W : m ^ S n * / (rho ^ 2) ^ S n <= C ^ 2).
    { apply Rmult_le_reg_r with ((rho ^ 2) ^ S n); [exact Q0|].
      rewrite Rmult_assoc, Rinv_l by lra. lra. }
    rewrite S_INR in T.
    assert (C ^ 2 < (INR n + 1) * p).
    { apply Rmult_lt_reg_r with (/ p); [apply Rinv_0_lt_compat, Pp|].
      rewrite Rmult_assoc, Rinv_r by lra. unfold Rdiv in Hn. lra. }
    lra.
Qed.

Theorem eigenvalues_from_decay : eigenvalues_from_decay_statement.
Proof.
  intros N A mu C rho a b x y bal HC Hr P Hd Pxy Ex Ey Hne.
  destruct (eigenvector_zero_sum N A mu a b x y bal Ex Ey Hne) as [Zx Zy].
  apply (modulus_from_decay N (perron N A mu) C rho a b x y); try assumption;
    intros n; apply Hd; assumption.
Qed.
