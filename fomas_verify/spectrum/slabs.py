"""All alpha of an interval, a *slab*, at once: the range of mu, and whether a claim is true, or false, throughout.

gamma and h, or mu, are the design's. c_1 and c_2 increase with alpha. Source: theory, section 8.
"""

from __future__ import annotations

from bisect import insort
from collections.abc import Callable
from fractions import Fraction

from fomas_verify.enclosure.interval import Interval, short_dyadic
from fomas_verify.enclosure.real import square_root
from fomas_verify.kernel.memory import one_step_weight_over, step_response, step_response_over
from fomas_verify.spectrum import margins as of_mu
from fomas_verify.spectrum.loop import Loop, sigma_at
from fomas_verify.spectrum.margins import MuMargin
from fomas_verify.spectrum.remembered import of_loop
from fomas_verify.spectrum.samples import Box

BITS = 128
KNOT_SHIFTS = (8, 40)
"""A knot is put next to mu, within 2^-8 and within 2^-40 of it."""
KNOT_WORK, FEWEST_KNOTS = 2_000_000_000, 6
"""Bounds on the values of sigma computed, times N^4, and on their number, whichever allows more."""

Knot = tuple[Fraction, Interval]
Truth = Callable[[Interval], bool | None]
"""Whether a claim is true for every alpha of a slab (True), for none (False), or neither was seen (None). Rigorous."""


def mu_over(loop: Loop, alpha: Interval) -> Interval:
    """An interval that holds mu for every alpha of the slab."""
    design = loop.design
    if design.mu is not None:
        return Interval.exactly(design.mu)
    if design.gamma is None or design.h is None:
        raise TypeError("a closed loop needs mu, or gamma and h")
    return one_step_weight_over(alpha, Interval.exactly(design.h), BITS) * design.gamma


def gain_bound(loop: Loop) -> Truth:
    """``mu < 1/D``; always true without edges."""
    margin = of_mu.gain_bound(loop)
    return (lambda _: True) if margin is None else _below(loop, margin)


def perron_eigenvalues(loop: Loop) -> Truth:
    """``mu < mu*``, where the margin in mu encloses mu*."""
    margin = of_mu.perron_eigenvalues(loop)
    return (lambda _: None) if margin is None else _below(loop, margin)


def _below(loop: Loop, margin: MuMargin) -> Truth:
    """True up to b, unless b is the end itself, and false from d on."""

    def truth(alpha: Interval) -> bool | None:
        mu = mu_over(loop, alpha)
        if mu.upper <= margin.inner[1] and mu.upper < margin.upper.lower:
            return True
        return False if mu.lower >= margin.outer[1] else None

    return truth


def memory_inequality(loop: Loop) -> Truth:
    """``-sqrt(c_2) <= beta <= c_1``."""
    lambda2 = loop.lambda2(BITS)

    def truth(alpha: Interval) -> bool | None:
        beta = 1 - mu_over(loop, alpha) * lambda2
        upper, lower = step_response_over(alpha, 1, BITS), -square_root(step_response_over(alpha, 2, BITS), BITS)
        if beta.upper <= upper.lower and beta.lower >= lower.upper:
            return True
        return False if beta.lower > upper.upper or beta.upper < lower.lower else None

    return truth


def repaired_condition(loop: Loop) -> Truth:
    """``sigma <= c_1``; sigma is convex in mu, and ``sigma(mu) >= sigma(m) - 2 D abs(mu - m)``."""
    chords, steepest = chords_of(loop), 2 * loop.degree_max

    def truth(alpha: Interval) -> bool | None:
        mu, threshold = mu_over(loop, alpha), step_response_over(alpha, 1, BITS)
        if chords.exceeds(mu.lower, threshold.upper + steepest * mu.width):
            return False
        return True if contracts_over(loop, Box(alpha, mu)) else None

    return truth


def contracts_over(loop: Loop, box: Box) -> bool:
    """Whether ``sigma <= 2^alpha - 1`` all over the box, certainly."""
    threshold = step_response(box.alpha.lower, 1, BITS).lower
    return all(chords_of(loop).exceeds(end, threshold) is False for end in (box.mu.lower, box.mu.upper))


@of_loop
def chords_of(loop: Loop) -> Chords:
    """Those of one loop, kept."""
    return Chords(loop)


class Chords:
    """Bounds of sigma from its values at some mu, the *knots*: between two it lies below the chord, and above what the
    chords on either side prolong to.
    """

    def __init__(self, loop: Loop) -> None:
        """Begin with ``sigma(0) = 1``."""
        self._loop = loop
        self._knots: list[Knot] = [(Fraction(0), Interval.exactly(1))]
        self._most = max(FEWEST_KNOTS, KNOT_WORK // loop.design.graph.agents**4)

    def exceeds(self, mu: Fraction, level: Fraction) -> bool | None:
        """Whether ``sigma(mu) > level``; None where knots near mu do not tell, or are too many. Rigorous."""
        for shift in (None, *KNOT_SHIFTS):
            if shift is not None:
                self._add(short_dyadic(mu, mu * (1 + Fraction(1, 1 << shift))))
            bounds = self._bounds(mu)
            if bounds.lower > level or bounds.upper <= level:
                return bounds.lower > level
        return None

    def sigma(self, mu: Fraction) -> Interval:
        """An enclosure of sigma(mu); rigorous."""
        self._add(short_dyadic(mu, mu * (1 + Fraction(1, 1 << KNOT_SHIFTS[0]))))
        return self._bounds(mu)

    def _add(self, mu: Fraction) -> None:
        if len(self._knots) < self._most and all(mu != knot for knot, _ in self._knots):
            insort(self._knots, (mu, sigma_at(self._loop.laplacian, mu, BITS)), key=lambda knot: knot[0])

    def _bounds(self, mu: Fraction) -> Interval:
        before = [knot for knot in self._knots if knot[0] <= mu][-2:]
        after = [knot for knot in self._knots if knot[0] > mu][:2]
        slope = 2 * self._loop.degree_max
        lowers = [value.lower - slope * abs(mu - knot) for knot, value in (before[-1], *after[:1])]
        uppers = [value.upper + slope * abs(mu - knot) for knot, value in (before[-1], *after[:1])]
        lowers += [_line(pair[0], pair[1], mu).lower for pair in (before, after) if len(pair) == 2]
        uppers += [_line(before[-1], knot, mu).upper for knot in after[:1]]
        return Interval(max(lowers), min(uppers))


def _line(first: Knot, second: Knot, mu: Fraction) -> Interval:
    """The line through two values, at mu."""
    share = (mu - first[0]) / (second[0] - first[0])
    return first[1] * (1 - share) + second[1] * share
