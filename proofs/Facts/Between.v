(** The motion between two samples. *)
From Coq Require Import Reals Arith Lia Lra.
From Coquelicot Require Import Coquelicot.
From Fomas Require Import Model.Vectors Model.Kernel Model.Gamma Model.Graph Model.Loop.
From Fomas Require Import Facts.Sums Facts.Vectors Facts.Kernel Facts.Gamma Facts.Loop.
Open Scope R_scope.

(** The mean value theorem on an open interval. *)
Lemma mean_value (F dF : R -> R) a b : a < b ->
  (forall x, a < x < b -> is_derive F x (dF x)) ->
  (forall x, a <= x <= b -> continuity_pt F x) ->
  exists c, a < c < b /\ F b - F a = dF c * (b - a).
Proof.
  intros Hab D C.
  assert (pF : forall x, a < x < b -> derivable_pt F x).
  { intros x Hx. exists (dF x). apply is_derive_Reals, D, Hx. }
  assert (pI : forall x, a < x < b -> derivable_pt id x) by (intros; apply derivable_pt_id).
  destruct (MVT F id a b pF pI Hab C) as [c [Hc E]].
  - intros x _. apply derivable_continuous_pt, derivable_pt_id.
  - exists c. split; [exact Hc|]. rewrite Derive_Reals in E.
    rewrite (is_derive_unique F c _ (D c Hc)) in E. rewrite Derive_Reals in E.
    change id with (fun x : R => x) in E. rewrite Derive_id in E. lra.
Qed.

(** x |-> (x+s)^alpha - x^alpha is nonincreasing. *)
Lemma rpow_increment alpha s x y : 0 < alpha < 1 -> 0 <= s -> 0 <= x <= y ->
  rpow (y + s) alpha - rpow y alpha <= rpow (x + s) alpha - rpow x alpha.
Proof.
  intros Ha Hs [Hx [Hxy| ->]]; [|lra].
  set (F := fun z => rpow (z + s) alpha - rpow z alpha).
  destruct (mean_value F (fun z => alpha * Rpower (z + s) (alpha - 1)
                                   - alpha * Rpower z (alpha - 1)) x y Hxy) as [c [Hc E]].
  - intros z Hz. unfold F.
    apply (is_derive_minus (V := R_NormedModule) (fun z => rpow (z + s) alpha)
             (fun z => rpow z alpha)); [|apply rpow_derive; lra].
    evar_last.
    + apply (is_derive_comp (fun y => rpow y alpha) (fun y => y + s)).
      * apply rpow_derive; lra.
      * auto_derive; [exact I|reflexivity].
    + unfold scal; simpl; unfold mult; simpl. ring.
  - intros z Hz. apply continuity_pt_minus; [|apply rpow_continuous; lra].
    apply (continuity_pt_comp (fun y => y + s) (fun y => rpow y alpha)).
    + apply continuity_pt_plus; [apply derivable_continuous_pt, derivable_pt_id|].
      apply continuity_pt_const. intros a b. reflexivity.
    + apply rpow_continuous; lra.
  - assert (B := Rpower_le_base_neg c (c + s) (alpha - 1) ltac:(lra) ltac:(lra)).
    cbv beta in E. assert (F y - F x <= 0); [|unfold F in *; lra]. rewrite E.
    apply Rmult_le_compat_l with (r := alpha) in B; [|lra].
    assert (Y : 0 < y - x) by lra. nra.
Qed.

Section Between.
Variables (N : nat) (alpha h : R) (x0 : vec) (u : nat -> vec) (x : R -> vec).
Context (Ha : 0 < alpha < 1) (Hh : 0 < h) (Hx : plant N alpha h x0 u x).

(** d_n = (n h + s)^alpha - (n h)^alpha. *)
Let d (s : R) (n : nat) : R := rpow (INR n * h + s) alpha - rpow (INR n * h) alpha.

Lemma d_nonneg s n : 0 <= s -> 0 <= d s n.
Proof.
  intros Hs. unfold d. assert (P := pos_INR n).
  assert (rpow (INR n * h) alpha <= rpow (INR n * h + s) alpha); [|lra].
  apply rpow_le; nra.
