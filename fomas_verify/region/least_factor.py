"""How strongly one step can contract at best: the least sigma(mu) over ``0 <= mu <= 1/D``, between two proofs.

Notation: sigma(mu) = norm of P = I - mu L on 1perp, convex in mu. A pair of vectors u, v of 1perp gives a line below
it: ``sigma(mu) >= (u.v - mu u.(L v)) / n`` with ``n = (norm(u)^2 + norm(v)^2) / 2``; so do the sums of a, b, n over
several pairs. Source: theory, section 5, "Emptiness and outer ends".
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from math import isqrt

from fomas_verify.enclosure.interval import Interval, short_dyadic
from fomas_verify.exact import matrix as exact
from fomas_verify.spectrum.contraction import directions, last
from fomas_verify.spectrum.loop import Loop, sigma_at

BITS, VECTOR_BITS = 64, (12, 16, 24, 32, 48, 64)
MOST_PAIRS = 64
"""As many as a certificate takes."""

MOST_STEPS = 60
CLOSE = Fraction(1, 1 << 64)
"""How near the two bounds of the least factor come, unless that takes more steps."""

Vector = list[Fraction]
Pair = tuple[Vector, Vector]


@dataclass(frozen=True)
class Line:
    """``sigma(x) >= height - x * fall`` for every x, by one pair of vectors; nearly an equality at ``mu``."""

    mu: Fraction
    pair: Pair
    height: Fraction
    fall: Fraction

    def at(self, x: Fraction) -> Fraction:
        """The line's value."""
        return self.height - x * self.fall


@dataclass(frozen=True)
class LeastFactor:
    """``sigma >= lower`` on all of ``[0, 1/D]``, as `pairs` show; ``sigma(mu) <= upper`` at one mu of ``(0, 1/D]``."""

    lower: Fraction
    upper: Fraction
    mu: Fraction
    lines: tuple[Line, ...]

    def pairs(self, bits: int) -> list[Pair]:
        """The vectors behind `lower`, with integers of about so many bits."""
        return _weighted(self.lines, bits)


@cache
def least_factor(loop: Loop) -> LeastFactor | None:
    """Both bounds, about 2^-64 apart; None where a single step can reach agreement (all weights equal). Rigorous.

    Presupposes Assumption 1. The next mu is, in turn, where the lines of both sides cross and where their slopes, drawn
    against mu, vanish: the first closes in on a kink of sigma, the second on a smooth minimum.
    """
    if _is_complete(loop):
        return None
    end = 1 / loop.degree_max
    left, right = line_at(loop, Fraction(0)), line_at(loop, end)
    best = right
    for step in range(MOST_STEPS):
        if right.fall >= 0 or best.at(best.mu) - _crossing_value(left, right) < CLOSE:
            break
        here = line_at(loop, _next(left, right, step))
        best = min(best, here, key=lambda line: line.at(line.mu))
        left, right = (here, right) if here.fall >= 0 else (left, here)
    lines = (right,) if right.fall >= 0 else (left, right)
    lower = lower_bound(loop, _weighted(lines, BITS))
    return LeastFactor(lower, sigma_at(loop.laplacian, best.mu, 2 * BITS).upper, best.mu, lines)


def lower_bound(loop: Loop, pairs: list[Pair], on: Interval | None = None) -> Fraction:
    """A number that sigma(mu) is not below for any mu of an interval, ``[0, 1/D]`` where none is given; exact."""
    a = sum((_dot(u, v) for u, v in pairs), Fraction(0))
    b = sum((_dot(u, exact.apply(loop.laplacian, v)) for u, v in pairs), Fraction(0))
    n = sum((exact.norm_squared(u) + exact.norm_squared(v) for u, v in pairs), Fraction(0)) / 2
    ends = (Fraction(0), 1 / loop.degree_max) if on is None else on.ends
    return min(a - mu * b for mu in ends) / n


