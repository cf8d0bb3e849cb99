"""What is false, or not shown by its witness, is refused with its reason."""

from collections.abc import Callable
from copy import deepcopy
from typing import Any

import pytest

from tests.checker.builder import Json, checked, claim, outcome
from tests.checker.cases import ALTERNATING_4, CASES, CENTRED_4, P4_LAMBDA2, P5_LAMBDA2

STATEMENT = "the statement is the one of this claim, to the letter"
SUMS = "e sums to 0"
BEYOND_BETA = "norm(P e) > beta norm(e)"
BEYOND = "norm(P e) > (2^alpha - 1) norm(e)"
ROOT = "the polynomial has exactly one real root in (lower, upper]"
TRACE = "abs trace(Pc(witness.mu)^power) > N - 1"
FORM = "2 (L_s - lambda2 I) - mu (L^T L - lambda2^2 I) >= 0"
CONNECTED = "the digraph is strongly connected and balanced"
DECREASE = "Q - Pc(t)^T Q Pc(t) > 0"
PERSIST = "Pc(t)^T Y Pc(t) - Y >= 0"
NOT_BELOW = "mu >= 1/Delta_max"
APPLICABLE = "the claim is applicable (Assumption 1 fails)"
INAPPLICABLE = "Assumption 1 fails, and the claim presupposes it"
FIRST = "beta <= 2^alpha - 1"
ABOVE_FIRST = "beta > 2^alpha - 1"
BELOW_SECOND = "beta < -sqrt(3^alpha - 2^alpha)"
STABLE = {"mu": "1/2", "Q": [["1"], ["0", "1"], ["0", "0", "1"]]}


def root(polynomial: list[str], lower: str, upper: str, mu: str = "1/2") -> Json:
    return {"mu": mu, "lambda2": {"polynomial": polynomial, "lower": lower, "upper": upper}}


def symmetric(mu: str, lambda2_upper: str, lambda_max_upper: str) -> Json:
    return {"mu": mu, "lambda2_upper": lambda2_upper, "lambda_max_upper": lambda_max_upper}