Qed.

Lemma d_antitone s n m : 0 <= s -> (n <= m)%nat -> d s m <= d s n.
Proof.
  intros Hs H. apply rpow_increment; [exact Ha|exact Hs|].
  assert (P := pos_INR n). apply le_INR in H. nra.
Qed.

Lemma d_0 s : d s 0 = rpow s alpha.
Proof.
  unfold d. simpl. rewrite Rmult_0_l, Rplus_0_l, (rpow_nonpos 0) by lra. ring.
Qed.

Lemma d_le_ck s n : 0 <= s <= h -> d s n <= rpow h alpha * ck alpha n.
Proof.
  intros Hs. unfold d, ck. assert (P := pos_INR n).
  rewrite Rmult_minus_distr_l, <- !rpow_mult by lra.
  replace (h * INR n) with (INR n * h) by ring.
  assert (rpow (INR n * h + s) alpha <= rpow (h * (INR n + 1)) alpha); [|lra].
  apply rpow_le; nra.
Qed.

Lemma d_telescope s n k : (n <= k)%nat ->
  \sum_(j < n) (d s (k - j - 1) - d s (k - j)) = d s (k - n) - d s k.
Proof.
  induction n as [|n IH]; intros H; [rewrite Nat.sub_0_r; simpl; ring|].
  rewrite sum_last, IH by lia. replace (k - n - 1)%nat with (k - S n)%nat by lia. ring.
Qed.

(** x(kh+s) - x(kh) in terms of the d_n. *)
Lemma between_difference k s i : (i < N)%nat -> 0 <= s <= h ->
  x (INR k * h + s) i - x (INR k * h) i = / Gamma (alpha + 1) *
    (rpow s alpha * u k i - \sum_(j < k) ((d s (k - j - 1) - d s (k - j)) * u j i)).
Proof.
  intros Hi Hs. rewrite (plant_between N alpha h x0 u x Ha Hh Hx k s i Hi Hs).
  assert (E := plant_between N alpha h x0 u x Ha Hh Hx k 0 i Hi ltac:(lra)).
  rewrite Rplus_0_r in E. rewrite E, (rpow_nonpos 0) by lra.
  rewrite (sum_ext k (fun j => (d s (k - j - 1) - d s (k - j)) * u j i)
    (fun j => (rpow (INR (k - j) * h + 0) alpha - rpow (INR (k - j - 1) * h + 0) alpha) * u j i
              - (rpow (INR (k - j) * h + s) alpha - rpow (INR (k - j - 1) * h + s) alpha) * u j i)).
  - rewrite sum_minus. ring.
  - intros j _. unfold d. rewrite !Rplus_0_r. ring.
Qed.

Lemma between_entry k s i : (i < N)%nat -> 0 <= s <= h ->
  Rabs (x (INR k * h + s) i - x (INR k * h) i) <= / Gamma (alpha + 1) *
    (rpow s alpha * Rabs (u k i)
     + \sum_(j < k) ((d s (k - j - 1) - d s (k - j)) * Rabs (u j i))).
Proof.
  intros Hi Hs. rewrite between_difference by assumption.
  assert (G : 0 < / Gamma (alpha + 1)) by (apply Rinv_0_lt_compat, Gamma_pos; lra).
  rewrite Rabs_mult, (Rabs_right (/ Gamma (alpha + 1))) by lra.
  apply Rmult_le_compat_l; [lra|].
  eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp. apply Rplus_le_compat.
  - rewrite Rabs_mult, (Rabs_right (rpow s alpha)); [lra|apply Rle_ge, rpow_nonneg].
  - eapply Rle_trans; [apply sum_abs|]. apply sum_le. intros j Hj.
    rewrite Rabs_mult, (Rabs_right (_ - _)); [lra|].
    assert (A := d_antitone s (k - j - 1) (k - j) ltac:(lra) ltac:(lia)). lra.
Qed.

