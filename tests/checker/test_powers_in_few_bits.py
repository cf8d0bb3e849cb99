"""Powers of matrices in as many bits as are asked for: their error holds, and what it leaves open is left open."""

from fractions import Fraction
from itertools import product
from operator import mul

import pytest

from fomas_verify.checker.stability import Scaled, _product, power_trace_beyond

# With the claim's N - 1 = 3: one agent alone and P = 2J - I on the three others, whose trace is 3 for every even power.
TIE = [[3, 0, 0, 0], [0, -1, 2, 2], [0, 2, -1, 2], [0, 2, 2, -1]]


@pytest.mark.parametrize("errors", [(3, 5), (10, 10), (1, 40)])
def test_the_error_of_a_product_holds_at_its_corners(errors: tuple[int, int]) -> None:
    a, b = Scaled([[1, 2], [0, 1]], -3, errors[0]), Scaled([[2, 0], [1, 1]], -5, errors[1])
    found = _product(a, b, 64)
    unit = Fraction(2) ** found.exponent
    for e, f in product(product((-1, 1), repeat=2), repeat=2):
        row = [a.rows[0][j] + e[j] * a.error for j in (0, 1)]
        column = [b.rows[j][0] + f[j] * b.error for j in (0, 1)]
        exact = sum(map(mul, row, column)) * Fraction(2) ** (a.exponent + b.exponent)
        assert abs(exact - found.rows[0][0] * unit) <= found.error * unit


@pytest.mark.parametrize("power", [2, 4, 200])
def test_a_tie_of_a_short_power_is_no_more_than_it(power: int) -> None:
    assert power_trace_beyond(TIE, 3, power, 1) == -1


def test_a_tie_of_a_long_power_is_left_open() -> None:
    assert power_trace_beyond(TIE, 3, 10**6, 1) is None


def test_one_entry_beyond_every_precision_leaves_it_open() -> None:
    """2 + 3^-2600 > 2, told from 2 by no 4096 bits, beside an entry that has few."""
    f = 3**2600
    assert power_trace_beyond([[2 * f + 1, 0], [0, 0]], f, 1) is None
