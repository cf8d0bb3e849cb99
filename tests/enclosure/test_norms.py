"""Norms of ball matrices, against numpy."""

from fractions import Fraction

import numpy as np
import pytest
from flint import arb, arb_mat

from fomas_verify.enclosure.norms import ball_columns, ball_identity, centered, spectral_norm, squared_image
from fomas_verify.enclosure.real import working_precision


@pytest.mark.parametrize("n", [1, 2, 5, 20])
@pytest.mark.parametrize("squarings", [0, 4, 40])
def test_the_norm_lies_inside_and_the_width_falls(n: int, squarings: int) -> None:
    a = np.random.default_rng(n).integers(-9, 10, (n, n))
    with working_precision(200):
        norm = spectral_norm(arb_mat(n, n, [int(x) for x in a.ravel()]), squarings)
    true = Fraction(float(np.linalg.norm(a.astype(float), 2)))
    slack = true / 10**12
    assert norm.lower <= true + slack
    assert true - slack <= norm.upper
    assert norm.upper <= true * n + slack
    if squarings == 40:
        assert norm.width <= true / 10**11


def test_a_multiple_top_singular_value() -> None:
    with working_precision(200):
        norm = spectral_norm(centered(ball_identity(8) * 3), 52)
    assert norm.contains(Fraction(3))
    assert norm.width < Fraction(1, 10**14)


def test_the_zero_matrix_and_one_of_tiny_balls() -> None:
    with working_precision(100):
        assert spectral_norm(arb_mat(3, 3, [0] * 9), 4).upper == 0
        fuzzy = spectral_norm(arb_mat(3, 3, [arb(0, 1e-20)] * 9), 4)
    assert fuzzy.lower == 0
    assert Fraction(3, 10**20) <= fuzzy.upper < Fraction(1, 10**19)


def test_the_square_of_a_ball_around_zero_is_finite() -> None:
    """An image whose entries straddle 0: powers of such balls would not be finite."""
    with working_precision(100):
        square = squared_image(arb_mat(2, 2, [arb(0, 1e-20)] * 4), ball_columns([[Fraction(1), Fraction(-1)]]))
    assert square.lower <= 0 <= square.upper < Fraction(1, 10**38)
