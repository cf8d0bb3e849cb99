"""What is compared with what, and at which sizes."""

from __future__ import annotations

import importlib.util
from dataclasses import dataclass

STATUSES = (0, 1)
PAPER = "examples/paper.toml"
TOOL = ("-m", "fomas_verify")


@dataclass(frozen=True)
class Method:
    """``name`` in `benchmarks.methods`; what it is; its sizes, of which a quick run takes the first two.

    ``needs``: a package that may be missing.
    """

    name: str
    words: str
    sizes: tuple[int, ...]
    needs: str = ""

    @property
    def missing(self) -> bool:
        return bool(self.needs) and importlib.util.find_spec(self.needs) is None


@dataclass(frozen=True)
class Topic:
    """A question and the ways to answer it, the project's own first; ``size`` says what a size counts, ``power`` how
    many of it there are for each number given to the method.
    """

    title: str
    size: str
    words: str
    methods: tuple[Method, ...]
    agents: bool = False

    def shown(self, size: int) -> int:
        """The size in its unit: a grid of n rows has n (n + 1) agents."""
        return size * (size + 1) if self.agents else size


def _simulation(law: str) -> Topic:
    peers = tuple(
        Method(f"{law}-{peer}", f"{peer}, which gives the same trajectory", (500, 1000, 2000, 4000), peer)
        for peer in ("fodeint", "pycaputo")
    )
    ours = Method(f"{law}-ours", "fomas_verify", (1000, 4000, 16_000, 128_000, 1_024_000))
    return Topic(f"Simulation, {law} law", "samples", "The paper's design, the states at every sample.", (ours, *peers))


TOPICS = (
    Topic(
        "Horizon",
        "samples",
        "Inequality (14) at each sample of the paper's design, 50 digits; every term is added.",
        (
            Method("horizon-ours", "fomas_verify, rigorous", (10**4, 10**5, 10**6, 10**7)),
            Method("horizon-arb", "plain loop in Arb, 200 bits", (10**4, 10**5, 10**6)),
            Method("horizon-mpmath", "plain loop in mpmath, not rigorous", (10**3, 10**4, 10**5)),
        ),
    ),
    Topic(
        "lambda2 of a grid",
        "agents",
        "The second smallest eigenvalue of the Laplacian of a grid of n times n + 1 agents.",
        (
            Method("lambda2-ours", "fomas_verify, a proved bound", (16, 32, 100, 316)),
            Method("lambda2-eigsh", "scipy's `eigsh`, shift-invert, nothing proved", (16, 32, 100, 316)),
            Method("lambda2-dense", "numpy's `eigvalsh`, nothing proved", (16, 22, 32, 45)),
            Method("lambda2-arb", "Arb: all roots of the exact characteristic polynomial", (5, 7, 9, 11)),
        ),
        agents=True,
    ),
    Topic(
        "Region and LMI",
        "agents",
        "The region of a weighted digraph: found, proved and held against the LMI; beside it one solve of the LMI.",
        (
            Method("lmi-ours", "`region --solver lmi`, certified", (5, 10, 20, 30)),
            Method("lmi-bare", "cvxpy and clarabel, one solve, nothing proved", (5, 10, 20, 30)),
        ),
    ),
    _simulation("proposed"),
    _simulation("memoryless"),
)

STARTS = {
    "`python -c pass`": ("-c", "pass"),
    "`verify-design --version`": (*TOOL, "--version"),
    "`verify-design prove` of the paper's design": (*TOOL, "prove", PAPER),
    "`import flint`": ("-c", "import flint"),
    "`import numpy`": ("-c", "import numpy"),
    "`import cvxpy`": ("-c", "import cvxpy"),
}

CHECKED = (5, 10, 20, 40)
"""Agents of the designs that are proved and checked."""
