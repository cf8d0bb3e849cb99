"""The table [graph]: exactly one of adjacency, edges, file and family.

Notation: `adjacency[i][j]` is a_ij, agent i hears agent j; an edge `[from, to, weight]` says that `to` hears `from`.
Agents count from 1.
"""

from collections.abc import Callable, Mapping
from fractions import Fraction
from math import lcm
from typing import Final

from fomas_verify.design.errors import DesignError
from fomas_verify.design.fields import Place, choice, count, number, one_of, positive, sequence, shown, table
from fomas_verify.design.graph_file import Folder, read_file
from fomas_verify.design.model import MAX_LISTED_AGENTS, MOST_AGENTS_EXACTLY
from fomas_verify.network import FAMILIES, SHAPED_FAMILIES, Digraph, Edge, GraphError, digraph, family
from fomas_verify.network.large import MOST_AGENTS, LargeGraph, large_family
from fomas_verify.network.sparse import SparseDigraph

MAX_FAMILY: Final = 2**64
MAX_DENOMINATOR_BITS: Final = 256

Graph = Digraph | LargeGraph
"""A digraph on at most 100 agents, or a larger one."""

_FORMS = ("adjacency", "edges", "file", "family")
# The keys that may stand beside each form.
_COMPANIONS: dict[str, tuple[str, ...]] = {
    "adjacency": (),
    "edges": ("agents",),
    "file": ("orientation", "variable"),
    "family": ("agents", "shape"),
}
_BESIDE = {
    "agents": "edges or a family",
    "shape": " or ".join(SHAPED_FAMILIES),
    "orientation": "a file",
    "variable": "a file",
}
_ONE = Fraction(1)


def read_graph(value: object, place: Place, folder: Folder | None = None) -> tuple[Graph, tuple[str, ...]]:
    """Read the table [graph]; with what the user must know about the reading of its file, where it names one.

    Parameters
    ----------
    value : object
        The table; or, from Python, the digraph itself.
    place : Place
        Where it stands.
    folder : Folder, optional
        Where its file may lie; a design that is no file has none.

    Raises
    ------
    DesignError
        It does not describe a digraph on 2 to 2^22 agents, of a family 2^64, whose weights are positive and have a
        common denominator of at most 256 bits.
    """
    if isinstance(value, SparseDigraph):
        return _sized(value), ()
    graph = table(value, place, (*_FORMS, *_BESIDE))
    forms = [form for form in _FORMS if form in graph]
    if len(forms) != 1:
        got = " and ".join(forms) or "none of them"
        raise DesignError(f"{place}: expected exactly {one_of(_FORMS)}, got {got}")
    form = forms[0]
    for key in _BESIDE:
        if key in graph and key not in _COMPANIONS[form]:
            raise DesignError(f"{place.key(key)}: expected only with {_beside(key)}, got it with {form}")
    if form == "file":
        read = read_file(graph, place, folder)
        return _sized(read.graph), read.remarks
    readers: dict[str, Callable[[Mapping[str, object], Place], Graph]] = {
        "adjacency": _from_adjacency,
        "edges": _from_edges,
        "family": _from_family,
    }
    return _sized(readers[form](graph, place)), ()


def read_listed_graph(
    value: object, place: Place, folder: Folder | None = None, *, most: int = MAX_LISTED_AGENTS
) -> tuple[Digraph, tuple[str, ...]]:
    """As `read_graph`, where more than so many agents are not supported."""
    graph, remarks = read_graph(value, place, folder)
    if isinstance(graph, Digraph):
        return graph, remarks
    if graph.agents > most:
        raise place.unsupported(f"{shown(graph.agents)} agents, more than {most}, are")
    return graph.digraph(), remarks


def _sized(graph: Graph | SparseDigraph) -> Graph:
    """The graph in the form that belongs to its size."""
    if isinstance(graph, LargeGraph):
        return graph
    if graph.agents > MOST_AGENTS_EXACTLY:
        return LargeGraph(listed=graph)
    return graph.to_digraph() if isinstance(graph, SparseDigraph) else graph


