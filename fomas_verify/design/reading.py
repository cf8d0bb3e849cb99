"""From a file, a text or a mapping to a design, or to the reason why not.

Source: the section on the design file in the README.
"""

from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from os import PathLike
from pathlib import Path
from typing import Any, Final

from fomas_verify.design.claim_ids import CLAIM_IDS, DEFAULT_REQUIRE, SWITCHED_CLAIM_IDS, SWITCHED_REQUIRE
from fomas_verify.design.document import Format, format_of, parse_document, read_text
from fomas_verify.design.errors import DesignError
from fomas_verify.design.fields import Place, choice, count, number, positive, sequence, shown, table
from fomas_verify.design.graph_file import Folder, folder_of
from fomas_verify.design.graph_table import read_graph, read_listed_graph
from fomas_verify.design.limits import NO_LIMITS, read_limits
from fomas_verify.design.model import (
    MOST_AGENTS_EXACTLY,
    AnyDesign,
    Design,
    LargeDesign,
    State,
    SwitchedDesign,
    UncertainDesign,
)
from fomas_verify.enclosure.interval import Interval
from fomas_verify.exact.errors import source_name
from fomas_verify.network import Digraph
from fomas_verify.network.large import LargeGraph

FORMAT: Final = "fomas-design/1"
MAX_HORIZON: Final = 10**7
MAX_NAME: Final = 200
MAX_GRAPHS: Final = 64
ALPHA_LIMIT: Final = 2**64

_KEYS = (
    "name",
    "alpha",
    "gamma",
    "mu",
    "h",
    "x0",
    "horizon",
    "settle_to",
    "graph",
    "gate",
    "limits",
    "format",
    "graphs",
)
_NOT_SWITCHED = ("x0", "horizon", "settle_to", "limits")


def read_design(path: str | PathLike[str], *, allow_outside: bool = False) -> Design:
    """Read a design file, TOML or JSON by its extension, otherwise by its content.

    Parameters
    ----------
    path : path
        A regular file of at most 16 MiB in UTF-8.
    allow_outside : bool
        Whether its graph file may lie outside its folder.

    Returns
    -------
    Design
        Valid and exact; its name defaults to that of the file.

    Raises
    ------
    DesignError
        With one line that names the file, the key and what was expected.
    """
    return _listed(read_single(path, allow_outside=allow_outside))


def read_single(path: str | PathLike[str], *, allow_outside: bool = False) -> Design | LargeDesign:
    """Read a design file with one graph, of any size; otherwise as `read_design`."""
    return _certain(read_named(path, allow_outside=allow_outside), source_name(path))


def read_any(path: str | PathLike[str], *, allow_outside: bool = False) -> Design | UncertainDesign:
    """Read a design file in which alpha, gamma, mu and h may be intervals; otherwise as `read_design`."""
    one = _one_graph(read_named(path, allow_outside=allow_outside), source_name(path))
    return one if isinstance(one, UncertainDesign) else _listed(one)


def read_named(path: str | PathLike[str], *, allow_outside: bool = False) -> AnyDesign:
    """Read a design file that may have intervals, [[graphs]] in place of [graph], and a graph of any size; otherwise
    as `read_design`.
    """
    text = read_text(path)
    source = source_name(path)
    mapping = parse_document(text, format_of(path, text), source)
    return named_from_mapping(mapping, source, folder_of(path, allow_outside=allow_outside))


def parse_design(text: str, format_: Format, source: str) -> Design:
    """Read a design from TOML or JSON text, which messages call `source`; raises as `read_design` does."""
    return design_from_mapping(parse_document(text, format_, source), source)


def design_from_mapping(mapping: Mapping[str, object], source: str = "design") -> Design:
    """Read a design from a mapping with the keys of the design file.

    Parameters
    ----------
    mapping : mapping
        Numbers are `int`, `Fraction`, a decimal or fraction in a `str`, or `float`, which is read as its shortest
        decimal (0.1 is 1/10) and noted in `Design.notes`.
    source : str
        Names the design in messages; its stem is the default name.

    Returns
    -------
    Design
        Valid and exact.

    Raises
    ------
    DesignError
        With one line that names the source, the key and what was expected.

    Examples
    --------
    >>> graph = {"family": "directed-cycle", "agents": 3}
    >>> design_from_mapping({"alpha": "9/10", "mu": "0.1", "graph": graph}).mu
    Fraction(1, 10)
    """
    return _listed(_certain(named_from_mapping(mapping, source), source))


