"""The weighted digraph of agents.

Notation: an edge `(from, to, weight)` says that agent `to` hears agent `from`: `a_(to, from) = weight > 0`. Agents
count from 1. Source: the paper's connectivity matrix A, with any positive rational weight in place of 1.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

from fomas_verify.exact.errors import FomasError
from fomas_verify.exact.rational import format_rational

Edge = tuple[int, int, Fraction]


class GraphError(FomasError, ValueError):
    """A digraph cannot be what was asked for."""


@dataclass(frozen=True)
class Digraph:
    """A digraph on agents 1..N with positive rational weights.

    Attributes
    ----------
    agents : int
        N >= 2.
    edges : tuple of (from, to, weight)
        Agent `to` hears agent `from` with weight > 0; sorted by (from, to), no self-loop, no pair twice; may be empty.

    Raises
    ------
    GraphError
        One of these conditions fails.
    """

    agents: int
    edges: tuple[Edge, ...]

    def __post_init__(self) -> None:
        if self.agents < 2:
            raise GraphError(f"expected at least 2 agents, got {self.agents}")
        for source, target, weight in self.edges:
            if not (1 <= source <= self.agents and 1 <= target <= self.agents):
                raise GraphError(f"expected agents between 1 and {self.agents}, got the edge from {source} to {target}")
            if source == target:
                raise GraphError(f"expected no self-loop, got one at agent {source}")
            if weight <= 0:
                raise GraphError(
                    f"expected positive weights, got {format_rational(weight)} on the edge from {source} to {target}"
                )
        for one, two in pairwise(self.edges):
            if one[:2] >= two[:2]:
                raise GraphError(f"expected edges sorted and each once, got {one[:2]} before {two[:2]}")


def digraph(agents: int, edges: Iterable[Edge]) -> Digraph:
    """Build a digraph from edges `(from, to, weight)` in any order; raises `GraphError` as `Digraph` does."""
    return Digraph(agents, tuple(sorted(edges)))
