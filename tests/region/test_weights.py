"""Weights chosen for an edge set: against published optima, closed forms and numpy; and nonsense of solvers."""

import math
import random
from dataclasses import replace
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

from fomas_verify.design import Design, design_from_mapping
from fomas_verify.network import Digraph, degree_max, imbalances, is_symmetric, laplacian, unreachable_pair
from fomas_verify.region.balanced import balanced_weights
from fomas_verify.region.errors import NoDesignError, UndecidedRegionError
from fomas_verify.region.weighted_design import weighted_design
from fomas_verify.region.weights import BestWeights, WeightProposal, best_weights
from fomas_verify.region.weights_lmi import weights_by_clarabel

PAPER = {"adjacency": [[0, 0, 0, 1, 1], [1, 0, 1, 0, 0], [1, 1, 0, 0, 0], [0, 1, 1, 0, 0], [0, 0, 0, 1, 0]]}
UNBALANCED = {"agents": 5, "edges": [[1, 2], [2, 3], [3, 4], [4, 5], [5, 1], [1, 3]]}


def family(name: str, agents: int) -> dict[str, Any]:
    return {"family": name, "agents": agents}


def design(graph: dict[str, Any], **more: Any) -> Design:
    return design_from_mapping({"alpha": "9/10", "graph": graph, **more})


def singular(graph: Digraph) -> float:
    n = graph.agents
    el = np.array([[float(x) for x in row] for row in laplacian(graph)])
    return float(np.linalg.norm(np.eye(n) - el - 1 / n, 2))


@pytest.mark.parametrize(
    ("graph", "symmetric", "optimum"),
    [
        # the fastest mixing chain on a path has probabilities 1/2 and cos(pi/N): Boyd, Diaconis, Sun and Xiao (2006)
        (family("path", 4), True, math.cos(math.pi / 4)),
        (family("path", 5), False, math.cos(math.pi / 5)),
        (family("cycle", 6), True, 0.6),  # max(1 - w, 4 w - 1) at w = 2/5
        (family("star", 5), True, 0.75),  # 1 - w at w = 1/4, where the centre's weights sum to 1
        (family("directed-cycle", 5), False, math.cos(math.pi / 5)),  # abs(1 - w + w omega) at w = 1/2
        (UNBALANCED, False, math.cos(math.pi / 5)),  # the chord of a ring carries no circulation of its own
        (family("complete", 4), False, 0.0),
    ],
)
def test_known_optima(graph: dict[str, Any], symmetric: bool, optimum: float) -> None:
    found = best_weights(design(graph), symmetric=symmetric)
    assert float(found.least) <= optimum + 1e-12
    assert optimum - 1e-7 <= float(found.least) + (optimum == 0)
    assert optimum - 1e-12 <= float(found.sigma.lower)
    assert float(found.sigma.upper) <= optimum + 2e-4
    assert is_symmetric(found.graph) or not symmetric


def assert_sound(found: BestWeights, of: Design) -> None:
    """Sums exactly equal, the diagonal positive, the edges among those given, sigma as numpy sees it."""
    assert not imbalances(found.graph)
    assert unreachable_pair(found.graph) is None
    assert degree_max(found.graph) < 1
    assert {edge[:2] for edge in found.graph.edges} | set(found.dropped) == {edge[:2] for edge in of.graph.edges}
    assert all(w > 0 for _, _, w in found.graph.edges)
    assert abs(float(found.sigma.mid) - singular(found.graph)) < 1e-12


def test_the_papers_graph() -> None:
    """Equal weights reach 0.818864181986644020778... (mpmath's singular values) at their best mu."""
    about = design(PAPER)
    found = best_weights(about)
    assert_sound(found, about)
    assert found.before is not None
    assert found.before.lower < Fraction("0.8188641819866440208") < found.before.upper + Fraction(1, 10**18)
    assert Fraction("0.7846404399") < found.least <= found.sigma.lower <= found.sigma.upper < Fraction("0.7846405")


def test_no_random_weights_beat_the_bound() -> None:
    """Circulations as mixtures of the graph's cycles."""
    cycles = [(1, 2, 4, 5), (1, 3, 4, 5), (1, 2, 4), (1, 3, 4), (2, 3), (1, 2, 3, 4), (1, 3, 2, 4, 5), (1, 2, 3, 4, 5)]
    least, source = float(best_weights(design(PAPER)).least), random.Random(5)
    best = 1.0
    for _ in range(3000):
        el = np.zeros((5, 5))
        for cycle in cycles:
            share = source.random() ** 3
            for one, other in zip(cycle, (*cycle[1:], cycle[0]), strict=True):
                el[other - 1, one - 1] -= share
                el[other - 1, other - 1] += share
        el *= source.uniform(0.5, 1) / max(np.diag(el))
        best = min(best, float(np.linalg.norm(np.eye(5) - el - 0.2, 2)))
    assert least <= best < 0.87


