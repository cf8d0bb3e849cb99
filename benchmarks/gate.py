"""The gate on many designs of five agents, each decided and checked: ``python -m benchmarks.gate [COUNT [JOBS]]``.

Half are on weighted balanced digraphs (sums of cycles through all agents), half on undirected weighted graphs; alpha, h
and the gain vary, so that some pass and some fail.
"""

from __future__ import annotations

import json
import random
import sys
import tempfile
from collections.abc import Iterator
from itertools import combinations
from pathlib import Path

from benchmarks.measure import run

AGENTS = 5
COUNT = 2000
STATUSES = (0, 1)


def design(source: random.Random, directed: bool) -> dict[str, object]:
    """A design on a balanced digraph, or on an undirected graph, of five agents."""
    weights: dict[tuple[int, int], int] = {}

    def add(start: int, end: int, weight: int) -> None:
        weights[start, end] = weights.get((start, end), 0) + weight

    if directed:
        for _ in range(2):
            order, weight = source.sample(range(1, AGENTS + 1), AGENTS), source.randrange(1, 20)
            for start, end in zip(order, order[1:] + order[:1], strict=True):
                add(start, end, weight)
    else:
        pairs = {(i, i + 1) for i in range(1, AGENTS)} | {
            pair for pair in combinations(range(1, AGENTS + 1), 2) if source.random() < 0.5
        }
        for pair in sorted(pairs):
            weight = source.randrange(1, 20)
            add(*pair, weight)
            add(*reversed(pair), weight)
    degree = max(sum(w for (_, end), w in weights.items() if end == agent) for agent in range(1, AGENTS + 1)) / 10
    return {
        "alpha": f"0.{source.randrange(50, 99)}",
        "gamma": f"{source.uniform(0.2, 1.1) / degree:.4f}",
        "h": f"0.{source.randrange(50, 99)}",
        "graph": {"agents": AGENTS, "edges": [[*edge, f"{w}/10"] for edge, w in sorted(weights.items())]},
    }


def write_designs(folder: Path, count: int) -> None:
    """That many designs as files of their own."""
    source = random.Random(5)
    for number in range(count):
        text = json.dumps({"name": f"design {number}", **design(source, directed=number % 2 == 0)})
        (folder / f"{number:05}.design.json").write_text(text)


def rows(count: int, jobs: int) -> Iterator[tuple[str, str, str]]:
    """The measurement: what, the figure, the goal."""
    with tempfile.TemporaryDirectory() as folder:
        write_designs(Path(folder), count)
        cost = run(["-m", "fomas_verify", "gate", folder, "--jobs", str(jobs), "--quiet"], accepted=STATUSES)
    figure = f"{count / cost.wall:.0f} designs/s, CPU {1000 * cost.cpu / count:.1f} ms each"
    yield f"gate, {count} designs of {AGENTS} agents, {jobs} processes", figure, "at least 50 designs/s"


def main(count: int = COUNT, jobs: int = 2) -> None:
    """Measure and print."""
    for row in rows(count, jobs):
        print(*row, sep="    ")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
