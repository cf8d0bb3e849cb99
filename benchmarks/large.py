"""Large networks that are no family's: ``python -m benchmarks.large [NAME ...]``; all of `CASES` by default.

Whole processes, reading the graph included; each graph is an ``.npz`` file of scipy.
"""

from __future__ import annotations

import json
import sys
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from benchmarks.measure import Cost, run

SEED = 7
EIGSH = """import sys
import numpy as np
from scipy import sparse
from scipy.sparse.linalg import eigsh
weights = sparse.load_npz(sys.argv[1])
degrees = np.asarray(weights.sum(axis=1)).ravel()
print(eigsh((sparse.diags_array(degrees) - weights).tocsc(), k=2, sigma=-1e-4, which="LM")[0])
"""
"""Nothing proved: the two smallest eigenvalues of the Laplacian by shift-invert."""


def torus(side: int) -> Any:
    """Of ``side**2`` agents in a random order, so that no family is seen and no order is given away."""
    import numpy as np
    from scipy import sparse

    cycle = sparse.diags_array([1.0, 1, 1, 1], offsets=[-1, 1, side - 1, 1 - side], shape=(side, side))
    whole = sparse.csr_array(sparse.kron(cycle, sparse.eye_array(side)) + sparse.kron(sparse.eye_array(side), cycle))
    order = np.random.default_rng(SEED).permutation(side * side)
    return whole[order][:, order]


def geometric(agents: int, degree: float) -> Any:
    """The largest part of a random geometric graph in the unit square; a mean of so many neighbours inside."""
    import numpy as np
    from scipy import sparse
    from scipy.sparse.csgraph import connected_components
    from scipy.spatial import cKDTree

    points = np.random.default_rng(SEED).random((agents, 2))
    pairs = cKDTree(points).query_pairs((degree / (np.pi * agents)) ** 0.5, output_type="ndarray")
    half = sparse.coo_array((np.ones(len(pairs)), tuple(pairs.T)), shape=(agents, agents)).tocsr()
    whole = half + half.T
    part = connected_components(whole, directed=False)[1]
    keep = np.flatnonzero(part == np.bincount(part).argmax())
    return whole[keep][:, keep]


def expander(agents: int, cycles: int) -> Any:
    """A balanced digraph, strongly connected: random cycles through all agents and a ring, each of its own weight."""
    import numpy as np
    from scipy import sparse

    draw = np.random.default_rng(SEED)
    orders = [np.arange(agents), *(draw.permutation(agents) for _ in range(cycles))]
    weights = draw.integers(1, 100, len(orders)) / 8
    rows = np.concatenate([np.roll(order, -1) for order in orders])
    found = sparse.coo_array((np.repeat(weights, agents), (rows, np.concatenate(orders))), shape=(agents, agents))
    return found.tocsr()


MOST_CHECKED = 100_000
"""Agents of which `check --numeric` is measured: of a million it takes more than ten minutes."""

CASES: dict[str, tuple[Callable[[], Any], str]] = {
    "torus of 99,856 agents": (lambda: torus(316), "below 3 GB"),
    "weighted digraph of 20,000 agents": (lambda: expander(20_000, 3), "below 180 s, 6 GB"),
    "torus of 1,000,000 agents": (lambda: torus(1000), "below 600 s, 16 GB"),
    "geometric graph of 1,000,000 agents": (lambda: geometric(1_000_000, 16), "below 600 s, 16 GB"),
}
FIRST, SECOND, *_ = CASES


def rows(names: list[str] | None = None) -> Iterator[tuple[str, str, str]]:
    """The measurements: what, the figure, the goal."""
    from scipy import sparse

    for name in names or CASES:
        make, goal = CASES[name]
        with tempfile.TemporaryDirectory() as folder:
            graph, design = Path(folder, "graph.npz"), Path(folder, "design.json")
            matrix = make()
            mu = 0.5 / float(matrix.sum(axis=1).max())
            sparse.save_npz(graph, matrix, compressed=False)
            about = {"file": graph.name, "orientation": "hears"}
            design.write_text(json.dumps({"alpha": "0.9", "mu": repr(mu), "graph": about}))
            certificate = Path(folder, "certificate.json")
            prove = run(["-m", "fomas_verify", "prove", str(design), "-o", str(certificate)], accepted=(0, 1))
            yield f"prove, {name}", shown(prove), goal
            yield "  its enclosure of lambda2, relative width", f"{width(certificate):.2g}", "below 1e-6"
            if name == FIRST:
                peer = run(["-c", EIGSH, str(graph)])
                yield "  eigsh, shift-invert, nothing proved", shown(peer), ""
                yield "  prove / eigsh, wall", f"{prove.wall / peer.wall:.2g}", "at most 2"
            if matrix.shape[0] <= MOST_CHECKED:
                check = ["-m", "fomas_verify", "check", "--numeric", str(certificate)]
                yield "  check --numeric", shown(run(check)), ""


def shown(cost: Cost) -> str:
    """Wall and CPU seconds, and memory."""
    return f"{cost.wall:.1f} s, CPU {cost.cpu:.1f} s, {cost.memory / 1024:.2f} GB"


def width(certificate: Path) -> float:
    """Of lambda2 in a certificate, as a share of its lower end."""
    from fractions import Fraction

    lambda2 = json.loads(certificate.read_bytes())["values"]["lambda2"]
    lower, upper = Fraction(lambda2["lower"]), Fraction(lambda2["upper"])
    return float((upper - lower) / lower)


def main(names: list[str]) -> None:
    """Measure and print."""
    for row in rows(names):
        print(*row, sep="    ", flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
