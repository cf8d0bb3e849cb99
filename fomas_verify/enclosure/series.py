"""Power series over Arb."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from flint import arb, arb_series, ctx

from fomas_verify.enclosure.interval import Interval
from fomas_verify.enclosure.real import Ball, to_fmpq, to_interval, working_precision


def second_differences(exponent: Fraction, count: int, bits: int) -> list[Ball]:
    """``(n+1)^s - 2 n^s + (n-1)^s`` for n = 1..count, s the exponent > 0, at a working precision of so many bits.
    Rigorous.
    """
    with working_precision(bits):
        s = to_fmpq(exponent)
        powers = [arb(0), *(arb(n) ** s for n in range(1, count + 2))]
        return [powers[n + 1] - 2 * powers[n] + powers[n - 1] for n in range(1, count + 1)]


def inverse_series(coefficients: Sequence[Ball], bits: int) -> list[Interval]:
    """The coefficients of ``1 / sum a_n z^n`` to the same length; a_0 is certainly not 0. Rigorous."""
    length = len(coefficients)
    former = ctx.cap
    try:
        ctx.cap = length
        with working_precision(bits):
            inverse = 1 / arb_series(list(coefficients), prec=length)
            return [to_interval(inverse[n]) for n in range(length)]
    finally:
        ctx.cap = former
