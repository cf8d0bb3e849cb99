"""`Design`: the same graph from every object, exact numbers with a note, and refusals in one line."""

import subprocess
import sys
from decimal import Decimal
from fractions import Fraction
from pathlib import Path
from typing import Any

import networkx as nx
import numpy as np
import pytest
import scipy.sparse

from fomas_verify.api import Design, FomasError, simulate
from fomas_verify.exact.errors import MissingExtraError

A = [[0, 0, 0, 1, 1], [1, 0, 1, 0, 0], [1, 1, 0, 0, 0], [0, 1, 1, 0, 0], [0, 0, 0, 1, 0]]
EDGES = sorted((j + 1, i + 1, Fraction(1)) for i, row in enumerate(A) for j, x in enumerate(row) if x)
FILES = Path(__file__).parents[1] / "network" / "files"


def as_networkx() -> nx.DiGraph:
    graph = nx.DiGraph()
    graph.add_nodes_from(range(1, 6))
    graph.add_edges_from((source, target) for source, target, _ in EDGES)
    return graph


GRAPHS: dict[str, dict[str, Any]] = {
    "rows": {"graph": A},
    "rows, transposed": {"graph": [list(row) for row in zip(*A, strict=True)], "orientation": "from-to"},
    "edges": {"graph": [(i, j) for i, j, _ in EDGES], "agents": 5},
    "weighted edges": {"graph": EDGES, "agents": 5},
    "numpy": {"graph": np.array(A), "orientation": "hears"},
    "numpy, transposed": {"graph": np.array(A).T, "orientation": "from-to"},
    "matrix": {"graph": np.asmatrix(A), "orientation": "hears"},
    "scipy": {"graph": scipy.sparse.csr_array(A), "orientation": "hears"},
    "networkx": {"graph": as_networkx()},
    "networkx, transposed": {"graph": as_networkx().reverse(), "orientation": "hears"},
    "file": {"graph": FILES / "paper.csv", "orientation": "hears"},
    "file of edges": {"graph": FILES / "paper.graphml"},
    "table": {"graph": {"adjacency": A}},
}


@pytest.mark.parametrize("kind", GRAPHS)
def test_the_same_graph_from_every_object(kind: str) -> None:
    design = Design(alpha="9/10", **GRAPHS[kind])
    assert list(design.edges) == EDGES
    assert design.notes == ()


def test_the_orientation_shows_along_a_trajectory() -> None:
    """With a_12 = 1 alone agent 1 moves towards agent 2; networkx and scipy mean that edge as from 2 to 1."""
    given = {"alpha": "1/2", "mu": "1/4", "h": 1, "x0": [0, 8]}
    matrix = np.array([[0, 1], [0, 0]])
    hears = simulate(Design(**given, graph=matrix, orientation="hears"), 1)
    told = simulate(Design(**given, graph=nx.DiGraph([(2, 1)])), 1)
    transposed = simulate(Design(**given, graph=matrix, orientation="from-to"), 1)
    assert hears.x.tolist() == told.x.tolist() == [[0, 8], [2, 8]]
    assert transposed.x.tolist() == [[0, 8], [0, 6]]


@pytest.mark.parametrize(
    ("value", "exact"),
    [
        (0.1, Fraction(1, 10)),
        ("0.1", Fraction(1, 10)),
        ("1/10", Fraction(1, 10)),
        (Fraction(1, 10), Fraction(1, 10)),
        (Decimal("0.1"), Fraction(1, 10)),
        (np.float64(0.1), Fraction(1, 10)),
        (np.float32(0.1), Fraction(1, 10)),
        (np.int64(2), Fraction(2)),
    ],
)
def test_numbers_are_exact_and_floats_noted(value: Any, exact: Fraction) -> None:
    design = Design(alpha="9/10", mu=value, graph="path", agents=3)
    assert design.mu == exact
    noted = ("mu: binary floats are read as their shortest decimals (0.1 is 1/10)",)
    assert design.notes == (noted if isinstance(value, float | np.float32) else ())


