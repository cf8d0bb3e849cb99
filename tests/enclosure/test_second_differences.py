"""Blocks of terms against mpmath, which shares no code with them."""

from fractions import Fraction

import pytest
from mpmath import mp
from mpmath.libmp import to_rational

from fomas_verify.enclosure.second_differences import BLOCK, Block, block

ALPHAS = ["9/10", "1/2", "1/1000000000", "999999999/1000000000", "617/1000"]
STARTS = [13_000, 20_001, 65_536, 1_234_567, 9_999_744, 10**9, 10**12 + 7]


def term(alpha: Fraction, j: int) -> Fraction:
    """``f(j)`` to 160 digits."""
    with mp.workdps(160):
        a = mp.mpf(alpha.numerator) / alpha.denominator
        found = mp.mpf(j + 1) ** a - 2 * mp.mpf(j) ** a + mp.mpf(j - 1) ** a
        numerator, denominator = to_rational(found._mpf_)
        return Fraction(int(numerator), int(denominator))


@pytest.mark.parametrize("alpha", ALPHAS)
@pytest.mark.parametrize("start", STARTS)
def test_every_term_lies_in_its_enclosure(alpha: str, start: int) -> None:
    a, bits = Fraction(alpha), 230
    found = block(a, start, bits)
    assert found is not None
    assert len(found.values) == BLOCK
    assert found.negative
    assert Fraction(found.error, 1 << found.shift) <= Fraction(3, 1 << bits)
    for t in (*range(60), 100, 171, BLOCK - 2, BLOCK - 1):
        true = term(a, start + t) * (1 << found.shift)
        assert abs(found.values[t] - true) <= found.error + 1


@pytest.mark.parametrize(("start", "bits"), [(1, 64), (2, 64), (512, 64), (2_000, 230), (20_000, 3_000)])
def test_where_terms_are_not_smooth_enough_there_is_no_block(start: int, bits: int) -> None:
    assert block(Fraction(1, 2), start, bits) is None


def test_fewer_bits_begin_earlier() -> None:
    assert block(Fraction(1, 2), 2_000, 60) is not None


@pytest.mark.parametrize(
    ("values", "error", "negative"), [([-5, -3], 2, True), ([-5, -3], 3, False), ([-5, 0], 0, False)]
)
def test_whether_all_are_below_0(values: list[int], error: int, negative: bool) -> None:
    assert Block(values, error, 8).negative is negative
