"""Graphs to switch among at the ends of what is allowed: ties, intervals of mu, and denominators that differ.

Two agents, an edge of weight w each way: Pc(t) = 1 - 2 t w, a number; then every test is an inequality of fractions.
"""

import json
from collections.abc import Callable
from fractions import Fraction
from typing import Any

import pytest

from fomas_verify.checker import Malformed, Report, check, switching
from fomas_verify.checker.statements import SWITCHED_CONDITIONS, SWITCHED_STATEMENTS
from tests.checker.builder import PAPER_EDGES, Json, both_ways, checked, complete, directed_cycle, path
from tests.checker.switched import (
    NORM,
    RING,
    about,
    condition,
    in_turn,
    proved,
    region,
    region_by_dual,
    said,
    switched,
    undecided,
)
from tests.checker.test_form import place
from tests.checker.test_switching import ALONE, UNBALANCED


def edge(weight: str) -> list[list[Any]]:
    return both_ways([(1, 2)], weight)


def reasons(report: Report, status: str) -> list[str]:
    return [outcome.reason for outcome in report.outcomes if outcome.status == status]


def accepted(document: Json) -> bool:
    return {outcome.status for outcome in checked(document).outcomes} == {"accepted"}


def refused_for(document: Json, reason: str) -> bool:
    return any(reason in told for told in reasons(checked(document), "refused"))


def rate(weights: tuple[str, ...], mu: Any, **more: Any) -> Json:
    """kappa = 1, rho = 1/2, Q = W = 1 of two agents."""
    ends = list(mu) if isinstance(mu, list) else [mu, mu]
    value = {"kappa": "1", "rho": "1/2", "mu": ends, "Q": [["1"]], **more}
    return switched(about(*map(edge, weights), agents=2, mu=mu), said("graph-assumption", "proved"), rate=value)


def test_a_rate_at_a_tie() -> None:
    """Weights 1/3 and 1 at mu = 3/4: Pc = 1/2 and -1/2."""
    assert accepted(rate(("1/3", "1"), "3/4"))
    assert refused_for(rate(("1/3", "1"), "3/4", rho="499999999/1000000000"), "rho^2 Q - Pc_1(t)^T Q Pc_1(t) >= 0")
    assert refused_for(rate(("1/3", "11/10"), "3/4"), "rho^2 Q - Pc_2(t)^T Q Pc_2(t) >= 0")


@pytest.mark.parametrize("rho", ["0", "1", "2", "-1/2"])
def test_a_rate_that_is_none(rho: str) -> None:
    """Weight 1 at mu = 1/2: Pc = 0, of which every rho would be a rate."""
    assert refused_for(rate(("1",), "1/2", rho=rho), "0 < rho < 1")
    assert accepted(rate(("1",), "1/2", rho="1/1000000"))


@pytest.mark.parametrize(
    ("ends", "reason"),
    [
        (["1/4", "3/4"], None),
        (["1/5", "3/4"], "rho^2 Q"),
        (["251/1000", "3/4"], "mu[0] <= mu"),
        (["1/4", "749/1000"], "mu <= mu[1]"),
        (["3/4", "3/4"], "mu[0] <= mu"),
        (["1/4", "1/4"], "mu <= mu[1]"),
    ],
)
def test_a_rate_of_an_interval(ends: list[str], reason: str | None) -> None:
    """Weight 1: abs(1 - 2 mu) <= 1/2 from 1/4 to 3/4."""
    document = place(rate(("1",), ["1/4", "3/4"]), "values.rate.mu", ends)
    assert accepted(document) if reason is None else refused_for(document, reason)


@pytest.mark.parametrize(
    ("lower", "upper", "reason"),
    [
        ("1/10", "13/20", None),
        ("0", "1", None),
        ("11/100", "13/20", "lower <= mu"),
        ("13/20", "13/20", "lower <= mu"),
        ("1/10", "64/100", "mu <= upper"),
        ("1/10", "1/10", "mu <= upper"),
    ],
)
def test_bounds_of_an_interval(lower: str, upper: str, reason: str | None) -> None:
    document = place(proved(["1/10", "13/20"]), "values.mu", {"lower": lower, "upper": upper})
    assert accepted(document) if reason is None else refused_for(document, reason)


@pytest.mark.parametrize(
    ("lower", "upper", "true"),
    [("1", "3", True), ("2", "3", True), ("1", "2", True), ("3", "4", False), ("1", "199/100", False),
     ("201/100", "3", False), ("3", "1", False)],
)  # fmt: skip
def test_bounds_of_the_degree(lower: str, upper: str, true: bool) -> None:
    document = place(proved(), "values.degree_max", {"lower": lower, "upper": upper})
    assert accepted(document) if true else refused_for(document, "lower <= Delta_max <= upper")


