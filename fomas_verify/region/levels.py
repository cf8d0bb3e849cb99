"""On which mu k samples settle: ``sigma(mu)^k <= eps``. More samples, more mu."""

from __future__ import annotations

from fractions import Fraction
from functools import cache

from fomas_verify.enclosure.interval import Interval, short_dyadic
from fomas_verify.enclosure.real import power_of
from fomas_verify.region.least_factor import Line, least_factor, line_at
from fomas_verify.spectrum.contraction import contraction_interval
from fomas_verify.spectrum.loop import Loop, sigma_at
from fomas_verify.spectrum.margins import BITS, above, below

NEAR = 40
"""A line touches sigma within 2^-40 of the upper end of a level."""

INWARD = (72, 56, 40, 24, 12)
"""A certified end lies inward of the level's by 2^-72 of itself, or by the first of the others that will do."""


@cache
def level(loop: Loop, settle_to: Fraction, k: int) -> Interval | None:
    """An interval outside of which no mu has ``sigma(mu)^k <= settle_to``; None where no mu of [0, 1/D] has it.

    Rigorous; its ends are within about 2^-90 of themselves of the true ones. Presupposes Assumption 1.
    """
    return contraction_interval(loop, factor(settle_to, k))


@cache
def known_lines(loop: Loop) -> list[Line]:
    """Lines below sigma, each nearly touching it somewhere, to which whoever finds one adds it. Each holds for every
    mu, so that it may show without a search that sigma is too large somewhere else.
    """
    return [line_at(loop, 1 / loop.degree_max)]


def touch(loop: Loop, found: Interval) -> None:
    """Add the lines that touch sigma just outside both ends of a level."""
    gap = found.upper / (1 << NEAR)
    for low, high in ((found.lower - gap, found.lower), (found.upper, found.upper + gap)):
        if high > 0:
            known_lines(loop).append(line_at(loop, short_dyadic(max(low, Fraction(0)), high)))


@cache
def enclosed_level(loop: Loop, settle_to: Fraction, k: int) -> tuple[Interval, Interval] | None:
    """Both ends of the mu that settle in k samples, enclosed; None where no mu does, or none was found. Rigorous."""
    found, within = level(loop, settle_to, k), factor(settle_to, k).lower
    if found is None:
        return None
    for shift in INWARD:
        low, high = above(found.lower, shift), below(found.upper, shift)
        if low < high and all(sigma_at(loop.laplacian, mu, BITS).upper <= within for mu in (low, high)):
            return Interval(found.lower, low), Interval(high, found.upper)
    return None


def factor(settle_to: Fraction, k: int) -> Interval:
    """``settle_to^(1/k)``."""
    return power_of(Interval.exactly(settle_to), Fraction(1, k), BITS)


def settles(loop: Loop, mu: Interval, settle_to: Fraction, k: int) -> bool:
    """Whether it is certain that ``sigma(mu)^k <= settle_to``; rigorous, as sigma is convex in mu."""
    within = factor(settle_to, k).lower
    return all(sigma_at(loop.laplacian, end, BITS).upper <= within for end in mu.outward(BITS).ends)


def fewest_samples(loop: Loop, settle_to: Fraction) -> int:
    """A number of samples that no mu of [0, 1/D] settles in fewer than."""
    best = least_factor(loop)
    low, high = 0, 1
    if best is None:
        return 1
    while best.lower > factor(settle_to, high).upper:
        low, high = high, 2 * high
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (middle, high) if best.lower > factor(settle_to, middle).upper else (low, middle)
    return high
