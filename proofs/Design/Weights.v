(** A graph given by integer weights over a common denominator: what computation decides of it. *)
From Coq Require Import Reals ZArith List Bool Lia Lra.
From Fomas Require Import Model.Vectors Model.Graph Model.Loop Facts.Sums Facts.Vectors Facts.Forms Facts.Graph.
From Fomas Require Import Design.Integers.
Open Scope R_scope.

(** a_ij = W_ij / d. *)
Definition weighted (W : zmat) (d : Z) : mat := fun i j => IZR (entry W i j) / IZR d.

Definition row_sum (N : nat) (W : zmat) (i : nat) : Z := zsum N (entry W i).
Definition column_sum (N : nat) (W : zmat) (i : nat) : Z := zsum N (fun j => entry W j i).

Definition digraph_check (N : nat) (W : zmat) : bool := below N (fun i =>
  below N (fun j => 0 <=? entry W i j)%Z && (entry W i i =? 0)%Z)%bool.
Definition balance_check (N : nat) (W : zmat) : bool :=
  below N (fun i => row_sum N W i =? column_sum N W i)%Z.
Definition bit (s : list bool) (i : nat) : bool := nth i s false.
Definition spread (N : nat) (W : zmat) (s : list bool) : list bool :=
  map (fun k => bit s k || existsb (fun j => bit s j && (0 <? entry W k j)%Z) (seq 0 N))%bool
    (seq 0 N).
Definition reached (N : nat) (W : zmat) (i : nat) : list bool :=
  Nat.iter N (spread N W) (map (Nat.eqb i) (seq 0 N)).
Definition connected_check (N : nat) (W : zmat) : bool :=
  below N (fun i => let s := reached N W i in below N (bit s)).
(** A set of agents, s, that holds i and not j and that nobody outside hears. *)
Definition separated_check (N : nat) (W : zmat) (s : list bool) (i j : nat) : bool :=
  (Nat.ltb i N && Nat.ltb j N && bit s i && negb (bit s j) && below N (fun k => below N (fun l =>
     negb (bit s k) || bit s l || negb (0 <? entry W l k)%Z)))%bool.
Definition degree_check (N : nat) (W : zmat) (D : Z) : bool :=
  ((0 <? D)%Z && below N (fun i => row_sum N W i <=? D)%Z
   && existsb (fun i => row_sum N W i =? D)%Z (seq 0 N))%bool.

Section Weights.
Variables (N : nat) (W : zmat) (d : Z).
Hypothesis Hd : (0 < d)%Z.
Let A := weighted W d.

Lemma denominator_pos : 0 < IZR d.
Proof. apply IZR_lt, Hd. Qed.

Lemma weight_pos i j : (0 < entry W i j)%Z -> 0 < A i j.
Proof.
  intros H. apply Rdiv_lt_0_compat; [apply IZR_lt, H|apply denominator_pos].
Qed.

Lemma weight_pos_inv i j : 0 < A i j -> (0 < entry W i j)%Z.
Proof.
  intros H. apply lt_IZR. assert (P := denominator_pos).
  replace (IZR (entry W i j)) with (A i j * IZR d) by (unfold A, weighted; field; lra). nra.
Qed.

Lemma weighted_row i : \sum_(j < N) A i j = IZR (row_sum N W i) / IZR d.
Proof.
  unfold A, weighted, row_sum, Rdiv. rewrite zsum_real, <- sum_scal_r. reflexivity.
Qed.

Lemma weighted_column i : \sum_(j < N) A j i = IZR (column_sum N W i) / IZR d.
Proof.
  unfold A, weighted, column_sum, Rdiv. rewrite zsum_real, <- sum_scal_r. reflexivity.
Qed.

