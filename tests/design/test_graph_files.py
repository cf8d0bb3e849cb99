"""A design whose graph is a file: where it may lie, what is said of its reading, and that it is not transposed."""

import math
import subprocess
import sys
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
import scipy.io

from fomas_verify.design import Design, DesignError, SwitchedDesign, read_design, read_named
from fomas_verify.exact.errors import MissingExtraError
from fomas_verify.gate.deciding import Options, decide
from fomas_verify.network import adjacency
from fomas_verify.simulate import PROPOSED, plant_of, simulate

FILES = Path(__file__).parents[1] / "network" / "files"
DESIGN = 'alpha = 0.9\ngamma = 0.15\nh = 0.85\nx0 = [4.5, 5, 6, 1.5, -1]\n[graph]\nfile = "{}"\n'
CSV = DESIGN + 'orientation = "{}"\n'
PAPER = ((0, 0, 0, 1, 1), (1, 0, 1, 0, 0), (1, 1, 0, 0, 0), (0, 1, 1, 0, 0), (0, 0, 0, 1, 0))


def design(folder: Path, text: str, name: str = "plant.toml") -> Path:
    path = folder / name
    path.write_text(text)
    return path


@pytest.fixture
def outside(tmp_path: Path) -> Path:
    """A folder for a design, beside one with the paper's graph."""
    for name in ("inside", "outside"):
        (tmp_path / name).mkdir()
    (tmp_path / "outside" / "paper.csv").write_bytes((FILES / "paper.csv").read_bytes())
    return tmp_path / "inside"


