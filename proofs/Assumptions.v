(** Prints the axioms each theorem rests on; [make assumptions] compares them with
    Assumptions.golden. *)
From Fomas Require Import Results.Lemma2.
From Fomas Require Import Results.Telescoping.
From Fomas Require Import Results.LogConvexity.
From Fomas Require Import Results.EqT2.
From Fomas Require Import Results.Kaluza.
From Fomas Require Import Results.Plant.
From Fomas Require Import Results.ClosedLoop.
From Fomas Require Import Results.BalancedGraph.
From Fomas Require Import Results.Perron.
From Fomas Require Import Results.Consensus.
From Fomas Require Import Results.NormBound.
From Fomas Require Import Results.Remark1.
From Fomas Require Import Results.Soundness.
From Fomas Require Import Results.Equivalence.
From Fomas Require Import Results.Regions.
From Fomas Require Import Results.Coordinates.
From Fomas Require Import Results.Stability.
From Fomas Require Import Results.Spectrum.
From Fomas Require Import Results.Refutation.
From Fomas Require Import Results.Step.
From Fomas Require Import Instances.Gamma19.
From Fomas Require Import Instances.PaperExample.
From Fomas Require Import Instances.PaperChain.
From Fomas Require Import Instances.PairGraph.
From Fomas Require Import Instances.Examples.
From Fomas Require Import Instances.MoreExamples.
From Fomas Require Import Instances.TestExamples.
From Fomas Require Import Instances.SpectrumExamples.

