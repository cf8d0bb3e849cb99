"""A command under ``--time-limit`` or ``--memory``: it runs in a process of its own, which this one watches over.

What it prints and writes is held back until it has ended, so that a run that is ended leaves nothing. Its processes are
a group of their own and are ended together. A library that is refused memory may abort or crash in place of raising an
error: under a limit of memory such an end counts as one by that limit. One that asks again and again is ended.
"""

from __future__ import annotations

import json
import os
import select
import signal
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from enum import Enum
from pathlib import Path
from typing import IO, Any

import click

from fomas_verify.cli.limits import Limits
from fomas_verify.cli.machine import ended_by_sigterm
from fomas_verify.cli.outcome import outcome
from fomas_verify.cli.stuck import Watch
from fomas_verify.exact.errors import FomasError, out_of_memory
from fomas_verify.exact.memory import allow_memory, raise_beyond_memory
from fomas_verify.report.files import hold_back, release

LOOK_EVERY, STUCK_EVERY = 0.1, 1.0
PATIENCE = 10.0
"""Seconds for a command that keeps what it has written to come to an end after it was asked to."""

Run = Callable[[], int]


class LimitReachedError(FomasError):
    """The run was ended by a limit."""

    exit_status = 3


class BrokenRunError(FomasError):
    """The process of a run ended without saying how."""

    exit_status = 4


@dataclass
class _Child:
    """The process, the pipe on which it tells, what it has told, and the files behind its standard streams."""

    pid: int
    pipe: int
    streams: tuple[IO[bytes], IO[bytes]]
    made: list[Path] = field(default_factory=list)
    end: dict[str, Any] | None = None
    _text: bytes = b""

    def read(self, seconds: float) -> bool:
        """Wait so long for what it tells; False once it has told its end, or has ended without."""
        if self._take(seconds):
            return self.end is None
        if not self.ended():
            return True
        while self._take(0.0) and self.end is None:
            pass
        return False

    def ended(self) -> bool:
        """Whether the process has ended; its number stays taken."""
        return os.waitid(os.P_PID, self.pid, os.WEXITED | os.WNOHANG | os.WNOWAIT) is not None

    def _take(self, seconds: float) -> bool:
        """Take what stands in the pipe; False where nothing does."""
        ready, _, _ = select.select([self.pipe], [], [], seconds)
        chunk = os.read(self.pipe, 1 << 16) if ready else b""
        *lines, self._text = (self._text + chunk).split(b"\n")
        for line in lines:
            told = json.loads(line)
            if "made" in told:
                self.made.append(Path(told["made"]))
            else:
                self.end = told
        return bool(chunk)


def supervised(run: Run, limits: Limits, *, keeps: bool) -> int:
    """Run a command under limits and give its exit status.

    Parameters
    ----------
    run : function
        The command.
    limits : Limits
        At least one.
    keeps : bool
        Whether what it has written whole stays when it is ended.

    Raises
    ------
    LimitReachedError
        A limit ended it. Nothing is written, unless it keeps what it has.
    FomasError
        What the command itself refused, or an internal error.
    """
    if not (hasattr(os, "fork") and hasattr(os, "waitid")):
        raise click.UsageError("--time-limit and --memory need a system such as Linux, which can fork and wait")
    with (
        ended_by_sigterm(),
        tempfile.TemporaryDirectory(prefix="fomas-run-") as room,
        _child(run, limits, room, keeps=keeps) as child,
    ):
        ended = _watch(child, limits, keeps=keeps)
        if keeps or ended is _Ended.ITS_OWN:
            _pass_on(child.streams[1], err=True)
        if ended is _Ended.TIME:
            raise LimitReachedError(f"kept within {limits.time_option}: this run needs longer; {_left(keeps=keeps)}")
        if ended is _Ended.MEMORY and limits.memory is not None:
            raise LimitReachedError(f"kept within {limits.memory_option}: this run needs more; {_left(keeps=keeps)}")
        end = child.end
        if end is None or ended is _Ended.MEMORY:
            raise BrokenRunError("internal error: the process of this run was ended from outside, or ran out of memory")
        release((Path(x) if x else None, Path(y)) for x, y in end["files"])
        child.made.clear()
        _pass_on(child.streams[0], err=False)
        if end["message"]:
            click.echo(f"verify-design: {end['message']}", err=True)
        return int(end["status"])


def _left(*, keeps: bool) -> str:
    return "what is written stays, and the same call goes on" if keeps else "it is ended, and nothing is written"


class _Ended(Enum):
    """How a run came to its end."""

    ITS_OWN = "its own"
    TIME = "time"
    MEMORY = "memory"


def _watch(child: _Child, limits: Limits, *, keeps: bool) -> _Ended:
    """Follow the child to its end, or to that of its time or of its memory."""
    deadline = None if limits.seconds is None else time.monotonic() + float(limits.seconds)
    watch, looked = Watch(child.pid), time.monotonic()
    while child.read(LOOK_EVERY if deadline is None else min(LOOK_EVERY, max(0.0, deadline - time.monotonic()))):
        now = time.monotonic()
        if deadline is not None and now >= deadline:
            if keeps:
                os.kill(child.pid, signal.SIGTERM)
                while child.read(LOOK_EVERY) and time.monotonic() < now + PATIENCE:
                    pass
            return _Ended.TIME
        if limits.memory is not None and now >= looked + STUCK_EVERY:
            looked = now
            if watch.stuck():
                return _Ended.MEMORY
    return _Ended.MEMORY if child.end is None or child.end["memory"] else _Ended.ITS_OWN


