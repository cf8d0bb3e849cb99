(** The plant at and between the samples, and the closed loop. *)
From Coq Require Import Reals Arith Lia Lra.
From Coquelicot Require Import Coquelicot.
From Fomas Require Import Model.Vectors Model.Kernel Model.Gamma Model.Graph Model.Loop.
From Fomas Require Import Facts.Sums Facts.Vectors Facts.Kernel Facts.Resolvent Facts.Gamma Facts.Graph.
Open Scope R_scope.

Section Plant.
Variables (N : nat) (alpha h : R) (x0 : vec) (u : nat -> vec) (x : R -> vec).
Hypothesis Ha : 0 < alpha < 1.
Hypothesis Hh : 0 < h.
Hypothesis Hx : plant N alpha h x0 u x.

Lemma INR_h_le j k : (j <= k)%nat -> INR j * h <= INR k * h.
Proof. intros H. apply Rmult_le_compat_r; [lra|apply le_INR, H]. Qed.

Lemma plant_inside k s i : (i < N)%nat -> 0 < s <= h ->
  x (INR k * h + s) i = x0 i + / Gamma (alpha + 1) *
    (\sum_(j < k) ((rpow (INR (k - j) * h + s) alpha
                    - rpow (INR (k - j - 1) * h + s) alpha) * u j i)
     + rpow s alpha * u k i).
Proof.
  intros Hi Hs. rewrite (proj2 Hx k s i Hi Hs). f_equal.
  rewrite Gamma_succ by lra. assert (G := Gamma_pos alpha ltac:(lra)).
  rewrite kernel_integral_value by lra.
  rewrite (sum_ext k _ (fun j => / alpha * ((rpow (INR (k - j) * h + s) alpha
                    - rpow (INR (k - j - 1) * h + s) alpha) * u j i))).
  - rewrite sum_scal.
    replace (INR k * h + s - INR k * h) with s by ring.
    replace (INR k * h + s - (INR k * h + s)) with 0 by ring.
    rewrite (rpow_nonpos 0) by lra. field. lra.
  - intros j Hj. assert (B := INR_h_le (S j) k ltac:(lia)).
    rewrite kernel_integral_value; [|exact Ha|rewrite S_INR in *; nra].
    replace (INR k * h + s - INR j * h) with (INR (k - j) * h + s)
      by (rewrite minus_INR by lia; ring).
    replace (INR k * h + s - INR (S j) * h) with (INR (k - j - 1) * h + s)
      by (replace (k - j - 1)%nat with (k - S j)%nat by lia; rewrite minus_INR by lia; ring).
    field. lra.
Qed.

(** The same formula holds at the left end of the interval. *)
Lemma plant_between k s i : (i < N)%nat -> 0 <= s <= h ->
  x (INR k * h + s) i = x0 i + / Gamma (alpha + 1) *
    (\sum_(j < k) ((rpow (INR (k - j) * h + s) alpha
                    - rpow (INR (k - j - 1) * h + s) alpha) * u j i)
     + rpow s alpha * u k i).
Proof.
  intros Hi [[Hs| <-] Hsh]; [apply plant_inside; auto; lra|].
  rewrite (rpow_nonpos 0), Rmult_0_l, Rplus_0_r, Rplus_0_r by lra.
  destruct k as [|k].
  - simpl. rewrite Rmult_0_l, (proj1 Hx i Hi). ring.
  - replace (INR (S k) * h) with (INR k * h + h) by (rewrite S_INR; ring).
    rewrite plant_inside by (auto; lra). do 2 f_equal. rewrite sum_last. f_equal.
    + apply sum_ext. intros j Hj.
      replace (INR (S k - j) * h + 0) with (INR (k - j) * h + h)
        by (replace (S k - j)%nat with (S (k - j)) by lia; rewrite S_INR; ring).
      replace (INR (S k - j - 1) * h + 0) with (INR (k - j - 1) * h + h)
        by (replace (S k - j - 1)%nat with (S (k - j - 1)) by lia; rewrite S_INR; ring).
      reflexivity.
    + replace (S k - k)%nat with 1%nat by lia. simpl.
      rewrite Rmult_1_l, Rmult_0_l, Rplus_0_r, Rplus_0_r, (rpow_nonpos 0) by lra. ring.
Qed.

Let m := rpow h alpha / Gamma (alpha + 1).

