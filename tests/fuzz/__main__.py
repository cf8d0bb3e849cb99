"""The fuzzer at any size: `python -m tests.fuzz --seconds 3600 [--target design] [--seed 1]`.

Prints the figures of each target and exits 1 if an input ended in anything but a verdict or a one-line refusal, took
more than 10 s or more than 1 GB. Such inputs stand in build/fuzz/failures; `--input FILE --target NAME` tries one
again.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from .campaign import ENDLESS, Figures, campaign
from .targets import TARGETS


def main(arguments: list[str]) -> int:
    """Run the campaign; 0 if nothing failed."""
    parser = argparse.ArgumentParser(prog="python -m tests.fuzz", description=__doc__)
    parser.add_argument("--seconds", type=float, default=60, help="for each target")
    parser.add_argument("--count", type=int, default=ENDLESS, help="inputs of each target, in place of a time")
    parser.add_argument("--target", action="append", choices=sorted(TARGETS))
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=2, help="targets at once")
    parser.add_argument("--input", type=Path, help="try this file once, with its traceback")
    given = parser.parse_args(arguments)
    if given.input is not None:
        with tempfile.TemporaryDirectory() as folder:
            print(TARGETS[given.target[0]](given.input.read_bytes(), Path(folder)))
        return 0
    seconds = ENDLESS if given.count < ENDLESS else given.seconds

    def run(target: str) -> Figures:
        return campaign(target, given.seed, count=given.count, seconds=seconds)

    with ThreadPoolExecutor(given.jobs) as pool:
        failed = 0
        for figures in pool.map(run, given.target or TARGETS):
            print(figures.line(), flush=True)
            for index, reason in figures.failures.items():
                print(f"  {figures.target} {index}: {reason}", flush=True)
            failed += len(figures.failures)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
