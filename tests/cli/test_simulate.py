"""``verify-design simulate``: the table, the files, and each way to be refused."""

import csv
import io
import json
import os
import re
import sys
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from subprocess import CompletedProcess
from typing import Any

import pytest

from fomas_verify.cli import main
from fomas_verify.cli.simulate_exactly import progress_bar
from fomas_verify.simulate import loop, plant

Verify = Callable[..., CompletedProcess[str]]
PAPER = "examples/paper.toml"
PAIR: dict[str, Any] = {
    "alpha": "1/2", "gamma": "1/4", "h": 1, "x0": [0, 1], "graph": {"family": "path", "agents": 2},
}  # fmt: skip


@pytest.fixture
def call(checkout: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Verify:
    """The command line in this process, in the checkout."""
    monkeypatch.chdir(checkout)

    def start(*arguments: object) -> CompletedProcess[str]:
        words = list(map(str, arguments))
        status = main(words)
        seen = capsys.readouterr()
        return CompletedProcess(words, status, seen.out, seen.err)

    return start


def rows_of(path: Path) -> list[list[str]]:
    return list(csv.reader(path.read_text().splitlines()))


def design(folder: Path, **changes: Any) -> Path:
    path = folder / "pair.json"
    path.write_text(json.dumps({key: x for key, x in {**PAIR, **changes}.items() if x is not None}))
    return path


def refused(run: CompletedProcess[str], *words: str) -> None:
    assert run.returncode == 2, run.stderr
    assert run.stdout == ""
    assert run.stderr.count("\n") == 1
    assert all(word in run.stderr for word in words), run.stderr


def test_the_table(verify: Verify) -> None:
    run = verify("simulate", PAPER)
    assert (run.returncode, run.stderr) == (0, "")
    assert "r is the distance from 3.2" in run.stdout
    rows = {tuple(line.split()[-4:-2]): line.split()[-2:] for line in run.stdout.splitlines() if "error r" in line}
    assert "0.010184162" in run.stdout
    assert "0.20473793" in run.stdout
    assert "0.012117836" in run.stdout
    assert len(rows) == 2
    assert "bounded at every sample as certified: mean(x_k) - limit, norm(x_k - limit), norm u_k by peak" in run.stdout


def test_the_csv_file(call: Verify, tmp_path: Path) -> None:
    path = tmp_path / "loop.csv"
    run = call("simulate", PAPER, "--samples", 25, "--controller", "proposed, memoryless", "--csv", path)
    assert run.returncode == 0, run.stderr
    rows = rows_of(path)
    assert rows[0] == ["k", "t", "controller", *(f"x_{i}" for i in range(1, 6)), *(f"u_{i}" for i in range(1, 6))]
    assert [(row[0], row[2]) for row in rows[1:]] == [
        (str(k), c) for k in range(26) for c in ("memoryless", "proposed")
    ]
    last = {row[2]: [float(x) for x in row[3:8]] for row in rows[41:43]}
    assert abs(sum(abs(x - 3.2) for x in last["memoryless"]) / 5 - 0.20473793) < 1e-8
    assert abs(sum(abs(x - 3.2) for x in last["proposed"]) / 5 - 0.01018416) < 1e-8


def test_truncated_and_between(call: Verify, tmp_path: Path) -> None:
    path = tmp_path / "loop.csv"
    run = call("simulate", PAPER, "--samples", 5, "--controller", "truncated", "--keep", 3, "--between", 2,
                 "--csv", path)  # fmt: skip
    assert run.returncode == 0, run.stderr
    assert f"leaves c_M = {4**0.9 - 3**0.9:.8g} of the plant's memory" in run.stdout
    assert "no longer geometric" in run.stdout
    assert len(path.read_text().splitlines()) == 1 + 6 + 5 * 2


def test_a_controller_tuned_for_another_order(call: Verify) -> None:
    run = call("simulate", PAPER, "--alpha-controller", "0.85")
    assert run.returncode == 0, run.stderr
    assert "tuned for another order" in run.stdout
    assert "0.010184162" not in run.stdout
    assert call("simulate", PAPER, "--alpha-controller", "9/10").stdout == call("simulate", PAPER).stdout


def test_figures(call: Verify, tmp_path: Path) -> None:
    folder = tmp_path / "a" / "b"
    run = call("simulate", PAPER, "--samples", 40, "--plot", folder, "--format", "svg")
    assert (run.returncode, run.stderr) == (0, "")
    assert len(list(folder.iterdir())) == 8
    assert all(path.read_bytes().startswith(b"<?xml") for path in folder.iterdir())


def test_many_digits(call: Verify, tmp_path: Path) -> None:
    """x_1 = x_0 - mu L x_0 exactly; floats would end after 17 digits."""
    path = tmp_path / "loop.csv"
    run = call("simulate", design(tmp_path, gamma=None, mu="1/3"), "--samples", 2, "--digits", 50, "--csv", path)
    assert run.returncode == 0, run.stderr
    rows = rows_of(path)
    assert rows[0] == ["k", "t", "controller", "x_1", "x_2", "u_1", "u_2"]
    for row in rows[3:5]:
        assert abs(Fraction(row[3]) - Fraction(1, 3)) < Fraction(1, 10**49)
        assert abs(Fraction(row[4]) - Fraction(2, 3)) < Fraction(1, 10**49)


def test_enclosed(call: Verify, tmp_path: Path) -> None:
    path = tmp_path / "loop.csv"
    pair = design(tmp_path, gamma=None, mu="1/3")
    run = call("simulate", pair, "--samples", 3, "--between", 1, "--enclose", "--csv", path)
    assert run.returncode == 0, run.stderr
    assert len(re.findall(r"each state and input enclosed within [\d.]+e-\d\d", run.stdout)) == 2
    rows = rows_of(path)
    assert rows[0][3:7] == ["x_1_lower", "x_1_upper", "x_2_lower", "x_2_upper"]
    assert [row[0] for row in rows[1:]] == list("00001111222233")
    third = next(row for row in rows if row[:3] == ["1", "1", "proposed"])
    assert Fraction(third[3]) <= Fraction(1, 3) <= Fraction(third[4])
    assert 0 <= Fraction(third[4]) - Fraction(third[3]) < Fraction(1, 10**35)
    alone = call("simulate", pair, "--samples", 3, "--enclose")
    assert alone.stdout.splitlines()[-1].startswith("memoryless: each state and input enclosed within")


def test_no_enclosure_is_status_3(call: Verify, tmp_path: Path) -> None:
    path = tmp_path / "loop.csv"
    run = call("simulate", design(tmp_path, gamma=30), "--samples", 5000, "--enclose", "--csv", path)
    assert run.returncode == 3
    assert "pair.json: proposed: no enclosure found" in run.stderr
    assert not path.exists()


def test_figures_of_an_unstable_design(call: Verify, tmp_path: Path) -> None:
    pytest.importorskip("matplotlib", reason="matplotlib comes with the extra plot")
    run = call("simulate", design(tmp_path, gamma=30), "--samples", 5000, "--plot", tmp_path / "figures")
    assert (run.returncode, run.stderr) == (0, "")
    assert {path.stem for path in (tmp_path / "figures").iterdir()} >= {"states-proposed", "states-memoryless"}


def test_mu_in_place_of_gamma(call: Verify, tmp_path: Path) -> None:
    run = call("simulate", design(tmp_path, gamma=None, mu="1/4"))
    assert run.returncode == 0, run.stderr
    assert "r is the distance from 0.5" in run.stdout


def test_an_unbalanced_graph_agrees_on_a_weighted_mean(call: Verify, tmp_path: Path) -> None:
    graph = {"agents": 3, "edges": [[1, 2], [2, 3], [3, 1], [1, 3]]}  # weights 1/2, 1/4, 1/4
    run = call("simulate", design(tmp_path, x0=[1, 0, 0], graph=graph), "--controller", "proposed")
    assert run.returncode == 0, run.stderr
    assert "r is the distance from 0.5\n" in run.stdout
    assert "not strongly connected and balanced" in run.stdout
    assert "k = 200  below" in run.stdout


def test_no_common_limit(call: Verify, tmp_path: Path) -> None:
    graph = {"agents": 3, "edges": [[1, 2], [3, 2]]}
    run = call("simulate", design(tmp_path, x0=[1, 0, 3], graph=graph))
    assert run.returncode == 0, run.stderr
    assert "no common limit: no agent reaches every other" in run.stdout


def test_ten_thousand_agents(call: Verify, tmp_path: Path) -> None:
    """On a torus, from 1 in one column of agents and 0 elsewhere: every agent of a column sees what a cycle's would."""
    x0 = [int(i % 100 == 0) for i in range(10_000)]
    graph = {"family": "torus", "shape": [100, 100]}
    path = design(tmp_path, alpha="9/10", gamma="1/5", h="1/2", x0=x0, graph=graph)
    run = call("simulate", path, "--samples", 40, "--controller", "proposed, memoryless")
    assert run.returncode == 0, run.stderr
    alone = {"x0": [1] + 99 * [0], "graph": {"family": "cycle", "agents": 100}}
    cycle = call("simulate", design(tmp_path, alpha="9/10", gamma="1/5", h="1/2", **alone), "--samples", 40)

    def errors(text: str) -> list[str]:
        return [line for line in text.splitlines() if "mean absolute error" in line]

    assert errors(run.stdout) == errors(cycle.stdout)
    assert len(errors(run.stdout)) == 2


def test_more_agents_than_are_listed_elsewhere(call: Verify, tmp_path: Path) -> None:
    path = tmp_path / "loop.csv"
    graph = {"family": "torus", "shape": [101, 100]}
    torus = design(tmp_path, alpha="9/10", gamma="1/5", h="1/2", x0=10_100 * [3], graph=graph)
    run = call("simulate", torus, "--samples", 1, "--controller", "proposed", "--csv", path)
    assert run.returncode == 0, run.stderr
    for row in rows_of(path)[1:]:
        assert {float(x) for x in row[3:10_103]} == {3.0}
        assert {float(x) for x in row[10_103:]} == {0.0}


def test_too_many_agents_are_refused_before_they_are_built(call: Verify, tmp_path: Path) -> None:
    path = design(tmp_path, x0=None, graph={"family": "cycle", "agents": 100_001})
    refused(call("simulate", path), "100001 agents, more than 100000")


def test_an_unstable_design_is_stopped(call: Verify, tmp_path: Path) -> None:
    path = tmp_path / "loop.csv"
    run = call("simulate", design(tmp_path, gamma=30), "--samples", 5000, "--csv", path)
    assert run.returncode == 0, run.stderr
    assert run.stdout.count("the loop is unstable: its numbers pass 1e100 at k = ") == 2
    rows = rows_of(path)
    assert 100 < len(rows) < 1000
    assert not {"inf", "-inf", "nan"} & {x for row in rows for x in row}


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"x0": None}, ["x0: simulate needs x0; got no x0"]),
        ({"h": None}, ["h: simulate needs h; got no h"]),
        ({"gamma": None}, ["simulate needs mu, or gamma and h"]),
        ({"x0": [1, 2, 3]}, ["x0"]),
        ({"alpha": ["1/2", "3/4"]}, ["alpha"]),
    ],
    ids=["no x0", "no h", "no gain", "x0 of another length", "an interval"],
)
def test_a_design_that_cannot_be_simulated(
    call: Verify, tmp_path: Path, changes: dict[str, Any], words: list[str]
) -> None:
    refused(call("simulate", design(tmp_path, **changes)), "pair.json", *words)


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["--samples", "0"], ["--samples", "0 is not in the range"]),
        (["--samples", "-3"], ["--samples"]),
        (["--samples", "many"], ["--samples"]),
        (["--samples", "10000000000000"], ["10000000000000 samples would need about", "TB of memory"]),
        (["--controller", "proposed,best"], ["'best'", "proposed, memoryless, truncated"]),
        (["--controller", ""], ["expected some of"]),
        (["--controller", "truncated"], ["--keep M"]),
        (["--keep", "5"], ["--keep M"]),
        (["--keep", "-1", "--controller", "truncated"], ["--keep"]),
        (["--alpha-controller", "1"], ["between 0 and 1"]),
        (["--alpha-controller", "1e-999999999"], ["between 0 and 1"]),
        (["--alpha-controller", "nan"], ["between 0 and 1"]),
        (["--between", "-1"], ["--between"]),
        (["--csv", "nowhere/at/all.csv"], ["nowhere/at/all.csv: cannot write"]),
        (["--csv", "fomas_verify"], ["fomas_verify: cannot write"]),
        (["--format", "bmp"], ["bmp"]),
        (["--digits", "30"], ["--csv FILE"]),
        (["--digits", "5", "--csv", "x.csv"], ["--digits"]),
        (["--parquet", "x.parquet", "--enclose"], ["--parquet holds floats"]),
        (["--digits", "20", "--samples", "30000", "--csv", "x.csv"], ["too many for mpmath"]),
    ],
    ids=lambda x: " ".join(x) if x and x[0].startswith("--") else "",
)
def test_a_call_that_is_refused(call: Verify, options: list[str], words: list[str]) -> None:
    refused(call("simulate", PAPER, *options), *words)


