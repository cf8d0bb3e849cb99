"""(14) sample by sample, against the closed form and a direct sum at 80 digits."""

from fractions import Fraction
from typing import Any

import mpmath
import pytest
from flint import arb, fmpq
from mpmath import mp

from fomas_verify.enclosure.horizon import _Scan, scan_horizon
from fomas_verify.enclosure.interval import Interval
from fomas_verify.enclosure.reference import DisagreementError
from fomas_verify.enclosure.second_differences import BLOCK, block
from fomas_verify.kernel.horizon import check_horizon


def direct(alpha: Fraction, beta: Fraction, last: int) -> tuple[int | None, Any, int]:
    """The first failure, and the smallest of ``1 - beta^(k+1)/c_(k+1)`` with its sample."""
    a, b = mp.mpf(alpha.numerator) / alpha.denominator, mp.mpf(beta.numerator) / beta.denominator
    total, failure, slacks = mp.mpf(0), None, []
    for k in range(last + 1):
        j = k + 1
        total += abs(mp.mpf(j + 1) ** a - 2 * mp.mpf(j) ** a + mp.mpf(j - 1) ** a)
        if b**j + total > 1 and failure is None:
            failure = k
        slacks.append(1 - b**j / (mp.mpf(j + 1) ** a - mp.mpf(j) ** a))
    least = min(slacks)
    return failure, least, slacks.index(least)


CASES = [
    ("9/10", "0.8652592538160561", 300, None),
    ("9/10", "0.867", 50, 0),
    ("9/10", "0.05", 200, None),
    ("9/10", "-0.8", 200, None),
    ("9/10", "-0.91", 20, 1),
    ("1/2", "-0.5637", 60, None),
    ("1/2", "-0.5638", 60, 1),
    ("1/50", "0.0139", 100, None),
    ("1/50", "0.014", 100, 0),
    ("1/1000000000", "0", 100, None),
    ("1/1000000000", "1e-9", 100, 0),
    ("999/1000", "-0.999", 100, None),
    ("9/10", "-5", 30, 1),
    ("9/10", "3", 30, 0),
]


@pytest.mark.parametrize(("alpha", "beta", "last", "failure"), CASES)
def test_against_the_direct_sum_and_the_closed_form(alpha: str, beta: str, last: int, failure: int | None) -> None:
    a, b = Fraction(alpha), Fraction(beta)
    seen = check_horizon(a, Interval.exactly(b), last, 50)
    with mp.workdps(80):
        c1 = mp.mpf(2) ** mp.mpf(a.numerator / mp.mpf(a.denominator)) - 1
        c2 = mp.mpf(3) ** mp.mpf(a.numerator / mp.mpf(a.denominator)) - 1 - c1
        exact = mp.mpf(b.numerator) / b.denominator
        assert failure == (0 if exact > c1 else 1 if exact < -mp.sqrt(c2) else None)
        first, least, at = direct(a, b, last)
        assert (seen.first_failure, seen.not_decided, seen.last) == (first, (), last)
        assert first == failure
        assert seen.least_slack_at == at
        p, q = mpmath.libmp.to_rational(least._mpf_)
        true = Fraction(int(p), int(q))
        slack = abs(true) / 10**60
        assert seen.least_slack.lower - slack <= true <= seen.least_slack.upper + slack
        assert seen.least_slack.width <= max(abs(true), 1) / Fraction(10**40)


@pytest.mark.parametrize(("last", "failure"), [(0, None), (1, 1), (2, 1)])
def test_a_horizon_before_the_failing_sample_does_not_see_it(last: int, failure: int | None) -> None:
    assert check_horizon(Fraction(1, 2), Interval.exactly(Fraction(-6, 10)), last, 50).first_failure == failure


def test_equality_is_neither_failure_nor_success() -> None:
    """alpha = 1/2 and beta = sqrt 2 - 1 enclosed: k = 0 is not decided, every other sample is."""
    fine = Fraction(41421356237309504880168872420969807856967187537694807317667973799, 10**65)
    beta = Interval(fine, fine + Fraction(1, 10**65))
    seen = check_horizon(Fraction(1, 2), beta, 100, 50)
    assert seen.first_failure is None
    assert seen.not_decided == (0,)
    assert seen.least_slack.contains(Fraction(0))
    assert seen.least_slack_at == 0


def test_a_wide_beta_claims_nothing() -> None:
    seen = check_horizon(Fraction(9, 10), Interval(Fraction(8, 10), Fraction(9, 10)), 3, 50)
    assert seen.first_failure is None
    assert 0 in seen.not_decided


def far(alpha: Fraction, done: int, power: str, smallest: str) -> _Scan:
    """A scan that has come so far, with ``beta = 0.99``."""
    exponent = fmpq(alpha.numerator, alpha.denominator)
    total = 1 - (arb(done + 1) ** exponent - arb(done) ** exponent)
    return _Scan(exponent, arb(fmpq(99, 100)), done, total, arb(power), smallest=arb(smallest))


def test_a_block_is_passed_over_only_where_its_ends_decide_it() -> None:
    """alpha = 1/2 at k = 20 000: the terms still to come are about 0.0035, so a power of 0.004 is not decided there,
    and with one of 0.001 the slack is above 0.7, not 0.8.
    """
    alpha, done = Fraction(1, 2), 20_000
    terms = block(alpha, done + 1, 200)
    assert terms is not None
    for power, smallest, passed in (("0.004", "-1", False), ("0.001", "0.8", False), ("0.001", "0.7", True)):
        scan = far(alpha, done, power, smallest)
        assert scan.pass_over(terms) is passed
        assert scan.done == done + BLOCK * passed


def test_a_sum_that_does_not_telescope_is_told() -> None:
    alpha, done = Fraction(1, 2), 20_000
    terms = block(alpha, done + 2, 60)
    assert terms is not None
    with pytest.raises(DisagreementError, match="the sum of 20256 terms is not 1 - c_n"):
        far(alpha, done, "0", "0").pass_over(terms)


@pytest.mark.parametrize(
    ("alpha", "beta"), [("9/10", "0.8652592538160561"), ("1/2", "-0.5638"), ("1/1000000000", "0"), ("9/10", "0.999999")]
)
def test_blocks_change_no_answer(alpha: str, beta: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """The last case fails at once and has its least slack far out."""
    a, b = Fraction(alpha), Interval.exactly(Fraction(beta))
    used = []
    monkeypatch.setattr("fomas_verify.enclosure.horizon.block", lambda *call: used.append(call) or block(*call))
    with_blocks = scan_horizon(a, b, 30_000, 50)
    monkeypatch.setattr("fomas_verify.enclosure.horizon.block", lambda *call: None)
    without = scan_horizon(a, b, 30_000, 50)
    assert used
    assert with_blocks[:2] == without[:2]
    assert with_blocks[2].overlaps(without[2])
    assert with_blocks[3] == without[3]
