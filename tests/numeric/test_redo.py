"""Bounds redone by a factor: shown where they are true, never where they are false, whatever the factor looks like."""

import hashlib
import io
import random
import subprocess
import sys
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.sparse import csc_array

from fomas_verify.checker.edge_list import read_edge_list
from fomas_verify.checker.network import Network
from fomas_verify.numeric import Redo, inertia
from fomas_verify.numeric.floats import Symmetric
from tests.checker.large_networks import Edges, Oracle, edge_list, joined
from tests.checker.test_large_truth import balanced, symmetric

MEMORY = 4 << 30


def network(edges: Edges, n: int) -> Network:
    data = edge_list(edges)
    return read_edge_list(lambda _: io.BytesIO(data), "x", hashlib.sha256(data).hexdigest(), len(edges), n, "$")


@pytest.mark.parametrize("seed", range(30))
def test_it_agrees_with_dense_eigenvalues(seed: int) -> None:
    rng = random.Random(seed)
    n = rng.randint(3, 30)
    edges = (balanced if seed % 2 else symmetric)(rng, n)
    mu = Fraction(1, 3 * int(max(np.diag(Oracle(edges, n, 0.5, 0.0).matrix)) + 1))
    oracle, given, redo = Oracle(edges, n, 0.5, float(mu)), network(edges, n), Redo(MEMORY)
    for margin, expected in ((1e-8, True), (-1e-8, False)):
        assert redo.lambda2_at_least(given, Fraction(oracle.gaps[0] * (1 - margin))) is expected
        assert redo.lambda_max_at_most(given, Fraction(oracle.gaps[-1] * (1 + margin))) is expected
        assert (
            redo.sigma_at_most(given, (mu, mu * (1 + Fraction(1, 10**15))), Fraction(oracle.sigma * (1 + margin)))
            is expected
        )
    # A bound that is met exactly, or is of no use, is not shown.
    assert redo.lambda2_at_least(given, Fraction(0)) is None
    assert redo.sigma_at_most(given, (mu, mu * 100), Fraction(1, 2)) is None


def test_a_bound_that_is_met_exactly_is_not_shown() -> None:
    # lambda2 of a complete graph is N; no float can tell a tie.
    complete = network(joined((i, j) for i in range(1, 9) for j in range(1, i)), 8)
    redo = Redo(MEMORY)
    assert redo.lambda2_at_least(complete, Fraction(8)) is not True
    assert redo.lambda_max_at_most(complete, Fraction(8)) is not True
    assert redo.lambda2_at_least(complete, 8 - Fraction(1, 10**9)) is True
    assert redo.lambda2_at_least(complete, 8 + Fraction(1, 10**9)) is False


@pytest.mark.parametrize("weak", [Fraction(1, 10**9), Fraction(1, 10**12)])
def test_two_rings_nearly_apart(weak: Fraction) -> None:
    """lambda2 of two complete graphs of 4 joined by one edge of weight w lies between w/2 (1 - w) and w/2."""
    halves = [(i + 4 * half, j + 4 * half) for half in (0, 1) for i in range(1, 5) for j in range(1, i)]
    edges = sorted([*joined(halves), *joined([(1, 5)], weak)])
    given, redo = network(edges, 8), Redo(MEMORY)
    assert redo.lambda2_at_least(given, weak / 2 * Fraction(11, 10)) is not True
    found = redo.lambda2_at_least(given, weak / 2 * Fraction(9, 10))
    assert found is not False
    assert found is True or weak < Fraction(1, 10**9)


def test_weights_too_far_apart_for_doubles_are_left_alone() -> None:
    edges = sorted([*joined([(1, 2)], Fraction(10**200)), *joined([(2, 3)], Fraction(1, 10**60))])
    given, redo = network(edges, 3), Redo(MEMORY)
    assert redo.lambda2_at_least(given, Fraction(1, 10**90)) is None
    assert redo.lambda_max_at_most(given, Fraction(10**300)) is None
    assert redo.sigma_at_most(given, (Fraction(1, 10**300),) * 2, Fraction(99, 100)) is None


