"""[[graphs]] through the command line: prove, check, region, gate, and the commands that refuse it."""

import json
import re
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from subprocess import CompletedProcess

import pytest

pytestmark = pytest.mark.slow

Verify = Callable[..., CompletedProcess[str]]

GRAPHS = """[[graphs]]
adjacency = [[0,0,0,1,1], [1,0,1,0,0], [1,1,0,0,0], [0,1,1,0,0], [0,0,0,1,0]]
[[graphs]]
family = "directed-cycle"
agents = 5
"""


def write(folder: Path, numbers: str, graphs: str = GRAPHS, name: str = "plant.design.toml") -> Path:
    path = folder / name
    path.write_text(f'name = "plant"\nalpha = 0.9\n{numbers}\n{graphs}')
    return path


def test_proved_checked_and_proved_again_in_the_same_place(verify: Verify, tmp_path: Path) -> None:
    design, certificate = write(tmp_path, "gamma = 0.15\nh = 0.85"), tmp_path / "certificate.json"
    for _ in range(2):
        run = verify("prove", design, "-o", certificate)
        assert (run.returncode, run.stderr) == (0, "")
    assert run.stdout.startswith("plant: alpha = 0.9, gamma = 0.15, h = 0.85; 5 agents, 2 graphs to switch among\n")
    assert re.search(r"^\* average-consensus +proved +one quadratic form decreases", run.stdout, re.MULTILINE)
    assert "under every switching norm(x_k - mean) <= kappa rho^k norm(x_0 - mean): kappa = 1, rho = " in run.stdout
    assert run.stdout.endswith("All 3 required claims are proved.\n")
    checked = verify("check", certificate, "--design", design, "--require", "design")
    assert (checked.returncode, checked.stderr) == (0, "")
    for numbers, graphs in (
        ("gamma = 0.16\nh = 0.85", GRAPHS),
        ("gamma = 0.15\nh = 0.85", GRAPHS.replace("1,1]", "1,2]", 1)),
    ):
        assert verify("check", certificate, "--design", write(tmp_path, numbers, graphs, "x.toml")).returncode == 1
    other = verify("check", certificate, "--design", "examples/paper.toml")
    assert (other.returncode, "edges" in other.stdout) == (1, True)
    assert verify("prove", design, "--json").stdout == certificate.read_text()


def test_the_other_way_round_a_single_graph_is_another_design(verify: Verify, tmp_path: Path) -> None:
    certificate = tmp_path / "paper.json"
    assert verify("prove", "examples/paper.toml", "-o", certificate).returncode == 0
    run = verify("check", certificate, "--design", write(tmp_path, "gamma = 0.15\nh = 0.85"))
    assert (run.returncode, "graphs" in run.stdout) == (1, True)


@pytest.mark.parametrize(("mu", "status", "words"), [
    ("[0.1, 0.65]", 0, "every mu up to 0.65"),
    ("0.66", 3, "no quadratic form decreases under every graph, as the dual shows"),
    ("0.7", 1, "graph 1 alone: mu = 0.7 >= mu* = 2/3"),
])  # fmt: skip
def test_beyond_the_gain_bound(verify: Verify, tmp_path: Path, mu: str, status: int, words: str) -> None:
    design, certificate = write(tmp_path, f"mu = {mu}"), tmp_path / "certificate.json"
    run = verify("prove", design, "-o", certificate)
    assert (run.returncode, run.stderr) == (status, "")
    assert words in " ".join(run.stdout.split())
    checked = verify("check", certificate, "--design", design)
    assert (checked.returncode, checked.stderr) == (0, "")
    assert verify("check", certificate, "--require", "design").returncode == status


def test_the_region(verify: Verify, tmp_path: Path) -> None:
    design, certificate = write(tmp_path, "h = 0.85"), tmp_path / "region.json"
    run = verify("region", design, "-o", certificate)
    assert (run.returncode, run.stderr) == (0, "")
    assert re.search(
        r"^common-form  \(0, 0\.65873730\d+\] certified, none above 0\.65873730\d+$", run.stdout, re.MULTILINE
    )
    assert "gamma up to 0.5566244964" in run.stdout
    assert verify("check", certificate, "--design", design).returncode == 0
    found = json.loads(verify("region", design, "--json").stdout)["conditions"]
    assert [entry["id"] for entry in found] == ["gain-bound", "common-form"]
    assert Fraction(found[1]["mu"]["outer"][1]) - Fraction(found[1]["mu"]["inner"][1]) < Fraction(1, 10**7)
    broken = GRAPHS.replace("[0,0,0,1,1]", "[0,0,0,1,2]")
    assert "common-form  empty" in verify("region", write(tmp_path, "", broken)).stdout


