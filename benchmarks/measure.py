"""One command, run to its end: CPU seconds, wall seconds and peak memory of the process."""

import os
import subprocess
import sys
import time
from dataclasses import dataclass
from statistics import median


@dataclass(frozen=True)
class Cost:
    """CPU and wall time in seconds, peak resident memory in MB."""

    cpu: float
    wall: float
    memory: float


def run(arguments: list[str], *, accepted: tuple[int, ...] = (0,)) -> Cost:
    """The cost of one run of this interpreter with these arguments; another exit status ends the benchmark."""
    start = time.perf_counter()
    process = subprocess.Popen([sys.executable, *arguments], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    _, status, usage = os.wait4(process.pid, 0)
    wall = time.perf_counter() - start
    process.returncode = os.waitstatus_to_exitcode(status)
    message = process.stderr.read().decode() if process.stderr else ""
    if process.returncode not in accepted:
        raise SystemExit(f"benchmark: {' '.join(arguments)} ended with {process.returncode}: {message}")
    return Cost(usage.ru_utime + usage.ru_stime, wall, usage.ru_maxrss / 1024)


def typical(arguments: list[str], *, times: int = 5, accepted: tuple[int, ...] = (0,)) -> Cost:
    """The medians over several runs."""
    costs = [run(arguments, accepted=accepted) for _ in range(times)]
    return Cost(*(median(getattr(cost, name) for cost in costs) for name in ("cpu", "wall", "memory")))
