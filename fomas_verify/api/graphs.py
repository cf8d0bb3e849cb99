"""The graph of a design from what Python users have, as the table [graph] of a design file."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import Any

from fomas_verify.api.values import plain
from fomas_verify.design import DesignError
from fomas_verify.design.fields import shown
from fomas_verify.design.model import MOST_AGENTS_EXACTLY
from fomas_verify.network.files import (
    FROM_TO,
    HEARS,
    GraphFile,
    graph_from_matrix,
    graph_from_networkx,
    read_graph_file,
)
from fomas_verify.network.sparse import SparseDigraph

Found = tuple[Mapping[str, object] | SparseDigraph, tuple[str, ...]]

_NAME = "design: graph"


def graph_table(
    graph: Any, orientation: str | None = None, agents: int | None = None, shape: Sequence[int] | None = None
) -> Found:
    """The table, or a digraph too large for one, and what the user must know about the reading.

    Parameters
    ----------
    graph : object
        A networkx graph; a square matrix of numpy, scipy or pandas; rows ``a_ij`` (agent i hears j) as lists; edges
        ``(from, to)`` or ``(from, to, weight)`` with `agents`; the name of a family with `agents` or `shape`; the path
        of a graph file, as a path and not a text; or a table of a design file.
    orientation : {"hears", "from-to"}, optional
        Of a matrix, which needs it, and of a file.
    agents : int, optional
        With edges and with a family.
    shape : pair of int, optional
        With the families grid and torus.

    Raises
    ------
    DesignError, GraphError
        It is none of these.
    """
    beside = {key: value for key, value in {"agents": agents, "shape": shape}.items() if value is not None}
    found = _table(graph, orientation, beside)
    if found is not None:
        return found
    if beside:
        raise DesignError(f"design: {next(iter(beside))}: expected only with edges or a family")
    if isinstance(graph, PathLike):
        return _of_file(read_graph_file(Path(graph), orientation, name=f"{_NAME}: {graph}"))
    if hasattr(graph, "is_multigraph") and hasattr(graph, "nodes"):
        return _of_file(graph_from_networkx(graph, _NAME, orientation=_one_of(orientation, FROM_TO)))
    if hasattr(graph, "shape"):
        if orientation is None:
            raise DesignError(
                'design: orientation: expected "hears" (a_ij: i hears j) or "from-to" (row i holds who hears i), got '
                "none: a matrix does not say it"
            )
        return _of_file(graph_from_matrix(graph, _one_of(orientation, HEARS), _NAME))
    raise DesignError(f"{_NAME}: expected a graph, a matrix, edges, a family or the path of a file, got {shown(graph)}")


def _table(graph: Any, orientation: str | None, beside: dict[str, Any]) -> Found | None:
    """What is written as in a design file."""
    if isinstance(graph, list | tuple) and "agents" not in beside:
        rows: object = plain(graph)
        if _one_of(orientation, HEARS) == FROM_TO and isinstance(rows, list):
            rows = _transposed(rows)
        return {"adjacency": rows, **beside}, ()
    if isinstance(graph, list | tuple):
        table: dict[str, object] = {"edges": plain(graph)}
    elif isinstance(graph, str):
        table = {"family": graph}
    elif isinstance(graph, Mapping):
        table = {str(key): plain(value) for key, value in graph.items()}
    else:
        return None
    if orientation is not None:
        raise DesignError("design: orientation: expected only with a matrix, rows, a networkx graph or a file")
    return table | {key: plain(value) for key, value in beside.items()}, ()


def _transposed(rows: list[Any]) -> list[Any]:
    if not all(isinstance(row, list) and len(row) == len(rows) for row in rows):
        raise DesignError(f"{_NAME}: expected a square matrix")
    return [list(column) for column in zip(*rows, strict=True)]


def _one_of(orientation: str | None, default: str) -> str:
    if orientation not in (None, FROM_TO, HEARS):
        raise DesignError(f"design: orientation: expected {HEARS} or {FROM_TO}, got {shown(orientation)}")
    return orientation or default


def _of_file(found: GraphFile) -> Found:
    remarks = tuple(f"graph: {remark}" for remark in found.remarks)
    if found.graph.agents > MOST_AGENTS_EXACTLY:
        return found.graph, remarks
    graph = found.graph.to_digraph()
    return {"agents": graph.agents, "edges": graph.edges}, remarks
