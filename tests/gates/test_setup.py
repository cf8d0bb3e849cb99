"""Set-up on machines that lack something: one line says so; what is missing is installed only where it may be."""

import os
import shutil
import subprocess
from pathlib import Path

import pytest

Run = subprocess.CompletedProcess[str]
NEEDED = ("bash", "mktemp", "tail", "rm", "dirname", "env")


@pytest.fixture
def machine(tmp_path: Path) -> Path:
    """A folder of commands that has neither Coq nor LaTeX nor Chromium nor apt-get."""
    commands = tmp_path / "bin"
    commands.mkdir()
    for name in NEEDED:
        (commands / name).symlink_to(Path(shutil.which(name) or name))
    return commands


def add(machine: Path, name: str, script: str) -> None:
    (machine / name).write_text(f"#!/bin/sh\n{script}\n")
    (machine / name).chmod(0o755)


def debian(checkout: Path, machine: Path) -> Run:
    return subprocess.run(
        [checkout / "tools" / "debian.sh"], env={"PATH": str(machine)}, capture_output=True, text=True, check=False
    )


def test_without_root_it_says_what_is_left_out(checkout: Path, machine: Path) -> None:
    add(machine, "id", "echo 1000")
    add(machine, "apt-get", "echo called >&2; exit 1")
    run = debian(checkout, machine)
    assert (run.returncode, run.stderr) == (0, "")
    assert [line.split(" (")[0] for line in run.stdout.splitlines()] == [
        "left out: proofs",
        "left out: PDF",
        "left out: the width of an HTML report on a phone",
    ]


def test_without_apt_it_says_what_is_left_out(checkout: Path, machine: Path) -> None:
    add(machine, "id", "echo 0")
    run = debian(checkout, machine)
    assert (run.returncode, run.stderr) == (0, "")
    assert len(run.stdout.splitlines()) == 3


def test_root_gets_what_is_missing(checkout: Path, machine: Path, tmp_path: Path) -> None:
    calls = tmp_path / "calls"
    add(machine, "id", "echo 0")
    add(machine, "apt-get", f'echo "$DEBIAN_FRONTEND $*" >> {calls}')
    theories = tmp_path / "coq" / "user-contrib"
    for name in ("Coquelicot", "Interval", "mathcomp/algebra"):
        (theories / name).mkdir(parents=True)
    add(machine, "coqc", f"echo {theories.parent}")
    run = debian(checkout, machine)
    assert run.returncode == 0
    update, install = calls.read_text().splitlines()
    assert update.startswith("noninteractive update")
    assert install.startswith("noninteractive install -y")
    assert "texlive-pictures" in install
    assert install.endswith(" chromium")
    assert "libcoq-interval" not in install
    left_out = [line for line in run.stdout.splitlines() if line.startswith("left out")]
    assert [line.split()[2] for line in left_out] == ["PDF", "the"]


def test_a_failing_installation_is_no_failure(checkout: Path, machine: Path) -> None:
    add(machine, "id", "echo 0")
    add(machine, "apt-get", "echo no such package; exit 100")
    run = debian(checkout, machine)
    assert run.returncode == 0
    assert "no such package" in run.stderr
    assert len(run.stdout.splitlines()) == 4


def test_make_says_when_no_python_fits(checkout: Path, tmp_path: Path) -> None:
    shutil.copy(checkout / "Makefile", tmp_path)
    environment = {name: value for name, value in os.environ.items() if not name.startswith(("MAKE", "MFLAGS"))}
    run = subprocess.run(
        ["make", ".venv/bin/python", "PYTHON=no-such-python false"],
        cwd=tmp_path,
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )
    assert run.returncode == 2
    assert run.stdout == ""
    assert run.stderr.splitlines()[0].startswith("no Python 3.11 to 3.13 with venv among: no-such-python false")
    assert not (tmp_path / ".venv").exists()
