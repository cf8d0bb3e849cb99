"""Simulation: ``python -m benchmarks.simulate``; with a law and K it only simulates the paper's design.

Side by side with pycaputo and fodeint: CPU seconds of the same trajectory in one process, the least of several runs,
how they grow with K, and the largest error against the enclosure.
"""

from __future__ import annotations

import importlib.util
import math
import sys
import time
from collections.abc import Callable, Iterator
from functools import cache
from typing import Any

from benchmarks.measure import Cost, typical

SAMPLES, MANY = 8_000, 100_000
SIZES = (2_000, 4_000, 8_000)
REPEATED, PEERS_REPEATED = 40, 3
GOALS = {"proposed": "below 2 s beyond imports", "memoryless": "below 10 s beyond imports"}


def rows() -> Iterator[tuple[str, str, str]]:
    """Each measurement: what, the figure, the goal."""
    yield from long_rows()
    yield from peer_rows()


def long_rows() -> Iterator[tuple[str, str, str]]:
    """A long run in a process of its own, less a run of one sample; memory at half of the samples and at all."""
    for name, goal in GOALS.items():
        nothing, half, whole = (simulation(name, count) for count in (1, MANY // 2, MANY))
        yield f"simulate {name}, K = {MANY}, N = 5, CPU", f"{whole.cpu - nothing.cpu:.2f} s", goal
        growth = f"{half.memory - nothing.memory:.0f} MB, {whole.memory - nothing.memory:.0f} MB"
        yield f"memory of simulate {name}, K = {MANY // 2} and {MANY}", growth, "linear"


def simulation(name: str, samples: int) -> Cost:
    """The cost of this module's own run."""
    return typical(["-m", "benchmarks.simulate", name, str(samples)], times=3)


def peer_rows() -> Iterator[tuple[str, str, str]]:
    """The paper's trajectory by each program."""
    from tests.simulate.peers import by_fodeint, by_pycaputo

    peers = {"pycaputo": by_pycaputo, "fodeint": by_fodeint}
    for name in GOALS:
        ours, error = own(name)
        yield f"simulate {name}, K = {SAMPLES}", figure(ours, error), ""
        for peer, run in peers.items():
            if importlib.util.find_spec(peer) is None:
                yield f"  {peer} / simulate {name}", "left out: not installed", "at least 100"
            else:
                theirs, their_error = other(run, name)
                yield f"  {peer}, the same trajectory", figure(theirs, their_error), ""
                yield f"  {peer} / simulate {name}, CPU", f"{theirs[-1] / ours[-1]:.0f}", "at least 100"


def figure(seconds: list[float], error: float) -> str:
    """Seconds at the largest K, growth exponent over K, error."""
    exponent = math.log(seconds[-1] / seconds[0]) / math.log(SIZES[-1] / SIZES[0])
    return f"{seconds[-1] * 1e3:.1f} ms, ~ K^{exponent:.2f}, error {error:.1e}"


def own(name: str) -> tuple[list[float], float]:
    """Seconds for each size, and the largest error of a state at the largest."""
    from fomas_verify.simulate import simulate

    plant, law = paper(name)
    seconds = [fastest(lambda count=count: simulate(plant, law, count), REPEATED) for count in SIZES]
    return seconds, error_of(simulate(plant, law, SAMPLES).states[:, 0], name)


def other(run: Callable[..., Any], name: str) -> tuple[list[float], float]:
    """The same of a peer."""
    from tests.simulate.designs import PAPER

    _, law = paper(name)
    seconds = [fastest(lambda count=count: run(PAPER, count, law.memory), PEERS_REPEATED) for count in SIZES]
    return seconds, error_of(run(PAPER, SAMPLES, law.memory), name)


def fastest(work: Callable[[], object], times: int) -> float:
    """The least CPU seconds of several runs."""
    found = []
    for _ in range(times):
        start = time.process_time()
        work()
        found.append(time.process_time() - start)
    return min(found)


def error_of(states: Any, name: str) -> float:
    """The largest distance from the enclosure's midpoints, which are right to 1e-40."""
    from numpy import abs as absolute
    from numpy import array

    return float(absolute(states - array(enclosed(name))).max())


@cache
def enclosed(name: str) -> list[list[float]]:
    """The true trajectory, by agents."""
    from fomas_verify.design import read_design
    from fomas_verify.simulate.enclosed import enclose

    tube = enclose(read_design("examples/paper.toml"), paper(name)[1], SAMPLES)
    return [[float(x.mid) for x in row[0]] for row in tube.states]


def paper(name: str) -> tuple[Any, Any]:
    """The paper's plant, and a law."""
    from fomas_verify.design import read_design
    from fomas_verify.simulate import MEMORYLESS, PROPOSED, plant_of

    return plant_of(read_design("examples/paper.toml")), {"proposed": PROPOSED, "memoryless": MEMORYLESS}[name]


def main(arguments: list[str]) -> None:
    """Measure and print, or simulate once."""
    if arguments:
        from fomas_verify.simulate import simulate

        simulate(*paper(arguments[0]), int(arguments[1]))
        return
    for row in rows():
        print(*row, sep="    ", flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
