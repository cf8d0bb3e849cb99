"""c_n, f(j), the resolvent, mu and the threshold: identities they satisfy, and values by mpmath at far more digits."""

from fractions import Fraction
from itertools import pairwise
from typing import Any

import mpmath
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mpmath import mp

from fomas_verify.enclosure.interval import Interval
from fomas_verify.kernel.memory import one_step_weight, resolvent, second_difference, step_response, threshold

BITS = 200
orders = st.builds(Fraction, st.integers(1, 9999), st.just(10**4))


def value(x: Any) -> Fraction:
    p, q = mpmath.libmp.to_rational(x._mpf_)
    return Fraction(int(p), int(q))


def holds(found: Interval, true: Any, digits: int = 55) -> bool:
    """The enclosure holds the value, to the digits that mpmath has, and is that fine itself."""
    x = value(true)
    slack = abs(x) / 10 ** (digits + 10)
    return found.lower - slack <= x <= found.upper + slack and found.width <= abs(x) / 10**digits


def order(alpha: Fraction) -> Any:
    return mp.mpf(alpha.numerator) / alpha.denominator


@given(orders, st.integers(1, 10**15))
def test_against_mpmath_at_200_digits(alpha: Fraction, j: int) -> None:
    with mp.workdps(200):
        a = order(alpha)
        ahead, here, behind = (mp.mpf(n) ** a for n in (j + 1, j, j - 1))
        assert holds(second_difference(alpha, j, BITS), ahead - 2 * here + behind)
        assert holds(step_response(alpha, j, BITS), ahead - here)


@pytest.mark.parametrize("j", [10**6, 10**12, 10**30])
def test_far_out_against_the_binomial_series(j: int) -> None:
    """``f(j) = 2 sum_i binomial(alpha, 2i) j^(alpha - 2i)``: no cancellation, so 90 digits are enough."""
    alpha = Fraction(9, 10)
    with mp.workdps(90):
        a = order(alpha)
        series = 2 * sum(mp.binomial(a, 2 * i) * mp.mpf(j) ** (a - 2 * i) for i in range(1, 12))
        assert holds(second_difference(alpha, j, 240), series, digits=65)


@pytest.mark.parametrize("alpha", [Fraction(9, 10), Fraction(1, 2), Fraction(1, 50), Fraction(1, 10**12)])
def test_the_sums_telescope_and_lemma_2_holds(alpha: Fraction) -> None:
    total, former = Interval.exactly(0), Interval.exactly(1)
    for j in range(1, 120):
        f = second_difference(alpha, j, BITS)
        assert f.upper < 0
        assert -f.lower < former.lower
        former = -f
        total = total + former
        assert total.overlaps(1 - step_response(alpha, j, BITS))
    assert total.width < Fraction(1, 10**45)


def test_known_values() -> None:
    """At alpha = 1/2: f(1) = sqrt 2 - 2, c_8 = 3 - sqrt 8, and c_0 = 1 exactly."""
    with mp.workdps(90):
        assert holds(second_difference(Fraction(1, 2), 1, BITS), mp.sqrt(2) - 2)
        assert holds(step_response(Fraction(1, 2), 8, BITS), 3 - mp.sqrt(8))
    assert step_response(Fraction(1, 2), 0, BITS) == Interval.exactly(1)
    assert threshold(Fraction(1, 2), BITS) == step_response(Fraction(1, 2), 1, BITS)


@pytest.mark.parametrize("alpha", [Fraction(9, 10), Fraction(1, 10), Fraction(1, 10**6), Fraction(999, 1000)])
def test_resolvent_against_its_recursion(alpha: Fraction) -> None:
    """``r_n = -sum_{l=1}^n f(l) r_{n-l}`` at 80 digits, in n^2 steps."""
    terms = 160
    with mp.workdps(80):
        a = order(alpha)
        f = [mp.mpf(0)] + [mp.mpf(n + 1) ** a - 2 * mp.mpf(n) ** a + mp.mpf(n - 1) ** a for n in range(1, terms)]
        r = [mp.mpf(1)]
        for n in range(1, terms):
            r.append(-mp.fsum(f[i] * r[n - i] for i in range(1, n + 1)))
        found = resolvent(alpha, terms, BITS)
        assert len(found) == terms
        assert found[0] == Interval.exactly(1)
        assert all(holds(x, y, digits=45) for x, y in zip(found[1:], r[1:], strict=True))


def test_resolvent_is_positive_nonincreasing_and_below_its_bound() -> None:
    """Theory, section 2: ``0 < r_n <= (n+1)^-alpha``, nonincreasing."""
    alpha, found = Fraction(3, 10), resolvent(Fraction(3, 10), 400, BITS)
    for n, (former, r) in enumerate(pairwise(found), 1):
        assert r.lower > 0
        assert r.upper <= former.upper
        with mp.workdps(60):
            assert r.lower <= value((mp.mpf(n) + 1) ** -order(alpha))


@given(orders, st.fractions(Fraction(1, 1000), 1000, max_denominator=10**4))
def test_one_step_weight(alpha: Fraction, h: Fraction) -> None:
    with mp.workdps(90):
        true = (mp.mpf(h.numerator) / h.denominator) ** order(alpha) / mp.gamma(order(alpha) + 1)
        assert holds(one_step_weight(alpha, h, BITS), true, digits=52)
