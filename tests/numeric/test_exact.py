"""Redone bounds against exact rational arithmetic: near misses on both sides, by a sparse and by a dense factor.

Blocks of three rows make several of what are few rows.
"""

import random
from fractions import Fraction

import numpy as np
import pytest

from fomas_verify.numeric import Redo, dense, redo
from fomas_verify.numeric.floats import Symmetric
from fomas_verify.numeric.ways import Way
from tests.checker.large_networks import Edges, joined, laplacian
from tests.checker.test_large_truth import balanced, symmetric
from tests.numeric.test_redo import MEMORY, network

DISTANCES = (1e-3, 1e-6, 1e-9, 1e-12, 1e-15)


@pytest.fixture(params=["sparse", "dense", "dense, by blocks"])
def redone(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> Redo:
    def way_for(matrix: Symmetric, memory: int, *, on_perp: bool) -> Way:
        return Way(matrix, memory, request.param != "sparse", on_perp)

    if request.param == "dense, by blocks":
        monkeypatch.setattr(dense, "_BLOCK", 3)
    monkeypatch.setattr(redo, "way_for", way_for)
    return Redo(MEMORY)


def at_least(edges: Edges, n: int, bound: Fraction, sign: int = 1) -> bool:
    """Whether sign L_s - bound I has no negative eigenvalue on 1perp, by elimination with fractions."""
    rows = [[Fraction(0)] * n for _ in range(n)]
    for source, target, weight in edges:
        i, j = source - 1, target - 1
        rows[j][j] += sign * weight
        for a, b in ((i, j), (j, i)):
            rows[a][b] -= sign * weight / 2
    for i in range(n):
        rows[i][i] -= bound
    last, m = n - 1, n - 1
    # In the basis e_i - e_n.
    left = [[rows[i][j] - rows[i][last] - rows[last][j] + rows[last][last] for j in range(m)] for i in range(m)]
    for k in range(m):
        if left[k][k] < 0 or (left[k][k] == 0 and any(left[k][k:])):
            return False
        for i in range(k + 1, m if left[k][k] else 0):
            share = left[i][k] / left[k][k]
            left[i] = [a - share * b for a, b in zip(left[i], left[k], strict=True)]
    return True


def never_wrong(found: bool | None, truth: bool) -> bool:
    return found is None or found is truth


@pytest.mark.parametrize("seed", range(100))
def test_no_answer_is_wrong_and_none_is_missing_at_a_distance(seed: int, redone: Redo) -> None:
    rng = random.Random(seed)
    n = rng.randint(3, 9)
    edges = (balanced if seed % 2 else symmetric)(rng, n)
    given, whole = network(edges, n), laplacian(edges, n)
    values = np.linalg.eigvalsh((whole + whole.T) / 2)
    answered = 0
    for distance in DISTANCES:
        for side in (-1, 1):
            low, high = (Fraction(float(values[k] * (1 + side * distance))) for k in (1, -1))
            for found, truth in (
                (redone.lambda2_at_least(given, low), at_least(edges, n, low)),
                (redone.lambda_max_at_most(given, high), at_least(edges, n, -high, -1)),
            ):
                assert never_wrong(found, truth)
                answered += found is truth
    assert answered >= 10


@pytest.mark.parametrize("n", [4, 54, 301])
def test_a_ring_whose_lambda2_is_a_double_eigenvalue(n: int, redone: Redo) -> None:
    places = random.Random(n).sample(range(1, n + 1), n)
    given = network(joined(zip(places, [*places[1:], places[0]], strict=True)), n)
    lambda2 = 2 - 2 * np.cos(2 * np.pi / n)
    assert redone.lambda2_at_least(given, Fraction(lambda2 * (1 - 8e-7))) is True
    assert redone.lambda2_at_least(given, Fraction(lambda2 * (1 + 8e-7))) is False


@pytest.mark.parametrize("seed", range(20))
def test_weights_twelve_orders_apart(seed: int, redone: Redo) -> None:
    rng = random.Random(seed)
    n = rng.randint(3, 9)
    pairs = [(i, i + 1) for i in range(1, n)] + [(1, i) for i in range(3, n + 1)]
    edges = [edge for pair in pairs for edge in joined([pair], Fraction(10) ** rng.randint(-6, 6))]
    given, whole = network(sorted(edges), n), laplacian(edges, n)
    for k, sign in ((1, 1), (-1, -1)):
        near = Fraction(float(np.linalg.eigvalsh(whole)[k]))
        for factor in (Fraction(1, 2), 1 - Fraction(1, 10**9), 1 + Fraction(1, 10**9), Fraction(2)):
            bound = abs(near) * factor
            ask = redone.lambda2_at_least if sign > 0 else redone.lambda_max_at_most
            assert never_wrong(ask(given, bound), at_least(edges, n, sign * bound, sign))


def test_where_neither_factor_fits_there_is_no_answer() -> None:
    given = network(joined((i, j) for i in range(1, 40) for j in range(1, i)), 39)
    assert Redo(1 << 10).lambda2_at_least(given, Fraction(38)) is None
    assert Redo(MEMORY).lambda2_at_least(given, Fraction(38)) is True
