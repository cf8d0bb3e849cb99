"""The claims: for each, the test of what a certificate says of it.

A test returns when the verdict is true and its witness shows it, and raises `Refused` or `Undecided` when not.
Source: docs/certificate-format.md, section 4.
"""

from collections.abc import Callable
from fractions import Fraction
from typing import Any

from fomas_verify.checker.contraction import (
    require_beyond_beta,
    require_beyond_threshold,
    require_root_of,
    require_symmetric_bounds,
)
from fomas_verify.checker.document import Claim
from fomas_verify.checker.facts import Facts
from fomas_verify.checker.graph import Graph
from fomas_verify.checker.member_form import MemberWitness
from fomas_verify.checker.relation import (
    moves,
    require_excess,
    require_excess_at,
    require_largest_bound,
    require_lemma,
    require_lemma_of,
)
from fomas_verify.checker.ruling import need, need_that
from fomas_verify.checker.stability import require_decrease, require_persistence, trace_beyond
from fomas_verify.checker.statements import ANY_GRAPH, STATEMENTS
from fomas_verify.checker.thresholds import beta_below_first, beta_below_second, sigma_below_first
from fomas_verify.checker.witness import (
    Excess,
    ExcessAt,
    GraphDefect,
    LargestBound,
    Lemma,
    Lyapunov,
    Nothing,
    Persistence,
    Power,
    RootOf,
    Sample,
    SymmetricBounds,
    Vector,
)


def require_claim(facts: Facts, claim: Claim) -> str:
    """Return the reason why a claim is accepted.

    Raises
    ------
    Refused
        If its statement is not the checker's, its verdict is false, or its witness does not show it.
    Undecided
        If that was not decided within the work allowed.
    """
    reason = presupposed(facts.graph, claim)
    if reason is None:
        require_shown(facts, claim.id, claim.verdict, claim.witness)
        reason = "true" if isinstance(claim.witness, Nothing) else "true, and the witness shows it"
    return reason


def presupposed(graph: Graph, claim: Claim) -> str | None:
    """Return why a claim is accepted that asserts nothing of the numbers, None where it does; raise `Refused`."""
    need_that(claim.statement == STATEMENTS[claim.id], "the statement is the one of this claim, to the letter")
    need_that(claim.id != "trajectory-norm-bound" or graph.design.x0 is not None, "the design has x0")
    applicable = claim.id in ANY_GRAPH or graph.satisfies_assumption
    if claim.verdict == "inapplicable":
        need_that(not applicable, "Assumption 1 fails, and the claim presupposes it")
        return "Assumption 1 fails"
    need_that(applicable, "the claim is applicable (Assumption 1 fails)")
    return "asserts nothing" if claim.verdict == "undecided" else None


def require_shown(facts: Facts, claim: str, verdict: str, witness: MemberWitness) -> None:
    """Return if a witness shows a verdict on a claim that is applicable; raise `Refused` or `Undecided` if not."""
    _TESTS[claim, verdict, type(witness)](facts, witness)


def _assumption_holds(facts: Facts, _: Nothing) -> None:
    need_that(facts.graph.satisfies_assumption, "the digraph is strongly connected and balanced")


def _assumption_fails(facts: Facts, witness: GraphDefect) -> None:
    graph = facts.graph
    if witness.unreachable is not None:
        start, end = witness.unreachable
        need_that(end not in graph.reachable(start), f"no directed path leads from agent {start} to agent {end}")
    if witness.imbalance is not None:
        agent, heard, spoken = witness.imbalance
        need_that(heard == graph.heard(agent), f'"in" is the sum of the weights that agent {agent} hears')
        need_that(spoken == graph.spoken(agent), f'"out" is the sum of the weights with which agent {agent} is heard')
        need_that(heard != spoken, '"in" and "out" differ')


def _gain_below(facts: Facts, _: Nothing) -> None:
    need(_compare_gain(facts), (-1,), "mu < 1/Delta_max")


def _gain_not_below(facts: Facts, _: Nothing) -> None:
    need(_compare_gain(facts), (0, 1), "mu >= 1/Delta_max")


