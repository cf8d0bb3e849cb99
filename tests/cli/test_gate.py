"""``verify-design gate`` as a CI job runs it: answers, statuses, files, and what must not break it."""

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from subprocess import CompletedProcess
from xml.etree.ElementTree import parse

import pytest

from fomas_verify.cli import main

Verify = Callable[..., CompletedProcess[str]]
Gate = Callable[..., CompletedProcess[str]]
GOOD = 'name = "{}"\nalpha = 0.9\nmu = 0.2\n[graph]\nfamily = "complete"\nagents = 4\n'
FALSE = 'name = "{}"\nalpha = 0.9\n mu = 1\n[graph]\nfamily = "directed-cycle"\nagents = 5\n'
# beta < 2^alpha - 1 < sigma of a digraph that is not symmetric: the bounds tell nothing of eqL3.
LARGE = (
    'name = "{}"\nalpha = 0.99985\nmu = 0.5\n[graph]\nfamily = "directed-cycle"\nagents = 201\n'
    '[gate]\nrequire = ["control-norm-bound"]\n'
)
BROKEN = 'name = "{}"\nalpha = 2\n'


def write(folder: Path, **texts: str) -> Path:
    folder.mkdir(exist_ok=True)
    for name, text in texts.items():
        (folder / f"{name}.design.toml").write_text(text.format(name))
    return folder


@pytest.fixture
def gate(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, checkout: Path) -> Gate:
    """Run the command in this process."""
    monkeypatch.chdir(checkout)

    def call(*arguments: object, **environment: str) -> CompletedProcess[str]:
        monkeypatch.setenv("GITHUB_ACTIONS", "")
        for name, value in environment.items():
            monkeypatch.setenv(name, value)
        capsys.readouterr()
        status = main(["gate", "--jobs", "1", *map(str, arguments)])
        return CompletedProcess([], status, *capsys.readouterr())

    return call


def words(run: CompletedProcess[str]) -> list[str]:
    return [line.split()[0] for line in run.stdout.splitlines()]


def test_the_examples_pass_by_folder_and_by_name(verify: Verify, checkout: Path) -> None:
    count = len(list((checkout / "examples").glob("*.toml")))
    for paths in (["examples"], sorted((checkout / "examples").glob("*.toml"))):
        run = verify("gate", *paths)
        assert (run.returncode, run.stderr) == (0, "")
        skipped = ["skipped:"] if paths == ["examples"] else []  # the grid below it
        assert words(run) == [*["pass"] * count, str(count), *skipped]


@pytest.mark.parametrize("jobs", [1, 2])
def test_every_answer_in_the_order_of_the_input(verify: Verify, tmp_path: Path, jobs: int) -> None:
    write(tmp_path, a=GOOD, b=FALSE, c=BROKEN, d=LARGE, e=GOOD)
    run = verify("gate", tmp_path, "--jobs", jobs)
    assert (run.returncode, run.stderr) == (1, "")
    assert words(run) == ["pass", "fail", "error", "undecided", "pass", "5"]
    lines = run.stdout.splitlines()
    assert "gain-bound refuted: mu = 1 = 1/Delta_max = 1" in lines[1]
    assert "remedy: lower mu" in lines[1]
    assert lines[2].endswith("c.design.toml: alpha: expected a number between 0 and 1, both excluded, got 2")
    assert lines[5] == "5 designs: 2 pass, 1 fail, 1 error, 1 undecided"
    backwards = verify("gate", *sorted(tmp_path.iterdir(), reverse=True), "--jobs", jobs)
    assert backwards.stdout.splitlines()[:5] == lines[4::-1]


@pytest.mark.parametrize(
    ("texts", "status"),
    [
        ({"a": GOOD}, 0),
        ({"a": GOOD, "b": LARGE}, 3),
        ({"a": GOOD, "b": LARGE, "c": BROKEN}, 2),
        ({"a": BROKEN, "b": FALSE, "c": LARGE}, 1),
        ({}, 2),
    ],
)
def test_the_first_of_4_1_2_3_0(gate: Gate, tmp_path: Path, texts: dict[str, str], status: int) -> None:
    assert gate(write(tmp_path, **texts)).returncode == status


