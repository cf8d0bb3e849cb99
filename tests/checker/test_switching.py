"""Graphs to switch among: what is true is accepted, and each certificate refused once it is changed until false."""

import json
from collections.abc import Callable
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

from fomas_verify.checker import Malformed, check, switching
from fomas_verify.checker.statements import SWITCHED_STATEMENTS
from tests.checker.builder import PAPER_EDGES, Json, checked, directed_cycle
from tests.checker.switched import (
    DUAL,
    FORM,
    NORM,
    ONE,
    OTHER,
    RING,
    about,
    full,
    in_turn,
    proved,
    region,
    region_by_dual,
    region_by_graph,
    said,
    slow,
    step,
    switched,
    undecided,
)
from tests.checker.test_form import DELETED, place

UNBALANCED = [[1, 2, "1"], [2, 3, "1"], [3, 4, "1"], [4, 5, "1"], [5, 1, "1"], [1, 3, "1"]]
BROKEN = switched(
    about(RING, UNBALANCED, mu="1/10"),
    said("graph-assumption", "refuted", graph=2, imbalance={"agent": 1, "in": "1", "out": "2"}),
    said("gain-bound", "proved"),
    said("control-bounded", "inapplicable"),
    said("average-consensus", "inapplicable"),
)
ALONE = switched(
    about(RING, PAPER_EDGES, mu="7/10"),
    said("control-bounded", "refuted", graph=2, mu="7/10", power=200),
    said("average-consensus", "refuted", graph=2, mu="7/10", power=200),
)
SINGLE = switched(about(RING, mu="1/2"), said("average-consensus", "proved", mu="1/2", Q=NORM))
INTERVAL = proved(["1/10", "13/20"])
EMPTY = region(about(RING, UNBALANCED), {**region_by_dual()["claims"][1], "verdict": "refuted", "witness": {}})
NO_EDGE = switched(about([], mu="1"), said("gain-bound", "proved"), said("average-consensus", "inapplicable"))
TRUE: dict[str, Json] = {
    "proved": proved(),
    "interval": INTERVAL,
    "slow": slow(),
    "undecided": undecided(),
    "broken": BROKEN,
    "alone": ALONE,
    "single": SINGLE,
    "in turn": in_turn(),
    "no edge": NO_EDGE,
    "region by dual": region_by_dual(),
    "region by graph": region_by_graph(),
    "empty": EMPTY,
}


def statuses(document: Json) -> set[str]:
    return {outcome.status for outcome in checked(document).outcomes}


@pytest.mark.parametrize("name", TRUE)
def test_what_is_true_is_accepted(name: str) -> None:
    assert statuses(TRUE[name]) == {"accepted"}
    assert checked(TRUE[name]).exit_status == 0


def test_the_forms_against_numpy() -> None:
    q = full(FORM)
    assert np.linalg.eigvalsh(q)[0] > 0
    for edges in (PAPER_EDGES, RING):
        p = step(edges, 5, 0.65)
        assert np.linalg.eigvalsh(q - p.T @ q @ p)[0] > 0
    total = np.zeros((4, 4))
    for edges, rows in zip((PAPER_EDGES, RING), DUAL, strict=True):
        p, z = step(edges, 5, 0.68), full(rows)
        assert np.linalg.eigvalsh(z)[0] > 0
        total += p @ z @ p.T - z
    assert np.linalg.eigvalsh(total)[0] > 0


def test_the_graphs_in_turn_against_numpy() -> None:
    one, other = (step(edges, 5, 0.1514) for edges in (ONE, OTHER))
    assert max(abs(np.linalg.eigvals(one))) < 1 > max(abs(np.linalg.eigvals(other)))
    assert max(abs(np.linalg.eigvals(other @ one @ one))) > 1.04
    assert abs(np.trace(np.linalg.matrix_power(other @ one @ one, 35))) > 4.5


def test_in_turn_at_a_number_of_the_interval() -> None:
    document = place(in_turn(), "design.mu", ["1/10", "1/5"])
    assert statuses(document) == {"accepted"}


