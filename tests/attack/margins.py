"""Truth of `values.margins`: how far mu and alpha may move, by section 3 of docs/certificate-format.md."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from typing import Any

from mpmath import mp

from . import oracle, ties
from .alpha_range import DPS, excess, gain_span, rounded, truth_over
from .bounds import memory_at_0
from .boxes import memory_at_1, over_box
from .gain import Truth, both, mu_at_least, mu_at_most
from .model import Design, assumption_1, degree_max
from .spectral_witness import leaves, stays

Ends = tuple[Fraction, Fraction]


def at_gain(design: Design, t: Fraction) -> Design:
    """The design with mu = t."""
    return replace(design, mu=t, gamma=None)


def at_alpha(design: Design, alpha: Fraction) -> Design:
    """The design with another alpha, gamma and h or mu as they are."""
    return replace(design, alpha=alpha)


def _memory_reached(design: Design) -> Truth:
    """beta >= 2^alpha - 1; what 300 digits do not separate and the exact test finds at most so is equal."""
    answer = oracle.settle(design, lambda dps: oracle.beta(design, dps) - oracle.threshold(design, dps))
    return True if answer.truth is None and ties.memory_at_0(design) else answer.truth


def _memory_passed(design: Design) -> Truth:
    """beta <= -sqrt(3^alpha - 2^alpha), which is never an equality at a rational mu."""
    truth = memory_at_1(design)
    return None if truth is None else not truth


def _not(truth: Truth) -> Truth:
    return None if truth is None else not truth


def _mu_tests(design: Design, claim: str, entry: dict[str, Any]) -> list[Truth]:
    (a, b), (c, d) = entry["inner"], entry["outer"]
    if claim == "gain-bound":
        most = degree_max(design)
        return [c == 0, b * most <= 1 <= d * most]
    if claim == "perron-eigenvalues":
        return [c == 0, stays(design, b, entry["Q"]), leaves(design, d, entry)]
    inside, last = [at_gain(design, t) for t in (a, b)], at_gain(design, d)
    if a == 0:
        return [False]
    before = at_gain(design, c) if c else None
    if claim == "memory-inequality":
        first = True if before is None else _memory_reached(before)
        return [memory_at_0(inside[0]).truth, memory_at_1(inside[1]), first, _memory_passed(last)]
    held = [oracle.decide(end, claim).truth for end in inside]
    return held + [_not(oracle.decide(end, claim).truth) for end in (before, last) if end is not None]


def _of_mu(design: Design, claim: str, entry: dict[str, Any]) -> Truth:
    (a, b), (c, d) = entry["inner"], entry["outer"]
    return 0 <= c <= a < b <= d and both(*_mu_tests(design, claim, entry))


def _by_the_ends_of_mu(design: Design, truth: bool, inner: Ends, ends: dict[str, Any] | None) -> Truth:
    """True if mu <= b, or mu >= d, over the interval of alpha, b and d those of the margin in mu."""
    if ends is None:
        return None
    b, d = ends["inner"][1], ends["outer"][1]
    if design.mu is not None:
        return (design.mu <= b if truth else design.mu >= d) or None
    with mp.workdps(DPS + oracle.scale(design)):
        low, high = gain_span(design, *map(oracle.real, inner))
        return bool(high < oracle.real(b) if truth else low > oracle.real(d)) or None


def _of_alpha(design: Design, claim: str, entry: dict[str, Any], ends: dict[str, Any] | None) -> Truth:
    (a, b), (c, d) = entry["inner"], entry["outer"]
    ordered = 0 <= a <= design.alpha <= b <= 1
    if not ordered or (c is not None and not 0 < c < a) or (d is not None and not b < d < 1):
        return False
    truth = oracle.decide(design, claim).truth
    if truth is None:
        return None
    changed = [oracle.decide(at_alpha(design, end), claim).truth for end in (c, d) if end is not None]
    if truth in changed:
        return False
    fixed = design.mu is not None and claim in oracle.ANY_GRAPH
    answers = [None if None in changed else True, fixed or truth_over(design, claim, truth, a, b)]
    if claim == "perron-eigenvalues" and False not in answers:
        answers.append(_by_the_ends_of_mu(design, truth, (a, b), ends))
    return both(*answers)


def gain_hull(design: Design, inner: Ends) -> tuple[Ends, Ends]:
    """Rational ends of mu over an interval of alpha: inside its range, and beyond it by the excess of section 7."""
    if design.mu is not None:
        return (design.mu, design.mu), (design.mu, design.mu)
    assert design.h is not None
    with mp.workdps(DPS + oracle.scale(design)):
        low, high = map(rounded, gain_span(design, *map(oracle.real, inner)))
    room = excess(design.h, inner)
    shrunk = low + low / 10**50, max(high - high / 10**50, low + low / 10**50)
    return shrunk, (low * max(1 - room, Fraction(1, 10**6)), high * (1 + room))


def _neighbourhood(design: Design, key: str, entry: dict[str, Any]) -> Truth:
    claim, (a, b) = "control-norm-bound", entry["inner"]
    truth = oracle.decide(design, claim).truth
    if truth is not None and truth != (entry["verdict"] == "proved"):
        return False
    within = both(mu_at_least(design, a), mu_at_most(design, b)) if key == "mu" else 0 < a <= design.alpha <= b < 1
    if not a <= b or within is False:
        return False
    given = (claim, entry["verdict"], entry["witness"])
    known = None if truth is None else True
    if key == "mu":
        if a <= 0:
            return None if entry["verdict"] == "refuted" else False
        return both(within, known, over_box(design, *given, (design.alpha, design.alpha), (a, b)))
    inside, beyond = gain_hull(design, (a, b))
    if over_box(design, *given, (a, b), inside) is False:
        return False
    return both(known, over_box(design, *given, (a, b), beyond) or None)


def holds(design: Design, margins: dict[str, dict[str, Any]]) -> Truth:
    """Whether every margin is true of the design."""
    answers: list[Truth] = []
    for claim, parts in margins.items():
        if claim not in oracle.ANY_GRAPH and not assumption_1(design):
            return False
        for key, entry in parts.items():
            if claim == "control-norm-bound":
                answers.append(_neighbourhood(design, key, entry))
            elif key == "mu":
                answers.append(_of_mu(design, claim, entry))
            else:
                answers.append(_of_alpha(design, claim, entry, parts.get("mu")))
    return both(*answers)
