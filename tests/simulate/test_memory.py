"""The memory in floats against mpmath's direct formulas."""

from fractions import Fraction

import numpy as np
import pytest
from mpmath import mp

from fomas_verify.simulate.memory import approx_memory_series, approx_step_response
from fomas_verify.simulate.series import approx_inverse_series

ORDERS = ["1/100", "3/10", "1/2", "9/10", "99/100"]
FAR = [*range(30), 100, 5_000, 99_999]


def order(text: str) -> tuple[float, object]:
    x = Fraction(text)
    a = float(x)
    return a, mp.mpf(a)


@pytest.mark.parametrize("text", ORDERS)
@pytest.mark.parametrize("share", [1.0, 0.5, 0.001])
def test_step_response(text: str, share: float) -> None:
    with mp.workdps(60):
        alpha, a = order(text)
        found = approx_step_response(alpha, FAR[-1] + 1, share)
        s = mp.mpf(share)
        for n in FAR:
            true = (n + s) ** a - (n - 1 + s) ** a if n else s**a
            assert abs(found[n] - true) <= 1e-14 * abs(true)


@pytest.mark.parametrize("text", ORDERS)
def test_memory_series(text: str) -> None:
    with mp.workdps(60):
        alpha, a = order(text)
        found = approx_memory_series(alpha, FAR[-1] + 1)
        assert found[0] == 1.0
        for j in FAR[1:]:
            true = mp.mpf(j + 1) ** a - 2 * mp.mpf(j) ** a + mp.mpf(j - 1) ** a
            assert abs(found[j] - true) <= 1e-14 * abs(true) + 4e-15


@pytest.mark.parametrize("count", [1, 2, 5, 9, 10, 11])
def test_short_series(count: int) -> None:
    assert np.array_equal(approx_memory_series(0.9, count), approx_memory_series(0.9, 40)[:count])
    assert len(approx_step_response(0.9, count)) == count


@pytest.mark.parametrize("count", [1, 2, 63, 64, 65, 127, 128, 129, 1000])
def test_inverse_series_times_the_series_is_one(count: int) -> None:
    """By sums of exactly rounded products; the first entries included."""
    series = approx_memory_series(0.7, count)
    inverse = approx_inverse_series(series)
    product = [float(np.dot(series[: n + 1], inverse[n::-1][: n + 1])) for n in range(count)]
    assert len(inverse) == count
    assert abs(product[0] - 1) == 0
    assert max([abs(x) for x in product[1:]], default=0.0) <= 1e-14


def test_inverse_series_decays_as_theory_says() -> None:
    """``r_n Gamma(1 - alpha) Gamma(1 + alpha) n^alpha -> 1``, and r is positive and nonincreasing."""
    r = approx_inverse_series(approx_memory_series(0.6, 50_001))
    with mp.workdps(30):
        a = mp.mpf("0.6")
        ratio = r[-1] * mp.gamma(1 - a) * mp.gamma(1 + a) * mp.mpf(50_000) ** a
    assert abs(ratio - 1) < 1e-4
    assert (r > 0).all()
    assert (np.diff(r) <= 1e-15).all()
