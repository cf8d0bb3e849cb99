"""Many consecutive second differences of a power, enclosed: ``f(l) = (l+1)^alpha - 2 l^alpha + (l-1)^alpha``.

Far out, f is so smooth that the polynomial of degree D through ``f(m), ..., f(m+D)`` meets every further term of a
block. With t = l - m, Newton's form and the mean value theorem for divided differences give

    f(m+t) - q(t) = C(alpha, D+3) (D+2)(D+3) xi^(alpha-D-3) t(t-1)...(t-D),  xi >= m - 1,

since the derivatives of f are those of the power, two orders higher, somewhere within 1; and ``abs C(alpha, n) <= 1``.
The values of q come from its forward differences by additions of integers alone, so nothing but the rounding of the
first D + 1 values is magnified, by at most ``sum_j C(t, j) 2^j``.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from itertools import accumulate, islice, pairwise, repeat
from math import comb

from flint import arb

from fomas_verify.enclosure.real import exact_end, to_fmpq, working_precision

BLOCK = 256
MOST = 48
"""The highest degree that pays: beyond it a power for each term is as fast."""

_SPARE = 8


@dataclass(frozen=True)
class Block:
    """``f(m), ..., f(m+255)``: each lies within ``error`` units of its integer; a unit is ``2^-shift``."""

    values: list[int]
    error: int
    shift: int

    @property
    def negative(self) -> bool:
        """Whether every one is certainly below 0."""
        return max(self.values) + self.error < 0


def block(alpha: Fraction, start: int, bits: int) -> Block | None:
    """A block of terms from ``m = start`` on, each to within about ``2^-bits``; rigorous for alpha in (0, 1).

    None where the terms are not smooth enough for so many bits, as the first ones are.
    """
    degree = _degree(start, bits)
    if degree is None:
        return None
    magnified = _magnified(degree)
    shift = bits + magnified.bit_length() + _SPARE
    with working_precision(shift + start.bit_length() + _SPARE):
        exponent, scale = to_fmpq(alpha), arb(2) ** shift
        powers = [arb(n) ** exponent for n in range(start - 1, start + degree + 2)]
        nodes = [(powers[i] - 2 * powers[i + 1] + powers[i + 2]) * scale for i in range(degree + 1)]
        error = 1 + max(-(-exact_end(x.rad()) // 1) for x in nodes)
        row = [int(exact_end(x.mid()) // 1) for x in nodes]
    values = list(islice(_continued(row), BLOCK))
    return Block(values, int(error) * magnified + (1 << shift - bits), shift)


@cache
def _magnified(degree: int) -> int:
    """How much an error of 1 in each of the first values can become within a block."""
    return sum(comb(BLOCK - 1, j) << j for j in range(degree + 1))


def _degree(start: int, bits: int) -> int | None:
    """The least degree whose remainder is below ``2^-bits`` in the whole block."""
    ratio = max(1, (start - 1).bit_length() - BLOCK.bit_length())
    for degree in range(bits // (ratio + 1), MOST + 1) if start > 2 * BLOCK else ():
        if (degree + 2) * (degree + 3) * BLOCK ** (degree + 1) << bits <= (start - 1) ** (degree + 2):
            return degree
    return None


def _continued(values: list[int]) -> Iterator[int]:
    """The polynomial through these values at 0, 1, ..., at every further integer too."""
    differences = []
    while values:
        differences.append(values[0])
        values = [b - a for a, b in pairwise(values)]
    found: Iterator[int] = repeat(differences.pop())
    for first in reversed(differences):
        found = accumulate(found, initial=first)
    return found
