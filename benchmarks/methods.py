"""What is measured side by side: ``python -m benchmarks.methods NAME SIZE`` does it once and prints its CPU seconds.

Each function prepares the work of a size, imports included, and gives the work itself.
"""

from __future__ import annotations

import json
import sys
import time
from collections.abc import Callable
from fractions import Fraction
from typing import Any

Work = Callable[[], object]
ALPHA, BETA = Fraction(9, 10), Fraction("0.865259253816056174117598007086")
ARB_BITS, MPMATH_DIGITS = 200, 50


def horizon_ours(last: int) -> Work:
    from fomas_verify.enclosure.interval import Interval
    from fomas_verify.kernel.horizon import check_horizon

    return lambda: check_horizon(ALPHA, Interval.exactly(BETA), last, MPMATH_DIGITS)


def horizon_arb(last: int) -> Work:
    from flint import arb, ctx, fmpq

    def work() -> None:
        with ctx.workprec(ARB_BITS):
            alpha, beta = (arb(fmpq(x.numerator, x.denominator)) for x in (ALPHA, BETA))
            total, power, smallest = arb(0), arb(1), arb("inf")
            for k in range(last + 1):
                j = k + 1
                total += abs(arb(j + 1) ** alpha - 2 * arb(j) ** alpha + arb(j - 1) ** alpha)
                power *= beta
                if not power + total <= 1:
                    raise SystemExit(f"not shown at k = {k}")
                slack = 1 - power / (1 - total)
                smallest = slack if slack < smallest else smallest

    return work


def horizon_mpmath(last: int) -> Work:
    from benchmarks.baseline_mpmath import main

    return lambda: main(last)


def lambda2_ours(rows: int) -> Work:
    from benchmarks.designs import grid
    from fomas_verify.spectrum.large import large_bounds

    graph, mu = grid(rows), (Fraction(1, 10), Fraction(1, 10))
    large_bounds(grid(4), mu, memory=8 << 30)  # loads what it needs

    def work() -> None:
        if large_bounds(graph, mu, memory=8 << 30).lambda2_lower is None:
            raise SystemExit("no bound was shown")

    return work


def lambda2_eigsh(rows: int) -> Work:
    from scipy.sparse.linalg import eigsh

    from benchmarks.designs import grid_laplacian

    laplacian = grid_laplacian(rows)
    return lambda: eigsh(laplacian, k=2, sigma=-1e-3, which="LM")


def lambda2_dense(rows: int) -> Work:
    import numpy as np

    from benchmarks.designs import grid_laplacian

    laplacian = grid_laplacian(rows).toarray()
    np.linalg.eigvalsh(np.eye(3))
    return lambda: np.linalg.eigvalsh(laplacian)


def lambda2_arb(rows: int) -> Work:
    from flint import fmpz_mat

    from benchmarks.designs import grid_laplacian

    laplacian = fmpz_mat(grid_laplacian(rows).toarray().astype(int).tolist())
    return lambda: laplacian.charpoly().complex_roots()


def lmi_ours(agents: int) -> Work:
    import cvxpy  # noqa: F401  # its import is no part of the work

    from fomas_verify.region.agreement import agreement
    from fomas_verify.region.find import find_region

    design = _on_digraph(agents)
    return lambda: agreement(find_region(design))


def lmi_bare(agents: int) -> Work:
    import cvxpy  # noqa: F401

    from fomas_verify.region.lmi import Goal, by_clarabel
    from fomas_verify.spectrum.loop import Loop

    loop = Loop(_on_digraph(agents))

    def work() -> None:
        if by_clarabel(loop, Goal.LEAST_SIGMA, Fraction(1), 0) is None:
            raise SystemExit("the solver has no answer")

    return work


def simulate_ours(name: str) -> Callable[[int], Work]:
    def prepare(samples: int) -> Work:
        from benchmarks.simulate import paper
        from fomas_verify.simulate import simulate

        plant, law = paper(name)
        simulate(plant, law, 300)  # what a library makes at its first use is no part of the work
        return lambda: simulate(plant, law, samples)

    return prepare


def simulate_peer(peer: str, name: str) -> Callable[[int], Work]:
    def prepare(samples: int) -> Work:
        from benchmarks.simulate import paper
        from tests.simulate import peers
        from tests.simulate.designs import PAPER as DESIGN

        run, (_, law) = getattr(peers, f"by_{peer}"), paper(name)
        run(DESIGN, 10, law.memory)
        return lambda: run(DESIGN, samples, law.memory)

    return prepare


def _on_digraph(agents: int) -> Any:
    from benchmarks.designs import weighted_digraph
    from fomas_verify.design import design_from_mapping

    return design_from_mapping(weighted_digraph(agents, 3, 1))


METHODS: dict[str, Callable[[int], Work]] = {
    "horizon-ours": horizon_ours,
    "horizon-arb": horizon_arb,
    "horizon-mpmath": horizon_mpmath,
    "lambda2-ours": lambda2_ours,
    "lambda2-eigsh": lambda2_eigsh,
    "lambda2-dense": lambda2_dense,
    "lambda2-arb": lambda2_arb,
    "lmi-ours": lmi_ours,
    "lmi-bare": lmi_bare,
    **{f"{law}-ours": simulate_ours(law) for law in ("proposed", "memoryless")},
    **{
        f"{law}-{peer}": simulate_peer(peer, law)
        for law in ("proposed", "memoryless")
        for peer in ("fodeint", "pycaputo")
    },
}


def main(name: str, size: int) -> None:
    """Do it once; the seconds are the last line."""
    work = METHODS[name](size)
    start = time.process_time()
    work()
    print(json.dumps(time.process_time() - start))


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]))
