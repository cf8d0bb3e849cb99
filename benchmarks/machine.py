"""The machine and the versions that a measurement is of; no name of a host, a user or a place."""

from __future__ import annotations

import os
import platform
from collections.abc import Iterator
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

PACKAGES = (
    "fomas_verify", "python-flint", "mpmath", "numpy", "scipy", "qdldl", "cvxpy", "clarabel", "fodeint", "pycaputo",
)  # fmt: skip
BUSY = 0.25
"""Share of the processors that other work may use before the page says so."""


def machine() -> Iterator[str]:
    """A line each."""
    cores = os.cpu_count() or 1
    load = os.getloadavg()[0]
    yield f"machine: {_processor()}, {cores} cores, {_memory()}; {platform.system()}"
    found = (f"{name} {number}" for name in PACKAGES if (number := _version(name)) is not None)
    yield f"versions: Python {platform.python_version()}, {', '.join(found)}"
    if load > BUSY * cores:
        yield f"other work ran at the same time (load {load:.1f} at the start), so that the times are too long"


def _processor() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        return platform.machine()
    return next((line.partition(":")[2].strip() for line in lines if line.startswith("model name")), platform.machine())


def _memory() -> str:
    size = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    return f"{size / (1 << 30):.0f} GB"


def _version(name: str) -> str | None:
    try:
        return version(name)
    except PackageNotFoundError:
        return None