def test_the_file_lies_beside_the_design(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Wherever the command runs."""
    (tmp_path / "graphs").mkdir()
    (tmp_path / "graphs" / "paper.graphml").write_bytes((FILES / "paper.graphml").read_bytes())
    path = design(tmp_path, DESIGN.format("graphs/paper.graphml"))
    monkeypatch.chdir("/")
    assert adjacency(read_design(path).graph) == PAPER


@pytest.mark.parametrize("file", ["../outside/paper.csv", "{outside}/paper.csv", "link.csv", "folder/paper.csv"])
def test_a_file_outside_is_refused_unless_allowed(outside: Path, file: str) -> None:
    """By its name, and by a symbolic link to it or to its folder."""
    (outside / "link.csv").symlink_to(outside.parent / "outside" / "paper.csv")
    (outside / "folder").symlink_to(outside.parent / "outside")
    path = design(outside, CSV.format(file.format(outside=outside.parent / "outside"), "hears"))
    with pytest.raises(DesignError, match=r"expected a file in the folder of the design.*--allow-outside allows it$"):
        read_design(path)
    assert adjacency(read_design(path, allow_outside=True).graph) == PAPER


def test_a_link_inside_is_inside(tmp_path: Path) -> None:
    (tmp_path / "real").mkdir()
    (tmp_path / "real" / "paper.csv").write_bytes((FILES / "paper.csv").read_bytes())
    (tmp_path / "link.csv").symlink_to("real/paper.csv")
    assert adjacency(read_design(design(tmp_path, CSV.format("link.csv", "hears"))).graph) == PAPER


def test_a_loop_of_links(tmp_path: Path) -> None:
    (tmp_path / "loop.csv").symlink_to("loop.csv")
    with pytest.raises(DesignError, match=r"graph\.file: "):
        read_design(design(tmp_path, CSV.format("loop.csv", "hears")))


def test_the_orientation_shows_along_a_trajectory(tmp_path: Path) -> None:
    """x_1 = x_0 - mu L x_0 with a_12 = 1 alone: agent 1 moves towards agent 2, and in the transposed graph agent 2."""
    (tmp_path / "a.csv").write_text("0,1\n0,0\n")
    moved = {}
    for orientation in ("hears", "from-to"):
        text = 'alpha = 0.5\ngamma = 0.1\nh = 1\nx0 = [0, 8]\n[graph]\nfile = "a.csv"\n'
        read = read_design(design(tmp_path, text + f'orientation = "{orientation}"\n'))
        moved[orientation] = simulate(plant_of(read), PROPOSED, 1).states[:, 0, 1].tolist()
    step = 8 * 0.1 / math.gamma(1.5)
    assert moved["hears"] == pytest.approx([step, 8], abs=1e-12)
    assert moved["from-to"] == pytest.approx([0, 8 - step], abs=1e-12)


def test_graphs_to_switch_among(tmp_path: Path) -> None:
    (tmp_path / "paper.csv").write_bytes((FILES / "paper.csv").read_bytes())
    scipy.io.savemat(tmp_path / "a.mat", {"A": 0.5 * np.array(PAPER)})
    text = 'alpha = 0.9\nmu = 0.1\n[[graphs]]\nfile = "paper.csv"\norientation = "hears"\n'
    found = read_named(design(tmp_path, text + '[[graphs]]\nfile = "a.mat"\norientation = "hears"\n'))
    assert isinstance(found, SwitchedDesign)
    assert adjacency(found.graphs[0]) == PAPER
    assert adjacency(found.graphs[1])[0][3] == Fraction(1, 2)
    assert [note.partition(":")[0] for note in found.first.notes] == ["graphs[1]"]


def test_too_many_agents_are_not_supported(tmp_path: Path) -> None:
    (tmp_path / "a.edgelist").write_text("\n".join(f"{i} {i % 10001 + 1}" for i in range(1, 10002)))
    text = 'alpha = 0.9\nmu = 0.1\n[graph]\nfile = "a.edgelist"\n'
    with pytest.raises(DesignError, match=r"graph: 10001 agents, more than 10000, are not supported yet here"):
        read_design(design(tmp_path, text))
    assert read_named(design(tmp_path, text)).graph.edge_count == 10001


@pytest.mark.parametrize("module", ["numpy", "scipy.io", "networkx", "defusedxml"])
def test_a_missing_extra_is_said_in_one_line(module: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    name = "a.mtx" if module in ("numpy", "scipy.io") else "a.graphml"
    (tmp_path / name).write_text("-")
    monkeypatch.setitem(__import__("sys").modules, module, None)
    top = module.partition(".")[0]
    with pytest.raises(MissingExtraError) as caught:
        read_design(design(tmp_path, CSV.format(name, "hears")))
    assert str(caught.value) == (
        f"graph files need {top}, which the extra `graphs` brings: pip install 'fomas_verify[graphs]'"
    )
    assert caught.value.exit_status == 2


def test_a_design_that_is_no_file_has_no_folder() -> None:
    from fomas_verify.design import parse_design

    with pytest.raises(DesignError, match="this design has no folder"):
        parse_design(DESIGN.format("paper.graphml"), "toml", "design")


@pytest.fixture
def floats(tmp_path: Path) -> Path:
    """A design with a graph of binary floats outside its folder."""
    (tmp_path / "designs").mkdir()
    scipy.io.savemat(tmp_path / "a.mat", {"A": 0.1 * np.array(PAPER)})
    text = 'format = "fomas-design/1"\nname = "plant"\nalpha = 0.9\ngamma = 1.5\nh = 0.85\n'
    return design(tmp_path / "designs", text + '[graph]\nfile = "../a.mat"\norientation = "hears"\n')


NOTE = "note: graph: weights that are binary floats are read as their shortest decimals (0.1 is 1/10)"


def run(*arguments: object) -> "subprocess.CompletedProcess[str]":
    call = [sys.executable, "-m", "fomas_verify", *map(str, arguments)]
    return subprocess.run(call, capture_output=True, text=True, check=False)


@pytest.mark.slow
def test_every_command_reads_it_and_says_so(floats: Path, tmp_path: Path) -> None:
    """In the table where there is one of the design, and otherwise on standard error."""
    certificate = tmp_path / "c.json"
    calls = {
        ("prove", floats, "-o", certificate): (1, 0),
        ("prove", floats, "--json"): (0, 1),
        ("check", certificate, "--design", floats): (0, 1),
        ("region", floats): (0, 1),
        ("synthesize", floats): (0, 1),
        ("gate", floats): (2, 0),
        ("report", floats, "-o", tmp_path / "r", "--format", "md"): (0, 1),
    }
    for call, said in calls.items():
        refused = run(*call)
        assert (refused.returncode, "--allow-outside allows it" in refused.stderr + refused.stdout) == (2, True), call
        done = run(*call, "--allow-outside")
        assert (done.returncode, done.stdout.count(NOTE[6:]), done.stderr.count(NOTE)) == (0, *said), call


def test_the_gate_notes_it(floats: Path) -> None:
    result = decide(floats, Options(allow_outside=True))
    assert (result.status, result.note) == (0, NOTE[6:])


def test_a_design_keeps_what_must_be_known(floats: Path) -> None:
    read = read_design(floats, allow_outside=True)
    assert isinstance(read, Design)
    assert read.notes == (NOTE[6:],)
    assert {weight for _, _, weight in read.graph.edges} == {Fraction(1, 10)}
