"""What a matrix known up to an error promises, at the worst case, with few bits and small integers."""

import random
from fractions import Fraction
from itertools import product as pairs
from typing import Any

import mpmath
import pytest

from fomas_verify.checker import norms
from fomas_verify.checker.ball import Ball, deviation, exact_deviation, fitted, power, product, rounding
from fomas_verify.checker.norms import compare_norm, compare_norm_with, measured, norm_upper
from tests.checker.builder import PAPER_EDGES, Json, complete, design, directed_cycle
from tests.checker.test_samples import facts

Columns = list[list[int]]


def distance(ball: Ball, columns: list[list[Fraction]]) -> Fraction:
    """The squared Frobenius norm of columns - ball, in the ball's unit."""
    unit = Fraction(2) ** ball.exponent
    return sum(
        ((x / unit - y) ** 2 for a, b in zip(columns, ball.columns, strict=True) for x, y in zip(a, b, strict=True)),
        Fraction(0),
    )


def values(ball: Ball) -> list[list[Fraction]]:
    return [[entry * Fraction(2) ** ball.exponent for entry in column] for column in ball.columns]


@pytest.mark.parametrize(("columns", "rows"), [(columns, rows) for columns in range(1, 7) for rows in range(1, 7)])
def test_rounding_of_every_entry_by_less_than_one(columns: int, rows: int) -> None:
    bound = rounding([[0] * rows for _ in range(columns)])
    assert (bound - 1) ** 2 <= columns * rows < bound**2


def test_the_three_norms_of_a_small_matrix() -> None:
    """[[3, 0], [4, 12]]: the largest eigenvalue of [[25, 48], [48, 144]] is (169 + sqrt 23377)/2 = 160.9..."""
    ball = Ball([[3, 4], [0, 12]], 0, 5)
    assert ball.gram == [[25], [48, 144]]
    assert ball.square == 169
    assert ball.frobenius == 13 + 1 + 5
    assert ball.size == ball.frobenius
    assert Ball(ball.columns, 0, 5, known=17).size == 17
    assert ball.stretch == 160


@pytest.mark.parametrize("scale", [1, 10**9, 10**30])
def test_stretch_is_a_lower_bound_and_near(scale: int) -> None:
    """s [[1, 1], [0, 1]]: the largest eigenvalue of its Gram matrix is s^2 (3 + sqrt 5) / 2."""
    found = Ball([[scale, 0], [scale, scale]], 0, 0).stretch
    exact = (3 * scale**2 + sqrt_down(5 * scale**4)) // 2
    assert exact - exact // 10**12 - 1 <= found <= exact + 1