def _compare_gain(facts: Facts) -> int | None:
    """The sign of mu - 1/D, where 1/0 is infinity."""
    degree = facts.graph.degree_max
    return -1 if degree == 0 else facts.compare_mu(1 / degree)


def _memory_holds(facts: Facts, _: Nothing) -> None:
    need(beta_below_first(facts), (0, 1), "beta <= 2^alpha - 1")
    need(beta_below_second(facts), (-1, 0), "beta >= -sqrt(3^alpha - 2^alpha)")


def _memory_fails(facts: Facts, witness: Sample) -> None:
    if witness.k == 0:
        need(beta_below_first(facts), (-1,), "beta > 2^alpha - 1")
    else:
        need(beta_below_second(facts), (1,), "beta < -sqrt(3^alpha - 2^alpha)")


def _decreases(facts: Facts, witness: Lyapunov) -> None:
    need(facts.compare_mu(witness.mu), (-1, 0), "mu <= witness.mu")
    require_decrease(facts.graph, witness.mu, witness.rows)


def _persists(facts: Facts, witness: Persistence) -> None:
    _require_earlier(facts, witness.mu)
    require_persistence(facts.graph, witness.mu, witness.rows)


def _grows(facts: Facts, witness: Power) -> None:
    _require_earlier(facts, witness.mu)
    need(trace_beyond(facts.graph, witness.mu, witness.power), (1,), "abs trace(Pc(witness.mu)^power) > N - 1")


def _require_earlier(facts: Facts, t: Fraction) -> None:
    need_that(t > 0, "0 < witness.mu")
    need(facts.compare_mu(t), (0, 1), "witness.mu <= mu")


def _sigma_within(facts: Facts, _: Nothing) -> None:
    need(sigma_below_first(facts), (0, 1), "sigma <= 2^alpha - 1")


def _agreed_or_within(facts: Facts, _: Nothing) -> None:
    if moves(facts.graph):
        need(sigma_below_first(facts), (0, 1), "L x_0 = 0, or sigma <= 2^alpha - 1")


_CONSENSUS = ("perron-eigenvalues", "control-bounded", "average-consensus")

# No entry, no acceptance: a verdict and witness that are not listed here are not taken for shown.
_TESTS: dict[tuple[str, str, type], Callable[[Facts, Any], None]] = {
    ("graph-assumption", "proved", Nothing): _assumption_holds,
    ("graph-assumption", "refuted", GraphDefect): _assumption_fails,
    ("gain-bound", "proved", Nothing): _gain_below,
    ("gain-bound", "refuted", Nothing): _gain_not_below,
    ("memory-inequality", "proved", Nothing): _memory_holds,
    ("memory-inequality", "refuted", Sample): _memory_fails,
    ("beta-contraction", "proved", RootOf): require_root_of,
    ("beta-contraction", "proved", SymmetricBounds): require_symmetric_bounds,
    ("beta-contraction", "refuted", Vector): require_beyond_beta,
    ("repaired-condition", "proved", Nothing): _sigma_within,
    ("repaired-condition", "refuted", Vector): require_beyond_threshold,
    ("control-norm-bound", "proved", Nothing): _sigma_within,
    ("control-norm-bound", "refuted", Power): _grows,
    ("control-norm-bound", "proved", Lemma): require_lemma,
    ("control-norm-bound", "proved", LargestBound): require_largest_bound,
    ("control-norm-bound", "refuted", Excess): require_excess,
    ("trajectory-norm-bound", "proved", Nothing): _agreed_or_within,
    ("trajectory-norm-bound", "proved", Lemma): require_lemma_of,
    ("trajectory-norm-bound", "proved", LargestBound): require_largest_bound,
    ("trajectory-norm-bound", "refuted", ExcessAt): require_excess_at,
    **{(claim, "proved", Lyapunov): _decreases for claim in _CONSENSUS},
    **{(claim, "refuted", Persistence): _persists for claim in _CONSENSUS},
    **{(claim, "refuted", Power): _grows for claim in _CONSENSUS},
}
