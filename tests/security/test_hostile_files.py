"""Hostile files through the command line: one printable line, status 2, no traceback, nothing written."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.slow

GRAPH = '[graph]\nfamily = "path"\nagents = 3\n'
GOOD = f"alpha = 0.9\nmu = 0.1\n{GRAPH}"
JSON = '{"alpha": 0.9, "mu": 0.1, "graph": {"family": "path", "agents": 3}%s}'
FILES = {
    "escape.toml": f'name = "\\u001b[31mred\\u0007"\n{GOOD}',
    "annotation.toml": f'name = "x\\n::error::y"\n{GOOD}',
    "direction.toml": f'name = "\\u202egnp.exe"\n{GOOD}',
    "key.toml": f'"\\u001b[2J" = 1\n{GOOD}',
    "exponent.toml": f"alpha = 0.9\nmu = 1e999999999\n{GRAPH}",
    "digits.json": '{"alpha": 0.9, "mu": ' + "9" * 1_000_000 + "}",
    "deep.json": "[" * 100_000,
    "deep.toml": f"{GOOD}[graph.{'.'.join(['a'] * 10_000)}]\n",
    "tables.toml": "".join(f"[a.b{i}]\n" for i in range(50_000)),
    "twice.json": JSON % ', "mu": 0.2',
    "prototype.json": JSON % ', "__proto__": {"mu": 0.2}',
    "surrogate.json": JSON % ', "name": "\\ud800"',
    "infinity.json": JSON.replace("0.1", "Infinity") % "",
    "trailing.json": JSON % "" + "{}",
    "agents.toml": f'alpha = 0.9\nmu = 0.1\n[graph]\nfamily = "complete"\nagents = {2**64 + 1}\n',
    "complete.json": '{"alpha": 0.9, "mu": 0.1, "graph": {"family": "complete", "agents": 1e99}}',
    "edges.toml": "alpha = 0.9\nmu = 0.1\n[graph]\nagents = 3\nedges = [" + "[1,2]," * 100_000 + "]\n",
    "denominators.toml": "alpha = 0.9\nmu = 0.1\n[graph]\nagents = 3\nedges = "
    + str([[1, 2, f"1/{'7' * 300}"], [2, 3, 1], [3, 1, 1]]).replace("'", '"'),
    "null.toml": GOOD + "\0",
    "include.toml": f'include = "/etc/passwd"\n{GOOD}',
    "yaml.json": "!!python/object/apply:os.system ['touch ran']",
    "pickle.toml": "cos\nsystem\n(S'touch ran'\ntR.",
}
COMMANDS = ["prove", "region", "synthesize", "simulate", "kernel", "report", "gate", "check"]


def start(folder: Path, *arguments: object) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-m", "fomas_verify", *map(str, arguments)],
        cwd=folder,
        env={**os.environ, "GITHUB_ACTIONS": ""},
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
    )


@pytest.mark.parametrize("name", FILES)
def test_a_hostile_design_is_one_line(tmp_path: Path, name: str) -> None:
    (tmp_path / name).write_text(FILES[name], "utf-8", "surrogatepass")
    for command in ("prove", "gate"):
        done = start(tmp_path, command, name)
        said = done.stderr if command == "prove" else done.stdout.splitlines(keepends=True)[0]
        assert done.returncode == 2, (done.stdout, done.stderr)
        assert name in said
        assert said.count("\n") == 1
        assert said.removesuffix("\n").isprintable()
        assert len(said) < 1000
    assert [path.name for path in tmp_path.iterdir()] == [name]


@pytest.mark.parametrize("command", COMMANDS)
def test_every_command_refuses_in_one_line(tmp_path: Path, command: str) -> None:
    (tmp_path / "x.toml").write_text(FILES["escape.toml"])
    before = sorted(tmp_path.iterdir())
    done = start(tmp_path, command, "x.toml")
    assert done.returncode == 2
    assert "Traceback" not in done.stderr + done.stdout
    assert "\x1b" not in done.stderr + done.stdout
    assert sorted(tmp_path.iterdir()) == before


@pytest.mark.parametrize("command", [*COMMANDS, "sweep"])
def test_a_file_that_is_missing_is_named_on_one_line(tmp_path: Path, command: str) -> None:
    done = start(tmp_path, command, "x\n::error::\x1b[31my.toml")
    said = (done.stderr or done.stdout).splitlines()[0]
    assert done.returncode == 2
    assert r"'x\n::error::\x1b[31my.toml': expected a" in said
    assert "\x1b" not in done.stderr + done.stdout


@pytest.mark.parametrize(
    "text",
    [
        "[" * 100_000,
        '{"format": "fomas-certificate/1", "format": "fomas-certificate/1"}',
        '{"format": 1e999999999}',
        '{"a": ' + "9" * 1_000_000 + "}",
        '"\\ud800"',
        '{"\\u001b[2J": 1}',
    ],
)
def test_a_hostile_certificate_is_refused_by_both_ways_in(tmp_path: Path, text: str) -> None:
    (tmp_path / "c.json").write_text(text)
    done = start(tmp_path, "check", "c.json")
    alone = subprocess.run(
        [sys.executable, "-I", "-S", Path(__file__).parents[2] / "fomas_verify" / "checker", "c.json"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
    )
    for run in (done, alone):
        assert run.returncode == 2, (run.stdout, run.stderr)
        assert "Traceback" not in run.stderr
        assert "\x1b" not in run.stderr + run.stdout


def test_nothing_that_a_design_says_is_run(tmp_path: Path) -> None:
    """No format that the reader takes can name code: what looks like it is text, or refused."""
    for name in ("yaml.json", "pickle.toml"):
        (tmp_path / name).write_text(FILES[name])
        assert start(tmp_path, "prove", name).returncode == 2
    assert not (tmp_path / "ran").exists()
