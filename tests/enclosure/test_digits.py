"""Printed digits: each one is a digit of the exact number, none is invented."""

import re
from decimal import Decimal
from fractions import Fraction
from math import isqrt

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from fomas_verify.enclosure.digits import decimal, exact_decimal, rounded_down, rounded_up
from fomas_verify.enclosure.interval import Interval

scales = st.integers(-400, 400)
positive = st.fractions(0, 10**6, max_denominator=10**12).filter(bool)


def read(text: str) -> tuple[Fraction, Fraction]:
    """The numbers that a printed text stands for: from its digits to one unit of the last of them, away from 0."""
    assert re.fullmatch(r"-?\d(\d*\.\d+)?\.\.\.(e[+-]\d+)?|-?\d+\.\d+\.\.\.|-?\d+\.\.\.|-?\d\.\d+\.\.\.e[+-]\d+", text)
    plain = Decimal(text.replace("...", ""))
    unit = Fraction(Decimal((0, (1,), plain.as_tuple().exponent)))
    ends = Fraction(plain), Fraction(plain) + (-unit if text.startswith("-") else unit)
    return min(ends), max(ends)


@given(positive, scales, st.integers(1, 60), st.integers(20, 220), st.booleans())
def test_every_digit_of_an_enclosed_number_is_right(
    x: Fraction, scale: int, digits: int, bits: int, minus: bool
) -> None:
    """The number lies between the printed digits and the next; so its first digits are these."""
    number = (-x if minus else x) * Fraction(10) ** scale
    radius = abs(number) / 2**bits
    assume(radius)
    text = decimal(Interval(number - radius, number + radius / 3), digits)
    if "+-" in text:
        middle, size = map(Fraction, text.split(" +- "))
        assert abs(number - middle) <= size
        return
    low, high = read(text)
    assert low <= number - radius
    assert number + radius / 3 <= high
    assert len(re.sub(r"e.*|\D", "", text).lstrip("0")) <= digits


@given(st.integers(2, 10**9), st.integers(12, 80))
def test_truncated_digits_are_those_of_a_much_finer_number(n: int, digits: int) -> None:
    """sqrt n by integer arithmetic to 300 digits more."""
    assume(isqrt(n) ** 2 != n)
    fine = isqrt(n * 10**800)
    text = decimal(Interval(Fraction(fine, 10**400), Fraction(fine + 1, 10**400)), digits)
    shown = text.removesuffix("...").replace(".", "")
    assert len(shown) == digits
    assert str(fine).startswith(shown)


@given(positive, scales, st.booleans())
def test_without_dots_the_number_is_exact(x: Fraction, scale: int, minus: bool) -> None:
    number = (-x if minus else x) * Fraction(10) ** scale
    text = decimal(Interval.exactly(number), 40)
    if "..." in text:
        low, high = read(text)
        assert low < number < high
    else:
        assert Fraction(text) == number


@pytest.mark.parametrize(
    ("x", "text"),
    [
        ("0", "0"),
        ("2", "2"),
        ("-0.5", "-0.5"),
        ("1/3", "1/3"),
        ("-22/7", "-22/7"),
        ("1/10007", "0.00009993004896..."),
        ("100000000000000000000", "100000000000000000000"),
        ("1e21", "1e+21"),
        ("1e-7", "0.0000001"),
        ("1e-8", "1e-8"),
        ("1.25e-300", "1.25e-300"),
        ("1.25e300", "1.25e+300"),
        ("9" * 999, "9.999999999...e+998"),
        ("1234567890123/7", "1.763668414...e+11"),
    ],
)
def test_exact_numbers(x: str, text: str) -> None:
    assert decimal(Interval.exactly(Fraction(x)), 10) == text


@pytest.mark.parametrize(
    ("lower", "upper", "text"),
    [
        ("0.19999999999999999999", "0.20000000000000000001", "0.2 +- 1e-20"),
        ("-1e-30", "1e-30", "0 +- 1e-30"),
        ("0.13474", "0.13475", "0.13474 +- 0.00001"),
    ],
)
def test_where_no_digit_is_certain_there_is_a_radius(lower: str, upper: str, text: str) -> None:
    assert decimal(Interval(Fraction(lower), Fraction(upper)), 30) == text


@given(positive, scales, st.integers(1, 12), st.booleans())
def test_rounding_to_the_safe_side(x: Fraction, scale: int, digits: int, minus: bool) -> None:
    number = (-x if minus else x) * Fraction(10) ** scale
    below, above = Fraction(rounded_down(number, digits)), Fraction(rounded_up(number, digits))
    assert below <= number <= above
    assert above - below <= abs(number) * Fraction(10) ** (1 - digits)
    assert (below == above) == (exact_decimal(number, digits) is not None)


def test_zero_rounds_to_zero() -> None:
    assert (rounded_down(Fraction(0), 3), rounded_up(Fraction(0), 3), exact_decimal(Fraction(0), 3)) == ("0", "0", "0")


def test_more_digits_than_the_interpreter_writes_at_once() -> None:
    third = decimal(Interval(Fraction(1, 3) - Fraction(1, 10**5001), Fraction(1, 3)), 5000)
    assert third == f"0.{'3' * 5000}..."
    assert exact_decimal(Fraction(10**4999 + 1), 5000) == f"1.{'0' * 4998}1e+4999"
