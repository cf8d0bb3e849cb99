"""The files that this process read graphs from: nothing that it writes may take the place of one."""

from __future__ import annotations

import os
from pathlib import Path

_READ: set[str] = set()


def remember(path: Path) -> None:
    """Note that a graph was read from this file."""
    _READ.add(os.path.realpath(path))


def was_read(path: Path) -> bool:
    """Whether a graph was read from this file."""
    return os.path.realpath(path) in _READ
