"""Large networks: of small graphs of every kind each claim is decided as numpy decides it, and never otherwise."""

import random
from fractions import Fraction
from typing import Any

import mpmath
import numpy as np
import pytest

from tests.checker.large_networks import (
    CLEAR,
    IDS,
    Dense,
    Edges,
    Json,
    Oracle,
    certificate,
    checked,
    claim,
    design,
    edge_list,
    family_edges,
    file_graph,
    slow_vector,
)

pytestmark = pytest.mark.slow

FAMILIES: list[tuple[Json, int]] = [
    *(({"family": name}, n) for name in ("cycle", "path", "star", "complete", "directed-cycle") for n in (2, 3, 4, 7)),
    *(({"family": "hypercube"}, n) for n in (2, 8)),
    *(({"family": "torus", "shape": [r, c]}, r * c) for r, c in ((3, 3), (3, 4), (5, 3))),
    *(({"family": "grid", "shape": [r, c]}, r * c) for r, c in ((1, 2), (4, 1), (2, 3), (4, 4))),
]


def balanced(rng: random.Random, n: int) -> Edges:
    """A sum of weighted cycles, the first through everyone."""
    weights: dict[tuple[int, int], Fraction] = {}
    for number in range(3):
        ring = rng.sample(range(1, n + 1), n if number == 0 else rng.randint(2, n))
        weight = Fraction(rng.randint(1, 9), rng.randint(1, 9))
        for i, agent in enumerate(ring):
            pair = (agent, ring[(i + 1) % len(ring)])
            weights[pair] = weights.get(pair, Fraction(0)) + weight
    return [(*pair, weight) for pair, weight in sorted(weights.items())]


def symmetric(rng: random.Random, n: int) -> Edges:
    weights = {(j, i): Fraction(rng.randint(1, 9), rng.randint(1, 9)) for i in range(2, n + 1) for j in range(1, i)}
    kept = {pair: weight for pair, weight in weights.items() if pair[1] == pair[0] + 1 or rng.random() < 0.4}
    return sorted((*ends, weight) for (i, j), weight in kept.items() for ends in ((i, j), (j, i)))


def gains(edges: Edges, n: int) -> list[Fraction]:
    """mu on both sides of what decides, and in between."""
    top = max(np.diag(Oracle(edges, n, 0.5, 0.0).matrix))
    low, high = Oracle(edges, n, 0.5, 0.0).gaps[[0, -1]]
    near = [0.03 / top, 0.6 / top, 0.97 / top, 1.4 / top, 1.9 / high, 2.3 / high, 2 / (low + high) * 0.98, 1 / low]
    return [Fraction(x).limit_denominator(997) for x in near]


def answers(graph: Json, n: int, alpha: str, mu: Fraction, verdict: str, **more: Any) -> dict[str, str]:
    about = design(graph, n, alpha, mu=str(mu))
    document = certificate(about, *(claim(name, verdict) for name in IDS[1:]), spectrum=more.get("spectrum"))
    report = checked(document, more.get("data", b""), more.get("numeric"))
    return {outcome.id: outcome.status for outcome in report.outcomes}


def compare(graph: Json, edges: Edges, n: int, alpha: str, mu: Fraction, **more: Any) -> int:
    """Assert that no answer is wrong; return how many claims are clear, and not decided."""
    proved, refuted = (answers(graph, n, alpha, mu, verdict, **more) for verdict in ("proved", "refuted"))
    missed = 0
    for name, excess in Oracle(edges, n, float(Fraction(alpha)), float(mu)).excesses().items():
        if abs(excess) < CLEAR:
            continue
        right, wrong = (proved, refuted) if excess < 0 else (refuted, proved)
        assert wrong[name] != "accepted", (name, excess)
        assert right[name] != "refused", (name, excess)
        assert (right[name] == "accepted") == (wrong[name] == "refused")
        missed += right[name] == "undecided"
    return missed


@pytest.mark.parametrize(("graph", "n"), FAMILIES, ids=str)
@pytest.mark.parametrize("alpha", ["9/10", "2/5"])
def test_a_family_is_decided_throughout(graph: Json, n: int, alpha: str) -> None:
    edges = family_edges(graph, n)
    # eqL3 of a directed cycle may fail at a later sample than the first, and hold beyond the repaired condition.
    allowed = 1 if graph["family"] == "directed-cycle" else 0
    for mu in gains(edges, n):
        assert compare(graph, edges, n, alpha, mu) <= allowed


@pytest.mark.parametrize("seed", range(12))
def test_a_listed_graph_is_never_decided_wrongly(seed: int) -> None:
    rng = random.Random(seed)
    n = rng.randint(2, 9)
    edges = (balanced if seed % 2 else symmetric)(rng, n)
    data = edge_list(edges)
    low, high = Oracle(edges, n, 0.5, 0.0).gaps[[0, -1]]
    bounds = {
        "vectors": [slow_vector(edges, n)],
        "lambda2_lower": str(Fraction(low * (1 - 1e-9))),
        "lambda_max_upper": str(Fraction(high * (1 + 1e-9))),
    }
    for mu in gains(edges, n):
        sigma = Oracle(edges, n, 0.5, float(mu)).sigma
        spectrum = {**bounds, "sigma_upper": str(Fraction(sigma * (1 + 1e-9)))}
        for alpha in ("9/10", "2/5"):
            graph, given = file_graph(data), {"data": data, "spectrum": spectrum}
            alone = compare(graph, edges, n, alpha, mu, **given)
            redone = compare(graph, edges, n, alpha, mu, **given, numeric=Dense())
            assert redone <= alone
            if mu * max(np.diag(Oracle(edges, n, 0.5, 0.0).matrix)) < 1:
                # Beyond the gain bound, and for eqL3 and the paper's step of a digraph, bounds do not always decide.
                assert redone <= (2 if seed % 2 else 0)


def test_the_values_of_a_torus_are_seen_to_thirty_digits() -> None:
    graph, n = {"family": "torus", "shape": [316, 316]}, 316**2
    with mpmath.workdps(60):
        exact = 2 - 2 * mpmath.cos(mpmath.pi / 158)
        text = int(mpmath.floor(exact * 10**40))
    about = design(graph, n, mu="1/10")
    right = certificate(about, lambda2=(f"{text}/{10**40}", f"{text + 1}/{10**40}"))
    assert checked(right).exit_status == 0
    for lower, upper in ((text + 1, text + 2), (text - 1, text)):
        assert checked(certificate(about, lambda2=(f"{lower}/{10**40}", f"{upper}/{10**40}"))).exit_status == 1
