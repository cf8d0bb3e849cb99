(** The eigenvalues of P decide whether its powers decay, so perron-eigenvalues is no more than
    the claims on controls and on consensus. *)
From Coq Require Import Reals Arith Lia Lra.
From Coquelicot Require Import Coquelicot.
From Fomas Require Import Model.Vectors Model.Kernel Model.Graph Model.Loop Model.Coordinates Statements.
From Fomas Require Import Facts.Sums Facts.Vectors Facts.Graph Facts.Kernel Facts.Resolvent Facts.Phi
  Facts.Spectrum.
From Fomas Require Import Results.Telescoping Results.ClosedLoop Results.BalancedGraph Results.NormBound Results.Consensus Results.Equivalence Results.Coordinates Results.Stability.
Open Scope R_scope.

(** The unit vectors span R^n. *)
Lemma vanishing_decay n M : (forall y i, (i < n)%nat -> is_lim_seq (fun k => iter k (mv n M) y i) 0) ->
  powers_decay n (mv n M).
Proof.
  intros V.
  destruct (geometric_decay n M (fun _ => True) n id_mat) as [C [rho [HC [Hr Hd]]]]; auto.
  - intros x _ i Hi. rewrite <- (id_mat_sum n i x Hi) at 1. apply sum_ext. intros j _.
    unfold id_mat. rewrite Nat.eqb_sym. ring.
  - exists C, rho. auto.
Qed.

Definition lift (n : nat) (y : vec) : vec := fun j => if Nat.eqb j n then 0 else y j.

Lemma lift_differences n y i : (i < n)%nat -> differences n (lift n y) i = y i.
Proof.
  intros Hi. unfold differences, lift. rewrite Nat.eqb_refl. destruct (Nat.eqb_spec i n); [lia|ring].
Qed.

Section Lifted.
Variables (n : nat) (A : mat) (mu : R).
Local Notation P := (mv (S n) (perron (S n) A mu)).
Local Notation Pc := (mv n (differences_step n A mu)).
Hypothesis spectrum : perron_spectrum (S n) A mu.

Lemma perron_shift x c i : (i < S n)%nat -> P (fun j => x j + c) i = P x i + c.
Proof.
  intros Hi. assert (E := proj1 spectrum i Hi). fold (mv (S n) (perron (S n) A mu)) in E.
  rewrite (mv_ext (S n) _ _ (fun j => x j + c * ones j)) by (intros; unfold ones; ring).
  rewrite mv_plus, mv_scal, E. ring.
Qed.

(** What agrees on all differences differs by a constant. *)
Lemma differences_constant x z : (forall i, (i < n)%nat -> differences n x i = differences n z i) ->
  forall i, (i < S n)%nat -> x i = z i + (x n - z n).
Proof.
  intros H i Hi. destruct (Nat.eq_dec i n) as [->|Ne]; [ring|].
  specialize (H i ltac:(lia)). unfold differences in H. lra.
Qed.

Lemma fixed_differences y : (forall i, (i < n)%nat -> Pc y i = y i) ->
  forall i, (i < n)%nat -> y i = 0.
Proof.
  intros F. set (x := lift n y).
  assert (E : forall i, (i < S n)%nat -> P x i = x i + (P x n - x n)).
  { apply differences_constant. intros i Hi. rewrite (proj2 (differences_evolve n A mu x i Hi)).
    unfold x at 2. rewrite lift_differences, <- (F i Hi) by exact Hi. apply mv_ext. intros j Hj.
    apply lift_differences, Hj. }
  assert (C : forall i, (i < S n)%nat -> x i = x 0%nat).
  { apply (proj1 (proj2 spectrum) x). intros i Hi.
    fold (mv (S n) (perron (S n) A mu)). rewrite (mv_ext (S n) _ (P x) _ i E), perron_shift by exact Hi.
    rewrite !(E i Hi). ring. }
  intros i Hi. rewrite <- (lift_differences n y i Hi). unfold differences. fold x.
  rewrite (C i), (C n) by lia. ring.