def test_no_design_is_status_2_even_when_quiet(gate: Gate, tmp_path: Path) -> None:
    (tmp_path / "x.toml").write_text("a = 1\n")
    run = gate(tmp_path, "--quiet")
    assert (run.returncode, run.stderr) == (2, "")
    assert run.stdout.splitlines()[0] == "no design found"


def test_undecided_never_passes(gate: Gate, tmp_path: Path) -> None:
    near = GOOD.replace("mu = 0.2", "mu = 0.1\nx0 = [1, 1, 1, 1]")
    run = gate(write(tmp_path, a=LARGE, b=near), "--require", "control-norm-bound")
    assert (run.returncode, words(run)) == (3, ["undecided", "pass", "2"])


def test_require_for_all(gate: Gate, tmp_path: Path) -> None:
    own = GOOD + '[gate]\nrequire = ["memory-inequality"]\n'
    write(tmp_path, a=own, b=FALSE)
    run = gate(tmp_path, "--require", "graph-assumption", "--json")
    assert [x["required"] for x in json.loads(run.stdout)["designs"]] == [["graph-assumption"]] * 2
    assert run.returncode == 0
    both = json.loads(gate(tmp_path, "--require", "design,graph-assumption", "--json").stdout)["designs"]
    assert both[0]["required"] == ["memory-inequality", "graph-assumption"]
    assert len(both[1]["required"]) == 6
    assert [x["status"] for x in both] == [0, 1]
    lacking = gate(tmp_path / "a.design.toml", "--require", "trajectory-norm-bound")
    assert lacking.returncode == 2
    assert "x0: trajectory-norm-bound needs x0; got no x0" in lacking.stdout


def test_an_uncertain_design(gate: Gate, tmp_path: Path) -> None:
    """Every member of the first passes; mu = 1/3 of the second breaks (15)."""
    wide = GOOD.replace("0.9", '["0.88", "0.92"]').replace("0.2", '["0.19", "0.21"]')
    broken = wide.replace('"0.21"', '"1/3"')
    run = gate(write(tmp_path / "in", a=wide, b=broken), "--cache", tmp_path / "cache")
    assert (run.returncode, words(run)) == (1, ["pass", "fail", "2"])
    assert "gain-bound refuted" in run.stdout
    assert gate(tmp_path / "in" / "a.design.toml", "--require", "trajectory-norm-bound").returncode == 2
    assert gate(tmp_path / "in", "--cache", tmp_path / "cache").stdout == run.stdout


def test_two_designs_with_one_name(gate: Gate, tmp_path: Path) -> None:
    write(tmp_path, a=GOOD, b="# b\n" + GOOD.replace("{}", "a"), c=GOOD)
    run = gate(tmp_path, "--json")
    first, second, third = json.loads(run.stdout)["designs"]
    assert (run.returncode, first["status"], second["status"], third["status"]) == (2, 0, 2, 0)
    (finding,) = second["findings"]
    assert finding["reason"].startswith("name: expected a name of its own, got 'a', the name of ")
    assert finding["line"] == 2


def test_quiet_says_only_what_does_not_pass(gate: Gate, tmp_path: Path) -> None:
    write(tmp_path, a=GOOD, b=GOOD)
    run = gate(tmp_path, "-q")
    assert (run.returncode, run.stdout, run.stderr) == (0, "", "")
    write(tmp_path, c=FALSE)
    run = gate(tmp_path, "--quiet")
    assert (run.returncode, words(run)) == (1, ["fail"])


def test_files_and_annotations(gate: Gate, tmp_path: Path) -> None:
    write(tmp_path / "in", a=GOOD, b=FALSE)
    out = tmp_path / "out"
    out.mkdir()
    files = [x for kind in ("junit", "sarif", "markdown") for x in (f"--{kind}", out / kind)]
    run = gate(tmp_path / "in", *files, GITHUB_ACTIONS="true")
    assert run.returncode == 1
    assert sorted(path.name for path in out.iterdir()) == ["junit", "markdown", "sarif"]
    (failure, *_) = parse(out / "junit").iter("failure")
    assert "mu = 1 = 1/Delta_max = 1" in failure.text
    places = [
        result["locations"][0]["physicalLocation"]["region"]
        for result in json.loads((out / "sarif").read_text())["runs"][0]["results"]
    ]
    assert places == [{"startLine": 3, "startColumn": 2}] * 4
    assert "| fail | b |" in (out / "markdown").read_text()
    assert run.stdout.count("\n::error file=") == 4
    repeated = gate(tmp_path / "in", "--junit", out / "again", "--jobs", 1)
    assert "::error" not in repeated.stdout
    assert (out / "again").read_bytes() == (out / "junit").read_bytes()
    machine = gate(tmp_path / "in", "--json", GITHUB_ACTIONS="true")
    assert json.loads(machine.stdout)["status"] == 1
    assert machine.stderr.count("::error") == 4


