"""A design as the attack sees it: exact numbers, and the matrices built from them by definition.

Notation: a_ij is the weight with which agent i hears agent j; L = diag(A 1) - A; D the largest row sum of A;
V = [I; -1^T] the basis of 1perp; Lc the action of L on the differences from agent N.
Source: docs/certificate-format.md.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from fractions import Fraction
from functools import lru_cache

from .exact import Matrix, combine, identity, matmul, transpose

Edge = tuple[int, int, Fraction]
Start = tuple[Fraction, ...] | tuple[tuple[Fraction, ...], ...]


@dataclass(frozen=True)
class Design:
    """alpha, the gain (gamma and h, or mu), edges (from, to, weight) and x_0; agents count from 1.

    `settle_to` is asked of the prover and is no part of the design that a certificate is about.
    """

    alpha: Fraction
    agents: int
    edges: tuple[Edge, ...]
    mu: Fraction | None = None
    gamma: Fraction | None = None
    h: Fraction | None = None
    x0: Start | None = None
    settle_to: Fraction | None = field(default=None, compare=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "edges", tuple(sorted(self.edges)))

    def mapping(self, name: str) -> dict[str, object]:
        """The design as a user would write it, for a design file."""
        given = {"alpha": self.alpha, "mu": self.mu, "gamma": self.gamma, "h": self.h, "settle_to": self.settle_to}
        numbers: dict[str, object] = {key: str(value) for key, value in given.items() if value is not None}
        edges = [[source, target, str(weight)] for source, target, weight in self.edges]
        start = {} if self.x0 is None else {"x0": [_written(entry) for entry in self.x0]}
        return {"name": name, **numbers, **start, "graph": {"agents": self.agents, "edges": edges}}


Ends = tuple[Fraction, Fraction]


@dataclass(frozen=True)
class Uncertain:
    """A design whose numbers lie in intervals; one that is fixed has equal ends."""

    alpha: Ends
    agents: int
    edges: tuple[Edge, ...]
    mu: Ends | None = None
    gamma: Ends | None = None
    h: Ends | None = None
    x0: Start | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "edges", tuple(sorted(self.edges)))

    def ends(self) -> dict[str, Ends]:
        """The numbers given, as intervals."""
        given = {"alpha": self.alpha, "gamma": self.gamma, "mu": self.mu, "h": self.h}
        return {key: ends for key, ends in given.items() if ends is not None}

    def member(self, numbers: dict[str, Fraction], side: int = 0) -> Design:
        """The member with these numbers, the others at their lower (0) or upper (1) ends."""
        chosen = {**{key: ends[side] for key, ends in self.ends().items()}, **numbers}
        return Design(agents=self.agents, edges=self.edges, x0=self.x0, **chosen)

    def mapping(self, name: str) -> dict[str, object]:
        """The design as a user would write it, for a design file."""
        given = {key: [str(x) for x in ends] for key, ends in self.ends().items() if ends[0] != ends[1]}
        return {**self.member({}).mapping(name), **given}


def _written(entry: Fraction | tuple[Fraction, ...]) -> str | list[str]:
    return [str(x) for x in entry] if isinstance(entry, tuple) else str(entry)


def x0_columns(design: Design) -> tuple[tuple[Fraction, ...], ...]:
    """x_0 as columns of N numbers, one for each dimension of the agents; none where it is not given."""
    rows = [entry if isinstance(entry, tuple) else (entry,) for entry in design.x0 or ()]
    return tuple(zip(*rows, strict=True))


@lru_cache(maxsize=512)
def _adjacency(design: Design) -> tuple[tuple[Fraction, ...], ...]:
    a = [[Fraction(0)] * design.agents for _ in range(design.agents)]
    for source, target, weight in design.edges:
        a[target - 1][source - 1] = weight
    return tuple(tuple(row) for row in a)


def adjacency(design: Design) -> Matrix:
    """A, with a_ij the weight with which agent i hears agent j."""
    return [list(row) for row in _adjacency(design)]


def laplacian(design: Design) -> Matrix:
    """L = diag(A 1) - A."""
    a = adjacency(design)
    return [[sum(row) - x if i == j else -x for j, x in enumerate(row)] for i, row in enumerate(a)]


@lru_cache(maxsize=512)
def degree_max(design: Design) -> Fraction:
    """D, the largest row sum of A."""
    return max(sum(row, Fraction(0)) for row in adjacency(design))


def symmetric_part(a: Matrix) -> Matrix:
    """(a + a^T)/2."""
    return combine(Fraction(1, 2), a, Fraction(1, 2), transpose(a))


def basis(n: int) -> Matrix:
    """V = [I; -1^T], whose columns span the vectors that sum to 0."""
    return [*identity(n - 1), [Fraction(-1)] * (n - 1)]


def on_1perp(form: Matrix) -> Matrix:
    """V^T form V: the quadratic form on 1perp, in the basis V."""
    v = basis(len(form))
    return matmul(transpose(v), matmul(form, v))


def on_differences(design: Design) -> Matrix:
    """Lc with entries L_ij - L_Nj, i, j < N."""
    lap = laplacian(design)
    n = design.agents - 1
    return [[lap[i][j] - lap[n][j] for j in range(n)] for i in range(n)]


def perron_on_differences(design: Design, t: Fraction) -> Matrix:
    """Pc(t) = I - t Lc."""
    return combine(Fraction(1), identity(design.agents - 1), -t, on_differences(design))


@lru_cache(maxsize=512)
def reachability(design: Design) -> tuple[tuple[bool, ...], ...]:
    """Entry [i][j] tells whether a directed path leads from agent i+1 to agent j+1 (Warshall's closure)."""
    n = design.agents
    reach = [[i == j for j in range(n)] for i in range(n)]
    for source, target, _ in design.edges:
        reach[source - 1][target - 1] = True
    for k in range(n):
        for i in range(n):
            if reach[i][k]:
                reach[i] = [x or y for x, y in zip(reach[i], reach[k], strict=True)]
    return tuple(tuple(row) for row in reach)


def strongly_connected(design: Design) -> bool:
    """Whether a directed path leads from every agent to every other."""
    return all(all(row) for row in reachability(design))


@lru_cache(maxsize=512)
def in_and_out(design: Design) -> tuple[tuple[Fraction, Fraction], ...]:
    """For each agent the sums (sum_j a_ij, sum_j a_ji)."""
    a = adjacency(design)
    return tuple(
        (sum(row, Fraction(0)), sum(column, Fraction(0))) for row, column in zip(a, zip(*a, strict=True), strict=True)
    )


@lru_cache(maxsize=512)
def assumption_1(design: Design) -> bool:
    """Assumption 1: strongly connected and balanced."""
    return strongly_connected(design) and all(x == y for x, y in in_and_out(design))
