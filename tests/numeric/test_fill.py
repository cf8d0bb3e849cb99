"""Columns of a factor counted before it is formed, against elimination done on sets."""

import numpy as np
import pytest
from scipy.sparse import csc_array

from fomas_verify.numeric.fill import column_counts, fill


def eliminated(pattern: np.ndarray, places: np.ndarray) -> list[int]:
    order = np.argsort(places)
    left = pattern[order][:, order].copy()
    counts = []
    for k in range(len(left)):
        rows = np.flatnonzero(left[k:, k]) + k
        counts.append(len(rows))
        left[np.ix_(rows, rows)] = True
    return sorted(counts)


@pytest.mark.parametrize("seed", range(100))
def test_the_counts_are_those_of_an_elimination(seed: int) -> None:
    rng = np.random.default_rng(seed)
    n = int(rng.integers(1, 25))
    pattern = rng.random((n, n)) < 0.3 * rng.random()
    pattern = pattern | pattern.T | np.eye(n, dtype=bool)
    places = rng.permutation(n)
    assert sorted(column_counts(csc_array(np.triu(pattern).astype(float)), places)) == eliminated(pattern, places)


def test_a_tree_does_not_fill_and_a_complete_graph_is_full() -> None:
    star, full = np.eye(9), np.ones((9, 9))
    star[0] = 1
    assert fill(csc_array(star)).entries == 17
    assert fill(csc_array(np.triu(full))).entries == 45