def _is_complete(loop: Loop) -> bool:
    """Whether L is a multiple of I - J, so that P vanishes on 1perp at one mu."""
    rows = exact.to_rows(loop.laplacian)
    return len({x for i, row in enumerate(rows) for j, x in enumerate(row) if i != j}) == 1


def line_at(loop: Loop, mu: Fraction) -> Line:
    """The line through (nearly) sigma(mu) that the direction shrunk least there, and its image, give."""
    e = last(directions(loop, mu, BITS))
    le = exact.apply(loop.laplacian, e)
    image = [x - mu * y for x, y in zip(e, le, strict=True)]
    stretch = exact.norm_squared(e) / exact.norm_squared(image)
    u = _integers(image, Fraction(isqrt(int(stretch * (1 << 2 * BITS))), 1 << BITS))
    n = (exact.norm_squared(u) + exact.norm_squared(e)) / 2
    return Line(mu, (u, e), _dot(u, e) / n, _dot(u, le) / n)


def _next(left: Line, right: Line, step: int) -> Fraction:
    """A short number well between both, near the one aimed at."""
    if step % 2:
        slope = (right.mu - left.mu) / (left.fall - right.fall)
        aim = left.mu + left.fall * slope
    else:
        aim = (left.height - right.height) / (left.fall - right.fall)
    room = (right.mu - left.mu) / 8
    aim = min(max(aim, left.mu + room / 1024), right.mu - room / 1024)
    near = min(aim - left.mu, right.mu - aim) / 1024
    return short_dyadic(aim - near, aim + near)


def _crossing_value(left: Line, right: Line) -> Fraction:
    return left.at((left.height - right.height) / (left.fall - right.fall))


def _weighted(lines: tuple[Line, ...], bits: int) -> list[Pair]:
    """The pairs with integer entries, of such lengths that the slopes of their lines cancel in the sum."""
    steepest = max(abs(line.fall) for line in lines)
    weights = [Fraction(1)] if len(lines) == 1 else [abs(line.fall) / steepest for line in reversed(lines)]
    pairs = [scaled_pair(line.pair, weight, bits) for line, weight in zip(lines, weights, strict=True)]
    return [(u, v) for u, v in pairs if any(u) and any(v)]


def scaled_pair(pair: Pair, weight: Fraction, bits: int) -> Pair:
    """The pair with norms near ``sqrt(weight) 2^bits``, rounded to integers that sum to 0."""
    square = weight * (1 << 4 * bits + 2 * BITS) / exact.norm_squared(pair[1])
    factor = Fraction(isqrt(int(square)), 1 << bits + BITS)
    return _integers(pair[0], factor), _integers(pair[1], factor)


def integer_pairs(pairs: list[Pair], bits: int) -> list[Pair]:
    """The pairs, all by the same factor, rounded to integers of about so many bits that sum to 0."""
    largest = max((abs(x) for pair in pairs for vector in pair for x in vector), default=Fraction(0))
    if largest == 0:
        return []
    factor = (1 << bits) / largest
    rounded = [(_integers(u, factor), _integers(v, factor)) for u, v in pairs]
    return [(u, v) for u, v in rounded if any(u) or any(v)]


def _integers(vector: Vector, factor: Fraction) -> Vector:
    entries = [Fraction(round(x * factor)) for x in vector]
    largest = max(range(len(entries)), key=lambda i: abs(entries[i]))
    entries[largest] -= sum(entries)
    return entries


def _dot(u: Vector, v: Vector) -> Fraction:
    return sum((x * y for x, y in zip(u, v, strict=True)), Fraction(0))


def short_pairs(loop: Loop, found: LeastFactor, above: Fraction) -> list[Pair] | None:
    """The pairs with the shortest integers that still show sigma > above on ``[0, 1/D]``; None where none do."""
    for bits in VECTOR_BITS:
        pairs = found.pairs(bits)
        if pairs and lower_bound(loop, pairs) > above:
            return pairs
    return None
