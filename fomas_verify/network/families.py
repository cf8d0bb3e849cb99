"""Families of graphs by name, every weight 1.

In the directed cycle agent i hears agent i-1, and agent 1 hears agent N. The others go both ways: cycle, path, star
(centre 1), complete, hypercube (N = 2^d; neighbours differ in one bit of their number less 1), and on a shape [a, b],
numbered row by row, grid and torus. Source: the table of the README.
"""

from collections.abc import Callable, Iterable, Iterator
from fractions import Fraction
from itertools import combinations
from typing import Final

from fomas_verify.network.digraph import Digraph, GraphError, digraph

Shape = tuple[int, int]

MOST_COMPLETE: Final = 512  # agents; three lines of a design must not ask for a hundred million edges

_ONE = Fraction(1)


def family(name: str, *, agents: int | None = None, shape: Shape | None = None) -> Digraph:
    """Build the graph of a family.

    Parameters
    ----------
    name : str
        One of `FAMILIES` (with `agents`) or `SHAPED_FAMILIES` (with `shape`).
    agents : int, optional
        N >= 2; a power of 2 for the hypercube.
    shape : (int, int), optional
        Rows and columns: at least 2 agents for the grid, at least 3 each way for the torus.

    Returns
    -------
    Digraph
        With every weight 1.

    Raises
    ------
    GraphError
        The family is unknown, or does not exist at this size. The message says what was expected and found.
    """
    if agents is not None and name == "complete" and agents > MOST_COMPLETE:
        raise GraphError(f"expected at most {MOST_COMPLETE} agents in a complete graph, got {agents}")
    size = checked_size(name, agents, shape)
    return FAMILIES[name](size) if isinstance(size, int) else SHAPED_FAMILIES[name](size)


def checked_size(name: str, agents: int | None, shape: Shape | None) -> int | Shape:
    """The agents or the shape of a family that exists at this size; raises `GraphError` where there is none."""
    if name in FAMILIES and agents is not None and shape is None:
        if agents < 2:
            raise GraphError(f"expected at least 2 agents, got {agents}")
        if name == "hypercube" and agents & (agents - 1):
            raise GraphError(f"expected a power of 2 for a hypercube, got {agents}")
        return agents
    if name in SHAPED_FAMILIES and shape is not None and agents is None:
        if name == "grid" and (min(shape) < 1 or shape[0] * shape[1] < 2):
            raise GraphError(f"expected at least 1 row, 1 column and 2 agents for a grid, got {list(shape)}")
        if name == "torus" and min(shape) < 3:
            raise GraphError(f"expected at least 3 rows and 3 columns for a torus, got {list(shape)}")
        return shape
    raise GraphError(f"expected a family with its agents or its shape, got {name!r} with {agents=}, {shape=}")


def _directed_cycle(agents: int) -> Digraph:
    return digraph(agents, ((i, i % agents + 1, _ONE) for i in range(1, agents + 1)))


def _cycle(agents: int) -> Digraph:
    return _both_ways(agents, ((i, i % agents + 1) for i in range(1, agents + 1)))


def _path(agents: int) -> Digraph:
    return _both_ways(agents, ((i, i + 1) for i in range(1, agents)))


def _star(agents: int) -> Digraph:
    return _both_ways(agents, ((1, i) for i in range(2, agents + 1)))


def _complete(agents: int) -> Digraph:
    return _both_ways(agents, combinations(range(1, agents + 1), 2))


def _hypercube(agents: int) -> Digraph:
    bits = [1 << d for d in range(agents.bit_length() - 1)]
    return _both_ways(agents, ((i + 1, (i ^ bit) + 1) for i in range(agents) for bit in bits))


def _grid(shape: Shape) -> Digraph:
    rows, columns = shape
    return _both_ways(rows * columns, _lattice(shape, wrap=False))


def _torus(shape: Shape) -> Digraph:
    rows, columns = shape
    return _both_ways(rows * columns, _lattice(shape, wrap=True))


def _lattice(shape: Shape, *, wrap: bool) -> Iterator[tuple[int, int]]:
    rows, columns = shape
    for row in range(rows):
        for column in range(columns):
            here = row * columns + column + 1
            if wrap or column + 1 < columns:
                yield here, row * columns + (column + 1) % columns + 1
            if wrap or row + 1 < rows:
                yield here, (row + 1) % rows * columns + column + 1


def _both_ways(agents: int, pairs: Iterable[tuple[int, int]]) -> Digraph:
    """Join each pair in both directions, once however often it is named."""
    ends = {end for i, j in pairs for end in ((i, j), (j, i))}
    return digraph(agents, ((source, target, _ONE) for source, target in ends))


FAMILIES: dict[str, Callable[[int], Digraph]] = {
    "directed-cycle": _directed_cycle,
    "cycle": _cycle,
    "path": _path,
    "star": _star,
    "complete": _complete,
    "hypercube": _hypercube,
}
SHAPED_FAMILIES: dict[str, Callable[[Shape], Digraph]] = {"torus": _torus, "grid": _grid}
