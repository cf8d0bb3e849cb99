"""The kill loop at any size: `python -m tests.faults --kills 1000 [--seed 1]`.

Kills commands at random moments over a folder that holds former outputs, and prints the figures. The exit status is 1
if a file was ever left that is neither the former one nor the new one, or if the next run did not mend everything.
"""

from __future__ import annotations

import argparse
import sys

from .killing import Figures, campaign


def main(arguments: list[str]) -> int:
    """Run the loop; 0 if nothing failed."""
    parser = argparse.ArgumentParser(prog="python -m tests.faults", description=__doc__)
    parser.add_argument("--kills", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--forked", type=float, default=0.95, help="share of forks; the others are new interpreters")
    given = parser.parse_args(arguments)
    told, figures = 0, Figures()
    for figures in campaign(given.kills, given.seed, forked=given.forked):
        for failure in figures.failures[told:]:
            print(f"  {failure}", flush=True)
        told = len(figures.failures)
        if figures.kills % 50 == 0 or figures.kills == given.kills:
            print(f"seed {given.seed}: {figures.line()}", flush=True)
    return 1 if figures.failures else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