Qed.

Lemma eigenvalues_of_differences a b y z : 0 < dot n y y + dot n z z ->
  (forall i, (i < n)%nat -> Pc y i = a * y i - b * z i) ->
  (forall i, (i < n)%nat -> Pc z i = b * y i + a * z i) -> a ^ 2 + b ^ 2 < 1.
Proof.
  intros Pyz Ey Ez. destruct (Req_dec ((1 - a) ^ 2 + b ^ 2) 0) as [D|D].
  - exfalso. assert (Q1 := pow2_ge_0 (1 - a)). assert (Q2 := pow2_ge_0 b).
    assert (a = 1 /\ b = 0) as [-> ->] by (split; nra).
    assert (Y := fixed_differences y ltac:(intros i Hi; rewrite Ey by exact Hi; ring)).
    assert (Z := fixed_differences z ltac:(intros i Hi; rewrite Ez by exact Hi; ring)).
    unfold dot in Pyz. rewrite !sum_zero in Pyz; [lra| |]; intros i Hi; [rewrite Z|rewrite Y]; auto; ring.
  - set (x1 := lift n y). set (x2 := lift n z).
    set (w1 := fun i => a * x1 i - b * x2 i). set (w2 := fun i => b * x1 i + a * x2 i).
    set (c1 := P x1 n - w1 n). set (c2 := P x2 n - w2 n).
    assert (E1 : forall i, (i < S n)%nat -> P x1 i = w1 i + c1).
    { apply differences_constant. intros i Hi. rewrite (proj2 (differences_evolve n A mu x1 i Hi)).
      replace (differences n w1 i) with (a * differences n x1 i - b * differences n x2 i)
        by (unfold differences, w1; ring).
      unfold x1 at 2, x2. rewrite !lift_differences, <- (Ey i Hi) by exact Hi. apply mv_ext.
      intros j Hj. apply lift_differences, Hj. }
    assert (E2 : forall i, (i < S n)%nat -> P x2 i = w2 i + c2).
    { apply differences_constant. intros i Hi. rewrite (proj2 (differences_evolve n A mu x2 i Hi)).
      replace (differences n w2 i) with (b * differences n x1 i + a * differences n x2 i)
        by (unfold differences, w2; ring).
      unfold x1, x2 at 2. rewrite !lift_differences, <- (Ez i Hi) by exact Hi. apply mv_ext.
      intros j Hj. apply lift_differences, Hj. }
    set (D0 := (1 - a) ^ 2 + b ^ 2) in *.
    set (d1 := (- (1 - a) * c1 + b * c2) / D0). set (d2 := (- (1 - a) * c2 - b * c1) / D0).
    apply (proj2 (proj2 spectrum) a b (fun j => x1 j + d1) (fun j => x2 j + d2)).
    + assert (X0 := dot_nonneg (S n) (fun j => x1 j + d1)).
      assert (Y0 := dot_nonneg (S n) (fun j => x2 j + d2)).
      destruct (Req_dec (dot (S n) (fun j => x1 j + d1) (fun j => x1 j + d1)
                         + dot (S n) (fun j => x2 j + d2) (fun j => x2 j + d2)) 0) as [Z|Z]; [|lra].
      exfalso. assert (Z1 := dot_zero (S n) (fun j => x1 j + d1) ltac:(lra)).
      assert (Z2 := dot_zero (S n) (fun j => x2 j + d2) ltac:(lra)).
      unfold dot in Pyz. rewrite !sum_zero in Pyz; [lra| |]; intros i Hi.
      * rewrite <- (lift_differences n z i Hi). unfold differences. fold x2.
        assert (A1 := Z2 i ltac:(lia)). assert (A2 := Z2 n ltac:(lia)). simpl in A1, A2.
        replace (x2 i) with (x2 n) by lra. ring.
      * rewrite <- (lift_differences n y i Hi). unfold differences. fold x1.
        assert (A1 := Z1 i ltac:(lia)). assert (A2 := Z1 n ltac:(lia)). simpl in A1, A2.
        replace (x1 i) with (x1 n) by lra. ring.
    + intros i Hi. fold (mv (S n) (perron (S n) A mu)). rewrite perron_shift, E1 by exact Hi.
      unfold w1, d1, d2. unfold D0. field. exact D.
    + intros i Hi. fold (mv (S n) (perron (S n) A mu)). rewrite perron_shift, E2 by exact Hi.
      unfold w2, d1, d2. unfold D0. field. exact D.
    + intros [-> ->]. apply D. unfold D0. ring.
