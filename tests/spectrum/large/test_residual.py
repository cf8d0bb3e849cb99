"""The bound of the residual against exact arithmetic on the factor's own doubles."""

import random
from fractions import Fraction

import numpy as np
import pytest
from scipy.sparse import csc_array

from fomas_verify.spectrum.large import residual
from fomas_verify.spectrum.large.factor import SparseFactors
from fomas_verify.spectrum.large.fronts import Fronts, fronts
from fomas_verify.spectrum.large.matrices import Near
from fomas_verify.spectrum.large.ordering import elimination_order
from fomas_verify.spectrum.large.residual import residual_norm


def exact_residual(matrix: np.ndarray, lower: np.ndarray, pivots: np.ndarray) -> list[list[Fraction]]:
    n = len(pivots)
    a, u = ([[Fraction(x) for x in row] for row in each.tolist()] for each in (matrix, lower))
    d = [Fraction(x) for x in pivots.tolist()]
    return [[a[i][j] - sum(u[i][k] * d[k] * u[j][k] for k in range(n)) for j in range(n)] for i in range(n)]


def true_norm(rows: list[list[Fraction]]) -> float:
    """The 2-norm of a symmetric matrix of any size of entries, to about ten digits."""
    largest = max(abs(x) for row in rows for x in row) or Fraction(1)
    scaled = np.array([[float(x / largest) for x in row] for row in rows])
    return float(np.linalg.norm(scaled, 2)) * float(largest) * (1 - 1e-10)


