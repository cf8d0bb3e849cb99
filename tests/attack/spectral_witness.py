"""Whether Q at a gain t shows that P(t) is stable on 1perp, and a power or Y that it is not."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from mpmath import mp

from . import oracle
from .exact import Matrix, combine, is_pd, is_psd, matmul, transpose
from .gain import Truth, positive
from .model import Design, perron_on_differences


def _step(design: Design, t: Fraction, form: Matrix) -> Matrix:
    """Pc(t)^T form Pc(t) - form."""
    p = perron_on_differences(design, t)
    return combine(Fraction(1), matmul(transpose(p), matmul(form, p)), Fraction(-1), form)


def _negated(form: Matrix) -> Matrix:
    return [[-x for x in row] for row in form]


def trace_exceeds(design: Design, t: Fraction, power: int) -> Truth:
    """abs trace(Pc(t)^power) > N - 1: exactly for small powers, by squaring with digits to spare for large ones."""
    rows = perron_on_differences(design, t)
    if power <= 32:
        product = rows
        for _ in range(power - 1):
            product = matmul(product, rows)
        return abs(sum((product[i][i] for i in range(len(rows))), Fraction(0))) > len(rows)

    def margin(dps: int) -> Any:
        with mp.workdps(2 * dps + 400):
            p, base, left = mp.eye(len(rows)), mp.matrix([[oracle.real(x) for x in row] for row in rows]), power
            while left:
                p, base, left = (p * base if left & 1 else p), base * base, left >> 1
            return abs(mp.fsum(p[i, i] for i in range(len(rows)))) - len(rows)

    return positive(design, margin)


def stays(design: Design, t: Fraction, q: Matrix) -> bool:
    """Q > 0 and Q - Pc(t)^T Q Pc(t) > 0."""
    return is_pd(q) and is_pd(_negated(_step(design, t, q)))


def leaves(design: Design, t: Fraction, witness: dict[str, Any]) -> Truth:
    """The trace of a power is too large, or Y >= 0, Y != 0 and Pc(t)^T Y Pc(t) - Y >= 0."""
    if "power" in witness:
        return trace_exceeds(design, t, witness["power"])
    form = witness["Y"]
    return any(any(row) for row in form) and is_psd(form) and is_psd(_step(design, t, form))
