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