Lemma digraph_sound : digraph_check N W = true -> digraph N A.
Proof.
  intros H. assert (P := denominator_pos). split.
  - intros i j Hi Hj. apply (below_true N _ H), andb_prop in Hi. destruct Hi as [Hi _].
    apply (below_true N _ Hi), Z.leb_le, IZR_le in Hj. apply Rle_mult_inv_pos; assumption.
  - intros i Hi. apply (below_true N _ H), andb_prop in Hi. destruct Hi as [_ Hi].
    apply Z.eqb_eq in Hi. unfold A, weighted. rewrite Hi. field. lra.
Qed.

Lemma balance_sound : balance_check N W = true -> balanced N A.
Proof.
  intros H i Hi. apply (below_true N _ H), Z.eqb_eq in Hi.
  rewrite weighted_row, weighted_column, Hi. reflexivity.
Qed.

Lemma imbalance_sound i : (i < N)%nat -> (row_sum N W i =? column_sum N W i)%Z = false ->
  ~ balanced N A.
Proof.
  intros Hi H B. apply Z.eqb_neq in H. apply H, eq_IZR. specialize (B i Hi).
  rewrite weighted_row, weighted_column in B. assert (P := denominator_pos).
  apply Rmult_eq_reg_r with (/ IZR d); [exact B|]. apply Rinv_neq_0_compat. lra.
Qed.

Lemma spread_sound i s : (forall k, (k < N)%nat -> bit s k = true -> reaches N A i k) ->
  forall k, (k < N)%nat -> bit (spread N W s) k = true -> reaches N A i k.
Proof.
  intros H k Hk B. unfold bit, spread in B. rewrite nth_seq in B by exact Hk.
  apply orb_prop in B. destruct B as [B|B]; [apply H; assumption|].
  apply existsb_exists in B. destruct B as [j [Hj B]]. apply in_seq in Hj.
  apply andb_prop in B. destruct B as [B1 B2]. apply Z.ltb_lt in B2.
  apply reaches_edge with j; [apply H; [lia|exact B1]|lia|exact Hk|apply weight_pos, B2].
Qed.

Lemma iter_spread_sound i n j : (j < N)%nat ->
  bit (Nat.iter n (spread N W) (map (Nat.eqb i) (seq 0 N))) j = true -> reaches N A i j.
Proof.
  revert j. induction n as [|n IH]; simpl; [|apply spread_sound, IH].
  intros j Hj R. unfold bit in R. rewrite nth_seq in R by exact Hj. apply Nat.eqb_eq in R. subst j.
  apply reaches_self.
Qed.

Lemma connected_sound : connected_check N W = true -> strongly_connected N A.
Proof.
  intros H i j Hi Hj. apply (below_true N _ H) in Hi. apply (below_true N _ Hi) in Hj as R.
  apply (iter_spread_sound i N j Hj R).
Qed.

Lemma separated_sound s i j : separated_check N W s i j = true -> ~ strongly_connected N A.
Proof.
  intros H C. unfold separated_check in H. repeat (apply andb_prop in H; destruct H as [H ?B]).
  apply Nat.ltb_lt in H. apply Nat.ltb_lt in B2.
  assert (S : forall k, reaches N A i k -> bit s k = true).
  { induction 1 as [|k l _ IH Hk Hl P]; [assumption|]. apply weight_pos_inv in P.
    apply (below_true N _ B) in Hk. apply (below_true N _ Hk) in Hl. apply Z.ltb_lt in P.
    rewrite IH, P in Hl. simpl in Hl. rewrite orb_false_r in Hl. exact Hl. }
  rewrite (S j (C i j H B2)) in B0. discriminate.
Qed.

