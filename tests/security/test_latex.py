"""LaTeX that a user names a design, or a file, after: printed, not obeyed, whatever the environment allows."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = [
    pytest.mark.slow,
    # A LaTeX is no Python package: who is not root, or has no Debian, may lack it and still run all other tests.
    pytest.mark.skipif(
        not (shutil.which("pdflatex") and shutil.which("pdftotext")),
        reason="no LaTeX: `make test` installs it if it can",
    ),
]

HOSTILE = r"\immediate\write18{touch ran}\input{/etc/passwd}\openout1=ran \directlua{os.execute('touch ran')}"
ALLOWED = {"shell_escape": "t", "openin_any": "a", "openout_any": "a", "TEXMFOUTPUT": "."}


def test_a_name_is_printed_and_does_nothing(tmp_path: Path) -> None:
    stem = r"\input{x}\write18{touch ran}"
    (tmp_path / "x.tex").write_text("OBEYED")
    (tmp_path / f"{stem}.toml").write_text(
        f"name = '''{HOSTILE}'''\nalpha = 0.9\nmu = 0.2\n[graph]\nfamily = 'path'\nagents = 3\n"
    )
    done = subprocess.run(
        [sys.executable, "-m", "fomas_verify", "report", f"{stem}.toml", "-o", "report"],
        cwd=tmp_path,
        env={**os.environ, **ALLOWED},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    (page,) = (tmp_path / "report").glob("*.pdf")
    words = subprocess.run(["pdftotext", page, "-"], capture_output=True, text=True, check=True).stdout
    assert r"\immediate\write18{touchran}\input{/etc/passwd}" in "".join(words.split())
    assert "root:" not in words
    assert "OBEYED" not in words
    assert [path for path in tmp_path.rglob("*") if path.name == "ran"] == []
