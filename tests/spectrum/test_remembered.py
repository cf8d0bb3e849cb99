"""What is kept with a loop: shared where it may be, and gone with it."""

import gc
import weakref
from dataclasses import replace
from fractions import Fraction

import pytest

from fomas_verify.claims.verdict import Verdict
from fomas_verify.design import CLAIM_IDS, design_from_mapping
from fomas_verify.prover import prove
from fomas_verify.spectrum.loop import Loop

GRAPHS = (
    {"adjacency": [[0, 0, 0, 1, 1], [1, 0, 1, 0, 0], [1, 1, 0, 0, 0], [0, 1, 1, 0, 0], [0, 0, 0, 1, 0]]},
    {"family": "directed-cycle", "agents": 4},
    {"family": "path", "agents": 4},
    {"agents": 3, "edges": [[1, 2], [2, 3]]},
)


def design(graph, alpha="9/10", mu="1/5"):
    return design_from_mapping({"alpha": alpha, "mu": mu, "graph": graph})


def test_a_loop_goes_with_its_proof() -> None:
    proof = prove(design(GRAPHS[0]))
    loop = weakref.ref(proof.loop)
    del proof
    gc.collect()
    assert loop() is None


@pytest.mark.parametrize("graph", GRAPHS)
def test_sharing_changes_no_answer(graph) -> None:
    first = design(graph)
    known = prove(first).loop
    for alpha, mu in (("9/10", "1/2"), ("3/10", "1/2"), ("1/2", "1"), ("9/10", "2")):
        other = replace(first, alpha=Fraction(alpha), mu=Fraction(mu))
        alone, shared = prove(other, only=CLAIM_IDS), prove(other, only=CLAIM_IDS, like=known)
        assert shared.decisions == alone.decisions
        assert shared.values == alone.values
        known = shared.loop


def test_what_depends_on_alpha_is_not_kept_for_another() -> None:
    one = Loop(design(GRAPHS[1], alpha="1/2"))
    two = one.on_same_graph(design(GRAPHS[1], alpha="9/10"))
    assert one.threshold(64).upper < two.threshold(64).lower


def test_another_digraph_is_refused() -> None:
    with pytest.raises(ValueError, match="same digraph"):
        prove(design(GRAPHS[1]), like=Loop(design(GRAPHS[2])))


def test_the_ring_at_its_tie_after_a_stable_one() -> None:
    """mu = 1 = mu* on a directed cycle: a permutation."""
    stable = prove(design(GRAPHS[1], mu="1/5")).loop
    proof = prove(design(GRAPHS[1], mu="1"), like=stable)
    assert proof.decisions["perron-eigenvalues"].verdict is Verdict.REFUTED