CLAIMS: list[tuple[str, str, str, Json, str]] = [
    ("paper", "graph-assumption", "refuted", {"unreachable": [1, 5]}, "no directed path leads from agent 1 to agent 5"),
    ("paper", "graph-assumption", "refuted", {"unreachable": [2, 2]}, "no directed path leads from agent 2 to agent 2"),
    (
        "paper",
        "graph-assumption",
        "refuted",
        {"imbalance": {"agent": 1, "in": "2", "out": "2"}},
        '"in" and "out" differ',
    ),
    ("paper", "graph-assumption", "inapplicable", {}, INAPPLICABLE),
    ("paper", "gain-bound", "refuted", {}, NOT_BELOW),
    ("paper", "gain-bound", "inapplicable", {}, INAPPLICABLE),
    ("paper", "memory-inequality", "refuted", {"k": 0}, ABOVE_FIRST),
    ("paper", "memory-inequality", "refuted", {"k": 1}, BELOW_SECOND),
    ("paper", "memory-inequality", "inapplicable", {}, INAPPLICABLE),
    ("paper", "average-consensus", "inapplicable", {}, INAPPLICABLE),
    ("paper", "repaired-condition", "proved", {}, "sigma <= 2^alpha - 1"),
    ("paper", "repaired-condition", "refuted", {"e": ["0"] * 5}, "e is not 0"),
    ("paper", "repaired-condition", "refuted", {"e": ["1", "0", "0", "0", "0"]}, SUMS),
    ("paper", "repaired-condition", "refuted", {"e": ["-1", "-3", "-3", "1", "7"]}, SUMS),
    ("paper", "repaired-condition", "refuted", {"e": ["1", "-1", "0", "0", "0"]}, BEYOND),
    ("paper", "beta-contraction", "refuted", {"e": ["0"] * 5}, "e is not 0"),
    ("paper", "beta-contraction", "refuted", {"e": ["1", "1", "1", "1", "1"]}, SUMS),
    ("paper", "beta-contraction", "refuted", {"e": ["1", "-1", "0", "0", "0"]}, BEYOND_BETA),
    ("paper", "beta-contraction", "proved", root(["-1", "1"], "0", "1"), FORM),
    ("paper", "beta-contraction", "proved", root(["-1", "1"], "0", "1", "1/8"), "mu <= witness.mu"),
    ("paper", "beta-contraction", "proved", symmetric("1/2", "1", "3"), "the graph is symmetric"),
    ("paper", "perron-eigenvalues", "refuted", {"mu": "3/20", "power": 7}, "witness.mu <= mu"),
    ("paper", "perron-eigenvalues", "refuted", {"mu": "13/100", "power": 7}, TRACE),
    ("paper", "perron-eigenvalues", "refuted", {"mu": "13/100", "power": 2**256}, TRACE),
    ("paper", "perron-eigenvalues", "refuted", {"mu": "13/100", "power": 10**50 + 7}, TRACE),
    ("paper", "perron-eigenvalues", "refuted", {"mu": "-1", "power": 7}, "0 < witness.mu"),
    (
        "paper",
        "perron-eigenvalues",
        "refuted",
        {"mu": "0", "Y": [["1"], ["0", "1"], ["0"] * 3, ["0"] * 4]},
        "0 < witness.mu",
    ),
    ("path4_tie", "memory-inequality", "refuted", {"k": 0}, ABOVE_FIRST),
    ("path4_tie", "memory-inequality", "refuted", {"k": 1}, BELOW_SECOND),
    ("path4_tie", "gain-bound", "proved", {}, "mu < 1/Delta_max"),
    ("path4_tie", "repaired-condition", "proved", {}, "sigma <= 2^alpha - 1"),
    ("path4_tie", "perron-eigenvalues", "proved", {"mu": "1", "Q": STABLE["Q"]}, DECREASE),
    ("path4_tie", "beta-contraction", "proved", {"mu": "1", "lambda2": P4_LAMBDA2}, FORM),
    ("path4_contraction", "beta-contraction", "refuted", {"e": ["1", "-1", "-1", "1"]}, BEYOND_BETA),
    ("path4_contraction", "beta-contraction", "refuted", {"e": ["1", "1", "-1", "-1"]}, BEYOND_BETA),
    ("path4_contraction", "beta-contraction", "refuted", {"e": ["12", "5", "-5", "-12"]}, BEYOND_BETA),
    ("path4_contraction", "beta-contraction", "proved", root(["2", "-4", "1"], "0", "4"), ROOT),
    ("path4_contraction", "beta-contraction", "proved", root(["2", "-4", "1"], "1", "2"), ROOT),
    ("path4_contraction", "beta-contraction", "proved", root(["2", "-4", "1"], "1", "0"), ROOT),
    ("path4_contraction", "beta-contraction", "proved", root(["2", "-4", "1"], "2", "4"), "the root is lambda2"),
    ("path4_contraction", "beta-contraction", "proved", root(["-3", "5"], "0", "1"), "the root is lambda2"),
    ("path4_contraction", "beta-contraction", "proved", root(["-2", "4"], "1/2", "1"), ROOT),
    (
        "path4_contraction",
        "beta-contraction",
        "proved",
        root(["-2", "1", "0"], "0", "2"),
        "the highest coefficient is not 0",
    ),
    ("path4_contraction", "beta-contraction", "proved", root(["2", "-4", "1"], "0", "1", "51/100"), FORM),
    (
        "path4_contraction",
        "beta-contraction",
        "proved",
        root(["2", "-4", "1"], "0", "1", "2"),
        "witness.mu lambda2 <= 1",
    ),
    ("path4_contraction", "beta-contraction", "proved", root(["2", "-4", "1"], "0", "1", "49/100"), "mu <= witness.mu"),
    ("path5_irrational_mu", "beta-contraction", "proved", {"mu": "1/5", "lambda2": P5_LAMBDA2}, "mu <= witness.mu"),
    (
        "path4_contraction",
        "beta-contraction",
        "proved",
        symmetric("1/2", "3/5", "7/2"),
        "witness.mu (witness.lambda2_upper + witness.lambda_max_upper) <= 2",
    ),
    (
        "path4_contraction",
        "beta-contraction",
        "proved",
        symmetric("1/2", "1/2", "7/2"),
        "lambda2 <= witness.lambda2_upper",
    ),
    (
        "path4_contraction",
        "beta-contraction",
        "proved",
        symmetric("1/2", "3/5", "17/5"),
        "every eigenvalue of L_s is <= witness.lambda_max_upper",
    ),
    ("path4_contraction", "beta-contraction", "proved", symmetric("1/3", "3/5", "7/2"), "mu <= witness.mu"),
    (
        "complete_deadbeat",
        "beta-contraction",
        "proved",
        symmetric("1/5", "6", "5"),
        "witness.mu witness.lambda2_upper <= 1",
    ),
    ("complete_deadbeat", "beta-contraction", "refuted", {"e": ["1", "-1", "0", "0", "0"]}, BEYOND_BETA),
    ("complete_deadbeat", "repaired-condition", "refuted", {"e": ["1", "-1", "0", "0", "0"]}, BEYOND),
    ("complete_deadbeat", "memory-inequality", "refuted", {"k": 1}, BELOW_SECOND),
    ("complete_negative_beta", "memory-inequality", "proved", {}, "beta >= -sqrt(3^alpha - 2^alpha)"),
    ("complete_negative_beta", "memory-inequality", "refuted", {"k": 0}, ABOVE_FIRST),
    (
        "complete_negative_beta",
        "beta-contraction",
        "proved",
        symmetric("39/100", "5", "5"),
        "witness.mu witness.lambda2_upper <= 1",
    ),
    ("square_contraction_tie", "beta-contraction", "refuted", {"e": ["1", "-1", "1", "-1"]}, BEYOND_BETA),
    ("square_contraction_tie", "beta-contraction", "refuted", {"e": ["1", "0", "-1", "0"]}, BEYOND_BETA),
    ("square_contraction_tie", "beta-contraction", "refuted", {"e": ["3", "-1", "-1", "-1"]}, BEYOND_BETA),
    ("square_contraction_tie", "gain-bound", "refuted", {}, NOT_BELOW),
    ("two_rotors", "memory-inequality", "proved", {}, FIRST),
    ("two_rotors", "beta-contraction", "proved", root(["-3/5", "1"], "0", "1", "3/2"), FORM),
    ("two_rotors", "beta-contraction", "proved", root(["-3/5", "1"], "0", "1", "1/11"), "mu <= witness.mu"),
    ("k2_on_the_circle", "gain-bound", "proved", {}, "mu < 1/Delta_max"),
    ("k2_on_the_circle", "perron-eigenvalues", "refuted", {"mu": "1", "power": 2}, TRACE),
    ("k2_on_the_circle", "perron-eigenvalues", "refuted", {"mu": "1", "power": 2**200}, TRACE),
    ("k2_on_the_circle", "perron-eigenvalues", "refuted", {"mu": "1", "Y": [["0"]]}, "Y != 0"),
    ("k2_on_the_circle", "perron-eigenvalues", "refuted", {"mu": "1", "Y": [["-1"]]}, "Y >= 0"),
    ("k2_on_the_circle", "perron-eigenvalues", "refuted", {"mu": "99/100", "Y": [["1"]]}, PERSIST),
    ("k2_on_the_circle", "perron-eigenvalues", "refuted", {"mu": "2", "Y": [["1"]]}, "witness.mu <= mu"),
    ("k2_on_the_circle", "perron-eigenvalues", "proved", {"mu": "1", "Q": [["1"]]}, DECREASE),
    ("k2_on_the_circle", "perron-eigenvalues", "proved", {"mu": "1", "Q": [["0"]]}, "Q > 0"),
    ("k2_on_the_circle", "perron-eigenvalues", "proved", {"mu": "99/100", "Q": [["1"]]}, "mu <= witness.mu"),
    ("k2_beyond", "control-bounded", "proved", {"mu": "3/2", "Q": [["-1"]]}, "Q > 0"),
    ("k2_beyond", "control-bounded", "refuted", {"mu": "1", "power": 9}, TRACE),
    ("directed_cycle_permutation", "perron-eigenvalues", "proved", {"mu": "1", "Q": CENTRED_4}, DECREASE),
    (
        "directed_cycle_permutation",
        "perron-eigenvalues",
        "refuted",
        {"mu": "1", "Y": [*ALTERNATING_4[:2], ["1", "1", "1"]]},
        "Y >= 0",
    ),
    (
        "directed_cycle_permutation",
        "perron-eigenvalues",
        "refuted",
        {"mu": "1", "Y": [["1"], ["0", "1"], ["0", "0", "1"]]},
        PERSIST,
    ),
    ("directed_cycle_permutation", "perron-eigenvalues", "refuted", {"mu": "1", "power": 4}, TRACE),
    ("directed_cycle_permutation", "perron-eigenvalues", "refuted", {"mu": "1", "power": 10**40}, TRACE),
    ("weighted_directed_cycle", "perron-eigenvalues", "proved", {"mu": "3/2", "Q": CENTRED_4}, DECREASE),
    (
        "weighted_directed_cycle",
        "graph-assumption",
        "refuted",
        {"imbalance": {"agent": 1, "in": "1", "out": "2/3"}},
        '"in" is the sum of the weights that agent 1 hears',
    ),
    (
        "weighted_directed_cycle",
        "graph-assumption",
        "refuted",
        {"imbalance": {"agent": 1, "in": "2/3", "out": "1"}},
        '"out" is the sum of the weights with which agent 1 is heard',
    ),
    ("square_alternating", "perron-eigenvalues", "refuted", {"mu": "1/2", "Y": CENTRED_4}, PERSIST),
    ("square_alternating", "beta-contraction", "refuted", {"e": ["1", "0", "-1", "0"]}, BEYOND_BETA),
    ("bipartite", "repaired-condition", "proved", {}, "sigma <= 2^alpha - 1"),
    ("bipartite", "memory-inequality", "refuted", {"k": 0}, ABOVE_FIRST),
    ("no_edges", "graph-assumption", "proved", {}, CONNECTED),
    ("no_edges", "gain-bound", "refuted", {}, NOT_BELOW),
    ("no_edges", "perron-eigenvalues", "proved", {"mu": "9", "Q": [["1"], ["0", "1"]]}, DECREASE),
    ("no_edges", "perron-eigenvalues", "inapplicable", {}, INAPPLICABLE),
    ("no_edges", "memory-inequality", "proved", {}, APPLICABLE),
    ("no_edges", "memory-inequality", "undecided", {"bits": 128}, APPLICABLE),
    ("no_edges", "beta-contraction", "refuted", {"e": ["1", "-1", "0"]}, APPLICABLE),
    ("rooted_and_unbalanced", "graph-assumption", "proved", {}, CONNECTED),
    (
        "rooted_and_unbalanced",
        "graph-assumption",
        "refuted",
        {"unreachable": [1, 3]},
        "no directed path leads from agent 1 to agent 3",
    ),
    (
        "rooted_and_unbalanced",
        "graph-assumption",
        "refuted",
        {"unreachable": [2, 1], "imbalance": {"agent": 2, "in": "2", "out": "1"}},
        '"in" is the sum of the weights that agent 2 hears',
    ),
    ("unbalanced", "graph-assumption", "proved", {}, CONNECTED),
    (
        "unbalanced",
        "graph-assumption",
        "refuted",
        {"unreachable": [1, 2]},
        "no directed path leads from agent 1 to agent 2",
    ),
    ("unbalanced", "control-bounded", "refuted", {"mu": "1", "power": 1}, APPLICABLE),
]


