"""A factor in ranges of columns is that of the matrix, whatever the signs of its pivots."""

import numpy as np
import pytest
from scipy.sparse import csc_array, random_array

from fomas_verify.spectrum.large.elimination import eliminated
from fomas_verify.spectrum.large.fronts import Fronts
from fomas_verify.spectrum.large.ordering import elimination_order


@pytest.mark.parametrize("seed", range(60))
def test_the_product_is_the_matrix_and_the_signs_are_its_inertia(seed: int) -> None:
    rng = np.random.default_rng(seed)
    n = int(rng.integers(1, 150))
    upper = random_array((n, n), density=min(1.0, 4 / n), rng=rng, data_sampler=rng.standard_normal)
    whole = (upper + upper.T).toarray()
    np.fill_diagonal(whole, rng.standard_normal(n) * 3)
    order = elimination_order(csc_array(whole + 100 * np.eye(n)))
    moved = whole[np.ix_(order.rows, order.rows)]
    matrix = csc_array(moved)
    matrix.sort_indices()
    negative = int((np.linalg.eigvalsh(moved) < 0).sum())
    found = eliminated(matrix, order.fronts, negative)
    assert found is not None
    lower, pivots, moves = found[0].toarray(), found[1], found[2]
    moved = moved[np.ix_(moves, moves)]
    assert (order.fronts.of_column[moves] == order.fronts.of_column).all()
    assert (np.diag(lower) == 1).all()
    assert (np.triu(lower, 1) == 0).all()
    assert int((pivots < 0).sum()) == negative
    growth = np.linalg.norm(abs(lower) @ np.diag(abs(pivots)) @ abs(lower).T)
    assert np.linalg.norm(lower @ np.diag(pivots) @ lower.T - moved) < 1e-13 * growth
    if negative:
        assert eliminated(matrix, order.fronts, negative - 1) is None


def test_a_pivot_0_is_no_factor() -> None:
    for rows in ([[0.0, 1.0], [1.0, 0.0]], [[1.0, 1.0], [1.0, 1.0]]):
        matrix = csc_array(np.array(rows) + 0.0)
        order = elimination_order(csc_array(np.array(rows) + 3 * np.eye(2)))
        assert eliminated(matrix, order.fronts, 2) is None


def test_a_small_pivot_is_not_taken_first() -> None:
    """Column 300 of 400 would have the pivot 1e-9, and the factor entries of 1e9."""
    n, small = 400, 1e-9
    whole = np.diag(np.linspace(1, 2, n))
    whole[300, 300] = small
    whole[300, 301:], whole[301:, 300] = 0.5, 0.5
    found = eliminated(csc_array(whole), Fronts([0, n], np.zeros(n, dtype=int)), 1)
    assert found is not None
    lower, pivots, moves = found[0].toarray(), found[1], found[2]
    assert abs(lower).max() < 2
    assert (pivots < 0).sum() == 1
    np.testing.assert_allclose(lower @ np.diag(pivots) @ lower.T, whole[np.ix_(moves, moves)], atol=1e-14)
