"""The memory kernel in numbers: f(j), c_j, the partial sums of abs f, and the resolvent r_j, for chosen j."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from fomas_verify.enclosure.interval import Interval
from fomas_verify.enclosure.reference import approx_memory, must_agree
from fomas_verify.kernel.memory import resolvent, second_difference, step_response

RESOLVENT_LIMIT = 20_000
"""The resolvent is computed up to this j; beyond it its cell stays empty."""


@dataclass(frozen=True)
class Row:
    """One j: f(j), c_j, ``sum_{l=1}^{j} abs f(l) = 1 - c_j``, and r_j (None beyond :data:`RESOLVENT_LIMIT`)."""

    j: int
    f: Interval
    c: Interval
    partial_sum: Interval
    r: Interval | None


def kernel_rows(alpha: Fraction, indices: Sequence[int], digits: int) -> list[Row]:
    """The rows for these j >= 1, each number enclosed to at least ``digits`` significant digits and met by mpmath's;
    rigorous.

    Raises
    ------
    DisagreementError
        mpmath's value lies outside of the enclosure.
    """
    small = [j for j in indices if j <= RESOLVENT_LIMIT]
    bits = int(digits * 3.33) + 4 * max((j.bit_length() for j in indices), default=0) + 64
    bits += 2 * max(alpha.denominator.bit_length() - alpha.numerator.bit_length(), 0)
    bits += 2 * (alpha.denominator.bit_length() - (alpha.denominator - alpha.numerator).bit_length())
    r = resolvent(alpha, max(small) + 1, bits) if small else []
    rows = []
    for j in indices:
        f, c = second_difference(alpha, j, bits), step_response(alpha, j, bits)
        for name, enclosure, approximation in zip(("f", "c"), (f, c), approx_memory(alpha, j, digits), strict=True):
            must_agree(f"{name}({j})", enclosure, approximation, digits)
        rows.append(Row(j, f, c, 1 - c, r[j] if j <= RESOLVENT_LIMIT else None))
    return rows