@pytest.mark.parametrize(("case", "name", "verdict", "witness", "reason"), CLAIMS)
def test_false_claims(case: str, name: str, verdict: str, witness: Json, reason: str) -> None:
    document = CASES[case]()
    document["claims"] = [claim(name, verdict, **witness)]
    assert outcome(document, name) == ("refused", f"not true: {reason}")
    report = checked(document)
    assert (report.exit_status, report.verdicts) == (1, {})


@pytest.mark.parametrize("case", CASES)
def test_another_statement(case: str) -> None:
    document = deepcopy(CASES[case]())  # cases share their inapplicable claims
    for entry in document["claims"]:
        entry["statement"] += " "
        assert outcome(document, entry["id"]) == ("refused", f"not true: {STATEMENT}")


@pytest.mark.parametrize("case", CASES)
def test_each_bound_moved_past_its_value(case: str) -> None:
    document = CASES[case]()
    for name, ends in document["values"].items():
        lower, upper = ends["lower"], ends["upper"]
        ends["lower"] = shifted(upper, 1)
        assert outcome(document, name) == ("refused", f"not true: lower <= {name}")
        ends["lower"], ends["upper"] = lower, shifted(lower, -1)
        assert outcome(document, name) == ("refused", f"not true: {name} <= upper")
        ends["upper"] = upper


