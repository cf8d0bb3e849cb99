(** The closed loop: existence, x_{k+1} = P x_k, and the controls. *)
From Coq Require Import Reals Arith Lia Lra.
From Coquelicot Require Import Coquelicot.
From Fomas Require Import Model.Vectors Model.Kernel Model.Gamma Model.Graph Model.Loop Statements.
From Fomas Require Import Facts.Sums Facts.Vectors Facts.Kernel Facts.Resolvent Facts.Gamma.
From Fomas Require Import Facts.Graph Facts.Loop Facts.Phi.
Open Scope R_scope.

Theorem closed_loop_exists : closed_loop_exists_statement.
Proof.
  intros N A alpha gamma h x0 D. split.
  - eexists. eexists. apply (exact_loop N A alpha gamma h x0 D).
  - intros x u x' u' H H'. apply (loop_unique N A alpha gamma h x0 D x u x' u' H H').
Qed.

Theorem eqxik_3 : eqxik_3_statement.
Proof.
  intros N A alpha gamma h x0 x u D H k i Hi mu xk.
  assert (E := loop_step N A alpha gamma h x0 D x u H k i Hi).
  split; [|split; [exact E|]].
  - rewrite E, perron_entry by exact Hi. reflexivity.
  - rewrite E, perron_entry, consensus_term by exact Hi. unfold xk, mu. ring.
Qed.

Theorem error_step : error_step_statement.
Proof.
  intros N A alpha gamma h x0 x u D H k i Hi.
  rewrite (loop_error N A alpha gamma h x0 D x u H (S k) i Hi). simpl. symmetry.
  apply mv_ext. intros j Hj. apply (loop_error N A alpha gamma h x0 D x u H k j Hj).
Qed.

Theorem equ1 : equ1_statement.
Proof.
  intros N A alpha gamma h x0 x u D H.
  assert (E : forall k i, (i < N)%nat -> u k i = - gamma * error N A h x k i
            + \sum_(l < k) (Rabs (fk alpha (S l)) * u (k - S l)%nat i)).
  { intros k i Hi. assert (C := controller_law N A alpha gamma h x u (proj2 H) k i Hi).
    rewrite (sum_ext k (fun l => Rabs (fk alpha (S l)) * u (k - S l)%nat i)
               (fun l => - (fk alpha (S l) * u (k - S l)%nat i))).
    - rewrite sum_opp. lra.
    - intros l _. rewrite Rabs_left by (apply fk_neg, D). ring. }
  split; [|exact E]. intros i Hi. rewrite (E 1%nat i Hi). simpl. ring.
Qed.

Theorem control_resolvent : control_resolvent_statement.
Proof.
  intros N A alpha gamma h x0 x u D H k i Hi P.
  split; [|split; [|split]].
  - rewrite (loop_error N A alpha gamma h x0 D x u H 0 i Hi).
    apply (loop_u0 N A alpha gamma h x0 D x u H i Hi).
  - apply (loop_convolution N A alpha gamma h x0 D x u H k i Hi).
  - rewrite <- sum_scal.
    rewrite (resolvent_unique alpha (fun k => - gamma * error N A h x k i) (fun k => u k i)).
    + apply sum_ext. intros j _. ring.
    + intros n. apply (controller_law N A alpha gamma h x u (proj2 H) n i Hi).
  - apply (loop_phi N A alpha gamma h x0 D x u H k i Hi).
Qed.

Theorem phi_recursion : phi_recursion_statement.
Proof.
  intros N M alpha y k i Ha Hi. split; [apply phi_step|apply phi_convolution]; assumption.
Qed.
