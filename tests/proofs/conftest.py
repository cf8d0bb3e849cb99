"""The proofs, compiled once for all who need them."""

import fcntl
import subprocess
from pathlib import Path

import pytest


@pytest.fixture(scope="session")
def compiled(checkout: Path) -> Path:
    """The folder proofs/, compiled without a warning; one process at a time."""
    proofs = checkout / "proofs"
    with (proofs / "Makefile").open() as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        run = subprocess.run(["make", "-C", proofs, "all"], capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stdout[-2000:] + run.stderr[-2000:]
    assert "Warning" not in run.stdout + run.stderr
    return proofs
