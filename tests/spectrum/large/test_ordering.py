"""The size of a factor is known before it is formed."""

from itertools import pairwise

import numpy as np
import pytest
from scipy.sparse import csc_array, eye_array, random_array

from fomas_verify.spectrum.large import ordering
from fomas_verify.spectrum.large.ordering import elimination_order


def filled(pattern: np.ndarray) -> list[int]:
    """The entries of each column, by eliminating the pattern."""
    counts = []
    for k in range(len(pattern)):
        below = np.flatnonzero(pattern[k:, k]) + k
        counts.append(len(below))
        pattern[np.ix_(below[1:], below[1:])] = True
    return counts


@pytest.mark.parametrize("seed", range(40))
@pytest.mark.parametrize("fails", [False, True])
def test_the_counts_are_those_of_the_elimination(seed: int, fails: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    if fails:

        def spilu(*_: object, **__: object) -> None:
            raise RuntimeError

        monkeypatch.setattr("scipy.sparse.linalg.spilu", spilu)
    rng = np.random.default_rng(seed)
    n = int(rng.integers(2, 60))
    upper = random_array((n, n), density=rng.uniform(0, 0.3), rng=rng)
    matrix = csc_array(upper + upper.T + n * eye_array(n))
    order = elimination_order(matrix)
    assert sorted(order.rows.tolist()) == list(range(n))
    assert order.counts.tolist() == filled(matrix.toarray()[np.ix_(order.rows, order.rows)] != 0)
    assert order.entries == order.counts.sum()
    edges = order.fronts.edges
    assert (edges[0], edges[-1]) == (0, n)
    assert order.fronts.of_column.tolist() == [s for s, (a, b) in enumerate(pairwise(edges)) for _ in range(a, b)]
    assert all(a < b for a, b in pairwise(edges))


def test_a_root_is_found_through_a_long_path() -> None:
    ancestors = [1, 2, 3, 3]
    assert ordering._root(ancestors, 0) == 3
    assert ancestors == [3, 3, 3, 3]
