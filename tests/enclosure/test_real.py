"""Powers, roots, Gamma, logarithms: each enclosure holds the true value, by mpmath at far more digits and by MPFR."""

import random
from fractions import Fraction
from typing import Any

import gmpy2
import mpmath
import pytest
from flint import arb, ctx
from mpmath import mp

from fomas_verify.enclosure import real
from fomas_verify.enclosure.interval import Interval

BITS = 160
POINTS = 2000


def near(x: Any) -> Interval:
    """What mpmath computed at 130 digits, give or take 1e-120 of it."""
    p, q = mpmath.libmp.to_rational(x._mpf_)
    value = Fraction(int(p), int(q))
    return Interval(value - abs(value) / 10**120, value + abs(value) / 10**120)


def mpf(x: Fraction) -> Any:
    return mp.mpf(x.numerator) / x.denominator


def is_right(found: Interval, true: Interval, lost: int = 12) -> bool:
    """It holds the value and is not much wider than its precision."""
    return found.lower <= true.lower and true.upper <= found.upper and found.width * 2 ** (BITS - lost) <= true.upper


def fraction(seed: random.Random, low: int, high: int) -> Fraction:
    return Fraction(seed.randint(low * 10**6 + 1, high * 10**6), 10**6) * Fraction(10) ** seed.randint(-9, 9)


def test_powers_at_thousands_of_points() -> None:
    seed = random.Random(1)
    with mp.workdps(130):
        for _ in range(POINTS):
            base, exponent = fraction(seed, 0, 9), Fraction(seed.randint(1, 10**6 - 1), 10**6)
            assert is_right(real.power(base, exponent, BITS), near(mpf(base) ** mpf(exponent)))


def test_gamma_at_thousands_of_points() -> None:
    seed = random.Random(2)
    with mp.workdps(130):
        for _ in range(POINTS):
            x = Fraction(seed.randint(1, 3 * 10**6), 10**6)
            assert is_right(real.gamma_function(x, BITS), near(mp.gamma(mpf(x))))


def test_square_roots_and_logarithms() -> None:
    seed = random.Random(3)
    with mp.workdps(130):
        for _ in range(POINTS):
            x = fraction(seed, 0, 9)
            root, log = real.square_root(Interval.exactly(x), BITS), real.log2(Interval.exactly(x), BITS)
            assert near(mp.sqrt(mpf(x))).overlaps(root)
            assert root.lower**2 <= x <= root.upper**2
            true = near(mp.log(mpf(x), 2))
            assert log.lower <= true.upper
            assert true.lower <= log.upper
            assert log.width < Fraction(1, 2**140)


def test_powers_and_gamma_between_mpfrs_directed_roundings() -> None:
    """Binary fractions, which MPFR holds exactly; its two roundings are 400 bits wide."""
    seed = random.Random(4)
    for _ in range(POINTS):
        base, exponent = Fraction(seed.randint(1, 2**40), 2**20), Fraction(seed.randint(1, 2**20 - 1), 2**20)
        for found, function in [
            (real.power(base, exponent, BITS), lambda b, e: b**e),
            (real.gamma_function(exponent + 1, BITS), lambda b, e: gmpy2.gamma(e + 1)),
        ]:
            ends = []
            for rounding in (gmpy2.RoundDown, gmpy2.RoundUp):
                with gmpy2.context(precision=400, round=rounding):
                    arguments = [gmpy2.mpfr(gmpy2.mpq(x.numerator, x.denominator)) for x in (base, exponent)]
                    ends.append(Fraction(*map(int, function(*arguments).as_integer_ratio())))
            assert found.lower <= min(ends)
            assert max(ends) <= found.upper


@pytest.mark.parametrize("base", ["1e-1200", "1e1200"])
def test_powers_of_extreme_numbers(base: str) -> None:
    with mp.workdps(130):
        x, a = Fraction(base), Fraction(9, 10)
        assert is_right(real.power(x, a, BITS), near(mp.mpf(base) ** mpf(a)), lost=24)


def test_a_wide_base_gives_every_power_of_it() -> None:
    base = Interval(Fraction(1, 3), Fraction(2, 3))
    found = real.power_of(base, Fraction(9, 10), BITS)
    for x in (base.lower, base.mid, base.upper):
        inner = real.power(x, Fraction(9, 10), 300)
        assert found.lower <= inner.lower
        assert inner.upper <= found.upper


def test_square_roots_of_squares_are_exact_and_of_negative_roundings_start_at_0() -> None:
    assert real.square_root(Interval.exactly(Fraction(49, 100)), 64) == Interval.exactly(Fraction(7, 10))
    assert real.square_root(Interval.exactly(0), 64) == Interval.exactly(0)
    found = real.square_root(Interval(Fraction(-1, 10**9), Fraction(1, 100)), 64)
    assert found.lower <= 0
    assert found.upper >= Fraction(1, 10)


def test_what_is_not_finite_is_refused() -> None:
    with pytest.raises(ArithmeticError):
        real.to_interval(arb(1) / arb(0))
    with pytest.raises(ArithmeticError):
        real.log2(Interval(Fraction(-1), Fraction(1)), 64)


def test_the_working_precision_is_restored_also_after_an_error() -> None:
    before = ctx.prec
    real.power(Fraction(2), Fraction(1, 3), 999)
    assert ctx.prec == before
    with pytest.raises(ArithmeticError), real.working_precision(777):
        raise ArithmeticError
    assert ctx.prec == before
