"""What a sweep shows on a terminal: one line with a bar, which goes, and messages on lines of their own."""

import os
import pty
import re
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from .conftest import parts

SMALL = {"mu": ["0.1", "0.2", "0.4"]}
MOVES = re.compile(r"\x1b\[([0-9;?]*)([A-Za-z])|([\r\n])|([^\x1b\r\n]+)")


def screens(written: str) -> Iterator[list[str]]:
    """The lines that a terminal shows after each piece of some output; knows the moves that rich makes."""
    lines, row, column = [""], 0, 0
    for number, move, control, text in MOVES.findall(written):
        if text:
            lines[row] = lines[row][:column].ljust(column) + text + lines[row][column + len(text) :]
            column += len(text)
        elif control == "\r":
            column = 0
        elif control == "\n":
            row += 1
            lines += [""] * (row + 1 - len(lines))
        elif move == "A":
            row -= int(number or 1)
        elif move == "K":
            assert number == "2"
            lines[row] = ""
        else:
            assert move in "hlm", move
        yield [line for line in lines if line]


def screen(written: str) -> list[str]:
    """The lines that a terminal shows after all of it."""
    return [[], *screens(written)][-1]


def on_terminal(
    *arguments: object, meanwhile: Callable[[subprocess.Popen], object] = lambda _: None, **environment: str
) -> tuple[int, str]:
    """Run a sweep whose standard error is a terminal; its status and what it wrote there."""
    ours, its = pty.openpty()
    process = subprocess.Popen(
        [sys.executable, "-m", "fomas_verify", "sweep", *map(str, arguments)],
        env={**os.environ, "TERM": "xterm", "COLUMNS": "80", **environment},
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=its,
    )
    os.close(its)
    written = b""
    try:
        while data := _read(ours):
            written += data
            meanwhile(process)
    except BaseException:
        process.kill()
        raise
    finally:
        os.close(ours)
    return process.wait(), written.decode()


def _read(terminal: int) -> bytes:
    try:
        return os.read(terminal, 65536)
    except OSError:  # the other side is closed
        return b""


def test_the_bar_is_one_line_and_goes(write_grid, tmp_path: Path) -> None:
    status, written = on_terminal(write_grid(SMALL, alpha="0.9"), "-o", tmp_path / "rows", "-j", 1)
    assert status == 0
    shown = list(screens(written))
    assert max(map(len, shown)) == 1
    assert any(lines and re.search(r"[0-3]/3 rows", lines[0]) for lines in shown)
    assert shown[-1] == []


@pytest.mark.slow
def test_an_interruption_has_a_line_of_its_own(long_grid: Path, tmp_path: Path) -> None:
    folder = tmp_path / "rows"

    sent = []

    def interrupt(process: subprocess.Popen) -> None:
        if not sent and len(parts(folder)) > 1:
            sent.append(process.send_signal(signal.SIGINT))

    status, written = on_terminal(long_grid, "-o", folder, "--part-rows", 10, "-j", 2, meanwhile=interrupt)
    assert status == 130
    (line,) = screen(written)
    assert re.fullmatch(
        r"verify-design: interrupted: \d+ of 240 rows are in .*; the same call computes the others", line
    )


def test_a_terminal_that_cannot_move_is_left_alone(write_grid, tmp_path: Path) -> None:
    status, written = on_terminal(write_grid(SMALL, alpha="0.9"), "-o", tmp_path / "rows", "-j", 1, TERM="dumb")
    assert (status, written) == (0, "")