Qed.

Lemma spectrum_decay : powers_decay n Pc.
Proof.
  apply vanishing_decay. intros y i Hi.
  apply (eigenvalues_inside_vanish n (differences_step n A mu) eigenvalues_of_differences), Hi.
Qed.
End Lifted.

Theorem eigenvalues_decide : eigenvalues_decide_statement.
Proof.
  intros n A mu. assert (E : perron_spectrum (S n) A mu <-> powers_decay n (mv n (differences_step n A mu)))
    by (split; [apply spectrum_decay|apply decay_spectrum]).
  split; [exact E|]. intros bal. rewrite E. split.
  - intros D. destruct (decay_1perp n A mu bal D) as [C [rho [HC [Hr Hd]]]]. intros v Hv i Hi.
    apply dominated_vanishes with (b := fun k => rho ^ k) (c := C * norm (S n) v).
    + intros k. eapply Rle_trans; [apply entry_le_norm, Hi|]. eapply Rle_trans; [apply Hd, Hv|].
      right. ring.
    + apply is_lim_seq_geom. rewrite Rabs_right; lra.
  - intros V. apply vanishing_decay. intros y i Hi. set (x := lift n y).
    set (v := fun j => x j - mean (S n) x).
    assert (Hv : zero_sum (S n) v) by (apply zero_sum_deviation; lia).
    apply is_lim_seq_ext with (fun k => differences n (iter k (mv (S n) (perron (S n) A mu)) v) i).
    + intros k. rewrite differences_iter by exact Hi. apply iter_mv_ext; [|exact Hi].
      intros j Hj. rewrite <- (lift_differences n y j Hj). unfold differences, v, x. ring.
    + replace (Finite 0) with (Finite (0 - 0)) by (f_equal; ring).
      apply is_lim_seq_minus'; apply V; auto; lia.
Qed.

Theorem claims_are_one : claims_are_one_statement.
Proof.
  intros N A alpha gamma h HN H1 D mu. destruct N as [|n]; [lia|].
  destruct (claims_equivalent (S n) A alpha gamma h HN H1 D) as [U X]. fold mu in U, X.
  assert (E := proj2 (eigenvalues_decide n A mu) (proj2 (proj2 H1))).
  split; rewrite E; symmetry; assumption.
Qed.

