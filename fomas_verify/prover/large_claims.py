"""Each claim about a large design, decided as to its truth by bounds; where they show neither side, undecided.

Source: docs/certificate-format.md, section 11; why each follows: docs/theory.md, section 14.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from fomas_verify.claims import (
    average_consensus,
    beta_contraction,
    control_bounded,
    control_norm_bound,
    gain_bound,
    graph_assumption,
    memory_inequality,
    perron_eigenvalues,
    repaired_condition,
    trajectory_norm_bound,
)
from fomas_verify.claims.registry import CLAIMS, ON_ANY_GRAPH
from fomas_verify.claims.verdict import Decision, Verdict, inapplicable
from fomas_verify.exact.rational import format_rational
from fomas_verify.network.quotients import Quotients
from fomas_verify.prover import large_remedies as remedies
from fomas_verify.prover.large_words import bounded, compared, numbers
from fomas_verify.spectrum.large_loop import LargeLoop, square

PRECISIONS = (128, 256, 512, 1024)
"""In bits; those of the checker, so that it sees what is seen here."""

Truth = bool | None
Words = Callable[[LargeLoop, int], str]


@dataclass(frozen=True)
class Rule:
    """How a claim is decided at a precision, and the words that go with it.

    Attributes
    ----------
    holds : callable
        True, False, or None where the bounds do not tell.
    reason : callable
        The numbers that decide.
    meaning, remedy : callable
        What a refutation means, and what to change.
    """

    holds: Callable[[LargeLoop, int], Truth]
    reason: Words
    meaning: Words
    remedy: Words


@dataclass(frozen=True)
class Start:
    """What is known of L x_0: whether it is 0, and its quotients; None where they are not known."""

    agrees: bool = False
    error: Quotients | None = None


def decide_all(loop: LargeLoop, start: Start, wanted: Callable[[str], bool]) -> dict[str, Decision]:
    """The verdicts on the claims that are wanted, in their order."""
    found: dict[str, Decision] = {}
    for claim in CLAIMS:
        name = claim.ID
        if not wanted(name) or (name == trajectory_norm_bound.ID and loop.design.x0 is None):
            continue
        if name == graph_assumption.ID:
            found[name] = _assumption(loop)
        elif name not in ON_ANY_GRAPH and not loop.assumption1:
            found[name] = inapplicable()
        elif name == trajectory_norm_bound.ID:
            found[name] = _trajectory(loop, start)
        else:
            found[name] = _decided(loop, RULES[name] if loop.assumption1 else WITHOUT_ASSUMPTION[name])
    return found


def _decided(loop: LargeLoop, rule: Rule) -> Decision:
    for bits in PRECISIONS:
        truth = rule.holds(loop, bits)
        if truth is not None:
            reason = rule.reason(loop, bits)
            if truth:
                return Decision(Verdict.PROVED, {}, reason)
            return Decision(Verdict.REFUTED, {}, reason, rule.meaning(loop, bits), rule.remedy(loop, bits))
    return Decision(Verdict.UNDECIDED, {}, f"{rule.reason(loop, bits)}: the bounds show neither side")


def _assumption(loop: LargeLoop) -> Decision:
    facts = loop.facts
    if facts.assumption1:
        return Decision(Verdict.PROVED, {}, "every agent reaches every other, and in-weight = out-weight at each agent")
    witness: dict[str, object] = {}
    reasons = []
    if facts.unreachable is not None:
        i, j = facts.unreachable
        witness["unreachable"] = [i, j]
        reasons.append(f"not strongly connected: no directed path leads from agent {i} to agent {j}")
    if (unequal := facts.imbalance) is not None:
        witness["imbalance"] = {"agent": unequal.agent, "in": unequal.in_, "out": unequal.out}
        hears, heard = format_rational(unequal.in_), format_rational(unequal.out)
        reasons.append(f"not balanced: agent {unequal.agent} hears {hears} and is heard with {heard}")
    meaning = "The paper's Theorem 1 does not speak about this graph; do not expect average consensus from it."
    return Decision(Verdict.REFUTED, witness, "; ".join(reasons), meaning, graph_assumption.REMEDY)


def _trajectory(loop: LargeLoop, start: Start) -> Decision:
    if start.agrees:
        return Decision(Verdict.PROVED, {}, "the agents agree already: u_k = 0 for every k")

    def holds(loop: LargeLoop, bits: int) -> Truth:
        if _norm_bound(loop, bits):
            return True
        return False if start.error and loop.first_sample_square(start.error, bits).lower > 1 else None

    def reason(loop: LargeLoop, bits: int) -> str:
        if _norm_bound(loop, bits):
            return "it holds for every x_0 (control-norm-bound)"
        if start.error is None:
            return "an initial state beyond the work allowed"
        return f"norm u_1^2 / norm u_0^2 = {bounded(loop.first_sample_square(start.error, bits))}"

    return _decided(loop, Rule(holds, reason, _said(trajectory_norm_bound.MEANING), _said("see control-norm-bound")))


def below(loop: LargeLoop, bits: int) -> Truth:
    """Whether ``mu < 1/D``; a graph without edges has D = 0."""
    if loop.degree_max == 0:
        return True
    mu, bound = loop.mu(bits), 1 / loop.degree_max
    return True if mu.upper < bound else False if mu.lower >= bound else None


def _memory(loop: LargeLoop, bits: int) -> Truth:
    beta, upper, lower = loop.beta(bits), loop.threshold(bits), loop.lower_threshold(bits)
    if beta.upper <= upper.lower and beta.lower >= lower.upper:
        return True
    return False if beta.lower > upper.upper or beta.upper < lower.lower else None


def _consensus(loop: LargeLoop, bits: int) -> Truth:
    small = below(loop, bits)
    if small or loop.sigma_square(bits).upper < 1:
        return True
    if loop.facts.is_symmetric:
        reach = loop.reach(bits)
        return True if reach.upper < 2 else False if reach.lower >= 2 else None
    return small if loop.facts.is_directed_cycle else None


def _contraction(loop: LargeLoop, bits: int) -> Truth:
    """It holds iff sigma = beta, since sigma >= abs(beta)."""
    mu, low, high, beta = loop.mu(bits), loop.lambda2(bits), loop.lambda_max(bits), loop.beta(bits)
    if loop.facts.is_symmetric and (mu * (low + high)).upper <= 2:
        return True
    return False if beta.upper < 0 or loop.sigma_square(bits).lower > square(beta).upper else None


def _repaired(loop: LargeLoop, bits: int) -> Truth:
    sigma, threshold = loop.sigma_square(bits), square(loop.threshold(bits))
    return True if sigma.upper <= threshold.lower else False if sigma.lower > threshold.upper else None


def _norm_bound(loop: LargeLoop, bits: int) -> Truth:
    beta, threshold = loop.beta(bits), loop.threshold(bits)
    if _repaired(loop, bits):
        return True
    if beta.lower > threshold.upper or any(loop.first_sample_square(x, bits).lower > 1 for x in loop.quotients):
        return False
    if loop.facts.is_symmetric:
        reach = loop.reach(bits)
        return False if reach.lower > 2 else True if reach.upper <= 2 and beta.upper <= threshold.lower else None
    return False if loop.facts.is_directed_cycle and loop.mu(bits).lower > 1 else None


def _rooted(loop: LargeLoop, bits: int) -> Truth:
    """``perron-eigenvalues`` where Assumption 1 fails: 1 is simple iff some agent reaches every other."""
    return False if not loop.facts.has_root else below(loop, bits) or None


def _root_words(loop: LargeLoop, bits: int) -> str:
    if loop.facts.has_root:
        return f"some agent reaches every other, and {compared(loop, bits, 'mu', '1/Delta_max')}"
    return "the graph has no agent from which every other is reached: 1 is a multiple eigenvalue of P at every mu"


def _comparing(one: str, other: str) -> Words:
    return lambda loop, bits: compared(loop, bits, one, other)


def _consensus_words(loop: LargeLoop, bits: int) -> str:
    if below(loop, bits):
        return compared(loop, bits, "mu", "1/Delta_max")
    if loop.facts.is_symmetric:
        reach = loop.reach(bits)
        sign = " < 2" if reach.upper < 2 else " >= 2" if reach.lower >= 2 else ", to be below 2"
        return f"mu lambda_max = {bounded(reach)}{sign}"
    return f"{compared(loop, bits, 'mu', '1/Delta_max')}; {numbers(loop, bits, 'sigma')}"


def _contraction_words(loop: LargeLoop, bits: int) -> str:
    if _contraction(loop, bits):
        return f"sigma = {numbers(loop, bits, 'beta')}"
    return compared(loop, bits, "sigma", "beta")


def _norm_words(loop: LargeLoop, bits: int) -> str:
    """What decided, in the order in which it was looked at."""
    beta, threshold = loop.beta(bits), loop.threshold(bits)
    if _repaired(loop, bits):
        return f"{compared(loop, bits, 'sigma', '2^alpha - 1')}: the repaired Theorem 1"
    if beta.lower > threshold.upper:
        return compared(loop, bits, "beta", "2^alpha - 1")
    if any(loop.first_sample_square(x, bits).lower > 1 for x in loop.quotients):
        return "norm Phi_1 e > norm e for a vector e in the certificate"
    if loop.facts.is_symmetric:
        return f"{compared(loop, bits, 'beta', '2^alpha - 1')}, {numbers(loop, bits, 'mu lambda_max')}"
    return f"{compared(loop, bits, 'beta', '2^alpha - 1')}, {numbers(loop, bits, 'sigma')}"


def _said(text: str) -> Words:
    return lambda *_: text


def _memory_words(loop: LargeLoop, bits: int) -> str:
    """The threshold on beta's side of 0."""
    upper = loop.beta(bits).lower >= 0
    return compared(loop, bits, "beta", "2^alpha - 1" if upper else "-sqrt(3^alpha - 2^alpha)")


