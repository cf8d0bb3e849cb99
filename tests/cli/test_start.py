"""What a command loads before it begins: start-up time is what a user waits for, and the checker's word is its own."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

HEAVY = {"cvxpy", "distributed", "flint", "jinja2", "matplotlib", "mpmath", "networkx", "numpy", "pyarrow", "scipy"}
PAPER = Path(__file__).parents[2] / "examples" / "paper.toml"


def loaded(*arguments: object) -> set[str]:
    """The modules of a command that ended with status 0."""
    code = "import sys; from fomas_verify.cli.app import main; ended = main(); print(*sys.modules); sys.exit(ended)"
    done = subprocess.run(
        [sys.executable, "-c", code, *map(str, arguments)], capture_output=True, text=True, check=True, timeout=60
    )
    return set(done.stdout.splitlines()[-1].split())


def rooms(modules: set[str]) -> set[str]:
    return {name.split(".")[1] for name in modules if name.startswith("fomas_verify.")}


def test_check_loads_the_checker_and_nothing_that_proves(tmp_path: Path) -> None:
    certificate = tmp_path / "certificate.json"
    loaded("prove", PAPER, "-o", certificate)
    modules = loaded("check", certificate)
    assert rooms(modules) == {"checker", "cli", "exact", "gate"}
    assert not modules & HEAVY


def test_proving_one_design_loads_no_library_that_it_does_not_use() -> None:
    assert loaded("prove", PAPER) & HEAVY == {"flint", "mpmath"}


@pytest.mark.parametrize("command", ["check", "completion", "init", "schema", "sweep"])
def test_help_of_what_does_not_prove_loads_no_prover(command: str) -> None:
    modules = loaded(command, "--help")
    assert "prover" not in rooms(modules)
    assert not modules & HEAVY