(** The overshoot: with controls at most M up to k, the move is at most
    2 s^alpha M / Gamma(alpha+1). *)
Lemma overshoot_norm M k s : 0 <= s <= h -> (forall j, (j <= k)%nat -> norm N (u j) <= M) ->
  norm N (fun i => x (INR k * h + s) i - x (INR k * h) i)
  <= 2 * rpow s alpha / Gamma (alpha + 1) * M.
Proof.
  intros Hs HM. assert (M0 : 0 <= M).
  { eapply Rle_trans; [apply (norm_nonneg N (u k))|apply HM; lia]. }
  assert (G : 0 < / Gamma (alpha + 1)) by (apply Rinv_0_lt_compat, Gamma_pos; lra).
  rewrite (norm_ext N _ (fun i => / Gamma (alpha + 1) *
    (rpow s alpha * u k i + \sum_(j < k) (- (d s (k - j - 1) - d s (k - j)) * u j i)))).
  2: { intros i Hi. rewrite between_difference by assumption.
       rewrite (sum_ext k (fun j => - (d s (k - j - 1) - d s (k - j)) * u j i)
                  (fun j => - ((d s (k - j - 1) - d s (k - j)) * u j i))) by (intros; ring).
       rewrite sum_opp. ring. }
  rewrite norm_scal, Rabs_right by lra.
  replace (2 * rpow s alpha / Gamma (alpha + 1) * M)
    with (/ Gamma (alpha + 1) * (rpow s alpha * M + rpow s alpha * M))
    by (unfold Rdiv; ring).
  apply Rmult_le_compat_l; [lra|]. assert (R := rpow_nonneg s alpha).
  eapply Rle_trans; [apply norm_triangle|]. apply Rplus_le_compat.
  - rewrite norm_scal, Rabs_right by lra. apply Rmult_le_compat_l; [exact R|apply HM; lia].
  - eapply Rle_trans; [apply norm_combination|].
    apply Rle_trans with (\sum_(j < k) ((d s (k - j - 1) - d s (k - j)) * M)).
    + apply sum_le. intros j Hj. rewrite Rabs_Ropp, Rabs_right.
      * apply Rmult_le_compat_l; [|apply HM; lia].
        assert (A := d_antitone s (k - j - 1) (k - j) ltac:(lra) ltac:(lia)). lra.
      * assert (A := d_antitone s (k - j - 1) (k - j) ltac:(lra) ltac:(lia)). lra.
    + rewrite sum_scal_r, d_telescope, Nat.sub_diag, d_0 by lia.
      apply Rmult_le_compat_r; [exact M0|]. assert (Z := d_nonneg s k ltac:(lra)). lra.
Qed.

(** Vanishing controls: the move between samples vanishes, uniformly in s. *)
Lemma between_vanishes i : (i < N)%nat -> is_lim_seq (fun k => u k i) 0 ->
  forall eps, 0 < eps -> exists K, forall k s, (K <= k)%nat -> 0 <= s <= h ->
    Rabs (x (INR k * h + s) i - x (INR k * h) i) <= eps.