def test_a_required_claim_counts_where_it_is_proved() -> None:
    report = checked(proved())
    assert report.design.require == ("graph-assumption", "average-consensus")
    assert report.shortfalls(report.design.require) == ()
    assert [x.id for x in checked(undecided()).shortfalls(["average-consensus", "gain-bound"])] == [
        "average-consensus",
        "gain-bound",
    ]
    assert checked(region_by_dual()).verdicts == {}


def test_a_dual_of_any_size_and_a_form_of_any_size_is_as_good() -> None:
    def larger(text: str) -> str:
        return str(Fraction(text) * Fraction(7, 3))

    document = region_by_dual()
    strip = document["claims"][1]["witness"]["mu"]
    strip["Q"] = [[larger(x) for x in row] for row in strip["Q"]]
    strip["Z"] = [[[larger(x) for x in row] for row in rows] for rows in strip["Z"]]
    assert statuses(document) == {"accepted"}


CLAIM, STRIP, RATE = "claims.3.witness", "claims.1.witness.mu", "values.rate"
FALSE: list[tuple[Callable[[], Json], dict[str, Any], str]] = [
    # the form perturbed, and what it is about
    (proved, {f"{CLAIM}.Q.1.1": "900"}, "not true: Q - Pc(t)^T Q Pc(t) > 0"),
    (proved, {f"{CLAIM}.Q.0.0": "-848"}, "not true: Q > 0"),
    (proved, {f"{CLAIM}.Q": NORM}, "not true: Q - Pc(t)^T Q Pc(t) > 0"),
    (proved, {f"{CLAIM}.mu": "649999/1000000"}, "not true: mu <= witness.mu"),
    (proved, {f"{CLAIM}.mu": "67/100"}, "not true: Q - Pc(t)^T Q Pc(t) > 0"),
    (proved, {"design.mu": "650001/1000000"}, "not true: mu <= witness.mu"),
    (proved, {"design.mu": ["1/2", "650001/1000000"]}, "not true: mu <= witness.mu"),
    (proved, {"design.graphs.1.0.2": "2"}, "not true: every digraph is strongly connected and balanced"),
    (proved, {f"{CLAIM}.solver": "x", "claims.3.statement": "x"}, "the statement is the one of this claim"),
    (proved, {"claims.0.verdict": "inapplicable"}, "Assumption 1 fails, and the claim presupposes it"),
    (proved, {"claims.1.verdict": "proved"}, "not true: mu < 1/Delta_max"),
    (slow, {"claims.0.verdict": "refuted"}, "not true: mu >= 1/Delta_max"),
    (proved, {"values.mu.lower": "650001/1000000"}, "not true: lower <= mu"),
    (proved, {"values.mu.upper": "649999/1000000"}, "not true: mu <= upper"),
    (proved, {"values.degree_max.upper": "1"}, "lower <= Delta_max <= upper"),
    # a rate
    (slow, {f"{RATE}.rho": "9/10"}, "not true: rho^2 Q - Pc_2(t)^T Q Pc_2(t) >= 0"),
    (slow, {f"{RATE}.rho": "1"}, "0 < rho < 1"),
    (slow, {f"{RATE}.rho": "-23/25"}, "0 < rho < 1"),
    (slow, {f"{RATE}.kappa": "99/100"}, "kappa >= 1"),
    (slow, {f"{RATE}.mu.0": "13475/100000"}, "not true: mu[0] <= mu"),
    (slow, {f"{RATE}.mu.1": "13474/100000"}, "not true: mu <= mu[1]"),
    (slow, {f"{RATE}.Q.0.0": "399/100"}, "not true: Q - W >= 0"),
    (slow, {f"{RATE}.Q.0.0": "401/100"}, "not true: kappa^2 W - Q >= 0"),
    (lambda: place(BROKEN, "values.rate", slow()["values"]["rate"]), {}, "the value exists (Assumption 1 fails)"),
    # no form
    (undecided, {"claims.1.witness.mu": "680001/1000000"}, "not true: witness.mu <= mu"),
    (undecided, {"claims.1.witness.mu": "13/20"}, "Pc_i(t) Z_i Pc_i(t)^T - Z_i) >= 0"),
    (undecided, {"claims.1.witness.mu": "-17/25"}, "0 < witness.mu"),
    (undecided, {"claims.1.witness.Z.0": [["0"], ["0", "0"], ["0", "0", "0"], ["0", "0", "0", "0"]]}, "- Z_i) >= 0"),
    (undecided, {"claims.1.witness.Z.1.0.0": "-224"}, "not true: Z_2 >= 0"),
    # a graph that fails alone
    (lambda: ALONE, {"claims.0.witness.graph": 1}, "abs trace(Pc(witness.mu)^power) > N - 1"),
    (lambda: ALONE, {"claims.0.witness.mu": "71/100"}, "not true: witness.mu <= mu"),
    (lambda: ALONE, {"claims.0.witness.power": 1}, "abs trace(Pc(witness.mu)^power) > N - 1"),
    (lambda: BROKEN, {"claims.0.witness.graph": 1}, '"out" is the sum'),
    (lambda: BROKEN, {"claims.3": said("average-consensus", "undecided", bits=1)}, "the claim is applicable"),
    # graphs in turn
    (in_turn, {"claims.0.witness.word": [1, 2]}, "^power) > N - 1"),
    (in_turn, {"claims.0.witness.word": [1]}, "^power) > N - 1"),
    (in_turn, {"claims.0.witness.power": 3}, "^power) > N - 1"),
    (in_turn, {"claims.0.witness.mu": "758/5000"}, "witness.mu is the mu of the design"),
    (in_turn, {"design.mu": ["1/10", "3/20"]}, "witness.mu is the mu of the design"),
    (in_turn, {"design.mu": DELETED, "design.gamma": "1", "design.h": "1"}, "witness.mu is the mu of the design"),
    # a region
    (region_by_dual, {f"{STRIP}.inner.1": "650001/1000000", f"{STRIP}.outer.1": "65/100"}, "inner[1] <= outer[1]"),
    (region_by_dual, {f"{STRIP}.inner.1": "33/50"}, "not true: Q - Pc(t)^T Q Pc(t) > 0"),
    (region_by_dual, {f"{STRIP}.outer.1": "66/100"}, "Pc_i(t) Z_i Pc_i(t)^T - Z_i) >= 0"),
    (region_by_dual, {f"{STRIP}.outer.0": "1/1000"}, "0 = outer[0]"),
    (region_by_dual, {f"{STRIP}.inner.0": "0"}, "0 = outer[0] < inner[0]"),
    (region_by_dual, {f"{STRIP}.Z.0.0.0": "592"}, "Z_1 >= 0"),
    (region_by_dual, {f"{STRIP}.Z.0": DUAL[1]}, "- Z_i) >= 0"),
    (region_by_dual, {"claims.1.statement": "x"}, "the statement is the one of this id"),
    (region_by_dual, {"claims.0.witness.mu.inner.1": "1/2"}, "inner[1] < 1/Delta_max"),
    (region_by_dual, {"claims.0.witness.mu.outer.1": "4999/10000"}, "1/Delta_max <= outer[1]"),
    (region_by_dual, {"claims.0.verdict": "refuted", "claims.0.witness": {}}, "no mu satisfies the condition gain"),
    (region_by_dual, {"claims.1.verdict": "refuted", "claims.1.witness": {}}, "no mu satisfies the condition common"),
    (region_by_dual, {"design.graphs.1": UNBALANCED}, "some mu satisfies the condition (Assumption 1 fails)"),
    (region_by_graph, {"claims.0.witness.mu.inner.1": "1"}, "not true: Q - Pc(t)^T Q Pc(t) > 0"),
    (region_by_graph, {"claims.0.witness.mu.outer.1": "999999/1000000"}, "Pc(t)^T Y Pc(t) - Y >= 0"),
]  # fmt: skip