def any_from_mapping(mapping: Mapping[str, object], source: str = "design") -> Design | UncertainDesign:
    """Read a design in which alpha, gamma, mu and h may be intervals; otherwise as `design_from_mapping`."""
    one = _one_graph(named_from_mapping(mapping, source), source)
    return one if isinstance(one, UncertainDesign) else _listed(one)


def _listed(design: Design | LargeDesign) -> Design:
    return design.listed() if isinstance(design, LargeDesign) else design


def _certain(found: AnyDesign, source: str) -> Design | LargeDesign:
    one = _one_graph(found, source)
    if isinstance(one, UncertainDesign):
        where = Place(source).key(next(iter(one.ranges)))
        raise DesignError(f"{where}: expected a number, got an interval: only prove, check and gate take one")
    return one


def _one_graph(found: AnyDesign, source: str) -> Design | LargeDesign | UncertainDesign:
    if isinstance(found, SwitchedDesign):
        where = Place(source).key("graphs")
        raise DesignError(f"{where}: expected one [graph]: only prove, check, region and gate take [[graphs]]")
    return found


def named_from_mapping(
    mapping: Mapping[str, object], source: str = "design", folder: Folder | None = None
) -> AnyDesign:
    """Read a design that may have graphs in place of graph, and whose graph file may lie in a folder.

    Otherwise as `design_from_mapping`, intervals included.
    """
    place = Place(source)
    top = table(mapping, place, _KEYS)
    if "format" in top:
        choice(top["format"], place.key("format"), "the format of a design", (FORMAT,))
    if "gamma" in top and "mu" in top:
        raise DesignError(f"{place.key('mu')}: expected either gamma or mu, got both")
    gains = [key for key in ("gamma", "mu", "h") if key in top]
    numbers = {"alpha": _number_or_interval(top.get("alpha"), place.key("alpha"), read_alpha)}
    numbers |= {key: _number_or_interval(top[key], place.key(key), positive) for key in gains}
    ranges = {key: x for key, x in numbers.items() if not x.is_exact}
    for key in ("horizon", "settle_to"):
        if ranges and key in top:
            raise place.key(key).unsupported(f"with an interval for {next(iter(ranges))} this key is")
    graphs, remarks = _graphs(top, place, ranges, folder)
    agents = graphs.agents if isinstance(graphs, LargeGraph) else graphs[0].agents
    given = _given(top, place, agents, remarks) | {key: x.lower for key, x in numbers.items()}
    if isinstance(graphs, LargeGraph):
        return LargeDesign(**given, graph=graphs)
    design = Design(**given, graph=graphs[0])
    if "graphs" in top:
        return SwitchedDesign(design, graphs, numbers.get("mu"))
    return UncertainDesign(design, ranges) if ranges else design


def _given(top: Mapping[str, object], place: Place, agents: int, remarks: Sequence[str]) -> dict[str, Any]:
    """What a design gives besides its graph, but for the numbers that may be intervals."""
    return {
        "name": _name(top, place),
        "gamma": None,
        "mu": None,
        "h": None,
        "x0": _initial_state(top["x0"], place.key("x0"), agents) if "x0" in top else None,
        "horizon": count(top["horizon"], place.key("horizon"), 0, MAX_HORIZON) if "horizon" in top else None,
        "settle_to": _settle_to(top["settle_to"], place.key("settle_to")) if "settle_to" in top else None,
        "require": _require(top, place),
        "limits": read_limits(top["limits"], place.key("limits")) if "limits" in top else NO_LIMITS,
        "source": place.source,
        "notes": (*_notes(top), *remarks),
    }


def _graphs(
    top: Mapping[str, object], place: Place, ranges: Mapping[str, Interval], folder: Folder | None
) -> tuple[LargeGraph | tuple[Digraph, ...], tuple[str, ...]]:
    """The digraph, large or as one of one, or the digraphs to switch among, and the remarks on their reading."""
    if "graphs" not in top:
        if "graph" not in top:
            raise place.key("graph").expected("a table", None)
        graph, remarks = read_graph(top["graph"], place.key("graph"), folder)
        if ranges and isinstance(graph, LargeGraph):
            what = f"{graph.agents} agents, more than {MOST_AGENTS_EXACTLY},"
            raise place.key("graph").unsupported(f"with an interval for {next(iter(ranges))} {what} are")
        told = tuple(f"graph: {remark}" for remark in remarks)
        return graph if isinstance(graph, LargeGraph) else (graph,), told
    where = place.key("graphs")
    if "graph" in top:
        raise DesignError(f"{where}: expected either graph or graphs, got both")
    for key in (*_NOT_SWITCHED, *(key for key in ranges if key != "mu")):
        if key in top:
            what = "an interval is" if key in ranges else "this key is"
            raise place.key(key).unsupported(f"with [[graphs]] {what}")
    entries = sequence(top["graphs"], where, "a list of tables")
    if not 1 <= len(entries) <= MAX_GRAPHS:
        raise where.expected(f"1 to {MAX_GRAPHS} graphs", entries)
    most = MOST_AGENTS_EXACTLY
    read = [read_listed_graph(entry, where.item(i), folder, most=most) for i, entry in enumerate(entries)]
    graphs = tuple(graph for graph, _ in read)
    for i, graph in enumerate(graphs):
        if graph.agents != graphs[0].agents:
            raise DesignError(f"{where.item(i)}: expected {graphs[0].agents} agents as before, got {graph.agents}")
    return graphs, tuple(f"graphs[{i}]: {remark}" for i, (_, remarks) in enumerate(read) for remark in remarks)