def sqrt_down(x: int) -> int:
    root = 0
    for shift in range(x.bit_length() // 2 + 1, -1, -1):
        root += (1 << shift) if (root + (1 << shift)) ** 2 <= x else 0
    return root


def test_stretch_of_nothing() -> None:
    assert Ball([[0, 0], [0, 0]], 0, 0).stretch == 0


def integers(seed: int, bits: int, size: int) -> Columns:
    """Half at random, half all ones in binary: what a shift drops is then as large as it can be."""
    choose = random.Random(seed)
    top = 2**bits - 1
    return [[choose.choice([top, -1, choose.randint(-top, top)]) for _ in range(size)] for _ in range(size)]


@pytest.mark.parametrize("seed", range(40))
@pytest.mark.parametrize("bits", [2, 5, 20])
def test_fitted_keeps_the_matrix_inside(seed: int, bits: int) -> None:
    ball = Ball(integers(seed, 12, 1 + seed % 4), seed - 9, [0, 1, 7, 5000][seed % 4])
    found = fitted(ball, bits)
    largest = max(ball.error, *(abs(entry) for column in ball.columns for entry in column)).bit_length()
    assert found.exponent == ball.exponent + largest - bits
    left = found.error - ball.error * Fraction(2) ** (ball.exponent - found.exponent)
    assert 0 <= left <= rounding(ball.columns) + 1
    assert distance(found, values(ball)) <= left**2
    assert bits < 13 or distance(found, values(ball)) == 0


@pytest.mark.parametrize("rows", range(1, 9))
@pytest.mark.parametrize("error", [0, 1, 33, 63])
def test_fitted_keeps_a_column_inside(rows: int, error: int) -> None:
    """Six bits go, all ones, from every entry and from the error."""
    ball = Ball([[4095] * rows], 0, error)
    found = fitted(ball, 6)
    left = found.error - Fraction(error, 64)
    assert left >= 0
    assert distance(found, values(ball)) <= left**2


def test_fitted_counts_the_error_among_the_integers() -> None:
    assert fitted(Ball([[1]], 0, 1 << 40), 8).error.bit_length() == 8
    assert fitted(Ball([[1]], 0, 1), 8) == Ball([[1 << 7]], -7, 1 << 7)
    assert fitted(Ball([[0b1011]], 3, 0), 4) == Ball([[0b1011]], 3, 0)


@pytest.mark.parametrize(("a", "e", "b", "f"), list(pairs((-9, 0, 4), (0, 1, 3), (-5, 0, 7), (0, 2))))
def test_products_of_the_ends_stay_inside(a: int, e: int, b: int, f: int) -> None:
    left, right = Ball([[a]], 2, e), Ball([[b]], -3, f)
    for x, y in ((left, right), (measured(left), right), (left, measured(right)), (measured(left), measured(right))):
        for bits in (None, 3, 9):
            found = product(x, y, bits)
            unit = Fraction(2) ** (found.exponent + 1)
            for p, q in pairs((a - e, a + e), (b - f, b + f)):
                assert abs(p * q / unit - found.columns[0][0]) <= found.error
    assert product(left, right, None).error <= (abs(a) + e + 1) * f + (abs(b) + 2 * f + 1) * e


def test_a_product_of_columns() -> None:
    """[[1, 2], [3, 4]] [[5, 6], [7, 8]] = [[19, 22], [43, 50]]."""
    found = product(Ball([[1, 3], [2, 4]], 1, 0), Ball([[5, 7], [6, 8]], 2, 0), None)
    assert found == Ball([[19, 43], [22, 50]], 3, 0)
    assert [power(Ball([[2]], 0, 0), n, None).columns[0][0] for n in range(1, 20)] == [2**n for n in range(1, 20)]


@pytest.mark.parametrize("bits", [3, 6, 30])
@pytest.mark.parametrize("scale", [Fraction(1), Fraction(7, 3), Fraction(1, 10**9), Fraction(10**9)])
@pytest.mark.parametrize(
    "about",
    [
        design(PAPER_EDGES, 5, gamma="3/20", h="17/20"),
        design(directed_cycle(3, "5/7"), 3, gamma="1/3", h="2"),
        design(complete(4), 4, mu="1/4"),
        design(complete(4), 4, "1/2", mu="1" + "0" * 12),
        design(directed_cycle(3), 3, mu="1/1" + "0" * 12),
    ],
)
def test_the_deviation_is_inside(bits: int, scale: Fraction, about: Json) -> None:
    ball, largest = inside(about, bits, scale)
    assert largest == 0 or 2 ** (bits - 2) <= largest <= 2 ** (bits + 1)
    assert ball.error <= rounding(ball.columns) + 1


def inside(about: Json, bits: int, scale: Fraction) -> tuple[Ball, Fraction]:
    """The ball, seen to hold the deviation at both ends of a narrow enclosure of mu, and its largest entry in units."""
    found = facts(about)
    ball, box = deviation(found, bits, scale), found.mu(400)
    for mu in (box.lower, box.upper):
        columns, q = exact_deviation(found, mu)
        exact = [[Fraction(entry, q) * scale for entry in column] for column in columns]
        assert distance(ball, exact) <= ball.error**2
    return ball, max(abs(entry) for column in exact for entry in column) / Fraction(2) ** ball.exponent


@pytest.mark.parametrize("bits", [3, 6, 30])
@pytest.mark.parametrize("agents", [2, 3, 4, 7])
@pytest.mark.parametrize("end", [mpmath.floor, mpmath.ceil])
def test_the_deviation_is_inside_where_only_the_error_of_mu_is_left(bits: int, agents: int, end: Any) -> None:
    """K_N, mu = gamma / Gamma(3/2) = 1/N to 30 digits: P - J is nearly 0."""
    with mpmath.workdps(50):
        gamma = f"{int(end(mpmath.mpf(10) ** 30 * mpmath.gamma(mpmath.mpf(3) / 2) / agents))}/{10**30}"
    inside(design(complete(agents), agents, "1/2", gamma=gamma, h="1"), bits, Fraction(5, 3))


def test_the_exact_deviation() -> None:
    """K_2 at mu = 1/3: P - J = [[1/6, -1/6], [-1/6, 1/6]]."""
    columns, q = exact_deviation(facts(design(complete(2), 2, mu="1/3")), Fraction(1, 3))
    assert [[Fraction(entry, q) for entry in column] for column in columns] == [
        [Fraction(1, 6), Fraction(-1, 6)],
        [Fraction(-1, 6), Fraction(1, 6)],
    ]


# Integers k times a matrix of norm 1, 2 or 5.
SHAPES: list[tuple[Columns, int]] = [([[1]], 1), ([[0, 1], [-1, 0]], 1), ([[1, 1], [1, 1]], 2), ([[3, 4], [-4, 3]], 5)]


@pytest.mark.parametrize(("shape", "norm"), SHAPES)
@pytest.mark.parametrize("error", [0, 1, 4])
def test_norms_are_compared_as_they_should(shape: Columns, norm: int, error: int) -> None:
    for k, lower, more in pairs(range(4), range(-6, 24), (0, 1, 3)):
        ball = Ball([[k * entry for entry in column] for column in shape], 0, error)
        least, most, upper = k * norm - error, k * norm + error, lower + more
        expected = 1 if most < lower else -1 if least > upper or upper + error < 0 else None
        assert compare_norm(ball, lower, upper, 128) == expected, (k, lower, upper)


@pytest.mark.parametrize("exponent", [-3, 0, 2])
@pytest.mark.parametrize("error", [0, 2])
def test_norms_are_compared_with_rationals(exponent: int, error: int) -> None:
    unit = Fraction(2) ** exponent
    for k, top, below in pairs((0, 1, 5, 64), range(1, 90, 4), (3, 7, 64)):
        s = Fraction(top, below)
        found = compare_norm_with(Ball([[k]], exponent, error), s, 128)
        least, most = (k - error) * unit, (k + error) * unit
        assert found != 1 or most < s
        assert found != -1 or least > s
        assert found == 1 or most > s - unit
        assert found == -1 or least < s + unit


@pytest.mark.parametrize("k", [1, 2, 3, 5, 8, 1000])
def test_an_irrational_norm_between_two_integers(k: int) -> None:
    """k [[1, 1], [0, 1]] has the norm k (1 + sqrt 5) / 2: s is less iff (2 s / k - 1)^2 < 5, where s >= k / 2."""
    ball = Ball([[k, 0], [k, k]], 0, 0)
    for part in range(-12, 13):
        s = Fraction(809 * k, 500) + Fraction(part, 8)
        assert compare_norm_with(ball, s, 256) in (None, -1 if s < 0 or (2 * s / k - 1) ** 2 < 5 else 1)
    assert compare_norm_with(ball, Fraction(162 * k, 100) + 1, 256) == 1
    assert compare_norm_with(ball, Fraction(161 * k, 100) - 1, 256) == -1


@pytest.mark.parametrize(("shape", "norm"), SHAPES)
def test_a_bound_is_above_only_if_it_is_larger(shape: Columns, norm: int) -> None:
    ball = Ball([[7 * entry for entry in column] for column in shape], 0, 0)
    assert [norms._is_above(ball, 7 * norm + k) for k in (-1, 0, 1)] == [False, False, True]


@pytest.mark.parametrize(("shape", "norm"), SHAPES)
@pytest.mark.parametrize("error", [0, 3])
@pytest.mark.parametrize("precise", [True, False])
def test_upper_bounds_of_norms(shape: Columns, norm: int, error: int, precise: bool) -> None:
    for k in (0, 1, 7, 10**6, 10**40):
        ball = Ball([[k * entry for entry in column] for column in shape], 0, error)
        above = norm_upper(ball, precise) - k * norm - error
        assert 0 <= above <= 2 + (k * norm >> (30 if precise else 12)) + (k * norm >> 50), k