@pytest.mark.parametrize("number", range(len(FALSE)))
def test_what_is_false_is_refused(number: int) -> None:
    base, changes, reason = FALSE[number]
    document = base()
    for where, value in changes.items():
        document = place(document, where, value)
    report = checked(document)
    refused = [outcome.reason for outcome in report.outcomes if outcome.status == "refused"]
    assert any(reason in told for told in refused), refused
    assert report.exit_status == 1


def test_a_dual_of_zeros_shows_nothing() -> None:
    zeros = [[["0"] * (i + 1) for i in range(4)]] * 2
    document = place(undecided(), "claims.1.witness.Z", zeros)
    assert "not all Z are 0" in checked(document).outcomes[1].reason


BAD_FORM: list[tuple[Callable[[], Json], str, Any, str]] = [
    (proved, "design.graphs", [], "expected 1 to 64 digraphs"),
    (proved, "design.graphs", [RING] * 65, "expected 1 to 64 digraphs"),
    (proved, "design.graphs.1", "ring", "expected an array of edges"),
    (proved, "design.graphs.1.0.0", 6, "expected an integer from 1 to 5"),
    (proved, "design.edges", [], "unknown key"),
    (proved, "design.x0", ["1"] * 5, "unknown key"),
    (proved, "design.gamma", "1", 'at most one of "gamma" and "mu"'),
    (slow, "design.h", DELETED, 'expected "mu", or "gamma" and "h"'),
    (slow, "design.gamma", ["1", "2"], "expected a rational"),
    (proved, "design.mu", ["2", "1"], "the lower end of the interval below the upper"),
    (proved, "design.require", [], "expected at least one claim id"),
    (proved, "design.require.1", "graph-assumption", "occurs twice"),
    (proved, "design.require.0", "memory-inequality", "expected one of graph-assumption"),
    (proved, "claims", [], "expected at least one claim"),
    (proved, "claims.1.id", "perron-eigenvalues", "expected one of graph-assumption"),
    (proved, "claims.1.id", "graph-assumption", "occurs twice"),
    (proved, "claims.1.verdict", "true", "expected one of proved"),
    (proved, "claims.1.witness", {"mu": "1"}, "unknown key"),
    (proved, "claims.2.witness.solver", "x" * 65, "at most 64 characters"),
    (proved, "claims.2.witness.solver", 1, "expected a string"),
    (proved, "claims.2.witness.Q.3", ["1"], "expected an array of 4 rationals"),
    (proved, "claims.2.witness.Z", DUAL, "unknown key"),
    (proved, "values.sigma", {"lower": "0", "upper": "1"}, "unknown key"),
    (undecided, "claims.1.witness.Z", DUAL[:1], "expected an array of 2 matrices"),
    (undecided, "claims.0.witness.bits", 0, "expected an integer of at least 1"),
    (lambda: ALONE, "claims.0.witness.graph", 3, "expected an integer from 1 to 2"),
    (lambda: ALONE, "claims.0.witness.graph", DELETED, 'expected an object with the key "graph"'),
    (lambda: ALONE, "claims.0.witness", [], 'expected an object with the key "graph"'),
    (in_turn, "claims.0.witness.word", [], "expected 1 to 64 digraphs"),
    (in_turn, "claims.0.witness.word", [1] * 65, "expected 1 to 64 digraphs"),
    (in_turn, "claims.0.witness.word.1", 3, "expected an integer from 1 to 2"),
    (in_turn, "claims.0.witness.power", 0, "expected an integer from 1"),
    (in_turn, "claims.0.witness.graph", 1, "unknown key"),
    (region_by_dual, "design.mu", ["1", "2"], "expected a rational"),
    (region_by_dual, "values.mu", {"lower": "0", "upper": "1"}, "unknown key"),
    (region_by_dual, "claims.1.verdict", "undecided", "expected one of proved, refuted"),
    (region_by_dual, "claims.1.witness.mu.Z", DELETED, 'missing key "Z"'),
    (region_by_dual, "claims.1.witness.mu.power", 3, "unknown key"),
    (region_by_dual, "claims.1.witness.mu.outer", ["0"], "expected an array of two"),
    (region_by_graph, "claims.0.witness.mu.Z", DUAL, "unknown key"),
    (region_by_graph, "claims.0.witness.mu.outer.1", "x", "expected a rational"),
    (region_by_graph, "claims.0.witness.mu.outer.1", None, "expected a rational"),
]


