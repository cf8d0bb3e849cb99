"""mu as a function of alpha, gamma and h (or mu itself) between their ends: enclosed at an alpha, and over an interval.

Source: docs/certificate-format.md, section 7. log mu = log gamma + alpha log h - log Gamma(1 + alpha) is concave in
alpha, as Gamma is log-convex; and mu increases with gamma and h.
"""

from collections import deque
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from math import ceil
from typing import cast

from fomas_verify.checker.designs import Design, Interval, UncertainDesign
from fomas_verify.checker.powers import REMEMBERED, Enclosure, gamma_one_plus, outward, outward_over, point, power

_WIDEST = Fraction(1, 16)
MAX_PARTS = 2**12
MAX_HALVINGS = 64
_CLOSE = 1 + Fraction(1, 2**120)
_BITS = 256


@dataclass(frozen=True)
class Gain:
    """The ends of gamma and h, or of mu where that is given."""

    gamma: Interval | None
    mu: Interval | None
    h: Interval | None

    def at(self, alpha: Fraction, bits: int) -> Enclosure:
        """mu at an alpha of [0, 1], for all gamma and h. Rigorous."""
        if self.gamma is None:
            return Enclosure(*cast(Interval, self.mu))
        low, high = self._ends(alpha, bits)
        return Enclosure(low.lower, high.upper)

    def over(self, first: Fraction, last: Fraction, bits: int) -> Enclosure:
        """mu at every alpha of [first, last] in [0, 1], for all gamma and h. Rigorous.

        A concave function is least at an end. With w = last - first it stays, from `first` on, below
        mu(first) max(1, mu(first)/mu(first - w)), and up to `last` below mu(last) max(1, mu(last)/mu(last + w)).
        """
        if self.gamma is None or first == last:
            return self.at(first, bits)
        width = last - first
        if first < width and last + width > 1:
            middle = (first + last) / 2
            halves = self.over(first, middle, bits), self.over(middle, last, bits)
            return Enclosure(min(half.lower for half in halves), max(half.upper for half in halves))
        ends = [self._ends(alpha, bits) for alpha in (first, last)]
        beyond = [
            high.upper * max(Fraction(1), high.upper / _short(self._ends(other, bits)[1].lower, bits))
            for (_, high), other in zip(ends, (first - width, last + width), strict=True)
            if 0 <= other <= 1
        ]
        return outward(min(low.lower for low, _ in ends), min(beyond), bits)

    def over_slab(self, first: Fraction, last: Fraction, bits: int) -> Enclosure:
        """The same, closer: in equal parts of at most 1/16."""
        count = max(ceil((last - first) / _WIDEST), 1)
        step = (last - first) / count
        parts = [self.over(first + i * step, first + (i + 1) * step, bits) for i in range(count)]
        return Enclosure(min(part.lower for part in parts), max(part.upper for part in parts))

    def least(self, first: Fraction, last: Fraction) -> Enclosure:
        """The least mu at any alpha of [first, last]. Rigorous."""
        if self.gamma is None:
            return point(cast(Interval, self.mu)[0])
        lows = [self._ends(alpha, _BITS)[0] for alpha in (first, last)]
        return Enclosure(min(low.lower for low in lows), min(low.upper for low in lows))

    def greatest(self, first: Fraction, last: Fraction) -> Enclosure:
        """The greatest mu at any alpha of [first, last], by halving the parts where it may be. Rigorous."""
        if self.gamma is None:
            return point(cast(Interval, self.mu)[1])
        lower, upper = self._ends(first, _BITS)[1].lower, Fraction(0)
        parts = deque([(first, last, 0)])
        for _ in range(MAX_PARTS):
            low, high, depth = parts.popleft()
            bound, middle = self.over(low, high, _BITS).upper, (low + high) / 2
            lower = max(lower, self._ends(middle, _BITS)[1].lower, self._ends(high, _BITS)[1].lower)
            if bound <= lower * _CLOSE or depth == MAX_HALVINGS:
                upper = max(upper, bound)
            else:
                parts += [(low, middle, depth + 1), (middle, high, depth + 1)]
            if not parts:
                break
        return Enclosure(lower, max([upper, *(self.over(low, high, _BITS).upper for low, high, _ in parts)]))

    def _ends(self, alpha: Fraction, bits: int) -> tuple[Enclosure, Enclosure]:
        """mu at the least, and at the greatest, gamma and h."""
        gamma, h = cast(Interval, self.gamma), cast(Interval, self.h)
        low = mu_at(gamma[0], h[0], alpha, bits)
        return low, low if gamma[0] == gamma[1] and h[0] == h[1] else mu_at(gamma[1], h[1], alpha, bits)


def _short(x: Fraction, bits: int) -> Fraction:
    """A lower bound of x > 0 of few bits."""
    return outward(x, x, bits).lower


@lru_cache(maxsize=REMEMBERED)
def mu_at(gamma: Fraction, h: Fraction, alpha: Fraction, bits: int) -> Enclosure:
    """gamma h^alpha / Gamma(alpha + 1), 0 <= alpha <= 1."""
    if alpha in (0, 1):
        return point(gamma * h**alpha.numerator)
    top, below = power(h, alpha, bits), gamma_one_plus(alpha, bits)
    return outward_over(gamma, top, below, bits)


def gain_of(design: Design | UncertainDesign) -> Gain:
    """That of a design, or of all members of one."""
    if isinstance(design, UncertainDesign):
        return Gain(design.interval("gamma"), design.interval("mu"), design.interval("h"))
    gamma, mu, h = (None if x is None else (x, x) for x in (design.gamma, design.mu, design.h))
    return Gain(gamma, mu, h)
