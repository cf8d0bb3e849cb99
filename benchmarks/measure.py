"""One command, run to its end: CPU seconds, wall seconds and peak memory of the process."""

import json
import os
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from statistics import median

ENOUGH = 3.0
"""Seconds after which a measurement is not repeated."""

ONE_THREAD = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1")


@dataclass(frozen=True)
class Cost:
    """CPU and wall time in seconds, peak resident memory in MB, and what was printed."""

    cpu: float
    wall: float
    memory: float
    output: str = ""


def run(arguments: list[str], *, accepted: tuple[int, ...] = (0,), one_thread: bool = False) -> Cost:
    """The cost of one run of this interpreter with these arguments; another exit status ends the benchmark."""
    environment = {**os.environ, **ONE_THREAD} if one_thread else None
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as errors:
        start = time.perf_counter()
        process = subprocess.Popen([sys.executable, *arguments], stdout=out, stderr=errors, env=environment)
        _, status, usage = os.wait4(process.pid, 0)
        wall = time.perf_counter() - start
        process.returncode = os.waitstatus_to_exitcode(status)
        out.seek(0)
        errors.seek(0)
        printed, message = out.read().decode(), errors.read().decode()
    if process.returncode not in accepted:
        raise SystemExit(f"benchmark: {' '.join(arguments)} ended with {process.returncode}: {message}")
    return Cost(usage.ru_utime + usage.ru_stime, wall, usage.ru_maxrss / 1024, printed)


def typical(arguments: list[str], *, times: int = 5, accepted: tuple[int, ...] = (0,)) -> Cost:
    """The medians over several runs."""
    costs = [run(arguments, accepted=accepted) for _ in range(times)]
    return Cost(*(median(getattr(cost, name) for cost in costs) for name in ("cpu", "wall", "memory")))


def work(method: str, size: int, times: int) -> tuple[float, float]:
    """CPU seconds of a method's work, imports left out, and peak MB of its process: medians over up to so many runs."""
    seconds, memory, spent = [], [], 0.0
    while len(seconds) < times and spent < ENOUGH:
        cost = run(["-m", "benchmarks.methods", method, str(size)], one_thread=True)
        seconds.append(float(json.loads(cost.output.splitlines()[-1])))
        memory.append(cost.memory)
        spent += cost.cpu
    return median(seconds), median(memory)
