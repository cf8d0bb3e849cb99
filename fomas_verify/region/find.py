"""The five strips of a design, each end between a mu that is feasible and one that is not.

A direct search: closed forms in lambda2 and the threshold, Newton's steps on sigma, mu*. Source: theory, section 5.
"""

from __future__ import annotations

from fractions import Fraction

from fomas_verify.design import Design, DesignError
from fomas_verify.enclosure.interval import Interval, short_dyadic
from fomas_verify.enclosure.real import square_root
from fomas_verify.region.errors import UndecidedRegionError
from fomas_verify.region.least_factor import LeastFactor, least_factor, short_pairs
from fomas_verify.region.model import Condition, Region, Strip
from fomas_verify.region.openings import as_stated_opening, closed_form_opening, repaired_opening
from fomas_verify.spectrum import margins
from fomas_verify.spectrum.loop import Loop
from fomas_verify.spectrum.margins import BITS, FINE, MuMargin, above, below

MOST_AGENTS = 120
"""The exact path takes about a quarter of a minute at this size, the checker half a minute."""

STABILITY_GAPS = (32, *margins.STABILITY_GAPS)
"""Either side of mu* is passed by 2^-32 to 2^-31 of it where a witness is found so near."""


def find_region(design: Design) -> Region:
    """The certified feasible mu of every condition.

    Parameters
    ----------
    design : Design
        With or without gamma, mu and h; of at least one edge.

    Returns
    -------
    Region
        Rigorous. Where Assumption 1 fails, which the other conditions include, only gain-bound has a strip.

    Raises
    ------
    DesignError
        The graph has no edge, so that no mu is too large.
    UndecidedRegionError
        A strip was not decided within the work allowed, or the design has too many agents.
    """
    if not design.graph.edges:
        raise DesignError(f"{design.source}: graph: region needs at least one edge; got none")
    if design.graph.agents > MOST_AGENTS:
        raise UndecidedRegionError(
            f"{design.source}: more than {MOST_AGENTS} agents are beyond region for now: undecided"
        )
    loop = Loop(design)
    bound = _gain_bound(loop)
    if not loop.assumption1:
        strips = [Strip(condition, bound if condition is Condition.GAIN_BOUND else None) for condition in Condition]
        return Region(loop, tuple(strips), None)
    best = least_factor(loop)
    strips = [
        _as_stated(loop, bound),
        _closed_form(loop),
        _repaired(loop, bound, best),
        Strip(Condition.GAIN_BOUND, bound),
        Strip(Condition.CONSENSUS, _consensus(loop)),
    ]
    return Region(loop, tuple(strips), best)


def _gain_bound(loop: Loop) -> MuMargin:
    """``0 < mu < 1/D``."""
    end = 1 / loop.degree_max
    return _from_zero(Interval.exactly(end), below(end, FINE), end, {})


def _from_zero(end: Interval, inner: Fraction, outer: Fraction, witness: dict[str, object]) -> MuMargin:
    """The margin of ``0 < mu < end``: its ends included, the inner interval begins just above 0."""
    tiny = short_dyadic(inner / (1 << FINE), inner / (1 << FINE - 1))
    return MuMargin(Interval.exactly(0), end, (tiny, inner), (Fraction(0), outer), witness)


def _both(one: MuMargin, other: MuMargin) -> MuMargin | None:
    """Where two conditions hold; None where the inner intervals do not meet."""
    inner = max(one.inner[0], other.inner[0]), min(one.inner[1], other.inner[1])
    if inner[0] > inner[1]:
        return None
    outer = max(one.outer[0], other.outer[0]), min(one.outer[1], other.outer[1])
    lower = Interval(max(one.lower.lower, other.lower.lower), max(one.lower.upper, other.lower.upper))
    upper = Interval(min(one.upper.lower, other.upper.lower), min(one.upper.upper, other.upper.upper))
    return MuMargin(lower, upper, inner, outer)


def _as_stated(loop: Loop, bound: MuMargin) -> Strip:
    """(15) and (14)."""
    memory, opening = margins.memory_inequality(loop), as_stated_opening(loop)
    mu = _both(memory, bound)
    if mu is None and memory.lower.lower * loop.degree_max < 1:
        raise _undecided(loop, Condition.AS_STATED)
    return Strip(Condition.AS_STATED, mu, opening)


def _closed_form(loop: Loop) -> Strip:
    """``2 D lambda2 mu^2 - 2 lambda2 mu + 1 - (2^alpha - 1)^2 <= 0``: both roots lie between 0 and 1/D."""
    threshold = loop.threshold(BITS)
    middle, opening = 1 / (2 * loop.degree_max), closed_form_opening(loop)
    room = 1 - (1 - threshold * threshold) * (2 * loop.degree_max) / loop.lambda2(BITS)
    if room.upper < 0:
        return Strip(Condition.CLOSED_FORM, None, opening)
    spread = square_root(room, BITS)
    lower, upper = (1 - spread) * middle, (spread + 1) * middle
    inner = above(lower.upper, FINE), below(upper.lower, FINE)
    if inner[0] > inner[1]:
        raise _undecided(loop, Condition.CLOSED_FORM)
    mu = MuMargin(lower, upper, inner, (below(lower.lower, FINE), above(upper.upper, FINE)))
    return Strip(Condition.CLOSED_FORM, mu, opening)


def _repaired(loop: Loop, bound: MuMargin, best: LeastFactor | None) -> Strip:
    """``sigma(mu) <= 2^alpha - 1``, and (15)."""
    opening = None if best is None else repaired_opening(loop, best)
    threshold = loop.threshold(BITS).upper
    if best is not None and best.lower > threshold:
        pairs = short_pairs(loop, best, threshold)
        if pairs is not None:
            return Strip(Condition.REPAIRED, None, opening, {"pairs": pairs})
    found = margins.repaired_condition(loop)
    mu = None if found is None else _both(found, bound)
    if mu is None:
        raise _undecided(loop, Condition.REPAIRED)
    return Strip(Condition.REPAIRED, mu, opening)


def _consensus(loop: Loop) -> MuMargin:
    """``0 < mu < mu*``."""
    found = margins.perron_eigenvalues(loop, STABILITY_GAPS)
    if found is None:
        raise _undecided(loop, Condition.CONSENSUS)
    return _from_zero(found.upper, found.inner[1], found.outer[1], dict(found.witness))


def _undecided(loop: Loop, condition: Condition) -> UndecidedRegionError:
    return UndecidedRegionError(f"{loop.design.source}: {condition}: not decided within the work allowed")
