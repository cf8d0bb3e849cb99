"""The large networks that are measured are what they are called, and one is measured, at a small size."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from scipy.sparse.csgraph import connected_components

from benchmarks import large

SMALL: dict[str, Callable[[], Any]] = {
    "torus": lambda: large.torus(12),
    "geometric": lambda: large.geometric(300, 12),
    "expander": lambda: large.expander(50, 3),
}


@pytest.mark.parametrize("name", SMALL)
def test_each_satisfies_assumption_1(name: str) -> None:
    weights = SMALL[name]()
    np.testing.assert_array_equal(weights.sum(axis=0), weights.sum(axis=1))
    assert weights.diagonal().max() == 0
    assert connected_components(weights, connection="strong")[0] == 1


def test_a_torus_has_its_eigenvalue() -> None:
    dense = SMALL["torus"]().toarray()
    values = np.linalg.eigvalsh(np.diag(dense.sum(axis=1)) - dense)
    assert values[1] == pytest.approx(2 - 2 * np.cos(2 * np.pi / 12))


@pytest.mark.slow
def test_the_first_is_measured_against_eigsh(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(large, "CASES", {large.FIRST: (SMALL["torus"], "a goal")})
    names, figures, goals = zip(*large.rows(), strict=True)
    assert [name.split()[0] for name in names] == ["prove,", "its", "eigsh,", "prove", "check"]
    assert 0 < float(figures[1]) < 1e-6
    assert goals[0] == "a goal"
