"""A real matrix known up to an error: integers times a power of two, and a bound of the norm of what is off.

`columns` holds one list a column. Under Assumption 1 the matrices here are polynomials in P, taken to be 0 on the
vector 1: their norm on R^N is their norm on 1perp. P is there D = P - J, J = 1 1^T / N, and D^k = P^k - J.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import ceil, isqrt
from operator import mul

from fomas_verify.checker.graph import Rows
from fomas_verify.checker.iteration import is_kept, iterated, squared
from fomas_verify.checker.loop import Loop
from fomas_verify.checker.packed import FEW, combinations

COARSE_BITS = 60
_GUESS_BITS = 56
_SQUARINGS = 4


@dataclass(frozen=True)
class Ball:
    """A real matrix M with norm of (M / 2^exponent - columns) <= error; of the Frobenius norm in a trajectory.

    `known`, where given, is an upper bound of norm M / 2^exponent.
    """

    columns: Rows
    exponent: int
    error: int
    known: int | None = None

    @cached_property
    def gram(self) -> Rows:
        """The lower triangle of X^T X, X the integers."""
        if len(self.columns) < FEW:
            return [
                [sum(map(mul, left, right)) for right in self.columns[: i + 1]] for i, left in enumerate(self.columns)
            ]
        rows = combinations(list(zip(*self.columns, strict=True)), self.columns)
        return [row[: i + 1] for i, row in enumerate(rows)]

    @cached_property
    def coarse(self) -> Ball:
        """The same matrix, its integers no longer than a first test needs."""
        return self if self.longest <= COARSE_BITS else fitted(self, COARSE_BITS)

    @cached_property
    def longest(self) -> int:
        """The bits of the largest integer, an entry or the error."""
        return max(self.error, *(max(abs(entry) for entry in column) for column in self.columns)).bit_length()

    @cached_property
    def square(self) -> int:
        """The squared Frobenius norm of the integers."""
        return sum(sum(map(mul, column, column)) for column in self.columns)

    @cached_property
    def stretch(self) -> int:
        """norm(X v)^2 / norm(v)^2, rounded down, for a v that power iteration leads to: a lower bound of norm(X)^2."""
        shift = max(max(row[-1] for row in self.gram).bit_length() - _GUESS_BITS, 0)
        full = _whole([[entry >> shift for entry in row] for row in self.gram])
        vector = [(37 * i + 11) % 101 - 50 for i in range(len(full))]
        vector = iterated(full, vector)
        if not is_kept(full, vector):
            vector = iterated(squared(full, _SQUARINGS), vector)
        image = [sum(map(mul, row, vector)) for row in _whole(self.gram)]
        size = sum(map(mul, vector, vector))
        return int(sum(map(mul, vector, image)) // size)

    @property
    def frobenius(self) -> int:
        """An upper bound of norm M / 2^exponent; of the Frobenius norm in a trajectory."""
        return isqrt(self.square) + 1 + self.error

    @property
    def size(self) -> int:
        """An upper bound of norm M / 2^exponent: of Frobenius, or the one that is known."""
        return self.frobenius if self.known is None else min(self.known, self.frobenius)


def _whole(lower: Rows) -> Rows:
    """A symmetric matrix from its lower triangle."""
    return [row + [below[i] for below in lower[i + 1 :]] for i, row in enumerate(lower)]


def fitted(ball: Ball, bits: int) -> Ball:
    """The same matrix, the largest integer (an entry or the error) of `bits` bits. Rigorous."""
    shift = ball.longest - bits
    if shift <= 0:
        columns = [[entry << -shift for entry in column] for column in ball.columns]
        return Ball(columns, ball.exponent + shift, ball.error << -shift)
    columns = [[entry >> shift for entry in column] for column in ball.columns]
    return Ball(columns, ball.exponent + shift, -(-ball.error >> shift) + rounding(columns))


def rounding(columns: Rows) -> int:
    """A bound of the Frobenius norm of errors below one unit an entry."""
    return isqrt(len(columns) * len(columns[0])) + 1


def product(a: Ball, b: Ball, bits: int | None) -> Ball:
    """a b, rounded to integers of `bits` bits where given: (A + E)(B + F) - A B = (A + E) F + E B. Rigorous."""
    columns = combinations(a.columns, b.columns)
    error = a.size * b.error + a.error * (b.size + b.error)
    result = Ball(columns, a.exponent + b.exponent, error)
    return result if bits is None else fitted(result, bits)


def power(base: Ball, n: int, bits: int | None) -> Ball:
    """base^n, n >= 1, by repeated squaring. Rigorous."""
    result = base
    for bit in bin(n)[3:]:
        result = product(result, result, bits)
        if bit == "1":
            result = product(result, base, bits)
    return result


def exact_deviation(loop: Loop, mu: Fraction) -> tuple[Rows, int]:
    """(columns X, q) with D = X / q, at a rational mu."""
    graph = loop.graph
    d, n = graph.denominator, graph.agents
    one, many = mu.denominator * d, n * mu.numerator
    columns = [[-many * entry - one for entry in column] for column in zip(*graph.laplacian, strict=True)]
    for i, column in enumerate(columns):
        column[i] += n * one
    return columns, n * one


def deviation(loop: Loop, bits: int, scale: Fraction = Fraction(1)) -> Ball:
    """`scale` > 0 times D, with integers of about `bits` bits. Rigorous."""
    graph, mu = loop.graph, loop.mu(bits + 16)
    columns, q = exact_deviation(loop, mu.middle)
    below = q * scale.denominator
    width = bits + below.bit_length() - (scale.numerator * max(max(map(abs, c)) for c in columns) or 1).bit_length()
    above = scale.numerator << max(width, 0)
    below <<= max(-width, 0)
    rounded = [[entry * above // below for entry in column] for column in columns]
    missed = mu.radius * graph.size * scale * Fraction(2) ** width
    return Ball(rounded, -width, rounding(rounded) + ceil(missed))
