"""``init``, ``schema``, ``completion``, ``--json`` and ``--help``."""

import json
import shutil
import subprocess
import tomllib
from collections.abc import Callable
from pathlib import Path
from subprocess import CompletedProcess

import pytest

from fomas_verify.cli.app import COMMANDS
from fomas_verify.sweep.grid_schema import grid_schema

Verify = Callable[..., CompletedProcess[str]]
PAPER = "examples/paper.toml"


def test_what_init_writes_passes(verify: Verify, tmp_path: Path) -> None:
    folder = tmp_path / "new" / "designs"
    run = verify("init", folder)
    path = folder / "plant.design.toml"
    assert (run.returncode, run.stdout, run.stderr) == (0, f"wrote {path}\n", "")
    text = path.read_text()
    assert {"format", "alpha", "gamma", "h", "graph", "gate"} <= set(tomllib.loads(text))
    assert [line for line in text.splitlines() if len(line) > 120] == []
    assert verify("prove", path).returncode == verify("gate", tmp_path).returncode == 0


def test_what_init_proposes_in_comments_is_right(verify: Verify, tmp_path: Path) -> None:
    """Each commented key, uncommented."""
    verify("init", tmp_path)
    path = tmp_path / "plant.design.toml"
    text = path.read_text()
    for key in ("x0 ", "horizon ", "settle_to "):
        text = text.replace(f"# {key}", key)
    path.write_text(text.replace('    # "repaired', '    "repaired').replace('# "trajectory', '"trajectory'))
    names = json.loads(verify("gate", path, "--json").stdout)["designs"][0]["required"]
    assert names[-2:] == ["repaired-condition", "trajectory-norm-bound"]
    for form in ("edges", "family"):
        head, _, tail = text.partition("adjacency = [")
        tail = tail.partition("\n]\n")[2].replace("# agents", "agents").replace(f"# {form}", form)
        path.write_text(head.replace("x0 ", "# x0 ") + tail)
        assert verify("prove", path).returncode in (0, 1)


def test_init_overwrites_nothing(verify: Verify, tmp_path: Path) -> None:
    path = tmp_path / "plant.design.toml"
    path.symlink_to("nowhere")
    run = verify("init", tmp_path)
    assert (run.returncode, run.stdout) == (2, "")
    assert run.stderr == f"verify-design: {path}: exists already, and is left as it is\n"
    assert not (tmp_path / "nowhere").exists()


@pytest.mark.parametrize("kind", ["design", "certificate"])
def test_schema_prints_what_the_package_ships(verify: Verify, checkout: Path, kind: str) -> None:
    run = verify("schema", kind)
    assert (run.returncode, run.stderr) == (0, "")
    assert run.stdout == (checkout / "fomas_verify" / kind / f"{kind}.schema.json").read_text()
    assert json.loads(run.stdout)["title"] == f"fomas-{kind}/1"


def test_schema_prints_that_of_grids(verify: Verify) -> None:
    run = verify("schema", "grid")
    assert (run.returncode, run.stderr) == (0, "")
    assert json.loads(run.stdout) == grid_schema()


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        (["ga"], ["gate"]),
        (["k"], ["kernel"]),
        (["gate", "--ju"], ["--junit"]),
        (["gate", "--require", "gain"], ["gain-bound"]),
        (["check", "--require", "gain-bound,perr"], ["gain-bound,perron-eigenvalues"]),
        (["schema", ""], ["design", "certificate", "grid"]),
        (["completion", "z"], ["zsh"]),
        (["nothing"], []),
    ],
)
def test_completion_completes(verify: Verify, words: list[str], expected: list[str]) -> None:
    environment = {"COMP_WORDS": " ".join(["verify-design", *words]), "COMP_CWORD": str(len(words))}
    run = verify(_VERIFY_DESIGN_COMPLETE="bash_complete", **environment)
    assert [line.partition(",")[2] for line in run.stdout.splitlines() if line] == expected


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_the_completion_script(verify: Verify, tmp_path: Path, shell: str) -> None:
    run = verify("completion", shell)
    assert (run.returncode, run.stderr) == (0, "")
    assert "_VERIFY_DESIGN_COMPLETE" in run.stdout
    if shutil.which(shell):
        path = tmp_path / "script"
        path.write_text(run.stdout)
        subprocess.run([shell, "-n", path], check=True)


def test_bash_takes_the_script(verify: Verify, tmp_path: Path) -> None:
    """Sourced by a real bash, it registers for the program."""
    script = verify("completion", "bash").stdout + "\ncomplete -p verify-design\n"
    run = subprocess.run(["bash", "--norc", "-c", script], capture_output=True, text=True, check=True)
    assert run.stdout.split()[-3:] == ["-F", "_verify_design_completion", "verify-design"]


def test_check_in_json(verify: Verify, tmp_path: Path) -> None:
    certificate = tmp_path / "c.json"
    verify("prove", PAPER, "-o", certificate)
    run = verify("check", certificate, "--design", PAPER, "--require", "design,control-norm-bound", "--json")
    document = json.loads(run.stdout)
    assert (run.returncode, document["status"], document["differences"]) == (1, 1, [])
    assert [shortfall["id"] for shortfall in document["shortfalls"]] == ["control-norm-bound"]
    assert len(document["required"]) == 7
    assert {outcome["status"] for outcome in document["outcomes"]} == {"accepted"}
    other = json.loads(verify("check", certificate, "--design", "examples/ring10.toml", "--json").stdout)
    assert (other["status"], other["shortfalls"]) == (1, [])
    assert {"gamma", "edges"} <= set(other["differences"])


def test_check_of_an_uncertain_design(verify: Verify, tmp_path: Path) -> None:
    design, other, certificate = tmp_path / "a.toml", tmp_path / "b.toml", tmp_path / "c.json"
    text = 'alpha = ["0.88", "0.92"]\nmu = 0.2\n[graph]\nfamily = "complete"\nagents = 4\n'
    design.write_text(text)
    verify("prove", design, "-o", certificate)
    same = verify("check", certificate, "--design", design, "--require", "design")
    assert (same.returncode, "required   all 6 claims are proved" in same.stdout) == (0, True)
    for changed in (text.replace("0.92", "0.921"), text.replace('["0.88", "0.92"]', "0.88")):
        other.write_text(changed)
        run = verify("check", certificate, "--design", other)
        assert (run.returncode, run.stdout.splitlines()[-1]) == (1, "Refused.")
        assert f"not the design of {other}: alpha differ" in run.stdout


def test_kernel_and_selftest_in_json(verify: Verify) -> None:
    rows = json.loads(verify("kernel", PAPER, "--terms", 2, "--at", 10**12, "--digits", 20, "--json").stdout)
    assert [row["j"] for row in rows] == [1, 2, 10**12]
    assert rows[0]["f"].startswith("-0.13393401692638516803")  # 2^0.9 - 2
    assert rows[2]["r"] is None
    tests = json.loads(verify("selftest", "--json").stdout)
    assert tests["wrong"] == 0
    assert all(test["right"] for test in tests["tests"])
    assert len(tests["tests"]) > 10


@pytest.mark.parametrize("command", [None, *COMMANDS])
def test_help_has_an_example(verify: Verify, command: str | None) -> None:
    run = verify(*filter(None, [command]), "--help")
    assert (run.returncode, run.stderr) == (0, "")
    assert f"Example:  verify-design {command or ''}" in run.stdout


@pytest.mark.parametrize("command", ["prove", "check", "kernel", "gate", "selftest"])
def test_what_prints_a_table_prints_json_too(verify: Verify, command: str) -> None:
    assert "--json" in verify(command, "--help").stdout
