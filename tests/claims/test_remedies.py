"""A remedy is a promise: followed, it makes the claim true; a little beyond the bound it names, the claim is false."""

import re
from fractions import Fraction

import pytest

from fomas_verify.claims.verdict import Decision, Verdict
from fomas_verify.design import design_from_mapping
from fomas_verify.prover import prove

pytestmark = pytest.mark.slow

PAPER = {"adjacency": [[0, 0, 0, 1, 1], [1, 0, 1, 0, 0], [1, 1, 0, 0, 0], [0, 1, 1, 0, 0], [0, 0, 0, 1, 0]]}
NUMBER = r"(\d[\d.]*(?:e[+-]?\d+)?)"
BOUND = rf"(to at least|to at most|below) {NUMBER}"


def family(name: str, agents: int) -> dict[str, object]:
    return {"family": name, "agents": agents}


def decide(claim: str, alpha: str, graph: dict[str, object], gain: dict[str, str]) -> Decision:
    return prove(design_from_mapping({"name": "x", "alpha": alpha, "graph": graph, **gain})).decisions[claim]


def bounds(remedy: str) -> list[tuple[str, str, str, Fraction]]:
    """(key, raise or lower, wording, bound) for mu, or for gamma and for h."""
    if match := re.fullmatch(rf"(raise|lower) mu {BOUND}", remedy):
        return [("mu", match[1], match[2], Fraction(match[3]))]
    match = re.fullmatch(
        rf"(raise|lower) gamma {BOUND} \(with h as it is\), or h {BOUND} \(with gamma as it is\)", remedy
    )
    assert match, remedy
    return [("gamma", match[1], match[2], Fraction(match[3])), ("h", match[1], match[4], Fraction(match[5]))]


GAMMA_LOW, GAMMA_HIGH = {"gamma": "0.12", "h": "0.85"}, {"gamma": "2.1", "h": "1.3"}
SHARP = [
    ("gain-bound", "9/10", PAPER, {"mu": "1/2"}),
    ("gain-bound", "9/10", PAPER, GAMMA_HIGH),
    ("gain-bound", "0.02", family("directed-cycle", 7), {"gamma": "30", "h": "1e-6"}),
    ("memory-inequality", "9/10", PAPER, {"mu": "1/10"}),
    ("memory-inequality", "9/10", PAPER, GAMMA_LOW),
    ("memory-inequality", "9/10", PAPER, {"mu": "1e-150"}),
    ("memory-inequality", "9/10", PAPER, {"gamma": "1e-20", "h": "1"}),
    ("memory-inequality", "1/2", family("complete", 5), {"mu": "0.4"}),
    ("memory-inequality", "1/2", family("complete", 5), {"gamma": "0.4", "h": "3"}),
    ("perron-eigenvalues", "9/10", PAPER, {"mu": "2/3"}),
    ("perron-eigenvalues", "9/10", PAPER, {"mu": "1e200"}),
    ("perron-eigenvalues", "9/10", PAPER, GAMMA_HIGH),
    ("perron-eigenvalues", "9/10", family("path", 4), {"mu": "0.6"}),
    ("control-bounded", "9/10", family("directed-cycle", 5), {"mu": "1"}),
    ("average-consensus", "1/3", family("star", 6), {"gamma": "1", "h": "1"}),
    ("beta-contraction", "9/10", family("path", 4), {"mu": "0.51"}),
    ("beta-contraction", "9/10", family("complete", 4), {"gamma": "0.5", "h": "1"}),
    ("repaired-condition", "9/10", PAPER, {"gamma": "0.15", "h": "0.85"}),
    ("repaired-condition", "9/10", PAPER, {"mu": "0.156782"}),
    ("repaired-condition", "9/10", PAPER, {"mu": "0.45"}),
    ("repaired-condition", "9/10", PAPER, {"mu": "0.39652"}),
    ("repaired-condition", "0.863038", PAPER, {"mu": "0.1"}),
    ("repaired-condition", "9/10", family("path", 4), {"mu": "0.1"}),
]


