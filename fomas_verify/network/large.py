"""A digraph of any size: a family's, of which nothing is built before it is asked for, or its edges.

Notation as in `digraph` and `sparse`. Needs numpy and scipy, the extra `scale`, for whatever takes edges.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from hashlib import sha256
from typing import TYPE_CHECKING

from fomas_verify.exact.errors import FomasError, MissingExtraError
from fomas_verify.network.balance import Imbalance
from fomas_verify.network.digraph import Digraph
from fomas_verify.network.families import Shape, checked_size
from fomas_verify.network.family_facts import Family
from fomas_verify.network.sparse import SparseDigraph, sparse_digraph

if TYPE_CHECKING:
    from typing import Any

    from numpy.typing import NDArray

MOST_AGENTS = 1 << 22
"""Of a graph that is given by its edges."""
MOST_EDGES = 1 << 24
"""No more are written into an edge list."""
MOST_FAMILY_EDGES = 1 << 22
"""No more are built of a family, which a few words ask for."""

_BLOCK = 1 << 16


class TooManyEdgesError(FomasError):
    """A graph has more edges than are built."""

    exit_status = 3


@dataclass(frozen=True, eq=False)
class LargeGraph:
    """A digraph on at least 2 agents: one of `family`, `listed` is given.

    Attributes
    ----------
    family : Family or None
        With weight 1.
    listed : SparseDigraph, Digraph or None
        Its edges.
    """

    family: Family | None = None
    listed: SparseDigraph | Digraph | None = None

    @property
    def agents(self) -> int:
        """N."""
        return self._given.agents

    @property
    def _given(self) -> Family | SparseDigraph | Digraph:
        given = self.family or self.listed
        if given is None:
            raise TypeError("a graph is a family's or has edges")
        return given

    @property
    def edge_count(self) -> int:
        """How many directed edges it has."""
        match self._given:
            case Family() as family:
                return family.edges
            case Digraph() as graph:
                return len(graph.edges)
            case graph:
                return len(graph.sources)

    @cached_property
    def sparse(self) -> SparseDigraph:
        """Its edges as arrays.

        Raises
        ------
        TooManyEdgesError
            There are more than 2^24, or 2^22 of a family.
        MissingExtraError
            numpy or scipy is not installed.
        """
        most = MOST_EDGES if self.family is None else MOST_FAMILY_EDGES
        if self.edge_count > most:
            raise TooManyEdgesError(f"expected at most {most} edges to build, got {self.edge_count}")
        need_scale(self.agents, "numpy", "scipy")
        match self._given:
            case Family() as family:
                from fomas_verify.network.sparse_families import sparse_family

                alone = None if family.shape else family.agents
                return sparse_family(family.name, agents=alone, shape=family.shape)
            case Digraph() as graph:
                return sparse_digraph(graph)
            case graph:
                return graph

    @cached_property
    def known_family(self) -> Family | None:
        """The family with weight 1 whose graph this is, however it was given; None where it is none."""
        if self.family is not None:
            return self.family
        from fomas_verify.network.sparse_families import recognised_family

        found = recognised_family(self.sparse)
        return None if found is None or found.weight != 1 else found

    @cached_property
    def edge_list(self) -> bytes:
        """The canonical edge list; raises as `sparse`."""
        return b"".join(edge_lines(self.sparse))

    @cached_property
    def digest(self) -> str:
        """The SHA-256 digest of the edge list, in hexadecimal digits."""
        return sha256(self.edge_list).hexdigest()

    def digraph(self) -> Digraph:
        """The same with one Python object an edge."""
        return self.listed if isinstance(self.listed, Digraph) else self.sparse.to_digraph()


def need_scale(agents: int, *modules: str) -> None:
    """Raise `MissingExtraError` where one of these modules of the extra `scale` is not installed."""
    from importlib.util import find_spec

    if missing := [name for name in modules if find_spec(name) is None]:
        raise MissingExtraError(
            f"a graph of {agents} agents needs {', '.join(missing)}, which the extra `scale` brings: "
            "pip install 'fomas_verify[scale]'"
        )


def large_family(name: str, *, agents: int | None = None, shape: Shape | None = None) -> LargeGraph:
    """The graph of a family, not built; raises `GraphError` where there is none of this size, as `families.family`."""
    size = checked_size(name, agents, shape)
    return LargeGraph(Family(name, (size,) if isinstance(size, int) else size))


@dataclass(frozen=True)
class GraphFacts:
    """What Assumption 1 and the gain bound are about, exact.

    Attributes
    ----------
    degree_max : Fraction
        D.
    is_symmetric, is_directed_cycle : bool
        A = A^T; a `directed-cycle` with weight 1.
    unreachable : (i, j) or None
        The first pair without a directed path from i to j; None iff the digraph is strongly connected.
    imbalance : Imbalance or None
        The first agent that breaks the balance; None iff it is balanced.
    has_root : bool
        Whether some agent reaches every other.
    """

    degree_max: Fraction
    is_symmetric: bool
    is_directed_cycle: bool = False
    unreachable: tuple[int, int] | None = None
    imbalance: Imbalance | None = None
    has_root: bool = True

    @property
    def assumption1(self) -> bool:
        """Whether it is strongly connected and balanced."""
        return self.unreachable is None and self.imbalance is None


def graph_facts(graph: LargeGraph) -> GraphFacts:
    """The facts; of a family in no time, otherwise in O(agents + edges log edges). Exact."""
    family = graph.known_family
    if family is not None:
        return GraphFacts(family.degree_max, family.is_symmetric, family.is_directed_cycle)
    from fomas_verify.network import sparse_facts as facts

    found = graph.sparse
    unreachable = facts.sparse_unreachable_pair(found)
    return GraphFacts(
        facts.sparse_degree_max(found),
        facts.sparse_is_symmetric(found),
        unreachable=unreachable,
        imbalance=facts.sparse_imbalance(found),
        has_root=unreachable is None or facts.sparse_has_root(found),
    )


def edge_lines(graph: SparseDigraph) -> Iterator[bytes]:
    """The canonical edge list, many lines at a time: ``from to weight``, agents from 1, sorted by (from, to), the
    weight ``p`` or ``p/q`` in lowest terms.
    """
    texts: dict[int, str] = {}
    for start in range(0, len(graph.sources), _BLOCK):
        block = slice(start, start + _BLOCK)
        weights = graph.weights[block].tolist()
        texts |= {w: str(Fraction(w, graph.denominator)) for w in set(weights) - texts.keys()}
        ends = (_from_one(graph.sources[block]), _from_one(graph.targets[block]))
        yield "".join(f"{i} {j} {texts[w]}\n" for i, j, w in zip(*ends, weights, strict=True)).encode()


def _from_one(ends: NDArray[Any]) -> list[int]:
    found: list[int] = (ends + 1).tolist()
    return found
