"""The members of an uncertain design: the range of their mu, and one that breaks a claim.

Everything depends on a member through (alpha, mu) alone. Source: docs/certificate-format.md, section 7.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from functools import cache
from itertools import pairwise
from typing import Any

from fomas_verify.claims.registry import CLAIMS, Claim
from fomas_verify.claims.verdict import Decision, Verdict
from fomas_verify.design import Design, UncertainDesign
from fomas_verify.enclosure.digits import decimal
from fomas_verify.enclosure.interval import Interval, short_dyadic
from fomas_verify.kernel.memory import one_step_weight_over
from fomas_verify.spectrum.alpha_margins import may_be_written
from fomas_verify.spectrum.loop import Loop

BITS = 128
PARTS, DIVISIONS = 64, 12
"""Parts of the interval of alpha among which the greatest mu is sought, and how often those that may hold it are
divided."""

MOST_SAMPLES = 400
"""Samples of a member examined in search of a refutation."""

STEEPEST_WIDTH = Fraction(1, 1 << 20)
"""How near to the alpha of the largest mu a member is looked for."""


def mu_over(design: UncertainDesign, alpha: Interval) -> Interval:
    """An enclosure of the mu of every member whose alpha lies in a slab; rigorous."""
    mu, gamma, h = map(design.range_of, ("mu", "gamma", "h"))
    if mu is not None:
        return mu
    if gamma is None or h is None:
        raise TypeError("a closed loop needs mu, or gamma and h")
    return one_step_weight_over(alpha, h, BITS) * gamma


def mu_of_every_member(design: UncertainDesign) -> Interval:
    """An enclosure of the mu of every member; rigorous. In alpha mu is log-concave, so least at an end."""
    alpha = alpha_of(design)
    if alpha.is_exact or design.range_of("mu") is not None:
        return mu_over(design, alpha)
    return Interval(min(mu_over(design, Interval.exactly(end)).lower for end in alpha.ends), _greatest(design, alpha))


def _greatest(design: UncertainDesign, alpha: Interval) -> Fraction:
    """A bound of the greatest mu: between two of equally spaced points, m_i and m_(i+1), it is at most
    ``m_i max(1, m_i / m_(i-1))``, and the same from the right; the parts where it may be are divided again.
    """
    found, slack = Fraction(0), 1 + Fraction(1, 1 << (BITS // 2))
    for _ in range(DIVISIONS):
        points = [alpha.lower + alpha.width * i / PARTS for i in range(PARTS + 1)]
        m = [mu_over(design, Interval.exactly(point)).upper for point in points]
        growth = [max(Fraction(1), b / a) for a, b in pairwise(m)]
        decline = [max(Fraction(1), a / b) for a, b in pairwise(m)]
        inner = [min(m[i] * growth[i - 1], m[i + 1] * decline[i + 1]) for i in range(1, PARTS - 1)]
        bounds = [x * slack for x in (m[1] * decline[1], *inner, m[-2] * growth[-2])]
        found = max(found, max(m) * slack)
        live = [i for i, bound in enumerate(bounds) if bound > found]
        if not live:
            return found
        alpha, last = Interval(points[live[0]], points[live[-1] + 1]), max(bounds)
    return last


def alpha_of(design: UncertainDesign) -> Interval:
    """The interval of alpha, of one number where it is certain."""
    return design.range_of("alpha") or Interval.exactly(design.least.alpha)


def halves(x: Interval) -> tuple[Interval, Interval]:
    """Two parts that meet in a number of few bits in the middle third."""
    cut = short_dyadic(x.lower + x.width / 3, x.upper - x.width / 3)
    return Interval(x.lower, cut), Interval(cut, x.upper)


def refuting_member(
    design: UncertainDesign, claim: Claim, slab: Interval, mu: Interval | None = None
) -> Decision | None:
    """The refutation of a claim for a member with its alpha in a slab, near the middle of a part of mu or else at an
    end of the intervals; None where none was found.
    """
    for member in _corners(design, slab) if mu is None else [_near(design, slab, mu)]:
        found = _decided(claim.ID, member)
        if found.verdict is Verdict.REFUTED:
            return _for_member(design, member, found)
    return None


@cache
def _decided(claim: str, member: Design) -> Decision:
    return next(x for x in CLAIMS if claim == x.ID).decide(Loop(member, MOST_SAMPLES))


def is_cut(slab: Interval) -> bool:
    """Whether a slab has a middle that a certificate may hold."""
    return not slab.is_exact and may_be_written(halves(slab)[0].upper)


def _middle(slab: Interval) -> Fraction:
    return halves(slab)[0].upper if is_cut(slab) else slab.lower


def _near(design: UncertainDesign, slab: Interval, mu: Interval) -> Design:
    """The member with the alpha in the middle of a slab whose mu is nearest to the middle of a part."""
    alpha = _middle(slab)
    return design.member(alpha, _share(mu_over(design, Interval.exactly(alpha)), mu.mid))


def _corners(design: UncertainDesign, slab: Interval) -> Iterator[Design]:
    """The ends of the intervals, with the middle of alpha and the one of the largest mu, the largest mu first."""
    alphas = {slab.lower, _middle(slab), slab.upper, _steepest(design, slab)}
    ordered = sorted(alphas, key=lambda alpha: -mu_over(design, Interval.exactly(alpha)).upper)
    for share in (Fraction(1), Fraction(0)) if design.ranges.keys() - {"alpha"} else (Fraction(1),):
        for alpha in ordered:
            yield design.member(alpha, share)


def _steepest(design: UncertainDesign, slab: Interval) -> Fraction:
    """An alpha near the one whose members have the largest mu, which is log-concave in alpha."""
    while slab.width > STEEPEST_WIDTH:
        left, right = (short_dyadic(x, x + slab.width / 16) for x in (slab.lower + slab.width / 3, slab.mid))
        smaller = mu_over(design, Interval.exactly(left)).upper < mu_over(design, Interval.exactly(right)).upper
        slab = Interval(left, slab.upper) if smaller else Interval(slab.lower, right)
    return slab.lower


def _share(range_: Interval, mu: Fraction) -> Fraction:
    """How far through a range a number lies, in 1024 parts."""
    if range_.width == 0:
        return Fraction(0)
    return Fraction(min(1024, max(0, round((mu - range_.lower) / range_.width * 1024))), 1024)


def _for_member(design: UncertainDesign, member: Design, found: Decision) -> Decision:
    """The refutation in the terms of the uncertain design."""
    numbers: dict[str, Fraction | None] = {"alpha": member.alpha, "gamma": member.gamma, "mu": member.mu, "h": member.h}
    given = {key: x for key, x in numbers.items() if x is not None}
    named = ", ".join(f"{key} = {decimal(Interval.exactly(x), 12)}" for key, x in given.items() if key in design.ranges)
    witness: dict[str, Any] = {"member": given, "witness": found.witness}
    remedy = f"for the member {named}: {found.remedy}" if found.remedy else ""
    return replace(found, witness=witness, reason=f"for the member {named}: {found.reason}", remedy=remedy)
