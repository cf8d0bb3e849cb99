"""A design decided from bounds: what the exact path says of the same design, and what the checker says of it."""

from __future__ import annotations

import json
import random
from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from fomas_verify.checker import check
from fomas_verify.checker.report import Report
from fomas_verify.claims.verdict import Verdict
from fomas_verify.design import CLAIM_IDS, Design, DesignError, LargeDesign, design_from_mapping
from fomas_verify.design.reading import named_from_mapping
from fomas_verify.enclosure.reference import DisagreementError
from fomas_verify.exact.errors import FomasError, MissingExtraError
from fomas_verify.gate.answer import held
from fomas_verify.network.large import LargeGraph, TooManyEdgesError, large_family
from fomas_verify.network.sparse import SparseDigraph
from fomas_verify.network.sparse_facts import sparse_degree_max
from fomas_verify.numeric import Redo
from fomas_verify.prover import LargeProof, large, prove, prove_large
from fomas_verify.spectrum.large import LargeBounds
from tests.prover.random_networks import ALPHAS, SHARES, balanced, random_design

CONSENSUS = {"perron-eigenvalues", "control-bounded", "average-consensus"}
REDO = Redo(1 << 30)
FAMILIES = [
    *[
        (name, {"agents": n})
        for name in ("cycle", "path", "star", "complete", "directed-cycle")
        for n in (2, 3, 4, 7, 12)
    ],
    *[("hypercube", {"agents": n}) for n in (2, 4, 8)],
    *[("torus", {"shape": shape}) for shape in ((3, 3), (3, 4), (5, 4))],
    *[("grid", {"shape": shape}) for shape in ((1, 2), (1, 5), (2, 2), (4, 3))],
]


def checked(proof: LargeProof, numeric: Redo | None = REDO) -> Report:
    return check(proof.certificate("c.json").encode(), opener=held(proof.edge_list or b""), numeric=numeric)


def named(**keys: Any) -> LargeDesign:
    found = named_from_mapping({"name": "x", "alpha": "9/10", "mu": "1/10", **keys})
    assert isinstance(found, LargeDesign)
    return found


def listed(agents: int, edges: list[list[Any]], **keys: Any) -> LargeDesign:
    graph = {"agents": agents, "edges": edges}
    return LargeDesign.of(design_from_mapping({"name": "x", "alpha": "9/10", "mu": "1/10", **keys, "graph": graph}))


def assert_the_same(design: Design, proof: LargeProof) -> set[str]:
    """The verdicts are those of the exact path, or undecided; the enclosures meet. The ids of the undecided claims."""
    exact = prove(design, only=CLAIM_IDS)
    assert proof.decisions.keys() == exact.decisions.keys()
    unknown = {name for name, found in proof.decisions.items() if found.verdict is Verdict.UNDECIDED}
    for name in proof.decisions.keys() - unknown:
        assert proof.decisions[name].verdict is exact.decisions[name].verdict, name
    assert proof.values.keys() == exact.values.keys()
    for name, value in proof.values.items():
        assert value.overlaps(exact.values[name]), name
    return unknown


def undecided_of_random_graphs(seeds: range, most_agents: int) -> list[set[str]]:
    found = []
    for seed in seeds:
        design = design_from_mapping(random_design(seed, random.Random(seed).randint(2, most_agents)))
        proof = prove_large(LargeDesign.of(design))
        found.append(assert_the_same(design, proof))
        assert [x for x in checked(proof).outcomes if x.status != "accepted"] == []
    return found


def test_the_exact_path_says_the_same_of_random_graphs() -> None:
    assert set().union(*undecided_of_random_graphs(range(24), 12)) == set()


@pytest.mark.slow
def test_the_exact_path_says_the_same_of_two_hundred_random_graphs() -> None:
    found = undecided_of_random_graphs(range(100, 296), 28) + undecided_of_random_graphs(range(296, 300), 70)
    assert sum(map(len, found)) <= 2


