(** perron-eigenvalues, decided by integers: powers with a trace that is too great, a form that
    does not fall, a form that does. n + 1 agents; the tables act on the n differences. *)
From Coq Require Import Reals ZArith List Bool Lia Lra.
From Coquelicot Require Import Coquelicot.
From Fomas Require Import Model.Vectors Model.Graph Model.Loop Model.Coordinates Statements.
From Fomas Require Import Facts.Sums Facts.Vectors Facts.Forms.
From Fomas Require Import Results.Stability Results.Spectrum Results.Refutation.
From Fomas Require Import Design.Integers Design.Weights Design.Claims.
Open Scope R_scope.

(** * Products and powers *)

Definition times (n : nat) (M B : zmat) : zmat :=
  table n (fun i j => zsum n (fun k => entry M i k * entry B k j)%Z).
Fixpoint power (n : nat) (M : zmat) (p : positive) : zmat :=
  match p with
  | xH => M
  | xO q => let S := power n M q in times n S S
  | xI q => let S := power n M q in times n M (times n S S)
  end.
Definition trace (n : nat) (M : zmat) : Z := zsum n (fun i => entry M i i).

Lemma times_real n M B x i : (i < n)%nat ->
  mv n (real (times n M B)) x i = mv n (real M) (mv n (real B) x) i.
Proof.
  intros Hi. unfold mv.
  transitivity (\sum_(j < n) \sum_(k < n) (real M i k * (real B k j * x j))).
  - apply sum_ext. intros j Hj. unfold real at 1, times. rewrite entry_table, zsum_real by assumption.
    rewrite <- sum_scal_r. apply sum_ext. intros k _. rewrite mult_IZR. unfold real. ring.
  - rewrite sum_swap. apply sum_ext. intros k _. apply sum_scal.
Qed.

Lemma power_real n M p : forall x i, (i < n)%nat ->
  mv n (real (power n M p)) x i = iter (Pos.to_nat p) (mv n (real M)) x i.
Proof.
  assert (double : forall q, (forall x i, (i < n)%nat ->
    mv n (real (power n M q)) x i = iter (Pos.to_nat q) (mv n (real M)) x i) ->
    forall x i, (i < n)%nat -> mv n (real (times n (power n M q) (power n M q))) x i
      = iter (Pos.to_nat q + Pos.to_nat q) (mv n (real M)) x i).
  { intros q IH x i Hi. rewrite times_real, iter_plus, IH by exact Hi. apply iter_mv_ext; [|exact Hi].
    intros j Hj. apply IH, Hj. }
  induction p as [q IH|q IH|]; intros x i Hi.
  - change (power n M q~1) with (times n M (times n (power n M q) (power n M q))).
    rewrite times_real by exact Hi. replace (Pos.to_nat q~1) with (S (Pos.to_nat q + Pos.to_nat q)) by lia.
    simpl iter. apply mv_ext. intros j Hj. apply double; assumption.
  - change (power n M q~0) with (times n (power n M q) (power n M q)).
    replace (Pos.to_nat q~0) with (Pos.to_nat q + Pos.to_nat q)%nat by lia. apply double; assumption.
  - reflexivity.
Qed.

(** * Sums of squares: K M = F^T diag(w) F with K > 0 and w >= 0, exactly *)

Definition squares (n : nat) (M F : zmat) (w : list Z) (K : Z) : bool :=
  ((0 <? K)%Z && below n (fun k => (0 <=? nth k w 0)%Z) && below n (fun i => below n (fun j =>
     (K * entry M i j =? zsum n (fun k => nth k w 0 * (entry F k i * entry F k j)))%Z)))%bool.