def _memory_meaning(loop: LargeLoop, bits: int) -> str:
    first = loop.beta(bits).lower > loop.threshold(bits).upper
    return memory_inequality.FIRST if first else memory_inequality.SECOND


def first_failure(loop: LargeLoop, decision: Decision) -> int | None:
    """The first sample at which (14) fails: by theory, section 7, 0 or 1; None where it is not refuted."""
    if decision.verdict is not Verdict.REFUTED:
        return None
    bits = PRECISIONS[-1]
    return 0 if loop.beta(bits).lower > loop.threshold(bits).upper else 1


RULES: dict[str, Rule] = {
    gain_bound.ID: Rule(below, _comparing("mu", "1/Delta_max"), _said(gain_bound.MEANING), remedies.gain_bound),
    memory_inequality.ID: Rule(_memory, _memory_words, _memory_meaning, remedies.memory),
    perron_eigenvalues.ID: Rule(_consensus, _consensus_words, _said(perron_eigenvalues.MEANING), remedies.consensus),
    beta_contraction.ID: Rule(_contraction, _contraction_words, _said(beta_contraction.MEANING), remedies.contraction),
    repaired_condition.ID: Rule(
        _repaired, _comparing("sigma", "2^alpha - 1"), _said(repaired_condition.MEANING), remedies.repaired
    ),
    control_norm_bound.ID: Rule(
        _norm_bound,
        _norm_words,
        _said(control_norm_bound.MEANING),
        remedies.norm_bound,
    ),
    control_bounded.ID: Rule(_consensus, _consensus_words, _said(control_bounded.MEANING), remedies.consensus),
    average_consensus.ID: Rule(_consensus, _consensus_words, _said(average_consensus.MEANING), remedies.consensus),
}
WITHOUT_ASSUMPTION: dict[str, Rule] = {
    gain_bound.ID: RULES[gain_bound.ID],
    perron_eigenvalues.ID: Rule(
        _rooted, _root_words, _said(perron_eigenvalues.MEANING), _said("add edges until one agent reaches every other")
    ),
}
