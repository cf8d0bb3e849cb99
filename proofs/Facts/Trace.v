(** The trace of a power of a matrix whose powers decay is at most its dimension. *)
From Coq Require Import Reals Arith Lia Lra.
From Coquelicot Require Import Coquelicot.
From Fomas Require Import Model.Vectors Facts.Sums Facts.Vectors.
Open Scope R_scope.

Section Trace.
Variables (n : nat) (M : mat) (k m : nat).
Local Notation P := (mv n M).
Hypothesis Hm : (1 <= m)%nat.
Hypothesis shrink : forall x, dot n (iter (m * k) P x) (iter (m * k) P x) <= dot n x x.

(** The inner product sum_{j<m} (M^(jk) x).(M^(jk) y), in which T = M^k contracts. *)
Definition inner (x y : vec) : R := \sum_(j < m) dot n (iter (j * k) P x) (iter (j * k) P y).
Let T x := iter k P x.

Lemma inner_sym x y : inner x y = inner y x.
Proof. apply sum_ext. intros j _. apply dot_comm. Qed.

Lemma inner_ext x y z : (forall i, (i < n)%nat -> y i = z i) -> inner x y = inner x z.
Proof.
  intros E. apply sum_ext. intros j _. apply dot_ext; [auto|]. apply iter_mv_ext, E.
Qed.

Lemma inner_combination x p (a : nat -> R) (v : nat -> vec) :
  inner x (fun i => \sum_(l < p) (a l * v l i)) = \sum_(l < p) (a l * inner x (v l)).
Proof.
  induction p as [|p IH]; simpl.
  - unfold inner. apply sum_zero. intros j _.
    rewrite (dot_ext n _ _ (iter (j * k) P x) (fun i => 0 * iter (j * k) P x i)); auto.
    + rewrite dot_scal_r. ring.
    + intros i Hi. rewrite <- iter_scal by exact Hi. apply iter_mv_ext; [|exact Hi].
      intros; ring.
  - rewrite <- IH. unfold inner. rewrite <- sum_scal, <- sum_plus. apply sum_ext. intros j _.
    rewrite <- dot_scal_r, <- dot_plus_r. apply dot_ext; [auto|]. intros i Hi.
    rewrite (iter_mv_ext n M (j * k) _ (fun i => \sum_(l < p) (a l * v l i) - (- a p) * v p i))
      by (try exact Hi; intros; ring).
    rewrite (iter_minus n M (j * k) (fun i => \sum_(l < p) (a l * v l i)) (fun i => - a p * v p i)),
      iter_scal by exact Hi. ring.
Qed.

Lemma inner_minus x y z : inner x (fun i => y i - z i) = inner x y - inner x z.
Proof.
  unfold inner. rewrite <- sum_minus. apply sum_ext. intros j _. rewrite <- dot_minus_r.
  apply dot_ext; [auto|]. intros i Hi. apply iter_minus, Hi.
Qed.

Lemma inner_ge x : dot n x x <= inner x x.
Proof.
  unfold inner. destruct m as [|l]; [lia|]. rewrite sum_first. simpl iter.
  assert (0 <= \sum_(i < l) dot n (iter (S i * k) P x) (iter (S i * k) P x))
    by (apply sum_nonneg; intros; apply dot_nonneg).
  simpl in *. lra.
Qed.

Lemma inner_contracts x : inner (T x) (T x) <= inner x x.
Proof.
  set (F := fun j => dot n (iter (j * k) P x) (iter (j * k) P x)).
  assert (E : inner (T x) (T x) = \sum_(j < m) F (S j)).
  { apply sum_ext. intros j _. unfold F, T. rewrite <- iter_plus.
    replace (j * k + k)%nat with (S j * k)%nat by lia. reflexivity. }
  assert (G := sum_first m F). rewrite sum_last in G. rewrite E.
  change (inner x x) with (sum_lt m F). specialize (shrink x). fold (F m) in shrink.
  assert (F0 : F 0%nat = dot n x x) by reflexivity. lra.
Qed.