Lemma squares_sound n M F w K : squares n M F w K = true -> forall x, 0 <= form n (real M) x.
Proof.
  intros H x. apply andb_prop in H. destruct H as [H E]. apply andb_prop in H. destruct H as [HK Hw].
  apply Z.ltb_lt, IZR_lt in HK. apply Rmult_le_reg_l with (IZR K); [exact HK|]. rewrite Rmult_0_r.
  replace (IZR K * form n (real M) x)
    with (\sum_(k < n) (IZR (nth k w 0%Z) * (mv n (real F) x k * mv n (real F) x k))).
  - apply sum_nonneg. intros k Hk. apply Rmult_le_pos; [|apply Rle_0_sqr].
    apply IZR_le, Z.leb_le, (below_true n _ Hw k Hk).
  - rewrite form_double_sum, <- sum_scal.
    transitivity (\sum_(k < n) \sum_(i < n) \sum_(j < n)
      (IZR (nth k w 0%Z) * (real F k i * real F k j) * (x i * x j))).
    + apply sum_ext. intros k _. unfold mv. rewrite <- sum_scal_r, <- sum_scal. apply sum_ext. intros i _.
      rewrite <- !sum_scal. apply sum_ext. intros j _. ring.
    + rewrite sum_swap. apply sum_ext. intros i Hi. rewrite sum_swap, <- sum_scal. apply sum_ext.
      intros j Hj. apply (below_true n _ E) in Hi. apply (below_true n _ Hi), Z.eqb_eq in Hj.
      rewrite sum_scal_r. rewrite (sum_ext n _ (fun k => IZR (nth k w 0%Z * (entry F k i * entry F k j)))).
      * rewrite <- zsum_real, <- Hj, mult_IZR. unfold real. ring.
      * intros k _. rewrite !mult_IZR. unfold real. ring.
Qed.

(** * The differences *)

Section Certificate.
Variables (n : nat) (W : zmat) (d : Z).
Hypothesis Hd : (0 < d)%Z.
Let A := weighted W d.

(** q d Pc(p/q). *)
Definition step_table (p q : Z) : zmat :=
  let L := laplacian_table (S n) W in table n (fun i j =>
    (if Nat.eqb i j then q * d else 0) - p * (entry L i j - entry L n j))%Z.

Lemma step_real p q i j : (0 < q)%Z -> (i < n)%nat -> (j < n)%nat ->
  real (step_table p q) i j = IZR (q * d) * differences_step n A (IZR p / IZR q) i j.
Proof.
  intros Hq Hi Hj. apply IZR_lt in Hq. unfold real, step_table.
  rewrite entry_table, minus_IZR, mult_IZR, minus_IZR by assumption.
  change (IZR (if Nat.eqb i j then q * d else 0) - IZR p * (real (laplacian_table (S n) W) i j
            - real (laplacian_table (S n) W) n j)
          = IZR (q * d) * differences_step n A (IZR p / IZR q) i j).
  rewrite !(laplacian_real (S n) W d Hd) by lia. rewrite mult_IZR.
  unfold differences_step, differences_laplacian, id_mat. fold A.
  destruct (Nat.eqb i j); [rewrite mult_IZR|]; field; lra.
Qed.

Lemma mv_step p q x i : (0 < q)%Z -> (i < n)%nat ->
  mv n (real (step_table p q)) x i = IZR (q * d) * mv n (differences_step n A (IZR p / IZR q)) x i.
Proof.
  intros Hq Hi. unfold mv. rewrite <- sum_scal. apply sum_ext. intros j Hj.
  rewrite step_real by assumption. ring.
Qed.

Lemma iter_step p q k x : (0 < q)%Z -> forall i, (i < n)%nat ->
  iter k (mv n (real (step_table p q))) x i
  = IZR (q * d) ^ k * iter k (mv n (differences_step n A (IZR p / IZR q))) x i.
Proof.
  intros Hq. induction k as [|k IH]; intros i Hi; simpl; [ring|].
  rewrite (mv_ext n _ _ _ i IH), mv_scal, mv_step by assumption. ring.
Qed.

(** abs trace(Pc(p/q)^m) > n. *)
Definition trace_check (p q : Z) (m : positive) : bool :=
  ((0 <? p) && (0 <? q)
   && (Z.of_nat n * (q * d) ^ Zpos m <? Z.abs (trace n (power n (step_table p q) m))))%Z%bool.

Lemma trace_sound p q m mu : trace_check p q m = true -> IZR p / IZR q <= mu ->
  ~ perron_spectrum (S n) A mu.
