"""Whether a process asks for the same memory again and again, and is refused it each time.

OpenBLAS does so without end where a limit leaves no room for its buffers. Such a process spends its time in the system,
close to its limit, and its address space does not change. Where the system does not show processes in ``/proc``,
nothing is found.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

SECONDS = 2.0
"""CPU time in the system after which a process is judged."""

SHARE = 0.7
ROOM = 64 << 20
"""Bytes below the limit that one request may exceed: a buffer has 32 MB."""

_PROCESSES = Path("/proc")
_GROUP, _USER, _SYSTEM, _SIZE = 2, 11, 12, 20


class Use(NamedTuple):
    """Seconds in the program and in the system, bytes of address space."""

    user: float
    system: float
    size: int


@dataclass
class Watch:
    """A group of processes, and the use of each when its address space last changed."""

    group: int
    _since: dict[int, Use] = field(default_factory=dict)

    def stuck(self) -> bool:
        """Whether one of them is stuck, as of now; to be asked from time to time."""
        for process, use in _uses(self.group):
            since = self._since.setdefault(process, use)
            if use.size != since.size:
                self._since[process] = use
            elif use.system - since.system >= SECONDS:
                if in_vain(since, use, _limit(process)):
                    return True
                self._since[process] = use
        return False


def in_vain(since: Use, now: Use, limit: int | None) -> bool:
    """Whether what a process did in between was to ask for memory beyond its limit."""
    if limit is None or now.size != since.size or now.size + ROOM <= limit:
        return False
    system = now.system - since.system
    return system >= SECONDS and system >= SHARE * (system + now.user - since.user)


def _uses(group: int) -> Iterator[tuple[int, Use]]:
    tick = os.sysconf("SC_CLK_TCK")
    for folder in _PROCESSES.glob("[0-9]*"):
        try:
            fields = (folder / "stat").read_text().rpartition(")")[2].split()
        except (OSError, UnicodeDecodeError):
            continue
        if int(fields[_GROUP]) == group:
            yield int(folder.name), Use(int(fields[_USER]) / tick, int(fields[_SYSTEM]) / tick, int(fields[_SIZE]))


def _limit(process: int) -> int | None:
    import resource

    if not hasattr(resource, "prlimit"):
        return None
    try:
        soft, _ = resource.prlimit(process, resource.RLIMIT_AS)
    except OSError:
        return None
    return None if soft == resource.RLIM_INFINITY else soft