Goal True. idtac "==" "lemma2". Abort.
Print Assumptions lemma2.
Goal True. idtac "==" "telescoping". Abort.
Print Assumptions telescoping.
Goal True. idtac "==" "log_convexity". Abort.
Print Assumptions log_convexity.
Goal True. idtac "==" "eqT2_closed_form". Abort.
Print Assumptions eqT2_closed_form.
Goal True. idtac "==" "eqT2_first_sample". Abort.
Print Assumptions eqT2_first_sample.
Goal True. idtac "==" "kaluza". Abort.
Print Assumptions kaluza.
Goal True. idtac "==" "gamma_function". Abort.
Print Assumptions gamma_function.
Goal True. idtac "==" "kernel_integral_formula". Abort.
Print Assumptions kernel_integral_formula.
Goal True. idtac "==" "eqxik_1". Abort.
Print Assumptions eqxik_1.
Goal True. idtac "==" "between_samples". Abort.
Print Assumptions between_samples.
Goal True. idtac "==" "closed_loop_exists". Abort.
Print Assumptions closed_loop_exists.
Goal True. idtac "==" "eqxik_3". Abort.
Print Assumptions eqxik_3.
Goal True. idtac "==" "error_step". Abort.
Print Assumptions error_step.
Goal True. idtac "==" "equ1". Abort.
Print Assumptions equ1.
Goal True. idtac "==" "control_resolvent". Abort.
Print Assumptions control_resolvent.
Goal True. idtac "==" "phi_recursion". Abort.
Print Assumptions phi_recursion.
Goal True. idtac "==" "quadratic_form". Abort.
Print Assumptions quadratic_form.
Goal True. idtac "==" "laplacian_norm_bound". Abort.
Print Assumptions laplacian_norm_bound.
Goal True. idtac "==" "invariant_mean". Abort.
Print Assumptions invariant_mean.
Goal True. idtac "==" "lambda2_exists". Abort.
Print Assumptions lambda2_exists.
Goal True. idtac "==" "lambda2_eigenvalue". Abort.
Print Assumptions lambda2_eigenvalue.
Goal True. idtac "==" "lambda2_positive". Abort.
Print Assumptions lambda2_positive.
Goal True. idtac "==" "sigma_ge_beta". Abort.
Print Assumptions sigma_ge_beta.
Goal True. idtac "==" "betahat". Abort.
Print Assumptions betahat.
Goal True. idtac "==" "perron_eigenvalues". Abort.
Print Assumptions perron_eigenvalues.
Goal True. idtac "==" "consensus_from_decay". Abort.
Print Assumptions consensus_from_decay.
Goal True. idtac "==" "consensus_at_samples". Abort.
Print Assumptions consensus_at_samples.
Goal True. idtac "==" "consensus_between_samples". Abort.
Print Assumptions consensus_between_samples.
Goal True. idtac "==" "overshoot". Abort.
Print Assumptions overshoot.
Goal True. idtac "==" "theorem1_from_gain_bound". Abort.
Print Assumptions theorem1_from_gain_bound.
Goal True. idtac "==" "theorem1_as_stated". Abort.
Print Assumptions theorem1_as_stated.
Goal True. idtac "==" "remark1". Abort.
Print Assumptions remark1.
Goal True. idtac "==" "remark1_consensus". Abort.
Print Assumptions remark1_consensus.
Goal True. idtac "==" "control_vanishes_converse". Abort.
Print Assumptions control_vanishes_converse.
Goal True. idtac "==" "peak_lemma". Abort.
Print Assumptions peak_lemma.
Goal True. idtac "==" "peak_tail". Abort.
Print Assumptions peak_tail.
Goal True. idtac "==" "peak_attained". Abort.
Print Assumptions peak_attained.
Goal True. idtac "==" "eqL3_from_powers". Abort.
Print Assumptions eqL3_from_powers.
Goal True. idtac "==" "control_peak". Abort.
Print Assumptions control_peak.
Goal True. idtac "==" "theorem1_repaired". Abort.
Print Assumptions theorem1_repaired.
Goal True. idtac "==" "theorem1_repaired_closed_form". Abort.
Print Assumptions theorem1_repaired_closed_form.
Goal True. idtac "==" "eqL3_characterised". Abort.
Print Assumptions eqL3_characterised.
Goal True. idtac "==" "eqL3_needs_eqT2". Abort.
Print Assumptions eqL3_needs_eqT2.
Goal True. idtac "==" "ldlt". Abort.
Print Assumptions ldlt.
Goal True. idtac "==" "residual_factor". Abort.
Print Assumptions residual_factor.
Goal True. idtac "==" "convexity". Abort.
Print Assumptions convexity.
Goal True. idtac "==" "convexity_in_mu". Abort.
Print Assumptions convexity_in_mu.
Goal True. idtac "==" "sigma_convex". Abort.
Print Assumptions sigma_convex.
Goal True. idtac "==" "lyapunov". Abort.
Print Assumptions lyapunov.
Goal True. idtac "==" "lyapunov_refutation". Abort.
Print Assumptions lyapunov_refutation.
Goal True. idtac "==" "schur_complement". Abort.
Print Assumptions schur_complement.
Goal True. idtac "==" "rayleigh". Abort.
Print Assumptions rayleigh.
Goal True. idtac "==" "hyperplane". Abort.
Print Assumptions hyperplane.
Goal True. idtac "==" "emptiness". Abort.
Print Assumptions emptiness.
Goal True. idtac "==" "decay_from_vanishing". Abort.
Print Assumptions decay_from_vanishing.
Goal True. idtac "==" "claims_equivalent". Abort.
Print Assumptions claims_equivalent.
Goal True. idtac "==" "eigenvalues_from_decay". Abort.
Print Assumptions eigenvalues_from_decay.
Goal True. idtac "==" "eigenvalue_bounds". Abort.
Print Assumptions eigenvalue_bounds.
Goal True. idtac "==" "outer_end". Abort.
Print Assumptions outer_end.
Goal True. idtac "==" "consensus_interval". Abort.
Print Assumptions consensus_interval.
Goal True. idtac "==" "lambda2_psd". Abort.
Print Assumptions lambda2_psd.
Goal True. idtac "==" "basis". Abort.
Print Assumptions basis.
Goal True. idtac "==" "definite_margin". Abort.
Print Assumptions definite_margin.
Goal True. idtac "==" "contraction_test". Abort.
Print Assumptions contraction_test.
Goal True. idtac "==" "lambda2_test". Abort.
Print Assumptions lambda2_test.
Goal True. idtac "==" "differences_evolve". Abort.
Print Assumptions differences_evolve.
Goal True. idtac "==" "lyapunov_test". Abort.
Print Assumptions lyapunov_test.
Goal True. idtac "==" "persistence_test". Abort.
Print Assumptions persistence_test.
Goal True. idtac "==" "trace_test". Abort.
Print Assumptions trace_test.
Goal True. idtac "==" "eigenvalues_decide". Abort.
Print Assumptions eigenvalues_decide.
Goal True. idtac "==" "stability_limit". Abort.
Print Assumptions stability_limit.
Goal True. idtac "==" "claims_are_one". Abort.
Print Assumptions claims_are_one.
Goal True. idtac "==" "eqL3_needs_spectrum". Abort.
Print Assumptions eqL3_needs_spectrum.
Goal True. idtac "==" "step_decided". Abort.
Print Assumptions step_decided.
Goal True. idtac "==" "symmetric_step". Abort.
Print Assumptions symmetric_step.
Goal True. idtac "==" "step_fails". Abort.
Print Assumptions step_fails.
Goal True. idtac "==" "region_as_stated". Abort.
Print Assumptions region_as_stated.
Goal True. idtac "==" "memoryless_law". Abort.
Print Assumptions memoryless_law.
Goal True. idtac "==" "gamma_enclosure". Abort.
Print Assumptions gamma_enclosure.
Goal True. idtac "==" "gamma_19". Abort.
Print Assumptions gamma_19.
Goal True. idtac "==" "paper_hypotheses". Abort.
Print Assumptions paper_hypotheses.
Goal True. idtac "==" "paper_step_false". Abort.
Print Assumptions paper_step_false.
Goal True. idtac "==" "paper_chain_false". Abort.
Print Assumptions paper_chain_false.
Goal True. idtac "==" "paper_step_never". Abort.
Print Assumptions paper_step_never.
Goal True. idtac "==" "paper_eqL3_false". Abort.
Print Assumptions paper_eqL3_false.
Goal True. idtac "==" "eqT2_not_necessary". Abort.
Print Assumptions eqT2_not_necessary.
Goal True. idtac "==" "lemma2_fails_at_one". Abort.
Print Assumptions lemma2_fails_at_one.
Goal True. idtac "==" "repaired_inhabited". Abort.
Print Assumptions repaired_inhabited.
Goal True. idtac "==" "eqT2_not_necessary_inhabited". Abort.
Print Assumptions eqT2_not_necessary_inhabited.
Goal True. idtac "==" "consensus_fails_at_gain_limit". Abort.
Print Assumptions consensus_fails_at_gain_limit.
Goal True. idtac "==" "consensus_fails_disconnected". Abort.
Print Assumptions consensus_fails_disconnected.
Goal True. idtac "==" "average_fails_unbalanced". Abort.
Print Assumptions average_fails_unbalanced.
Goal True. idtac "==" "betahat_fails_beyond_gain_bound". Abort.
Print Assumptions betahat_fails_beyond_gain_bound.
Goal True. idtac "==" "emptiness_inhabited". Abort.
Print Assumptions emptiness_inhabited.
Goal True. idtac "==" "lyapunov_refutation_inhabited". Abort.
Print Assumptions lyapunov_refutation_inhabited.
Goal True. idtac "==" "ldlt_inhabited". Abort.
Print Assumptions ldlt_inhabited.
Goal True. idtac "==" "hyperplane_inhabited". Abort.
Print Assumptions hyperplane_inhabited.
Goal True. idtac "==" "peak_inhabited". Abort.
Print Assumptions peak_inhabited.
Goal True. idtac "==" "peak_fails_without_decay". Abort.
Print Assumptions peak_fails_without_decay.
Goal True. idtac "==" "peak_above_one_inhabited". Abort.
Print Assumptions peak_above_one_inhabited.
Goal True. idtac "==" "lyapunov_inhabited". Abort.
Print Assumptions lyapunov_inhabited.
Goal True. idtac "==" "residual_factor_inhabited". Abort.
Print Assumptions residual_factor_inhabited.
Goal True. idtac "==" "signals_unbounded_beyond_gain_bound". Abort.
Print Assumptions signals_unbounded_beyond_gain_bound.
Goal True. idtac "==" "remark1_inhabited". Abort.
Print Assumptions remark1_inhabited.
Goal True. idtac "==" "remark1_fails_at_gain_limit". Abort.
Print Assumptions remark1_fails_at_gain_limit.
Goal True. idtac "==" "basis_fails_off_1perp". Abort.
Print Assumptions basis_fails_off_1perp.
Goal True. idtac "==" "margin_needs_definite". Abort.
Print Assumptions margin_needs_definite.
Goal True. idtac "==" "contraction_test_inhabited". Abort.
Print Assumptions contraction_test_inhabited.
Goal True. idtac "==" "lambda2_test_inhabited". Abort.
Print Assumptions lambda2_test_inhabited.
Goal True. idtac "==" "lyapunov_test_inhabited". Abort.
Print Assumptions lyapunov_test_inhabited.
Goal True. idtac "==" "lyapunov_test_needs_strictness". Abort.
Print Assumptions lyapunov_test_needs_strictness.
Goal True. idtac "==" "persistence_test_inhabited". Abort.
Print Assumptions persistence_test_inhabited.
Goal True. idtac "==" "persistence_test_needs_nonzero". Abort.
Print Assumptions persistence_test_needs_nonzero.
Goal True. idtac "==" "trace_test_inhabited". Abort.
Print Assumptions trace_test_inhabited.
Goal True. idtac "==" "spectrum_inhabited". Abort.
Print Assumptions spectrum_inhabited.
Goal True. idtac "==" "spectrum_needs_balance". Abort.
Print Assumptions spectrum_needs_balance.
Goal True. idtac "==" "symmetric_step_inhabited". Abort.
Print Assumptions symmetric_step_inhabited.
Goal True. idtac "==" "eqL3_needs_spectrum_inhabited". Abort.
Print Assumptions eqL3_needs_spectrum_inhabited.