def matrix(seed: int = 0, n: int = 80, *, least: int = 40) -> tuple[Symmetric, np.ndarray]:
    """Of a band and some more, so that qdldl's columns and the end that is not qdldl's both matter."""
    rng = np.random.default_rng(seed)
    full = np.triu(np.tril(rng.integers(-9, 10, (n, n)).astype(float), 3))
    full = full + full.T
    np.fill_diagonal(full, rng.integers(least, 90, n))
    return Symmetric(csc_array(np.triu(full)), np.zeros(n)), full


def test_the_count_is_that_of_dense_eigenvalues() -> None:
    for seed in range(50):
        symmetric_matrix, full = matrix(seed, 6 + 2 * seed, least=(-9, 20, 40)[seed % 3])
        found = inertia.inertia(symmetric_matrix, MEMORY)
        values = np.linalg.eigvalsh(full)
        if found is not None and min(abs(values)) > 1e-6:
            assert found[0] == (values < 0).sum()
            assert found[1] < 1e-9


@pytest.mark.parametrize("damage", ["entry", "pivot", "order", "upper", "diagonal", "huge"])
def test_a_factor_that_is_not_one_is_seen(monkeypatch: pytest.MonkeyPatch, damage: str) -> None:
    """The residual is as large as what was changed, or the factor is not taken at all."""
    import qdldl

    symmetric_matrix, _ = matrix()
    real = qdldl.Solver

    class Damaged:
        def __init__(self, *args: Any, **more: Any) -> None:
            self.parts = real(*args, **more).factors()

        def factors(self) -> Any:
            lower, pivots, order = self.parts
            lower, pivots, order = csc_array(lower).copy(), np.array(pivots), np.array(order)
            if damage == "entry":
                lower.data[0] += 1e-3
            elif damage == "pivot":
                pivots[0] = -pivots[0]
            elif damage == "order":
                order[0] = order[1]
            elif damage == "huge":
                # Products overflow, and what is compared is no number: it must not pass for a small one.
                lower.data[:] = 1e300
            else:
                extra = np.zeros(lower.shape)
                extra[(0, 3) if damage == "upper" else (2, 2)] = 1.0
                lower = csc_array(lower + csc_array(extra))
            return lower, pivots, order

    monkeypatch.setattr(qdldl, "Solver", Damaged)
    monkeypatch.setattr(inertia, "_MOST_TAIL", 48)
    found = inertia.inertia(symmetric_matrix, MEMORY)
    assert found is None or found[1] > 1e-5


FILLED_IN = """
import random
from fractions import Fraction
from fomas_verify.numeric import Redo
from tests.checker.large_networks import joined
from tests.numeric.test_redo import MEMORY, network

rng, n, pairs = random.Random(1), 1500, set()
for _ in range(4):
    order = rng.sample(range(1, n + 1), n)
    pairs |= {(min(pair), max(pair)) for pair in zip(order, [*order[1:], order[0]], strict=True)}
graph, bound = network(joined(pairs), n), Fraction(1, 10)
print(Redo(1 << 20).lambda2_at_least(graph, bound), Redo(MEMORY).lambda2_at_least(graph, bound))
"""


@pytest.mark.slow
# The limit is held against /proc/self/statm; elsewhere there is no limit to be tested.
@pytest.mark.skipif(sys.platform != "linux", reason="the limit needs a process's memory, which only Linux tells")
def test_no_memory_is_no_answer() -> None:
    """A random graph of degree 8, whose factor fills in, in a process that has no memory left from before."""
    root = Path(__file__).resolve().parents[2]
    run = subprocess.run([sys.executable, "-c", FILLED_IN], cwd=root, capture_output=True, text=True, check=False)
    assert (run.stdout, run.stderr) == ("None True\n", "")


@pytest.mark.parametrize("exponent", [19, 200, 400])
def test_of_a_gain_beyond_doubles_nothing_is_said(exponent: int) -> None:
    ring: Edges = [(i, i % 4 + 1, Fraction(1)) for i in range(1, 5)]
    mu, bound = Fraction(10**exponent), Fraction(10 ** (exponent - 10))
    assert Redo(MEMORY).sigma_at_most(network(ring, 4), (mu, mu), bound) is None