def test_bounds_alone_leave_little_open(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(large, "decided_by_matrices", lambda _, found: found)
    found = undecided_of_random_graphs(range(48), 12)
    assert set().union(*found) == {*CONSENSUS, "trajectory-norm-bound"}
    assert found.count(set()) >= 24


@pytest.mark.slow
@pytest.mark.parametrize("agents", [150])
def test_what_bounds_leave_open_matrices_decide_up_to_two_hundred_agents(agents: int) -> None:
    """A digraph whose least eigenvalue of P lies outside the circle, by numpy, and one with all of them inside."""
    weights = balanced(random.Random(5), agents)
    edges = [[i, j, str(w)] for (i, j), w in sorted(weights.items())]
    dense = np.zeros((agents, agents))
    for (source, target), weight in weights.items():
        dense[target - 1, source - 1] = float(weight)
    laplacian = np.diag(dense.sum(axis=1)) - dense
    values = np.linalg.eigvals(laplacian)
    critical = min(2 * x.real / abs(x) ** 2 for x in values if abs(x) > 1e-9)
    for share, verdict in ((0.99, Verdict.PROVED), (1.01, Verdict.REFUTED)):
        mu = Fraction(critical * share).limit_denominator(10**6)
        assert mu * dense.sum(axis=1).max() > 1
        proof = prove_large(listed(agents, edges, mu=str(mu)))
        assert {proof.decisions[name].verdict for name in CONSENSUS} == {verdict}
        assert checked(proof, None).verdicts["average-consensus"] == verdict.value


def test_of_a_gain_beyond_doubles_all_is_said_but_by_a_factor() -> None:
    edges = [[i, i % 201 + 1, 2] for i in range(1, 202)] + [[1, 101], [101, 1]]
    decisions = prove_large(listed(201, edges, mu="1e400")).decisions
    assert decisions["gain-bound"].verdict is Verdict.REFUTED
    assert decisions["control-norm-bound"].verdict is Verdict.REFUTED
    assert decisions["average-consensus"].verdict is Verdict.UNDECIDED


def test_beyond_two_hundred_agents_bounds_alone_decide() -> None:
    edges = [[i, i % 201 + 1] for i in range(1, 202)] + [[1, 101, 1], [101, 1, 1]]
    decisions = prove_large(listed(201, edges, mu="1/2")).decisions
    assert {name for name, found in decisions.items() if found.verdict is Verdict.UNDECIDED} >= CONSENSUS


@pytest.mark.slow
@pytest.mark.parametrize("name", ["cycle", "directed-cycle", "complete"])
def test_up_to_the_size_where_matrices_end_they_say_the_same(name: str) -> None:
    graph = {"family": name, "agents": 100}
    for mu in (Fraction(1, 3), Fraction(9, 10)):
        design = design_from_mapping({"name": "x", "alpha": "9/10", "mu": str(mu), "graph": graph})
        assert_the_same(design, prove_large(LargeDesign.of(design)))


def test_beyond_100_agents_no_matrix_is_formed() -> None:
    keys = {"name": "x", "alpha": "9/10", "mu": "1/10"}
    assert isinstance(named_from_mapping({**keys, "graph": {"family": "cycle", "agents": 100}}), Design)
    assert isinstance(named_from_mapping({**keys, "graph": {"family": "cycle", "agents": 101}}), LargeDesign)


@pytest.mark.parametrize(("name", "size"), FAMILIES, ids=lambda x: str(x) if isinstance(x, str) else str([*x.values()]))
def test_a_family_by_its_eigenvalues_is_what_its_matrices_say(name: str, size: dict[str, Any]) -> None:
    for i, share in enumerate(SHARES):
        graph = large_family(name, **size)
        mu = share / graph.family.degree_max
        keys = {"name": "x", "alpha": ALPHAS[i % len(ALPHAS)], "mu": str(mu), "x0": [1, *[0] * (graph.agents - 1)]}
        design = design_from_mapping(keys | {"graph": {"family": name, **size}})
        proof = prove_large(replace(LargeDesign.of(design), graph=graph))
        assert_the_same(design, proof)
        assert proof.edge_list is None
        assert [x for x in checked(proof, None).outcomes if x.status == "refused"] == []
        # The same graph given by its edges is known for what it is, of two agents under the first of its names.
        again = prove_large(LargeDesign.of(design))
        assert (again.edge_list, again.values) == (None, proof.values) or graph.agents < 6
        assert_the_same(design, again)


@pytest.mark.parametrize("agents", [10**6, 2**40, 2**64])
@pytest.mark.parametrize("name", ["cycle", "path", "star", "complete", "directed-cycle", "hypercube"])
def test_a_family_of_any_size_is_decided_without_its_edges(name: str, agents: int) -> None:
    agents = 1 << agents.bit_length() - 1 if name == "hypercube" else agents
    proof = prove_large(named(graph={"family": name, "agents": agents}, mu="1/1000000000000000000000"))
    report = checked(proof, None)
    assert report.exit_status == 0
    assert report.verdicts["average-consensus"] == "proved"
    assert all(value.width * 10**30 <= max(1, abs(value.lower)) for value in proof.values.values())


def test_where_no_bound_is_known_nothing_is_wrong(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(large, "large_bounds", lambda *_, **__: LargeBounds((), None, None, None, "none today"))
    for seed in range(40):
        design = design_from_mapping(random_design(seed, 7))
        exact, proof = prove(design, only=CLAIM_IDS), prove_large(LargeDesign.of(design))
        for name, found in proof.decisions.items():
            assert found.verdict in (Verdict.UNDECIDED, exact.decisions[name].verdict)
        assert checked(proof, None).exit_status == 0
        assert proof.notes in (("none today",), ())


FALSE: dict[str, Callable[[LargeBounds, Fraction], Fraction | None]] = {
    "lambda2_lower": lambda found, _: found.lambda2_lower and found.lambda2_lower * Fraction(101, 100),
    "lambda_max_upper": lambda _, degree: degree,
    "sigma_upper": lambda found, _: found.sigma_upper and found.sigma_upper * Fraction(99, 100),
}


@pytest.mark.parametrize("name", FALSE)
def test_a_bound_that_is_false_is_never_accepted(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    honest, told = large.large_bounds, []

    def lying(graph: SparseDigraph, mu: tuple[Fraction, Fraction], *, memory: int) -> LargeBounds:
        found = honest(graph, mu, memory=memory)
        told.append(FALSE[name](found, sparse_degree_max(graph)))
        return replace(found, vectors=(), **{name: told[-1]})

    monkeypatch.setattr(large, "large_bounds", lying)
    refused = []
    for seed in (0, 1, 2, 3, 6, 8):
        proof = prove_large(LargeDesign.of(design_from_mapping(random_design(seed, 9))))
        if told[-1] is not None:
            refused.append(checked(proof).exit_status)
    assert 1 in refused
    assert 0 not in refused


ALTERED: dict[str, Callable[[dict[str, Any]], object]] = {
    "verdict": lambda d: d["claims"][1].update(verdict="refuted"),
    "lambda2": lambda d: d["values"]["lambda2"].update(upper="1/1000"),
    "vector": lambda d: d["spectrum"]["vectors"][0].__setitem__(0, d["spectrum"]["vectors"][0][0] + 1),
    "bound": lambda d: d["spectrum"].update(lambda2_lower="100"),
    "mu": lambda d: d["design"].update(mu="10"),
    "sigma": lambda d: d["values"]["sigma"].update(upper="1/10"),
}


@pytest.fixture(scope="module")
def ring() -> LargeProof:
    """Of a weighted graph that is no family's."""
    edges = [
        [i, j, w]
        for i, w in zip(range(1, 10), (3, 1, 4, 1, 5, 9, 2, 6, 5), strict=True)
        for i, j in ((i, i + 1), (i + 1, i))
    ]
    return prove_large(listed(10, edges, mu="1/20"))


@pytest.mark.parametrize("name", ALTERED)
def test_an_altered_certificate_is_refused(name: str, ring: LargeProof) -> None:
    document = json.loads(ring.certificate("c.json"))
    assert check(json.dumps(document).encode(), opener=held(ring.edge_list), numeric=REDO).exit_status == 0
    ALTERED[name](document)
    assert check(json.dumps(document).encode(), opener=held(ring.edge_list), numeric=REDO).exit_status == 1


def test_without_a_factor_the_checker_leaves_open_what_takes_one(ring: LargeProof) -> None:
    report = checked(ring, None)
    assert report.exit_status == 3
    assert {x.id for x in report.outcomes if x.status == "undecided"} >= {"spectrum.lambda2_lower", "lambda2", "beta"}
    assert report.verdicts["average-consensus"] == "proved"


@pytest.mark.parametrize(
    ("edges", "witness"),
    [
        ([[1, 2], [2, 3], [3, 1], [1, 3]], {"imbalance": {"agent": 1, "in": 1, "out": 2}}),
        ([[1, 2], [2, 1]], {"unreachable": [1, 3]}),
        ([], {"unreachable": [1, 2]}),
    ],
)
def test_a_graph_that_fails_assumption_1_says_why(edges: list[list[int]], witness: dict[str, Any]) -> None:
    proof = prove_large(listed(3, edges))
    assert proof.decisions["graph-assumption"].witness == witness
    assert proof.decisions["average-consensus"].verdict is Verdict.INAPPLICABLE
    assert proof.values.keys() == {"mu", "threshold", "degree_max"}
    assert checked(proof).exit_status == 0


@pytest.mark.parametrize("share", ["1", "2", "4/3"])
def test_a_tie_with_the_gain_bound_is_decided_exactly(share: str) -> None:
    """A torus 3 x 70: D = 4, lambda_max = 3 + 4; at mu = 2/7 an eigenvalue of P is -1."""
    mu = {"1": "1/4", "2": "2/7", "4/3": "1/3"}[share]
    proof = prove_large(named(graph={"family": "torus", "shape": [3, 70]}, mu=mu))
    assert proof.decisions["gain-bound"].verdict is Verdict.REFUTED
    stable = proof.decisions["average-consensus"].verdict
    assert stable is (Verdict.PROVED if share == "1" else Verdict.REFUTED)


def test_a_horizon_agrees_with_the_closed_form() -> None:
    holds = prove_large(named(graph={"family": "complete", "agents": 300}, mu="1/300"), horizon=50)
    assert (holds.horizon.last, holds.horizon.first_failure) == (50, None)
    fails = prove_large(named(graph={"family": "cycle", "agents": 300}), horizon=50)
    assert fails.horizon.first_failure == 0
    late = prove_large(named(graph={"family": "complete", "agents": 300}, mu="2/300", alpha="1/2"), horizon=5)
    assert (late.horizon.first_failure, late.decisions["memory-inequality"].verdict) == (1, Verdict.REFUTED)


def test_a_second_opinion_that_differs_ends_the_run(monkeypatch: pytest.MonkeyPatch) -> None:
    proving = import_module("fomas_verify.prover.prove")
    monkeypatch.setattr(proving, "approx_gain_and_threshold", lambda *_: {"threshold": Fraction(1, 2)})
    with pytest.raises(DisagreementError):
        prove_large(named(graph={"family": "cycle", "agents": 300}))


def test_an_initial_state_is_followed_one_sample() -> None:
    """On a directed ring of 201 agents, alpha close to 1, of eqL3 nothing is known; where L x_0 grows it is refuted."""
    ring = {"family": "directed-cycle", "agents": 201}
    for x0, verdict in (([1] * 201, "proved"), ([1, *[0] * 200], "undecided"), ([-1] * 100 + [1] * 101, "undecided")):
        proof = prove_large(named(graph=ring, alpha="0.99985", mu="1/2", x0=x0))
        assert proof.decisions["trajectory-norm-bound"].verdict.value == verdict
        assert checked(proof, None).exit_status == 0
    grows = prove_large(named(graph=ring, mu="1/1000", x0=[-1] * 100 + [1] * 101))
    assert grows.decisions["trajectory-norm-bound"].verdict is Verdict.REFUTED
    assert checked(grows, None).exit_status == 0


def test_more_edges_than_are_built_are_refused_and_leave_a_family_decided() -> None:
    vast = LargeGraph(listed=SparseDigraph(300, np.zeros(2**24 + 1, np.int64), np.ones(1), np.ones(1), 1))
    with pytest.raises(TooManyEdgesError, match="at most 16777216 edges") as caught:
        prove_large(replace(named(graph={"family": "cycle", "agents": 300}), graph=vast))
    assert caught.value.exit_status == 3
    with pytest.raises(TooManyEdgesError, match="at most 4194304 edges"):
        _ = large_family("complete", agents=2049).sparse
    full = prove_large(named(graph={"family": "complete", "agents": 5000}, mu="1/10000", x0=[1] * 4999 + [0]))
    assert full.decisions["trajectory-norm-bound"].verdict is Verdict.PROVED


@pytest.mark.parametrize("missing", ["numpy", "scipy", "qdldl"])
def test_a_missing_extra_is_named_and_families_need_none(missing: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None if name == missing else object())
    with pytest.raises(MissingExtraError, match=rf"needs {missing}, which the extra `scale` brings"):
        prove_large(listed(4, [[1, 2], [2, 3], [3, 4], [4, 1], [1, 3], [3, 1]]))
    assert prove_large(named(graph={"family": "cycle", "agents": 300})).exit_status == 1


def test_a_missing_gain_is_named() -> None:
    design = named_from_mapping({"alpha": "9/10", "gamma": 1, "graph": {"family": "cycle", "agents": 300}})
    with pytest.raises(DesignError, match="h: prove needs mu, or gamma and h"):
        prove_large(design)


@pytest.mark.parametrize(
    ("file", "stem"),
    [("c.json", "c"), ("a.b.json", "a.b"), ("plain", "plain")],
)
def test_the_edge_list_lies_beside_the_certificate(file: str, stem: str, ring: LargeProof, tmp_path: Path) -> None:
    edges = f"{stem}-{ring.design.graph.digest[:16]}.edges"
    files = ring.files(tmp_path / file)
    assert [*files] == [tmp_path / edges, tmp_path / file]
    assert json.loads(files[tmp_path / file])["design"]["graph"]["file"] == edges


@pytest.mark.parametrize("file", [".json", "a:b.json", "x" * 130 + ".json"])
def test_a_name_that_no_edge_list_can_have_is_replaced(file: str, ring: LargeProof, tmp_path: Path) -> None:
    edges = next(iter(ring.files(tmp_path / file)))
    assert edges.name == f"network-{ring.design.graph.digest[:16]}.edges"


def test_errors_are_the_projects_own() -> None:
    assert issubclass(TooManyEdgesError, FomasError)
