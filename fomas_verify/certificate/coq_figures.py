"""The integers of a design's Coq file: Laplacian, bounds of lambda2 and vectors, as proofs/Design counts them.

Notation: d is the common denominator of the weights; e an integer vector that sums to 0; its ``size`` is norm(e)^2,
its ``turn`` d e.(L e) and its ``speed`` d^2 norm(L e)^2.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import lcm

from fomas_verify.certificate.coq_enclosures import Enclosures
from fomas_verify.certificate.coq_factor import Factor, Table, factor, identity, stein
from fomas_verify.enclosure.interval import round_down, round_up
from fomas_verify.enclosure.linear import approx_eigenvector
from fomas_verify.exact.matrix import identity as one_matrix
from fomas_verify.exact.matrix import kernel, scaled, to_rows
from fomas_verify.spectrum.loop import Loop


@dataclass(frozen=True)
class Direction:
    """An integer vector that sums to 0, with its size, turn and speed."""

    e: list[int]
    size: int
    turn: int
    speed: int


@dataclass(frozen=True, eq=False)
class Figures:
    """The integers that belong to a loop and the enclosures of its numbers."""

    loop: Loop
    enclosures: Enclosures

    @cached_property
    def denominator(self) -> int:
        """d."""
        return lcm(*(x.denominator for row in to_rows(self.loop.laplacian) for x in row))

    @cached_property
    def laplacian(self) -> Table:
        """``d L``."""
        return [[int(x * self.denominator) for x in row] for row in to_rows(self.loop.laplacian)]

    def perron(self, t: Fraction) -> Table:
        """``q d P`` at mu = t = p/q."""
        unit = t.denominator * self.denominator
        return [
            [(unit if i == j else 0) - t.numerator * x for j, x in enumerate(row)]
            for i, row in enumerate(self.laplacian)
        ]

    def step(self, t: Fraction) -> Table:
        """``q d Pc`` at mu = t = p/q: P on the differences from the last agent."""
        unit, last = t.denominator * self.denominator, self.laplacian[-1]
        return [
            [(unit if i == j else 0) - t.numerator * (x - y) for j, (x, y) in enumerate(zip(row, last, strict=True))][
                :-1
            ]
            for i, row in enumerate(self.laplacian[:-1])
        ]

    def direction(self, vector: Sequence[Fraction]) -> Direction:
        """The vector, which sums to 0, in integers."""
        scale = lcm(*(x.denominator for x in vector))
        e = [int(x * scale) for x in vector]
        moved = [sum(x * y for x, y in zip(row, e, strict=True)) for row in self.laplacian]
        turn = sum(x * y for x, y in zip(e, moved, strict=True))
        return Direction(e, sum(x * x for x in e), turn, sum(x * x for x in moved))

    @cached_property
    def lambda2_lower(self) -> tuple[Fraction, Factor] | None:
        """A dyadic number below lambda2, and what shows it."""
        bits = self.enclosures.bits
        bound = round_down(self.loop.lambda2(2 * bits).lower, bits) - Fraction(1, 1 << bits)
        columns = list(zip(*self.laplacian, strict=True))
        symmetric = [
            [x + y for x, y in zip(row, column, strict=True)]
            for row, column in zip(self.laplacian, columns, strict=True)
        ]
        one = identity(len(symmetric))
        found = factor(stein(symmetric, one, bound.denominator, 0, 2 * self.denominator * bound.numerator))
        return None if found is None or bound < 0 else (bound, found)

    @cached_property
    def lambda2_upper(self) -> tuple[Fraction, list[int]] | None:
        """A dyadic number that a Rayleigh quotient shows to be at least lambda2, and its vector."""
        bits = self.enclosures.bits
        approximation = approx_eigenvector(self.loop.symmetric_part, self.loop.lambda2(2 * bits).lower, bits)
        e = [Fraction(round(x * (1 << bits // 2))) for x in approximation]
        e[0] -= sum(e)
        found = self.direction(e)
        if found.size == 0:
            return None
        return round_up(Fraction(found.turn, self.denominator * found.size), bits), found.e

    @cached_property
    def lambda2_exactly(self) -> tuple[Fraction, list[int]] | None:
        """lambda2 and an eigenvector of it, where it is rational with a small denominator."""
        bounds = self.loop.lambda2(256)
        guess = bounds.lower.limit_denominator(self.denominator << 16)
        if not bounds.lower <= guess <= bounds.upper or guess == 0:
            return None
        shifted = self.loop.symmetric_part - scaled(one_matrix(len(self.laplacian)), guess)
        found = kernel(shifted)
        if found.ncols() == 0:
            return None
        return guess, self.direction([row[0] for row in to_rows(found)]).e

    def stretched(self, found: Direction, factor_squared: Fraction) -> bool:
        """Whether P stretches e by more than a factor, at every mu of the enclosure."""
        low, high, unit, d = self.enclosures.low, self.enclosures.high, self.enclosures.unit, self.denominator
        whole = found.size * d * d * unit * unit
        return factor_squared * whole < whole - 2 * high * unit * d * found.turn + low * low * found.speed

    def grown(self, found: Direction, r: Fraction) -> bool:
        """Whether ``P + r_1 I`` stretches e at all, at every mu of the enclosure and every ``r_1 >= r``."""
        low, high, unit, d = self.enclosures.low, self.enclosures.high, self.enclosures.unit, self.denominator
        if high * found.turn > unit * d * found.size:
            return False
        gain = low * low * found.speed + (2 * r + r * r) * found.size * unit * unit * d * d
        return gain > 2 * high * found.turn * d * unit * (1 + r)
