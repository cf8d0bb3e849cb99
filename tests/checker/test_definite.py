"""The sign of the least eigenvalue against sympy's exact inertia and against known spectra."""

import random
from collections.abc import Iterator
from fractions import Fraction

import pytest
import sympy

from fomas_verify.checker.definite import exact_sign, least_sign, quick_sign
from fomas_verify.checker.ruling import Undecided

Matrix = list[list[int]]


def int_sign(x: int) -> int:
    return (x > 0) - (x < 0)


def from_spectrum(values: list[int], seed: int) -> Matrix:
    """S diag(values) S^T with a unimodular S: the signs of the eigenvalues are those of the values (Sylvester)."""
    n = len(values)
    choose = random.Random(seed)
    s = [[choose.randint(-3, 3) if j < i else int(i == j) for j in range(n)] for i in range(n)]
    choose.shuffle(s)
    return [[sum(s[i][k] * values[k] * s[j][k] for k in range(n)) for j in range(i + 1)] for i in range(n)]


def spectra() -> Iterator[tuple[Matrix, int]]:
    choose = random.Random(3)
    for seed in range(600):
        n = choose.randint(1, 7)
        least = choose.choice([-1, 0, 1])
        values = [choose.randint(max(least, 0), 9) for _ in range(n)]
        values[choose.randrange(n)] = least * choose.choice([1, 5])
        yield from_spectrum(values, seed), least


def sympy_sign(rows: Matrix) -> int:
    n = len(rows)
    full = sympy.Matrix(n, n, lambda i, j: rows[max(i, j)][min(i, j)])
    x = sympy.Symbol("x")
    coefficients = sympy.Poly(full.charpoly(x).as_expr().subs(x, -x) * (-1) ** n, x).all_coeffs()
    if all(c > 0 for c in coefficients):
        return 1
    return 0 if all(c >= 0 for c in coefficients) else -1


def test_least_sign_of_given_spectra() -> None:
    for rows, sign in spectra():
        assert least_sign(rows) == sign
        assert exact_sign(rows, 1, int_sign) == sign
        assert quick_sign(rows, 256) in (None, sign)


def test_against_the_characteristic_polynomial() -> None:
    choose = random.Random(4)
    seen = set()
    for _ in range(200):
        n = choose.randint(1, 5)
        rows = [[choose.randint(-2, 2) for _ in range(i)] + [choose.randint(-1, 6)] for i in range(n)]
        sign = sympy_sign(rows)
        assert least_sign(rows) == sign, rows
        assert exact_sign(rows, 1, int_sign) == sign, rows
        seen.add(sign)
    assert seen == {-1, 0, 1}


@pytest.mark.parametrize("power", [40, 100, 200, 600, 900, 3000])
@pytest.mark.parametrize("least", [-1, 0, 1])
def test_tiny_least_eigenvalues(power: int, least: int) -> None:
    """[[a^2, a b], [a b, b^2 + least]] scaled up to 2^power has a least eigenvalue of relative size 2^-power."""
    a, b = 3**20, 2**power
    rows = [[a * a], [a * b, b * b + least]]
    assert least_sign(rows) == least


def test_quick_sign_says_nothing_of_singular_matrices() -> None:
    assert quick_sign([[1], [1, 1]], 256) is None
    assert quick_sign([[0], [0, 1]], 256) is None
    assert quick_sign([[4], [2, 1]], 1024) is None


def test_quick_sign_of_unequal_scales() -> None:
    big = 2**500
    assert quick_sign([[big], [1, 1]], 256) == 1
    assert quick_sign([[big], [2**251, 1]], 256) == -1
    assert quick_sign([[1], [big, 1]], 256) == -1
    assert quick_sign([[1], [0, -1]], 256) == -1


@pytest.mark.parametrize(
    ("rows", "sign"),
    [
        ([[0]], 0),
        ([[5]], 1),
        ([[-5]], -1),
        ([[0], [0, 0]], 0),
        ([[0], [1, 0]], -1),
        ([[0], [1, 5]], -1),
        ([[1], [0, 0], [0, 1, 0]], -1),
        ([[2], [0, 0], [0, 0, 3]], 0),
    ],
)
def test_small_matrices(rows: Matrix, sign: int) -> None:
    assert least_sign(rows) == sign
    assert exact_sign(rows, 1, int_sign) == sign


def test_hilbert_matrices_are_positive_definite_and_no_more_with_less_on_the_diagonal() -> None:
    for n in (6, 12, 20):
        common = sympy.ilcm(*range(1, 2 * n))
        rows = [[int(Fraction(int(common), i + j + 1)) for j in range(i + 1)] for i in range(n)]
        assert least_sign(rows) == 1
        rows[-1][-1] = 0
        assert least_sign(rows) == -1


def test_a_large_singular_matrix_is_beyond_the_work_allowed() -> None:
    huge = 2 ** (2**14)
    rows = [[huge] * (i + 1) for i in range(60)]
    with pytest.raises(Undecided, match="singular"):
        least_sign(rows)


def test_few_rows_of_wide_entries_are_beyond_the_work_allowed() -> None:
    """A form of rank 9 on 10 rows whose entries have 200 000 bits: its elimination would take minutes."""
    wide = 1 << 200_000
    rows = [[wide + i + j + (wide >> 1) * (i == j) for j in range(i + 1)] for i in range(9)]
    rows.append([sum(rows[max(i, j)][min(i, j)] for i in range(9)) for j in range(9)])
    rows[-1].append(sum(rows[-1]))
    with pytest.raises(Undecided, match="nearly singular"):
        least_sign(rows)