Proof.
  intros Hi L eps He.
  set (g := / Gamma (alpha + 1)). set (H := rpow h alpha).
  assert (G : 0 < g) by (apply Rinv_0_lt_compat, Gamma_pos; lra).
  assert (H0 : 0 < H) by (apply rpow_gt_0, Hh).
  (* a bound of all controls *)
  assert (bound : exists U, 0 <= U /\ forall j, Rabs (u j i) <= U).
  { apply is_lim_seq_spec in L. destruct (L (mkposreal 1 Rlt_0_1)) as [n Hn]. simpl in Hn.
    exists (1 + \sum_(j < n) Rabs (u j i)).
    assert (S0 : 0 <= \sum_(j < n) Rabs (u j i)) by (apply sum_nonneg; intros; apply Rabs_pos).
    split; [lra|]. intros j. destruct (le_lt_dec n j) as [Hj|Hj].
    - specialize (Hn j Hj). rewrite Rminus_0_r in Hn. lra.
    - assert (T := sum_ge_term n (fun j => Rabs (u j i)) j (fun _ _ => Rabs_pos _) Hj).
      cbv beta in T. lra. }
  destruct bound as [U [U0 HU]].
  set (e1 := eps / (4 * g * H)).
  assert (E1 : 0 < e1) by (apply Rdiv_lt_0_compat; [exact He|nra]).
  apply is_lim_seq_spec in L. destruct (L (mkposreal e1 E1)) as [J HJ]. simpl in HJ.
  set (e2 := eps / (2 * g * H * (U + 1))).
  assert (E2 : 0 < e2).
  { apply Rdiv_lt_0_compat; [exact He|]. apply Rmult_lt_0_compat; [|lra].
    apply Rmult_lt_0_compat; [lra|exact H0]. }
  assert (C := ck_lim alpha Ha). apply is_lim_seq_spec in C.
  destruct (C (mkposreal e2 E2)) as [K HK]. simpl in HK.
  exists (J + K)%nat. intros k s Hk Hs.
  eapply Rle_trans; [apply between_entry; assumption|]. fold g.
  assert (Rs : rpow s alpha <= H) by (apply rpow_le; lra).
  assert (Rs0 := rpow_nonneg s alpha).
  assert (A1 : rpow s alpha * Rabs (u k i) <= H * e1).
  { apply Rmult_le_compat; [exact Rs0|apply Rabs_pos|exact Rs|].
    specialize (HJ k ltac:(lia)). rewrite Rminus_0_r in HJ. lra. }
  assert (dd : forall j, (j < k)%nat -> 0 <= d s (k - j - 1) - d s (k - j)).
  { intros j Hj. assert (A := d_antitone s (k - j - 1) (k - j) ltac:(lra) ltac:(lia)). lra. }
  assert (A2 : \sum_(j < J) ((d s (k - j - 1) - d s (k - j)) * Rabs (u j i)) <= H * e2 * U).
  { apply Rle_trans with (\sum_(j < J) ((d s (k - j - 1) - d s (k - j)) * U)).
    - apply sum_le. intros j Hj. apply Rmult_le_compat_l; [apply dd; lia|apply HU].
    - rewrite sum_scal_r, d_telescope by lia. apply Rmult_le_compat_r; [exact U0|].
      assert (Z := d_nonneg s k ltac:(lra)). assert (Q := d_le_ck s (k - J) Hs). fold H in Q.
      specialize (HK (k - J)%nat ltac:(lia)). rewrite Rminus_0_r in HK. apply Rabs_def2 in HK.
      nra. }
  assert (A3 : \sum_(j < k - J) ((d s (k - (J + j) - 1) - d s (k - (J + j))) * Rabs (u (J + j)%nat i))
               <= H * e1).
  { apply Rle_trans with (\sum_(j < k - J) ((d s (k - J - j - 1) - d s (k - J - j)) * e1)).
    - apply sum_le. intros j Hj. assert (Q := dd (J + j)%nat ltac:(lia)).
      replace (k - J - j)%nat with (k - (J + j))%nat by lia.
      apply Rmult_le_compat_l; [exact Q|].
      specialize (HJ (J + j)%nat ltac:(lia)). rewrite Rminus_0_r in HJ. lra.
    - rewrite sum_scal_r, d_telescope, Nat.sub_diag, d_0 by lia.
      apply Rmult_le_compat_r; [lra|]. assert (Z := d_nonneg s (k - J) ltac:(lra)). lra. }
  replace k with (J + (k - J))%nat at 2 by lia. rewrite sum_split.
  apply Rle_trans with (g * (H * e1 + (H * e2 * U + H * e1))).
  - apply Rmult_le_compat_l; lra.
  - assert (Q1 : g * H * e1 = eps / 4) by (unfold e1; field; lra).
    assert (Q2 : g * H * e2 * (U + 1) = eps / 2) by (unfold e2; field; lra).
    assert (0 <= g * H * e2) by (apply Rmult_le_pos; nra). nra.
Qed.
End Between.