@pytest.mark.parametrize("number", range(len(BAD_FORM)))
def test_a_defect_of_form_is_told(number: int) -> None:
    base, where, value, message = BAD_FORM[number]
    with pytest.raises(Malformed) as caught:
        check(json.dumps(place(base(), where, value)).encode())
    assert message in str(caught.value)


@pytest.mark.parametrize("document", [proved(), undecided()], ids=["proved", "undecided"])
def test_work_is_bounded(monkeypatch: pytest.MonkeyPatch, document: Json) -> None:
    monkeypatch.setattr(switching, "MAX_PRODUCT_WORK", 1)
    document = place(document, "values.rate", {"kappa": "99", "rho": "999/1000", "mu": ["13/20", "17/25"], "Q": FORM})
    assert "undecided" in statuses(document)
    assert checked(document).exit_status == 3


def test_the_work_of_a_word_is_bounded() -> None:
    """Wide weights in a long word: the products of their matrices would take minutes."""
    width = "9" * 12_000
    ring = [[source, target, f"1/{width}"] for source, target, _ in directed_cycle(20)]
    word = {"word": [1] * 64, "mu": f"1/{width[1:]}7", "power": 1}
    document = switched(about(ring, mu=word["mu"], agents=20), said("control-bounded", "refuted", **word))
    (outcome,) = checked(document).outcomes
    assert (outcome.status, outcome.reason) == (
        "undecided", "a product of 64 matrices of 19 rows is beyond the work allowed"
    )  # fmt: skip


