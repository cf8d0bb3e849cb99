"""Graphs to switch among: what is decided, against closed forms, direct simulation and numpy; solvers' nonsense."""

import json
import math
import random
from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

from fomas_verify.certificate import switching_document
from fomas_verify.checker import check
from fomas_verify.checker.statements import SWITCHED_CONDITIONS, SWITCHED_STATEMENTS
from fomas_verify.claims.verdict import Verdict
from fomas_verify.design import DesignError, SwitchedDesign
from fomas_verify.design.reading import named_from_mapping
from fomas_verify.network import laplacian
from fomas_verify.region import common_search, words
from fomas_verify.region.common_lmi import Margin, Margins, margins_by_clarabel
from fomas_verify.region.common_search import Search
from fomas_verify.region.errors import UndecidedRegionError
from fomas_verify.region.switching import SwitchedProof, loops_of, prove_switched
from fomas_verify.region.switching_region import find_switched_region
from fomas_verify.spectrum.loop import Loop

PAPER = {"adjacency": [[0, 0, 0, 1, 1], [1, 0, 1, 0, 0], [1, 1, 0, 0, 0], [0, 1, 1, 0, 0], [0, 0, 0, 1, 0]]}
RING = {"family": "directed-cycle", "agents": 5}
BACK = {"agents": 5, "edges": [[i % 5 + 1, i] for i in range(1, 6)]}
UNBALANCED = {"agents": 5, "edges": [[1, 2], [2, 3], [3, 4], [4, 5], [5, 1], [1, 3]]}
CONSENSUS = ("control-bounded", "average-consensus")


def design(*graphs: dict[str, Any], **numbers: Any) -> SwitchedDesign:
    found = named_from_mapping({"alpha": "9/10", **numbers, "graphs": list(graphs)})
    assert isinstance(found, SwitchedDesign)
    return found


def verdicts(proof: SwitchedProof) -> dict[str, str]:
    return {name: decision.verdict.value for name, decision in proof.decisions.items()}


def assert_accepted(certificate: str) -> None:
    report = check(certificate.encode())
    assert {outcome.status for outcome in report.outcomes} == {"accepted"}, report.outcomes


def alone(loops: Sequence[Loop]) -> Search:
    """Without a solver."""
    return Search(loops, None)


@pytest.mark.parametrize(
    ("graphs", "mu", "consensus", "status"),
    [
        ((PAPER, RING), "2/5", "proved", 0),
        ((PAPER, RING), "13/20", "proved", 0),
        ((PAPER, RING), ["1/10", "13/20"], "proved", 0),
        ((PAPER, RING), "33/50", "undecided", 3),
        ((PAPER, RING), "7/10", "refuted", 1),
        ((PAPER, RING), ["1/10", "7/10"], "refuted", 1),
        ((PAPER, UNBALANCED), "1/10", "inapplicable", 1),
        ((RING, BACK), "999/1000", "proved", 0),
        ((RING, BACK), "1", "refuted", 1),
        ((PAPER,), "13/20", "proved", 0),
    ],
)
def test_what_is_decided(graphs: tuple[dict[str, Any], ...], mu: Any, consensus: str, status: int) -> None:
    """P of a directed cycle is normal and of norm below 1 up to mu* = 1; mu* = 2/3 of the paper's graph."""
    proof = prove_switched(design(*graphs, mu=mu))
    assert {verdicts(proof)[name] for name in CONSENSUS} == {consensus}
    assert proof.exit_status == status
    assert_accepted(proof.certificate())
    assert (proof.rate is not None) == (consensus == "proved")


ONE = {"agents": 5, "edges": [[1, 2, 5], [1, 3, 4], [2, 4, 5], [3, 1, 5], [3, 4, 4], [4, 5, 9], [5, 1, 4], [5, 3, 5]]}
OTHER = {"agents": 5, "edges": [[1, 5, 2], [2, 1, 2], [3, 4, 2], [4, 5, 2], [5, 2, 2], [5, 3, 2]]}


