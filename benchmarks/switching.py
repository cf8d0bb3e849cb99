"""Graphs to switch among: where the time of `region` goes, between solver, exact tests and checking.

``python -m benchmarks.switching N`` measures a pair of weighted digraphs on N agents and prints the seconds as JSON.
"""

import json
import subprocess
import sys
import time
from collections.abc import Iterator
from fractions import Fraction

Row = tuple[str, str, str]


def rows(sizes: tuple[int, ...]) -> Iterator[Row]:
    """A row a size, each measured in a process of its own."""
    for agents in sizes:
        command = [sys.executable, "-m", "benchmarks.switching", str(agents)]
        spent = json.loads(subprocess.run(command, capture_output=True, text=True, check=True).stdout)
        shares = ", ".join(f"{name} {seconds:.2f} s" for name, seconds in spent.items())
        yield f"region of 2 graphs, N = {agents}", shares, "the solver most"


def measure(agents: int) -> dict[str, float]:
    """Seconds for importing the solver, for its answers, for everything else of the search, and for checking."""
    start = time.perf_counter()
    import cvxpy  # noqa: F401

    spent = {"import": time.perf_counter() - start, "solver": 0.0}
    from benchmarks.designs import weighted_digraph
    from fomas_verify.checker import check
    from fomas_verify.design import SwitchedDesign
    from fomas_verify.design.reading import named_from_mapping
    from fomas_verify.region.common_lmi import margins_by_clarabel
    from fomas_verify.region.common_search import Search
    from fomas_verify.region.switching_region import find_switched_region

    graphs = [weighted_digraph(agents, 2, seed)["graph"] for seed in (1, 2)]
    design = named_from_mapping({"alpha": "9/10", "graphs": graphs})
    assert isinstance(design, SwitchedDesign)

    def searcher(loops):
        answers = margins_by_clarabel(loops)

        def timed(t: Fraction, attempt: int):
            begin = time.perf_counter()
            try:
                return answers(t, attempt)
            finally:
                spent["solver"] += time.perf_counter() - begin

        return Search(loops, timed)

    start = time.perf_counter()
    found = find_switched_region(design, searcher)
    spent["exact"] = time.perf_counter() - start - spent["solver"]
    certificate = found.certificate().encode()
    start = time.perf_counter()
    assert check(certificate).exit_status == 0
    spent["check"] = time.perf_counter() - start
    return spent


if __name__ == "__main__":
    print(json.dumps(measure(int(sys.argv[1]))))
