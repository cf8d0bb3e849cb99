"""Everything in one run: printed, and stored as a page with its chart.

``python -m benchmarks [--quick] [--no-goals] [-o FOLDER]``. A quick run takes the two smallest sizes of everything,
once, and leaves the goals out.
"""

from __future__ import annotations

import argparse
import json
import tempfile
from collections.abc import Iterator
from pathlib import Path

from benchmarks import goals
from benchmarks.chart import chart
from benchmarks.designs import weighted_digraph
from benchmarks.machine import machine
from benchmarks.measure import Cost, typical, work
from benchmarks.model import Point, Series
from benchmarks.page import Results, page
from benchmarks.topics import CHECKED, STARTS, STATUSES, TOOL, TOPICS, Topic

NAME = "benchmarks"


def measured(topic: Topic, *, quick: bool) -> Iterator[Series]:
    """Each method of a topic that is there."""
    for method in topic.methods:
        if method.missing:
            continue
        points = []
        for size in method.sizes[: 2 if quick else None]:
            seconds, memory = work(method.name, size, 1 if quick else 5)
            points.append(Point(topic.shown(size), seconds, memory))
            print(f"{topic.title}: {method.words}, {topic.shown(size)} {topic.size}: {seconds:.4g} s", flush=True)
        yield Series(method, tuple(points))


def started(*, quick: bool) -> dict[str, Cost]:
    """The processes of the cold start."""
    found = {}
    for words, arguments in STARTS.items():
        found[words] = typical(list(arguments), times=1 if quick else 5)
        print(f"{words}: {found[words].cpu:.3g} s", flush=True)
    return found


def checked(*, quick: bool) -> dict[int, tuple[Cost, Cost]]:
    """Prover and checker by agents."""
    found, times = {}, 1 if quick else 3
    with tempfile.TemporaryDirectory() as folder:
        file, certificate = Path(folder, "design.json"), str(Path(folder, "certificate.json"))
        for agents in CHECKED[: 2 if quick else None]:
            file.write_text(json.dumps(weighted_digraph(agents, 3, 1)))
            prove = typical([*TOOL, "prove", str(file), "-o", certificate], times=times, accepted=STATUSES)
            check = typical(["-I", "-S", "fomas_verify/checker", certificate], times=times)
            found[agents] = prove, check
            print(f"{agents} agents: prove {prove.cpu:.3g} s, check {check.cpu:.3g} s", flush=True)
    return found


def promised() -> Iterator[str]:
    """The goals, printed as they are measured."""
    with tempfile.TemporaryDirectory() as folder:
        for row in (goals.HEAD, *goals.rows(Path(folder))):
            print(row, flush=True)
            yield row.rstrip()


def main() -> None:
    """Measure, print and store."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks", description=__doc__)
    parser.add_argument("--quick", action="store_true", help="small sizes only, once each")
    parser.add_argument("--no-goals", action="store_true", help="leave out what was promised of gate, sweep and others")
    parser.add_argument("-o", "--output", type=Path, default=Path("docs"), metavar="FOLDER", help="[docs]")
    options = parser.parse_args()
    quick = options.quick
    seen = list(machine())
    topics = [(topic, list(measured(topic, quick=quick))) for topic in TOPICS]
    missing = sorted({m.needs for topic in TOPICS for m in topic.methods if m.missing})
    start, proved = started(quick=quick), checked(quick=quick)
    lines = [] if quick or options.no_goals else list(promised())
    found = Results(seen, topics, start, proved, missing, lines)
    text = page(found, f"{NAME}.svg")
    (options.output / f"{NAME}.svg").write_bytes(chart(topics))
    (options.output / f"{NAME}.md").write_text(text, encoding="utf-8")
    print(f"\n{text}")


if __name__ == "__main__":
    main()
