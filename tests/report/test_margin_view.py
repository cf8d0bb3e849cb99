"""A printed margin is a promise: moved to it, the claim is true; a little beyond it, false; and the words around it."""

from __future__ import annotations

import re
from collections.abc import Iterator
from fractions import Fraction

import pytest

from fomas_verify.claims.verdict import Verdict
from fomas_verify.design import design_from_mapping
from fomas_verify.prover import Proof, prove
from fomas_verify.report.margin_view import binding, margin_lines
from fomas_verify.report.text import proof_text

PAPER = {"adjacency": [[0, 0, 0, 1, 1], [1, 0, 1, 0, 0], [1, 1, 0, 0, 0], [0, 1, 1, 0, 0], [0, 0, 0, 1, 0]]}
NUMBER = r"(\d[\d.]*(?:e[+-]?\d+)?)"
STEP = Fraction(3, 10**5)


def proof(graph: dict[str, object] = PAPER, alpha: str = "9/10", **keys: object) -> Proof:
    return prove(design_from_mapping({"name": "x", "alpha": alpha, "graph": graph, **keys}))


def verdict(found: Proof, claim: str, key: str, value: Fraction) -> Verdict:
    """The verdict where one number is another."""
    design = found.design
    gain = {name: getattr(design, name) for name in ("gamma", "mu", "h", "alpha")}
    given = {name: str(x) for name, x in (gain | {key: value}).items() if x is not None}
    edges = [[*map(str, edge)] for edge in design.graph.edges]
    graph = {"agents": design.graph.agents, "edges": [[int(i), int(j), w] for i, j, w in edges]}
    moved = design_from_mapping({"name": "x", "graph": graph, **given})
    return prove(moved, only=[claim]).decisions[claim].verdict


def ranges(words: str) -> Iterator[tuple[str, Fraction, Fraction, bool]]:
    """(key, least factor, greatest, whether the greatest is excluded) for each number of a line that is multiplied."""
    for match in re.finditer(rf"(gamma|h|mu) times (?:less than {NUMBER}|{NUMBER} to {NUMBER})", words):
        key, below, least, most = match.groups()
        yield key, Fraction(least or 0), Fraction(below or most), bool(below)


FAMILY = {"family": "complete", "agents": 5}
DESIGNS = [
    (PAPER, "9/10", {"gamma": "0.15", "h": "0.85"}),
    (PAPER, "9/10", {"gamma": "0.6", "h": "0.85"}),
    (PAPER, "9/10", {"mu": "0.3"}),
    (FAMILY, "1/2", {"gamma": "0.3", "h": "3"}),
    (FAMILY, "1/50", {"gamma": "0.19", "h": "1e-3"}),
    ({"family": "path", "agents": 4}, "0.97", {"mu": "0.6"}),
]


@pytest.mark.parametrize(("graph", "alpha", "gain"), DESIGNS)
def test_factors_are_sharp_and_on_the_safe_side(graph: dict[str, object], alpha: str, gain: dict[str, str]) -> None:
    found = proof(graph, alpha, **gain)
    seen = 0
    for claim, words in margin_lines(found):
        if claim == "control-norm-bound":
            continue
        for key, least, most, open_end in ranges(words):
            base, seen = Fraction(gain[key]), seen + 1
            inside = most * (1 - STEP / 3) if open_end else most
            assert verdict(found, claim, key, base * inside) is Verdict.PROVED
            assert verdict(found, claim, key, base * most * (1 + STEP)) is Verdict.REFUTED
            if least:
                assert verdict(found, claim, key, base * least) is Verdict.PROVED
                assert verdict(found, claim, key, base * least * (1 - STEP)) is Verdict.REFUTED
    assert seen >= 3 * len(gain)


@pytest.mark.parametrize(("graph", "alpha", "gain"), [*DESIGNS, (PAPER, "0.3", {"gamma": "0.5", "h": "8"})])
def test_alpha_moved_to_its_bound_changes_nothing(graph: dict[str, object], alpha: str, gain: dict[str, str]) -> None:
    found = proof(graph, alpha, **gain)
    for claim, words in margin_lines(found):
        here = found.decisions[claim].verdict
        for _, bound in re.findall(rf"alpha (at least|at most|from) {NUMBER}", words):
            assert verdict(found, claim, "alpha", Fraction(bound)) is here


def test_the_papers_numbers() -> None:
    """Issue: gamma may fall by 0.6 % before (14) fails, and must rise to 0.174538096247815173... at h = 0.85."""
    text = " ".join(proof_text(proof(gamma="0.15", h="0.85")).split())
    assert "gamma may fall by 0.598 % (memory-inequality binds) and rise by 271 % (gain-bound binds)" in text
    assert "gamma = 0.174538096247815173... at least" in text
    assert "alpha may fall to 0.899341 (memory-inequality binds) and rise to any number below 1" in text


def test_what_binds_binds() -> None:
    """One unit further than printed, the claim named is refuted."""
    found = proof(gamma="0.15", h="0.85")
    pattern = r"(gamma|h) may fall by ([\d.]+) % \((\S+) binds\) and rise by (\d+) % \((\S+) binds\)"
    matches = re.findall(pattern, binding(found))
    assert [match[0] for match in matches] == ["gamma", "h"]
    for key, fall, first, rise, last in matches:
        value = Fraction({"gamma": "0.15", "h": "0.85"}[key])
        for sign, size, unit, claim in ((-1, fall, "0.001", first), (1, rise, "1", last)):
            kept, lost = (
                value * (1 + sign * Fraction(x) / 100) for x in (Fraction(size), Fraction(size) + Fraction(unit))
            )
            for name in found.design.require:
                assert verdict(found, name, key, kept) is Verdict.PROVED
            assert verdict(found, claim, key, lost) is Verdict.REFUTED


def test_nothing_binds_what_is_refuted_already() -> None:
    assert binding(proof(gamma="0.14", h="0.85")) == ""
    assert binding(proof(gamma="0.15", h="0.85", gate={"require": ["repaired-condition"]})) == ""
    assert binding(proof(gamma="0.15", h="0.85", gate={"require": ["graph-assumption"]})) == ""


def test_required_claims_without_ends_are_named() -> None:
    require = ["gain-bound", "control-norm-bound", "average-consensus"]
    words = binding(proof(mu="0.3", gate={"require": require}))
    assert words.startswith("mu may fall to any positive number and rise by 66.6 % (gain-bound binds)")
    assert words.endswith("(control-norm-bound not counted)")


def test_without_edges_there_is_no_line_about_gains() -> None:
    found = proof({"agents": 3, "edges": []}, gamma="0.15", h="0.85")
    assert list(margin_lines(found)) == [("gain-bound", "true for every alpha")]
    assert "margins" in proof_text(found)


@pytest.mark.parametrize("alpha", ["1e-9", "1e-15"])
def test_a_factor_of_h_beyond_all_bounds_is_not_told(alpha: str) -> None:
    found = proof(alpha=alpha, gamma="0.15", h="0.85")
    lines = dict(margin_lines(found))
    assert "gamma times less than" in lines["gain-bound"]
    assert "h times" not in lines["gain-bound"]
    assert "or h" not in found.decisions["memory-inequality"].remedy