Lemma degree_sound D : degree_check N W D = true -> degree_max N A = IZR D / IZR d.
Proof.
  intros H. apply andb_prop in H. destruct H as [H E]. apply andb_prop in H. destruct H as [H U].
  apply Z.ltb_lt, IZR_lt in H. assert (P := denominator_pos). apply Rle_antisym.
  - assert (B : forall n, (n <= N)%nat -> max_lt n (degree N A) <= IZR D / IZR d).
    { induction n as [|n IH]; intros Hn; simpl.
      - apply Rlt_le, Rdiv_lt_0_compat; assumption.
      - apply Rmax_lub; [apply IH; lia|]. unfold degree. rewrite weighted_row.
        apply Rmult_le_compat_r; [apply Rlt_le, Rinv_0_lt_compat, P|].
        apply IZR_le, Z.leb_le, (below_true N _ U). lia. }
    apply B. apply le_n.
  - apply existsb_exists in E. destruct E as [i [Hi E]]. apply in_seq in Hi. apply Z.eqb_eq in E.
    rewrite <- E, <- weighted_row. apply (max_lt_ge N (degree N A) i). lia.
Qed.

Lemma assumption1_sound :
  (digraph_check N W && connected_check N W && balance_check N W)%bool = true -> assumption1 N A.
Proof.
  intros H. apply andb_prop in H. destruct H as [H B]. apply andb_prop in H. destruct H as [H C].
  split; [apply digraph_sound, H|]. split; [apply connected_sound, C|apply balance_sound, B].
Qed.

(** * The Laplacian, times d; P at mu = p/q, times q d. *)

Definition laplacian_table : zmat :=
  table N (fun i j => (if Nat.eqb i j then row_sum N W i else 0) - entry W i j)%Z.
Definition symmetric_table : zmat :=
  let L := laplacian_table in table N (fun i j => entry L i j + entry L j i)%Z.
Definition perron_table (p q : Z) : zmat :=
  let L := laplacian_table in
  table N (fun i j => (if Nat.eqb i j then q * d else 0) - p * entry L i j)%Z.

Lemma laplacian_real i j : (i < N)%nat -> (j < N)%nat ->
  real laplacian_table i j = IZR d * laplacian N A i j.
Proof.
  intros Hi Hj. unfold real, laplacian_table. rewrite entry_table, minus_IZR by assumption.
  unfold laplacian, degree. rewrite weighted_row. assert (P := denominator_pos).
  unfold A, weighted. destruct (Nat.eqb i j); field; lra.
Qed.

Lemma mv_laplacian_table x i : (i < N)%nat ->
  mv N (real laplacian_table) x i = IZR d * mv N (laplacian N A) x i.
Proof.
  intros Hi. unfold mv. rewrite <- sum_scal. apply sum_ext. intros j Hj.
  rewrite laplacian_real by assumption. ring.
Qed.

Lemma form_symmetric_table x :
  form N (real symmetric_table) x = 2 * IZR d * form N (laplacian_sym N A) x.
Proof.
  rewrite (form_mat_ext N _ (fun i j => (2 * IZR d) * laplacian_sym N A i j + 0 * id_mat i j)).
  - rewrite form_linear. ring.
  - intros i j Hi Hj. unfold real, symmetric_table. rewrite entry_table, plus_IZR by assumption.
    change (real laplacian_table i j + real laplacian_table j i
            = 2 * IZR d * laplacian_sym N A i j + 0 * id_mat i j).
    rewrite !laplacian_real by assumption. unfold laplacian_sym. field.
Qed.

Lemma mv_perron_table p q x i : (0 < q)%Z -> (i < N)%nat ->
  mv N (real (perron_table p q)) x i = IZR (q * d) * mv N (perron N A (IZR p / IZR q)) x i.
Proof.
  intros Hq Hi. apply IZR_lt in Hq. unfold mv. rewrite <- sum_scal. apply sum_ext. intros j Hj.
  unfold real, perron_table. rewrite entry_table, minus_IZR, mult_IZR by assumption.
  fold (real laplacian_table i j). rewrite laplacian_real by assumption.
  rewrite mult_IZR. unfold perron, id_mat. destruct (Nat.eqb i j); [rewrite mult_IZR|]; field; lra.
Qed.
End Weights.