@contextmanager
def _child(run: Run, limits: Limits, room: str, *, keeps: bool) -> Iterator[_Child]:
    """Start it; at the end of the block none of its processes is left, and nothing of what it made and did not keep."""
    for stream in (sys.stdout, sys.stderr):
        if stream is not None:
            stream.flush()
    (pipe, told), (life, held) = os.pipe(), os.pipe()
    with Path(room, "stdout").open("w+b") as out, Path(room, "stderr").open("w+b") as err:
        pid = os.fork()
        if pid == 0:
            os.close(held)
            try:
                _work(run, limits, room, told, life, (out.fileno(), err.fileno()), keeps=keeps)
            finally:
                os._exit(0)
        child = _Child(pid, pipe, (out, err))
        try:
            os.close(told)
            with suppress(OSError):  # it may have done so itself, or have ended
                os.setpgid(pid, pid)
            yield child
        finally:
            _end(child)
            for end in (pipe, life, held):
                os.close(end)


def _end(child: _Child) -> None:
    """End the child's processes, and remove what they made; what has its own name by now is not among it."""
    while not child.ended():
        with suppress(OSError):
            os.killpg(child.pid, signal.SIGKILL)
        time.sleep(0.001)
    with suppress(OSError):
        os.killpg(child.pid, signal.SIGKILL)  # what it left behind; its number is taken until it is waited for
    child.read(0.0)
    os.waitpid(child.pid, 0)
    for path in reversed(child.made):
        with suppress(OSError):
            path.rmdir() if path.is_dir() else path.unlink(missing_ok=True)


def _pass_on(stream: IO[bytes], *, err: bool) -> None:
    stream.seek(0)
    click.echo(stream.read(), nl=False, err=err)


def _work(run: Run, limits: Limits, room: str, told: int, life: int, streams: tuple[int, int], *, keeps: bool) -> None:
    """The child: run, and tell how it ended."""
    os.setpgid(0, 0)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    _end_with(life)
    for number, stream in enumerate(streams, 1):
        os.dup2(stream, number)
    sys.stdout, sys.stderr = (os.fdopen(number, "w", encoding="utf-8", closefd=False) for number in (1, 2))
    tempfile.tempdir = os.environ["TMPDIR"] = room

    def tell(**words: Any) -> None:
        data = json.dumps(words).encode() + b"\n"
        while data:
            data = data[os.write(told, data) :]

    held = hold_back(lambda path: tell(made=str(path)), names=not keeps)
    status, message, memory = _outcome(run, limits)
    sys.stdout.flush()
    sys.stderr.flush()
    files = [(None if x is None else str(x), str(y)) for x, y in held.files]
    tell(status=status, message=message, memory=memory, files=files)
    os.read(life, 1)  # the files are locked as long as this process lives, so it waits to be ended


def _outcome(run: Run, limits: Limits) -> tuple[int, str, bool]:
    """Exit status and line, as without limits; whether memory ran out."""
    try:
        return _allowed_outcome(run, limits)
    except SystemExit as error:
        return (error.code if isinstance(error.code, int) else 1), "", False
    except BaseException as error:
        interrupted = isinstance(error, KeyboardInterrupt)
        if out_of_memory(error) or (limits.memory is not None and _starved(error)):
            return 3, "", True
        if interrupted:
            return 130, "", False
        if os.environ.get("FOMAS_VERIFY_TRACEBACK") == "1":
            import traceback

            traceback.print_exception(error)
        return 4, "internal error: " + " ".join(f"{type(error).__name__}: {error}".split()), False


def _starved(error: BaseException) -> bool:
    """Whether this is how a library says, within a limit of memory, that it got none.

    OpenBLAS interrupts the program where it cannot start its threads; a user interrupts the one that watches. Compiled
    modules return without an exception, and pyarrow has one of its own.
    """
    return isinstance(error, KeyboardInterrupt | SystemError) or "launch worker thread" in str(error)


def _allowed_outcome(run: Run, limits: Limits) -> tuple[int, str, bool]:
    def allowed() -> int:
        if limits.memory is not None:
            try:
                allow_memory(limits.memory)
            except (ImportError, OSError, ValueError):
                raise click.UsageError("--memory: this system limits no process's memory") from None
        try:
            return run()
        except FomasError as error:
            raise_beyond_memory(error)
            raise

    return *outcome(allowed), False


def _end_with(life: int) -> None:
    """Have this process ended once the other end of a pipe is closed, as it is when the one that watches dies."""
    import fcntl

    if hasattr(fcntl, "F_SETSIG"):
        signal.signal(signal.SIGIO, signal.SIG_DFL)  # which ends it
        fcntl.fcntl(life, fcntl.F_SETOWN, os.getpid())
        fcntl.fcntl(life, fcntl.F_SETFL, fcntl.fcntl(life, fcntl.F_GETFL) | os.O_ASYNC)
