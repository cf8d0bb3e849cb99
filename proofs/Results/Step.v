(** The paper's step decided, the paper's region, and the memory-free law. *)
From Coq Require Import Reals Arith Lia Lra.
From Fomas Require Import Model.Vectors Model.Kernel Model.Gamma Model.Graph Model.Loop Statements.
From Fomas Require Import Facts.Sums Facts.Vectors Facts.Kernel Facts.Graph Facts.Lambda2 Facts.Loop.
From Fomas Require Import Results.EqT2.
Open Scope R_scope.

Lemma step_identity N A mu l e :
  (1 - mu * l) ^ 2 * dot N e e - dot N (mv N (perron N A mu) e) (mv N (perron N A mu) e)
  = mu * step_bracket N A mu l e.
Proof. unfold step_bracket. rewrite perron_dot, form_sym. ring. Qed.

(** 1perp has a nonzero vector. *)
Lemma zero_sum_nonzero N : (2 <= N)%nat -> exists v, zero_sum N v /\ 0 < norm N v.
Proof.
  intros HN. destruct (rayleigh_minimum N id_mat HN) as [_ [_ [v [Hv [Pv _]]]]].
  - intros i j. unfold id_mat. rewrite Nat.eqb_sym. reflexivity.
  - exists v. split; [exact Hv|apply sqrt_lt_R0, Pv].
Qed.

Theorem step_decided : step_decided_statement.
Proof.
  intros N A mu l HN Hmu. split; [apply step_identity|]. split.
  - intros H. assert (B : 0 <= 1 - mu * l).
    { destruct (zero_sum_nonzero N HN) as [v [Hv Pv]]. specialize (H v Hv).
      assert (Q := norm_nonneg N (mv N (perron N A mu) v)). nra. }
    split; [exact B|]. intros e He. specialize (H e He).
    apply Rmult_le_reg_l with mu; [exact Hmu|]. rewrite Rmult_0_r, <- step_identity.
    rewrite <- !norm_sq. assert (P := norm_nonneg N (mv N (perron N A mu) e)). nra.
  - intros [B H] e He. apply norm_le_bound; [apply Rmult_le_pos; [exact B|apply norm_nonneg]|].
    rewrite Rpow_mult_distr, norm_pow2. assert (E := step_identity N A mu l e).
    assert (0 <= mu * step_bracket N A mu l e) by (apply Rmult_le_pos; [lra|apply H, He]). lra.
Qed.

(** With Q = L - lambda2 and y = Q e the bracket is 2 beta e.y - mu |y|^2; Q(e - s y) >= 0 for
    s = mu / (2 beta) bounds |y|^2. *)
