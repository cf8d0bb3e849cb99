"""What a certificate about graphs to switch among says, as data, read with the path of every defect.

Source: docs/certificate-format.md, section 10.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import TypeVar

from fomas_verify.checker.designs import (
    Design,
    Interval,
    Number,
    Setting,
    read_edges,
    read_interval_or,
    read_order,
    read_positive,
)
from fomas_verify.checker.statements import SWITCHED_CONDITIONS, SWITCHED_STATEMENTS, VERDICTS
from fomas_verify.checker.text import Malformed, array, count, expected, fields, rational, string
from fomas_verify.checker.value_form import Bounds, Rate, Value
from fomas_verify.checker.witness import Lyapunov, Nothing, Triangle, Witness, read_power, read_triangle, read_witness

MOST_GRAPHS = MOST_LETTERS = 64
_MOST_NAME = 64
_SWITCHED = ("control-bounded", "average-consensus")
_END = ("Z", "graph", "power", "Y")


@dataclass(frozen=True)
class SwitchedDesign(Setting):
    """A set of digraphs on the same agents, of which one, or a convex combination, holds at each sample.

    Attributes
    ----------
    edges : those of the first
    graphs : the settings of all, in order
    alpha, gamma, mu, h : as of a design; mu may be (lower, upper)
    """

    graphs: tuple[Setting, ...]
    alpha: Fraction
    gamma: Fraction | None
    mu: Number | None
    h: Fraction | None

    def end(self, i: int) -> Design:
        """The design of the first digraph with the least (0) or greatest (1) mu."""
        mu = self.mu[i] if isinstance(self.mu, tuple) else self.mu
        common = (self.agents, self.edges, self.x0, self.plain_x0, self.require)
        return Design(*common, self.alpha, self.gamma, mu, self.h)


@dataclass(frozen=True)
class OfGraph:
    """A witness about one digraph of the set, counted from 1."""

    graph: int
    witness: Witness


@dataclass(frozen=True)
class Word:
    """Digraphs, counted from 1, in the order in which they hold, over and over: some power of the product grows."""

    graphs: tuple[int, ...]
    mu: Fraction
    power: int


@dataclass(frozen=True)
class Dual:
    """Z_i >= 0 that show that no form decreases under every digraph at mu."""

    mu: Fraction
    matrices: tuple[Triangle, ...]


@dataclass(frozen=True)
class SwitchedClaim:
    """What the certificate says of one claim."""

    id: str
    verdict: str
    statement: str
    witness: Nothing | Lyapunov | OfGraph | Word | Dual


@dataclass(frozen=True)
class SwitchedRate(Rate):
    """norm(x_k - mean) <= kappa rho^k norm(x_0 - mean), shown by a form at both ends of mu."""

    ends: Interval
    rows: Triangle


@dataclass(frozen=True)
class SwitchedCondition:
    """What the certificate says of one condition on mu; `proof` is the witness at inner[1], `end` at outer[1]."""

    id: str
    verdict: str
    statement: str
    inner: Interval | None
    outer: Interval | None
    proof: Lyapunov | None
    end: OfGraph | Dual | None


Said = TypeVar("Said", SwitchedClaim, SwitchedCondition)


def is_switched(value: object) -> bool:
    """Whether the design of a certificate is one of this section."""
    return isinstance(value, dict) and "graphs" in value


def read_switched(value: object, path: str, of_region: bool) -> SwitchedDesign:
    """The design, its form checked; raises `Malformed`."""
    given = fields(value, path, ("alpha", "agents", "graphs", "require"), ("gamma", "mu", "h"))
    if "gamma" in given and "mu" in given:
        raise Malformed(path, 'expected at most one of "gamma" and "mu"')
    if not of_region and "mu" not in given and not ("gamma" in given and "h" in given):
        raise Malformed(path, 'expected "mu", or "gamma" and "h"')
    alpha = read_order(given["alpha"], f"{path}.alpha")
    gamma, h = (read_positive(given[key], f"{path}.{key}") if key in given else None for key in ("gamma", "h"))
    number = read_positive if of_region else read_interval_or
    mu = number(given["mu"], f"{path}.mu") if "mu" in given else None
    agents = count(given["agents"], f"{path}.agents", 2)
    require = _require(given["require"], f"{path}.require")
    entries = array(given["graphs"], f"{path}.graphs", "an array of arrays of edges")
    if not 1 <= len(entries) <= MOST_GRAPHS:
        raise expected(f"{path}.graphs", f"1 to {MOST_GRAPHS} digraphs", entries)
    all_edges = [read_edges(entry, f"{path}.graphs[{i}]", agents) for i, entry in enumerate(entries)]
    graphs = tuple(Setting(agents, edges, None, False, require) for edges in all_edges)
    return SwitchedDesign(agents, all_edges[0], None, False, require, graphs, alpha, gamma, mu, h)


def _require(value: object, path: str) -> tuple[str, ...]:
    ids: list[str] = []
    for index, entry in enumerate(array(value, path, "an array of claim ids")):
        ids.append(_id(entry, f"{path}[{index}]", SWITCHED_STATEMENTS, ids))
    if not ids:
        raise Malformed(path, "expected at least one claim id")
    return tuple(ids)


def _id(value: object, path: str, known: dict[str, str], seen: list[str]) -> str:
    if not isinstance(value, str) or value not in known:
        raise expected(path, f"one of {', '.join(known)}", value)
    if value in seen:
        raise Malformed(path, f"{value} occurs twice")
    return value


def read_switched_claims(value: object, path: str, design: SwitchedDesign) -> tuple[SwitchedClaim, ...]:
    """The claims, their form checked; raises `Malformed`."""

    def read(name: str, verdict: str, statement: str, witness: object, here: str) -> SwitchedClaim:
        return SwitchedClaim(name, verdict, statement, _witness(name, verdict, witness, here, design))

    return _entries(value, path, SWITCHED_STATEMENTS, VERDICTS, read)


def read_switched_conditions(value: object, path: str, design: SwitchedDesign) -> tuple[SwitchedCondition, ...]:
    """The conditions of a region, their form checked; raises `Malformed`."""

    def read(name: str, verdict: str, statement: str, witness: object, here: str) -> SwitchedCondition:
        empty = SwitchedCondition(name, verdict, statement, None, None, None, None)
        if verdict == "refuted":
            fields(witness, here, ())
            return empty
        return _strip(empty, fields(witness, here, ("mu",))["mu"], f"{here}.mu", design)

    return _entries(value, path, SWITCHED_CONDITIONS, ("proved", "refuted"), read)


def _entries(
    value: object,
    path: str,
    known: dict[str, str],
    verdicts: tuple[str, ...],
    read: Callable[[str, str, str, object, str], Said],
) -> tuple[Said, ...]:
    found: list[Said] = []
    for index, entry in enumerate(array(value, path, "an array of claims")):
        here = f"{path}[{index}]"
        given = fields(entry, here, ("id", "verdict", "statement", "witness"))
        name = _id(given["id"], f"{here}.id", known, [said.id for said in found])
        verdict = given["verdict"]
        if not isinstance(verdict, str) or verdict not in verdicts:
            raise expected(f"{here}.verdict", f"one of {', '.join(verdicts)}", verdict)
        statement = string(given["statement"], f"{here}.statement")
        found.append(read(name, verdict, statement, given["witness"], f"{here}.witness"))
    if not found:
        raise Malformed(path, "expected at least one claim")
    return tuple(found)


def _witness(
    name: str, verdict: str, value: object, path: str, design: SwitchedDesign
) -> Nothing | Lyapunov | OfGraph | Word | Dual:
    if verdict == "undecided":
        if isinstance(value, dict) and "Z" in value and name in _SWITCHED:
            given = fields(value, path, ("mu", "Z"), ("solver",))
            _solver(given, path)
            return Dual(rational(given["mu"], f"{path}.mu"), _matrices(given["Z"], f"{path}.Z", design))
        read_witness(name, verdict, value, path, design.agents)
        return Nothing()
    if verdict == "refuted" and name in _SWITCHED and isinstance(value, dict) and "word" in value:
        return _word(value, path, design)
    if verdict == "refuted" and name != "gain-bound":
        return _of_graph(name, value, path, design)
    if verdict == "proved" and name not in ("graph-assumption", "gain-bound"):
        given = fields(value, path, ("mu", "Q"), ("solver",))
        _solver(given, path)
        return Lyapunov(rational(given["mu"], f"{path}.mu"), read_triangle(given["Q"], f"{path}.Q", design.agents))
    fields(value, path, ())
    return Nothing()


def _of_graph(name: str, value: object, path: str, design: SwitchedDesign) -> OfGraph:
    if not isinstance(value, dict) or "graph" not in value:
        raise expected(path, 'an object with the key "graph"', value)
    graph = count(value["graph"], f"{path}.graph", 1, len(design.graphs))
    rest = {key: entry for key, entry in value.items() if key != "graph"}
    return OfGraph(graph, read_witness(name, "refuted", rest, path, design.agents))


def _word(value: object, path: str, design: SwitchedDesign) -> Word:
    given = fields(value, path, ("word", "mu", "power"))
    here = f"{path}.word"
    entries = array(given["word"], here, "an array of digraphs")
    if not 1 <= len(entries) <= MOST_LETTERS:
        raise expected(here, f"1 to {MOST_LETTERS} digraphs", entries)
    graphs = tuple(count(entry, f"{here}[{i}]", 1, len(design.graphs)) for i, entry in enumerate(entries))
    return Word(graphs, rational(given["mu"], f"{path}.mu"), read_power(given["power"], f"{path}.power"))


def _matrices(value: object, path: str, design: SwitchedDesign) -> tuple[Triangle, ...]:
    entries = array(value, path, f"an array of {len(design.graphs)} matrices", len(design.graphs))
    return tuple(read_triangle(entry, f"{path}[{i}]", design.agents) for i, entry in enumerate(entries))


def _solver(given: dict[str, object], path: str) -> None:
    if len(string(given.get("solver", ""), f"{path}.solver")) > _MOST_NAME:
        raise expected(f"{path}.solver", f"at most {_MOST_NAME} characters", given["solver"])


def _strip(empty: SwitchedCondition, value: object, path: str, design: SwitchedDesign) -> SwitchedCondition:
    if empty.id == "gain-bound":
        given = fields(value, path, ("inner", "outer"))
        inner, outer = (_interval(given[key], f"{path}.{key}") for key in ("inner", "outer"))
        return replace(empty, inner=inner, outer=outer)
    given = fields(value, path, ("inner", "outer", "Q"), (*_END, "solver"))
    _solver(given, path)
    inner = _interval(given["inner"], f"{path}.inner")
    outer = _interval(given["outer"], f"{path}.outer")
    proof = Lyapunov(inner[1], read_triangle(given["Q"], f"{path}.Q", design.agents))
    return replace(empty, inner=inner, outer=outer, proof=proof, end=_end(given, path, design, outer[1]))


def _end(given: dict[str, object], path: str, design: SwitchedDesign, top: Fraction) -> OfGraph | Dual:
    """The witness that no form will do at `top`."""
    if "graph" not in given:
        fields({key: given[key] for key in _END if key in given}, path, ("Z",))
        return Dual(top, _matrices(given["Z"], f"{path}.Z", design))
    shown: dict[str, object] = {key: given[key] for key in _END if key in given}
    # The number at which the digraph fails stands in the strip.
    shown["mu"] = array(given["outer"], f"{path}.outer", "an array of two", 2)[1]
    return _of_graph("perron-eigenvalues", shown, path, design)


def _interval(value: object, path: str) -> Interval:
    lower, upper = (rational(end, f"{path}[{i}]") for i, end in enumerate(array(value, path, "an array of two", 2)))
    return lower, upper


def read_switched_values(value: object, path: str, agents: int) -> tuple[Value, ...]:
    """The values, their form checked; raises `Malformed`."""
    given = fields(value, path, (), ("mu", "degree_max", "rate"))
    return tuple(_value(name, entry, f"{path}.{name}", agents) for name, entry in given.items())


def _value(name: str, value: object, path: str, agents: int) -> Value:
    if name != "rate":
        given = fields(value, path, ("lower", "upper"))
        return Bounds(name, rational(given["lower"], f"{path}.lower"), rational(given["upper"], f"{path}.upper"))
    given = fields(value, path, ("kappa", "rho", "mu", "Q"), ("solver",))
    _solver(given, path)
    kappa, rho = (rational(given[key], f"{path}.{key}") for key in ("kappa", "rho"))
    rows = read_triangle(given["Q"], f"{path}.Q", agents)
    return SwitchedRate(name, kappa, rho, _interval(given["mu"], f"{path}.mu"), rows)
