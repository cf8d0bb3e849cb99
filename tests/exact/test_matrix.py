"""Exact signs of symmetric matrices, null spaces and the forms on 1perp, against sympy and numpy."""

from fractions import Fraction

import numpy as np
import pytest
import sympy
from flint import fmpz_poly
from hypothesis import assume, given
from hypothesis import strategies as st

from fomas_verify.exact import matrix as exact
from fomas_verify.exact.matrix import Inertia

entries = st.builds(Fraction, st.integers(-6, 6), st.integers(1, 4))


@st.composite
def symmetric(draw: st.DrawFn) -> list[list[Fraction]]:
    n = draw(st.integers(1, 5))
    rows = [[draw(entries) for _ in range(n)] for _ in range(n)]
    return [[rows[max(i, j)][min(i, j)] for j in range(n)] for i in range(n)]


@st.composite
def congruent(draw: st.DrawFn) -> tuple[list[list[Fraction]], tuple[int, int, int]]:
    """``S^T diag(d) S`` for an invertible S: by Sylvester's law its inertia is the number of signs in d."""
    n = draw(st.integers(1, 5))
    d = [draw(st.sampled_from([Fraction(-2, 3), Fraction(0), Fraction(0), Fraction(5, 7)])) for _ in range(n)]
    s = sympy.Matrix(n, n, lambda i, j: sympy.Rational(*draw(entries).as_integer_ratio()))
    assume(s.det() != 0)
    a = s.T * sympy.diag(*[sympy.Rational(x.numerator, x.denominator) for x in d]) * s
    rows = [[Fraction(int(a[i, j].p), int(a[i, j].q)) for j in range(n)] for i in range(n)]
    return rows, (sum(x < 0 for x in d), sum(x == 0 for x in d), sum(x > 0 for x in d))


@given(congruent())
def test_inertia_is_that_of_the_diagonal_it_is_congruent_to(case: tuple[list[list[Fraction]], tuple[int, ...]]) -> None:
    rows, signs = case
    assert exact.inertia(exact.matrix(rows)) == Inertia(*signs)


@given(symmetric())
def test_inertia_where_floating_point_is_sure(rows: list[list[Fraction]]) -> None:
    eigenvalues = np.linalg.eigvalsh(np.array(rows, dtype=float))
    assume(min(abs(eigenvalues)) > 1e-9)
    a, signs = exact.matrix(rows), (int(sum(eigenvalues < 0)), 0, int(sum(eigenvalues > 0)))
    assert exact.inertia(a) == Inertia(*signs)
    assert exact.is_positive_definite(a) == (signs[0] == 0)
    assert exact.is_positive_semidefinite(a) == (signs[0] == 0)


@pytest.mark.parametrize("n", [1, 2, 7])
def test_the_zero_matrix(n: int) -> None:
    zero = exact.matrix([[Fraction(0)] * n for _ in range(n)])
    assert exact.inertia(zero) == Inertia(0, n, 0)
    assert exact.is_positive_semidefinite(zero)
    assert not exact.is_positive_definite(zero)


def test_definite_by_less_than_any_float_sees() -> None:
    tiny = Fraction(1, 10**200)
    for shift, signs in [(tiny, Inertia(0, 0, 2)), (Fraction(0), Inertia(0, 1, 1)), (-tiny, Inertia(1, 0, 1))]:
        assert exact.inertia(exact.matrix([[1 + shift, Fraction(1)], [Fraction(1), Fraction(1)]])) == signs


@given(symmetric())
def test_null_space(rows: list[list[Fraction]]) -> None:
    a = exact.matrix(rows)
    basis = exact.kernel(a)
    assert basis.ncols() == len(rows) - sympy.Matrix(rows).rank()
    if basis.ncols():
        assert not any(x for row in (a * basis).tolist() for x in row)
        assert basis.rank() == basis.ncols()


@given(symmetric(), st.lists(st.integers(-5, 5), min_size=1, max_size=4))
def test_a_polynomial_of_a_matrix(rows: list[list[Fraction]], coefficients: list[int]) -> None:
    x = sympy.Matrix([[sympy.Rational(e.numerator, e.denominator) for e in row] for row in rows])
    value = sum((c * x**i for i, c in enumerate(coefficients)), sympy.zeros(len(rows)))
    got = exact.to_rows(exact.evaluate(fmpz_poly(coefficients), exact.matrix(rows)))
    assert got == [[Fraction(int(e.p), int(e.q)) for e in row] for row in value.tolist()]


def test_forms_on_1perp_and_on_differences() -> None:
    rows = [[Fraction(3 * i + j * j - 2) for j in range(4)] for i in range(4)]
    laplacian = [[x if i != j else x - sum(row) for j, x in enumerate(row)] for i, row in enumerate(rows)]
    v = sympy.Matrix([[1, 0, 0], [0, 1, 0], [0, 0, 1], [-1, -1, -1]])
    c = sympy.Matrix([[1, 0, 0, -1], [0, 1, 0, -1], [0, 0, 1, -1]])
    el = sympy.Matrix(laplacian)
    form = sympy.Matrix(exact.to_rows(exact.on_sum_zero(exact.matrix(laplacian))))
    action = sympy.Matrix(exact.to_rows(exact.on_differences(exact.matrix(laplacian))))
    assert form == v.T * el * v
    assert c * el == action * c


@given(symmetric(), st.integers(1, 6))
def test_leading_bits_are_as_near_as_said(rows: list[list[Fraction]], bits: int) -> None:
    whole = [[x - (sum(row) if i == j else 0) for j, x in enumerate(row)] for i, row in enumerate(rows)]
    assume(any(map(any, whole)))
    short, scale, far = exact.leading_bits(exact.matrix(whole), bits)
    kept = exact.to_rows(short)
    assert all(x.denominator == 1 for row in kept for x in row)
    assert [sum(row) for row in kept] == [0] * len(kept)
    rest = [[float(x - scale * y) for x, y in zip(*pair, strict=True)] for pair in zip(whole, kept, strict=True)]
    assert np.linalg.norm(np.array(rest), 2) <= float(scale * far) * (1 + 1e-12)


def test_the_length_of_entries_leaves_out_what_they_share() -> None:
    rows = [[Fraction(3 * 2**900, 7), Fraction(-(2**901))], [Fraction(0), Fraction(2**900)]]
    assert exact.longest_bits(exact.matrix(rows)) == 4  # 3, -14, 0 and 7 times 2^900, over 7
