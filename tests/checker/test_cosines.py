"""Cosines at few bits, where a unit in the last place cannot hide behind the guard: every end is on its own side."""

from fractions import Fraction

import mpmath
import pytest

from fomas_verify.checker import cosines
from fomas_verify.checker.cosines import _atan_of_inverse, _pi, _series, versine

TWO = mpmath.mpf(2)


@pytest.fixture(autouse=True)
def many_digits():
    with mpmath.workdps(60):
        yield


def real(x: Fraction) -> mpmath.mpf:
    return mpmath.mpf(x.numerator) / x.denominator


def test_an_arc_tangent_lies_between_its_bounds() -> None:
    for n in range(2, 240, 3):
        exact = mpmath.atan(mpmath.mpf(1) / n)
        for w in range(40):
            low, high = _atan_of_inverse(n, w)
            assert low <= exact * TWO**w <= high, (n, w)
            assert high - low <= w + 4


def test_pi_lies_between_its_bounds() -> None:
    for w in range(150):
        low, high = _pi(w)
        assert low <= mpmath.pi * TWO**w <= high, w
        assert high - low <= 20 * w + 60


def test_pi_takes_each_bound_from_its_own_side(monkeypatch: pytest.MonkeyPatch) -> None:
    """However wide the arc tangents are, their widths add up."""
    for five, other in ((1, 1000), (1000, 1)):

        def bounds(n: int, w: int, wide: dict[int, int] = {5: five, 239: other}) -> tuple[int, int]:  # noqa: B006
            near = int(mpmath.floor(mpmath.atan(mpmath.mpf(1) / n) * TWO**w))
            return near - wide[n], near + 1 + wide[n]

        monkeypatch.setattr(cosines, "_atan_of_inverse", bounds)
        low, high = _pi.__wrapped__(40)
        assert low <= mpmath.pi * TWO**40 - 4 * 990
        assert high >= mpmath.pi * TWO**40 + 4 * 990


def test_a_series_is_bounded_from_both_sides() -> None:
    for w in range(9):
        for square in range(0, 12 << w, max(1, (12 << w) // 300)):
            exact = (1 - mpmath.cos(mpmath.sqrt(mpmath.mpf(square) / 2**w))) * TWO**w
            low, high = _series(square, w, False), _series(square, w, True)
            assert low <= exact <= high, (square, w)
            assert high - low <= 12


def test_the_argument_is_rounded_outward(monkeypatch: pytest.MonkeyPatch) -> None:
    """Neither guard bits nor the width of pi take up what the argument loses."""

    def tight(w: int) -> tuple[int, int]:
        below = int(mpmath.floor(mpmath.pi * TWO**w))
        return below, below + 1

    monkeypatch.setattr(cosines, "_GUARD", 0)
    monkeypatch.setattr(cosines, "_pi", tight)
    for q in range(4, 100):
        for p in range(1, q):
            exact = 1 - mpmath.cos(mpmath.pi * p / q)
            for bits in (-4, -2, 1):
                found = versine.__wrapped__(Fraction(p, q), bits)
                assert real(found.lower) - TWO**-190 <= exact <= real(found.upper) + TWO**-190, (p, q, bits)


def test_rational_values_are_exact() -> None:
    known = {"1": 2, "2/3": "3/2", "1/2": 1, "1/3": "1/2"}
    for x, value in known.items():
        found = versine(Fraction(x), 64)
        assert found.lower == found.upper == Fraction(value)
    for x in ("1/4", "1/5", "2/5", "1/6", "5/6", "3/4"):
        assert versine(Fraction(x), 64).lower < versine(Fraction(x), 64).upper


def test_the_width_is_relative() -> None:
    """However small the number: that many of its leading bits are known."""
    for q in (7, 316, 10**6, 10**12, 2**60 + 1, 2**100 + 1):
        for bits in (1, 64, 200):
            found = versine(Fraction(1, q), bits)
            assert 0 < found.upper - found.lower < found.lower / 2**bits
