"""The judge of mutated Coq files: what it calls true and false, without coqc (which `coq_mutants` runs)."""

from __future__ import annotations

from random import Random

import pytest

from .coq_mutants import design_in, mutated, texts, wrong
from .designs import NAMED


@pytest.fixture(scope="module")
def files() -> dict[str, str]:
    return texts()


def test_what_the_prover_writes_is_true_of_the_design_in_it(files: dict[str, str]) -> None:
    for name, text in files.items():
        design = design_in(text)
        assert design is not None
        assert (design.alpha, design.edges, design.agents) == (
            NAMED[name].alpha,
            NAMED[name].edges,
            NAMED[name].agents,
        )
        assert wrong(text) == []


@pytest.mark.parametrize(
    ("name", "old", "new", "claim"),
    [
        ("paper", "alpha : R := 9 / 10", "alpha : R := 8 / 10", "memory-inequality"),
        ("paper", "gamma : R := 3 / 20", "gamma : R := 30 / 20", "gain-bound"),
        ("paper", "[1; 1; 0; 0; 0]", "[1; 2; 0; 0; 0]", "graph-assumption"),
        ("c4-third", "mu : R := 1 / 3", "mu : R := 2 / 3", "gain-bound"),
        ("unbalanced", "(* graph-assumption: refuted *)", "(* graph-assumption: proved *)", "graph-assumption"),
    ],
)
def test_what_is_false_is_seen(files: dict[str, str], name: str, old: str, new: str, claim: str) -> None:
    changed = files[name].replace(old, new)
    assert changed != files[name]
    assert any(fault.startswith(claim) for fault in wrong(changed))


def test_a_matrix_of_no_digraph_is_not_judged(files: dict[str, str]) -> None:
    changed = files["paper"].replace("weights : zmat := [[0;", "weights : zmat := [[1;")
    assert changed != files["paper"]
    assert design_in(changed) is None


def test_a_mutant_differs_outside_of_comments(files: dict[str, str]) -> None:
    changed = [mutated(files["paper"], Random(k)) for k in range(50)]
    assert sum(text != files["paper"] for text in changed) > 40
    assert all(text.splitlines()[:7] == files["paper"].splitlines()[:7] for text in changed)