Lemma plant_sample k i : (i < N)%nat ->
  x (INR (S k) * h) i = x0 i + m * \sum_(j < S k) (ck alpha (k - j) * u j i).
Proof.
  intros Hi. replace (INR (S k) * h) with (INR k * h + h) by (rewrite S_INR; ring).
  rewrite plant_inside by (auto; lra). f_equal. unfold m, Rdiv.
  rewrite (Rmult_comm (rpow h alpha) (/ Gamma (alpha + 1))), Rmult_assoc. f_equal.
  rewrite sum_last, Nat.sub_diag, ck_0, Rmult_plus_distr_l, <- sum_scal. f_equal; [|ring].
  apply sum_ext. intros j Hj. rewrite <- Rmult_assoc. f_equal.
  unfold ck. assert (P := pos_INR (k - j)).
  rewrite Rmult_minus_distr_l, <- !rpow_mult by lra. f_equal; f_equal; [ring|].
  replace (INR (k - j)) with (INR (k - j - 1) + 1); [ring|].
  rewrite <- S_INR. f_equal. lia.
Qed.

Lemma plant_step k i : (i < N)%nat ->
  x (INR (S k) * h) i =
    x (INR k * h) i + m * (u k i + \sum_(l < k) (fk alpha (S l) * u (k - S l)%nat i)).
Proof.
  intros Hi. rewrite plant_sample by exact Hi. destruct k as [|k].
  - simpl. rewrite Rmult_0_l, (proj1 Hx i Hi), ck_0. ring.
  - rewrite (plant_sample k i Hi).
    rewrite <- (sum_rev k (fun l => fk alpha (S l) * u (S k - S l)%nat i)).
    rewrite (sum_ext (S k) (fun l => fk alpha (S (k - l)) * u (S k - S (k - l))%nat i)
               (fun l => ck alpha (S k - l) * u l i - ck alpha (k - l) * u l i)).
    + rewrite sum_minus.
      change (\sum_(j < S (S k)) (ck alpha (S k - j) * u j i)) with
        (\sum_(j < S k) (ck alpha (S k - j) * u j i) + ck alpha (S k - S k) * u (S k) i).
      rewrite Nat.sub_diag, ck_0. ring.
    + intros l Hl. rewrite fk_ck. replace (S k - S (k - l))%nat with l by lia.
      replace (S k - l)%nat with (S (k - l)) by lia. ring.
Qed.
End Plant.

Section Loop.
Variables (N : nat) (A : mat) (alpha gamma h : R) (x0 : vec).
Hypothesis D : design alpha gamma h.
Let mu := mu_of alpha gamma h.
Let P := perron N A mu.

Lemma mu_pos : 0 < mu.
Proof.
  destruct D as [Ha [Hg Hh]]. unfold mu, mu_of.
  apply Rmult_lt_0_compat; [exact Hg|].
  apply Rdiv_lt_0_compat; [apply rpow_gt_0, Hh|apply Gamma_pos; lra].
Qed.

Lemma consensus_term v i : (i < N)%nat ->
  \sum_(j < N) (A i j * (v j - v i)) = - mv N (laplacian N A) v i.
Proof.
  intros Hi. rewrite laplacian_entry, <- sum_opp by exact Hi. apply sum_ext. intros; ring.
Qed.

Lemma controller_law x u : controller N A alpha gamma h x u -> forall k i, (i < N)%nat ->
  u k i + \sum_(l < k) (fk alpha (S l) * u (k - S l)%nat i) = - gamma * error N A h x k i.
Proof.
  intros C k i Hi. rewrite (C k i Hi), consensus_term by exact Hi. unfold error. ring.
Qed.

(** A step with total input -gamma L y is a step with P. *)
Lemma perron_step y i : (i < N)%nat ->
  y i + rpow h alpha / Gamma (alpha + 1) * (- gamma * mv N (laplacian N A) y i) = mv N P y i.
Proof. intros Hi. unfold P. rewrite perron_entry by exact Hi. unfold mu, mu_of. ring. Qed.

Lemma loop_step x u : closed_loop N A alpha gamma h x0 x u -> forall k i, (i < N)%nat ->
  x (INR (S k) * h) i = mv N P (x (INR k * h)) i.
