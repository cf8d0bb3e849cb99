"""From the best point to a design of short decimals, rounded inward and proved to satisfy condition and limits."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction

from fomas_verify.design.fields import fits_a_design
from fomas_verify.enclosure.digits import rounded_down, rounded_up
from fomas_verify.enclosure.interval import Interval
from fomas_verify.enclosure.real import LARGEST_LOG, power_of, root_of
from fomas_verify.kernel.memory import one_step_weight
from fomas_verify.region.levels import level, settles
from fomas_verify.region.task import Objective, Task
from fomas_verify.region.tradeoff import Piece
from fomas_verify.spectrum.margins import BITS, above, below

FEWEST_DIGITS, MOST_DIGITS = 4, 24
MARGIN = 60
"""The ends of a level are passed by 2^-60 of themselves, inward, before anything is rounded."""

MOST_LOG = 700.0
"""The exponential of more is no float."""


@dataclass(frozen=True)
class Point:
    """A gamma and an h, proved to satisfy the condition and every limit; ``samples`` settle, where settling matters."""

    gamma: Fraction
    h: Fraction
    samples: int | None


def rounded(task: Task, piece: Piece) -> Point | None:
    """The point of fewest digits near the best of the piece that could be proved; None where none was. Rigorous."""
    for digits in range(FEWEST_DIGITS, MOST_DIGITS + 1):
        for gamma, h in _candidates(task, piece, digits):
            point = proved(task, gamma, h, piece.first)
            if point is not None:
                return point
    return None


def proved(task: Task, gamma: Fraction, h: Fraction, samples: int) -> Point | None:
    """The point, if it is certain that it satisfies the condition and the limits; None if not, or if a design file
    cannot hold it. Rigorous.

    ``samples``: in how many it is to settle, where settling matters; fewer where the limit of time leaves fewer.
    """
    box, strip = task.box, task.strip
    if strip is None or not (fits_a_design(gamma) and fits_a_design(h)):
        return None
    if not (box.h[0] <= h and (box.h[1] is None or h <= box.h[1])):
        return None
    if not (box.gamma_least <= gamma and (box.gamma_sure is None or gamma <= box.gamma_sure)) or gamma <= 0 or h <= 0:
        return None
    mu = one_step_weight(task.design.alpha, h, BITS) * gamma
    if not strip.inner[0] <= mu.lower <= mu.upper <= strip.inner[1]:
        return None
    if task.settle_to is None:
        return Point(gamma, h, None)
    if task.within is not None:
        samples = min(samples, int(task.within / h))
    if samples < 1 or not settles(task.loop, mu, task.settle_to, samples):
        return None
    return Point(gamma, h, samples)


def allows(task: Task, point: Point, q: Fraction) -> bool:
    """Whether it is certain that gamma and h, those that move, may be off by the factor q, either way. Rigorous.

    Without a settling limit only.
    """
    strip, box, (gamma_moves, h_moves) = task.strip, task.box, task.moves
    if strip is None or task.settle_to is not None:
        return False
    spread = (_power(q, task).upper if h_moves else 1) * (q if gamma_moves else 1)
    mu = one_step_weight(task.design.alpha, point.h, BITS) * point.gamma
    if not (strip.inner[0] * spread <= mu.lower and mu.upper * spread <= strip.inner[1]):
        return False
    ranges = ((point.gamma, box.gamma_least, box.gamma_sure, gamma_moves), (point.h, *box.h, h_moves))
    return all(not moves or (least * q <= x and (most is None or x * q <= most)) for x, least, most, moves in ranges)


def _candidates(task: Task, piece: Piece, digits: int) -> Iterator[tuple[Fraction, Fraction]]:
    """Points near the best one: the number that is best rounded inward, the other short within what is left to it."""
    m = _levels(task, piece)
    if m is None:
        return
    box = task.box
    longest = box.h[1]
    if task.within is not None:
        longest = min(task.within / piece.first, longest or task.within)
    gammas, hs = (box.gamma_least, box.gamma_sure), (box.h[0], longest)
    match task.objective:
        case Objective.SLOWEST:
            ends = [Interval.exactly(longest)] if longest is not None else []
            ends += [_root(m.upper / box.gamma_least, task)] if box.gamma_least else []
            firsts = _inward(min(x.lower for x in ends), hs, digits, up=False)
        case Objective.GENTLEST:
            ends = [Interval.exactly(box.gamma_least)]
            ends += [m.lower / _power(longest, task)] if longest is not None else []
            firsts = _inward(max(x.upper for x in ends), gammas, digits, up=True)
        case Objective.FASTEST:
            ends = [Interval.exactly(box.h[0])]
            ends += [_root(m.lower / box.gamma_sure, task)] if box.gamma_sure is not None else []
            firsts = _inward(max(x.upper for x in ends), hs, digits, up=True)
        case Objective.ROBUST:
            yield from _centre(task, piece, digits)
            return
    for first in firsts:
        if task.objective is Objective.GENTLEST:
            second = _short(_root(m.lower / first, task).upper, _root(m.upper / first, task).lower, hs)
            pair = None if second is None else (first, second)
        else:
            weight = _power(first, task)
            second = _short((m.lower / weight).upper, (m.upper / weight).lower, gammas)
            pair = None if second is None else (second, first)
        if pair is not None:
            yield pair


@dataclass(frozen=True)
class _Ends:
    """``mu Gamma(alpha + 1)`` at both ends of a piece, a little inward."""

    lower: Interval
    upper: Interval


def _levels(task: Task, piece: Piece) -> _Ends | None:
    if task.strip is None:
        return None
    low, high = task.strip.inner
    if task.settle_to is not None:
        found = level(task.loop, task.settle_to, piece.last)
        if found is None:
            return None
        low, high = max(low, above(found.lower, MARGIN)), min(high, below(found.upper, MARGIN))
    return None if low > high else _Ends(task.gamma_function * low, task.gamma_function * high)


def _power(h: Fraction, task: Task) -> Interval:
    return power_of(Interval.exactly(h), task.design.alpha, BITS)


def _root(x: Interval, task: Task) -> Interval:
    """``x^(1/alpha)``, or a number on its way there where that is beyond all that are given."""
    near = Fraction(2) ** (LARGEST_LOG if x.lower > 1 else -LARGEST_LOG)
    return root_of(x, task.design.alpha, BITS) or Interval.exactly(near)


def _inward(x: Fraction, limits: tuple[Fraction, Fraction | None], digits: int, *, up: bool) -> list[Fraction]:
    """x rounded to so many digits; the limit itself where that passes it, as no decimal may lie between both limits."""
    found = Fraction((rounded_up if up else rounded_down)(x, digits))
    if up and limits[1] is not None and found > limits[1]:
        found = limits[1]
    if not up and found < limits[0]:
        found = limits[0]
    return [found] if found > 0 else []


def _short(lower: Fraction, upper: Fraction, limits: tuple[Fraction, Fraction | None]) -> Fraction | None:
    """A decimal of few digits near the middle, in logarithms, of what both ranges leave, if they leave anything."""
    low = max(lower, limits[0])
    high = upper if limits[1] is None else min(upper, limits[1])
    if low >= high:
        return low if low == high else None
    for digits in range(1, MOST_DIGITS):
        target = _between(low, high, 2)
        near = [Fraction(rounding(target, digits)) for rounding in (rounded_down, rounded_up)]
        for first, last in ((_between(low, high, 1), _between(low, high, 3)), (low, high)):
            if found := [x for x in near if first <= x <= last]:
                return found[0]
    return _between(low, high, 2)


def _between(low: Fraction, high: Fraction, quarters: int) -> Fraction:
    """A number near the point so many quarters of the way from low to high, straight in logarithms."""
    share = high / low
    step = Fraction(math.exp(min(MOST_LOG, math.log(share.numerator) - math.log(share.denominator)) * quarters / 4))
    return min(high, low * step)


def _centre(task: Task, piece: Piece, digits: int) -> Iterator[tuple[Fraction, Fraction]]:
    """The middle of the points with the most room; h is the design's own, or near it, where nothing else says."""
    room, alpha, own = piece.room, piece.alpha, task.design.h
    both = piece.moves[0] + alpha * piece.moves[1]
    low, high = piece.low + both * room, piece.high - both * room
    ranges = zip((piece.gamma, piece.h), piece.moves, strict=True)
    (g0, g1), (y0, y1) = ((x[0] + moves * room, x[1] - moves * room) for x, moves in ranges)
    y0, y1 = max(y0, (low - g1) / alpha), min(y1, (high - g0) / alpha)
    if math.isfinite(y0) and math.isfinite(y1):
        y = (y0 + y1) / 2
    else:
        y = max(y0, min(y1, 0.0 if own is None else math.log(own.numerator) - math.log(own.denominator)))
    g = (max(g0, low - alpha * y) + min(g1, high - alpha * y)) / 2
    if max(abs(g), abs(y)) < MOST_LOG:
        limits = task.limits
        gamma, h = (Fraction(rounded_down(Fraction(math.exp(x)), digits)) for x in (g, y))
        yield (
            gamma if piece.moves[0] or limits.gamma is None else limits.gamma[0],
            h if piece.moves[1] or limits.h is None else limits.h[0],
        )