def test_an_output_that_cannot_be_written(gate: Gate, tmp_path: Path) -> None:
    write(tmp_path / "in", a=GOOD)
    bad, good = tmp_path / "no" / "x.xml", tmp_path / "x.sarif"
    run = gate(tmp_path / "in", "--junit", bad, "--sarif", good, "--markdown", tmp_path)
    assert (run.returncode, words(run)) == (2, ["pass", "1"])
    assert [line.split(": ")[1] for line in run.stderr.splitlines()] == [str(bad), str(tmp_path)]
    assert good.exists()
    write(tmp_path / "in", b=FALSE)
    assert gate(tmp_path / "in", "--junit", bad).returncode == 1
    for option in ("--cache", "-o"):
        run = gate(tmp_path / "in", option, good)
        assert (run.returncode, run.stdout, run.stderr.count("\n")) == (2, "", 1)


@pytest.mark.parametrize("option", ["--junit", "--sarif", "--markdown"])
def test_an_output_takes_no_designs_place(gate: Gate, tmp_path: Path, option: str) -> None:
    design = write(tmp_path, a=GOOD) / "a.design.toml"
    for call in ([design, option, design], [design, "--junit", tmp_path / "x", "--sarif", tmp_path / "." / "x"]):
        run = gate(*call)
        assert (run.returncode, run.stdout, run.stderr.count("\n")) == (2, "", 1)
        assert "expected a file of its own" in run.stderr
    assert design.read_text() == GOOD.format("a")
    assert [path.name for path in tmp_path.iterdir()] == ["a.design.toml"]


@pytest.mark.parametrize(
    "arguments",
    [
        [],
        [""],
        ["examples", ""],
        ["examples", "--jobs", "0"],
        ["examples", "--jobs", "x"],
        ["examples", "--require", "gain"],
        ["examples", "--require", ""],
        ["examples", "--loss", "2"],
        ["examples", "--loss", "-0.1"],
        ["examples", "--loss", "1/0"],
        ["examples", "--loss", "0.1e1"],
        ["examples", "--loss", "٣%"],
    ],
)
def test_a_wrong_call(gate: Gate, arguments: list[str]) -> None:
    run = gate(*arguments)
    assert (run.returncode, run.stdout, run.stderr.count("\n")) == (2, "", 1)


def test_the_cache_is_checked_again(gate: Gate, tmp_path: Path) -> None:
    write(tmp_path / "in", a=GOOD, b=FALSE)
    cache = tmp_path / "cache"
    call = (tmp_path / "in", "--cache", cache)
    first = gate(*call)
    kept = {path.name: path.read_text() for path in cache.iterdir()}
    assert len(kept) == 2
    assert gate(*call).stdout == first.stdout == gate(tmp_path / "in").stdout
    for damage in (
        lambda text: text.replace('"verdict": "refuted"', '"verdict": "proved"').replace('"k": 0', ""),
        lambda text: "{",
        lambda text: text.replace('"mu": "1/5"', '"mu": "1/6"').replace('"mu": "1"', '"mu": "1/6"'),
        lambda text: max(kept.values()),
        lambda text: min(kept.values()),
    ):
        for name, text in kept.items():
            (cache / name).write_text(damage(text))
        run = gate(*call)
        assert (run.returncode, run.stdout, run.stderr) == (1, first.stdout, "")


