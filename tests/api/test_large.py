"""Networks too large for matrices by the Python API."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import networkx as nx
import numpy as np
import pytest
import scipy.sparse as sp

from fomas_verify.api import Design, FomasError, check, prove, region, simulate
from fomas_verify.network.sparse import SparseDigraph
from fomas_verify.network.sparse_families import sparse_family

REGULAR = nx.random_regular_graph(4, 300, seed=2)


def test_a_networkx_graph_is_proved_checked_and_saved(tmp_path: Path) -> None:
    design = Design(alpha="9/10", mu="1/10", graph=REGULAR)
    proof = prove(design)
    assert (design.agents, len(design.edges), proof.verdicts["average-consensus"]) == (300, 1200, "proved")
    lower, upper = proof.values["lambda2"]
    assert lower < Fraction(float(nx.linalg.algebraic_connectivity(REGULAR, tol=1e-12))) < upper + Fraction(1, 10**9)
    found = check(proof, design=design, require=["average-consensus"])
    assert (found.exit_status, found.verdicts["average-consensus"]) == (3, "proved")
    proof.save(tmp_path / "a.json")
    assert check(tmp_path / "a.json", design=design).outcomes == found.outcomes
    other = Design(alpha="9/10", mu="1/10", graph=nx.random_regular_graph(4, 300, seed=3))
    assert check(tmp_path / "a.json", design=other).differences == ["graph"]
    assert "average-consensus" in str(proof)
    assert "300 agents" in repr(design)


def test_a_matrix_is_the_graph_that_it_stands_for() -> None:
    torus = sparse_family("torus", shape=(15, 20))
    matrix = sp.coo_array((torus.weights, (torus.targets, torus.sources)))
    by_name = prove(Design(alpha="9/10", mu="1/10", graph="torus", shape=(15, 20)))
    proof = prove(Design(alpha="9/10", mu="1/10", graph=matrix, orientation="hears"))
    assert proof.certificate == by_name.certificate
    assert check(proof).exit_status == 0


def test_arrays_that_nobody_has_looked_at_are_no_graph() -> None:
    """Whoever builds a SparseDigraph has tested its edges; a user who builds one may not have."""
    ends = np.array([0, 0])
    self_loops = SparseDigraph(300, ends, ends, np.array([-1, -1]), 1)
    with pytest.raises(FomasError, match="expected a graph, a matrix, edges"):
        Design(alpha="9/10", mu="1/10", graph=self_loops)


def test_what_takes_matrices_refuses_a_large_graph() -> None:
    design = Design(alpha="9/10", mu="1/10", h=1, graph="cycle", agents=10_001, name="ring")
    for call in (region, lambda x: simulate(x, 3), lambda x: x.to_control(), lambda x: x.save("never.toml")):
        with pytest.raises(FomasError, match="10001 agents, more than 10000, are not supported yet here"):
            call(design)
    assert not Path("never.toml").exists()
