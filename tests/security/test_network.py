"""No command reaches for the network: each runs where a socket cannot be made, in it and in every process it starts."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.slow

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
Run = subprocess.CompletedProcess[str]


def start(folder: Path, *arguments: str) -> tuple[Run, list[str]]:
    """Run Python in a folder without sockets; what was attempted, though it was refused and perhaps passed over."""
    attempts = folder / "attempts"
    attempts.touch()
    done = subprocess.run(
        [sys.executable, *arguments],
        cwd=folder,
        env={**os.environ, "PYTHONPATH": str(HERE / "forbidden"), "ATTEMPTS": str(attempts)},
        capture_output=True,
        text=True,
        check=False,
    )
    return done, attempts.read_text().splitlines()


COMMANDS = {
    "prove": ["prove", "paper.toml", "-o", "certificate.json", "--horizon", "100"],
    "prove switching": ["prove", "switching.toml"],
    "graph file": ["prove", "file.toml"],
    "kernel": ["kernel", "paper.toml"],
    "region": ["region", "limits.toml", "--solver", "lmi", "--plot", "region.svg"],
    "synthesize": ["synthesize", "limits.toml", "-o", "best"],
    "weights": ["synthesize", "paper.toml", "--weights", "-o", "weights"],
    "simulate": ["simulate", "paper.toml", "--csv", "x.csv", "--parquet", "x.parquet", "--plot", "figures"],
    "report": ["report", "paper.toml", "-o", "latex"],
    "report html": ["report", "paper.toml", "-o", "html", "--format", "html"],
    "gate": ["gate", ".", "--jobs", "2", "--junit", "x.xml", "--sarif", "x.sarif"],
    "sweep": ["sweep", "grid.toml", "-o", "rows", "--jobs", "2", "--plot", "rows.svg", "--x", "gamma", "--y", "h"],
    "init": ["init", "new"],
    "schema": ["schema", "design"],
    "completion": ["completion", "bash"],
    "selftest": ["selftest"],
}


@pytest.fixture
def designs(tmp_path: Path) -> Path:
    for path in (ROOT / "examples").rglob("*.toml"):
        (tmp_path / path.name).write_bytes(path.read_bytes())
    graph = ROOT / "tests" / "network" / "files" / "paper.graphml"
    (tmp_path / graph.name).write_bytes(graph.read_bytes())
    (tmp_path / "file.toml").write_text(
        f'format = "fomas-design/1"\nalpha = 0.9\ngamma = 0.15\nh = 0.85\n[graph]\nfile = "{graph.name}"\n'
    )
    return tmp_path


@pytest.mark.parametrize("name", COMMANDS)
def test_a_command_needs_no_network(designs: Path, name: str) -> None:
    done, attempts = start(designs, "-m", "fomas_verify", *COMMANDS[name])
    assert (done.returncode, attempts) == (0, []), done.stderr


def test_the_checker_needs_no_network(designs: Path) -> None:
    assert start(designs, "-m", "fomas_verify", "prove", "paper.toml", "-o", "c.json")[0].returncode == 0
    for arguments in (
        ["-m", "fomas_verify", "check", "c.json", "--design", "paper.toml"],
        ["-m", "fomas_verify.checker", "c.json"],
    ):
        done, attempts = start(designs, *arguments)
        assert (done.returncode, attempts) == (0, []), done.stderr


@pytest.mark.parametrize(
    "code",
    [
        "import socket; socket.socket()",
        "import socket; socket.getaddrinfo('localhost', 1)",
        "import urllib.request; urllib.request.urlopen('http://localhost:1')",
        "import subprocess, sys; subprocess.run([sys.executable, '-c', 'import socket; socket.socket()'])",
        (
            "import multiprocessing as m, socket\nif __name__ == '__main__':\n"
            "    with m.get_context('spawn').Pool(1) as pool: pool.apply(socket.gethostbyname, ['localhost'])"
        ),
    ],
)
def test_an_attempt_is_seen(tmp_path: Path, code: str) -> None:
    program = tmp_path / "program.py"
    program.write_text(code)
    _, attempts = start(tmp_path, str(program))
    assert attempts
