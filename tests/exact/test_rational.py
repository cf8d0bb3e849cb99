"""Numbers from text and back: exact, or refused before anything is expanded."""

import sys
from decimal import Decimal
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fomas_verify.exact.errors import FomasError
from fomas_verify.exact.rational import RationalError, excerpt, format_rational, parse_rational, shortened


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("0.9", Fraction(9, 10)),
        ("9/10", Fraction(9, 10)),
        ("18/20", Fraction(9, 10)),
        ("1e-3", Fraction(1, 1000)),
        ("1.5E+2", Fraction(150)),
        ("-2", Fraction(-2)),
        ("+1", Fraction(1)),
        ("-0.50", Fraction(-1, 2)),
        ("-0", Fraction(0)),
        ("007", Fraction(7)),
        ("-3/6", Fraction(-1, 2)),
        ("1e4000", Fraction(10**4000)),
        ("1e-0004000", Fraction(1, 10**4000)),
    ],
)
def test_read_exactly(text: str, value: Fraction) -> None:
    assert parse_rational(text, what="x") == value


NOT_NUMBERS = [
    "",
    "-",
    ".5",
    "5.",
    "1e",
    "e5",
    "1.2.3",
    "1/2/3",
    "1/-2",
    "1/+2",
    "0.5/2",
    "1/2e3",
    "--1",
    "0x10",
    "1_0",
]
NOT_NUMBERS += [" 1", "1 ", "1 /2", "1\n", "1e 3", "nan", "NaN", "inf", "-Infinity", "1j", "٣", "²", "1,5", "1e1.5"]


@pytest.mark.parametrize("text", NOT_NUMBERS)
def test_anything_else_is_refused(text: str) -> None:
    with pytest.raises(RationalError) as caught:
        parse_rational(text, what="graph.edges[3]")
    expected = "expected a decimal or a fraction such as 0.9 or 9/10"
    assert str(caught.value) == f"graph.edges[3]: {expected}, got {text!r}"


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("1e999999999", "x: expected an exponent between -4000 and 4000, got '1e999999999'"),
        ("1e-4001", "x: expected an exponent between -4000 and 4000, got '1e-4001'"),
        ("0e4001", "x: expected an exponent between -4000 and 4000, got '0e4001'"),
        ("1/0", "x: expected a denominator that is not zero, got '1/0'"),
        ("-0/000", "x: expected a denominator that is not zero, got '-0/000'"),
        ("7" * 4001, f"x: expected a number of at most 4000 characters, got '{'7' * 40}'... (4001 characters)"),
    ],
)
def test_beyond_the_limits(text: str, reason: str) -> None:
    with pytest.raises(RationalError) as caught:
        parse_rational(text, what="x")
    assert str(caught.value) == reason


def test_the_error_is_the_projects_own_and_a_value_error() -> None:
    assert issubclass(RationalError, FomasError)
    assert issubclass(RationalError, ValueError)


@given(st.fractions())
def test_written_and_read_again(x: Fraction) -> None:
    assert parse_rational(format_rational(x), what="x") == x


@given(st.decimals(allow_nan=False, allow_infinity=False))
def test_decimals_as_the_standard_library_reads_them(x: Decimal) -> None:
    assert parse_rational(str(x), what="x") == Fraction(x)


@given(st.text(st.sampled_from("0123456789+-./eE _\n"), max_size=12))
def test_what_is_read_is_what_fraction_reads(text: str) -> None:
    try:
        x = parse_rational(text, what="x")
    except RationalError:
        return
    assert Fraction(text) == x


def test_lowest_terms_and_whole_numbers() -> None:
    assert [format_rational(Fraction(*x)) for x in [(-6, 4), (6, 3), (0, 5)]] == ["-3/2", "2", "0"]


@pytest.mark.parametrize("digits", [3999, 4000, 4001, 8000, 12_345, 40_000])
def test_more_digits_than_the_interpreter_converts(digits: int) -> None:
    assert sys.get_int_max_str_digits() == 4300
    assert format_rational(Fraction(10**digits)) == "1" + "0" * digits
    assert format_rational(Fraction(1 - 10**digits)) == "-" + "9" * digits
    assert format_rational(Fraction(1, 10**digits + 7)) == "1/1" + "0" * (digits - 1) + "7"


def test_quotations_are_short_and_on_one_line() -> None:
    assert excerpt("a\nb\ud800") == r"'a\nb\ud800'"
    assert excerpt("a" * 41) == "'" + "a" * 40 + "'... (41 characters)"
    assert shortened("1" * 40) == "1" * 40
    assert shortened("1" * 41) == "1" * 40 + "... (41 characters)"
