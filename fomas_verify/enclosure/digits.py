"""Decimal digits of an enclosed number, each of them right.

``0.1347...`` is the number truncated: every digit shown is a digit of the exact number. Without dots the number is
exact.
"""

from __future__ import annotations

from fractions import Fraction

from fomas_verify.enclosure.interval import Interval
from fomas_verify.exact.rational import format_rational

SHORT_DENOMINATOR = 10_000
FEW_DIGITS = 12


def _exponent(x: Fraction) -> int:
    """The decimal exponent e of x > 0: ``10^e <= x < 10^(e+1)``."""
    estimate = int((x.numerator.bit_length() - x.denominator.bit_length()) * 0.30103) - 1
    while x >= Fraction(10) ** (estimate + 1):
        estimate += 1
    while x < Fraction(10) ** estimate:
        estimate -= 1
    return estimate


def _truncated(x: Fraction, exponent: int, digits: int) -> int:
    """The first ``digits`` digits of x >= 0, counted from ``10^exponent``."""
    scaled = x * Fraction(10) ** (digits - 1 - exponent)
    return scaled.numerator // scaled.denominator


def _place(digits: str, exponent: int, *, exact: bool) -> str:
    """Digits with the first at ``10^exponent``, as a plain or a scientific decimal."""
    dots = "" if exact else "..."
    if -7 <= exponent < 0:
        return "0." + "0" * (-exponent - 1) + digits + dots
    if 0 <= exponent < 21:
        digits = digits.ljust(exponent + 1, "0") if exact else digits
        if len(digits) <= exponent:
            return _scientific(digits, exponent, dots)
        whole, rest = digits[: exponent + 1], digits[exponent + 1 :]
        return whole + ("." + rest if rest else "") + dots
    return _scientific(digits, exponent, dots)


def _scientific(digits: str, exponent: int, dots: str) -> str:
    rest = "." + digits[1:] if len(digits) > 1 else ""
    return f"{digits[0]}{rest}{dots}e{exponent:+d}"


def exact_decimal(x: Fraction, digits: int) -> str | None:
    """x as a decimal of at most so many digits; None where it is not one."""
    if x == 0:
        return "0"
    size = abs(x)
    exponent = _exponent(size)
    scaled = size * Fraction(10) ** (digits - 1 - exponent)
    if scaled.denominator != 1:
        return None
    text = format_rational(Fraction(scaled.numerator)).rstrip("0")
    return ("-" if x < 0 else "") + _place(text, exponent, exact=True)


def decimal(x: Interval, digits: int) -> str:
    """The number to at most ``digits`` certified significant digits, truncated; an exact short decimal without dots.

    An exact fraction of small denominator and few digits is printed as it is. Where the enclosure straddles a short
    decimal, so that no digit of the truncated number is certain, that decimal and a radius: ``0.2 +- 1e-38``.
    """
    if x.is_exact and (text := exact_decimal(x.lower, digits)) is not None:
        return text
    if x.is_exact and x.lower.denominator < SHORT_DENOMINATOR and abs(x.lower.numerator) < 10**digits:
        return f"{x.lower.numerator}/{x.lower.denominator}"
    if x.lower <= 0 <= x.upper:
        return _with_radius(x)
    sign = "-" if x.upper < 0 else ""
    low, high = sorted((abs(x.lower), abs(x.upper)))
    exponent = _exponent(low)
    for count in range(digits, 0, -1):
        first = _truncated(low, exponent, count)
        if first == _truncated(high, exponent, count):
            return (
                sign + _place(format_rational(Fraction(first)), exponent, exact=False)
                if count >= min(digits, FEW_DIGITS)
                else _with_radius(x)
            )
    return _with_radius(x)


def _with_radius(x: Interval) -> str:
    """The shortest decimal near the number, and how far from it the number may be: ``0.2 +- 1e-38``."""
    for count in range(1, 400):
        below, above = rounded_down(x.mid, count), rounded_up(x.mid, count)
        text = min(below, above, key=lambda t: abs(Fraction(t) - x.mid))
        radius = max(abs(x.upper - Fraction(text)), abs(x.lower - Fraction(text)))
        if radius <= 4 * x.width:
            return f"{text} +- {rounded_up(radius, 1)}"
    return f"[{rounded_down(x.lower, 2)}, {rounded_up(x.upper, 2)}]"


def rounded_down(x: Fraction, digits: int) -> str:
    """The largest decimal of so many significant digits that is at most x."""
    return _neighbour(x, digits, up=False)


def rounded_up(x: Fraction, digits: int) -> str:
    """The smallest decimal of so many significant digits that is at least x."""
    return _neighbour(x, digits, up=True)


def _neighbour(x: Fraction, digits: int, *, up: bool) -> str:
    if x == 0:
        return "0"
    exponent = _exponent(abs(x))
    unit = Fraction(10) ** (exponent - digits + 1)
    count = -((-x) // unit) if up else x // unit
    return exact_decimal(count * unit, digits + 1) or "0"
