"""How far alpha may move before a claim's truth changes, gamma and h, or mu, as they are.

A stretch of alpha is cut in two until each part is decided by ranges over it, so that a reader of the ends can see it
again by halving, and with room. Source: theory, section 8; docs/certificate-format.md, section 3, "margins".
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from fomas_verify.enclosure.interval import Interval, short_dyadic
from fomas_verify.spectrum.slabs import Truth

FINE, FINEST, BEYOND = 26, 60, (1, 2, 4, 8, 16, 32, 64)
"""The ends of what is known are about 2^-26 of alpha apart, or 2^-60; where a slab does not tell, up to 65
times that."""

ALPHA_BELOW = 1 << 64
"""Bound on numerator and denominator of an order in a certificate (format, section 2)."""

MOST_STEPS, MOST_PARTS = 1 << 10, 3 << 9
"""Bounds on the parts tried on the way out, and on those of each side halved again: a reader may use 2^12."""


@dataclass(frozen=True)
class AlphaMargin:
    """The truth is that of the design for every alpha in ``inner``, and the other at the ends of ``outer`` that are
    given.
    """

    inner: tuple[Fraction, Fraction]
    outer: tuple[Fraction | None, Fraction | None]


def alpha_margin(truth: Truth, alpha: Fraction) -> AlphaMargin | None:
    """The stretch around alpha; None where the truth at alpha itself is not seen. Rigorous."""
    here = truth(Interval.exactly(alpha))
    if here is None:
        return None
    ends = [_reach(truth, alpha, end, here) for end in (Fraction(0), Fraction(1))]
    inner = [_seen_by_halving(truth, alpha, end, here) for end, _ in ends]
    beyond = [end if end is not None and may_be_written(end) else None for _, end in ends]
    known = [end if may_be_written(end) else alpha for end in inner]
    return AlphaMargin((known[0], known[1]), (beyond[0], beyond[1]))


def may_be_written(alpha: Fraction) -> bool:
    """Whether a certificate may hold this order: one at the edge of what is allowed has neighbours that it may not."""
    return max(alpha.numerator, alpha.denominator) < ALPHA_BELOW


def _reach(truth: Truth, start: Fraction, end: Fraction, here: bool) -> tuple[Fraction, Fraction | None]:
    """From start towards end: as far as the truth is seen not to change, and a point where it has (None: none seen)."""
    at, targets, steps = start, [end], 0
    while targets and steps < MOST_STEPS:
        target, steps = targets[-1], steps + 1
        if truth(_slab(at, target)) is here:
            at = targets.pop()
        elif abs(target - at) <= max(at / (1 << FINE), Fraction(1, 1 << FINEST)):
            return at, _changed(truth, at, target, here)
        else:
            targets.append(_between(at, target))
    return at, None


def _changed(truth: Truth, at: Fraction, target: Fraction, here: bool) -> Fraction | None:
    """The nearest of a few points at or beyond the target where the truth is the other."""
    points = (target, *(_between(at + (target - at) * times, target + (target - at) * times) for times in BEYOND))
    return next((x for x in points if 0 < x < 1 and truth(Interval.exactly(x)) is (not here)), None)


def _seen_by_halving(truth: Truth, start: Fraction, end: Fraction, here: bool) -> Fraction:
    """The end, or one nearer to start, up to which halving sees the truth in few parts."""
    for _ in range(FINEST):
        parts, left = [_slab(start, end)], MOST_PARTS
        while parts and left:
            part, left = parts.pop(), left - 1
            if truth(part) is not here:
                parts += [Interval(part.lower, part.mid), Interval(part.mid, part.upper)]
        if not parts:
            return end
        end = _between(start, end)
    return start


def _between(a: Fraction, b: Fraction) -> Fraction:
    """A short number near the middle."""
    low, step = min(a, b), abs(b - a) / 8
    return short_dyadic(low + 3 * step, low + 5 * step)


def _slab(a: Fraction, b: Fraction) -> Interval:
    return Interval(min(a, b), max(a, b))
