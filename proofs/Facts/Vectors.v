(** Inner products, norms and maps on vectors of dimension N. *)
From Coq Require Import Reals Arith Lia Lra.
From Fomas Require Import Model.Vectors Facts.Sums.
Open Scope R_scope.

Lemma dot_ext N x y x' y' : (forall i, (i < N)%nat -> x i = x' i) ->
  (forall i, (i < N)%nat -> y i = y' i) -> dot N x y = dot N x' y'.
Proof. intros Hx Hy. apply sum_ext. intros i Hi. rewrite Hx, Hy; auto. Qed.

Lemma dot_comm N x y : dot N x y = dot N y x.
Proof. apply sum_ext. intros i _. ring. Qed.

Lemma dot_plus_l N x y z : dot N (fun i => x i + y i) z = dot N x z + dot N y z.
Proof. unfold dot. rewrite <- sum_plus. apply sum_ext. intros i _. ring. Qed.

Lemma dot_scal_l N a x y : dot N (fun i => a * x i) y = a * dot N x y.
Proof. unfold dot. rewrite <- sum_scal. apply sum_ext. intros i _. ring. Qed.

Lemma dot_plus_r N x y z : dot N x (fun i => y i + z i) = dot N x y + dot N x z.
Proof. rewrite dot_comm, dot_plus_l, (dot_comm N y), (dot_comm N z). reflexivity. Qed.

Lemma dot_scal_r N a x y : dot N x (fun i => a * y i) = a * dot N x y.
Proof. rewrite dot_comm, dot_scal_l, (dot_comm N y). reflexivity. Qed.

Lemma dot_minus_l N x y z : dot N (fun i => x i - y i) z = dot N x z - dot N y z.
Proof. unfold dot. rewrite <- sum_minus. apply sum_ext. intros i _. ring. Qed.

Lemma dot_minus_r N x y z : dot N x (fun i => y i - z i) = dot N x y - dot N x z.
Proof. rewrite dot_comm, dot_minus_l, (dot_comm N y), (dot_comm N z). reflexivity. Qed.

Lemma dot_nonneg N x : 0 <= dot N x x.
Proof. apply sum_nonneg. intros i _. nra. Qed.

Lemma dot_zero N x : dot N x x = 0 -> forall i, (i < N)%nat -> x i = 0.
Proof.
  intros H i Hi.
  assert (x i * x i = 0)
    by (apply (sum_zero_terms N (fun i => x i * x i)); auto; intros; nra).
  nra.
Qed.

Lemma cauchy_schwarz N x y : dot N x y ^ 2 <= dot N x x * dot N y y.
Proof.
  unfold dot. induction N as [|N IH]; simpl; [lra|]. simpl in IH.
  set (a := \sum_(i < N) (x i * x i)) in *. set (b := \sum_(i < N) (y i * y i)) in *.
  set (s := \sum_(i < N) (x i * y i)) in *.
  assert (Ha : 0 <= a) by (apply sum_nonneg; intros; nra).
  assert (Hb : 0 <= b) by (apply sum_nonneg; intros; nra).
  assert (2 * s * (x N * y N) <= a * (y N * y N) + b * (x N * x N)).
  { destruct (Req_dec a 0) as [Z|Z].
    - assert (s = 0) by (rewrite Z in IH; nra). subst s. rewrite H. nra.
    - apply Rmult_le_reg_l with a; [lra|].
      assert (0 <= (a * y N - s * x N) ^ 2) by apply pow2_ge_0.
      assert (s * (s * 1) * (x N * x N) <= a * b * (x N * x N))
        by (apply Rmult_le_compat_r; nra).
      nra. }
  nra.
Qed.

Lemma norm_nonneg N x : 0 <= norm N x.
Proof. apply sqrt_pos. Qed.

Lemma norm_sq N x : norm N x * norm N x = dot N x x.
Proof. apply sqrt_sqrt, dot_nonneg. Qed.

Lemma norm_pow2 N x : norm N x ^ 2 = dot N x x.
Proof. rewrite <- norm_sq. ring. Qed.

Lemma norm_ext N x y : (forall i, (i < N)%nat -> x i = y i) -> norm N x = norm N y.
Proof. intros H. unfold norm. f_equal. apply dot_ext; auto. Qed.

Lemma dot_le_norm N x y : Rabs (dot N x y) <= norm N x * norm N y.
Proof.
  assert (H := cauchy_schwarz N x y). rewrite <- !norm_sq in H.
  assert (Hx := norm_nonneg N x). assert (Hy := norm_nonneg N y).
  apply Rsqr_incr_0_var; [|nra]. rewrite <- Rsqr_abs. unfold Rsqr. nra.
Qed.

Lemma norm_triangle N x y : norm N (fun i => x i + y i) <= norm N x + norm N y.
Proof.
  assert (Hx := norm_nonneg N x). assert (Hy := norm_nonneg N y).
  apply Rsqr_incr_0_var; [|lra].
  unfold Rsqr. rewrite norm_sq, dot_plus_l, !dot_plus_r, (dot_comm N y x), <- !norm_sq.
  assert (H := Rle_trans _ _ _ (Rle_abs _) (dot_le_norm N x y)). nra.
Qed.

Lemma norm_scal N a x : norm N (fun i => a * x i) = Rabs a * norm N x.
Proof.
  unfold norm. rewrite dot_scal_l, dot_scal_r, <- Rmult_assoc.
  rewrite sqrt_mult_alt by nra. f_equal. apply sqrt_Rsqr_abs.
Qed.

Lemma norm_zero N x : (forall i, (i < N)%nat -> x i = 0) -> norm N x = 0.
Proof.
  intros H. unfold norm, dot. rewrite sum_zero; [apply sqrt_0|].
  intros i Hi. rewrite H by auto. ring.
Qed.

Lemma norm_zero_inv N x : norm N x = 0 -> forall i, (i < N)%nat -> x i = 0.
Proof. intros H. apply dot_zero. rewrite <- norm_sq, H. ring. Qed.

Lemma norm_le_sq N x y : dot N x x <= dot N y y -> norm N x <= norm N y.
Proof. apply sqrt_le_1_alt. Qed.

Lemma norm_le_bound N x b : 0 <= b -> dot N x x <= b ^ 2 -> norm N x <= b.
Proof.
  intros Hb H. apply Rsqr_incr_0_var; [|exact Hb].
  unfold Rsqr. rewrite norm_sq. simpl in H. lra.
Qed.

Lemma entry_le_norm N x i : (i < N)%nat -> Rabs (x i) <= norm N x.
Proof.
  intros Hi. apply Rsqr_incr_0_var; [|apply norm_nonneg].
  rewrite <- Rsqr_abs. unfold Rsqr. rewrite norm_sq.
  apply (sum_ge_term N (fun i => x i * x i)); auto. intros; nra.
Qed.

Lemma norm_le_sum N x : norm N x <= \sum_(i < N) Rabs (x i).
Proof.
  apply norm_le_bound; [apply sum_nonneg; intros; apply Rabs_pos|].
  unfold dot. induction N as [|N IH]; simpl; [lra|]. simpl in IH.
  assert (0 <= \sum_(i < N) Rabs (x i)) by (apply sum_nonneg; intros; apply Rabs_pos).
  assert (x N * x N = Rabs (x N) * Rabs (x N)) by (rewrite <- Rabs_mult, Rabs_right; nra).
  assert (H1 := Rabs_pos (x N)). nra.
Qed.

(** The norm of a linear combination. *)
Lemma norm_combination N n (a : nat -> R) (v : nat -> vec) :
  norm N (fun i => \sum_(l < n) (a l * v l i)) <= \sum_(l < n) (Rabs (a l) * norm N (v l)).
Proof.
  induction n as [|n IH]; simpl; [rewrite norm_zero; auto; lra|].
  eapply Rle_trans; [apply norm_triangle|]. rewrite norm_scal. lra.
Qed.

(** * Maps *)

Lemma mv_ext N M x y i : (forall j, (j < N)%nat -> x j = y j) -> mv N M x i = mv N M y i.
Proof. intros H. apply sum_ext. intros j Hj. rewrite H; auto. Qed.

Lemma mv_plus N M x y i : mv N M (fun j => x j + y j) i = mv N M x i + mv N M y i.
Proof. unfold mv. rewrite <- sum_plus. apply sum_ext. intros j _. ring. Qed.

Lemma mv_scal N M a x i : mv N M (fun j => a * x j) i = a * mv N M x i.
Proof. unfold mv. rewrite <- sum_scal. apply sum_ext. intros j _. ring. Qed.

Lemma mv_minus N M x y i : mv N M (fun j => x j - y j) i = mv N M x i - mv N M y i.
Proof. unfold mv. rewrite <- sum_minus. apply sum_ext. intros j _. ring. Qed.

Lemma mv_sum N M n (x : nat -> vec) i :
  mv N M (fun j => \sum_(l < n) x l j) i = \sum_(l < n) mv N M (x l) i.
Proof.
  unfold mv. rewrite sum_swap. apply sum_ext. intros j _. symmetry. apply sum_scal.
Qed.

Lemma iter_mv_ext N M k x y : (forall j, (j < N)%nat -> x j = y j) ->
  forall i, (i < N)%nat -> iter k (mv N M) x i = iter k (mv N M) y i.
Proof.
  intros H. induction k as [|k IH]; intros i Hi; simpl; [auto|].
  apply mv_ext. exact IH.
Qed.

Lemma iter_plus (T : vec -> vec) m n x : iter (m + n) T x = iter m T (iter n T x).
Proof. induction m as [|m IH]; simpl; [reflexivity|rewrite IH; reflexivity]. Qed.

Lemma iter_scal N M k a x i : (i < N)%nat ->
  iter k (mv N M) (fun j => a * x j) i = a * iter k (mv N M) x i.
Proof.
  revert i. induction k as [|k IH]; intros i Hi; simpl; [reflexivity|].
  rewrite <- mv_scal. apply mv_ext. exact IH.
Qed.

Lemma iter_minus N M k x y i : (i < N)%nat ->
  iter k (mv N M) (fun j => x j - y j) i = iter k (mv N M) x i - iter k (mv N M) y i.
Proof.
  revert i. induction k as [|k IH]; intros i Hi; simpl; [reflexivity|].
  rewrite <- mv_minus. apply mv_ext. exact IH.
Qed.

Lemma id_mat_sum N i x : (i < N)%nat -> \sum_(j < N) (id_mat i j * x j) = x i.
Proof.
  intros Hi. rewrite (sum_single N i); [|exact Hi|]; unfold id_mat.
  - rewrite Nat.eqb_refl. ring.
  - intros j _ Hj. destruct (Nat.eqb_spec i j); [congruence|ring].
Qed.

Lemma zero_sum_ext N x y : (forall i, (i < N)%nat -> x i = y i) -> zero_sum N x -> zero_sum N y.
Proof. unfold zero_sum. intros H Hx. rewrite <- Hx. symmetry. apply sum_ext, H. Qed.

Lemma zero_sum_plus N x y : zero_sum N x -> zero_sum N y -> zero_sum N (fun i => x i + y i).
Proof. unfold zero_sum. intros Hx Hy. rewrite sum_plus, Hx, Hy. ring. Qed.

Lemma zero_sum_scal N a x : zero_sum N x -> zero_sum N (fun i => a * x i).
Proof. unfold zero_sum. intros Hx. rewrite sum_scal, Hx. ring. Qed.

(** The deviation from the mean lies in 1perp. *)
Lemma zero_sum_deviation N x : (1 <= N)%nat -> zero_sum N (fun i => x i - mean N x).
Proof.
  intros HN. unfold zero_sum, mean. rewrite sum_minus, sum_const. field.
  apply not_0_INR. lia.
Qed.

Lemma bounded_compose N S T a b : 0 <= a ->
  (forall e, zero_sum N e -> zero_sum N (T e)) ->
  bounded_on_1perp N S a -> bounded_on_1perp N T b ->
  bounded_on_1perp N (fun e => S (T e)) (a * b).
Proof.
  intros Ha HT HS HTb e He.
  eapply Rle_trans; [apply HS, HT, He|]. rewrite Rmult_assoc.
  apply Rmult_le_compat_l; auto.
Qed.

(** * Quadratic forms *)

Lemma dot_mv_sym N Q x y : (forall i j, (i < N)%nat -> (j < N)%nat -> Q i j = Q j i) ->
  dot N x (mv N Q y) = dot N y (mv N Q x).
Proof.
  intros H. unfold dot, mv.
  rewrite (sum_ext N _ (fun i => \sum_(j < N) (x i * (Q i j * y j))))
    by (intros; symmetry; apply sum_scal).
  rewrite sum_swap. apply sum_ext. intros i Hi. rewrite <- sum_scal.
  apply sum_ext. intros j Hj. rewrite (H j i) by auto. ring.
Qed.

Lemma form_double_sum N Q x : form N Q x = \sum_(i < N) \sum_(j < N) (Q i j * x i * x j).
Proof.
  unfold form, dot, mv. apply sum_ext. intros i _. rewrite <- sum_scal.
  apply sum_ext. intros j _. ring.
Qed.

Lemma form_ext N Q x y : (forall i, (i < N)%nat -> x i = y i) -> form N Q x = form N Q y.
Proof. intros H. apply dot_ext; [exact H|]. intros i _. apply mv_ext, H. Qed.

Lemma form_scal N Q a x : form N Q (fun i => a * x i) = a ^ 2 * form N Q x.
Proof.
  unfold form. rewrite dot_scal_l, (dot_ext N x _ x (fun i => a * mv N Q x i)), dot_scal_r;
    [ring|auto|]. intros i _. apply mv_scal.
Qed.

Lemma form_plus N Q x y : (forall i j, (i < N)%nat -> (j < N)%nat -> Q i j = Q j i) ->
  form N Q (fun i => x i + y i) = form N Q x + 2 * dot N x (mv N Q y) + form N Q y.
Proof.
  intros H. unfold form.
  rewrite (dot_ext N (fun i => x i + y i) _ (fun i => x i + y i)
             (fun i => mv N Q x i + mv N Q y i)); [|auto|intros; apply mv_plus].
  rewrite dot_plus_l, !dot_plus_r, (dot_mv_sym N Q y x) by auto. ring.
Qed.
