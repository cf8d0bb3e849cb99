"""From LaTeX to PDF in a folder of its own that is thrown away.

Shell escape is off, no file is written outside, nothing reaches the network, and each run has a time limit.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

SECONDS = 180
_RUNS = 4
_BATCH = ("-no-shell-escape", "-interaction=nonstopmode", "-halt-on-error")
ENGINES: Mapping[str, tuple[str, ...]] = {
    "pdflatex": _BATCH,
    "lualatex": _BATCH,
    "tectonic": ("--untrusted", "--only-cached", "--keep-logs"),
}
NO_LATEX = (
    "no PDF: none of pdflatex, lualatex, tectonic was found "
    "(on Debian: apt-get install texlive-latex-extra texlive-pictures lmodern)"
)


@dataclass(frozen=True)
class Compilation:
    """What came of it: the PDF, or None and the reason in one line; and the engine's log."""

    pdf: bytes | None
    reason: str
    log: str


def compile_latex(source: str, data: Mapping[str, bytes], *, seconds: float = SECONDS) -> Compilation:
    """Typeset a document with the first LaTeX found on the path.

    Parameters
    ----------
    source : str
        The document, ASCII.
    data : mapping
        The files it reads, by name.
    seconds : float
        Limit of each run.

    Returns
    -------
    Compilation
        Without a PDF where there is no LaTeX, or where it failed.
    """
    name = next((engine for engine in ENGINES if shutil.which(engine)), None)
    if name is None:
        return Compilation(None, NO_LATEX, "")
    with tempfile.TemporaryDirectory(prefix="fomas-report-") as folder:
        room = Path(folder)
        for file, content in {**data, "report.tex": source.encode("ascii")}.items():
            (room / file).write_bytes(content)
        return _typeset(name, room, seconds)


def _typeset(engine: str, room: Path, seconds: float) -> Compilation:
    """Run the engine until references settle."""
    before = b""
    for _ in range(_RUNS):
        try:
            run = subprocess.run(
                [engine, *ENGINES[engine], "report.tex"],
                cwd=room,
                env=_environment(),
                stdin=subprocess.DEVNULL,
                capture_output=True,
                timeout=seconds,
                check=False,
            )
        except subprocess.TimeoutExpired:
            return Compilation(None, f"no PDF: {engine} took more than {seconds:g} s", "")
        except OSError as error:
            return Compilation(None, f"no PDF: {engine} could not be started: {error.strerror}", "")
        log = _text(room / "report.log")
        if run.returncode != 0 or not (room / "report.pdf").is_file():
            return Compilation(None, f"no PDF: {engine} failed: {_first_error(log)}", log)
        made = _bytes(room / "report.pdf")
        if not made.startswith(b"%PDF-") or b"%%EOF" not in made[-1024:]:  # such as a full disk leaves
            return Compilation(None, f"no PDF: {engine} failed: its PDF is not whole", log)
        references = _bytes(room / "report.aux")
        if references == before or engine == "tectonic":
            break
        before = references
    return Compilation(made, "", log)


def _environment() -> dict[str, str]:
    """The caller's, with the same time everywhere and TeX confined to its folder."""
    kept = {name: value for name, value in os.environ.items() if not name.startswith(("TEXMFOUTPUT", "TEXINPUTS"))}
    confined = {"openin_any": "p", "openout_any": "p", "shell_escape": "f", "max_print_line": "1000"}
    return kept | confined | {"SOURCE_DATE_EPOCH": "0", "FORCE_SOURCE_DATE": "1", "LC_ALL": "C"}


def _first_error(log: str) -> str:
    line = next((line[2:] for line in log.splitlines() if line.startswith("! ")), "its log names no error")
    return " ".join(line.split())[:200]


def _text(path: Path) -> str:
    return _bytes(path).decode("utf-8", "replace")


def _bytes(path: Path) -> bytes:
    return path.read_bytes() if path.is_file() else b""
