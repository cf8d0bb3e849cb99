"""Integers to and from decimal text of any length, without touching the interpreter's limit on digits."""

from __future__ import annotations

from fractions import Fraction

CHUNK = 4000


def to_int(text: str) -> int:
    """The integer written in ASCII digits, with or without a minus sign."""
    if len(text) <= CHUNK:
        return int(text)
    if text[0] == "-":
        return -to_int(text[1:])
    low = len(text) // 2
    high: int = to_int(text[:-low]) * 10**low
    return high + to_int(text[-low:])


def to_text(n: int) -> str:
    """The decimal digits of an integer."""
    if n < 0:
        return "-" + to_text(-n)
    if n.bit_length() <= 13_000:
        return str(n)
    low = n.bit_length() * 30103 // 200_000
    high, rest = divmod(n, 10**low)
    return to_text(high) + to_text(rest).zfill(low)


def ratio(x: Fraction) -> str:
    """A rational as the certificate writes it, in lowest terms."""
    return to_text(x.numerator) + ("" if x.denominator == 1 else "/" + to_text(x.denominator))