Proof.
  intros [Hx C] k i Hi. destruct D as [Ha [Hg Hh]].
  rewrite (plant_step N alpha h x0 u x Ha Hh Hx k i Hi).
  rewrite (controller_law x u C k i Hi). apply perron_step, Hi.
Qed.

Lemma loop_sample x u : closed_loop N A alpha gamma h x0 x u -> forall k i, (i < N)%nat ->
  x (INR k * h) i = iter k (mv N P) x0 i.
Proof.
  intros H k. induction k as [|k IH]; intros i Hi.
  - simpl. rewrite Rmult_0_l. apply H, Hi.
  - rewrite (loop_step x u H k i Hi). simpl. apply mv_ext, IH.
Qed.

Lemma loop_error x u : closed_loop N A alpha gamma h x0 x u -> forall k i, (i < N)%nat ->
  error N A h x k i = iter k (mv N P) (mv N (laplacian N A) x0) i.
Proof.
  intros H k i Hi. unfold error.
  rewrite (mv_ext N _ _ (iter k (mv N P) x0)) by (intros; eapply loop_sample; eassumption).
  apply laplacian_iter, Hi.
Qed.

Lemma loop_u0 x u : closed_loop N A alpha gamma h x0 x u -> forall i, (i < N)%nat ->
  u 0%nat i = - gamma * mv N (laplacian N A) x0 i.
Proof.
  intros H i Hi. assert (E := controller_law x u (proj2 H) 0 i Hi).
  rewrite (loop_error x u H 0 i Hi) in E. simpl in E. lra.
Qed.

(** F * u = P^k u_0. *)
Lemma loop_convolution x u : closed_loop N A alpha gamma h x0 x u -> forall k i, (i < N)%nat ->
  u k i + \sum_(l < k) (fk alpha (S l) * u (k - S l)%nat i) = iter k (mv N P) (u 0%nat) i.
Proof.
  intros H k i Hi. rewrite (controller_law x u (proj2 H) k i Hi), (loop_error x u H k i Hi).
  rewrite (iter_mv_ext N P k (u 0%nat) (fun j => - gamma * mv N (laplacian N A) x0 j));
    [|apply (loop_u0 x u H)|exact Hi].
  symmetry. apply iter_scal, Hi.
Qed.

Lemma loop_phi x u : closed_loop N A alpha gamma h x0 x u -> forall k i, (i < N)%nat ->
  u k i = Phi alpha N P k (u 0%nat) i.
Proof.
  intros H k i Hi. apply (resolvent_unique alpha
    (fun k => iter k (mv N P) (u 0%nat) i) (fun k => u k i)).
  intros n. apply (loop_convolution x u H n i Hi).
Qed.

Lemma loop_u0_zero_sum x u : balanced N A -> closed_loop N A alpha gamma h x0 x u ->
  zero_sum N (u 0%nat).
Proof.
  intros bal H. apply zero_sum_ext with (fun i => - gamma * mv N (laplacian N A) x0 i).
  - intros i Hi. symmetry. apply (loop_u0 x u H i Hi).
  - apply zero_sum_scal. apply zero_sum_laplacian, bal.
Qed.

(** * Existence *)

Definition exact_control (k : nat) : vec := fun i =>
  \sum_(j < S k) (rk alpha (k - j) * (- gamma * mv N (laplacian N A) (iter j (mv N P) x0) i)).

Lemma index_unique n k s : 0 < h -> 0 < s <= h ->
  INR n < (INR k * h + s) / h <= INR n + 1 -> n = k.
Proof.
  intros Hh Hs [L U].
  apply Rmult_lt_compat_r with (r := h) in L; [|exact Hh].
  apply Rmult_le_compat_r with (r := h) in U; [|lra].
  replace ((INR k * h + s) / h * h) with (INR k * h + s) in * by (field; lra).
  assert (INR n < INR (S k)) by (apply Rmult_lt_reg_r with h; [exact Hh|rewrite S_INR; lra]).
  assert (INR k < INR (S n)) by (apply Rmult_lt_reg_r with h; [exact Hh|rewrite S_INR; lra]).
  apply INR_lt in H. apply INR_lt in H0. lia.
Qed.

