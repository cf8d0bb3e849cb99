"""The files that this process reads: nothing that it writes may take the place of one."""

from __future__ import annotations

import os
from pathlib import Path

_READ: set[str] = set()


def remember(path: Path) -> None:
    """Note that this file is read."""
    _READ.add(os.path.realpath(path))


def was_read(path: Path) -> bool:
    """Whether this file was read."""
    return os.path.realpath(path) in _READ
