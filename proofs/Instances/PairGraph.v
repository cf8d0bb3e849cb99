(** Two agents that hear each other: eqL3 holds for 1/2 <= mu <= 1, also where (14) fails. *)
From Coq Require Import Reals Arith Lia Lra.
From Fomas Require Import Model.Vectors Model.Kernel Model.Gamma Model.Graph Model.Loop Model.Examples Statements.
From Fomas Require Import Facts.Sums Facts.Vectors Facts.Kernel Facts.Resolvent Facts.Graph.
From Fomas Require Import Facts.Loop Facts.Phi Results.EqT2 Results.BalancedGraph Results.NormBound.
Open Scope R_scope.

Ltac below2 i := destruct i as [|[|i]]; [| |lia].

Lemma pair_assumption1 : assumption1 2 pair_graph.
Proof.
  split; [split|split].
  - intros i j Hi Hj. below2 i; below2 j; cbn; lra.
  - intros i Hi. below2 i; reflexivity.
  - intros i j Hi Hj. below2 i; below2 j; try apply reaches_self;
      (eapply reaches_edge; [apply reaches_self|lia|lia|cbn; lra]).
  - intros i Hi. below2 i; cbn; lra.
Qed.

Lemma pair_degree : degree_max 2 pair_graph = 1.
Proof.
  unfold degree_max, degree. cbn. rewrite !Rplus_0_l, !Rplus_0_r.
  unfold Rmax. repeat destruct Rle_dec; lra.
Qed.

Lemma pair_form x : form 2 (laplacian_sym 2 pair_graph) x = (x 0%nat - x 1%nat) ^ 2.
Proof.
  rewrite (proj2 (quadratic_form 2%nat pair_graph x (proj2 (proj2 pair_assumption1)))).
  unfold pair_graph. cbn. field.
Qed.

Lemma pair_lambda2 : is_lambda2 2 pair_graph 2.
Proof.
  split.
  - intros x Hx. unfold zero_sum in Hx. simpl in Hx. rewrite pair_form. unfold dot. simpl.
    replace (x 1%nat) with (- x 0%nat) by lra. lra.
  - exists (of_list (1 :: -1 :: nil)%list). rewrite pair_form.
    unfold zero_sum, dot, of_list. simpl. split; [|split]; lra.
Qed.

(** On 1perp P is multiplication by 1 - 2 mu. *)
Lemma pair_perron mu e i : zero_sum 2 e -> (i < 2)%nat ->
  mv 2 (perron 2 pair_graph mu) e i = (1 - mu * 2) * e i.
Proof.
  intros He Hi. unfold zero_sum in He. simpl in He.
  rewrite perron_entry, laplacian_entry by exact Hi.
  assert (E : e 1%nat = - e 0%nat) by lra.
  below2 i; unfold pair_graph; cbn; rewrite E; ring.
Qed.

Lemma pair_iter mu n e i : zero_sum 2 e -> (i < 2)%nat ->
  iter n (mv 2 (perron 2 pair_graph mu)) e i = (1 - mu * 2) ^ n * e i.
Proof.
  intros He. revert i. induction n as [|n IH]; intros i Hi; simpl; [ring|].
  rewrite (mv_ext 2 _ _ (fun i => (1 - mu * 2) ^ n * e i)) by exact IH.
  rewrite mv_scal, pair_perron by assumption. ring.
Qed.

Lemma pair_phi alpha mu k e i : zero_sum 2 e -> (i < 2)%nat ->
  Phi alpha 2 (perron 2 pair_graph mu) k e i
  = (\sum_(j < S k) (rk alpha (k - j) * (1 - mu * 2) ^ j)) * e i.
Proof.
  intros He Hi. unfold Phi. rewrite <- sum_scal_r. apply sum_ext. intros j _.
  rewrite Rmult_assoc. f_equal. apply pair_iter; assumption.
Qed.

(** With beta = -b, 0 <= b <= 1, every phi_k lies in [r_k - b, 1]. *)
Lemma alternating_phi alpha b k : 0 < alpha < 1 -> 0 <= b <= 1 ->
  rk alpha k - b <= \sum_(j < S k) (rk alpha (k - j) * (- b) ^ j) <= 1.
Proof.
  intros Ha Hb. induction k as [|k IH]; [simpl; rewrite rk_0; lra|].
  rewrite resolvent_geom_step.
  assert (R := rk_decreasing alpha Ha k). assert (R1 := rk_le_1 alpha Ha k).
  split; [nra|].
  assert (rk alpha (S k) + b * (b - rk alpha k) <= 1) by nra. nra.
Qed.

Theorem eqT2_not_necessary : eqT2_not_necessary_statement.
Proof.
  intros alpha gamma h D mu Hmu.
  split; [exact pair_assumption1|]. split; [exact pair_degree|].
  split; [exact pair_lambda2|]. split.
  - apply bound_from_phi; [apply pair_assumption1|exact D|]. intros k e He. fold mu.
    rewrite (norm_ext 2 _ _ (fun i Hi => pair_phi alpha mu k e i He Hi)), norm_scal.
    apply Rmult_le_compat_r; [apply norm_nonneg|].
    assert (A := alternating_phi alpha (mu * 2 - 1) k (proj1 D) ltac:(lra)).
    assert (R := rk_pos alpha (proj1 D) k).
    replace (- (mu * 2 - 1)) with (1 - mu * 2) in A by ring. apply Rabs_le. lra.
  - intros L M. apply (eqT2_closed_form alpha _ (proj1 D)) in M. lra.
Qed.
