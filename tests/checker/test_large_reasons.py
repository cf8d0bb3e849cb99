"""Large networks: what is refused or left undecided is so for the reason that is given, in words, and for no other."""

from fractions import Fraction
from typing import Any

import pytest

from fomas_verify.checker import STATEMENTS
from fomas_verify.checker.large import at_most, require_vector
from fomas_verify.checker.powers import Enclosure
from fomas_verify.checker.ruling import Refused
from tests.checker.large_networks import Edges, Json, certificate, checked, claim, design, edge_list, file_graph, joined

F = Fraction
RING = edge_list(joined((i, i % 5 + 1) for i in range(1, 6)))
CYCLE: Json = {"family": "cycle"}
UNBALANCED: Edges = [(1, 2, F(1)), (2, 3, F(1)), (3, 1, F(1)), (1, 3, F(1, 2))]
"""Agent 1 hears 1 and is heard with 3/2; agent 3 the other way round; agent 2 hears as much as it is heard."""


def said(about: Json, *claims: Json, data: bytes = RING, **more: Any) -> list[tuple[str, str]]:
    """Status and reason of each bound, and of each claim that stands for something."""
    report = checked(certificate(about, *claims, **more), data)
    return [(o.status, o.reason) for o in report.outcomes if o.verdict != "undecided"]


def test_a_claim_that_is_false_is_said_to_be_what_it_is() -> None:
    about = design(CYCLE, 5, mu="1/10")
    for name in ("gain-bound", "average-consensus", "control-norm-bound"):
        assert said(about, claim(name, "proved"))[0][0] == "accepted"
        assert said(about, claim(name, "refuted")) == [("refused", "the claim is true")]
    beyond = design(CYCLE, 5, mu="9/10")
    for name in ("gain-bound", "average-consensus", "repaired-condition", "beta-contraction"):
        assert said(beyond, claim(name, "refuted"))[0][0] == "accepted"
        assert said(beyond, claim(name, "proved")) == [("refused", "the claim is false")]


@pytest.mark.parametrize("name", STATEMENTS)
@pytest.mark.parametrize("verdict", ["undecided", "inapplicable"])
def test_a_claim_says_its_own_statement_whatever_its_verdict(name: str, verdict: str) -> None:
    """Neither more nor less, nor that of another claim."""
    about = design(CYCLE, 5, mu="1/10", x0=["1"] * 5)
    words = "not true: the statement is the one of this claim, to the letter"
    right = STATEMENTS[name]
    others = (right + " ", right[:-1], right.upper(), right.lower() + "~", "", "~", "0")
    for statement in (*others, *(x for other, x in STATEMENTS.items() if other != name)):
        report = checked(certificate(about, claim(name, verdict) | {"statement": statement}))
        assert [(o.status, o.reason) for o in report.outcomes] == [("refused", words)]


def test_assumption_1_holds_or_it_does_not() -> None:
    words = STATEMENTS["graph-assumption"]
    for about, data in ((design(CYCLE, 2**50, mu="1"), b""), (design(file_graph(RING), 5, mu="1"), RING)):
        assert said(about, claim("graph-assumption", "proved"), data=data) == [("accepted", "true")]
        for defect in ({"unreachable": [1, 2]}, {"imbalance": {"agent": 1, "in": "2", "out": "2"}}):
            wrong = claim("graph-assumption", "refuted", **defect)
            assert said(about, wrong, data=data) == [("refused", f"not true: {words}")]
    data = edge_list(UNBALANCED)
    about = design(file_graph(data), 3, mu="1")
    assert said(about, claim("graph-assumption", "proved"), data=data) == [("refused", f"not true: {words}")]


@pytest.mark.parametrize("agent", [1, 2, 3])
def test_an_imbalance_is_the_one_that_is_there(agent: int) -> None:
    data = edge_list(UNBALANCED)
    about = design(file_graph(data), 3, mu="1")
    true = {1: (F(1), F(3, 2)), 2: (F(1), F(1)), 3: (F(3, 2), F(1))}[agent]
    numbers = [F(1, 2), F(1), F(3, 2), F(2)]
    for heard, spoken in ((x, y) for x in numbers for y in numbers):
        witness = {"agent": agent, "in": str(heard), "out": str(spoken)}
        found = said(about, claim("graph-assumption", "refuted", imbalance=witness), data=data)
        if heard != true[0]:
            words = f'not true: "in" is the sum of the weights that agent {agent} hears'
        elif spoken != true[1]:
            words = f'not true: "out" is the sum of the weights with which agent {agent} is heard'
        else:
            words = "true" if heard != spoken else 'not true: "in" and "out" differ'
        assert found == [("accepted" if words == "true" else "refused", words)]


