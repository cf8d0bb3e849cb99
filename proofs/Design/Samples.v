(** Phi_k and P^n enclosed in fixed point, sample after sample: the norm bound eqL3 from finitely
    many of them, or a vector on which one exceeds 1.

    A cell (c, e) holds a vector y where |scale y_i - c_i| <= e. *)
From Coq Require Import Reals ZArith List Bool Lia Lra.
From Fomas Require Import Model.Vectors Model.Kernel Model.Graph Model.Loop Statements.
From Fomas Require Import Facts.Sums Facts.Vectors Facts.Kernel Facts.Resolvent Facts.Graph Facts.Phi.
From Fomas Require Import Results.ClosedLoop Results.NormBound.
From Fomas Require Import Design.Integers Design.Weights Design.Claims Design.Directions.
Open Scope R_scope.

Definition cell := (list Z * Z)%type.
Definition pair_at (l : list (Z * Z)) (k : nat) : Z * Z := nth k l (0, 0)%Z.
Definition cell_at (l : list cell) (k : nat) : cell := nth k l (nil, 0%Z).

Section Kernel.
Variables (scale : Z) (alpha : R).
Hypotheses (Hs : (0 < scale)%Z) (Ha : 0 < alpha < 1).

(** n^alpha, (n+1)^alpha, ... lie between the given quotients. *)
Fixpoint powers_within (n : nat) (l : list (Z * Z)) : Prop :=
  match l with
  | nil => True
  | (p, q) :: rest => (IZR p / IZR scale <= Rpower (INR n) alpha <= IZR q / IZR scale)
                      /\ powers_within (S n) rest
  end.

Lemma powers_at l : forall n k, (k < length l)%nat -> powers_within n l ->
  IZR (fst (pair_at l k)) <= IZR scale * Rpower (INR (n + k)) alpha <= IZR (snd (pair_at l k)).
Proof.
  assert (S0 := IZR_lt _ _ Hs).
  induction l as [|[p q] rest IH]; intros n k Hk H; simpl in Hk; [lia|]. destruct H as [[L U] H].
  destruct k as [|k].
  - rewrite Nat.add_0_r. unfold pair_at. simpl.
    apply Rmult_le_compat_l with (r := IZR scale) in L; [|lra].
    apply Rmult_le_compat_l with (r := IZR scale) in U; [|lra].
    replace (IZR scale * (IZR p / IZR scale)) with (IZR p) in L by (field; lra).
    replace (IZR scale * (IZR q / IZR scale)) with (IZR q) in U by (field; lra). lra.
  - replace (n + S k)%nat with (S n + k)%nat by lia. apply (IH (S n) k ltac:(lia) H).
Qed.

(** c_n, from the powers of 1, 2, 3, ... *)
Definition c_low (l : list (Z * Z)) (n : nat) : Z :=
  match n with O => scale | S k => fst (pair_at l n) - snd (pair_at l k) end%Z.
Definition c_high (l : list (Z * Z)) (n : nat) : Z :=
  match n with O => scale | S k => snd (pair_at l n) - fst (pair_at l k) end%Z.

Lemma c_within l n : powers_within 1 l -> (n < length l)%nat ->
  IZR (c_low l n) <= IZR scale * ck alpha n <= IZR (c_high l n).
Proof.
  intros H Hn. destruct n as [|k]; [rewrite ck_0; simpl; lra|]. unfold c_low, c_high.
  assert (A := powers_at l 1 (S k) Hn H). assert (B := powers_at l 1 k ltac:(lia) H).
  rewrite !minus_IZR. unfold ck. rewrite !rpow_pos.
  - replace (INR (S k) + 1) with (INR (1 + S k)) by (rewrite plus_INR; simpl; ring).
    change (INR (1 + k)) with (INR (S k)) in B. lra.
  - apply lt_0_INR. lia.
  - assert (P := pos_INR (S k)). lra.
Qed.