Theorem symmetric_step : symmetric_step_statement.
Proof.
  intros N A mu l r HN Hmu sym Hl Hr H1 H2. apply step_decided; [exact HN|exact Hmu|].
  split; [lra|]. intros e He. set (L := laplacian N A).
  assert (bal : balanced N A) by (intros i Hi; apply sum_ext; intros j Hj; apply sym; assumption).
  assert (SL : forall i j, (i < N)%nat -> (j < N)%nat -> L i j = L j i).
  { intros i j Hi Hj. unfold L, laplacian. rewrite (sym i j Hi Hj), (Nat.eqb_sym j i).
    destruct (Nat.eqb_spec i j) as [->|]; reflexivity. }
  set (y := fun i => mv N L e i - l * e i).
  assert (Ly : forall i, (i < N)%nat -> mv N L e i = y i + l * e i) by (intros; unfold y; ring).
  assert (Hy : zero_sum N y).
  { unfold zero_sum, y. rewrite sum_minus, sum_scal. change (\sum_(i < N) e i) with (sum_lt N e).
    rewrite He. assert (Z := zero_sum_laplacian N A bal e). unfold zero_sum in Z.
    change (\sum_(i < N) mv N L e i) with (sum_lt N (mv N L e)). unfold L. rewrite Z. ring. }
  set (a := dot N e y). set (b := dot N y y). assert (B0 : 0 <= b) by apply dot_nonneg.
  assert (Fe : form N L e = a + l * dot N e e).
  { unfold form. rewrite (dot_ext N e _ e (fun i => y i + l * e i)), dot_plus_r, dot_scal_r; auto. }
  assert (Fy : form N L y <= r * b) by (unfold L; rewrite <- form_sym; apply Hr, Hy).
  assert (cross : dot N e (mv N L y) = b + l * a).
  { rewrite (dot_mv_sym N L e y SL), (dot_ext N y _ y (fun i => y i + l * e i)), dot_plus_r, dot_scal_r
      by auto. unfold a, b. rewrite (dot_comm N y e). ring. }
  assert (A0 : 0 <= a).
  { assert (Q := proj1 Hl e He). rewrite form_sym in Q. fold L in Q. lra. }
  assert (key : forall s, 0 <= a - 2 * s * b + s ^ 2 * (r - l) * b).
  { intros s. assert (Hz : zero_sum N (fun i => e i + (- s) * y i))
      by (apply zero_sum_plus; [exact He|apply zero_sum_scal, Hy]).
    assert (Q := proj1 Hl _ Hz). rewrite form_sym in Q. fold L in Q.
    rewrite (form_plus N L e (fun i => - s * y i) SL), form_scal in Q.
    rewrite (dot_ext N e (mv N L (fun i => - s * y i)) e (fun i => - s * mv N L y i)) in Q
      by (auto; intros; apply mv_scal).
    rewrite dot_plus_l, !dot_plus_r, !dot_scal_l, !dot_scal_r, cross, Fe, (dot_comm N y e) in Q.
    fold a b in Q. assert (S2 : s ^ 2 * form N L y <= s ^ 2 * (r * b))
      by (apply Rmult_le_compat_l; [apply pow2_ge_0|exact Fy]).
    replace ((- s) ^ 2) with (s ^ 2) in Q by ring. lra. }
  assert (bracket : step_bracket N A mu l e = 2 * (1 - mu * l) * a - mu * b).
  { unfold step_bracket. rewrite form_sym. fold L. rewrite Fe.
    rewrite (dot_ext N _ _ _ _ Ly Ly), dot_plus_l, !dot_plus_r, !dot_scal_l, !dot_scal_r.
    rewrite (dot_comm N y e). fold a b. ring. }
  rewrite bracket. set (c := 1 - mu * l) in *.
  assert (R : mu * (r - l) <= 2 * c) by (unfold c; lra).
  destruct (Rle_lt_or_eq_dec 0 c ltac:(unfold c; lra)) as [C|C].
  - set (s := mu / (2 * c)). assert (s0 : 0 < s) by (apply Rdiv_lt_0_compat; lra).
    assert (K := key s). assert (E : s * (r - l) <= 1).
    { apply Rmult_le_reg_l with (2 * c); [lra|]. unfold s.
      replace (2 * c * (mu / (2 * c) * (r - l))) with (mu * (r - l)) by (field; lra). lra. }
    assert (s * (s * (r - l)) * b <= s * 1 * b).
    { apply Rmult_le_compat_r; [exact B0|]. apply Rmult_le_compat_l; lra. }
    assert (F : s * b <= a) by lra.
    apply Rmult_le_compat_l with (r := 2 * c) in F; [|lra].
    replace (2 * c * (s * b)) with (mu * b) in F by (unfold s; field; lra). lra.
  - rewrite <- C in *. assert (D : (r - l) * b <= 0).
    { assert (r - l <= 0); [|nra]. apply Rmult_le_reg_l with mu; [exact Hmu|]. lra. }
    assert (K := key ((a + 1) / (b + 1))). set (s := (a + 1) / (b + 1)) in *.
    assert (Z : b = 0); [|rewrite Z; lra].
    destruct (Req_dec b 0) as [Z|Z]; [exact Z|]. exfalso.
    assert (P := pow2_ge_0 s). assert (s ^ 2 * (r - l) * b <= 0) by nra.
    assert (K2 := key ((a + 1) / b)).
    assert (P2 := pow2_ge_0 ((a + 1) / b)).
    assert (((a + 1) / b) ^ 2 * (r - l) * b <= 0) by nra.
    replace (2 * ((a + 1) / b) * b) with (2 * (a + 1)) in K2 by (field; lra). lra.
Qed.

