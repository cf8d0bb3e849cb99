"""The smallest alpha at which some mu satisfies a condition, between an alpha that opens it and one that does not.

Source: theory, section 5. Each condition is the easier to satisfy, the larger alpha.
"""

from __future__ import annotations

from fractions import Fraction

from fomas_verify.enclosure.interval import Interval, round_down, round_up
from fomas_verify.enclosure.real import log2, square_root
from fomas_verify.kernel.memory import threshold
from fomas_verify.region.errors import UndecidedRegionError
from fomas_verify.region.least_factor import LeastFactor, short_pairs
from fomas_verify.region.model import Opening
from fomas_verify.spectrum.loop import Loop
from fomas_verify.spectrum.margins import BITS

PLACES = 60
"""Bits after the point of an alpha; its denominator has to stay below 2^64."""


def as_stated_opening(loop: Loop) -> Opening | None:
    """``log2(2 - lambda2/D)``; every alpha where ``lambda2 >= D``. Rigorous."""
    bound = 1 - loop.lambda2(BITS) / loop.degree_max
    return None if bound.upper <= 0 else _opening(bound)


def closed_form_opening(loop: Loop) -> Opening | None:
    """The alpha with ``lambda2 = 2 D (1 - (2^alpha - 1)^2)``; every alpha where ``lambda2 >= 2 D``. Rigorous."""
    square = 1 - loop.lambda2(BITS) / (2 * loop.degree_max)
    return None if square.upper <= 0 else _opening(square_root(square, BITS))


def repaired_opening(loop: Loop, best: LeastFactor) -> Opening:
    """``log2(1 + inf sigma)``, the infimum over ``0 < mu < 1/D``. Rigorous."""
    found = _opening(Interval(best.lower, best.upper))
    pairs = short_pairs(loop, best, threshold(found.alpha.lower, BITS).upper)
    if pairs is None:
        raise UndecidedRegionError(f"{loop.design.source}: repaired: which alpha open it was not decided")
    return Opening(found.alpha, {"pairs": pairs, "mu": best.mu})


def _opening(bound: Interval) -> Opening:
    """The alpha at which ``2^alpha - 1`` passes the bound, with room on either side."""
    ends = log2(Interval(max(bound.lower, Fraction(0)), bound.upper) + 1, BITS)
    unit = Fraction(1, 1 << PLACES)
    lower, upper = round_down(ends.lower, PLACES) - unit, round_up(ends.upper, PLACES) + unit
    return Opening(Interval(max(lower, Fraction(0)), min(upper, Fraction(1))))