Proof.
  intros H Hmu. apply andb_prop in H. destruct H as [H T]. apply andb_prop in H. destruct H as [Hp Hq].
  apply Z.ltb_lt in Hp, Hq, T. assert (P := IZR_lt _ _ Hp). assert (Q := IZR_lt _ _ Hq).
  apply (trace_test n A (IZR p / IZR q) mu (Pos.to_nat m)).
  2: { split; [apply Rdiv_lt_0_compat; assumption|exact Hmu]. }
  set (k := Pos.to_nat m) in *. set (s := IZR (q * d)).
  assert (S0 : 0 < s) by (unfold s; apply IZR_lt; lia). assert (Sk := pow_lt s k S0).
  assert (E : IZR (trace n (power n (step_table p q) m))
    = s ^ k * \sum_(i < n) iter k (mv n (differences_step n A (IZR p / IZR q))) (id_mat i) i).
  { unfold trace. rewrite zsum_real, <- sum_scal. apply sum_ext. intros i Hi.
    unfold s, k. rewrite <- iter_step, <- power_real by assumption.
    etransitivity; [symmetry; apply (id_mat_sum n i (fun j => real (power n (step_table p q) m) i j) Hi)|].
    apply sum_ext. intros j _. rewrite Rmult_comm. reflexivity. }
  apply IZR_lt in T. rewrite abs_IZR, E, Rabs_mult, (Rabs_right (s ^ k)), mult_IZR in T by lra.
  apply Rmult_lt_reg_l with (s ^ k); [exact Sk|]. eapply Rle_lt_trans; [|exact T].
  rewrite <- INR_IZR_INZ, Rmult_comm. right. f_equal. unfold s, k.
  rewrite pow_IZR, positive_nat_Z. reflexivity.
Qed.

Definition symmetric_check (Q : zmat) : bool :=
  below n (fun i => below n (fun j => entry Q i j =? entry Q j i)%Z).

Lemma symmetric_sound Q : symmetric_check Q = true -> symmetric n (real Q).
Proof.
  intros H i j Hi Hj. apply (below_true n _ H) in Hi. apply (below_true n _ Hi), Z.eqb_eq in Hj.
  unfold real. rewrite Hj. reflexivity.
Qed.

(** a Q - b B^T Q B - c I, with B = q d Pc: stein of Integers.v where nothing is added. *)
Lemma form_stein_differences Q p q a b c x : (0 < q)%Z ->
  form n (real (stein n Q (step_table p q) a b c 0)) x
  = IZR a * form n (real Q) x
    - IZR b * (IZR (q * d) ^ 2 * form n (real Q) (mv n (differences_step n A (IZR p / IZR q)) x))
    - IZR c * dot n x x.
Proof.
  intros Hq. rewrite form_stein_any, Rmult_0_l, Rplus_0_r.
  rewrite (form_ext n (real Q) (mv n (real _) x)
    (fun i => IZR (q * d) * mv n (differences_step n A (IZR p / IZR q)) x i))
    by (intros; apply mv_step; assumption).
  rewrite form_scal. reflexivity.
Qed.

(** Y >= 0, an entry of Y is not 0, and Pc^T Y Pc - Y >= 0, both as sums of squares. *)
Definition persistent_check (Y : zmat) (p q : Z) (i j : nat) : bool :=
  (symmetric_check Y && (0 <? p)%Z && (0 <? q)%Z && Nat.ltb i n && Nat.ltb j n
   && negb (entry Y i j =? 0)%Z)%bool.

Lemma persistence_sound Y p q i j F1 w1 K1 F2 w2 K2 mu : persistent_check Y p q i j = true ->
  squares n Y F1 w1 K1 = true ->
  squares n (stein n Y (step_table p q) (- (q * d * (q * d))) (-1) 0 0) F2 w2 K2 = true ->
  IZR p / IZR q <= mu -> ~ perron_spectrum (S n) A mu.
