"""The matrices in doubles are as near to the exact ones as they say."""

import random
from fractions import Fraction

import pytest

from fomas_verify.spectrum.large.matrices import Near, scaled
from tests.spectrum.large.exact_counts import Rows, gram, laplacian, random_network, symmetric_part
from tests.spectrum.large.test_large_bounds import graph_of

FACTORS = [Fraction(1), Fraction(1, 3), Fraction(2**70 + 1, 7), Fraction(1, 10**30), Fraction(10**20, 3**9)]


def distance(near: Near, exact: Rows) -> Fraction:
    """The largest row sum of the difference: at least the 2-norm."""
    rows = near.matrix.toarray().tolist()
    return max(sum(abs(Fraction(x) - y) for x, y in zip(*each, strict=True)) for each in zip(rows, exact, strict=True))


@pytest.mark.parametrize("seed", range(50))
def test_the_difference_is_within_the_error(seed: int) -> None:
    rng = random.Random(seed)
    n = rng.randint(2, 14)
    factor = FACTORS[seed % len(FACTORS)]
    spread = rng.choice([0, 12])
    edges = {e: w * factor for e, w in random_network(rng, n, symmetric=seed % 4 == 0, spread=spread).items()}
    rows, network = laplacian(n, edges), scaled(graph_of(n, edges))
    assert network is not None
    degree = max(rows[i][i] for i in range(n)) / network.unit
    assert degree <= Fraction(network.degree) <= degree * (1 + Fraction(1, 10**5)) <= 2
    part = network.symmetric_part()
    exact = [[x / network.unit for x in row] for row in symmetric_part(rows)]
    assert distance(part, exact) <= Fraction(part.error)
    assert part.error < 1e-14
    gain = rng.choice([rng.uniform(0.01, 3), 1e4 * rng.random()])
    mu = Fraction(gain) / network.unit
    decrease = network.decrease(gain)
    identity = [[Fraction(int(i == j)) for j in range(n)] for i in range(n)]
    exact = [
        [(x - y) / Fraction(gain) for x, y in zip(*each, strict=True)]
        for each in zip(identity, gram(rows, mu), strict=True)
    ]
    assert distance(decrease, exact) <= Fraction(decrease.error)
    assert decrease.error < 1e-13 * (1 + gain)
    for near in (part, decrease):
        whole = near.matrix.toarray()
        assert (whole == whole.T).all()
        assert near.matrix.nnz >= n
        assert near.matrix.has_sorted_indices


def test_every_diagonal_entry_is_stored_even_if_it_is_0() -> None:
    # mu = 1 on a directed cycle: P is a permutation, and I - P^T P is 0.
    edges = {(i, i % 5 + 1): Fraction(1) for i in range(1, 6)}
    network = scaled(graph_of(5, edges))
    assert network is not None
    decrease = network.decrease(float(network.unit))
    assert (decrease.matrix.toarray() == 0).all()
    stored = {(int(i), j) for j in range(5) for i in decrease.matrix.indices[slice(*decrease.matrix.indptr[j : j + 2])]}
    assert {(j, j) for j in range(5)} <= stored


def test_weights_beyond_doubles_have_no_matrices() -> None:
    edges = {(1, 2): Fraction(2**600), (2, 1): Fraction(2**600), (2, 3): Fraction(1), (3, 2): Fraction(1)}
    assert scaled(graph_of(3, edges)) is None
