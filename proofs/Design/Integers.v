(** Integer matrices, decided by computation, and what they say about real ones. *)
From Coq Require Import Reals ZArith List Bool Lia Lra.
From Fomas Require Import Model.Vectors Statements Facts.Sums Facts.Vectors Facts.Forms Results.Soundness.
Open Scope R_scope.

(** Proves an equality of booleans by computing it. *)
Ltac check := vm_compute; reflexivity.

Definition zmat := list (list Z).
Definition entry (M : zmat) (i j : nat) : Z := nth j (nth i M nil) 0%Z.
Definition real (M : zmat) : mat := fun i j => IZR (entry M i j).
Definition table (N : nat) (f : nat -> nat -> Z) : zmat :=
  map (fun i => map (f i) (seq 0 N)) (seq 0 N).
Definition below (n : nat) (t : nat -> bool) : bool := forallb t (seq 0 n).
Fixpoint zsum (n : nat) (F : nat -> Z) : Z :=
  match n with O => 0 | S m => zsum m F + F m end%Z.

Lemma nth_seq {T} (f : nat -> T) n i d : (i < n)%nat -> nth i (map f (seq 0 n)) d = f i.
Proof.
  intros Hi. rewrite (nth_indep _ d (f 0%nat)) by (rewrite map_length, seq_length; exact Hi).
  rewrite map_nth, seq_nth by exact Hi. reflexivity.
Qed.

Lemma entry_table N f i j : (i < N)%nat -> (j < N)%nat -> entry (table N f) i j = f i j.
Proof. intros Hi Hj. unfold entry, table. rewrite !nth_seq by assumption. reflexivity. Qed.

Lemma below_true n t : below n t = true -> forall i, (i < n)%nat -> t i = true.
Proof.
  intros H i Hi. unfold below in H. rewrite forallb_forall in H. apply H, in_seq. lia.
Qed.

Lemma zsum_real n F : IZR (zsum n F) = \sum_(i < n) IZR (F i).
Proof. induction n as [|n IH]; simpl; [reflexivity|]. rewrite plus_IZR, IH. reflexivity. Qed.

Lemma zsum_ext n F G : (forall i, (i < n)%nat -> F i = G i) -> zsum n F = zsum n G.
Proof. induction n as [|n IH]; intros H; simpl; [reflexivity|]. rewrite IH, H; auto. Qed.

(** * Nonnegative forms: K M - eps I = F F^T + E with E symmetric, ||E||_inf <= eps. *)

Definition residual (N : nat) (M F : zmat) (K eps : Z) : zmat := table N (fun i j =>
  K * entry M i j - (if Nat.eqb i j then eps else 0)
  - zsum N (fun k => entry F i k * entry F j k))%Z.
Definition nonnegative (N : nat) (M F : zmat) (K eps : Z) : bool :=
  let E := residual N M F K eps in
  ((0 <? K)%Z && below N (fun i =>
     (zsum N (fun j => Z.abs (entry E i j)) <=? eps)%Z
     && below N (fun j => (entry E i j =? entry E j i)%Z)))%bool.

Lemma nonnegative_sound N M F K eps : nonnegative N M F K eps = true ->
  forall x, 0 <= form N (real M) x.
