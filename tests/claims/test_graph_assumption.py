"""Assumption 1: which part fails, for whom and by how much."""

from fractions import Fraction

import pytest

from fomas_verify.claims import graph_assumption
from fomas_verify.claims.verdict import Decision, Verdict
from fomas_verify.design import design_from_mapping
from fomas_verify.spectrum.loop import Loop


def decide(agents: int, edges: list[list[object]], **keys: object) -> Decision:
    graph = {"agents": agents, "edges": edges}
    keys = {"name": "x", "alpha": "1/2", "mu": "1", "graph": graph} | keys
    return graph_assumption.decide(Loop(design_from_mapping(keys)))


def test_a_balanced_ring_holds() -> None:
    decision = decide(3, [[1, 2, "1/3"], [2, 3, "1/3"], [3, 1, "1/3"]])
    assert (decision.verdict, decision.witness) == (Verdict.PROVED, {})


@pytest.mark.parametrize(
    ("agents", "edges", "pair", "imbalance"),
    [
        (2, [], [1, 2], None),
        (4, [[1, 2], [2, 1], [3, 4], [4, 3]], [1, 3], None),
        (3, [[1, 2], [2, 1], [2, 3]], [3, 1], (2, 1, 2)),
        (3, [[1, 2], [2, 3], [3, 1], [1, 3]], None, (1, 1, 2)),
        (3, [[1, 2], [2, 3], [3, 1, "1.000000000000000000000000000001"]], None, (1, 1 + Fraction(1, 10**30), 1)),
    ],
)
def test_what_fails(agents: int, edges: list[list[object]], pair: object, imbalance: object) -> None:
    decision = decide(agents, edges)
    assert decision.verdict is Verdict.REFUTED
    assert decision.witness.get("unreachable") == pair
    if imbalance is None:
        assert "imbalance" not in decision.witness
    else:
        assert tuple(decision.witness["imbalance"].values()) == imbalance
        assert list(decision.witness["imbalance"]) == ["agent", "in", "out"]
    assert ("not strongly connected" in decision.reason) == (pair is not None)
    assert ("not balanced" in decision.reason) == (imbalance is not None)


def test_a_long_list_of_unbalanced_agents_is_cut_and_counted() -> None:
    decision = decide(9, [[1, j] for j in range(2, 10)])
    assert decision.reason.endswith(", and 4 more")


ROOTED = [[1, 2], [2, 3], [3, 1], [1, 3]]


def test_a_rooted_graph_agrees_on_a_weighted_mean() -> None:
    """L = [[1, 0, -1], [-1, 1, 0], [-1, -1, 2]], so w = (2, 1, 1)/4: w^T L = 0. Eigenvalues 0, 2, 2: mu* = 1."""
    meaning = decide(3, ROOTED, mu="1/2", x0=[1, 2, 3]).meaning
    assert "w = (1/2, 1/4, 1/4), which is 1.75 for the given x_0" in meaning
    assert "which is (1.75, 0) for the given x_0" in decide(3, ROOTED, mu="1/2", x0=[[1, 1], [2, -2], [3, 0]]).meaning


def test_only_the_agents_that_reach_every_other_have_weight() -> None:
    """Agents 1 and 2 hear each other with weights 1 and 3; the third hears only."""
    assert "w = (3/4, 1/4, 0)." in decide(3, [[2, 1, 1], [1, 2, 3], [2, 3, 1]], mu="1/8").meaning


@pytest.mark.parametrize(
    ("agents", "edges", "mu"),
    [(4, [[1, 2], [2, 1], [3, 4], [4, 3]], "1/8"), (3, [[1, 2], [3, 2]], "1/8"), (3, ROOTED, "1"), (3, ROOTED, "2")],
)
def test_without_a_root_or_with_too_large_a_gain_nothing_is_promised(
    agents: int, edges: list[list[object]], mu: str
) -> None:
    assert decide(agents, edges, mu=mu).meaning.endswith("do not expect average consensus from it.")