Lemma inner_step v : Rabs (inner v (T v)) <= inner v v.
Proof.
  assert (C := inner_contracts v).
  assert (Q : forall s, s = 1 \/ s = -1 -> 2 * s * inner v (T v) <= 2 * inner v v).
  { intros s Hs. assert (N := inner_ge (fun i => v i - s * T v i)).
    assert (N0 := dot_nonneg n (fun i => v i - s * T v i)).
    assert (L : forall x, inner x (fun i => v i - s * T v i) = inner x v - s * inner x (T v)).
    { intros x. rewrite (inner_minus x v (fun i => s * T v i)). f_equal.
      rewrite (inner_ext x (fun i => s * T v i) (fun i => \sum_(l < 1) (s * T v i)))
        by (intros; simpl; ring).
      rewrite (inner_combination x 1 (fun _ => s) (fun _ => T v)). simpl. ring. }
    rewrite L in N. rewrite (inner_sym _ v), (inner_sym _ (T v)), !L in N.
    rewrite (inner_sym (T v) v) in N. destruct Hs as [-> | ->]; lra. }
  apply Rabs_le. assert (Q1 := Q 1 (or_introl eq_refl)). assert (Q2 := Q (-1) (or_intror eq_refl)).
  lra.
Qed.

(** Gram-Schmidt: an orthogonal family that reproduces the first p unit vectors. *)
Definition weight (v : nat -> vec) (a i : nat) : R := inner (v i) (id_mat a) / inner (v i) (v i).

Lemma orthogonal_family p : (p <= n)%nat -> exists v : nat -> vec,
  (forall i j, (i < p)%nat -> (p <= j)%nat -> v i j = 0) /\
  (forall i, (i < p)%nat -> 0 < inner (v i) (v i)) /\
  (forall i l, (i < p)%nat -> (l < p)%nat -> i <> l -> inner (v i) (v l) = 0) /\
  (forall a j, (a < p)%nat -> id_mat a j = \sum_(i < p) (weight v a i * v i j)).