Proof.
  intros H x. apply andb_prop in H. destruct H as [HK H]. apply Z.ltb_lt, IZR_lt in HK.
  set (E := residual N M F K eps) in *.
  assert (B : forall i, (i < N)%nat ->
            (zsum N (fun j => Z.abs (entry E i j)) <= eps)%Z /\
            forall j, (j < N)%nat -> entry E i j = entry E j i).
  { intros i Hi. apply (below_true N _ H), andb_prop in Hi. destruct Hi as [B S]. split.
    - apply Z.leb_le, B.
    - intros j Hj. apply Z.eqb_eq. apply (below_true N _ S j Hj). }
  assert (P : 0 <= form N (fun i j => IZR K * real M i j + 0 * id_mat i j) x).
  { apply (residual_factor N N _ (real F) (real E) (IZR eps)).
    - intros i j Hi Hj. change (real E i j) with (IZR (entry E i j)). unfold E, residual. rewrite entry_table by assumption.
      rewrite !minus_IZR, mult_IZR, zsum_real.
      rewrite (sum_ext N (fun k => IZR (entry F i k * entry F j k))
                 (fun k => real F i k * real F j k)) by (intros; apply mult_IZR).
      unfold id_mat, real. destruct (Nat.eqb i j); ring.
    - intros i j Hi Hj. unfold real. f_equal. apply B; assumption.
    - intros i Hi. destruct (B i Hi) as [L _]. apply IZR_le in L. rewrite zsum_real in L.
      erewrite sum_ext; [exact L|]. intros j _. simpl. unfold real. symmetry. apply abs_IZR. }
  rewrite form_linear in P. apply Rmult_le_reg_l with (IZR K); [exact HK|]. lra.
Qed.

(** * The table of a Q - b B^T Q B - c I + w 1 1^T *)

Definition identity (N : nat) : zmat := table N (fun i j => if Nat.eqb i j then 1 else 0)%Z.
Definition stein (N : nat) (Q B : zmat) (a b c w : Z) : zmat :=
  let QB := table N (fun i j => zsum N (fun k => entry Q i k * entry B k j))%Z in
  table N (fun i j =>
    a * entry Q i j - b * zsum N (fun k => entry B k i * entry QB k j)
    - (if Nat.eqb i j then c else 0) + w)%Z.

Lemma form_all_ones N x : form N (fun _ _ => 1) x = sum_lt N x ^ 2.
Proof.
  unfold form, dot, mv.
  rewrite (sum_ext N _ (fun i => x i * sum_lt N x)).
  - rewrite sum_scal_r. simpl. ring.
  - intros i _. f_equal. apply sum_ext. intros; ring.
Qed.

Lemma form_stein_any N Q B a b c w x :
  form N (real (stein N Q B a b c w)) x
  = IZR a * form N (real Q) x - IZR b * form N (real Q) (mv N (real B) x) - IZR c * dot N x x
    + IZR w * sum_lt N x ^ 2.
Proof.
  set (BQB := fun i j => \sum_(k < N) (real B k i * \sum_(l < N) (real Q k l * real B l j))).
  rewrite (form_mat_ext N _ (fun i j =>
    1 * (IZR a * real Q i j + (- IZR b) * BQB i j)
    + 1 * ((- IZR c) * id_mat i j + IZR w * 1))).
  - rewrite !form_linear, form_identity, form_all_ones.
    unfold BQB. rewrite form_congruence. ring.
  - intros i j Hi Hj.
    change (real (stein N Q B a b c w) i j) with (IZR (entry (stein N Q B a b c w) i j)).
    unfold stein. rewrite entry_table by assumption.
    rewrite plus_IZR, !minus_IZR, !mult_IZR, zsum_real. unfold BQB.
    rewrite (sum_ext N (fun k => IZR (entry B k i * _))
               (fun k => real B k i * \sum_(l < N) (real Q k l * real B l j))).
    + unfold id_mat, real. destruct (Nat.eqb i j); ring.
    + intros k Hk. rewrite mult_IZR, entry_table, zsum_real by assumption. unfold real. f_equal.
      apply sum_ext. intros l _. apply mult_IZR.
Qed.

Lemma form_stein N Q B a b c w x : zero_sum N x ->
  form N (real (stein N Q B a b c w)) x
  = IZR a * form N (real Q) x - IZR b * form N (real Q) (mv N (real B) x) - IZR c * dot N x x.
Proof. intros Hx. rewrite form_stein_any, (Hx : sum_lt N x = 0). ring. Qed.

Lemma real_identity N x : form N (real (identity N)) x = dot N x x.
Proof.
  rewrite <- form_identity. apply form_mat_ext. intros i j Hi Hj.
  unfold real, identity, id_mat. rewrite entry_table by assumption. destruct (Nat.eqb i j); reflexivity.
Qed.
