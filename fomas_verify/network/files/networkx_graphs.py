"""Graphs of networkx: edges with the attribute `weight`, or none of them with it.

An undirected edge goes both ways.
"""

from __future__ import annotations

from typing import Any

from fomas_verify.exact.rational import excerpt
from fomas_verify.network.files.entries import Entries
from fomas_verify.network.files.names import numbering
from fomas_verify.network.files.refusals import refused
from fomas_verify.network.files.weights import SHORTEST, is_float, ratios_of_objects


def entries_of_networkx(graph: Any, name: str, weight: str = "weight", default: object = None) -> Entries:
    """The edges of a networkx graph.

    Parameters
    ----------
    graph : networkx.Graph or networkx.DiGraph
        Nodes of any kind: integers in their numerical order, others in the order of the graph.
    weight : str
        The attribute that holds a number, or a text such as "1/2".
    default : object
        The weight of an edge without it, where the format gives one.

    Raises
    ------
    GraphFileError
        It is a multigraph, or some edges have a weight and some have none.
    """
    import numpy as np

    if graph.is_multigraph():
        raise refused(name, "a graph with each edge once", "a multigraph (add the weights of parallel edges)")
    names = {node: position for position, node in enumerate(graph.nodes)}
    agents, remarks = numbering(_texts(names, name))
    order = np.array(agents, dtype=np.int64)
    edges = list(graph.edges(data=True))
    ends = np.array([(names[u], names[v]) for u, v, _ in edges], dtype=np.int64).reshape(-1, 2)
    values = [data.get(weight, default) for _, _, data in edges]
    missing = [i for i, value in enumerate(values) if value is None]

    def place(entry: int) -> str:
        u, v, _ = edges[entry]
        return f"the edge from {excerpt(str(u))} to {excerpt(str(v))}"

    if missing and len(missing) < len(values):
        where = f"{name}: {place(missing[0])}"
        raise refused(where, f"the attribute {excerpt(weight)} on every edge or on none", "none, though others have it")
    if missing:
        values = [1] * len(values)
        if others := sorted({str(key) for _, _, data in edges for key in data}):
            remarks += (f"no edge has the attribute {excerpt(weight)}: every weight is 1, {others[0]!r} is not read",)
    if any(map(is_float, values)):
        remarks += (SHORTEST,)
    return Entries(
        len(names), order[ends[:, 0]], order[ends[:, 1]], np.arange(len(edges)), lambda: ratios_of_objects(values),
        place, not graph.is_directed(), remarks,
    )  # fmt: skip


def _texts(names: dict[Any, int], name: str) -> list[str]:
    """The nodes as texts, each its own."""
    texts = [str(node) for node in names]
    if len(set(texts)) != len(texts):
        twice = next(text for i, text in enumerate(texts) if text in texts[:i])
        raise refused(name, "nodes with different names", f"{excerpt(twice)} twice, of different kinds")
    return texts
