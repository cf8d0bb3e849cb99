"""A page of documentation as a user follows it: its files are written, its commands run, in order, in one folder.

A fence ``toml title="NAME"`` (or another language with a title) is a file. A fence ``console`` holds commands after
``$ ``, each followed by what it prints on standard output and standard error; a line ``...`` stands for any lines.
"""

import os
import re
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

FENCE = re.compile(r"^```(\w+)([^\n]*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)

HERE = Path(sys.executable).parent


@dataclass(frozen=True)
class Step:
    """A file to write, or a command and what it prints."""

    subject: str
    text: str
    is_file: bool


def steps(page: str) -> Iterator[Step]:
    """The steps of a page in their order."""
    for language, rest, body in FENCE.findall(page):
        if title := re.search(r'title="([^"]+)"', rest):
            yield Step(title[1], body, is_file=True)
        elif language == "console":
            for part in re.split(r"^\$ ", body, flags=re.MULTILINE)[1:]:
                command, _, shown = part.partition("\n")
                yield Step(command, shown, is_file=False)


def run(command: str, folder: Path, before: int, programs: Path = HERE) -> tuple[int, str]:
    """Run a command by bash with the programs of an environment; ``before`` is the exit status that ``$?`` shows."""
    path = f"{programs}{os.pathsep}{os.environ['PATH']}"
    done = subprocess.run(
        ["bash", "-c", f"(exit {before}); {command}"],
        cwd=folder,
        env={**os.environ, "PATH": path, "COLUMNS": "80"},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        check=False,
    )
    return done.returncode, done.stdout


def agrees(shown: str, printed: str) -> bool:
    """What is shown is what was printed, but for elisions and white space at ends."""
    lines = [r"(?:.*\n)*?" if line.strip() == "..." else re.escape(line.rstrip()) + r"\n" for line in _lines(shown)]
    return re.fullmatch("".join(lines), "".join(f"{line.rstrip()}\n" for line in _lines(printed))) is not None


def follow(page: str, folder: Path, programs: Path = HERE) -> None:
    """Do what a page says, and assert that what it shows is what happens."""
    status = 0
    for step in steps(page):
        if step.is_file:
            (folder / step.subject).write_text(step.text, "utf-8")
            continue
        status, printed = run(step.subject, folder, status, programs)
        assert agrees(step.text, printed), f"$ {step.subject}\n{printed}"


def _lines(text: str) -> list[str]:
    return text.strip("\n").splitlines()
