"""Of at most 200 agents claims may rest on matrices: here on the paper's digraph, whose consensus ends at mu = 2/3."""

from fractions import Fraction

import pytest

from fomas_verify.checker import Malformed
from tests.checker.builder import PAPER_EDGES, lyapunov
from tests.checker.large_networks import Edges, Json, certificate, checked, claim, design, edge_list, file_graph

CONSENSUS = ("perron-eigenvalues", "control-bounded", "average-consensus")
PAPER: Edges = [(i, j, Fraction(w)) for i, j, w in PAPER_EDGES]
START = ["1", "0", "0", "0", "0"]
STABLE = {"mu": "3/5", "Q": lyapunov(PAPER_EDGES, 5, Fraction(3, 5))}
UNSTABLE = {"mu": "7/10", "power": 256}
PERSISTENT = {"mu": "2/3", "Y": [["0"], ["0", "0"], ["0", "0", "0"], ["0", "0", "0", "0"]]}


def status(
    mu: str, name: str, verdict: str, witness: Json | None = None, *, edges: Edges = PAPER, agents: int = 5
) -> str:
    data = edge_list(edges)
    about = design(file_graph(data), agents, mu=mu, x0=[*START, *["0"] * (agents - 5)])
    report = checked(certificate(about, claim(name, verdict) | {"witness": witness or {}}), data)
    return report.outcomes[-1].status


@pytest.mark.parametrize("name", CONSENSUS)
def test_what_bounds_leave_open_a_witness_shows(name: str) -> None:
    assert status("3/5", name, "proved") == "undecided"
    assert status("3/5", name, "proved", STABLE) == "accepted"
    assert status("7/10", name, "refuted") == "undecided"
    assert status("7/10", name, "refuted", UNSTABLE) == "accepted"


@pytest.mark.parametrize(
    ("mu", "verdict", "witness"),
    [
        ("61/100", "proved", STABLE),
        ("3/5", "proved", {**STABLE, "mu": "7/10"}),
        ("7/10", "proved", {**STABLE, "mu": "7/10"}),
        ("3/5", "refuted", UNSTABLE),
        ("3/5", "refuted", {**UNSTABLE, "mu": "3/5"}),
        ("7/10", "refuted", {**UNSTABLE, "power": 1}),
        ("2/3", "refuted", PERSISTENT),
    ],
)
def test_a_witness_that_does_not_show_it_is_refused(mu: str, verdict: str, witness: Json) -> None:
    for name in CONSENSUS:
        assert status(mu, name, verdict, witness) == "refused"


def test_a_witness_is_looked_at_even_where_bounds_decide() -> None:
    assert status("1/10", "average-consensus", "proved") == "accepted"
    assert status("1/10", "average-consensus", "refuted", UNSTABLE) == "refused"
    assert status("1/10", "average-consensus", "proved", {**STABLE, "mu": "1/20"}) == "refused"


def test_without_assumption_1_the_eigenvalues_are_those_of_the_matrix() -> None:
    """Agent 1 hears nobody: P has the eigenvalue 1 - mu four times more."""
    star: Edges = [(1, i, Fraction(1)) for i in range(2, 6)]
    given = [[1, i, "1"] for i in range(2, 6)]
    stable = {"mu": "3/2", "Q": lyapunov(given, 5, Fraction(3, 2))}
    assert status("3/2", "perron-eigenvalues", "proved", edges=star) == "undecided"
    assert status("3/2", "perron-eigenvalues", "proved", stable, edges=star) == "accepted"
    assert status("5/2", "perron-eigenvalues", "refuted", {"mu": "5/2", "power": 2}, edges=star) == "accepted"
    assert status("3/2", "average-consensus", "proved", stable, edges=star) == "refused"
    assert status("3/2", "average-consensus", "inapplicable", edges=star) == "accepted"


def test_one_initial_state() -> None:
    """At mu = 1 the eigenvalues 2 + i, 2 - i of L give P the modulus sqrt 2."""
    assert status("3/5", "trajectory-norm-bound", "refuted", {"k": 1}) == "refused"
    assert status("1", "trajectory-norm-bound", "refuted", {"k": 30}) == "accepted"


def ring(agents: int) -> Edges:
    return sorted((i, i % agents + 1, Fraction(1)) for i in range(1, agents + 1))


def test_beyond_two_hundred_agents_there_are_no_matrices() -> None:
    """The trace of P on the differences is N - 1 - 2 N."""
    outside = {"mu": "2", "power": 1}
    assert status("2", "average-consensus", "refuted", outside, edges=ring(200), agents=200) == "accepted"
    assert status("2", "average-consensus", "refuted", edges=ring(201), agents=201) == "undecided"
    with pytest.raises(Malformed, match=r"claims\[0\].witness: unknown key 'mu'"):
        status("2", "average-consensus", "refuted", outside, edges=ring(201), agents=201)


@pytest.mark.parametrize(
    ("name", "verdict", "witness", "words"),
    [
        ("gain-bound", "proved", {"mu": "1/2"}, "unknown key 'mu'"),
        ("average-consensus", "undecided", {"bits": 128}, "unknown key 'bits'"),
        ("average-consensus", "inapplicable", {"power": 1}, "unknown key 'power'"),
        ("average-consensus", "proved", {"mu": "1/2"}, 'missing key "Q"'),
    ],
)
def test_a_witness_that_does_not_belong_there(name: str, verdict: str, witness: Json, words: str) -> None:
    with pytest.raises(Malformed, match=words):
        status("1/2", name, verdict, witness)
