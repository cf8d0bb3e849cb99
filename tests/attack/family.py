"""Truth of the ten claims about an uncertain design: of every member, or with a member that fails.

The members' (alpha, mu) fill the strip between the two curves that the lower and the upper ends of gamma and h (or mu)
draw over the interval of alpha. At a fixed alpha each claim but the norm bounds on digraphs is decided by the ends of
mu; along alpha by halving (`alpha_range`). The norm bounds on digraphs are searched in floats for a member that fails.
"""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from functools import lru_cache
from typing import Any

from mpmath import mp

from . import oracle, ties
from .alpha_range import DPS, SPANS, Span, gain_at, gain_span, halved, rounded, turning_point
from .bounds import is_symmetric
from .boxes import Loop, start_of
from .gain import Truth
from .model import Design, Uncertain, x0_columns

SPECTRAL = ("perron-eigenvalues", "control-bounded", "average-consensus")
GRID, ZOOMS, SAMPLES = 9, 6, 48


def gains_over(family: Uncertain, x: Any, y: Any) -> Span:
    """The range of the members' mu over the alphas of [x, y]."""
    return gain_span(family.member({}, 0), x, y)[0], gain_span(family.member({}, 1), x, y)[1]


def most_gain(family: Uncertain) -> Design:
    """A member with the largest mu, its alpha rounded where it is not rational."""
    upper = family.member({}, 1)
    if upper.mu is not None:
        return upper
    assert upper.h is not None
    with mp.workdps(DPS):
        turn = rounded(turning_point(upper.h))
    return replace(upper, alpha=min(max(turn, family.alpha[0]), family.alpha[1]))


def least_gain(family: Uncertain) -> Design:
    """A member with the least mu."""
    ends = [family.member({"alpha": alpha}) for alpha in family.alpha]
    return min(ends, key=lambda member: oracle.mu(member, DPS))


def _by_spans(family: Uncertain, claim: str) -> tuple[Truth, Design | None]:
    """By halving the interval of alpha; with the member that fails."""
    design = family.member({})
    dps = DPS + 10 + oracle.scale(family.member({}, 1))

    def span(x: Any, y: Any) -> Span:
        return SPANS[claim](design, x, y, gains_over(family, x, y))

    truth, alpha = halved(span, *family.alpha, dps)
    if truth is True:
        return True, None
    for side in (0, 1):
        member = family.member({"alpha": alpha}, side)
        if oracle.decide(member, claim).truth is False:
            return False, member
    return None, None


def _ratios(design: Design, start: Any, alpha: float, gain: float) -> float:
    loop = Loop(design, start, alpha, gain, SAMPLES, SAMPLES)
    return max(loop.controls)


def _searched(family: Uncertain, claim: str) -> tuple[Truth, Design | None]:
    """A member where norm Phi_k, or norm(Phi_k e)/norm(e), exceeds 1, by a grid that closes in on the largest."""
    design = family.member({})
    start = start_of(design, x0_columns(design) if claim == "trajectory-norm-bound" else None)
    if start.columns is None:
        return True, None
    low, high = family.member({}, 0), family.member({}, 1)
    alphas, sides = family.alpha, (Fraction(0), Fraction(1))
    for _ in range(ZOOMS):
        points = []
        for i in range(GRID):
            alpha = alphas[0] + (alphas[1] - alphas[0]) * Fraction(i, GRID - 1)
            with mp.workdps(20):
                first, last = (float(gain_at(end, oracle.real(alpha))) for end in (low, high))
            for j in range(GRID):
                side = sides[0] + (sides[1] - sides[0]) * Fraction(j, GRID - 1)
                ratio = _ratios(design, start, float(alpha), first + float(side) * (last - first))
                points.append((ratio, alpha, side))
        ratio, alpha, side = max(points)
        member = _at_side(family, alpha, side)
        if ratio > 1 + 1e-7 and oracle.decide(member, claim).truth is False:
            return False, member
        alphas, sides = (_closer(ends, at) for ends, at in ((alphas, alpha), (sides, side)))
    return None, None


def _closer(ends: tuple[Fraction, Fraction], at: Fraction) -> tuple[Fraction, Fraction]:
    step = (ends[1] - ends[0]) / (GRID - 1)
    return max(ends[0], at - step), min(ends[1], at + step)


def _at_side(family: Uncertain, alpha: Fraction, side: Fraction) -> Design:
    """The member with this alpha and its gain (by gamma, h or mu) this part of the way up."""
    key = next((key for key in ("mu", "gamma") if key in family.ends()), "mu")
    low, high = family.ends()[key]
    numbers = {"alpha": alpha, key: low + side * (high - low)}
    if family.h is not None and family.gamma is not None and low == high:
        numbers["h"] = family.h[0] + side * (family.h[1] - family.h[0])
    elif family.h is not None:
        numbers["h"] = family.h[1] if side > Fraction(1, 2) else family.h[0]
    return family.member(numbers)


def _contraction(family: Uncertain) -> tuple[Truth, Design | None]:
    """The gains for which the step holds are an interval from 0, so the largest decides."""
    member = most_gain(family)
    answer = oracle.decide(member, "beta-contraction").truth
    if answer is False:
        near = replace(member, alpha=Fraction(int(member.alpha * 2**40), 2**40))
        near = near if family.alpha[0] <= near.alpha else member
        return False, near if oracle.decide(near, "beta-contraction").truth is False else member
    with mp.workdps(100):
        truth = ties.contraction(replace(member, mu=None), gain_at(member, oracle.real(member.alpha)))
    return (answer and truth if member.mu is None else answer), None


@lru_cache(maxsize=512)
def decide(family: Uncertain, claim: str) -> tuple[Truth, Design | None]:
    """Whether the claim is true of every member, and a member of which it is false where one was found."""
    try:
        return _decide(family, claim)
    except oracle.UNDECIDED:
        return None, None


def _decide(family: Uncertain, claim: str) -> tuple[Truth, Design | None]:
    if claim == "graph-assumption":
        return oracle.decide(family.member({}), claim).truth, None
    if family.mu is not None and claim in ("gain-bound", *SPECTRAL, "beta-contraction"):
        member = family.member({}, 1)
        truth = oracle.decide(member, claim).truth
        return truth, None if truth else member
    if claim == "beta-contraction":
        return _contraction(family)
    if claim in SPECTRAL:
        return _by_spans(family, "perron-eigenvalues")
    if claim == "trajectory-norm-bound" or (claim == "control-norm-bound" and not is_symmetric(family.member({}))):
        if _by_spans(family, "repaired-condition")[0]:
            return True, None
        return _searched(family, claim)
    return _by_spans(family, claim)


def verdict(family: Uncertain, claim: str) -> str | None:
    """`proved`, `refuted` or `inapplicable`; None where the oracle cannot tell."""
    if oracle.verdict(family.member({}), "graph-assumption") == "refuted" and claim not in oracle.ANY_GRAPH:
        return "inapplicable"
    truth = decide(family, claim)[0]
    return None if truth is None else "proved" if truth else "refuted"