@pytest.mark.parametrize("document", [proved(), undecided()], ids=["proved", "undecided"])
def test_the_work_of_many_graphs_is_that_of_all(monkeypatch: pytest.MonkeyPatch, document: Json) -> None:
    """4^3 (bits)^2 of the forms here is below 2^17 for one graph, and beyond it for 64 of them."""
    monkeypatch.setattr(switching, "MAX_PRODUCT_WORK", 2**17)
    assert checked(document).exit_status == 0
    document["design"]["graphs"] *= 32
    for one in document["claims"]:
        if "Z" in one["witness"]:
            one["witness"]["Z"] *= 32
    assert checked(document).exit_status == 3
    monkeypatch.undo()
    assert checked(document).exit_status == 0


def test_a_slow_rate_by_another_form() -> None:
    """rho = 0.9919..., kappa = 2.526... by a form that is not the norm: FORM / 340 at mu = 13/20."""
    scaled = [[str(Fraction(x) / 40) for x in row] for row in FORM]
    q, w = full([[str(float(Fraction(x))) for x in row] for row in scaled]), full(NORM)
    ratio = np.linalg.eigvals(np.linalg.solve(w, q)).real
    assert min(ratio) >= 1
    kappa = Fraction(int(np.sqrt(max(ratio)) * 1000) + 1, 1000)
    document = proved()
    document["values"]["rate"] = {"kappa": str(kappa), "rho": "997/1000", "mu": ["13/20", "13/20"], "Q": scaled}
    assert statuses(document) == {"accepted"}
    for key, value in (("kappa", kappa - Fraction(1, 500)), ("rho", Fraction(98, 100))):
        assert checked(place(document, f"values.rate.{key}", str(value))).exit_status == 1


def test_the_statements_name_every_switching() -> None:
    assert all("every" in text for text in SWITCHED_STATEMENTS.values())
