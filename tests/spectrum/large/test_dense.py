"""A dense factor shows what is true, and the cheaper way is taken."""

import math
import random
from fractions import Fraction

import numpy as np
import pytest
from scipy.linalg import lapack
from scipy.sparse import csc_array

from fomas_verify.network.sparse_families import sparse_family
from fomas_verify.spectrum.large import bounds, dense
from fomas_verify.spectrum.large.bounds import large_bounds
from fomas_verify.spectrum.large.dense import DenseFactors
from fomas_verify.spectrum.large.factor import SparseFactors
from fomas_verify.spectrum.large.matrices import Near, scaled
from fomas_verify.spectrum.large.ordering import elimination_order
from fomas_verify.spectrum.large.ways import way_for
from tests.spectrum.large.exact_counts import laplacian, negative_eigenvalues, random_network, shifted
from tests.spectrum.large.test_large_bounds import MEMORY, assert_true, assert_vectors_fit, graph_of


@pytest.mark.parametrize("seed", range(60))
def test_bounds_by_a_dense_factor_are_true_and_near(seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(bounds, "way_for", lambda near, memory: (DenseFactors(), None))
    monkeypatch.setattr(dense, "_COLUMNS", (3, 4, 512)[seed % 3])
    rng = random.Random(seed)
    n, spread = rng.randint(2, 18), rng.choice([0, 0, 0, 12])
    edges = random_network(rng, n, symmetric=seed % 3 == 0, spread=spread)
    rows = laplacian(n, edges)
    mu = (Fraction(rng.randint(1, 99), 100) / max(rows[i][i] for i in range(n)),) * 2
    found = large_bounds(graph_of(n, edges), mu, memory=MEMORY)
    assert_true(found, rows, mu)
    assert_vectors_fit(found, n)
    if not spread:
        assert found.lambda2_lower is not None
        assert found.reason is None


def test_lapack_factors_few_rows_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """OpenBLAS writes beyond its memory where 16,000 rows are factored in one call on two threads."""
    seen, once = [], lapack.dpotrf
    monkeypatch.setattr(lapack, "dpotrf", lambda a, **keys: seen.append(len(a)) or once(a, **keys))
    monkeypatch.setattr(bounds, "way_for", lambda near, memory: (DenseFactors(), None))
    found = large_bounds(sparse_family("path", agents=1100), (Fraction(1, 10),) * 2, memory=MEMORY)
    assert {*seen} == {512, 76}
    assert found.lambda2_lower is not None
    assert 0 < 1 - float(found.lambda2_lower) / (2 - 2 * math.cos(math.pi / 1100)) < 1e-3


@pytest.mark.parametrize("seed", range(30))
def test_a_shift_beyond_the_eigenvalue_shows_nothing(seed: int) -> None:
    rng = random.Random(seed)
    n = rng.randint(3, 15)
    rows = laplacian(n, random_network(rng, n, symmetric=True))
    near = Near(csc_array(np.array([[float(x) for x in row] for row in rows])), 1e-13 * float(rows[0][0] + 100))
    near.matrix.sort_indices()
    values = np.linalg.eigvalsh(near.matrix.toarray())
    way = DenseFactors()
    for shift in (values[1] * (1 - 1e-9), values[1] * (1 - 1e-6)):
        found = way.second_at_least(near, shift)
        assert found is not None
        assert shift * (1 - 1e-6) < found < shift
        assert negative_eigenvalues(shifted(rows, 1, -Fraction(found))) == 1
    assert way.second_at_least(near, values[1] * (1 + 1e-9)) is None
    assert way.second_at_least(near, 1e-16) is None
    found = way.all_at_most(near, values[-1] * (1 + 1e-9))
    assert found is not None
    assert negative_eigenvalues(shifted(rows, -1, Fraction(found))) == 0
    assert way.all_at_most(near, values[-1] * (1 - 1e-9)) is None


def test_the_error_grows_with_the_trace() -> None:
    """The a-priori bound is part of what is shown."""
    near = scaled(sparse_family("complete", agents=50)).symmetric_part()
    found = DenseFactors().second_at_least(near, 0.5)
    trace = near.matrix.diagonal().sum() - 50 * 0.5
    assert found is not None
    assert 0.5 - found > 51 * 2.0**-53 * trace


@pytest.mark.parametrize("way", [DenseFactors(), None])
def test_what_the_matrix_is_off_by_is_part_of_what_is_shown(way: DenseFactors | None) -> None:
    near = scaled(sparse_family("grid", shape=(5, 7))).symmetric_part()
    factors = way or SparseFactors(elimination_order(near.matrix))
    values = np.linalg.eigvalsh(near.matrix.toarray())
    off = Near(near.matrix, values[1] / 10)
    lower, upper = factors.second_at_least(off, values[1] * 0.99), factors.all_at_most(off, values[-1] * 1.01)
    assert lower is not None
    assert upper is not None
    assert lower == pytest.approx(values[1] * 0.89, rel=1e-5)
    assert lower < values[1] * 0.89
    assert upper == pytest.approx(values[-1] * 1.01 + values[1] / 10, rel=1e-5)
    assert upper > values[-1] * 1.01 + values[1] / 10
    assert factors.second_at_least(Near(near.matrix, values[1]), values[1] * 0.99) is None


def test_a_graph_that_fills_in_takes_the_dense_way_and_one_that_does_not_the_sparse() -> None:
    torus = scaled(sparse_family("torus", shape=(40, 40))).symmetric_part()
    assert isinstance(way_for(torus, MEMORY)[0], SparseFactors)
    n, rng = 1500, random.Random(1)
    cycles = [rng.sample(range(1, n + 1), n) for _ in range(6)]
    edges = {ends: Fraction(1) for cycle in cycles for ends in zip(cycle, cycle[1:] + cycle[:1], strict=True)}
    expander = scaled(graph_of(n, edges)).symmetric_part()
    assert isinstance(way_for(expander, MEMORY)[0], DenseFactors)
    way, reason = way_for(expander, 8 * n * n - 1)
    assert way is None or isinstance(way, SparseFactors)
    way, reason = way_for(torus, 10_000)
    assert way is None
    assert reason is not None
    assert "more than the 0.0 GB allowed" in reason
