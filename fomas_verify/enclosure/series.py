"""Power series over Arb."""

from __future__ import annotations

from collections.abc import Sequence

from flint import arb_series, ctx

from fomas_verify.enclosure.interval import Interval
from fomas_verify.enclosure.real import to_ball, to_interval, working_precision


def inverse_series(coefficients: Sequence[Interval], bits: int) -> list[Interval]:
    """The coefficients of ``1 / sum a_n z^n`` to the same length; a_0 is certainly not 0. Rigorous."""
    length = len(coefficients)
    former = ctx.cap
    try:
        ctx.cap = length
        with working_precision(bits):
            inverse = 1 / arb_series([to_ball(x) for x in coefficients], prec=length)
            return [to_interval(inverse[n]) for n in range(length)]
    finally:
        ctx.cap = former