@pytest.mark.parametrize(("claim", "alpha", "graph", "gain"), SHARP)
def test_followed_it_holds_and_a_little_beyond_it_fails(
    claim: str, alpha: str, graph: dict[str, object], gain: dict[str, str]
) -> None:
    refuted = decide(claim, alpha, graph, gain)
    assert refuted.verdict is Verdict.REFUTED
    for key, verb, wording, bound in bounds(refuted.remedy):
        assert (bound > Fraction(gain[key])) == (verb == "raise")
        inside = bound * (1 - Fraction(1, 10**9)) if wording == "below" else bound
        assert decide(claim, alpha, graph, {**gain, key: str(inside)}).verdict is Verdict.PROVED
        beyond = bound * (1 + Fraction(3 if verb == "lower" else -3, 10**5))
        assert decide(claim, alpha, graph, {**gain, key: str(beyond)}).verdict is Verdict.REFUTED


@pytest.mark.parametrize("alpha", ["0.8552059620743", "0.85520606107", "0.8552069611"])
def test_a_remedy_for_14_keeps_within_the_gain_bound_that_it_says_can_be_met(alpha: str) -> None:
    """On the directed ring of 10 both can be met from alpha = 0.855205961... on, by mu just below 1."""
    refuted = decide("memory-inequality", alpha, family("directed-cycle", 10), {"mu": "1/2"})
    for _, _, _, bound in bounds(refuted.remedy):
        assert bound < 1
        assert (
            decide("memory-inequality", alpha, family("directed-cycle", 10), {"mu": str(bound)}).verdict
            is Verdict.PROVED
        )


def test_no_region_says_so_and_from_which_order_on_there_is_one() -> None:
    """Theory, section 5: nonempty iff alpha > log2(2 - lambda2/D): 0.585 on the paper's graph, 0.855 on a 10-ring."""
    for graph, order in [(PAPER, Fraction("0.584963")), (family("directed-cycle", 10), Fraction("0.855206"))]:
        refuted = decide("memory-inequality", "1/2", graph, {"mu": "1/10"})
        match = re.search(rf"an alpha above {NUMBER} opens a region$", refuted.remedy)
        assert match, refuted.remedy
        assert 0 <= Fraction(match[1]) - order < Fraction(2, 10**6)
        opened = decide("memory-inequality", str(Fraction(match[1]) + Fraction(1, 10**5)), graph, {"mu": "1/10"})
        assert bounds(opened.remedy)[0][3] < 1


def test_what_is_said_to_be_impossible_is() -> None:
    """The star of 5 at alpha 0.7655 has sigma(1/3) = 2/3 below the threshold, beyond 1/Delta_max = 1/4."""
    refuted = decide("repaired-condition", "0.7655", family("star", 5), {"mu": "1/5"})
    assert "no gamma and no h gives it" not in refuted.remedy
    assert decide("repaired-condition", "0.7655", family("star", 5), {"mu": "1/3"}).verdict is Verdict.PROVED


@pytest.mark.parametrize("graph", [{"agents": 3, "edges": []}, {"agents": 3, "edges": [[1, 3], [2, 3]]}])
def test_where_no_gain_will_do_the_remedy_is_about_edges(graph: dict[str, object]) -> None:
    refuted = decide("perron-eigenvalues", "9/10", graph, {"mu": "1/10"})
    assert refuted.remedy == "add edges until one agent reaches every other"


def test_each_refutation_has_a_reason_a_meaning_and_a_remedy() -> None:
    for graph, gain in [
        (PAPER, {"mu": "1"}),
        (family("complete", 5), {"mu": "1"}),
        ({"agents": 2, "edges": []}, {"mu": "1"}),
    ]:
        proof = prove(design_from_mapping({"name": "x", "alpha": "1/2", "graph": graph, **gain}))
        for decision in proof.decisions.values():
            if decision.verdict is Verdict.REFUTED:
                assert all([decision.reason, decision.meaning, decision.remedy])
            else:
                assert not decision.remedy
