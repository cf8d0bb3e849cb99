(** The closed loop: existence, x_{k+1} = P x_k, and the controls. *)
From Coq Require Import Reals Arith Lia Lra.
From Coquelicot Require Import Coquelicot.
From Fomas Require Import Model.Vectors Model.Kernel Model.Gamma Model.Graph Model.Loop Statements.
From Fomas Require Import Facts.Sums Facts.Vectors Facts.Kernel Facts.Resolvent Facts.Gamma.
From Fomas Require Import Facts.Graph Facts.Loop.
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
  intros N M alpha y k i Ha Hi. split.
  - unfold Phi at 1. rewrite sum_first, Nat.sub_0_r. simpl iter.
    unfold Phi. rewrite mv_sum.
    rewrite (sum_ext (S k) (fun l => mv N M (fun j => rk alpha (k - l) * iter l (mv N M) y j) i)
               (fun l => rk alpha (k - l) * mv N M (iter l (mv N M) y) i))
      by (intros; apply mv_scal).
    rewrite Rplus_comm. f_equal.
  - assert (E := resolvent_solves alpha (fun j => iter j (mv N M) y i) k). cbv zeta beta in E.
    unfold Phi. rewrite <- E.
    rewrite (sum_ext k (fun l => Rabs (fk alpha (S l)) * _)
               (fun l => - (fk alpha (S l) *
                  \sum_(j < S (k - S l)) (rk alpha (k - S l - j) * iter j (mv N M) y i)))).
    + rewrite sum_opp. ring.
    + intros l _. rewrite Rabs_left by (apply fk_neg, Ha). ring.
Qed.
