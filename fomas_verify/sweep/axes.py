"""One swept parameter: a list of values, or so many equidistant ones from one number to another; every one exact."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from math import lcm
from typing import Final, TypeVar

from fomas_verify.design.fields import Place, choice, count, number, positive, sequence, shown, table
from fomas_verify.design.model import MAX_LISTED_AGENTS
from fomas_verify.design.reading import ALPHA_LIMIT, read_alpha
from fomas_verify.network import FAMILIES, SHAPED_FAMILIES

MAX_LISTED: Final = 10_000
"""The most values of a list; a range holds any number."""

MAX_STEPS: Final = 10**12
RANGE: Final = ("from", "to", "steps")

T = TypeVar("T")


@dataclass(frozen=True)
class Span:
    """``steps`` >= 2 numbers from ``start`` to ``end``, both included, at equal distances."""

    start: Fraction
    end: Fraction
    steps: int

    def __len__(self) -> int:
        """How many."""
        return self.steps

    def __getitem__(self, i: int) -> Fraction:
        """The i-th, 0 <= i < steps; exact."""
        return self.start + i * self.step

    @property
    def step(self) -> Fraction:
        """The distance."""
        return (self.end - self.start) / (self.steps - 1)


@dataclass(frozen=True)
class Axis:
    """A swept number: ``alpha``, ``gamma``, ``mu`` or ``h``, and its values in the order of the rows."""

    name: str
    values: tuple[Fraction, ...] | Span


def read_numbers(name: str, value: object, place: Place) -> Axis:
    """Read a list or a range of alpha, gamma, mu or h.

    Raises
    ------
    DesignError
        A value is impossible for this number, stands twice, or there is none.
    """
    read = read_alpha if name == "alpha" else positive
    if not isinstance(value, Mapping):
        return Axis(name, tuple(_list(value, place, read)))
    span = _span(value, place, read)
    if name == "alpha" and lcm(span.start.denominator, span.step.denominator) >= ALPHA_LIMIT:
        raise place.expected("numbers with numerator and denominator below 2^64", value)
    return Axis(name, span)


def read_agents(value: object, place: Place) -> tuple[int, ...]:
    """Read a list, or a range that meets integers only, of numbers of agents; raises `DesignError`."""
    if not isinstance(value, Mapping):
        return tuple(_list(value, place, read_agents_of_one))
    span = _span(value, place, number)
    if span.start.denominator * span.step.denominator != 1 or not 2 <= span.start <= span.end <= MAX_LISTED_AGENTS:
        raise place.expected(f"a range of integers between 2 and {MAX_LISTED_AGENTS}", value)
    return tuple(int(span[i]) for i in range(len(span)))


def read_agents_of_one(value: object, place: Place) -> int:
    """Read the number of agents of one graph; raises `DesignError`."""
    return count(value, place, 2, MAX_LISTED_AGENTS)


def read_families(value: object, place: Place) -> tuple[str, ...]:
    """Read a list of families of graphs; raises `DesignError`."""
    return tuple(_list(value, place, lambda x, here: choice(x, here, "a family", (*FAMILIES, *SHAPED_FAMILIES))))


def read_shapes(value: object, place: Place) -> tuple[tuple[int, int], ...]:
    """Read a list of shapes [rows, columns]; raises `DesignError`."""
    return tuple(_list(value, place, read_shape))


def read_shape(value: object, place: Place) -> tuple[int, int]:
    """Read one shape; raises `DesignError`."""
    rows, columns = sequence(value, place, "two integers [rows, columns]", 2)
    return count(rows, place.item(0), 1), count(columns, place.item(1), 1)


def _list(value: object, place: Place, read: Callable[[object, Place], T]) -> list[T]:
    entries = sequence(value, place, 'a list, or a range {from = "0.5", to = "0.99", steps = 50}')
    if not 1 <= len(entries) <= MAX_LISTED:
        raise place.expected(f"a list of 1 to {MAX_LISTED} values", entries)
    found: dict[T, None] = {}
    for i, entry in enumerate(entries):
        x = read(entry, place.item(i))
        if x in found:
            raise place.item(i).expected("each value once", entry)
        found[x] = None
    return list(found)


def _span(value: Mapping[str, object], place: Place, read: Callable[[object, Place], Fraction]) -> Span:
    ends = table(value, place, RANGE)
    start, end = (read(ends.get(key), place.key(key)) for key in RANGE[:2])
    if start >= end:
        raise place.key("to").expected(f"a number above {shown(start)}, where the range begins", end)
    return Span(start, end, count(ends.get("steps"), place.key("steps"), 2, MAX_STEPS))
