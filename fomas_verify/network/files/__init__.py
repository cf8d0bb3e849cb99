"""Graphs that people have: files of other programs, networkx graphs and matrices, as exact sparse digraphs.

Needs the extra `graphs`. Text is read exactly as decimals and fractions; binary floats as their shortest decimals.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Any, Final

from fomas_verify.exact.errors import source_name
from fomas_verify.exact.inputs import remember
from fomas_verify.exact.rational import shortened
from fomas_verify.network.files.entries import BOTH_WAYS, FROM_TO, HEARS, ORIENTATIONS, Entries, assemble
from fomas_verify.network.files.refusals import GraphFileError, must_be_file, need_extra, refused
from fomas_verify.network.sparse import SparseDigraph

MATRIX_FORMATS: Final = (".csv", ".mtx", ".npz", ".mat")
EDGE_FORMATS: Final = (".graphml", ".edgelist")
FORMATS: Final = (*EDGE_FORMATS, *MATRIX_FORMATS)
VARIABLE_FORMATS: Final = (".npz", ".mat")


@dataclass(frozen=True, eq=False)
class GraphFile:
    """A graph, and what the user must know about its reading, a line each."""

    graph: SparseDigraph
    remarks: tuple[str, ...] = ()


def read_graph_file(
    path: str | PathLike[str], orientation: str | None = None, *, variable: str | None = None, name: str | None = None
) -> GraphFile:
    """Read a graph file by the format that its ending names.

    Parameters
    ----------
    path : path
        ``.graphml``, ``.edgelist`` (networkx's text), ``.csv`` (adjacency), ``.mtx``, ``.npz`` (of scipy, or a square
        array) or ``.mat`` (version 4 to 7.2).
    orientation : str, optional
        ``"from-to"``: an edge, or entry, (i, j) says that j hears i; ``"hears"``: that i hears j, as a_ij does;
        ``"both-ways"``, of an edge list only: both. A matrix needs it; of edges it is ``"from-to"`` by default. An
        undirected graph and a symmetric matrix go both ways, whatever it is.
    variable : str, optional
        The name of the matrix in an ``.npz`` or ``.mat`` file with several square ones.
    name : str, optional
        What messages call the file.

    Returns
    -------
    GraphFile
        Exact; in time n log n and memory linear in the file.

    Raises
    ------
    GraphFileError
        The file is not of its format, or its graph is none: fewer than 2 agents, a self-loop, a negative or infinite
        weight, an edge twice, a weight on some edges only, a common denominator of more than 256 bits, an imbalance
        below 1e-12 of a degree.
    MissingExtraError
        A library of the extra `graphs` is not installed.
    """
    found, called = Path(path), name or source_name(path)
    ending = check_call(found.name, orientation, variable, called)
    need_extra("numpy")
    must_be_file(found, called)
    remember(found)
    try:
        entries = _reader(ending, variable)(found, called)
        return GraphFile(assemble(entries, orientation or FROM_TO, called), entries.remarks)
    except MemoryError:
        raise refused(called, "a graph for which there is memory", "a larger one") from None


def check_call(file: str, orientation: str | None, variable: str | None, name: str) -> str:
    """The ending of a file's name; refuse what does not go with it, a matrix without orientation too."""
    ending = Path(file).suffix.lower()
    if ending not in FORMATS:
        raise refused(name, f"a name that ends in one of {', '.join(FORMATS)}", shortened(ending) or "no ending")
    if orientation is None and ending in MATRIX_FORMATS:
        raise refused(
            name, 'orientation = "hears" (row i holds whom i hears) or "from-to" (row i holds who hears i)',
            f"none: a {ending} file does not say it",
        )  # fmt: skip
    choices = ORIENTATIONS if ending == ".edgelist" else (FROM_TO, HEARS)
    if orientation is not None and orientation not in choices:
        raise refused(name, f"orientation {' or '.join(choices)}", repr(orientation)[:60])
    if variable is not None and ending not in VARIABLE_FORMATS:
        raise refused(name, f"variable only with {' or '.join(VARIABLE_FORMATS)}", ending)
    return ending


def graph_from_matrix(matrix: Any, orientation: str, name: str = "graph") -> GraphFile:
    """The graph of a square matrix of numpy or scipy; raises as `read_graph_file` does."""
    entries = _matrix_entries(matrix, name)
    return GraphFile(assemble(entries, orientation, name), entries.remarks)


def graph_from_networkx(graph: Any, name: str = "graph", *, orientation: str = FROM_TO) -> GraphFile:
    """The graph of a networkx object; raises as `read_graph_file` does."""
    from fomas_verify.network.files.networkx_graphs import entries_of_networkx

    need_extra("numpy")
    entries = entries_of_networkx(graph, name)
    return GraphFile(assemble(entries, orientation, name), entries.remarks)


def _matrix_entries(matrix: Any, name: str) -> Entries:
    from fomas_verify.network.files.matrices import entries_of_matrix

    return entries_of_matrix(matrix, name)


def _reader(ending: str, variable: str | None) -> Callable[[Path, str], Entries]:
    """The reader of a format, imported when it is used."""
    from fomas_verify.network.files import adjacency_csv, edgelist, graphml, matlab, matrix_market, npz

    if ending in VARIABLE_FORMATS:
        of_variable = npz.read if ending == ".npz" else matlab.read
        return lambda path, name: of_variable(path, name, variable)
    return {
        ".graphml": graphml.read,
        ".edgelist": edgelist.read,
        ".csv": adjacency_csv.read,
        ".mtx": matrix_market.read,
    }[ending]


__all__ = [
    "BOTH_WAYS",
    "EDGE_FORMATS",
    "FORMATS",
    "FROM_TO",
    "HEARS",
    "MATRIX_FORMATS",
    "ORIENTATIONS",
    "VARIABLE_FORMATS",
    "GraphFile",
    "GraphFileError",
    "check_call",
    "graph_from_matrix",
    "graph_from_networkx",
    "read_graph_file",
]
