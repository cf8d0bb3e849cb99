"""The grid of a sweep: from a file to its rows, each of which is one design.

The file is a design with a table [grid], which names what is swept. Rows are numbered from 0: graphs vary slowest, then
alpha, then gamma or mu, then h, so that neighbours share what is computed of a graph.
Source: the section on sweeps in the README.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from math import prod
from os import PathLike
from typing import Any, Final

from fomas_verify.design import Design, DesignError, design_from_mapping
from fomas_verify.design.document import format_of, parse_document, read_text
from fomas_verify.design.fields import Place, table
from fomas_verify.design.graph_file import Folder, folder_of
from fomas_verify.design.graph_table import read_listed_graph
from fomas_verify.exact.errors import source_name
from fomas_verify.exact.rational import format_rational
from fomas_verify.network import SHAPED_FAMILIES
from fomas_verify.sweep.axes import (
    Axis,
    read_agents,
    read_agents_of_one,
    read_families,
    read_numbers,
    read_shape,
    read_shapes,
)

NUMBERS: Final = ("alpha", "gamma", "mu", "h")
OF_GRAPHS: Final = ("family", "agents", "shape")
MOST_ROWS: Final = 1_000_000
"""A grid with more rows is refused unless the call allows more."""

GraphKeys = Mapping[str, Any]


@dataclass(frozen=True)
class Grid:
    """What is swept, and the design that the rest comes from.

    Attributes
    ----------
    source : str
        The file, for messages.
    base : mapping
        The keys of the design other than [grid], as parsed; the edges in place of the name of a graph file, so that
        whoever computes reads no file.
    graph_axes : tuple of str
        Which of family, agents and shape are swept.
    graphs : tuple of mappings
        The keys of [graph] that each graph has of its own; one empty mapping where no graph is swept.
    axes : tuple of Axis
        The swept numbers, in the order alpha, gamma, mu, h.
    remarks : tuple of str
        What the user must know about the reading of the graph file.
    """

    source: str
    base: Mapping[str, object]
    graph_axes: tuple[str, ...]
    graphs: tuple[GraphKeys, ...]
    axes: tuple[Axis, ...]
    remarks: tuple[str, ...] = ()

    @property
    def rows(self) -> int:
        """The number of designs."""
        return len(self.graphs) * self.rows_of_a_graph

    @property
    def rows_of_a_graph(self) -> int:
        """The rows that follow one another with the same graph."""
        return prod(len(axis.values) for axis in self.axes)

    @property
    def names(self) -> tuple[str, ...]:
        """The swept parameters, slowest first."""
        return (*self.graph_axes, *(axis.name for axis in self.axes))

    def numbers(self, row: int) -> dict[str, Fraction]:
        """The swept numbers of a row; exact."""
        found = {}
        for axis in reversed(self.axes):
            row, i = divmod(row, len(axis.values))
            found[axis.name] = axis.values[i]
        return {axis.name: found[axis.name] for axis in self.axes}

    def graph_keys(self, graph: int) -> GraphKeys:
        """The table [graph] of this graph; where families are swept, without the size that is of no use to its own."""
        given = self.base.get("graph", {})
        keys = {**(given if isinstance(given, Mapping) else {}), **self.graphs[graph]}
        if "family" in self.graph_axes:
            keys.pop("agents" if keys["family"] in SHAPED_FAMILIES else "shape", None)
        return keys

    def graph_value(self, graph: int, name: str) -> str | int | None:
        """What family, agents or shape is on this graph, "3x4" for a shape; None where it has none."""
        keys = self.graph_keys(graph)
        shape = keys.get("shape")
        if name == "shape":
            return None if shape is None else "x".join(map(str, shape))
        value: str | int | None = prod(shape) if name == "agents" and shape is not None else keys.get(name)
        return value

    def design_on(self, graph: int) -> Design:
        """The design on this graph with the first value of each swept number.

        Raises
        ------
        DesignError
            There is none, such as a hypercube of 5 agents.
        """
        first = {axis.name: axis.values[0] for axis in self.axes}
        mapping = {**self.base, **first}
        if self.graph_axes:
            mapping["graph"] = self.graph_keys(graph)
        return design_from_mapping(mapping, self.source)


def read_grid(path: str | PathLike[str], *, allow_outside: bool = False) -> Grid:
    """Read a grid file, TOML or JSON.

    Parameters
    ----------
    path : path
        A design file with a table [grid]: lists, or for numbers `{from, to, steps}`, under `alpha`, `gamma`, `mu`, `h`,
        `family`, `agents`, `shape`. What stands in [grid] stands nowhere else.
    allow_outside : bool
        Whether its graph file may lie outside its folder.

    Returns
    -------
    Grid
        At least one of its graphs makes a valid design with every combination of the numbers.

    Raises
    ------
    DesignError
        With one line that names the file, the key and what was expected.
    """
    text, source = read_text(path), source_name(path)
    folder = folder_of(path, allow_outside=allow_outside)
    return grid_from_mapping(parse_document(text, format_of(path, text), source), source, folder)


def grid_from_mapping(mapping: Mapping[str, object], source: str = "grid", folder: Folder | None = None) -> Grid:
    """Read a grid from a mapping with the keys of the grid file; otherwise as `read_grid`."""
    place = Place(source).key("grid")
    if "grid" not in mapping:
        raise place.expected("a table of what is swept", None)
    swept = table(mapping["grid"], place, (*NUMBERS, *OF_GRAPHS))
    if not swept:
        raise place.expected("at least one of alpha, gamma, mu, h, family, agents, shape", swept)
    base = {key: value for key, value in mapping.items() if key != "grid"}
    for key in NUMBERS:
        if key in swept and key in base:
            raise DesignError(f"{place.key(key)}: expected {key} either in [grid] or above it, got both")
    axes = tuple(read_numbers(key, swept[key], place.key(key)) for key in NUMBERS if key in swept)
    graph_axes = tuple(key for key in OF_GRAPHS if key in swept)
    base, remarks = _with_edges(base, Place(source).key("graph"), folder)
    if graph_axes and remarks is not None:
        raise DesignError(f"{place.key(graph_axes[0])}: expected no {graph_axes[0]} where the graph is a file's")
    grid = Grid(source, base, graph_axes, _graphs(swept, base, place), axes, remarks or ())
    _first_design(grid).needs("mu", command="sweep")
    return grid


def _with_edges(
    base: dict[str, object], place: Place, folder: Folder | None
) -> tuple[dict[str, object], tuple[str, ...] | None]:
    """The base with edges in place of its graph file, and what must be known of the reading; None for no file."""
    given = base.get("graph")
    if not isinstance(given, Mapping) or "file" not in given:
        return base, None
    graph, remarks = read_listed_graph(given, place, folder)
    edges = [[source, target, format_rational(weight)] for source, target, weight in graph.edges]
    return {**base, "graph": {"agents": graph.agents, "edges": edges}}, remarks


def _graphs(swept: Mapping[str, object], base: Mapping[str, object], place: Place) -> tuple[GraphKeys, ...]:
    """Each family with each of its sizes: the shapes for torus and grid, the numbers of agents for the others."""
    graph = Place(place.source).key("graph")
    given = base.get("graph", {})
    if any(key in swept for key in OF_GRAPHS) and not isinstance(given, Mapping):
        raise graph.expected("a table", given)
    given = given if isinstance(given, Mapping) else {}
    if "family" in swept:  # no family may need it, so nobody else would read it
        for key, read in (("agents", read_agents_of_one), ("shape", read_shape)):
            if key in given:
                read(given[key], graph.key(key))
    for key in OF_GRAPHS:
        if key in swept and key in given:
            raise DesignError(f"{place.key(key)}: expected {key} either in [grid] or in [graph], got both")
    readers = {"family": read_families, "agents": read_agents, "shape": read_shapes}
    found: dict[str, tuple[Any, ...]] = {
        key: readers[key](swept[key], place.key(key)) for key in OF_GRAPHS if key in swept
    }
    graphs: list[GraphKeys] = []
    for family in found.get("family", (given.get("family"),)):
        size = "shape" if isinstance(family, str) and family in SHAPED_FAMILIES else "agents"
        named = {"family": family} if "family" in found else {}
        graphs += [{**named, size: value} for value in found[size]] if size in found else [named]
    return tuple(graphs)


def _first_design(grid: Grid) -> Design:
    """A design of the grid; the first refusal where there is none."""
    refusals = []
    for graph in range(len(grid.graphs)):
        try:
            return grid.design_on(graph)
        except DesignError as error:
            refusals.append(error)
    raise refusals[0]


def at_row(design: Design, numbers: Mapping[str, Fraction]) -> Design:
    """A design with these numbers in place of its own."""
    given: dict[str, Any] = dict(numbers)
    return replace(design, **given)