def test_the_gate(verify: Verify, tmp_path: Path) -> None:
    write(tmp_path, "gamma = 0.15\nh = 0.85")
    run = verify("gate", tmp_path, "--cache", tmp_path / "cache", "-o", tmp_path / "certificates")
    assert (run.returncode, run.stderr) == (0, "")
    assert verify("gate", tmp_path, "--cache", tmp_path / "cache", "--json").returncode == 0
    run = verify("gate", tmp_path, "--require", "memory-inequality")
    assert (run.returncode, "memory-inequality is no claim about [[graphs]]" in run.stdout) == (2, True)
    write(tmp_path, "mu = 0.1", GRAPHS.replace("[0,0,0,1,1]", "[0,0,0,1,2]"))
    found = json.loads(verify("gate", tmp_path, "--json").stdout)["designs"][0]
    assert found["status"] == 1
    assert {(x["rule"], x["line"]) for x in found["findings"]} == {
        (name, 4) for name in ("graph-assumption", "control-bounded", "average-consensus")
    }


def test_the_baseline_of_a_single_graph_is_not_forgotten(verify: Verify, tmp_path: Path) -> None:
    single = '[graph]\nfamily = "directed-cycle"\nagents = 5\n'
    write(tmp_path, "gamma = 0.15\nh = 0.85", single)
    baseline = tmp_path / "baseline"
    verify("gate", tmp_path, "--require", "average-consensus", "-o", baseline)
    write(tmp_path, "gamma = 0.15\nh = 0.85")
    run = verify("gate", tmp_path, "--require", "average-consensus", "--baseline", baseline)
    assert (run.returncode, "the design has several graphs" in run.stdout) == (1, True)


@pytest.mark.parametrize(
    ("arguments", "numbers", "message"),
    [
        (["prove"], "", "mu: prove needs mu, or gamma and h; got no mu"),
        (["prove", "--horizon", "3"], "mu = 0.1", "--horizon is not supported yet with [[graphs]]"),
        (["prove", "--coq", "coq"], "mu = 0.1", "--coq is not supported yet with [[graphs]]"),
        (["prove"], "mu = 0.1\nx0 = [1,2,3,4,5]", "x0: with [[graphs]] this key is not supported yet"),
        (["prove"], "mu = 0.1\nsettle_to = 0.1", "settle_to: with [[graphs]] this key is not supported yet"),
        (["prove"], "gamma = [0.1, 0.2]\nh = 1", "gamma: with [[graphs]] an interval is not supported yet"),
        (["prove"], "mu = 0.1\ngate = {require = ['perron-eigenvalues']}", "gate.require[0]: expected a claim id"),
        (
            ["prove"],
            "mu = 0.1\ngraph = {family = 'path', agents = 5}",
            "graphs: expected either graph or graphs, got both",
        ),
        (["region"], "mu = [0.1, 0.2]", "mu: expected a number, got an interval"),
        (["region", "--plot", "x.svg"], "", "--plot is not supported yet with [[graphs]]"),
        (["region", "--solver", "lmi"], "", "--solver is not supported yet with [[graphs]]"),
        (["kernel"], "mu = 0.1", "graphs: expected one [graph]"),
        (["report"], "mu = 0.1", "graphs: expected one [graph]"),
        (["simulate"], "mu = 0.1", "graphs: expected one [graph]"),
    ],
)
def test_what_is_refused(verify: Verify, tmp_path: Path, arguments: list[str], numbers: str, message: str) -> None:
    command, *options = arguments
    run = verify(command, write(tmp_path, numbers), *options)
    assert (run.returncode, run.stdout) == (2, "")
    assert message in run.stderr
    assert run.stderr.count("\n") == 1


@pytest.mark.parametrize(
    ("graphs", "message"),
    [
        ("graphs = []\n", "graphs: expected 1 to 64 graphs, got a list of 0"),
        ("graphs = 1\n", "graphs: expected a list of tables, got 1"),
        ("[[graphs]]\nfamily = 'path'\nagents = 3\n" * 65, "graphs: expected 1 to 64 graphs, got a list of 65"),
        ("[[graphs]]\nfamily = 'path'\nagents = 3\n[[graphs]]\nfamily = 'path'\nagents = 4\n",
         "graphs[1]: expected 3 agents as before, got 4"),
        ("[[graphs]]\nfamily = 'path'\nagents = 3\n[[graphs]]\nfamily = 'paht'\nagents = 3\n", "graphs[1].family:"),
    ],
)  # fmt: skip
def test_sets_that_are_none(verify: Verify, tmp_path: Path, graphs: str, message: str) -> None:
    run = verify("prove", write(tmp_path, "mu = 0.1", graphs))
    assert (run.returncode, run.stdout) == (2, "")
    assert message in run.stderr