(** Every t > 0 lies in one sampling interval (k h, (k+1) h]. *)
Lemma sampling_interval t : 0 < h -> 0 < t -> exists k s, 0 < s <= h /\ t = INR k * h + s.
Proof.
  intros Hh Ht. destruct (nfloor1_ex (t / h)) as [n [L U]]; [apply Rdiv_lt_0_compat; lra|].
  exists n, (t - INR n * h). apply Rmult_lt_compat_r with (r := h) in L; [|exact Hh].
  apply Rmult_le_compat_r with (r := h) in U; [|lra].
  replace (t / h * h) with t in * by (field; lra). lra.
Qed.

Definition exact_state (t : R) : vec := fun i =>
  match Rlt_dec 0 (t / h) with
  | right _ => x0 i
  | left pos => let k := proj1_sig (nfloor1_ex (t / h) pos) in
      x0 i + / Gamma alpha *
        (\sum_(j < k) (exact_control j i * kernel_integral alpha t (INR j * h) (INR (S j) * h))
         + exact_control k i * kernel_integral alpha t (INR k * h) t)
  end.

Lemma exact_plant : plant N alpha h x0 exact_control exact_state.
Proof.
  destruct D as [Ha [Hg Hh]]. split.
  - intros i _. unfold exact_state. destruct (Rlt_dec 0 (0 / h)) as [C|]; [|reflexivity].
    exfalso. unfold Rdiv in C. lra.
  - intros k s i Hi Hs t. unfold exact_state.
    assert (B := pos_INR k).
    destruct (Rlt_dec 0 (t / h)) as [pos|C].
    + destruct (nfloor1_ex (t / h) pos) as [n Hn]. simpl.
      rewrite (index_unique n k s Hh Hs Hn). reflexivity.
    + exfalso. apply C. apply Rdiv_lt_0_compat; [unfold t; nra|exact Hh].
Qed.

Lemma exact_sample k : forall i, (i < N)%nat ->
  exact_state (INR k * h) i = iter k (mv N P) x0 i.
Proof.
  destruct D as [Ha [Hg Hh]]. induction k as [|k IH]; intros i Hi.
  - simpl. rewrite Rmult_0_l. apply exact_plant, Hi.
  - rewrite (plant_step N alpha h x0 _ _ Ha Hh exact_plant k i Hi), (IH i Hi).
    assert (E := resolvent_solves alpha
      (fun j => - gamma * mv N (laplacian N A) (iter j (mv N P) x0) i) k).
    cbv zeta beta in E. unfold exact_control. rewrite E. simpl. apply perron_step, Hi.
Qed.

Lemma exact_loop : closed_loop N A alpha gamma h x0 exact_state exact_control.
Proof.
  split; [exact exact_plant|]. intros k i Hi. rewrite consensus_term by exact Hi.
  rewrite (mv_ext N _ _ (iter k (mv N P) x0)) by (intros; apply exact_sample; assumption).
  assert (E := resolvent_solves alpha
    (fun j => - gamma * mv N (laplacian N A) (iter j (mv N P) x0) i) k).
  cbv zeta beta in E. unfold exact_control at 1. unfold exact_control. lra.
Qed.

Lemma loop_unique x u x' u' : closed_loop N A alpha gamma h x0 x u ->
  closed_loop N A alpha gamma h x0 x' u' ->
  (forall k i, (i < N)%nat -> u k i = u' k i) /\
  (forall t i, (i < N)%nat -> 0 <= t -> x t i = x' t i).
Proof.
  intros H H'. destruct D as [Ha [Hg Hh]].
  assert (U : forall k i, (i < N)%nat -> u k i = u' k i).
  { intros k i Hi. rewrite (loop_phi x u H k i Hi), (loop_phi x' u' H' k i Hi).
    apply sum_ext. intros j Hj. f_equal. apply iter_mv_ext; [|exact Hi].
    intros n Hn. rewrite (loop_u0 x u H n Hn), (loop_u0 x' u' H' n Hn). reflexivity. }
  split; [exact U|]. intros t i Hi [Ht| <-].
  - destruct (sampling_interval t Hh Ht) as [k [s [Hs ->]]].
    rewrite (proj2 (proj1 H) k s i Hi Hs), (proj2 (proj1 H') k s i Hi Hs), (U k i Hi).
    do 3 f_equal. apply sum_ext. intros j Hj. rewrite (U j i Hi). reflexivity.
  - rewrite (proj1 (proj1 H) i Hi), (proj1 (proj1 H') i Hi). reflexivity.
Qed.
End Loop.
