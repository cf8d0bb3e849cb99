"""The memory that the user allows to a run (``--memory``), as its processes must know it.

The limit is of the address space, which the system refuses to extend beyond it, so that a request fails where it is
made and nothing is ended from outside. Processes that work at once have equal parts of it.
"""

from __future__ import annotations

import os

from fomas_verify.exact.errors import out_of_memory

_allowed: int | None = None


def allow_memory(size: int) -> None:
    """Hold this process, and those it starts, to so many bytes each; raises ValueError or OSError where none can."""
    global _allowed  # noqa: PLW0603  # a limit is the process's own, like the one that the system keeps
    import resource

    soft, hard = resource.getrlimit(resource.RLIMIT_AS)
    least = size if soft == resource.RLIM_INFINITY else min(size, soft)
    resource.setrlimit(resource.RLIMIT_AS, (least, hard))
    _allowed = size


def allowed_memory() -> int | None:
    """The bytes that this process may have by ``--memory``; None without a limit."""
    return _allowed


def memory_for_factors() -> int:
    """The bytes that factors of a large network's matrices may take: half of what is allowed, or of the machine's."""
    machine = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE") if hasattr(os, "sysconf") else 8 << 30
    return min(machine, _allowed or machine) // 2


def raise_beyond_memory(error: BaseException) -> None:
    """Raise MemoryError where there is a limit and the error comes from it: it ends the run, and is about no design."""
    if _allowed is not None and out_of_memory(error):
        raise MemoryError("beyond the memory allowed") from error
