"""The design a certificate is about, as data: its schema, read with the path of every defect.

Source: docs/certificate-format.md, sections 2, 7 and 8.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from fractions import Fraction
from typing import cast

from fomas_verify.checker.statements import STATEMENTS
from fomas_verify.checker.text import Malformed, array, count, expected, fields, rational

Edge = tuple[int, int, Fraction]
State = tuple[tuple[Fraction, ...], ...]
Interval = tuple[Fraction, Fraction]
Number = Fraction | Interval

NUMBERS = ("alpha", "gamma", "mu", "h")
MAX_ALPHA = 2**64


@dataclass(frozen=True)
class Setting:
    """What the members of a design have in common.

    Attributes
    ----------
    agents : number of agents, at least 2
    edges : (from, to, weight), sorted; agent `to` hears agent `from`
    x0 : one row an agent, of the same length each (1 where the file has plain numbers), or None
    plain_x0 : whether the file has x0 as plain numbers
    require : ids of the claims that the design must satisfy
    """

    agents: int
    edges: tuple[Edge, ...] = field(hash=False)
    x0: State | None = field(hash=False)
    plain_x0: bool
    require: tuple[str, ...]

    def at(self, alpha: Fraction, mu: Fraction) -> "Design":
        """The design with these numbers."""
        return Design(self.agents, self.edges, self.x0, self.plain_x0, self.require, alpha, None, mu, None)


@dataclass(frozen=True)
class Design(Setting):
    """A design, every number an exact rational.

    Attributes
    ----------
    alpha : order of the Caputo derivative, in (0, 1)
    gamma, mu : the gain, or the integrated gain; exactly one of them is given (of a region: at most one)
    h : sampling period, required with gamma (not of a region)
    """

    alpha: Fraction
    gamma: Fraction | None
    mu: Fraction | None
    h: Fraction | None


@dataclass(frozen=True)
class UncertainDesign(Setting):
    """All designs with numbers of these intervals; at least one of the numbers is an interval.

    Attributes
    ----------
    alpha, gamma, mu, h : as of a design, or (lower, upper)
    """

    alpha: Number
    gamma: Number | None
    mu: Number | None
    h: Number | None

    def interval(self, key: str) -> Interval | None:
        """The number of that name as an interval, or None where there is none."""
        number: Number | None = getattr(self, key)
        return (number, number) if isinstance(number, Fraction) else number

    def member(self, numbers: dict[str, Fraction]) -> Design:
        """The design with these numbers."""
        others = (numbers.get(key) for key in NUMBERS[1:])
        return Design(self.agents, self.edges, self.x0, self.plain_x0, self.require, numbers["alpha"], *others)


def read_design(value: object, path: str) -> Design | UncertainDesign:
    """The design of a certificate, its form checked; raises `Malformed`."""
    given = _given(value, path)
    alpha = _number(given["alpha"], f"{path}.alpha", read_order)
    if ("gamma" in given) == ("mu" in given):
        raise Malformed(path, 'expected exactly one of "gamma" and "mu"')
    if "gamma" in given and "h" not in given:
        raise Malformed(path, 'missing key "h", required with "gamma"')
    gamma, mu, h = (
        _number(given[key], f"{path}.{key}", read_positive) if key in given else None for key in NUMBERS[1:]
    )
    setting = _setting(given, path)
    if any(isinstance(number, tuple) for number in (alpha, gamma, mu, h)):
        return UncertainDesign(*setting, alpha, gamma, mu, h)
    others = (cast(Fraction | None, number) for number in (gamma, mu, h))
    return Design(*setting, cast(Fraction, alpha), *others)


def read_family(value: object, path: str) -> Design:
    """The design of a region: gamma, mu and h may be absent, and are no intervals; raises `Malformed`."""
    given = _given(value, path)
    alpha = read_order(given["alpha"], f"{path}.alpha")
    if "gamma" in given and "mu" in given:
        raise Malformed(path, 'expected at most one of "gamma" and "mu"')
    others = (read_positive(given[key], f"{path}.{key}") if key in given else None for key in NUMBERS[1:])
    return Design(*_setting(given, path), alpha, *others)


def _given(value: object, path: str) -> dict[str, object]:
    return fields(value, path, ("alpha", "agents", "edges", "require"), ("gamma", "mu", "h", "x0"))


def _setting(given: dict[str, object], path: str) -> tuple[int, tuple[Edge, ...], State | None, bool, tuple[str, ...]]:
    """The attributes of a `Setting`, in their order."""
    agents = count(given["agents"], f"{path}.agents", 2)
    edges = read_edges(given["edges"], f"{path}.edges", agents)
    x0 = read_state(given["x0"], f"{path}.x0", agents) if "x0" in given else None
    plain = "x0" in given and not isinstance(array(given["x0"], f"{path}.x0", "an array")[0], list)
    return agents, edges, x0, plain, read_require(given["require"], f"{path}.require")


def read_interval_or(value: object, path: str) -> Number:
    """A rational > 0, or an interval of two."""
    return _number(value, path, read_positive)


def _number(value: object, path: str, read: Callable[[object, str], Fraction]) -> Number:
    """A rational, or an interval of two."""
    if not isinstance(value, list) or len(value) != 2:
        return read(value, path)
    lower, upper = (read(end, f"{path}[{i}]") for i, end in enumerate(value))
    if lower >= upper:
        raise Malformed(path, "expected the lower end of the interval below the upper")
    return lower, upper


def read_order(value: object, path: str) -> Fraction:
    """An order alpha: a rational in (0, 1) of which numerator and denominator are below 2^64."""
    alpha = rational(value, path)
    if not 0 < alpha < 1 or alpha.denominator >= MAX_ALPHA:
        raise Malformed(path, "expected 0 < alpha < 1, numerator and denominator below 2^64")
    return alpha


def read_positive(value: object, path: str) -> Fraction:
    """A rational > 0."""
    number = rational(value, path)
    if number <= 0:
        raise Malformed(path, "expected a rational > 0")
    return number


def read_edges(value: object, path: str, agents: int) -> tuple[Edge, ...]:
    """Edges, sorted; raises `Malformed`."""
    edges: dict[tuple[int, int], Fraction] = {}
    for index, entry in enumerate(array(value, path, "an array of edges")):
        here = f"{path}[{index}]"
        ends = array(entry, here, "an array [from, to, weight]", 3)
        pair = (count(ends[0], f"{here}[0]", 1, agents), count(ends[1], f"{here}[1]", 1, agents))
        if pair[0] == pair[1]:
            raise Malformed(here, "a self-loop")
        if pair in edges:
            raise Malformed(here, "the same pair of agents as an earlier edge")
        edges[pair] = read_positive(ends[2], f"{here}[2]")
    return tuple((*pair, edges[pair]) for pair in sorted(edges))


def read_state(value: object, path: str, agents: int) -> State:
    """An initial state: a row of one or more rationals for each agent; raises `Malformed`."""
    rows = array(value, path, f"an array of {agents}", agents)
    if not isinstance(rows[0], list):
        return tuple((rational(row, f"{path}[{i}]"),) for i, row in enumerate(rows))
    width = len(rows[0])
    if width == 0:
        raise expected(f"{path}[0]", "at least one rational", rows[0])
    return tuple(
        tuple(
            rational(entry, f"{path}[{i}][{j}]")
            for j, entry in enumerate(array(row, f"{path}[{i}]", f"an array of {width} rationals", width))
        )
        for i, row in enumerate(rows)
    )


def read_claim_id(value: object, path: str, seen: list[str]) -> str:
    """The id of a claim that is not among those seen before, to which it is added."""
    if not isinstance(value, str) or value not in STATEMENTS:
        raise expected(path, "the id of a claim", value)
    if value in seen:
        raise Malformed(path, f"{value} occurs twice")
    seen.append(value)
    return value


def read_require(value: object, path: str) -> tuple[str, ...]:
    """At least one claim id, none twice; raises `Malformed`."""
    ids: list[str] = []
    for index, entry in enumerate(array(value, path, "an array of claim ids")):
        read_claim_id(entry, f"{path}[{index}]", ids)
    if not ids:
        raise Malformed(path, "expected at least one claim id")
    return tuple(ids)