def test_the_gain_bound_at_a_tie() -> None:
    """D = 2, mu = 1/2: not below 1/D; a hair less is."""
    for mu, verdict in (("1/2", "refuted"), ("49999999999/100000000000", "proved")):
        for tried in ("proved", "refuted"):
            document = switched(about(PAPER_EDGES, RING, mu=mu), said("gain-bound", tried))
            assert accepted(document) is (tried == verdict)
    interval = switched(about(PAPER_EDGES, RING, mu=["1/10", "1/2"]), said("gain-bound", "refuted"))
    assert accepted(interval)


def none(weights: tuple[str, ...], mu: str, *forms: str) -> Json:
    matrices = [[[z]] for z in forms]
    design = about(*map(edge, weights), agents=2, mu=mu)
    return switched(design, said("average-consensus", "undecided", mu=mu, Z=matrices))


@pytest.mark.parametrize("weights", [("1/3", "7/5"), ("7/5", "1/3"), ("2", "5/7"), ("1/6", "5/4")])
def test_no_form_at_a_tie(weights: tuple[str, str]) -> None:
    """sum z_i (p_i^2 - 1) = 0 of p_i = 1 - 2 mu w_i, of which the two signs differ: a tie shows it, a hair less not."""
    mu = Fraction(9, 10)
    less, more = (abs((1 - 2 * mu * Fraction(w)) ** 2 - 1) for w in weights)
    hair = Fraction(1, 10**12)
    grows = 1 if (1 - 2 * mu * Fraction(weights[1])) ** 2 > 1 else 0
    for by, true in ((Fraction(0), True), (hair, True), (-hair, False)):
        forms = [more, less]
        forms[grows] += by
        document = none(weights, "9/10", *map(str, forms))
        assert accepted(document) if true else refused_for(document, "- Z_i) >= 0")


def test_a_form_for_one_digraph_or_without_negative_entries_is_one() -> None:
    assert accepted(none(("1",), "1", "1"))
    assert accepted(none(("1", "1/2"), "1", "1", "0"))
    assert refused_for(none(("1", "1/2"), "1", "0", "1"), "- Z_i) >= 0")
    assert refused_for(none(("1", "1/2"), "1", "0", "0"), "not all Z are 0")
    assert refused_for(none(("1", "1/2"), "1", "2", "-1"), "Z_2 >= 0")


def exact_sum(edges: list[list[list[Any]]], t: Fraction, forms: list[list[list[str]]]) -> list[list[Fraction]]:
    """sum_i (Pc_i Z_i Pc_i^T - Z_i), Pc_i from I - t L added up edge by edge, less its last row."""
    n = len(forms[0])
    total = [[Fraction(0)] * n for _ in range(n)]
    for graph, rows in zip(edges, forms, strict=True):
        step = [[Fraction(int(i == j)) for j in range(n + 1)] for i in range(n + 1)]
        for source, target, weight in graph:
            step[target - 1][target - 1] -= t * Fraction(weight)
            step[target - 1][source - 1] += t * Fraction(weight)
        p = [[step[i][j] - step[n][j] for j in range(n)] for i in range(n)]
        z = [[Fraction(rows[max(i, j)][min(i, j)]) for j in range(n)] for i in range(n)]
        for i in range(n):
            for j in range(n):
                image = sum((p[i][k] * z[k][m] * p[j][m] for k in range(n) for m in range(n)), Fraction(0))
                total[i][j] += image - z[i][j]
    return total


def test_the_sum_is_the_one_of_the_page(monkeypatch: pytest.MonkeyPatch) -> None:
    """Weights of different denominators; the form whose sign is asked is a positive multiple of the sum."""
    asked: list[list[list[int]]] = []
    monkeypatch.setattr(switching, "least_sign", lambda rows: asked.append(rows) or 1)
    edges = [directed_cycle(3, "1/3"), complete(3, "2/5"), path(3)]
    forms = [[["3"], ["-1/2", "2"]], [["1/7"], ["2", "5"]], [["1"], ["0", "1/3"]]]
    design = about(*edges, agents=3, mu="5/6")
    document = switched(design, said("average-consensus", "undecided", mu="5/6", Z=forms))
    assert accepted(document)
    exact = exact_sum(edges, Fraction(5, 6), forms)
    factor = asked[-1][0][0] / exact[0][0]
    assert factor > 0
    assert asked[-1] == [[factor * x for x in row[: i + 1]] for i, row in enumerate(exact)]


def test_no_form_at_an_end_of_an_interval_of_mu() -> None:
    document = place(undecided(), "design.mu", ["13/20", "17/25"])
    assert accepted(document)
    assert refused_for(place(document, "design.mu", ["13/20", "67/100"]), "witness.mu <= mu")
    assert refused_for(place(undecided(), "claims.1.witness.mu", "0"), "0 < witness.mu")


def test_a_digraph_that_fails_alone_at_an_end_of_an_interval_of_mu() -> None:
    document = place(ALONE, "design.mu", ["1/10", "7/10"])
    assert accepted(document)
    assert refused_for(place(document, "design.mu", ["1/10", "69/100"]), "witness.mu <= mu")


