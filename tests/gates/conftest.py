"""A copy of the package that a test may break, and the gates as the Makefile runs them."""

import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

Run = subprocess.CompletedProcess[str]
Gate = Callable[..., Run]


@pytest.fixture
def copy(tmp_path: Path, checkout: Path) -> Path:
    """The configuration and the package, in a folder of their own."""
    shutil.copy(checkout / "pyproject.toml", tmp_path)
    shutil.copytree(checkout / "fomas_verify", tmp_path / "fomas_verify", ignore=shutil.ignore_patterns("__pycache__"))
    return tmp_path


@pytest.fixture
def gate() -> Gate:
    """Run a tool of this environment in a folder and return its exit status and words."""

    def run(folder: Path, tool: str, *arguments: str) -> Run:
        return subprocess.run(
            [Path(sys.executable).parent / tool, *arguments],
            cwd=folder,
            env={**os.environ, "PYTHONPATH": str(folder), "NO_COLOR": "1", "COLUMNS": "200"},
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            check=False,
        )

    return run