def _number_or_interval(value: object, place: Place, read: Callable[[object, Place], Fraction]) -> Interval:
    """A number, or an interval of two of its kind."""
    if not isinstance(value, list | tuple):
        return Interval.exactly(read(value, place))
    ends = sequence(value, place, "a number, or an interval of two", 2)
    lower, upper = (read(x, place.item(i)) for i, x in enumerate(ends))
    if lower >= upper:
        raise place.item(1).expected(f"a number above {shown(lower)}, where the interval begins", upper)
    return Interval(lower, upper)


def read_alpha(value: object, place: Place) -> Fraction:
    """Read an order: a number between 0 and 1, both excluded; raises `DesignError`."""
    alpha = number(value, place)
    if not 0 < alpha < 1:
        raise place.expected("a number between 0 and 1, both excluded", value)
    if alpha.denominator >= ALPHA_LIMIT:
        raise place.expected("numerator and denominator below 2^64", value)
    return alpha


def _name(top: Mapping[str, object], place: Place) -> str:
    if "name" not in top:
        stem = Path(place.source).stem
        return stem if _is_name(stem) else "design"
    name = top["name"]
    if not isinstance(name, str) or not _is_name(name):
        raise place.key("name").expected(f"a text of 1 to {MAX_NAME} printable characters", name)
    return name


def _is_name(text: str) -> bool:
    return 0 < len(text) <= MAX_NAME and text.isprintable()


def _initial_state(value: object, place: Place, agents: int) -> State:
    entries = sequence(value, place, f"a list of {agents} numbers, one for each agent", agents)
    dimensions = [len(entry) for entry in entries if isinstance(entry, list | tuple)]
    if not dimensions:
        return tuple((number(entry, place.item(i)),) for i, entry in enumerate(entries))
    dimension = max(dimensions[0], 1)
    expectation = f"a list of length {dimension}, the same for every agent"
    rows = [sequence(entry, place.item(i), expectation, dimension) for i, entry in enumerate(entries)]
    return tuple(tuple(number(x, place.item(i).item(j)) for j, x in enumerate(row)) for i, row in enumerate(rows))


def _settle_to(value: object, place: Place) -> Fraction:
    target = positive(value, place)
    if target >= 1:
        raise place.expected("a number between 0 and 1, both excluded", value)
    return target


def _require(top: Mapping[str, object], place: Place) -> tuple[str, ...]:
    known, default = (SWITCHED_CLAIM_IDS, SWITCHED_REQUIRE) if "graphs" in top else (CLAIM_IDS, DEFAULT_REQUIRE)
    gate = table(top.get("gate", {}), place.key("gate"), ("require",))
    if "require" not in gate:
        return default
    where = place.key("gate").key("require")
    entries = sequence(gate["require"], where, "a list of claim ids")
    if not entries:
        raise where.expected("at least one claim id", entries)
    required: list[str] = []
    for i, entry in enumerate(entries):
        claim = choice(entry, where.item(i), "a claim id", known)
        if claim == "trajectory-norm-bound" and "x0" not in top:
            raise DesignError(f"{where.item(i)}: expected a design with x0, which {claim} is about; got no x0")
        if claim in required:
            raise DesignError(f"{where.item(i)}: expected each claim once, got {claim} again")
        required.append(claim)
    return tuple(required)


def _notes(top: Mapping[str, object]) -> tuple[str, ...]:
    keys = [key for key, value in top.items() if _has_float(value)]
    return (f"{', '.join(keys)}: binary floats are read as their shortest decimals (0.1 is 1/10)",) if keys else ()


def _has_float(value: object) -> bool:
    """Look for a binary float in a value already found valid, so that its nesting is known to be small."""
    if isinstance(value, Mapping):
        return any(map(_has_float, value.values()))
    if isinstance(value, list | tuple):
        return any(map(_has_float, value))
    return isinstance(value, float)
