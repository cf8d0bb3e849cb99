"""Rows of the kernel table: as fine as asked at every order, and stopped where mpmath says otherwise."""

from fractions import Fraction

import pytest

from fomas_verify.enclosure.reference import DisagreementError
from fomas_verify.kernel import table

ORDERS = ["9/10", "1/2", "1/1000000000", "999999999/1000000000", "1/18446744073709551615", "1e-12", "0.999999999999"]


@pytest.mark.parametrize("alpha", ORDERS)
@pytest.mark.parametrize("digits", [20, 50, 200])
def test_every_number_has_the_digits_asked(alpha: str, digits: int) -> None:
    a = Fraction(alpha)
    for row in table.kernel_rows(a, [1, 2, 7, 50, 10**12, 10**30], digits):
        assert row.f.upper < 0 < row.c.lower
        for x in (row.f, row.c, row.partial_sum, *([row.r] if row.r is not None else [])):
            assert x.width * 10**digits <= abs(x.mid)
        assert (row.r is None) == (row.j > table.RESOLVENT_LIMIT)
        assert row.partial_sum == 1 - row.c


def test_rows_come_in_the_order_asked() -> None:
    assert [row.j for row in table.kernel_rows(Fraction(1, 2), [5, 1, 3], 20)] == [5, 1, 3]
    assert table.kernel_rows(Fraction(1, 2), [], 20) == []


@pytest.mark.parametrize("position", [0, 1])
def test_a_second_opinion_that_differs_stops_the_run(monkeypatch: pytest.MonkeyPatch, position: int) -> None:
    def wrong(alpha: Fraction, j: int, digits: int) -> tuple[Fraction, ...]:
        right = list(table_reference(alpha, j, digits))
        right[position] *= 1 + Fraction(1, 10**40)
        return tuple(right)

    table_reference = table.approx_memory
    monkeypatch.setattr(table, "approx_memory", wrong)
    with pytest.raises(DisagreementError, match=rf"^{'fc'[position]}\(3\): "):
        table.kernel_rows(Fraction(9, 10), [3], 50)