def spoilt(kind: str) -> Any:
    def propose(graph: Digraph, symmetric: bool, attempt: int) -> WeightProposal | None:
        good = weights_by_clarabel(graph, symmetric, attempt)
        assert good is not None
        first = next(iter(good.weights))
        match kind:
            case "nothing":
                return None
            case "no number":
                return replace(good, weights=good.weights | {first: math.nan})
            case "infinite":
                return replace(good, weights=good.weights | {first: math.inf})
            case "no sigma":
                return replace(good, sigma=math.nan)
            case "too good":
                return replace(good, sigma=good.sigma - 0.01)
            case "another edge":
                return replace(good, weights={(1, 5): 0.5})
            case "negative":
                return replace(good, weights={ends: -w for ends, w in good.weights.items()})
            case "too large":
                return replace(good, weights={ends: 2 * w for ends, w in good.weights.items()})
            case _:
                return replace(good, weights={ends: w / 4 for ends, w in good.weights.items()}, sigma=0.99)

    return propose


@pytest.mark.parametrize(
    "kind",
    ["nothing", "no number", "infinite", "no sigma", "too good", "another edge", "negative", "too large", "worse"],
)
def test_nonsense_is_undecided(kind: str) -> None:
    with pytest.raises(UndecidedRegionError, match="no usable weights"):
        best_weights(design(PAPER), propose=spoilt(kind))


@pytest.mark.parametrize("change", [
    {"pairs": ()}, {"potentials": ()}, {"potentials": (math.nan,) * 5}, {"pairs": (([math.inf] * 5, [0.0] * 5),)},
    {"pairs": (([1.0, -1.0, 0, 0, 0], [0, 0, 1.0, -1.0, 0]),)}, {"potentials": (9.0, -9.0, 5.0, 1.0, 0.0)},
])  # fmt: skip
def test_a_spoilt_dual_only_weakens_the_bound(change: dict[str, Any]) -> None:
    def propose(graph: Digraph, symmetric: bool, attempt: int) -> WeightProposal | None:
        good = weights_by_clarabel(graph, symmetric, attempt)
        return None if good is None else replace(good, **change)

    found = best_weights(design(PAPER), propose=propose)
    assert 0 <= found.least <= found.sigma.lower


def test_where_no_weights_do() -> None:
    with pytest.raises(NoDesignError, match=r"does not reach agent . over edges in both directions$") as caught:
        best_weights(design(PAPER), symmetric=True)
    assert caught.value.exit_status == 1
    with pytest.raises(NoDesignError, match=r"no weights do: agent . does not reach agent .$"):
        best_weights(design({"agents": 3, "edges": [[1, 2], [2, 3]]}))
    with pytest.raises(UndecidedRegionError, match="more than 40 agents"):
        best_weights(design(family("cycle", 41)))


@pytest.mark.parametrize("places", [1, 3, 9])
def test_rounding_keeps_the_balance_exactly(places: int) -> None:
    share = {(1, 2): 1 / 3, (2, 3): 1 / 3 + 1 / 7, (3, 1): 1 / 3, (3, 2): 1 / 7}
    found = balanced_weights(3, share, places, symmetric=False)
    assert found is not None
    for agent in (1, 2, 3):
        assert sum(w for (_, j), w in found.items() if j == agent) == sum(
            w for (i, _), w in found.items() if i == agent
        )
    assert all(abs(float(w) - share[ends]) < 2 * 10**-places for ends, w in found.items())


@pytest.mark.parametrize("weights", [{(1, 2): 0.5, (2, 1): 0.5}, {(1, 2): 0.5, (2, 3): 0.5}, {}])
def test_what_cannot_be_balanced(weights: dict[tuple[int, int], float]) -> None:
    assert balanced_weights(3, weights, 6, symmetric=False) is None


def test_gamma_and_h_are_left_free() -> None:
    about = design(PAPER, x0=["1/3", 2, 3, 4, "5.5"], h="17/20", gamma="3/20")
    weighted = weighted_design(about, best_weights(about))
    assert (weighted.gamma, weighted.mu, weighted.h, weighted.x0) == (None, None, None, about.x0)