def test_a_figure_folder_that_cannot_be_written(call: Verify, tmp_path: Path) -> None:
    """Then nothing is written, the table neither."""
    taken, table = tmp_path / "file", tmp_path / "loop.csv"
    taken.write_text("mine")
    refused(call("simulate", PAPER, "--plot", taken, "--csv", table), "cannot write")
    assert taken.read_text() == "mine"
    assert not table.exists()


@pytest.mark.parametrize("name", ["numpy", "scipy"])
def test_a_missing_extra_is_named(verify: Verify, tmp_path: Path, name: str) -> None:
    (tmp_path / f"{name}.py").write_text("raise ImportError('not here')\n")
    paths = os.pathsep.join([str(tmp_path), os.environ.get("PYTHONPATH", "")])
    refused(verify("simulate", PAPER, PYTHONPATH=paths), f"needs {name}", "pip install 'fomas_verify[simulate]'")


def test_a_wrong_certificate_is_status_4(
    checkout: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    from dataclasses import replace

    from fomas_verify.prover import sizes

    measure, table = sizes.measure, tmp_path / "loop.csv"

    def wrong(*arguments: Any, **options: Any) -> sizes.Sizes:
        found = measure(*arguments, **options)
        assert found.rate is not None
        return replace(found, rate=replace(found.rate, rho=found.rate.rho * 9 / 10))

    monkeypatch.setattr(sizes, "measure", wrong)
    assert main(["simulate", str(checkout / PAPER), "--csv", str(table)]) == 4
    seen = capsys.readouterr()
    assert seen.out == ""
    assert "proposed: norm(x_k - limit) is" in seen.err
    assert not table.exists()


def test_a_wrong_plant_is_status_4(
    checkout: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """The loop with a memory of another order than the plant's."""
    true = loop.approx_step_response
    monkeypatch.setattr(loop, "approx_step_response", lambda alpha, count: true(alpha + 1e-6, count))
    assert main(["simulate", str(checkout / PAPER)]) == 4
    assert "memoryless: the closed loop and the plant driven by its inputs" in capsys.readouterr().err
    assert plant.approx_step_response is true


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


@pytest.mark.parametrize("terminal", [True, False])
@pytest.mark.parametrize("long", [True, False])
def test_progress_is_shown_on_a_terminal_and_of_long_runs_only(
    monkeypatch: pytest.MonkeyPatch, terminal: bool, long: bool
) -> None:
    stream = Terminal() if terminal else io.StringIO()
    monkeypatch.setattr(sys, "stderr", stream)
    with progress_bar("memoryless", 100, shown=long) as progress:
        progress(40)
        progress(100)
    assert ("memoryless" in stream.getvalue() and "100%" in stream.getvalue()) == (terminal and long)
    assert (stream.getvalue() == "") == (not (terminal and long))


@pytest.mark.parametrize(("key", "value"), [("h", "1e200"), ("x0", "[1e101, 1, 1, 1, 1]")])
def test_numbers_beyond_floats_end_in_one_line(call: Verify, tmp_path: Path, key: str, value: str) -> None:
    lines = Path(PAPER).read_text().splitlines()
    changed = [f"{key} = {value}" if line.split("=")[0].strip() == key else line for line in lines]
    path = tmp_path / "far.toml"
    path.write_text("\n".join(changed))
    run = call("simulate", path, "--samples", 5)
    assert (run.returncode, run.stderr.count("\n")) == (2, 1)
    assert "pass 1e100 before its second sample" in run.stderr


def test_agents_that_agree_are_drawn(call: Verify, tmp_path: Path) -> None:
    path = tmp_path / "agreed.toml"
    path.write_text(Path(PAPER).read_text().replace("[4.5, 5, 6, 1.5, -1]", "[1, 1, 1, 1, 1]"))
    run = call("simulate", path, "--samples", 5, "--plot", tmp_path / "figures", "--format", "svg")
    assert run.returncode == 0, run.stderr
    assert (tmp_path / "figures" / "between-samples.svg").exists()


def test_two_outputs_need_a_file_each(call: Verify, tmp_path: Path) -> None:
    run = call("simulate", PAPER, "--samples", 5, "--csv", tmp_path / "a", "--parquet", tmp_path / "a")
    assert (run.returncode, list(tmp_path.iterdir())) == (2, [])


def test_json_says_what_the_table_says(call: Verify, tmp_path: Path) -> None:
    """K2 at mu L with eigenvalue z = 1 - 2 mu: the distance from the mean 1/2 is abs(z)^k / 2."""
    run = call("simulate", design(tmp_path), "--samples", 30, "--json", "--csv", tmp_path / "x.csv")
    assert (run.returncode, run.stderr) == (0, "")
    found = json.loads(run.stdout)
    assert (found["alpha"], found["gamma"], found["h"], found["limit"]) == ("1/2", "1/4", "1", ["1/2"])
    proposed, memoryless = found["controllers"]
    assert [proposed["controller"], memoryless["controller"]] == ["proposed", "memoryless"]
    z = 1 - 2 * 0.25 / 0.886226925452758
    assert proposed["mean_absolute_error"]["20"] == pytest.approx(z**20 / 2)
    assert (proposed["at"], proposed["samples"], proposed["stopped"]) == (1, 30, False)
    assert proposed["largest_norm_u"] == pytest.approx(0.25 * 2**0.5 * (z + 2 - 2**0.5))
    assert any("bounded at every sample as certified" in remark for remark in found["remarks"])
    apart = {"edges": [], "agents": 2}
    (lone, _) = json.loads(call("simulate", design(tmp_path, graph=apart), "--json").stdout)["controllers"]
    assert lone["mean_absolute_error"] is None
