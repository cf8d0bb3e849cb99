"""The bound of the residual against exact arithmetic on the factor's own doubles."""

import random
from fractions import Fraction

import numpy as np
import pytest
from scipy.sparse import csc_array

from fomas_verify.spectrum.large import factor, residual
from fomas_verify.spectrum.large.factor import SparseFactors
from fomas_verify.spectrum.large.fronts import Fronts
from fomas_verify.spectrum.large.matrices import Near
from fomas_verify.spectrum.large.ordering import elimination_order
from fomas_verify.spectrum.large.residual import residual_norm


def ranges(edges: list[int]) -> Fronts:
    return Fronts(edges, np.repeat(np.arange(len(edges) - 1), np.diff(edges)))


def bounded(matrix: np.ndarray, lower: np.ndarray, pivots: np.ndarray, edges: list[int] | None = None) -> float:
    """The bound, with ranges of three columns where nothing else is said."""
    n = len(pivots)
    return residual_norm(csc_array(matrix), csc_array(lower), pivots, ranges(edges or [*range(0, n, 3), n]))


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
    bound = bounded(matrix, lower, pivots)
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
    bound = bounded(matrix, lower, pivots)
    truth = true_norm(exact_residual(matrix, lower, pivots))
    assert truth <= bound
    assert bound < truth * 100 + 1e-13 * np.abs(pivots).max() * np.abs(lower).max() ** 2


@pytest.mark.parametrize("seed", range(20))
def test_any_partition_into_ranges_gives_a_bound(seed: int) -> None:
    rng = random.Random(seed)
    matrix, lower, pivots = problem(seed, 30)
    edges = [0, *sorted(rng.sample(range(1, 30), rng.randint(0, 20))), 30]
    truth = true_norm(exact_residual(matrix, lower, pivots))
    assert truth <= bounded(matrix, lower, pivots, edges) <= truth * 1.01 + 1e-11


@pytest.mark.parametrize("terms", [1, 3])
def test_many_roundings_are_counted(terms: int, monkeypatch: pytest.MonkeyPatch) -> None:
    # One term at a time, in doubles whose sums are inexact: what is hidden grows, and the bound with it.
    monkeypatch.setattr(residual, "_TERMS", terms)
    for seed in range(20):
        matrix, lower, pivots = problem(seed, 25)
        truth = true_norm(exact_residual(matrix, lower, pivots))
        assert truth <= bounded(matrix, lower, pivots)


def test_what_hides_in_the_rounding_is_in_the_bound() -> None:
    """E is computed as 0, and is not 0: 1 - 3 (1/3), with 1/3 the double."""
    third = 1 / 3
    matrix = np.array([[3.0, 1.0], [1.0, 2.0]])
    lower, pivots = np.array([[1.0, 0.0], [third, 1.0]]), np.array([3.0, 2.0 - third])
    assert 3.0 * third == 1.0
    truth = true_norm(exact_residual(matrix, lower, pivots))
    assert 0 < truth <= bounded(matrix, lower, pivots) < 1e-13


@pytest.mark.parametrize("damage", ["upper", "diagonal", "nan", "infinite", "huge"])
def test_what_is_no_factor_has_no_bound(damage: str) -> None:
    matrix, lower, pivots = problem(1, 8)
    if damage == "upper":
        lower[0, 3] = 1e-300
    elif damage == "diagonal":
        lower[2, 2] = 1 + 2.0**-52
    else:
        pivots[3] = {"nan": float("nan"), "infinite": float("inf"), "huge": 1e40}[damage]
    assert bounded(matrix, lower, pivots) == float("inf")


@pytest.mark.parametrize("damage", ["entry", "pivot", "sign", "another", "nothing", "order", "twice"])
def test_a_factor_that_is_wrong_shows_nothing_false(monkeypatch: pytest.MonkeyPatch, damage: str) -> None:
    """A bound from a damaged factor is still below the truth, or there is none."""
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
    way, real = SparseFactors(elimination_order(near.matrix)), factor.eliminated
    assert way.second_at_least(near, truth * 0.9) == pytest.approx(truth * 0.9, rel=1e-9)
    assert way.second_at_least(near, truth * 1.1) is None
    seen = []

    def damaged(moved: csc_array, fronts: Fronts, most: int) -> tuple[csc_array, np.ndarray, np.ndarray]:
        if damage == "another":
            moved = csc_array(moved + np.diag(np.full(30, 10.0)))
        lower, pivots, order = real(moved, fronts, 30)
        k = {"entry": 0, "pivot": 3, "sign": int(np.argmin(pivots))}.get(damage)
        if damage == "entry":
            lower.data[-2] += 0.5
        elif damage == "order":
            order = np.roll(order, 1)
        elif damage == "twice":
            order[:] = order[0]
        elif damage == "nothing":
            lower, pivots = csc_array(np.eye(30)), np.ones(30)
        elif k is not None:
            pivots[k] = abs(pivots[k]) * (1 if damage == "sign" else 1.01)
        seen.append((pivots < 0).sum())
        return lower, pivots, order

    monkeypatch.setattr(factor, "eliminated", damaged)
    for shift in (truth * 0.9, truth * 1.1, truth * 3):
        found = way.second_at_least(near, shift)
        assert found is None or found <= truth
    assert len(seen) == 3