Proof.
  induction p as [|p IH]; intros Hp.
  - exists (fun _ _ => 0). repeat split; intros; lia.
  - destruct IH as [v [supp [pos [orth rep]]]]; [lia|].
    set (w := fun j => id_mat p j - \sum_(i < p) (weight v p i * v i j)).
    assert (vw : forall l, (l < p)%nat -> inner (v l) w = 0).
    { intros l Hl. unfold w. rewrite inner_minus, inner_combination.
      rewrite (sum_single p l); [|exact Hl|].
      - unfold weight. field. assert (Q := pos l Hl). lra.
      - intros i Hi Ne. rewrite (orth l i Hl Hi) by lia. ring. }
    assert (ww : 0 < inner w w).
    { apply Rlt_le_trans with (dot n w w); [|apply inner_ge].
      apply Rlt_le_trans with (w p * w p).
      - assert (E : w p = 1); [|rewrite E; lra]. unfold w, id_mat at 1. rewrite Nat.eqb_refl.
        rewrite sum_zero; [ring|]. intros i Hi. rewrite supp by lia. ring.
      - apply (sum_ge_term n (fun j => w j * w j)); [|lia]. intros. nra. }
    assert (wp : inner w (id_mat p) = inner w w).
    { rewrite (inner_ext w (id_mat p) (fun j => w j - \sum_(i < p) (- weight v p i * v i j))).
      - rewrite (inner_minus w w), (inner_combination w p (fun i => - weight v p i)).
        rewrite sum_zero; [ring|]. intros i Hi. rewrite (inner_sym w), vw by exact Hi. ring.
      - intros j _. unfold w. rewrite <- (Rplus_0_r (id_mat p j)) at 1.
        rewrite (sum_ext p (fun i => - weight v p i * v i j) (fun i => - (weight v p i * v i j)))
          by (intros; ring). rewrite sum_opp. ring. }
    assert (wa : forall a, (a < p)%nat -> inner w (id_mat a) = 0).
    { intros a Ha. rewrite (inner_ext w (id_mat a) _ (fun j _ => rep a j Ha)).
      rewrite (inner_combination w p (weight v a)).
      apply sum_zero. intros i Hi. rewrite (inner_sym w), vw by exact Hi. ring. }
    set (v' := fun i => if Nat.eqb i p then w else v i).
    assert (new : v' p = w) by (unfold v'; rewrite Nat.eqb_refl; reflexivity).
    assert (old : forall i, (i < p)%nat -> v' i = v i).
    { intros i Hi. unfold v'. destruct (Nat.eqb_spec i p); [lia|reflexivity]. }
    exists v'. split; [|split; [|split]].
    + intros i j Hi Hj. destruct (Nat.eq_dec i p) as [->|Ne].
      * rewrite new. unfold w, id_mat. destruct (Nat.eqb_spec p j); [lia|].
        rewrite sum_zero; [ring|]. intros l Hl. rewrite supp by lia. ring.
      * rewrite old by lia. apply supp; lia.
    + intros i Hi. destruct (Nat.eq_dec i p) as [->|Ne]; [rewrite new; exact ww|].
      rewrite old by lia. apply pos. lia.
    + intros i l Hi Hl Ne.
      destruct (Nat.eq_dec i p) as [->|Ni], (Nat.eq_dec l p) as [->|Nl]; try lia.
      * rewrite new, old by lia. rewrite inner_sym. apply vw. lia.
      * rewrite new, old by lia. apply vw. lia.
      * rewrite !old by lia. apply orth; lia.
    + intros a j Ha. rewrite sum_last.
      rewrite (sum_ext p _ (fun i => weight v a i * v i j))
        by (intros; unfold weight; rewrite old by assumption; reflexivity).
      unfold weight at 2. rewrite new. destruct (Nat.eq_dec a p) as [->|Ne].
      * rewrite wp. replace (inner w w / inner w w) with 1 by (field; lra). unfold w. ring.
      * rewrite wa, <- rep by lia. unfold Rdiv. ring.
Qed.

Lemma trace_bounded : Rabs (\sum_(a < n) T (id_mat a) a) <= INR n.
Proof.
  destruct (orthogonal_family n (le_n n)) as [v [_ [pos [_ rep]]]].
  assert (E : \sum_(a < n) T (id_mat a) a = \sum_(i < n) (inner (v i) (T (v i)) / inner (v i) (v i))).
  { transitivity (\sum_(a < n) \sum_(i < n) (weight v a i * T (v i) a)).
    - apply sum_ext. intros a Ha. unfold T.
      rewrite (iter_mv_ext n M k (id_mat a) (fun j => \sum_(i < n) (weight v a i * v i j)))
        by (try exact Ha; intros; apply rep; exact Ha).
      assert (C : forall p j, (j < n)%nat ->
        iter k P (fun j => \sum_(i < p) (weight v a i * v i j)) j
        = \sum_(i < p) (weight v a i * iter k P (v i) j)).
      { induction p as [|p IH]; intros j Hj; simpl.
        - rewrite (iter_mv_ext n M k (fun _ => 0) (fun j => 0 * v 0%nat j)) by (try exact Hj; intros; ring).
          rewrite iter_scal by exact Hj. ring.
        - rewrite <- IH by exact Hj.
          rewrite (iter_mv_ext n M k _ (fun j => \sum_(i < p) (weight v a i * v i j)
                     - (- weight v a p) * v p j)) by (try exact Hj; intros; ring).
          rewrite (iter_minus n M k (fun j => \sum_(i < p) (weight v a i * v i j))
                     (fun j => - weight v a p * v p j)), iter_scal by exact Hj.
          ring. }
      apply C, Ha.
    - rewrite sum_swap. apply sum_ext. intros i Hi.
      rewrite (inner_ext (v i) (T (v i)) (fun j => \sum_(a < n) (T (v i) a * id_mat a j))).
      + rewrite (inner_combination (v i) n (T (v i))). unfold Rdiv. rewrite <- sum_scal_r.
        apply sum_ext. intros a _. unfold weight, Rdiv. ring.
      + intros j Hj. symmetry. rewrite <- (id_mat_sum n j (T (v i)) Hj). apply sum_ext.
        intros a _. unfold id_mat. rewrite Nat.eqb_sym. ring. }
  rewrite E. eapply Rle_trans; [apply sum_abs|]. rewrite <- (Rmult_1_r (INR n)), <- sum_const.
  apply sum_le. intros i Hi. assert (Q := pos i Hi).
  unfold Rdiv. rewrite Rabs_mult, (Rabs_right (/ inner (v i) (v i)))
    by (apply Rle_ge, Rlt_le, Rinv_0_lt_compat, Q).
  apply Rmult_le_reg_r with (inner (v i) (v i)); [exact Q|].
  rewrite Rmult_assoc, Rinv_l by lra. rewrite Rmult_1_r, Rmult_1_l. apply inner_step.
Qed.
End Trace.