@pytest.mark.parametrize("mu", ["0.15", "0.1514", ["0.1", "0.155"]])
def test_graphs_in_turn_may_fail_where_each_alone_agrees(mu: Any) -> None:
    """mu* = 0.1559 and more; numpy sees the product ONE, ONE, OTHER leave the unit disc at mu = 0.1499."""
    proof = prove_switched(design(ONE, OTHER, mu=mu))
    for name in CONSENSUS:
        assert proof.decisions[name].verdict is Verdict.REFUTED
        assert sorted(proof.decisions[name].witness["word"]) == [1, 1, 2]
    assert proof.exit_status == 1
    assert_accepted(proof.certificate())


def test_graphs_in_turn_are_not_refuted_where_they_do_not_grow() -> None:
    assert verdicts(prove_switched(design(ONE, OTHER, mu="0.149")))["average-consensus"] == "undecided"


@pytest.mark.parametrize("limit", ["MOST_BITS", "MOST_POWER", "MOST_PRODUCTS"])
def test_beyond_its_work_a_search_for_an_order_finds_nothing(monkeypatch: pytest.MonkeyPatch, limit: str) -> None:
    monkeypatch.setattr(words, limit, 1)
    assert verdicts(prove_switched(design(ONE, OTHER, mu="0.1514")))["average-consensus"] == "undecided"


