"""Whether the LMI agrees with the direct search, whose region is what is certified in any case.

An answer that is no number, lies outside ``0 <= mu <= 1/D`` or breaks its own inequality, tested exactly, is a failure
of the solver: it is asked once more, otherwise scaled. An answer that is none of these and lies elsewhere than the
direct search's certified ends, twice, is a contradiction. Source: theory, section 5.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction

from fomas_verify.enclosure.interval import Interval
from fomas_verify.enclosure.reference import DisagreementError
from fomas_verify.region.least_factor import MOST_PAIRS, VECTOR_BITS, integer_pairs, lower_bound
from fomas_verify.region.lmi import Goal, Proposal, Propose, by_clarabel
from fomas_verify.region.model import Condition, Region
from fomas_verify.spectrum.loop import Loop, sigma_at
from fomas_verify.spectrum.margins import BITS

SIGMA_TOLERANCE = Fraction(1, 10**6)
"""How far the solver's sigma may lie from the certified one, and sigma at its mu from the bound there."""

MU_TOLERANCE = Fraction(1, 10**6)
"""How far the solver's mu may lie from a certified end, in units of 1/D, unless sigma there is near enough."""

MOST_AGENTS = 40
"""The programs take some seconds at this size, and grow with about the fifth power."""

ATTEMPTS = 2


@dataclass(frozen=True)
class Agreement:
    """On what the LMI agrees with the direct search, and of what no usable answer came, with the reason."""

    agreed: tuple[str, ...]
    failed: tuple[str, ...]


def agreement(region: Region, propose: Propose = by_clarabel) -> Agreement:
    """Compare the region's best contraction, and the ends or the emptiness of `repaired`, with the LMI's.

    Parameters
    ----------
    region : Region
        By the direct search.
    propose : callable
        The solver; its answers are not trusted.

    Returns
    -------
    Agreement
        Nothing of it changes the region.

    Raises
    ------
    DisagreementError
        An answer that stands its own tests lies beyond the tolerance from the certified numbers, at every attempt.
    """
    loop = region.loop
    if not loop.assumption1:
        return Agreement((), ("Assumption 1 fails, which the LMI presupposes",))
    if loop.design.graph.agents > MOST_AGENTS:
        return Agreement((), (f"more than {MOST_AGENTS} agents",))
    agreed, failed = [], []
    for goal in _goals(region):
        reason = _compared(region, goal, propose)
        if reason:
            failed.append(f"{goal.value}: {reason}")
        else:
            agreed.append(goal.value)
    return Agreement(tuple(agreed), tuple(failed))


def _goals(region: Region) -> tuple[Goal, ...]:
    empty = region.strip(Condition.REPAIRED).mu is None
    return (Goal.LEAST_SIGMA,) if empty else tuple(Goal)


def _compared(region: Region, goal: Goal, propose: Propose) -> str:
    """An empty text where they agree, else why there was no usable answer; raises `DisagreementError`."""
    loop, bound = region.loop, region.loop.threshold(BITS).lower
    reason, contradictions = "", []
    for attempt in range(ATTEMPTS):
        proposal = propose(loop, goal, bound, attempt)
        reason = "the solver failed" if proposal is None else _nonsense(loop, proposal)
        if proposal is None or reason:
            continue
        contradiction = _contradiction(region, goal, proposal)
        if contradiction:
            contradictions.append(contradiction)
            continue
        reason = _dual_reason(region, goal, proposal)
        if not reason:
            return ""
    if len(contradictions) == ATTEMPTS:
        raise DisagreementError(f"{loop.design.source}: {goal.value}: {contradictions[-1]}")
    return reason or contradictions[-1]


def _nonsense(loop: Loop, proposal: Proposal) -> str:
    """Why an answer cannot be one, else an empty text."""
    if not (math.isfinite(proposal.mu) and math.isfinite(proposal.rho)):
        return "the solver's answer is no number"
    share = Fraction(proposal.mu) * loop.degree_max
    if not -MU_TOLERANCE <= share <= 1 + MU_TOLERANCE:
        return "the solver's mu lies outside [0, 1/Delta_max]"
    if _sigma(loop, proposal).lower > Fraction(proposal.rho) + SIGMA_TOLERANCE:
        return "the solver's point violates its own inequality"
    return ""


def _sigma(loop: Loop, proposal: Proposal) -> Interval:
    """sigma at the solver's mu; rigorous."""
    mu = max(Fraction(proposal.mu), Fraction(0))
    return Interval.exactly(1) if mu == 0 else sigma_at(loop.laplacian, mu, BITS)


def _contradiction(region: Region, goal: Goal, proposal: Proposal) -> str:
    """How an answer contradicts what is certified, else an empty text."""
    if goal is Goal.LEAST_SIGMA:
        best = region.best
        least = Interval.exactly(0) if best is None else Interval(best.lower, best.upper)
        near = least.lower - SIGMA_TOLERANCE <= Fraction(proposal.rho) <= least.upper + SIGMA_TOLERANCE
        return "" if near else f"the LMI finds {proposal.rho:.12g}, the direct search {float(least.mid):.12g}"
    found = region.strip(Condition.REPAIRED).mu
    if found is None:
        raise TypeError("an empty strip has no ends")
    end = found.lower if goal is Goal.LEAST_MU else found.upper
    mu, room = Fraction(proposal.mu), MU_TOLERANCE / region.loop.degree_max
    if end.lower - room <= mu <= end.upper + room:
        return ""
    # Where sigma hardly changes with mu, an end is known to the solver by sigma only.
    gap = _sigma(region.loop, proposal) - region.loop.threshold(BITS)
    if max(map(abs, gap.ends)) <= SIGMA_TOLERANCE and abs(mu - end.mid) <= 1000 * room:
        return ""
    return f"the LMI finds {proposal.mu:.12g}, the direct search {float(end.mid):.12g}"


def _dual_reason(region: Region, goal: Goal, proposal: Proposal) -> str:
    """Where `repaired` is empty: an empty text if the solver's dual, rounded to integers, proves that exactly."""
    if goal is not Goal.LEAST_SIGMA or region.strip(Condition.REPAIRED).mu is not None:
        return ""
    loop, threshold = region.loop, region.loop.threshold(BITS).upper
    vectors = [x for pair in proposal.pairs for x in pair]
    if not 0 < len(proposal.pairs) <= MOST_PAIRS or not all(math.isfinite(entry) for x in vectors for entry in x):
        return "the solver's dual is no proof that no mu will do"
    exactly = [([Fraction(x) for x in u], [Fraction(x) for x in v]) for u, v in proposal.pairs]
    if any(lower_bound(loop, integer_pairs(exactly, bits)) > threshold for bits in VECTOR_BITS[2:]):
        return ""
    return "the solver's dual, rounded, is no proof that no mu will do"
