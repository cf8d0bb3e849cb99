"""Powers of P and the matrices Phi_k, with their norms, from their definitions at the working precision.

`P^k S` and `Phi_k S = sum_j r_{k-j} P^j S` for a block S of columns: the unit matrix on an orthonormal basis of 1perp
(spectral norm), or e = L x_0 (Euclidean norm over all entries). The resolvent r comes from its recursion. A float of
the exact block says which norms are near a bound; those are computed in full. Source: docs/certificate-format.md.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from functools import lru_cache
from math import ceil, log2
from operator import mul
from typing import Any

import numpy as np
from mpmath import mp

from . import oracle
from .model import Design, laplacian, x0_columns

Block = list[list[Any]]
Truth = bool | None
NEAR = 1e-11
GUARD = 30
SPARE = 64  # bits for what the roundings of a few thousand terms add up to


class Kernel:
    """c_n = (n+1)^alpha - n^alpha and the resolvent r_n, extended as asked for."""

    def __init__(self, alpha: Fraction, dps: int) -> None:
        self.alpha, self.dps = alpha, dps
        self._c: list[Any] = [mp.mpf(1)]
        self._bits = ceil((dps + GUARD) * log2(10)) + SPARE
        self._falls: list[int] = []
        self._r: list[int] = [1 << self._bits]

    def c(self, n: int) -> Any:
        """The step response of the memory."""
        with mp.workdps(self.dps + GUARD):
            alpha = oracle.real(self.alpha)
            while len(self._c) <= n:
                k = len(self._c)
                self._c.append(mp.mpf(k + 1) ** alpha - mp.mpf(k) ** alpha)
                self._falls.append(int(mp.nint(mp.ldexp(self._c[k - 1] - self._c[k], self._bits))))
        return self._c[n]

    def r(self, n: int) -> Any:
        """r_n = -sum_{j=1}^{n} f(j) r_{n-j}, with f(j) = c_j - c_{j-1}, by integers: all lie in [0, 1]."""
        self.c(n)
        while len(self._r) <= n:
            self._r.append(sum(map(mul, self._falls, reversed(self._r))) >> self._bits)
        with mp.workdps(self.dps + GUARD):
            return mp.ldexp(self._r[n], -self._bits)


@lru_cache(maxsize=256)
def kernel(alpha: Fraction, dps: int) -> Kernel:
    """The kernel of an alpha, shared."""
    return Kernel(alpha, dps)


def multiply(p: Block, columns: Block) -> Block:
    """p, given by rows, times a block given by columns; by columns."""
    return [[mp.fdot(row, column) for row in p] for column in columns]


def approx_norm(columns: Block, spectral: bool) -> Any:
    """The norm of a block, right to about 14 digits whatever its size."""
    size = max(abs(x) for column in columns for x in column)
    if not size:
        return mp.mpf(0)
    exponent = mp.frexp(size)[1]
    floats = np.array([[float(mp.ldexp(x, -exponent)) for x in column] for column in columns])
    return mp.ldexp(float(np.linalg.norm(floats, 2) if spectral else np.linalg.norm(floats)), exponent)


def exact_norm(columns: Block, spectral: bool) -> Any:
    """The norm of a block at the working precision."""
    if spectral and len(columns) > 1:
        return oracle.largest_singular_value(mp.matrix(columns))
    return mp.sqrt(mp.fsum(x * x for column in columns for x in column))


class Response:
    """The blocks P^k S and Phi_k S for k = 0, 1, ..., and their norms."""

    def __init__(self, p: Block, start: Block, alpha: Fraction, dps: int, spectral: bool) -> None:
        self.p, self.start, self.dps, self.spectral = p, start, dps, spectral
        self.kernel = kernel(alpha, dps)
        self._powers, self._controls = [start], [start]
        one = exact_norm(start, spectral)
        self._power_norms, self._control_norms = [one], [one]
        self.limit = min(2048, max(64, 700_000 // (len(p) ** 2 * len(start))))

    def _afford(self, k: int) -> None:
        if k > self.limit:
            raise ArithmeticError(f"{k} samples are beyond the oracle's limit")

    def power_norm(self, k: int) -> Any:
        """norm(P^k S), to about 14 digits.

        Raises
        ------
        ArithmeticError
            Where k samples are more than this oracle affords, as in `control_norm`.
        """
        self._afford(k)
        while len(self._powers) <= k:
            with mp.workdps(self.dps + GUARD):
                self._powers.append(multiply(self.p, self._powers[-1]))
                self._power_norms.append(approx_norm(self._powers[-1], self.spectral))
        return self._power_norms[k]

    def control_norm(self, k: int) -> Any:
        """norm(Phi_k S), to about 14 digits."""
        self._afford(k)
        while len(self._controls) <= k:
            r = self.kernel.r(len(self._controls))
            with mp.workdps(self.dps + GUARD):
                moved = multiply(self.p, self._controls[-1])
                kept = [
                    [x + r * s for x, s in zip(column, first, strict=True)]
                    for column, first in zip(moved, self.start, strict=True)
                ]
                self._controls.append(kept)
                self._control_norms.append(approx_norm(kept, self.spectral))
        return self._control_norms[k]

    def control_matrix(self, k: int) -> Any:
        """Phi_k S, as a matrix."""
        self.control_norm(k)
        return mp.matrix(self._controls[k]).T

    def exact_control_norm(self, k: int) -> Any:
        """norm(Phi_k S) at full precision."""
        self.control_norm(k)
        with mp.workdps(self.dps + 10):
            return exact_norm(self._controls[k], self.spectral)

    def _at_most(self, near: Any, block: Block, bound: Any) -> Truth:
        with mp.workdps(self.dps + 10):
            if abs(near - bound) > NEAR * abs(bound):
                return bool(near < bound)
            margin = bound - exact_norm(block, self.spectral)
            return None if abs(margin) <= abs(bound) * mp.mpf(10) ** (-2 * self.dps // 3) else bool(margin > 0)

    def power_at_most(self, k: int, bound: Any) -> Truth:
        """norm(P^k S) <= bound; None where the digits do not separate them."""
        near = self.power_norm(k)
        return self._at_most(near, self._powers[k], bound)

    def control_at_most(self, k: int, bound: Any) -> Truth:
        """norm(Phi_k S) <= bound; None where the digits do not separate them."""
        near = self.control_norm(k)
        return self._at_most(near, self._controls[k], bound)


def digits(design: Design) -> int:
    """The working precision for a design: 60 digits after the point."""
    return 60 + oracle.scale(design)


@lru_cache(maxsize=16)
def on_1perp(design: Design) -> Response:
    """P^k and Phi_k on 1perp, in Helmert's basis."""
    dps = digits(design)
    with mp.workdps(dps + GUARD):
        n = design.agents
        v = oracle._orthonormal_basis(n)
        lap = mp.matrix([[oracle.real(x) for x in row] for row in laplacian(design)])
        p = mp.eye(n - 1) - oracle.mu(design, dps + GUARD) * (v.T * lap * v)
        rows = [[p[i, j] for j in range(n - 1)] for i in range(n - 1)]
        unit = [[mp.mpf(i == j) for j in range(n - 1)] for i in range(n - 1)]
    return Response(rows, unit, design.alpha, dps, spectral=True)