def test_without_numpy_no_order_is_sought(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(words, "find_spec", lambda name: None)
    assert words.growing_word(loops_of(design(ONE, OTHER, mu="0.1514")), Fraction("0.1514")) is None


def test_without_a_solver_the_gain_bound_suffices() -> None:
    """Under (15) the norm itself decreases: kappa = 1, and the certificate names no solver."""
    proof = prove_switched(design(PAPER, RING, gamma="3/20", h="17/20"), alone)
    assert set(verdicts(proof).values()) == {"proved"}
    assert proof.rate is not None
    assert proof.rate.kappa == 1
    text = proof.certificate()
    assert "solver" not in text
    assert text == prove_switched(design(PAPER, RING, gamma="3/20", h="17/20"), alone).certificate()
    assert_accepted(text)


def test_beyond_the_norm_without_a_solver_it_says_what_is_missing(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(common_search, "find_spec", lambda name: None)
    monkeypatch.setattr("fomas_verify.region.switching.installed", common_search.installed)
    proof = prove_switched(design(PAPER, RING, mu="13/20"))
    assert {verdicts(proof)[name] for name in CONSENSUS} == {"undecided"}
    assert "fomas_verify[region]" in proof.decisions["average-consensus"].reason
    assert_accepted(proof.certificate())


def test_a_solvers_form_is_named_as_such() -> None:
    document = json.loads(prove_switched(design(PAPER, RING, mu="13/20")).certificate())
    assert document["claims"][3]["witness"]["solver"] == "clarabel"
    assert all(Fraction(x).denominator.bit_count() == 1 for row in document["claims"][3]["witness"]["Q"] for x in row)


def spoilt(kind: str) -> Any:
    """A search whose solver answers nonsense, and calls it optimal."""

    def searcher(loops: Sequence[Loop]) -> Search:
        good = margins_by_clarabel(loops)

        def margins(t: Fraction, attempt: int) -> Margin | None:
            answer = good(t, attempt)
            assert answer is not None
            n = len(answer.form)
            match kind:
                case "nothing":
                    return None
                case "no numbers":
                    nan = [[math.nan] * n for _ in range(n)]
                    return Margin(math.nan, nan, (nan, nan))
                case "infinite":
                    large = [[math.inf] * n for _ in range(n)]
                    return Margin(math.inf, large, (large, large))
                case "zero":
                    zero = [[0.0] * n for _ in range(n)]
                    return Margin(1.0, zero, (zero, zero))
                case "violated":
                    form = [[-x for x in row] for row in answer.form]
                    return Margin(1.0, form, (answer.dual[0], [[-x for x in row] for row in answer.dual[1]]))
                case "another sign":
                    return replace(answer, eps=-answer.eps, dual=answer.dual[:1])
                case _:
                    identity = [[float(i == j) for j in range(n)] for i in range(n)]
                    return Margin(1.0, identity, (identity, identity))

        return Search(loops, margins)

    return searcher


NONSENSE = ["nothing", "no numbers", "infinite", "zero", "violated", "a point that is none"]


@pytest.mark.parametrize("kind", NONSENSE)
@pytest.mark.parametrize("mu", ["13/20", "33/50"])
def test_nonsense_is_undecided(kind: str, mu: str) -> None:
    proof = prove_switched(design(PAPER, RING, mu=mu), spoilt(kind))
    assert {verdicts(proof)[name] for name in CONSENSUS} == {"undecided"}
    assert proof.exit_status == 3
    assert "Z" not in proof.decisions["average-consensus"].witness
    assert_accepted(proof.certificate())


@pytest.mark.parametrize("kind", [*NONSENSE, "another sign"])
def test_nonsense_makes_a_region_wide_and_never_wrong(kind: str) -> None:
    """t* = 0.65873730...: by 32 halvings with clarabel, and by the dual."""
    found = find_switched_region(design(PAPER, RING), spoilt(kind))
    strip = found.strips[1]
    assert strip.inner is not None
    assert strip.inner[1] < Fraction("0.6587373021")
    assert strip.outer > Fraction("0.6587373005")
    assert_accepted(found.certificate())


def test_a_second_answer_may_mend_the_first() -> None:
    def searcher(loops: Sequence[Loop]) -> Search:
        good: Margins = margins_by_clarabel(loops)
        return Search(loops, lambda t, attempt: good(t, attempt) if attempt else None)

    assert verdicts(prove_switched(design(PAPER, RING, mu="13/20"), searcher))["average-consensus"] == "proved"


@pytest.mark.parametrize(
    ("graphs", "low", "high"),
    [
        ((PAPER, RING), "0.658737", "0.658738"),
        ((RING, BACK), "0.99999999", "1"),
        ((PAPER,), "0.66666666", "0.66666667"),
        (({"family": "path", "agents": 3}, {"family": "star", "agents": 3}), "0.66666666", "0.66666667"),
    ],
)
def test_the_region(graphs: tuple[dict[str, Any], ...], low: str, high: str) -> None:
    """Of one graph, and of symmetric ones, it ends at the least mu*."""
    found = find_switched_region(design(*graphs))
    strip = found.strips[1]
    assert strip.inner is not None
    assert Fraction(low) <= strip.inner[1] <= strip.outer <= Fraction(high)
    assert_accepted(found.certificate())


@pytest.mark.parametrize("graphs", [(PAPER, RING), (RING, BACK)])
def test_a_region_wider_by_a_millionth_is_refused(graphs: tuple[dict[str, Any], ...]) -> None:
    document = json.loads(find_switched_region(design(*graphs)).certificate())
    for key, end, side in (("inner", 1, 1), ("outer", 1, -1)):
        changed = json.loads(json.dumps(document))
        ends = changed["claims"][1]["witness"]["mu"][key]
        ends[end] = str(Fraction(ends[end]) + side * Fraction(1, 10**6))
        assert check(json.dumps(changed).encode()).outcomes[1].status == "refused"


def test_a_region_without_a_solver_ends_where_one_graph_fails() -> None:
    found = find_switched_region(design(PAPER, RING), alone)
    strip = found.strips[1]
    assert strip.inner is not None
    assert Fraction(1, 2) <= strip.inner[1] + Fraction(1, 10**6) < strip.outer < Fraction(67, 100)
    assert_accepted(found.certificate())


def test_where_assumption_1_fails() -> None:
    found = find_switched_region(design(PAPER, UNBALANCED))
    assert [strip.inner is None for strip in found.strips] == [False, True]
    assert_accepted(found.certificate())
    proof = prove_switched(design(PAPER, UNBALANCED, mu="1/10"))
    assert proof.decisions["graph-assumption"].witness["graph"] == 2


def test_what_is_refused() -> None:
    with pytest.raises(DesignError, match="mu: expected a number, got an interval"):
        find_switched_region(design(PAPER, mu=["1/10", "1/5"]))
    with pytest.raises(DesignError, match="graphs: region needs at least one edge"):
        find_switched_region(design({"agents": 3, "edges": []}))
    with pytest.raises(DesignError, match="prove needs mu, or gamma and h"):
        prove_switched(design(PAPER, h="1"))
    large = {"family": "cycle", "agents": 61}
    for call in (find_switched_region, prove_switched):
        with pytest.raises(UndecidedRegionError, match="more than 60 agents"):
            call(design(large, mu="1/10"))


def test_without_edges_nothing_but_the_gain_bound_applies() -> None:
    proof = prove_switched(design({"agents": 3, "edges": []}, mu="1/10"))
    assert verdicts(proof) == {
        "graph-assumption": "refuted",
        "gain-bound": "proved",
        "control-bounded": "inapplicable",
        "average-consensus": "inapplicable",
    }
    assert_accepted(proof.certificate())


def floats(graph: dict[str, Any]) -> np.ndarray:
    return np.array([[float(x) for x in row] for row in laplacian(design(graph, mu="1").graphs[0])])


def test_the_controller_closes_the_loop_whatever_the_order() -> None:
    """The Volterra plant and the paper's controller, term by term: x_{k+1} = P_k x_k, the rate holds, u_k vanishes."""
    proof = prove_switched(design(PAPER, RING, mu="13/20"))
    assert proof.rate is not None
    kappa, rho = float(proof.rate.kappa), float(proof.rate.rho)
    alpha, mu, m, samples = 0.9, 0.65, 1.3, 300
    source, matrices = random.Random(3), [floats(PAPER), floats(RING)]
    x = [np.array([4.5, 5.0, 6.0, 1.5, -1.0])]
    f = [j**alpha * ((1 + 1 / j) ** alpha - 2 + (1 - 1 / j) ** alpha) for j in range(1, samples + 1)]
    controls: list[np.ndarray] = []
    for k in range(samples):
        share = source.choice([0.0, 1.0, source.random()])
        el = share * matrices[0] + (1 - share) * matrices[1]
        remembered = sum((f[j] * controls[k - 1 - j] for j in range(k)), np.zeros(5))
        controls.append(-(mu / m) * el @ x[k] - remembered)
        x.append(x[k] + m * (controls[k] + remembered))
        assert np.allclose(x[k + 1], (np.eye(5) - mu * el) @ x[k], atol=1e-9)
        assert np.linalg.norm(x[k] - 3.2) <= kappa * rho**k * np.linalg.norm(x[0] - 3.2) + 1e-9
    sizes = [float(np.linalg.norm(u)) for u in controls]
    assert max(sizes[200:]) < 0.02 * max(sizes)


@pytest.mark.parametrize("seed", range(6))
def test_random_sets_against_products(seed: int) -> None:
    """A worst-case search of products of P_1, P_2 never exceeds a proved rate, and the region ends between both."""
    source = random.Random(seed)
    graphs = []
    for _ in range(2):
        order = source.sample(range(1, 5), 4)
        edges = {(order[i], order[(i + 1) % 4]): Fraction(source.randint(1, 4), 2) for i in range(4)}
        turn = source.sample(range(1, 5), 3)
        weight = Fraction(source.randint(1, 3), 3)
        for i in range(3):
            pair = (turn[i], turn[(i + 1) % 3])
            edges[pair] = edges.get(pair, Fraction(0)) + weight if pair in edges else weight
        graphs.append({"agents": 4, "edges": [[*pair, str(w)] for pair, w in edges.items()]})
    balanced = []
    for graph in graphs:
        el = floats(graph)
        if np.allclose(el.sum(axis=0), 0):
            balanced.append(graph)
    if len(balanced) < 2:
        balanced = [{"family": "directed-cycle", "agents": 4}, {"family": "path", "agents": 4}]
    strip = find_switched_region(design(*balanced)).strips[1]
    assert strip.inner is not None
    mu = strip.inner[1] * Fraction(9, 10)
    proof = prove_switched(design(*balanced, mu=str(mu)))
    assert proof.decisions["average-consensus"].verdict is Verdict.PROVED
    assert proof.rate is not None
    steps = [np.eye(4) - float(mu) * floats(graph) - 0.25 for graph in balanced]
    worst = [np.eye(4) - 0.25]
    for k in range(1, 9):
        worst = [p @ w for p in steps for w in worst]
        largest = max(np.linalg.norm(w, 2) for w in worst)
        assert largest <= float(proof.rate.kappa * proof.rate.rho**k) + 1e-9
    assert_accepted(proof.certificate())


def test_the_statements_are_the_checkers() -> None:
    assert dict(switching_document.STATEMENTS) == SWITCHED_STATEMENTS
    assert dict(switching_document.CONDITIONS) == SWITCHED_CONDITIONS
