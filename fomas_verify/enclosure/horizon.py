"""The running sum of inequality (14) in ball arithmetic, one pass, constant memory."""

from __future__ import annotations

from fractions import Fraction

from flint import arb

from fomas_verify.enclosure.interval import Interval
from fomas_verify.enclosure.real import to_ball, to_fmpq, to_interval, working_precision

SHOWN_TIES = 16


def scan_horizon(
    alpha: Fraction, beta: Interval, last: int, digits: int
) -> tuple[int | None, tuple[int, ...], Interval, int]:
    """``beta^(k+1) + sum_{l=1}^{k+1} abs f(l)`` against 1 for k = 0 .. last.

    Returns the first certain failure, the samples not decided, the smallest relative slack and its sample. Rigorous:
    every term ``f(l) = (l+1)^alpha - 2 l^alpha + (l-1)^alpha`` is enclosed and added.
    """
    bits = int(digits * 3.33) + 3 * last.bit_length() + 32
    with working_precision(bits):
        exponent, factor, one = to_fmpq(alpha), to_ball(beta), arb(1)
        behind, here = arb(0), arb(1)
        total, power = arb(0), arb(1)
        failure: int | None = None
        open_samples: list[int] = []
        smallest, smallest_at = None, 0
        for k in range(last + 1):
            ahead = arb(k + 2) ** exponent
            step = ahead - here
            total -= step - (here - behind)
            power *= factor
            behind, here = here, ahead
            left = power + total
            if not left <= one:
                if left > one:
                    failure = k if failure is None else failure
                elif len(open_samples) < SHOWN_TIES:
                    open_samples.append(k)
            slack = 1 - power / step
            if smallest is None or slack < smallest:
                smallest, smallest_at = slack, k
        if smallest is None:
            raise ValueError("a horizon has at least the sample k = 0")
        return failure, tuple(open_samples), to_interval(smallest), smallest_at