(** P = I - mu L: an eigenvalue p + q i of L is the eigenvalue 1 - mu (p + q i) of P. *)
Theorem stability_limit : stability_limit_statement.
Proof.
  intros N A mu Hmu L. set (P := mv N (perron N A mu)).
  assert (PL : forall x i, (i < N)%nat -> P x i = x i - mu * L x i)
    by (intros x i Hi; apply perron_entry, Hi).
  assert (PP : forall x i, (i < N)%nat -> P (P x) i - 2 * P x i + x i = mu * mu * L (L x) i).
  { intros x i Hi. rewrite (PL (P x)) by exact Hi. unfold L at 1.
    rewrite (mv_ext N _ (P x) (fun j => x j - mu * L x j)) by (intros; apply PL; assumption).
    rewrite mv_minus, mv_scal, PL by exact Hi. fold L. ring. }
  unfold perron_spectrum. fold P. split.
  - intros [_ [simple others]]. split.
    + intros x Hx. apply simple. intros i Hi. rewrite PP, Hx by exact Hi. ring.
    + intros p q x y Hxy Ex Ey Hne.
      assert (B := others (1 - mu * p) (- (mu * q)) x y Hxy).
      assert (W : (1 - mu * p) ^ 2 + (- (mu * q)) ^ 2 < 1).
      { apply B.
        - intros i Hi. rewrite PL, Ex by exact Hi. ring.
        - intros i Hi. rewrite PL, Ey by exact Hi. ring.
        - intros [E1 E2]. apply Hne. split; apply Rmult_eq_reg_l with mu; lra. }
      apply Rmult_lt_reg_l with mu; [exact Hmu|]. lra.
  - intros [simple others]. split; [|split].
    + intros i Hi. rewrite PL by exact Hi. unfold L. rewrite laplacian_ones by exact Hi.
      unfold ones. ring.
    + intros x Hx. apply simple. intros i Hi. specialize (Hx i Hi). rewrite PP in Hx by exact Hi.
      apply Rmult_eq_reg_l with (mu * mu); [lra|nra].
    + intros a b x y Hxy Ex Ey Hne.
      assert (B := others ((1 - a) / mu) (- b / mu) x y Hxy).
      assert (W : mu * (((1 - a) / mu) ^ 2 + (- b / mu) ^ 2) < 2 * ((1 - a) / mu)).
      { apply B.
        - intros i Hi. specialize (Ex i Hi). rewrite PL in Ex by exact Hi.
          apply Rmult_eq_reg_l with mu; [|lra]. field_simplify; lra.
        - intros i Hi. specialize (Ey i Hi). rewrite PL in Ey by exact Hi.
          apply Rmult_eq_reg_l with mu; [|lra]. field_simplify; lra.
        - intros [E1 E2]. apply Hne. split.
          + apply Rmult_eq_compat_r with (r := mu) in E1. field_simplify in E1; lra.
          + apply Rmult_eq_compat_r with (r := mu) in E2. field_simplify in E2; lra. }
      apply Rmult_lt_compat_l with (r := mu) in W; [|exact Hmu].
      replace (mu * (mu * (((1 - a) / mu) ^ 2 + (- b / mu) ^ 2))) with ((1 - a) ^ 2 + b ^ 2) in W
        by (field; lra).
      replace (mu * (2 * ((1 - a) / mu))) with (2 * (1 - a)) in W by (field; lra). lra.
Qed.

(** * eqL3 *)

Lemma simple_zero N A x : (1 <= N)%nat -> assumption1 N A ->
  (forall i, (i < N)%nat -> mv N (laplacian N A) (mv N (laplacian N A) x) i = 0) ->
  forall i, (i < N)%nat -> x i = x 0%nat.
Proof.
  intros HN H1 Hx. assert (bal : balanced N A) by apply H1.
  destruct (lambda2_positive N A H1) as [[kappa [Pk K]] _].
  assert (vanish : forall y, zero_sum N y -> (forall i, (i < N)%nat -> mv N (laplacian N A) y i = 0) ->
            forall i, (i < N)%nat -> y i = 0).
  { intros y Hy E. apply dot_zero. specialize (K y Hy). rewrite form_sym in K.
    assert (Z : dot N y (mv N (laplacian N A) y) = 0).
    { apply sum_zero. intros i Hi. rewrite E by exact Hi. ring. }
    assert (D0 := dot_nonneg N y). unfold form in K. nra. }
  assert (E : forall i, (i < N)%nat -> mv N (laplacian N A) x i = 0)
    by (apply vanish; [apply zero_sum_laplacian, bal|exact Hx]).
  assert (V : forall i, (i < N)%nat -> x i - mean N x = 0).
  { apply vanish; [apply zero_sum_deviation, HN|]. intros i Hi.
    rewrite mv_minus, E by exact Hi.
    rewrite (mv_ext N _ (fun _ => mean N x) (fun j => mean N x * ones j)) by (intros; unfold ones; ring).
    rewrite mv_scal, laplacian_ones by exact Hi. ring. }
  intros i Hi. assert (V0 := V 0%nat ltac:(lia)). specialize (V i Hi). lra.