def _from_adjacency(graph: Mapping[str, object], place: Place) -> Digraph:
    where = place.key("adjacency")
    rows = sequence(graph["adjacency"], where, "a list of rows")
    if len(rows) < 2:
        raise where.expected("at least 2 rows", rows)
    agents = _agents(len(rows), where)
    edges: list[Edge] = []
    weights = _Weights()
    for i, row in enumerate(rows):
        row_place = where.item(i)
        entries = sequence(row, row_place, f"a row of {agents} numbers", agents)
        for j, entry in enumerate(entries):
            if type(entry) is int and entry == 0:
                continue
            here = row_place.item(j)
            weight = number(entry, here)
            if weight < 0:
                raise here.expected("a weight >= 0", entry)
            if weight and i == j:
                raise here.expected("0 on the diagonal (no self-loop)", entry)
            if weight:
                edges.append((j + 1, i + 1, weights.admit(weight, here)))
    return digraph(agents, edges)


def _from_edges(graph: Mapping[str, object], place: Place) -> Digraph:
    agents = _agents(graph.get("agents"), place.key("agents"))
    where = place.key("edges")
    found: dict[tuple[int, int], Fraction] = {}
    weights = _Weights()
    for position, value in enumerate(sequence(graph["edges"], where, "a list of edges")):
        here = where.item(position)
        source, target, weight = _edge(value, here, agents)
        if (source, target) in found:
            raise DesignError(f"{here}: expected each edge once, got the edge from {source} to {target} again")
        found[source, target] = weights.admit(weight, here)
    return digraph(agents, ((*ends, weight) for ends, weight in found.items()))


def _edge(value: object, place: Place, agents: int) -> Edge:
    entries = sequence(value, place, "an edge [from, to] or [from, to, weight]")
    if len(entries) not in (2, 3):
        raise place.expected("an edge [from, to] or [from, to, weight]", value)
    source, target = (count(entry, place.item(end), 1, agents) for end, entry in enumerate(entries[:2]))
    if source == target:
        raise DesignError(f"{place}: expected two different agents (no self-loop), got {source} twice")
    return source, target, positive(entries[2], place.item(2), "a weight") if len(entries) == 3 else _ONE


def _from_family(graph: Mapping[str, object], place: Place) -> Graph:
    name = choice(graph["family"], place.key("family"), "a family", (*FAMILIES, *SHAPED_FAMILIES))
    if name in FAMILIES:
        if "shape" in graph:
            raise DesignError(f"{place.key('shape')}: expected only with {_beside('shape')}, got it with {name}")
        where = place.key("agents")
        agents = _agents(graph.get("agents"), where, MAX_FAMILY)
        return _built(name, where, agents=agents)
    where = place.key("shape")
    sides = sequence(graph.get("shape"), where, "two integers [rows, columns]", 2)
    rows, columns = (count(side, where.item(i), 1) for i, side in enumerate(sides))
    if rows * columns > 1:
        _agents(rows * columns, where, MAX_FAMILY)
    if "agents" in graph and count(graph["agents"], place.key("agents"), 2) != rows * columns:
        raise place.key("agents").expected(f"{rows * columns}, as the shape says", graph["agents"])
    return _built(name, where, shape=(rows, columns))


def _built(name: str, place: Place, *, agents: int | None = None, shape: tuple[int, int] | None = None) -> Graph:
    try:
        large = large_family(name, agents=agents, shape=shape)
        if large.agents > MOST_AGENTS_EXACTLY:
            return large
        return family(name, agents=agents, shape=shape)
    except GraphError as error:
        raise DesignError(f"{place}: {error}") from None


def _agents(value: object, place: Place, most: int = MOST_AGENTS) -> int:
    agents = count(value, place, 2)
    if agents > most:
        raise place.unsupported(f"{shown(agents)} agents, more than {most}, are")
    return agents


def _beside(key: str) -> str:
    return _BESIDE[key]


class _Weights:
    """The common denominator of the weights so far, kept within its bound."""

    def __init__(self) -> None:
        self._denominator = 1

    def admit(self, weight: Fraction, place: Place) -> Fraction:
        self._denominator = lcm(self._denominator, weight.denominator)
        if self._denominator.bit_length() > MAX_DENOMINATOR_BITS:
            raise place.expected(f"weights whose common denominator has at most {MAX_DENOMINATOR_BITS} bits", weight)
        return weight