def test_both_defects_of_a_witness_are_tested() -> None:
    data = edge_list([(1, 2, F(1)), (1, 3, F(1)), (2, 3, F(1))])
    about = design(file_graph(data), 3, mu="1")
    right: Json = {"unreachable": [3, 1], "imbalance": {"agent": 1, "in": "0", "out": "2"}}
    wrong: Json = {"unreachable": [1, 3], "imbalance": {"agent": 2, "in": "1", "out": "1"}}
    assert said(about, claim("graph-assumption", "refuted", **right), data=data) == [("accepted", "true")]
    for key, words in (
        ("unreachable", "no directed path leads from agent 1 to agent 3"),
        ("imbalance", '"in" and "out" differ'),
    ):
        changed = claim("graph-assumption", "refuted", **{**right, key: wrong[key]})
        assert said(about, changed, data=data) == [("refused", f"not true: {words}")]


def test_what_presupposes_assumption_1_is_inapplicable_without_it_and_only_then() -> None:
    data = edge_list(UNBALANCED)
    for name in STATEMENTS:
        for graph, n, holds in ((file_graph(data), 3, False), (CYCLE, 5, True)):
            about = design(graph, n, mu="1/100", x0=["1"] * n)
            found = said(about, claim(name, "inapplicable"), data=data)
            if holds or name in ("graph-assumption", "gain-bound", "perron-eigenvalues"):
                assert found == [("refused", "not true: Assumption 1 fails, and the claim presupposes it")]
            else:
                assert found == [("accepted", "Assumption 1 fails")]
                for verdict in ("proved", "refuted", "undecided"):
                    report = checked(certificate(about, claim(name, verdict)), data)
                    assert report.outcomes[0].reason == "not true: the claim is applicable (Assumption 1 fails)"


@pytest.mark.parametrize("verdict", ["proved", "refuted", "undecided", "inapplicable"])
def test_there_is_no_claim_about_a_state_without_one(verdict: str) -> None:
    about = design(CYCLE, 5, mu="1/10")
    report = checked(certificate(about, claim("trajectory-norm-bound", verdict)))
    assert [(o.status, o.reason) for o in report.outcomes] == [("refused", "not true: the design has x0")]


FACTORS = [
    # the ring on 5: lambda2 = 1.38, lambda_max = 3.62, D = 2; sigma = 0.86 at mu = 1/10
    ("lambda2_lower", "lambda2 is at least the bound", "0", "1", "5"),
    ("lambda_max_upper", "lambda_max is at most the bound", "4", "39/10", "1"),
    ("sigma_upper", "sigma is at most the bound", "7/5", "9/10", "1/2"),
]


@pytest.mark.parametrize(("key", "words", "true", "unseen", "false"), FACTORS)
def test_a_bound_by_factor_in_words(key: str, words: str, true: str, unseen: str, false: str) -> None:
    about = design(file_graph(RING), 5, mu="1/10")
    assert said(about, spectrum={key: true}) == [("accepted", words)]
    needs = f"that {words} takes a sparse factor: `verify-design check --numeric` computes one"
    assert said(about, spectrum={key: unseen}) == [("undecided", needs)]
    assert said(about, spectrum={key: false}) == [("refused", f"not true: {words}")]
    data = edge_list(UNBALANCED)
    name = key.rsplit("_", 1)[0]
    found = said(design(file_graph(data), 3, mu="1/10"), spectrum={key: true}, data=data)
    assert found == [("refused", f"not true: {name} exists (Assumption 1 fails)")]


@pytest.mark.parametrize("vector", [(1, 0), (0, -1), (1, -2), (2**62, 1 - 2**62), (-(2**62), 2**62 - 1)])
def test_a_vector_that_does_not_sum_to_0(vector: tuple[int, ...]) -> None:
    with pytest.raises(Refused, match="the vector sums to 0"):
        require_vector(vector)
    found = said(design(file_graph(RING), 5, mu="1/10"), spectrum={"vectors": [[*vector, 0, 0, 0]]})
    assert found == [("refused", "not true: the vector sums to 0")]


def test_a_vector_of_zeros() -> None:
    with pytest.raises(Refused, match="the vector is not 0"):
        require_vector((0, 0))
    assert require_vector((0, 1, -1)) == "sums to 0 and is not 0"


def test_a_vector_that_was_refused_bounds_nothing() -> None:
    """(1, 1, 1, 1, 1) would have the quotient 0, and lambda2 <= 0 would refute the memory inequality."""
    about = design(file_graph(RING), 5, mu="1/10")
    for vector in ([1] * 5, [-1] * 5, [0] * 5):
        report = checked(
            certificate(about, claim("memory-inequality", "refuted"), spectrum={"vectors": [vector]}), RING
        )
        assert [o.status for o in report.outcomes] == ["refused", "undecided"]


def test_where_two_enclosures_touch_nothing_is_refused() -> None:
    """Both numbers may be the one they have in common."""
    low, high = Enclosure(F(0), F(1)), Enclosure(F(1), F(2))
    assert at_most(high, low) is None
    assert at_most(low, high) is True
    assert at_most(Enclosure(F(1), F(1)), Enclosure(F(1), F(1))) is True
    assert at_most(Enclosure(F(5, 4), F(2)), low) is False
