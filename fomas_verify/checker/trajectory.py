"""norm(Phi_k L x_0) and norm(P^n L x_0) against norm(L x_0), for one x_0 of N rows; a norm is over all components.

Source: docs/certificate-format.md, section 4, `control-norm-bound` and `trajectory-norm-bound`.
"""

from functools import lru_cache
from math import isqrt
from operator import mul

from fomas_verify.checker.ball import Ball, fitted
from fomas_verify.checker.designs import State
from fomas_verify.checker.graph import MAX_MATRIX_BITS, Graph, Rows, common_denominator
from fomas_verify.checker.loop import Loop
from fomas_verify.checker.ruling import Undecided
from fomas_verify.checker.samples import GUARD, Samples


def error_columns(graph: Graph, x0: State) -> tuple[Rows, int]:
    """(E, q) with L x_0 = E / q, one list a component of x_0."""
    entries = [entry for row in x0 for entry in row]
    q = common_denominator(entries, len(x0))
    if (q.bit_length() + max(abs(x.numerator) for x in entries).bit_length()) * len(entries) > MAX_MATRIX_BITS:
        raise Undecided("an initial state with so large a common denominator is beyond the work allowed")
    states = [[int(entry * q) for entry in column] for column in zip(*x0, strict=True)]
    return [[sum(map(mul, row, state)) for row in graph.laplacian] for state in states], q * graph.denominator


class Trajectory:
    """The samples from one x_0 with L x_0 != 0, at one precision."""

    def __init__(self, loop: Loop, x0: State, bits: int) -> None:
        columns, _ = error_columns(loop.graph, x0)
        start = fitted(Ball(columns, 0, 0), bits + GUARD)
        self.samples = Samples(loop, bits, start)
        square = sum(sum(map(mul, column, column)) for column in columns)
        shift = -2 * start.exponent
        self.size = isqrt(square << shift if shift >= 0 else square >> -shift)

    def sample_sign(self, k: int) -> int | None:
        """1 if norm(Phi_k e) < norm(e), -1 if it is larger, e = L x_0; None if neither is seen."""
        return _compare(self.samples.sample(k), self.size, self.size + 1)

    def power_sign(self, n: int) -> int | None:
        """The same of norm(P^n e) and c_n norm(e)."""
        lower, upper = self.samples.kernel.step_response(n)
        scale = self.samples.scale
        bounds = (self.size * max(lower, 0) >> scale, ((self.size + 1) * upper >> scale) + 1)
        return _compare(self.samples.power(n), *bounds)


def _compare(ball: Ball, lower: int, upper: int) -> int | None:
    """The sign of s - the Frobenius norm of the matrix, for s between the bounds."""
    if ball.frobenius < lower:
        return 1
    return -1 if isqrt(ball.square) - ball.error > upper else None


@lru_cache(maxsize=4)
def trajectory(loop: Loop, x0: State, bits: int) -> Trajectory:
    """The samples from x_0 at a precision, one for all who ask."""
    return Trajectory(loop, x0, bits)