def problem(seed: int, n: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """A sparse symmetric matrix, and a factor of it as doubles give it, in a chance order."""
    rng = np.random.default_rng(seed)
    matrix = np.zeros((n, n))
    for _ in range(2 * n):
        i, j = rng.integers(n, size=2)
        if i != j:
            matrix[i, j] = matrix[j, i] = -rng.uniform() * 10.0 ** rng.integers(-6, 1)
    np.fill_diagonal(matrix, -matrix.sum(axis=1) - rng.uniform(0, 0.3))
    work, lower, pivots = matrix.copy(), np.eye(n), np.zeros(n)
    for k in range(n):
        pivots[k] = work[k, k]
        lower[k + 1 :, k] = work[k + 1 :, k] / pivots[k]
        work[k + 1 :, k + 1 :] -= np.outer(lower[k + 1 :, k], work[k, k + 1 :])
    return matrix, lower, pivots


@pytest.mark.parametrize("seed", range(60))
def test_the_bound_holds_and_is_near(seed: int) -> None:
    n = random.Random(seed).randint(2, 40)
    matrix, lower, pivots = problem(seed, n)
    bound = residual_norm(csc_array(matrix), csc_array(lower), pivots)
    truth = true_norm(exact_residual(matrix, lower, pivots))
    product = abs(lower) @ np.diag(abs(pivots)) @ abs(lower).T
    assert truth <= bound <= truth * 1.01 + 200 * 2.0**-53 * np.linalg.norm(product, 2)


@pytest.mark.parametrize("seed", range(60))
@pytest.mark.parametrize("size", [1e-12, 1e-3, 10.0])
def test_a_factor_of_something_else_is_seen(seed: int, size: float) -> None:
    rng = np.random.default_rng(seed)
    matrix, lower, pivots = problem(seed, 12)
    if seed % 2:
        pivots[rng.integers(12)] += size
    else:
        lower[rng.integers(6, 12), rng.integers(6)] += size
    bound = residual_norm(csc_array(matrix), csc_array(lower), pivots)
    truth = true_norm(exact_residual(matrix, lower, pivots))
    assert truth <= bound
    assert bound < truth * 100 + 1e-13 * np.abs(pivots).max() * np.abs(lower).max() ** 2


@pytest.mark.parametrize("seed", range(20))
def test_any_partition_into_ranges_gives_a_bound(seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    rng = random.Random(seed)
    matrix, lower, pivots = problem(seed, 30)
    edges = [0, *sorted(rng.sample(range(1, 30), rng.randint(1, 20))), 30]
    of_column = np.repeat(np.arange(len(edges) - 1), np.diff(edges))
    monkeypatch.setattr(residual, "fronts", lambda _: Fronts(edges, of_column))
    truth = true_norm(exact_residual(matrix, lower, pivots))
    assert truth <= residual_norm(csc_array(matrix), csc_array(lower), pivots) <= truth * 1.01 + 1e-11


@pytest.mark.parametrize("terms", [1, 3])
def test_many_roundings_are_counted(terms: int, monkeypatch: pytest.MonkeyPatch) -> None:
    # One term at a time, in doubles whose sums are inexact: what is hidden grows, and the bound with it.
    monkeypatch.setattr(residual, "_TERMS", terms)
    for seed in range(20):
        matrix, lower, pivots = problem(seed, 25)
        truth = true_norm(exact_residual(matrix, lower, pivots))
        assert truth <= residual_norm(csc_array(matrix), csc_array(lower), pivots)


def test_what_hides_in_the_rounding_is_in_the_bound() -> None:
    """E is computed as 0, and is not 0: 1 - 3 (1/3), with 1/3 the double."""
    third = 1 / 3
    matrix = np.array([[3.0, 1.0], [1.0, 2.0]])
    lower, pivots = np.array([[1.0, 0.0], [third, 1.0]]), np.array([3.0, 2.0 - third])
    assert 3.0 * third == 1.0
    truth = true_norm(exact_residual(matrix, lower, pivots))
    assert 0 < truth <= residual_norm(csc_array(matrix), csc_array(lower), pivots) < 1e-13


@pytest.mark.parametrize("damage", ["upper", "diagonal", "nan", "infinite", "huge"])
def test_what_is_no_factor_has_no_bound(damage: str) -> None:
    matrix, lower, pivots = problem(1, 8)
    if damage == "upper":
        lower[0, 3] = 1e-300
    elif damage == "diagonal":
        lower[2, 2] = 1 + 2.0**-52
    else:
        pivots[3] = {"nan": float("nan"), "infinite": float("inf"), "huge": 1e40}[damage]
    assert residual_norm(csc_array(matrix), csc_array(lower), pivots) == float("inf")


def test_the_ranges_cover_every_column_once() -> None:
    for seed in range(40):
        n = random.Random(seed).randint(1, 200)
        lower = np.tril(np.random.default_rng(seed).uniform(size=(n, n)) < 3 / n, -1) + np.eye(n)
        found = fronts(csc_array(lower))
        assert found.edges[0] == 0
        assert found.edges[-1] == n
        assert all(a < b for a, b in zip(found.edges, found.edges[1:], strict=False))
        assert found.of_column.tolist() == [
            s for s, (a, b) in enumerate(zip(found.edges, found.edges[1:], strict=False)) for _ in range(a, b)
        ]


@pytest.mark.parametrize("damage", ["entry", "pivot", "order", "sign"])
def test_a_solver_that_is_wrong_shows_nothing_false(monkeypatch: pytest.MonkeyPatch, damage: str) -> None:
    """A bound from a damaged factor is still below the truth, or there is none."""
    from fomas_verify.spectrum.large import factor as module

    rng = np.random.default_rng(3)
    matrix = np.zeros((30, 30))
    for i in range(30):
        for j in (i - 1, rng.integers(30)):
            if i != j:
                matrix[i, j] = matrix[j, i] = -1.0
    np.fill_diagonal(matrix, -matrix.sum(axis=1))
    near = Near(csc_array(matrix), 0.0)
    near.matrix.sort_indices()
    truth = np.linalg.eigvalsh(matrix)[1]
    way, real = SparseFactors(elimination_order(near.matrix)), module._factor
    assert way.second_at_least(near, truth * 0.9) == pytest.approx(truth * 0.9, rel=1e-9)
    assert way.second_at_least(near, truth * 1.1) is None

    class Damaged:
        def __init__(self, whole: csc_array) -> None:
            found = real(whole)
            self.L, self.U, self.perm_r, self.perm_c = found.L, found.U.tolil(), found.perm_r, found.perm_c
            if damage == "entry":
                self.L.data[-2] += 0.5
            elif damage == "order":
                self.perm_r = self.perm_c = self.perm_c[::-1].copy()
            else:
                k = int(np.argmin(self.U.diagonal())) if damage == "sign" else 3
                self.U[k, k] = abs(self.U[k, k]) * (1 if damage == "sign" else 1.01)
            self.U = self.U.tocsc()

    monkeypatch.setattr(module, "_factor", Damaged)
    for shift in (truth * 0.9, truth * 1.1, truth * 3):
        found = way.second_at_least(near, shift)
        assert found is None or found <= truth