def test_a_graph_of_floats_is_noted() -> None:
    design = Design(alpha="9/10", graph=0.1 * np.array(A), orientation="hears")
    assert design.notes == ("graph: weights that are binary floats are read as their shortest decimals (0.1 is 1/10)",)
    assert {weight for _, _, weight in design.edges} == {Fraction(1, 10)}


def test_every_key_of_a_design_file() -> None:
    design = Design(
        name="plant", alpha=(0.88, 0.92), gamma=0.15, h="0.85", graph="star", agents=np.int64(4),
        x0=np.array([[1, 2], [3, 4], [5, 6], [7, 8.5]]), require=["gain-bound"],
        limits={"h": (0.1, 2), "u_max": 3},
    )  # fmt: skip
    assert (design.name, design.agents, design.alpha) == ("plant", 4, (Fraction(22, 25), Fraction(23, 25)))
    least = design.exact.least
    assert (least.x0[3], least.require) == ((7, Fraction(17, 2)), ("gain-bound",))
    assert (least.limits.h, least.limits.u_max) == ((Fraction(1, 10), 2), 3)
    assert Design(alpha="1/2", graph="torus", shape=(3, 4)).agents == 12


def test_graphs_to_switch_among() -> None:
    design = Design(alpha=0.9, mu=0.1, graphs=[np.array(A), np.array(A).T], orientation="hears")
    assert len(design.exact.graphs) == 2


def test_it_is_read_and_written(tmp_path: Path, checkout: Path) -> None:
    paper = Design.read(checkout / "examples" / "paper.toml")
    paper.save(tmp_path / "copy.toml")
    copy = Design.read(tmp_path / "copy.toml")
    assert (copy.edges, copy.alpha, copy.gamma, copy.h) == (paper.edges, paper.alpha, paper.gamma, paper.h)
    assert repr(paper) == "<Design 'paper': alpha=9/10, gamma=3/20, h=17/20, 5 agents>"


GRAPH: dict[str, Any] = {"graph": "path", "agents": 3}


@pytest.mark.parametrize(
    ("given", "reason"),
    [
        ({"alpha": 1.5, **GRAPH}, "design: alpha: expected a number between 0 and 1, both excluded, got 1.5"),
        ({"alpha": float("nan"), **GRAPH}, "design: alpha: expected a decimal or a fraction such as 0.9 or 9/10"),
        ({"alpha": 0.9, "gamma": 1, "mu": 1, **GRAPH}, "design: mu: expected either gamma or mu, got both"),
        ({"alpha": 0.9}, "design: graph: expected a table, got nothing"),
        ({"alpha": 0.9, "mu": object(), **GRAPH}, "design: mu: expected a number, got a object"),
        ({"alpha": 0.9, "graph": "pth", "agents": 3}, "design: graph.family: expected a family, got 'pth'; did you"),
        ({"alpha": 0.9, "graph": np.array(A)}, 'design: orientation: expected "hears" (a_ij: i hears j) or "from-to"'),
        ({"alpha": 0.9, "graph": np.array(A), "orientation": "rows"}, "design: orientation: expected hears or from-to"),
        ({"alpha": 0.9, "graph": A, "orientation": "both-ways"}, "design: orientation: expected hears or from-to"),
        ({"alpha": 0.9, **GRAPH, "orientation": "hears"}, "design: orientation: expected only with a matrix, rows"),
        ({"alpha": 0.9, "graph": as_networkx(), "agents": 5}, "design: agents: expected only with edges or a family"),
        ({"alpha": 0.9, "graph": nx.MultiDiGraph([(1, 2)])}, "design: graph: expected a graph with each edge once"),
        ({"alpha": 0.9, "graph": 7}, "design: graph: expected a graph, a matrix, edges, a family or the path of a"),
        ({"alpha": 0.9, "graph": np.eye(2), "orientation": "hears"}, "design: graph: row 1, column 1: expected no"),
        ({"alpha": 0.9, "graph": Path("none.mtx"), "orientation": "hears"}, "expected a file, got no such file"),
        ({"alpha": 0.9, "graph": {"file": "a.graphml"}}, "design: graph.file: expected a graph in the design itself"),
        ({"alpha": [0.8, 0.9], "graph": nx.path_graph(101)}, "101 agents, more than 100, are not supported yet"),
        ({"alpha": 0.9, "graphs": [nx.path_graph(101)]}, "101 agents, more than 100, are not supported yet"),
        ({"alpha": 0.9, **GRAPH, "require": []}, "design: gate.require: expected at least one claim id"),
        ({"alpha": 0.9, **GRAPH, "x0": [1, 2]}, "design: x0: expected a list of 3 numbers, one for each agent"),
        ({"alpha": 0.9, "graphs": [], "graph": "path", "agents": 2}, "design: graphs: expected either graph or graphs"),
    ],
)
def test_what_is_refused_is_refused_in_one_line(given: dict[str, Any], reason: str) -> None:
    with pytest.raises(FomasError) as caught:
        Design(**given)
    assert reason in str(caught.value)
    assert str(caught.value).isprintable()
    assert caught.value.exit_status == 2


