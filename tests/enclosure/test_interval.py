"""Interval arithmetic contains every value it stands for, and refuses what has none."""

from fractions import Fraction

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from fomas_verify.enclosure.interval import Interval, round_down, round_up, short_dyadic

numbers = st.fractions(max_denominator=10**6)
parts = st.fractions(0, 1, max_denominator=64)


@st.composite
def enclosed(draw: st.DrawFn) -> tuple[Interval, Fraction]:
    """An interval, exact ones among them, and a number inside of it."""
    a, b = sorted((draw(numbers), draw(numbers)))
    if draw(st.booleans()):
        b = a
    return Interval(a, b), a + (b - a) * draw(parts)


@given(enclosed(), enclosed())
def test_containment(first: tuple[Interval, Fraction], second: tuple[Interval, Fraction]) -> None:
    (x, p), (y, q) = first, second
    assert (x + y).contains(p + q)
    assert (x - y).contains(p - q)
    assert (x * y).contains(p * q)
    assert (-x).contains(-p)
    assert (x + q).contains(p + q)
    assert (q - x).contains(q - p)
    assert (x * q).contains(p * q)
    if not y.contains(Fraction(0)):
        assert (x / y).contains(p / q)


@given(enclosed(), enclosed())
def test_the_ends_are_attained(first: tuple[Interval, Fraction], second: tuple[Interval, Fraction]) -> None:
    x, y = first[0], second[0]
    corners = [a * b for a in (x.lower, x.upper) for b in (y.lower, y.upper)]
    assert x * y == Interval(min(corners), max(corners))
    assert x + y == Interval(x.lower + y.lower, x.upper + y.upper)


@given(enclosed(), enclosed())
def test_comparison_is_certain_or_silent(first: tuple[Interval, Fraction], second: tuple[Interval, Fraction]) -> None:
    (x, p), (y, q) = first, second
    verdict = x.compare(y)
    if verdict is not None:
        assert verdict == (p > q) - (p < q)
    assert (verdict in (-1, 1)) == (not x.overlaps(y))
    assert x.overlaps(y) == y.overlaps(x)


@given(enclosed(), st.integers(1, 80))
def test_rounding_is_outward_and_fine(case: tuple[Interval, Fraction], bits: int) -> None:
    x, p = case
    rounded = x.rounded(bits)
    assert rounded.contains(p)
    assert rounded.lower <= x.lower
    assert x.upper <= rounded.upper
    if x.is_exact:
        assert rounded == x
    else:
        assert rounded.width <= x.width + 2 * Fraction(1, 2**bits)
        assert all(end.denominator & (end.denominator - 1) == 0 for end in (rounded.lower, rounded.upper))


@given(numbers, st.integers(0, 90))
def test_one_ended_rounding(x: Fraction, shift: int) -> None:
    unit = Fraction(1, 2**shift)
    assert round_down(x, shift) <= x < round_down(x, shift) + unit
    assert round_up(x, shift) - unit < x <= round_up(x, shift)


@given(numbers, numbers)
def test_the_shortest_dyadic(a: Fraction, b: Fraction) -> None:
    lower, upper = sorted((a, b))
    assume(lower < upper)
    x = short_dyadic(lower, upper)
    assert lower <= x <= upper
    shift = x.denominator.bit_length() - 1
    assert x.denominator == 1 << shift
    if shift:
        assert round_up(lower, shift - 1) > upper


@pytest.mark.parametrize(("lower", "upper"), [(1, 0), (Fraction(1, 3), Fraction(33, 100)), (0, -1)])
def test_ends_in_the_wrong_order_are_refused(lower: Fraction, upper: Fraction) -> None:
    with pytest.raises(ArithmeticError):
        Interval(Fraction(lower), Fraction(upper))


@pytest.mark.parametrize("zero", [(0, 0), (-1, 1), (0, 1), (-1, 0)])
def test_division_by_what_may_be_0_is_refused(zero: tuple[int, int]) -> None:
    with pytest.raises(ZeroDivisionError):
        Interval.exactly(1) / Interval(Fraction(zero[0]), Fraction(zero[1]))


def test_division_by_the_number_0_is_refused() -> None:
    with pytest.raises(ZeroDivisionError):
        Interval.exactly(1) / 0
