"""Readers of the parts a certificate is made of: rationals, counts, arrays, objects, triangles.

Each raises `Malformed` for what `check` must answer with exit status 2, and `Unclear` where the page does not say.
"""

from __future__ import annotations

import re
from fractions import Fraction
from typing import Any

from .digits import to_int
from .strict_json import Malformed, Num, Obj

RATIONAL = re.compile(r"-?[0-9]+(?:/[0-9]+)?\Z")
INTEGER = re.compile(r"-?(?:0|[1-9][0-9]*)\Z")


class Unclear(Exception):
    """The format page does not say, or the document is beyond what the oracle affords."""


def rational(item: Any) -> Fraction:
    """A rational in a string."""
    if not isinstance(item, str) or not RATIONAL.match(item):
        raise Malformed("expected a rational in a string")
    if sum(map(str.isdigit, item)) > 100_000:
        raise Malformed("more than 100000 digits")
    top, _, bottom = item.partition("/")
    if bottom and not bottom.strip("0"):
        raise Malformed("denominator zero")
    return Fraction(to_int(top), to_int(bottom or "1"))


def integer(item: Any, least: int) -> int:
    """A JSON integer, at least `least`."""
    if not isinstance(item, Num) or not INTEGER.match(item.text):
        raise Malformed("expected an integer")
    if item.text == "-0":
        raise Unclear("-0 for a count")
    if len(item.text) > 80:
        raise Malformed("more than 80 digits")
    number = to_int(item.text)
    if number < least:
        raise Malformed("integer out of range")
    return number


def items(item: Any, least: int = 0) -> list[Any]:
    """A JSON array of at least `least` entries."""
    if not isinstance(item, list) or len(item) < least:
        raise Malformed("expected an array")
    return item


def members(item: Any, required: tuple[str, ...], optional: tuple[str, ...] = ()) -> dict[str, Any]:
    """A JSON object with the required keys and none but the optional ones besides."""
    if not isinstance(item, Obj):
        raise Malformed("expected an object")
    keys = set(item.keys())
    if not set(required) <= keys or not keys <= {*required, *optional}:
        raise Malformed("keys missing or unknown")
    return dict(item.pairs)


def one_of(item: Any, allowed: tuple[str, ...]) -> str:
    """One of the strings allowed."""
    if not isinstance(item, str) or item not in allowed:
        raise Malformed("unknown word")
    return item


def triangle(item: Any, size: int) -> list[list[Fraction]]:
    """The symmetric matrix whose lower triangle is given row by row."""
    rows = items(item)
    if len(rows) != size or any(len(items(row)) != i for i, row in enumerate(rows, 1)):
        raise Malformed("not a lower triangle of the right size")
    lower = [[rational(x) for x in row] for row in rows]
    return [[lower[max(i, j)][min(i, j)] for j in range(size)] for i in range(size)]


def vector(item: Any, agents: int) -> list[Fraction]:
    if len(items(item)) != agents:
        raise Malformed("expected one rational for each agent")
    return [rational(x) for x in item]


def power_of_trace(item: Any) -> int:
    power = integer(item, 1)
    if power > 2**256:
        raise Malformed("power beyond 2^256")
    return power