Theorem step_fails : step_fails_statement.
Proof.
  intros N A mu l v Hl Hmu Hv Ev [i [Hi Ne]] H. specialize (H v Hv).
  set (L := laplacian N A) in *.
  (* |L v - l v|^2 > 0, and v^T L v = l |v|^2, so |L v|^2 > l^2 |v|^2 *)
  set (z := fun j => mv N L v j - l * v j).
  assert (Z : 0 < dot N z z).
  { destruct (Req_dec (dot N z z) 0) as [E|E]; [|assert (P := dot_nonneg N z); lra].
    exfalso. apply Ne. assert (Y := dot_zero N z E i Hi). unfold z in Y. lra. }
  rewrite form_sym in Ev. unfold form in Ev. fold L in Ev.
  assert (E : dot N z z = dot N (mv N L v) (mv N L v) - l ^ 2 * dot N v v).
  { unfold z. rewrite dot_minus_l, !dot_minus_r, !dot_scal_l, !dot_scal_r.
    rewrite (dot_comm N (mv N L v) v), Ev. ring. }
  assert (I := step_identity N A mu l v). unfold step_bracket in I. rewrite form_sym in I.
  unfold form in I. fold L in I. rewrite Ev in I.
  set (np := norm N (mv N (perron N A mu) v)) in *. set (nv := norm N v) in *.
  assert (P : 0 <= np) by apply norm_nonneg.
  assert (X : np * np = (1 - mu * l) ^ 2 * dot N v v + mu * (mu * dot N z z)).
  { unfold np. rewrite norm_sq, E. lra. }
  assert (M : 0 < mu * (mu * dot N z z)).
  { apply Rmult_lt_0_compat; [exact Hmu|]. apply Rmult_lt_0_compat; assumption. }
  assert (S : np * np <= (1 - mu * l) * nv * ((1 - mu * l) * nv))
    by (apply Rmult_le_compat; assumption).
  replace ((1 - mu * l) * nv * ((1 - mu * l) * nv)) with ((1 - mu * l) ^ 2 * (nv * nv)) in S by ring.
  unfold nv in S. rewrite norm_sq in S. lra.
Qed.

Theorem region_as_stated : region_as_stated_statement.
Proof.
  intros alpha l D Ha Hl HD.
  assert (S0 := sqrt_pos (Rpower 3 alpha - Rpower 2 alpha)).
  set (q := sqrt (Rpower 3 alpha - Rpower 2 alpha)) in *.
  assert (C1 := ck_1 alpha). assert (C1l := ck_lt_1 alpha Ha 1 (le_n 1)).
  assert (C1p := ck_pos alpha Ha 1).
  assert (I : forall mu, memory_inequality alpha (1 - mu * l) <->
                (2 - Rpower 2 alpha) / l <= mu <= (1 + q) / l).
  { intros mu. rewrite (eqT2_closed_form alpha _ Ha). fold q. split; intros [B1 B2]; split.
    - apply Rmult_le_reg_r with l; [exact Hl|]. unfold Rdiv.
      rewrite Rmult_assoc, Rinv_l by lra. lra.
    - apply Rmult_le_reg_r with l; [exact Hl|]. unfold Rdiv.
      rewrite Rmult_assoc, Rinv_l by lra. lra.
    - apply Rmult_le_compat_r with (r := l) in B2; [|lra]. unfold Rdiv in B2.
      rewrite Rmult_assoc, Rinv_l in B2 by lra. lra.
    - apply Rmult_le_compat_r with (r := l) in B1; [|lra]. unfold Rdiv in B1.
      rewrite Rmult_assoc, Rinv_l in B1 by lra. lra. }
  split; [exact I|]. split.
  - intros [mu [[M0 M1] H]]. apply I in H. destruct H as [B _].
    apply Rmult_lt_compat_r with (r := D * l) in M1; [|nra].
    apply Rmult_le_compat_r with (r := D * l) in B; [|nra].
    replace ((2 - Rpower 2 alpha) / l * (D * l)) with (D * (2 - Rpower 2 alpha)) in B
      by (field; lra).
    replace (1 / D * (D * l)) with l in M1 by (field; lra). lra.
  - intros H. exists ((2 - Rpower 2 alpha) / l). split; [split|].
    + apply Rdiv_lt_0_compat; lra.
    + apply Rmult_lt_reg_r with (D * l); [nra|].
      replace ((2 - Rpower 2 alpha) / l * (D * l)) with (D * (2 - Rpower 2 alpha)) by (field; lra).
      replace (1 / D * (D * l)) with l by (field; lra). exact H.
    + apply I. split; [lra|]. unfold Rdiv. apply Rmult_le_compat_r; [|lra].
      left. apply Rinv_0_lt_compat, Hl.
Qed.

Theorem memoryless_law : memoryless_law_statement.
Proof.
  intros N A alpha gamma h x0 x u [Ha [Hg Hh]] Hx U k i Hi.
  rewrite (plant_sample N alpha h x0 u x Ha Hh Hx k i Hi).
  rewrite (sum_ext (S k) (fun j => ck alpha (k - j) * u j i)
             (fun j => - gamma * (ck alpha (k - j) * error N A h x j i)))
    by (intros j _; rewrite (U j i Hi); ring).
  rewrite sum_scal. unfold mu_of. ring.
Qed.
