"""mpmath's second opinion: a difference beyond its last digits stops the run with status 4."""

from fractions import Fraction

import pytest

from fomas_verify.enclosure.interval import Interval
from fomas_verify.enclosure.real import power
from fomas_verify.enclosure.reference import (
    DisagreementError,
    approx_gain_and_threshold,
    approx_memory,
    must_agree,
)

THIRD = Interval(Fraction(1, 3) - Fraction(1, 10**60), Fraction(1, 3) + Fraction(1, 10**60))


def test_agreement_within_the_enclosure_or_the_last_digits() -> None:
    must_agree("x", THIRD, Fraction(1, 3), 50)
    must_agree("x", THIRD, Fraction(1, 3) + Fraction(2, 10**56), 50)


@pytest.mark.parametrize("error", [Fraction(1, 10**40), -Fraction(1, 10**50), Fraction(1, 10**54), Fraction(1)])
def test_disagreement(error: Fraction) -> None:
    with pytest.raises(DisagreementError, match=r"^x: the enclosure and mpmath disagree at 50 digits$") as caught:
        must_agree("x", THIRD, Fraction(1, 3) + error, 50)
    assert caught.value.exit_status == 4


@pytest.mark.parametrize("alpha", ["9/10", "1/100", "1/1000000", "1e-9", "1e-19", "999999999/1000000000"])
def test_both_computations_agree_at_every_order(alpha: str) -> None:
    a = Fraction(alpha)
    reference = approx_gain_and_threshold(a, Fraction(85, 100), Fraction(15, 100), 50)
    must_agree("threshold", power(Fraction(2), a, 400) - 1, reference["threshold"], 50)
    for j in (2, 1000, 10**12):
        f, c = approx_memory(a, j, 50)
        ahead, here, behind = (power(Fraction(n), a, 600) for n in (j + 1, j, j - 1))
        must_agree("f", ahead - here * 2 + behind, f, 50)
        must_agree("c", ahead - here, c, 50)