Qed.

(** Every ||Phi_k|| <= 1 gives ||P^k|| <= 2, by P^k = Phi_k - sum |f(l)| Phi_{k-l}. *)
Lemma bounded_powers N A alpha mu : 0 < alpha < 1 ->
  (forall k, bounded_on_1perp N (Phi alpha N (perron N A mu) k) 1) ->
  decays_on_1perp N (mv N (perron N A mu)) 2 1.
Proof.
  intros Ha H k e He. rewrite pow1, Rmult_1_r. set (P := perron N A mu).
  set (w := fun i => \sum_(l < k) (Rabs (fk alpha (S l)) * Phi alpha N P (k - S l) e i)).
  rewrite (norm_ext N _ (fun i => Phi alpha N P k e i + (-1) * w i)).
  2: { intros i Hi. rewrite (proj2 (phi_recursion N P alpha e k i Ha Hi)). unfold w. ring. }
  eapply Rle_trans; [apply norm_triangle|]. rewrite norm_scal, (Rabs_left (-1)) by lra.
  assert (B := H k e He). fold P in B.
  assert (Wn : norm N w <= norm N e).
  { unfold w. eapply Rle_trans; [apply norm_combination|].
    apply Rle_trans with (\sum_(l < k) (Rabs (fk alpha (S l)) * norm N e)).
    - apply sum_le. intros l _. rewrite (Rabs_right (Rabs _)) by (apply Rle_ge, Rabs_pos).
      apply Rmult_le_compat_l; [apply Rabs_pos|]. assert (Q := H (k - S l)%nat e He). rewrite Rmult_1_l in Q. exact Q.
    - rewrite sum_scal_r, (proj1 (telescoping alpha Ha)). assert (C := ck_pos alpha Ha k).
      assert (N0 := norm_nonneg N e). nra. }
  lra.
Qed.

Theorem eqL3_needs_spectrum : eqL3_needs_spectrum_statement.
Proof.
  intros N A alpha gamma h t HN H1 D HB Ht. set (mu := mu_of alpha gamma h) in *.
  assert (bal : balanced N A) by apply H1.
  assert (B := bounded_powers N A alpha mu (proj1 D) (proj1 (eqL3_characterised N A alpha gamma h HN H1 D) HB)).
  apply stability_limit; [apply Ht|]. split.
  - intros x Hx. apply (simple_zero N A x ltac:(lia) H1 Hx).
  - intros p q x y Hxy Ex Ey Hne.
    assert (PQ : 0 < p ^ 2 + q ^ 2).
    { assert (Q1 := pow2_ge_0 p). assert (Q2 := pow2_ge_0 q).
      destruct (Req_dec (p ^ 2 + q ^ 2) 0) as [Z|Z]; [|lra]. exfalso. apply Hne. split; nra. }
    assert (M : (1 - mu * p) ^ 2 + (- (mu * q)) ^ 2 <= 1 ^ 2).
    { apply (eigenvalues_from_decay N A mu 2 1 (1 - mu * p) (- (mu * q)) x y bal); try lra.
      - exact B.
      - intros i Hi. rewrite perron_entry, Ex by exact Hi. ring.
      - intros i Hi. rewrite perron_entry, Ey by exact Hi. ring.
      - intros [E1 E2]. apply Hne. split; apply Rmult_eq_reg_l with mu; lra. }
    assert (T : mu * (p ^ 2 + q ^ 2) <= 2 * p).
    { apply Rmult_le_reg_l with mu; [lra|]. lra. }
    eapply Rlt_le_trans; [|exact T]. apply Rmult_lt_compat_r; lra.
Qed.
