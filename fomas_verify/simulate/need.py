"""How much memory a simulation needs, and whether the machine has it."""

from __future__ import annotations

import os
from pathlib import Path

from fomas_verify.simulate.errors import SimulationError

NUMBER, CELL = 8, 130
"""Bytes of a float, and of a cell of the table while it is written."""

ARRAYS, COPIES = 5, 5
"""Arrays of the size of the states that are held at once, transforms of padded length among them; and the copies of one
controller's states between the samples while they are put in order.
"""

_MEMINFO = Path("/proc/meminfo")


def needed_bytes(columns: int, samples: int, *, controllers: int, between: int, table: bool) -> int:
    """About how many bytes: ``columns`` is the number of agents times their numbers."""
    size = columns * (samples + 1)
    arrays = ARRAYS + (2 + between) * controllers + COPIES * between
    return NUMBER * size * arrays + (2 * CELL * size * controllers * (1 + between) if table else 0)


def available_bytes() -> int | None:
    """Memory that is free for use; None where the system does not say."""
    try:
        for line in _MEMINFO.read_text().splitlines():
            if line.startswith("MemAvailable:"):
                return int(line.split()[1]) * 1024
    except (OSError, ValueError, IndexError):
        pass
    try:
        return os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    except (AttributeError, OSError, ValueError):
        return None


def must_fit(needed: int, available: int | None, samples: int) -> None:
    """Raise `SimulationError` where more is needed than is available."""
    if available is not None and needed > available:
        raise SimulationError(
            f"{samples} samples would need about {_shown(needed)} of memory, {_shown(available)} are free: "
            "ask for fewer samples, or for fewer points between them"
        )


def _shown(size: int) -> str:
    return f"{size / 1e9:.3g} GB" if size < 10**12 else f"{size / 1e12:.3g} TB"