def shifted(text: str, sign: int) -> str:
    """The rational, moved by 1e-60."""
    numerator, _, denominator = text.partition("/")
    below = int(denominator or "1")
    return f"{int(numerator) * 10**60 + sign * below}/{below * 10**60}"


@pytest.mark.parametrize("case", ["no_edges", "rooted_and_unbalanced", "unbalanced"])
@pytest.mark.parametrize("name", ["lambda2", "beta", "sigma"])
def test_values_that_do_not_exist(case: str, name: str) -> None:
    document = CASES[case]()
    document["values"] = {name: {"lower": "-1000", "upper": "1000"}}
    assert outcome(document, name) == ("refused", f"not true: {name} exists (Assumption 1 fails)")


def transposed_weight(document: Json) -> None:
    document["design"]["edges"][0][2] = "2"


def other_alpha(document: Json) -> None:
    document["design"]["alpha"] = "8/10"


def other_gain(document: Json) -> None:
    document["design"]["gamma"] = "151/1000"


def other_period(document: Json) -> None:
    document["design"]["h"] = "851/1000"


def missing_edge(document: Json) -> None:
    document["design"]["edges"].pop()


@pytest.mark.parametrize(
    ("change", "refused"),
    [
        (transposed_weight, {"graph-assumption", "memory-inequality", "lambda2", "beta", "sigma", "control-bounded"}),
        (other_alpha, {"mu", "threshold", "beta", "sigma"}),
        (other_gain, {"mu", "beta", "sigma", "perron-eigenvalues"}),
        (other_period, {"mu", "beta", "sigma", "perron-eigenvalues"}),
        (missing_edge, {"graph-assumption", "lambda2", "average-consensus"}),
    ],
)
def test_the_certificate_of_another_design(change: Callable[[Json], None], refused: set[str]) -> None:
    document = CASES["paper"]()
    change(document)
    found: set[Any] = {o.id for o in checked(document).outcomes if o.status == "refused"}
    assert found >= refused
