"""The closed forms are derived anew in sympy, and every script is listed."""

import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

PROOFS = Path(__file__).resolve().parents[2] / "proofs"
SCRIPTS = sorted(path.name for path in (PROOFS / "symbolic").glob("*.py"))


def test_every_script_is_listed() -> None:
    listed = tomllib.loads((PROOFS / "index.toml").read_text("utf-8"))["script"]
    assert sorted(entry["file"] for entry in listed) == [f"symbolic/{name}" for name in SCRIPTS]


@pytest.mark.parametrize("name", SCRIPTS)
def test_script_derives_what_it_says(name: str) -> None:
    pytest.importorskip("sympy")
    run = subprocess.run([sys.executable, PROOFS / "symbolic" / name], capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stderr
    assert run.stdout.strip()