@lru_cache(maxsize=16)
def along(design: Design, columns: tuple[tuple[Fraction, ...], ...]) -> Response:
    """P^k e and Phi_k e for e = L x_0, x_0 given by columns, divided by norm(e), which is not 0."""
    dps = digits(design)
    with mp.workdps(dps + GUARD):
        gain = oracle.mu(design, dps + GUARD)
        p = [[(i == j) - gain * oracle.real(x) for j, x in enumerate(row)] for i, row in enumerate(laplacian(design))]
        errors = [[oracle.real(x) for x in column] for column in error_columns(design, columns)]
        size = mp.sqrt(mp.fsum(x * x for column in errors for x in column))
        start = [[x / size for x in column] for column in errors]
    return Response(p, start, design.alpha, dps, spectral=False)


def error_columns(design: Design, columns: Sequence[Sequence[Fraction]]) -> list[list[Fraction]]:
    """L x_0, exactly, column by column."""
    lap = laplacian(design)
    return [[sum((a * x for a, x in zip(row, column, strict=True)), Fraction(0)) for row in lap] for column in columns]


def trajectory(design: Design) -> Response | None:
    """The response to the design's own x_0; None where L x_0 = 0."""
    columns = x0_columns(design)
    return along(design, columns) if any(any(column) for column in error_columns(design, columns)) else None


def all_true(answers: Sequence[Callable[[], Truth]]) -> Truth:
    """Three-valued and, one answer after the other until one is false."""
    unknown = False
    for answer in answers:
        truth = answer()
        if truth is False:
            return False
        unknown = unknown or truth is None
    return None if unknown else True