@pytest.mark.parametrize("known", [SWITCHED_STATEMENTS, SWITCHED_CONDITIONS], ids=["claim", "condition"])
def test_a_statement_is_the_one_of_its_id(known: dict[str, str]) -> None:
    base = proved() if known is SWITCHED_STATEMENTS else region_by_dual()
    name = base["claims"][-1]["id"]
    for text in ("", known[name][:-1], known[name] + " ", known[name].upper()):
        assert refused_for(place(base, f"claims.{len(base['claims']) - 1}.statement", text), "to the letter")


STRIP, BOUND = "claims.1.witness.mu", "claims.0.witness.mu"


@pytest.mark.parametrize(
    ("changes", "reason"),
    [
        ({f"{BOUND}.outer.1": "1"}, None),
        ({f"{BOUND}.inner": ["1/4", "1/4"]}, None),
        ({f"{STRIP}.inner": ["13/20", "13/20"]}, None),
        ({f"{BOUND}.inner.1": "51/100", f"{BOUND}.outer.1": "51/100"}, "inner[1] < 1/Delta_max"),
        ({f"{BOUND}.outer.0": "-1"}, "0 = outer[0]"),
        ({f"{BOUND}.inner.0": "-1/100"}, "0 = outer[0] < inner[0]"),
        ({f"{STRIP}.inner.0": "-1/100"}, "0 = outer[0] < inner[0]"),
        ({f"{BOUND}.inner": ["49/100", "1/100"]}, "inner[0] <= inner[1]"),
        ({f"{STRIP}.inner.0": "66/100"}, "inner[0] <= inner[1]"),
    ],
)
def test_the_ends_of_a_strip(changes: dict[str, Any], reason: str | None) -> None:
    document = region_by_dual()
    for where, value in changes.items():
        document = place(document, where, value)
    assert accepted(document) if reason is None else refused_for(document, reason)


def test_some_mu_is_below_the_gain_bound_whatever_the_graphs() -> None:
    nothing = condition("gain-bound", "refuted")
    for graphs in ((RING, UNBALANCED), (RING, PAPER_EDGES)):
        assert refused_for(region(about(*graphs), nothing), "no mu satisfies the condition gain-bound")


@pytest.mark.parametrize(("graph", "true"), [(1, False), (2, True), (3, False)])
def test_the_digraph_that_fails_at_the_end_is_the_one_named(graph: int, true: bool) -> None:
    """Directed cycles of weights 1/2, 1 and 1/3 on three agents: at t = 1 the second only is a permutation."""
    norm = [["2"], ["-1", "2"]]
    graphs = [directed_cycle(3, weight) for weight in ("1/2", "1", "1/3")]
    end = {"inner": ["1/9", "999/1000"], "outer": ["0", "1"], "Q": norm, "graph": graph, "Y": norm}
    document = region(about(*graphs, agents=3), condition("common-form", "proved", mu=end))
    assert accepted(document) if true else refused_for(document, "Pc(t)^T Y Pc(t) - Y >= 0")


def malformed(document: Json) -> str:
    with pytest.raises(Malformed) as caught:
        check(json.dumps(document).encode())
    return str(caught.value)


LONG = "x" * 65


@pytest.mark.parametrize(
    ("base", "where", "value", "message"),
    [
        # what shows that it is refuted shows no other verdict
        (in_turn, "claims.1.verdict", "proved", "unknown key"),
        (in_turn, "claims.1.verdict", "inapplicable", "unknown key"),
        (in_turn, "claims.1.verdict", "undecided", "unknown key"),
        (lambda: ALONE, "claims.1.verdict", "proved", "unknown key"),
        (undecided, "claims.1.verdict", "proved", "unknown key"),
        (undecided, "claims.1.verdict", "refuted", 'an object with the key "graph"'),
        (proved, "claims.3.verdict", "refuted", 'an object with the key "graph"'),
        (region_by_dual, "claims.1.verdict", "refuted", "unknown key"),
        (region_by_dual, "claims.0.verdict", "refuted", "unknown key"),
        (proved, "claims.3.witness.solver", LONG, "at most 64 characters"),
        (undecided, "claims.1.witness.solver", LONG, "at most 64 characters"),
        (region_by_dual, f"{STRIP}.solver", LONG, "at most 64 characters"),
        (lambda: rate(("1",), "1/2"), "values.rate.solver", LONG, "at most 64 characters"),
        (proved, "design.agents", 1, "design.agents"),
    ],
)
def test_a_defect_of_form(base: Callable[[], Json], where: str, value: Any, message: str) -> None:
    assert message in malformed(place(base(), where, value))


def test_as_much_as_is_allowed() -> None:
    assert accepted(place(proved(), "claims.3.witness.solver", "x" * 64))
    most = switched(about(*[RING] * 64, mu="1/2"), said("average-consensus", "proved", mu="1/2", Q=NORM))
    assert accepted(most)
    letters = place(in_turn(), "claims.0.witness.word", [1, 1, 2] * 21 + [1])
    assert checked(place(letters, "claims.0.witness.power", 2)).outcomes[1].status == "accepted"