def test_a_kept_certificate_saves_the_proof(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    folder, cache = write(tmp_path / "in", a=GOOD), tmp_path / "cache"
    deciding = __import__("fomas_verify.gate.deciding", fromlist=["prove"])
    assert main(["gate", str(folder), "--cache", str(cache)]) == 0
    calls: list[object] = []
    monkeypatch.setattr(deciding, "prove", lambda *a, **k: calls.append(a))
    assert main(["gate", str(folder), "--cache", str(cache)]) == 0
    assert calls == []
    (folder / "a.design.toml").write_text(GOOD.format("a") + '[gate]\nrequire = ["gain-bound"]\n')
    assert main(["gate", str(folder), "--cache", str(cache)]) == 4
    assert len(calls) == 1


ENTRY = """
import dataclasses, os, signal, sys, types
import fomas_verify.gate.deciding as deciding
from fomas_verify._entry import main

signal.signal(signal.SIGINT, signal.default_int_handler)  # a background job starts with it ignored
whole = deciding.prove

def broken(design, **options):
    {}

deciding.prove = lambda design, **options: (broken if design.name == "b" else whole)(design, **options)
sys.argv[0] = "verify-design"
main()
"""
FALSIFIED = """proof = whole(design, **options)
    text = proof.certificate().replace('"verdict": "proved"', '"verdict": "refuted"', 1)
    return types.SimpleNamespace(certificate=lambda: text, decisions=proof.decisions)"""
INJECTIONS = {
    FALSIFIED: "the checker cannot read the certificate: $.claims[0].witness: ",
    FALSIFIED.replace('"verdict": "proved"', '"lower": "1/5"').replace('"verdict": "refuted"', '"lower": "1/4"'): (
        "the checker refuses the certificate: mu: "
    ),
    "return whole(dataclasses.replace(design, mu=design.mu / 2), **options)": "the certificate is about another design",
    "return 1 / 0": "ZeroDivisionError: division by zero",
    "os._exit(9)": "the process that decided it was ended from outside",
}


@pytest.mark.parametrize("injected", INJECTIONS)
def test_an_internal_error_fails_its_design_alone(checkout: Path, tmp_path: Path, injected: str) -> None:
    folder = write(tmp_path, a=GOOD, b=GOOD, c=FALSE, d=GOOD)
    command = [sys.executable, "-c", ENTRY.format(injected), "gate", str(folder), "--jobs", "2"]
    run = subprocess.run(command, cwd=checkout, capture_output=True, text=True, check=False)
    assert (run.returncode, run.stderr) == (4, "")
    assert words(run) == ["pass", "internal", "fail", "pass", "4"]
    assert f"b.design.toml: {INJECTIONS[injected]}" in run.stdout.splitlines()[1]


@pytest.mark.parametrize(("number", "status"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_an_interruption_leaves_nothing_half_written(
    checkout: Path, tmp_path: Path, number: signal.Signals, status: int
) -> None:
    folder = write(tmp_path / "in", **{f"d{i:04}": GOOD for i in range(800)})
    out = tmp_path / "out"
    out.mkdir()
    arguments = ["gate", folder, "-j", "2", "--junit", out / "j", "--sarif", out / "s", "--markdown", out / "m"]
    with subprocess.Popen(
        [sys.executable, "-c", ENTRY.format("pass"), *map(str, arguments), "--cache", str(out / "cache")],
        cwd=checkout,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    ) as process:
        assert process.stdout is not None
        process.stdout.readline()
        os.killpg(process.pid, number)
        _, error = process.communicate(timeout=60)
    assert (process.returncode, error.strip()) == (status, "")
    assert [path.name for path in out.iterdir()] == ["cache"]
    for path in (out / "cache").iterdir():
        assert path.suffix == ".json"
        assert json.loads(path.read_text())["format"] == "fomas-certificate/1"
    for _ in range(100):
        try:
            os.killpg(process.pid, 0)
        except ProcessLookupError:
            return
        time.sleep(0.05)
    pytest.fail("a process of the gate is left")


def test_progress_only_on_a_terminal(checkout: Path, tmp_path: Path) -> None:
    folder = write(tmp_path, a=GOOD, b=GOOD)
    pty = pytest.importorskip("pty")
    shown = {}
    for options in ((), ("--quiet",)):
        leader, follower = pty.openpty()
        command = [sys.executable, "-m", "fomas_verify", "gate", str(folder), *options]
        run = subprocess.run(command, cwd=checkout, stdout=subprocess.PIPE, stderr=follower, check=False)
        os.close(follower)
        os.set_blocking(leader, False)
        try:
            shown[options] = os.read(leader, 10_000).decode()
        except OSError:  # nothing was written, and no writer is left
            shown[options] = ""
        os.close(leader)
        assert run.returncode == 0
    assert "1/2" in shown[()]
    assert shown["--quiet",] == ""