def test_the_sampled_loop_for_python_control() -> None:
    """x_{k+1} = P x_k, as numpy has P; and one step of it is a step of the simulation, which has the memory."""
    import control

    design = Design(alpha="9/10", mu="1/10", h="1/2", graph=A, x0=[4.5, 5, 6, 1.5, -1])
    loop = design.to_control()
    matrix = np.array(A, dtype=float)
    expected = np.eye(5) - 0.1 * (np.diag(matrix.sum(axis=1)) - matrix)
    assert np.abs(loop.A - expected).max() < 1e-15
    assert (loop.dt, loop.ninputs, loop.noutputs) == (0.5, 0, 5)
    times = 0.5 * np.arange(21)
    states = control.initial_response(loop, T=times, X0=[4.5, 5, 6, 1.5, -1]).outputs
    assert np.abs(states.T - simulate(design, 20).x).max() < 1e-12


def test_python_control_is_an_extra(monkeypatch: pytest.MonkeyPatch) -> None:
    design = Design(alpha="9/10", mu="1/10", h="1/2", graph=A)
    with pytest.raises(FomasError, match=r"^design: h: to_control needs h; got no h$"):
        Design(alpha="9/10", mu="1/10", graph=A).to_control()
    with pytest.raises(FomasError, match=r"to_control: expected a design with numbers, got an interval"):
        Design(alpha=("8/10", "9/10"), mu="1/10", h=1, graph=A).to_control()
    monkeypatch.setitem(sys.modules, "control", None)
    with pytest.raises(MissingExtraError, match="the extra `control` brings: pip install 'fomas_verify\\[control\\]'"):
        design.to_control()


def test_names_are_found_in_the_package_in_any_order() -> None:
    """Rooms of the package are called like two verbs: imported before or after, the name can be called."""
    script = """
import fomas_verify
assert fomas_verify.region is fomas_verify.api.region
import fomas_verify.simulate.loop as loop, fomas_verify.region.find
from fomas_verify import Design, FomasError, check, prove, region, simulate, synthesize
assert loop.simulate and region.find_region and "simulate" in dir(fomas_verify)
design = Design(alpha="1/2", mu="1/4", h=1, graph="complete", agents=2, x0=[0, 1])
assert region(design).strips["gain-bound"].inner and fomas_verify.simulate(design, 1).x[1, 0] == 0.25
from fomas_verify import region as again
assert again(design).exit_status == 0 == check(prove(design)).exit_status
try:
    fomas_verify.regions
except AttributeError as error:
    print(error)
"""
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert done.stdout == "module 'fomas_verify' has no attribute 'regions'\n"