Proof.
  intros H S1 S2 Hmu. unfold persistent_check in H. repeat (apply andb_prop in H; destruct H as [H ?B]).
  apply Z.ltb_lt in B3, B2. apply Nat.ltb_lt in B1, B0. apply negb_true_iff, Z.eqb_neq in B.
  assert (P := IZR_lt _ _ B3). assert (Q := IZR_lt _ _ B2).
  assert (D : 0 < IZR (q * d)) by (apply IZR_lt; lia).
  apply (persistence_test n A (real Y) (IZR p / IZR q) mu).
  - apply symmetric_sound, H.
  - intros y. apply (squares_sound n Y F1 w1 K1 S1).
  - exists i, j. split; [exact B1|]. split; [exact B0|]. intros C. apply B, eq_IZR. exact C.
  - intros y. assert (N := squares_sound n _ F2 w2 K2 S2 y). rewrite form_stein_differences in N by exact B2.
    rewrite (form_mat_ext n _ (fun i j => (-1) * stein_form n (real Y) (differences_step n A (IZR p / IZR q)) i j
                                          + 0 * real Y i j)) by (intros; ring).
    rewrite form_linear, form_stein_form. rewrite opp_IZR, !mult_IZR in N. rewrite mult_IZR in D.
    apply Rmult_le_reg_l with ((IZR q * IZR d) ^ 2); [nra|]. lra.
  - split; [apply Rdiv_lt_0_compat; assumption|exact Hmu].
Qed.

(** Q > 0 and Q - Pc^T Q Pc > 0, by factors with a residual. *)
Lemma falling_sound Q p q c F1 K1 eps1 c' F2 K2 eps2 mu :
  (symmetric_check Q && (0 <? q) && (0 <? c) && (0 <? c'))%Z%bool = true ->
  nonnegative n (stein n Q (identity n) 1 0 c 0) F1 K1 eps1 = true ->
  nonnegative n (stein n Q (step_table p q) (q * d * (q * d)) 1 c' 0) F2 K2 eps2 = true ->
  0 < mu <= IZR p / IZR q -> perron_spectrum (S n) A mu.
Proof.
  intros H M1 M2 Hmu. repeat (apply andb_prop in H; destruct H as [H ?B]).
  apply Z.ltb_lt in B1. apply Z.ltb_lt, IZR_lt in B0, B.
  assert (D : 0 < IZR (q * d)) by (apply IZR_lt; lia).
  apply (lyapunov_test n A (real Q) (IZR p / IZR q) mu).
  - apply symmetric_sound, H.
  - intros y Hy. assert (N := nonnegative_sound n _ _ _ _ M1 y). rewrite form_stein_any in N. nra.
  - intros y Hy. assert (N := nonnegative_sound n _ _ _ _ M2 y).
    rewrite form_stein_differences in N by exact B1. rewrite form_stein_form.
    rewrite !mult_IZR in N. rewrite mult_IZR in D.
    apply Rmult_lt_reg_l with ((IZR q * IZR d) ^ 2); [nra|]. nra.
  - exact Hmu.
Qed.
End Certificate.

(** * What perron-eigenvalues says of the other claims *)

Lemma no_spectrum_consensus N A alpha gamma h : (2 <= N)%nat -> assumption1 N A ->
  design alpha gamma h -> ~ perron_spectrum N A (mu_of alpha gamma h) ->
  ~ average_consensus N A alpha gamma h.
Proof.
  intros HN H1 D NS H. apply NS, (proj2 (claims_are_one N A alpha gamma h HN H1 D)), H.
Qed.

Lemma no_spectrum_control N A alpha gamma h : (2 <= N)%nat -> assumption1 N A ->
  design alpha gamma h -> ~ perron_spectrum N A (mu_of alpha gamma h) ->
  ~ control_bounded N A alpha gamma h.
Proof.
  intros HN H1 D NS [B H]. apply NS, (proj1 (claims_are_one N A alpha gamma h HN H1 D)).
  intros x0 x u L. apply (H x0 x u L).
Qed.

Lemma no_spectrum_norm_bound N A alpha gamma h t : (2 <= N)%nat -> assumption1 N A ->
  design alpha gamma h -> 0 < t < mu_of alpha gamma h -> ~ perron_spectrum N A t ->
  ~ control_norm_bound N A alpha gamma h.
Proof. intros HN H1 D Ht NS H. exact (NS (eqL3_needs_spectrum N A alpha gamma h t HN H1 D H Ht)). Qed.