(** r_n between r's numbers: those of |f(l)| = c_{l-1} - c_l give them one by one. *)
Definition resolvent_check (l r : list (Z * Z)) (K : nat) : bool :=
  ((K <? length l)%nat && (fst (pair_at r 0) <=? scale)%Z && (scale <=? snd (pair_at r 0))%Z
   && below (S K) (fun k => (0 <=? fst (pair_at r k))%Z)
   && below K (fun l' => (0 <=? c_low l l' - c_high l (S l'))%Z)
   && below K (fun k =>
        (scale * fst (pair_at r (S k)) <=?
           zsum (S k) (fun i => (c_low l i - c_high l (S i)) * fst (pair_at r (k - i))))%Z
        && (zsum (S k) (fun i => (c_high l i - c_low l (S i)) * snd (pair_at r (k - i)))
           <=? scale * snd (pair_at r (S k)))%Z))%bool.

Lemma r_within l r K : powers_within 1 l -> resolvent_check l r K = true -> forall k, (k <= K)%nat ->
  IZR (fst (pair_at r k)) <= IZR scale * rk alpha k <= IZR (snd (pair_at r k)).
Proof.
  intros Hl H. unfold resolvent_check in H. repeat (apply andb_prop in H; destruct H as [H ?B]).
  apply Nat.ltb_lt in H. apply Z.leb_le, IZR_le in B3, B2. assert (S0 := IZR_lt _ _ Hs).
  induction k as [k IH] using lt_wf_ind. intros Hk. destruct k as [|k]; [rewrite rk_0; lra|].
  apply (below_true K _ B) in Hk as C. apply andb_prop in C. destruct C as [C1 C2].
  apply Z.leb_le, IZR_le in C1, C2. rewrite mult_IZR, zsum_real in C1, C2. rewrite rk_S.
  assert (term : forall i, (i < S k)%nat ->
    IZR ((c_low l i - c_high l (S i)) * fst (pair_at r (k - i)))
    <= IZR scale * IZR scale * (- fk alpha (S i) * rk alpha (k - i))
    <= IZR ((c_high l i - c_low l (S i)) * snd (pair_at r (k - i)))).
  { intros i Hi. assert (R := IH (k - i)%nat ltac:(lia) ltac:(lia)). rewrite fk_ck.
    assert (X := c_within l i Hl ltac:(lia)). assert (Y := c_within l (S i) Hl ltac:(lia)).
    assert (F0 := below_true K _ B0 i ltac:(lia)). apply Z.leb_le, IZR_le in F0.
    assert (R0 := below_true (S K) _ B1 (k - i)%nat ltac:(lia)). apply Z.leb_le, IZR_le in R0.
    rewrite !mult_IZR, !minus_IZR in *.
    replace (IZR scale * IZR scale * (- (ck alpha (S i) - ck alpha i) * rk alpha (k - i)))
      with ((IZR scale * ck alpha i - IZR scale * ck alpha (S i)) * (IZR scale * rk alpha (k - i))) by ring.
    split; apply Rmult_le_compat; lra. }
  assert (E : IZR scale * IZR scale * - (\sum_(i < S k) (fk alpha (S i) * rk alpha (k - i)))
              = \sum_(i < S k) (IZR scale * IZR scale * (- fk alpha (S i) * rk alpha (k - i)))).
  { rewrite sum_scal, <- sum_opp. f_equal. apply sum_ext. intros; ring. }
  assert (L := sum_le (S k) _ _ (fun i Hi => proj1 (term i Hi))).
  assert (U := sum_le (S k) _ _ (fun i Hi => proj2 (term i Hi))).
  rewrite <- E in L, U. split; apply Rmult_le_reg_l with (IZR scale); lra.
Qed.
End Kernel.

Section Cells.
Variables (N : nat) (W : zmat) (d lo hi m scale : Z) (mu : R).
Hypotheses (Hd : (0 < d)%Z) (Hm : (0 < m)%Z) (Hs : (0 < scale)%Z) (Hlo : (0 <= lo)%Z).
Hypothesis Hmu : IZR lo / IZR m <= mu <= IZR hi / IZR m.
Let A := weighted W d.

Definition holds (c : cell) (y : vec) : Prop := forall i, (i < N)%nat ->
  Rabs (IZR scale * y i - IZR (nth i (fst c) 0%Z)) <= IZR (snd c).

Definition row_size (i : nat) : Z := zsum N (fun j => Z.abs (entry (laplacian_table N W) i j)).

(** From y to P y + rho v, rho between r's numbers over the scale. *)
Definition step_check (v : list Z) (r : Z * Z) (c c' : cell) : bool := below N (fun i =>
  let ci := nth i (fst c) 0 in let vi := nth i v 0 in
  (Z.abs (m * d * (ci + fst r * vi - nth i (fst c') 0) - lo * moved N W (fst c) i)
   + (hi - lo) * Z.abs (moved N W (fst c) i) + (m * d + hi * row_size i) * snd c
   + m * d * (snd r - fst r) * Z.abs vi <=? m * d * snd c'))%Z.

Lemma step_sound v r rho c c' y : holds c y -> IZR (fst r) <= IZR scale * rho <= IZR (snd r) ->
  step_check v r c c' = true -> holds c' (fun i => mv N (perron N A mu) y i + rho * vector v i).
Proof.
  intros H Hr C i Hi. assert (B := below_true N _ C i Hi). clear C. apply Z.leb_le, IZR_le in B.
  cbv zeta in B.
  rewrite !plus_IZR, !mult_IZR, !abs_IZR, minus_IZR, !mult_IZR, !minus_IZR, plus_IZR, mult_IZR in B.
  rewrite (plus_IZR (m * d)), !mult_IZR in B.
  assert (D := IZR_lt _ _ Hd). assert (M := IZR_lt _ _ Hm). assert (L := IZR_le _ _ Hlo).
  set (S0 := IZR scale) in *. set (delta := fun j => S0 * y j - vector (fst c) j).
  assert (Hdelta : forall j, (j < N)%nat -> Rabs (delta j) <= IZR (snd c)) by (intros j Hj; apply (H j Hj)).
  assert (spread : Rabs (IZR d * mv N (laplacian N A) delta i) <= IZR (row_size i) * IZR (snd c)).
  { unfold A. rewrite <- (mv_laplacian_table N W d Hd delta i Hi). unfold row_size. rewrite zsum_real.
    eapply Rle_trans; [apply sum_abs|]. rewrite <- sum_scal_r. apply sum_le. intros j Hj.
    rewrite Rabs_mult, abs_IZR. apply Rmult_le_compat_l; [apply Rabs_pos|apply Hdelta, Hj]. }
  assert (E : S0 * mv N (laplacian N A) y i
              = mv N (laplacian N A) (vector (fst c)) i + mv N (laplacian N A) delta i).
  { rewrite <- mv_scal, <- mv_plus. apply mv_ext. intros j _. unfold delta. ring. }
  assert (X := moved_real N W d Hd (fst c) i Hi). fold A in X.
  rewrite perron_entry by exact Hi.
  set (ci := IZR (nth i (fst c) 0%Z)) in *. set (vi := IZR (nth i v 0%Z)) in *.
  set (Mi := IZR (moved N W (fst c) i)) in *. set (Di := IZR d * mv N (laplacian N A) delta i) in *.
  assert (T : IZR m * IZR d * (S0 * (y i - mu * mv N (laplacian N A) y i + rho * vector v i)
                - IZR (nth i (fst c') 0%Z))
    = (IZR m * IZR d * (ci + IZR (fst r) * vi - IZR (nth i (fst c') 0%Z)) - IZR lo * Mi)
      + IZR m * IZR d * delta i + - (IZR m * mu - IZR lo) * Mi + - (IZR m * mu) * Di
      + IZR m * IZR d * ((S0 * rho - IZR (fst r)) * vi)).
  { replace (S0 * (y i - mu * mv N (laplacian N A) y i + rho * vector v i))
      with (S0 * y i - mu * (S0 * mv N (laplacian N A) y i) + S0 * rho * vi) by (unfold vi, vector; ring).
    rewrite E. unfold Di. rewrite X. unfold delta, vector. fold ci. ring. }
  assert (U1 : IZR lo <= IZR m * mu).
  { replace (IZR lo) with (IZR m * (IZR lo / IZR m)) by (field; lra). apply Rmult_le_compat_l; lra. }
  assert (U2 : IZR m * mu <= IZR hi).
  { replace (IZR hi) with (IZR m * (IZR hi / IZR m)) by (field; lra). apply Rmult_le_compat_l; lra. }
  assert (MD : 0 < IZR m * IZR d) by (apply Rmult_lt_0_compat; assumption).
  apply Rmult_le_reg_l with (IZR m * IZR d); [exact MD|].
  rewrite <- (Rabs_right (IZR m * IZR d)) at 1 by lra. rewrite <- Rabs_mult, T.
  eapply Rle_trans; [|exact B].
  eapply Rle_trans; [apply Rabs_triang|]. apply Rplus_le_compat.
  2: { rewrite Rabs_mult, (Rabs_right (IZR m * IZR d)) by lra.
       rewrite (Rmult_assoc (IZR m * IZR d) (_ - _)). apply Rmult_le_compat_l; [lra|]. rewrite Rabs_mult. apply Rmult_le_compat_r; [apply Rabs_pos|].
       rewrite Rabs_right; lra. }
  eapply Rle_trans; [apply Rabs_triang|].
  apply Rle_trans with ((Rabs (IZR m * IZR d * (ci + IZR (fst r) * vi - IZR (nth i (fst c') 0%Z))
      - IZR lo * Mi) + (IZR hi - IZR lo) * Rabs Mi + IZR m * IZR d * IZR (snd c))
      + IZR hi * (IZR (row_size i) * IZR (snd c))); [|right; ring].
  apply Rplus_le_compat.
  2: { rewrite Rabs_mult, Rabs_Ropp, (Rabs_right (IZR m * mu)) by lra.
       apply Rmult_le_compat; try apply Rabs_pos; try lra. }
  eapply Rle_trans; [apply Rabs_triang|].
  rewrite (Rabs_mult (- (IZR m * mu - IZR lo))), Rabs_Ropp, (Rabs_right (IZR m * mu - IZR lo)) by lra.
  assert (Q1 : (IZR m * mu - IZR lo) * Rabs Mi <= (IZR hi - IZR lo) * Rabs Mi)
    by (apply Rmult_le_compat_r; [apply Rabs_pos|lra]).
  assert (Q2 := Rabs_triang (IZR m * IZR d * (ci + IZR (fst r) * vi - IZR (nth i (fst c') 0%Z)) - IZR lo * Mi)
                  (IZR m * IZR d * delta i)).
  rewrite (Rabs_mult (IZR m * IZR d)), (Rabs_right (IZR m * IZR d)) in Q2 by lra.
  assert (Q3 : IZR m * IZR d * Rabs (delta i) <= IZR m * IZR d * IZR (snd c))
    by (apply Rmult_le_compat_l; [lra|apply Hdelta, Hi]). lra.
Qed.

Lemma holds_ext c y z : (forall i, (i < N)%nat -> y i = z i) -> holds c y -> holds c z.
Proof. intros E H i Hi. rewrite <- E by exact Hi. apply H, Hi. Qed.

(** Phi_0 v, ..., Phi_K v with the resolvent's numbers r, and P^0 v, ..., P^K v without. *)
Definition start_check (v : list Z) (c : cell) : bool := below N (fun i =>
  Z.abs (scale * nth i v 0 - nth i (fst c) 0) <=? snd c)%Z.
Definition phi_check (v : list Z) (r : list (Z * Z)) (cells : list cell) (K : nat) : bool :=
  (start_check v (cell_at cells 0) && below K (fun k =>
     step_check v (pair_at r (S k)) (cell_at cells k) (cell_at cells (S k))))%bool.

Lemma start_sound v c : start_check v c = true -> holds c (vector v).
Proof.
  intros H i Hi. apply (below_true N _ H), Z.leb_le, IZR_le in Hi.
  rewrite abs_IZR, minus_IZR, mult_IZR in Hi. exact Hi.
Qed.

Lemma phi_sound alpha v r cells K : 0 < alpha < 1 ->
  (forall k, (k <= K)%nat -> IZR (fst (pair_at r k)) <= IZR scale * rk alpha k <= IZR (snd (pair_at r k))) ->
  phi_check v r cells K = true ->
  forall k, (k <= K)%nat -> holds (cell_at cells k) (Phi alpha N (perron N A mu) k (vector v)).
Proof.
  intros Ha Hr H. apply andb_prop in H. destruct H as [H0 H]. induction k as [|k IH]; intros Hk.
  - apply holds_ext with (vector v); [intros; symmetry; apply phi_0|apply start_sound, H0].
  - apply holds_ext with (fun i => mv N (perron N A mu) (Phi alpha N (perron N A mu) k (vector v)) i
                                   + rk alpha (S k) * vector v i).
    + intros i Hi. symmetry. apply (proj1 (phi_recursion N (perron N A mu) alpha (vector v) k i Ha Hi)).
    + apply step_sound with (r := pair_at r (S k)) (c := cell_at cells k).
      * apply IH. lia.
      * apply Hr, Hk.
      * apply (below_true K _ H k). lia.
Qed.

Lemma power_sound v cells K : phi_check v nil cells K = true ->
  forall k, (k <= K)%nat -> holds (cell_at cells k) (iter k (mv N (perron N A mu)) (vector v)).
Proof.
  intros H. apply andb_prop in H. destruct H as [H0 H]. induction k as [|k IH]; intros Hk.
  - apply start_sound, H0.
  - apply holds_ext with (fun i => mv N (perron N A mu) (iter k (mv N (perron N A mu)) (vector v)) i
                                   + 0 * vector v i); [intros; simpl; ring|].
    apply step_sound with (r := pair_at nil (S k)) (c := cell_at cells k).
    + apply IH. lia.
    + unfold pair_at. simpl. lra.
    + apply (below_true K _ H k). lia.
Qed.

(** |y| > |v| where the cell of y says so. *)
Definition beyond_check (v : list Z) (c : cell) : bool :=
  (sums_to_zero N v && (scale * scale * size N v <?
     zsum N (fun i => let x := Z.max 0 (Z.abs (nth i (fst c) 0) - snd c) in x * x))%Z)%bool.

Lemma beyond_sound v c y : holds c y -> beyond_check v c = true -> norm N (vector v) < norm N y.
Proof.
  intros H B. apply andb_prop in B. destruct B as [_ B]. apply Z.ltb_lt, IZR_lt in B.
  rewrite !mult_IZR, <- size_real, zsum_real in B. assert (S0 := IZR_lt _ _ Hs).
  apply Rnot_le_lt. intros C.
  assert (C2 := pow_incr _ _ 2 (conj (norm_nonneg _ _) C)). rewrite !norm_pow2 in C2.
  assert (T : \sum_(i < N) IZR (let x := Z.max 0 (Z.abs (nth i (fst c) 0) - snd c) in x * x)%Z
              <= IZR scale * IZR scale * dot N y y).
  { unfold dot. rewrite <- sum_scal. apply sum_le. intros i Hi. specialize (H i Hi). cbv zeta.
    rewrite mult_IZR. set (x := IZR (Z.max 0 _)).
    assert (X : 0 <= x <= IZR scale * Rabs (y i)).
    { unfold x. split; [apply IZR_le; lia|]. apply Z.max_case_strong; intros _.
      - apply Rmult_le_pos; [lra|apply Rabs_pos].
      - rewrite minus_IZR, abs_IZR. assert (Q := Rabs_triang_inv (IZR (nth i (fst c) 0%Z)) (IZR scale * y i)).
        rewrite (Rabs_minus_sym (IZR _)), (Rabs_mult (IZR scale)), (Rabs_right (IZR scale)) in Q by lra. lra. }
    replace (IZR scale * IZR scale * (y i * y i))
      with ((IZR scale * Rabs (y i)) * (IZR scale * Rabs (y i)))
      by (assert (Q := Rsqr_abs (y i)); unfold Rsqr in Q; rewrite Q; ring).
    apply Rmult_le_compat; lra. }
  nra.
Qed.
End Cells.

(** Some ||Phi_k v|| > ||v||. *)
Lemma sample_refutes N W d lo hi m scale alpha mu l r v cells K :
  (0 < d)%Z -> ((0 <? m) && (0 <? scale) && (0 <=? lo))%Z = true ->
  IZR lo / IZR m <= mu <= IZR hi / IZR m -> 0 < alpha < 1 -> powers_within scale alpha 1 l ->
  resolvent_check scale l r K = true -> phi_check N W d lo hi m scale v r cells K = true ->
  beyond_check N scale v (cell_at cells K) = true ->
  ~ bounded_on_1perp N (Phi alpha N (perron N (weighted W d) mu) K) 1.
Proof.
  intros Hd H Hmu Ha Hl Hr Hc Hb B. apply andb_prop in H. destruct H as [H L]. apply andb_prop in H.
  destruct H as [M S0]. apply Z.ltb_lt in M, S0. apply Z.leb_le in L.
  assert (Z := proj1 (andb_prop _ _ Hb)). apply sums_to_zero_sound in Z.
  specialize (B _ Z). rewrite Rmult_1_l in B. apply Rle_not_lt in B. apply B.
  apply (beyond_sound N scale S0 v (cell_at cells K)); [|exact Hb].
  apply (phi_sound N W d lo hi m scale mu Hd M L Hmu alpha v r cells K Ha); auto.
  apply (r_within scale alpha S0 l r K Hl Hr).
Qed.
