(** lambda2 exists: a quadratic form that is positive on a subspace of the unit
    sphere is bounded below there, by completing squares one coordinate at a time. *)
From Coq Require Import Reals Arith Lia Lra.
From Fomas Require Import Model.Vectors Model.Graph Facts.Sums Facts.Vectors Facts.Graph.
Open Scope R_scope.

(** A symmetric form that is positive off zero has a positive lower bound. *)
Lemma positive_form_bounded n : forall Q : mat, (forall i j, Q i j = Q j i) ->
  (forall x, 0 < dot n x x -> 0 < form n Q x) ->
  exists e, 0 < e /\ forall x, e * dot n x x <= form n Q x.
Proof.
  induction n as [|n IH]; intros Q S P.
  - exists 1. split; [lra|]. intros x. unfold form, dot. simpl. lra.
  - (* the last pivot is positive *)
    set (d := Q n n).
    assert (split_form : forall x, form (Datatypes.S n) Q x
              = form n Q x + 2 * x n * \sum_(j < n) (Q n j * x j) + d * x n ^ 2).
    { intros x. rewrite !form_double_sum. rewrite !sum_last.
      rewrite (sum_ext n (fun i => \sum_(j < Datatypes.S n) (Q i j * x i * x j))
                 (fun i => \sum_(j < n) (Q i j * x i * x j) + x n * (Q n i * x i)))
        by (intros i _; rewrite sum_last, (S i n); ring).
      rewrite sum_plus, sum_scal.
      rewrite (sum_ext n (fun j => Q n j * x n * x j) (fun j => x n * (Q n j * x j)))
        by (intros; ring).
      rewrite sum_scal. unfold d. ring. }
    assert (Hd : 0 < d).
    { specialize (P (fun i => if Nat.eqb i n then 1 else 0)). rewrite split_form in P.
      rewrite Nat.eqb_refl in P. unfold form, dot in P.
      rewrite (sum_zero n), (sum_zero n) in P.
      - enough (0 < 0 + 2 * 1 * 0 + d * 1 ^ 2) by lra. apply P. simpl.
        rewrite Nat.eqb_refl. rewrite sum_zero; [lra|].
        intros i Hi. destruct (Nat.eqb_spec i n); [lia|ring].
      - intros i Hi. destruct (Nat.eqb_spec i n); [lia|ring].
      - intros i Hi. destruct (Nat.eqb_spec i n); [lia|ring]. }
    (* the Schur complement is positive too *)
    set (Q' := fun i j => Q i j - Q n i * Q n j / d).
    assert (complete : forall x, form (Datatypes.S n) Q x
              = form n Q' x + d * (x n + (\sum_(j < n) (Q n j * x j)) / d) ^ 2).
    { intros x. rewrite split_form.
      assert (E : form n Q' x = form n Q x - (\sum_(j < n) (Q n j * x j)) ^ 2 / d).
      { rewrite !form_double_sum. unfold Q'.
        rewrite (sum_ext n _ (fun i => \sum_(j < n) (Q i j * x i * x j)
                    - Q n i * x i / d * \sum_(j < n) (Q n j * x j)))
          by (intros i _; rewrite <- sum_scal, <- sum_minus; apply sum_ext; intros; field; lra).
        rewrite sum_minus, sum_scal_r.
        rewrite (sum_ext n (fun i => Q n i * x i / d) (fun i => / d * (Q n i * x i)))
          by (intros; field; lra).
        rewrite sum_scal. field. lra. }
      rewrite E. field. lra. }
    destruct (IH Q') as [e [He Hq]].
    + intros i j. unfold Q'. rewrite (S i j). field. lra.
    + intros x Hx.
      set (y := fun i => if Nat.eqb i n then - (\sum_(j < n) (Q n j * x j)) / d else x i).
      assert (yx : forall i, (i < n)%nat -> y i = x i)
        by (intros i Hi; unfold y; destruct (Nat.eqb_spec i n); [lia|reflexivity]).
      assert (yn : y n = - (\sum_(j < n) (Q n j * x j)) / d)
        by (unfold y; rewrite Nat.eqb_refl; reflexivity).
      assert (E := complete y). rewrite (form_ext n Q' y x yx) in E.
      rewrite (sum_ext n (fun j => Q n j * y j) (fun j => Q n j * x j)) in E
        by (intros; rewrite yx; auto).
      rewrite yn in E.
      replace (- (\sum_(j < n) (Q n j * x j)) / d + (\sum_(j < n) (Q n j * x j)) / d)
        with 0 in E by (field; lra).
      replace (form n Q' x) with (form (Datatypes.S n) Q y) by (rewrite E; ring).
      apply P. unfold dot. rewrite sum_last.
      change (0 < dot n y y + y n * y n). rewrite (dot_ext n y y x x) by auto.
      assert (Z := pow2_ge_0 (y n)). nra.
    + (* |x_n| is controlled by the square and the other coordinates *)
      set (q := dot n (Q n) (Q n)).
      assert (q0 : 0 <= q) by apply dot_nonneg.
      set (k := 1 + 2 * (q / (d * d))).
      assert (k0 : 1 <= k).
      { unfold k. assert (0 <= q / (d * d)); [|lra].
        apply Rmult_le_pos; [exact q0|left; apply Rinv_0_lt_compat; nra]. }
      set (e' := Rmin (e / k) (d / 2)).
      assert (He' : 0 < e').
      { unfold e'. apply Rmin_glb_lt; [apply Rdiv_lt_0_compat; lra|lra]. }
      exists e'. split; [exact He'|]. intros x. rewrite complete.
      assert (E1 : e' <= e / k) by apply Rmin_l. assert (E2 : e' <= d / 2) by apply Rmin_r.
      set (s := \sum_(j < n) (Q n j * x j)). specialize (Hq x).
      assert (CS := cauchy_schwarz n (Q n) x). fold q in CS.
      change (dot n (Q n) x) with s in CS.
      unfold dot at 1. rewrite sum_last. change (\sum_(i < n) (x i * x i)) with (dot n x x).
      assert (X0 := dot_nonneg n x). set (X := dot n x x) in *.
      assert (B : x n * x n <= 2 * (x n + s / d) ^ 2 + 2 * (q / (d * d)) * X).
      { assert (T : (s / d) ^ 2 <= q / (d * d) * X).
        { apply Rmult_le_reg_l with (d * d); [nra|].
          replace (d * d * (s / d) ^ 2) with (s ^ 2) by (field; lra).
          replace (d * d * (q / (d * d) * X)) with (q * X) by (field; lra). exact CS. }
        assert (Z := pow2_ge_0 (x n + 2 * (s / d))). nra. }
      apply Rle_trans with (e' * (k * X + 2 * (x n + s / d) ^ 2)).
      * apply Rmult_le_compat_l; [lra|]. unfold k. lra.
      * assert (W := pow2_ge_0 (x n + s / d)).
        assert (K1 : e' * (k * X) <= e * X).
        { replace (e * X) with (e / k * (k * X)) by (field; lra).
          apply Rmult_le_compat_r; [nra|exact E1]. }
        assert (K2 : e' * (2 * (x n + s / d) ^ 2) <= d * (x n + s / d) ^ 2) by nra.
        lra.
Qed.

(** |x^T Q x| is at most a multiple of |x|^2, and |M x| of |x|. *)
Lemma form_bounded N Q : exists B, 0 <= B /\ forall x, Rabs (form N Q x) <= B * dot N x x.
Proof.
  exists (\sum_(i < N) \sum_(j < N) Rabs (Q i j)). split.
  - apply sum_nonneg. intros. apply sum_nonneg. intros. apply Rabs_pos.
  - intros x. rewrite form_double_sum, <- sum_scal_r.
    eapply Rle_trans; [apply sum_abs|]. apply sum_le. intros i Hi. rewrite <- sum_scal_r.
    eapply Rle_trans; [apply sum_abs|]. apply sum_le. intros j Hj.
    rewrite Rmult_assoc, Rabs_mult. apply Rmult_le_compat_l; [apply Rabs_pos|].
    rewrite Rabs_mult, <- norm_sq.
    apply Rmult_le_compat; try apply Rabs_pos; apply entry_le_norm; assumption.
Qed.

Lemma mv_bounded N M : exists B, 0 <= B /\ forall x, norm N (mv N M x) <= B * norm N x.
Proof.
  exists (\sum_(i < N) \sum_(j < N) Rabs (M i j)). split.
  - apply sum_nonneg. intros. apply sum_nonneg. intros. apply Rabs_pos.
  - intros x. eapply Rle_trans; [apply norm_le_sum|]. rewrite <- sum_scal_r.
    apply sum_le. intros i Hi. rewrite <- sum_scal_r.
    eapply Rle_trans; [apply sum_abs|]. apply sum_le. intros j Hj. rewrite Rabs_mult.
    apply Rmult_le_compat_l; [apply Rabs_pos|apply entry_le_norm; assumption].
Qed.

(** On 1perp a symmetric form that is positive off zero has a positive lower bound: the last
    entry is minus the sum of the others. *)
Lemma positive_form_bounded_1perp n Q : (forall i j, Q i j = Q j i) ->
  (forall x, zero_sum (S n) x -> 0 < dot (S n) x x -> 0 < form (S n) Q x) ->
  exists e, 0 < e /\ forall x, zero_sum (S n) x -> e * dot (S n) x x <= form (S n) Q x.
Proof.
  intros sym pos.
  set (ext := fun y : vec => fun i => if Nat.eqb i n then - sum_lt n y else y i).
  assert (ext_lt : forall y i, (i < n)%nat -> ext y i = y i)
    by (intros y i Hi; unfold ext; destruct (Nat.eqb_spec i n); [lia|reflexivity]).
  assert (ext_n : forall y, ext y n = - sum_lt n y)
    by (intros y; unfold ext; rewrite Nat.eqb_refl; reflexivity).
  assert (ext_zero : forall y, zero_sum (S n) (ext y)).
  { intros y. unfold zero_sum. rewrite sum_last, ext_n, (sum_ext n (ext y) y (ext_lt y)). ring. }
  assert (ext_dot : forall y, dot (S n) (ext y) (ext y) = dot n y y + sum_lt n y ^ 2).
  { intros y. unfold dot. rewrite sum_last, ext_n.
    rewrite (sum_ext n (fun i => ext y i * ext y i) (fun i => y i * y i))
      by (intros; rewrite ext_lt; auto). ring. }
  set (Q' := fun i j => Q i j - Q i n - Q n j + Q n n).
  assert (E : forall y, form (S n) Q (ext y) = form n Q' y).
  { intros y. rewrite !form_double_sum. rewrite sum_last, sum_last, ext_n.
    set (s := sum_lt n y).
    rewrite (sum_ext n (fun i => \sum_(j < S n) (Q i j * ext y i * ext y j))
               (fun i => \sum_(j < n) (Q i j * y i * y j) - Q i n * y i * s)).
    2: { intros i Hi. rewrite sum_last, ext_n, (ext_lt y i Hi). fold s.
         rewrite (sum_ext n (fun j => Q i j * y i * ext y j) (fun j => Q i j * y i * y j))
           by (intros; rewrite ext_lt; auto). ring. }
    rewrite (sum_ext n (fun j => Q n j * - s * ext y j) (fun j => - s * (Q n j * y j)))
      by (intros; rewrite ext_lt by assumption; ring).
    rewrite (sum_ext n (fun i => \sum_(j < n) (Q' i j * y i * y j))
               (fun i => \sum_(j < n) (Q i j * y i * y j) - Q i n * y i * s
                         - (y i * \sum_(j < n) (Q n j * y j)) + Q n n * y i * s)).
    2: { intros i _. unfold s. change (sum_lt n y) with (\sum_(j < n) y j).
         rewrite <- !sum_scal, <- !sum_minus, <- sum_plus.
         apply sum_ext. intros j _. unfold Q'. ring. }
    rewrite sum_plus, !sum_minus.
    assert (T1 : \sum_(i < n) (Q i n * y i * s) = \sum_(i < n) (Q i n * y i) * s)
      by apply sum_scal_r.
    assert (T2 : \sum_(i < n) (y i * \sum_(j < n) (Q n j * y j))
                 = s * \sum_(j < n) (Q n j * y j)) by apply sum_scal_r.
    assert (T3 : \sum_(i < n) (Q n n * y i * s) = Q n n * s * s).
    { rewrite sum_scal_r. f_equal. apply sum_scal. }
    assert (T4 : \sum_(j < n) (- s * (Q n j * y j)) = - s * \sum_(j < n) (Q n j * y j))
      by apply sum_scal.
    rewrite T1, T2, T3, T4. ring. }
  destruct (positive_form_bounded n Q') as [e [He H]].
  - intros i j. unfold Q'. rewrite (sym i j), (sym i n), (sym n j). ring.
  - intros y Hy. rewrite <- E. apply pos; [apply ext_zero|]. rewrite ext_dot.
    assert (Z := pow2_ge_0 (sum_lt n y)). lra.
  - assert (Pn := pos_INR n).
    exists (e / (1 + INR n)). split; [apply Rdiv_lt_0_compat; lra|]. intros x Hx.
    assert (Xe : forall i, (i < S n)%nat -> x i = ext x i).
    { intros i Hi. destruct (Nat.eq_dec i n) as [->|Hn].
      - rewrite ext_n. unfold zero_sum in Hx. rewrite sum_last in Hx. lra.
      - rewrite ext_lt by lia. reflexivity. }
    rewrite (form_ext (S n) Q x (ext x) Xe), (dot_ext (S n) x x (ext x) (ext x) Xe Xe).
    rewrite E, ext_dot. specialize (H x).
    assert (CS : sum_lt n x ^ 2 <= INR n * dot n x x).
    { assert (C := cauchy_schwarz n (fun _ => 1) x). unfold dot in C at 1 2.
      rewrite (sum_ext n (fun i => 1 * x i) x) in C by (intros; apply Rmult_1_l).
      rewrite sum_const in C. lra. }
    assert (X0 := dot_nonneg n x).
    apply Rle_trans with (e / (1 + INR n) * ((1 + INR n) * dot n x x)).
    + apply Rmult_le_compat_l; [left; apply Rdiv_lt_0_compat; lra|lra].
    + replace (e / (1 + INR n) * ((1 + INR n) * dot n x x)) with (e * dot n x x)
        by (field; lra). exact H.
Qed.

(** The Rayleigh quotient of a symmetric form attains its minimum on 1perp. *)
Lemma rayleigh_minimum N Q : (2 <= N)%nat -> (forall i j, Q i j = Q j i) -> exists m,
  (forall x, zero_sum N x -> m * dot N x x <= form N Q x) /\
  (exists v, zero_sum N v /\ 0 < dot N v v /\ form N Q v = m * dot N v v).
Proof.
  intros HN sym. destruct (form_bounded N Q) as [B [B0 HB]].
  assert (pack : exists v, zero_sum N v /\ dot N v v = 1).
  { exists (fun i => match i with O => / sqrt 2 | 1%nat => - / sqrt 2 | _ => 0 end).
    destruct N as [|[|n]]; [lia|lia|]. assert (Q2 := sqrt_sqrt 2 ltac:(lra)).
    assert (Q2p : 0 < sqrt 2) by (apply sqrt_lt_R0; lra).
    unfold zero_sum, dot. split; rewrite !sum_first, (sum_zero n) by (intros; ring).
    - ring.
    - replace (/ sqrt 2 * / sqrt 2 + (- / sqrt 2 * - / sqrt 2 + 0))
        with (2 / (sqrt 2 * sqrt 2)) by (field; lra).
      rewrite Q2. field. }
  destruct (completeness (fun y => exists x, zero_sum N x /\ dot N x x = 1 /\ y = - form N Q x))
    as [l [UB LUB]].
  - exists B. intros y [x [_ [H1 ->]]]. specialize (HB x). rewrite H1 in HB.
    assert (T := Rle_abs (- form N Q x)). rewrite Rabs_Ropp in T. lra.
  - destruct pack as [v [Hv H1]]. exists (- form N Q v), v. auto.
  - exists (- l).
    assert (low : forall x, zero_sum N x -> - l * dot N x x <= form N Q x).
    { intros x Hx. destruct (Req_dec (dot N x x) 0) as [Z|Z].
      - specialize (HB x). rewrite Z, Rmult_0_r in *.
        assert (T := Rle_abs (- form N Q x)). rewrite Rabs_Ropp in T. lra.
      - assert (X0 := dot_nonneg N x). set (a := / norm N x).
        assert (Np : 0 < norm N x) by (apply sqrt_lt_R0; lra).
        assert (Ea : a ^ 2 * dot N x x = 1) by (rewrite <- norm_sq; unfold a; field; lra).
        assert (U : - form N Q (fun i => a * x i) <= l).
        { apply UB. exists (fun i => a * x i). split; [apply zero_sum_scal, Hx|].
          split; [|reflexivity]. rewrite dot_scal_l, dot_scal_r. rewrite <- Ea. ring. }
        rewrite form_scal in U. apply Rmult_le_compat_r with (r := dot N x x) in U; [|lra].
        replace (- (a ^ 2 * form N Q x) * dot N x x) with (- form N Q x * (a ^ 2 * dot N x x))
          in U by ring.
        rewrite Ea in U. lra. }
    split; [exact low|]. apply Classical_Prop.NNPP. intros C.
    destruct N as [|n]; [lia|].
    set (Q' := fun i j => Q i j - (- l) * id_mat i j).
    assert (FQ : forall x, form (S n) Q' x = form (S n) Q x - (- l) * dot (S n) x x).
    { intros x. unfold form, dot. rewrite <- sum_scal, <- sum_minus. apply sum_ext.
      intros i Hi. unfold mv, Q'.
      rewrite (sum_ext (S n) _ (fun j => Q i j * x j - (- l) * (id_mat i j * x j)))
        by (intros; ring).
      rewrite sum_minus, sum_scal, id_mat_sum by exact Hi. ring. }
    destruct (positive_form_bounded_1perp n Q') as [e [He H]].
    + intros i j. unfold Q', id_mat. rewrite (sym i j), (Nat.eqb_sym i j). reflexivity.
    + intros x Hx Xp. rewrite FQ. assert (L := low x Hx).
      destruct (Req_dec (form (S n) Q x) (- l * dot (S n) x x)) as [E|NE]; [|lra].
      exfalso. apply C. exists x. auto.
    + assert (l <= l - e); [|lra]. apply LUB. intros y [x [Hx [H1 ->]]].
      specialize (H x Hx). rewrite FQ, H1 in H. lra.
Qed.
