"""One process of the fuzzer: draws inputs by their numbers and says what came of each.

The kernel ends it where an input takes more than `SECONDS` of processor time, and memory beyond `MEMORY` is refused to
it; the parent sees which input that was.
"""

from __future__ import annotations

import resource
import signal
import sys
import tempfile
import time
from pathlib import Path

from .targets import TARGETS, draw

SECONDS = 10
MEMORY = 2**30


def main(target: str, seed: int, start: int, step: int, count: int) -> None:
    """Print a line `start INDEX`, and then `done INDEX OUTCOME SECONDS KILOBYTES [REASON]`, for each input."""
    run = TARGETS[target]
    with tempfile.TemporaryDirectory(prefix="fomas-fuzz-") as name:
        run(draw(target, seed, start), Path(name))  # what is imported late counts for no input
        _bound_memory()
        for index in range(start, start + step * count, step):
            print("start", index, flush=True)
            data = draw(target, seed, index)
            began = time.process_time()
            signal.setitimer(signal.ITIMER_PROF, SECONDS)
            try:
                said = run(data, Path(name))
            except BaseException as error:
                said = f"failure {' '.join(repr(error).split())[:300]}"
            signal.setitimer(signal.ITIMER_PROF, 0)
            used, _, reason = said.partition(" ")
            peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
            print("done", index, used, f"{time.process_time() - began:.3f}", peak, reason, flush=True)


def _bound_memory() -> None:
    status = Path("/proc/self/status")
    if status.exists():
        lines = dict(line.split(":", 1) for line in status.read_text().splitlines() if ":" in line)
        now = int(lines["VmSize"].split()[0]) * 1024
        resource.setrlimit(resource.RLIMIT_AS, (now + MEMORY, now + MEMORY))


if __name__ == "__main__":
    main(sys.argv[1], *map(int, sys.argv[2:6]))
