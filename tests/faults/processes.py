"""A command in a process of its own: a new interpreter, as a user starts it, or a fork of this one.

A fork has every library loaded, so that a kill takes a twentieth of the time and comes where the command works; the
command is the same. No LaTeX is on the path: typesetting takes longer than all else together.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from typing import NoReturn

from .commands import Command, call, environment, run

Run = Callable[[Command, Path], tuple[int, str]]
NO_LATEX = {"PATH": ""}
LOADED = ("flint", "mpmath", "numpy", "scipy.linalg", "matplotlib.figure", "pyarrow.parquet", "jinja2", "sympy")


def run_afresh(command: Command, folder: Path) -> tuple[int, str]:
    """The status and standard error of a new interpreter."""
    ended = run(command.arguments, folder, **NO_LATEX)
    return ended.returncode, ended.stderr.decode()


def told(
    line: list[str], folder: Path, *, stdout: int = subprocess.PIPE, before_start: Callable[[], None] | None = None
) -> subprocess.CompletedProcess[str]:
    """How a command line ends in a folder, and what it says."""
    return subprocess.run(
        line,
        cwd=folder,
        env=environment(**NO_LATEX),
        stdin=subprocess.DEVNULL,
        stdout=stdout,
        stderr=subprocess.PIPE,
        text=True,
        check=False,
        preexec_fn=before_start,
    )


def run_forked(command: Command, folder: Path) -> tuple[int, str]:
    """The same of a fork."""
    with tempfile.TemporaryFile() as errors:
        _, status = os.waitpid(start_forked(command, folder, errors.fileno()), 0)
        errors.seek(0)
        return os.waitstatus_to_exitcode(status), errors.read().decode()


def start_afresh(command: Command, folder: Path) -> int:
    """The number of a new process, leader of a group."""
    return os.posix_spawn(
        "/bin/sh",
        ["sh", "-c", 'cd "$0" && exec "$@" <&- >/dev/null 2>&1', str(folder), *call(command.arguments)],
        environment(**NO_LATEX),
        setpgroup=0,
    )


def start_forked(command: Command, folder: Path, errors: int | None = None) -> int:
    """The same of a fork."""
    for module in (*LOADED, "fomas_verify.cli"):
        import_module(module)
    pid = os.fork()
    if pid == 0:
        _become(command, folder, errors)
    return pid


def _become(command: Command, folder: Path, errors: int | None) -> NoReturn:
    """Be the command until the end of this process."""
    status: object = 70
    try:
        os.setpgid(0, 0)
        os.chdir(folder)
        os.environ |= environment(**NO_LATEX)
        nowhere = os.open(os.devnull, os.O_RDWR)
        for number, there in ((0, nowhere), (1, nowhere), (2, nowhere if errors is None else errors)):
            os.dup2(there, number)
        sys.argv = ["verify-design", *command.arguments]
        from fomas_verify._entry import main

        main()
    except SystemExit as ended:
        status = ended.code
    finally:
        sys.stderr.flush()
        os._exit(status if isinstance(status, int) else 70)
