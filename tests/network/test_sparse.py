"""Arrays and edges say the same."""

from fractions import Fraction

import pytest

from fomas_verify.network import digraph, family
from fomas_verify.network.sparse import sparse_digraph

HUGE = Fraction(2**70 + 1, 3)


@pytest.mark.parametrize(
    "graph",
    [
        family("directed-cycle", agents=4),
        family("torus", shape=(3, 4)),
        digraph(3, [(1, 2, Fraction(1, 6)), (3, 1, Fraction(3, 4))]),
        digraph(2, [(1, 2, HUGE), (2, 1, Fraction(1, 2))]),
        digraph(2, []),
    ],
)
def test_there_and_back(graph) -> None:
    assert sparse_digraph(graph).to_digraph() == graph


def test_rows_count_from_0_and_weights_have_one_denominator() -> None:
    graph = sparse_digraph(digraph(3, [(1, 2, Fraction(1, 6)), (3, 1, Fraction(3, 4))]))
    assert (graph.sources.tolist(), graph.targets.tolist()) == ([0, 2], [1, 0])
    assert (graph.weights.tolist(), graph.denominator) == ([2, 9], 12)


def test_weights_beyond_63_bits_stay_exact() -> None:
    graph = sparse_digraph(digraph(2, [(1, 2, HUGE), (2, 1, Fraction(1, 2))]))
    assert [Fraction(w, graph.denominator) for w in graph.weights] == [HUGE, Fraction(1, 2)]
