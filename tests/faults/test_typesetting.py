"""A LaTeX that fails, is killed, hangs or lies: the text is written all the same, and no part of a PDF."""

from __future__ import annotations

import os
import signal
import subprocess
import time
from pathlib import Path

import pytest

from fomas_verify.report.compilation import compile_latex

from .commands import NEW, call, environment, found, lay
from .killing import TEMPORARY

pytestmark = pytest.mark.slow
SOURCE = "\\documentclass{article}\\begin{document}x\\end{document}\n"
FAILING = {
    "exits with 1": ("echo '! Undefined control sequence.' >report.log; exit 1", "failed: Undefined control sequence."),
    "says nothing": ("exit 1", "failed: its log names no error"),
    "makes nothing": ("exit 0", "failed: its log names no error"),
    "is killed": ("printf '%%PDF-1.5 half' >report.pdf; kill -9 $$", "failed: its log names no error"),
    "leaves half a PDF": ("printf '%%PDF-1.5 half' >report.pdf; exit 0", "failed: its PDF is not whole"),
    "leaves an empty PDF": (": >report.pdf; exit 0", "failed: its PDF is not whole"),
    "removes its folder": ('rm -r "$PWD"; exit 0', "failed: its log names no error"),
}


@pytest.fixture
def shim(tmp_path: Path) -> Path:
    """The folder of a pdflatex that a test writes."""
    folder = tmp_path / "bin"
    folder.mkdir()
    return folder


def install(shim: Path, script: str) -> str:
    (shim / "pdflatex").write_text(f"#!/bin/sh\n{script}\n")
    (shim / "pdflatex").chmod(0o755)
    return f"{shim}:/usr/bin:/bin"


def report(folder: Path, path: str) -> subprocess.Popen[str]:
    return subprocess.Popen(
        call(("report", "plant.toml", "-o", "report")),
        cwd=folder,
        env=environment(PATH=path, TMPDIR=str(folder / "tmp")),
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


@pytest.mark.parametrize("fault", FAILING)
def test_a_latex_that_fails(fault: str, shim: Path, room: Path) -> None:
    script, reason = FAILING[fault]
    earlier = {f"report/report.{ending}": b"of an earlier text" for ending in ("tex", "pdf")}
    lay({**NEW, **earlier, "tmp/x": b""}, room)
    process = report(room, install(shim, script))
    out, err = process.communicate()
    assert (process.returncode, err) == (0, "")
    assert out.splitlines()[-1] == f"no PDF: pdflatex {reason}"
    left = found(room)
    assert left["report/report.tex"].endswith(b"\\end{document}\n")
    assert "report/report.pdf" not in left  # it would contradict the text beside it
    assert [name for name in left if TEMPORARY.fullmatch(name) or name.startswith("tmp/f")] == []


def test_a_latex_that_hangs_is_ended(shim: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", install(shim, f"echo $$ >{shim}/pid; exec sleep 1000"))
    made = compile_latex(SOURCE, {}, seconds=2)
    assert (made.pdf, made.reason) == (None, "no PDF: pdflatex took more than 2 s")
    with pytest.raises(ProcessLookupError):
        os.kill(int((shim / "pid").read_text()), 0)


@pytest.mark.parametrize(("number", "status"), [(signal.SIGINT, 130), (signal.SIGKILL, -9)])
def test_interrupted_while_latex_runs(number: signal.Signals, status: int, shim: Path, room: Path) -> None:
    """Nothing has been written by then, so every former file is there."""
    lay({**NEW, "report/report.pdf": b"old", "report/report.tex": b"old", "tmp/x": b""}, room)
    path = install(shim, f"echo $$ >{shim}/pid.new; mv {shim}/pid.new {shim}/pid; exec sleep 1000")
    process = report(room, path)
    while not (shim / "pid").exists():
        assert process.poll() is None
        time.sleep(0.02)
    process.send_signal(number)
    process.wait()
    if number == signal.SIGKILL:  # then nobody ends the LaTeX
        os.kill(int((shim / "pid").read_text()), signal.SIGKILL)
    _, err = process.communicate()
    assert (process.returncode, err.strip()) == (status, "")  # a line feed closes the terminal's ^C
    left = found(room)
    assert left["report/report.pdf"] == left["report/report.tex"] == b"old"
    if number == signal.SIGINT:
        assert [name for name in left if name.startswith("tmp/f")] == []
