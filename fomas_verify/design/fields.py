"""Single values of a design: where they stand, and how numbers, counts, names and tables are read.

Every function returns the exact value or raises `DesignError` with one line
`FILE: key.path[i]: expected ..., got ...`; positions in lists count from 0.
"""

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from fractions import Fraction
from typing import Final

from fomas_verify.design.document import Number
from fomas_verify.design.errors import DesignError
from fomas_verify.exact.rational import RationalError, excerpt, format_rational, parse_rational, shortened

MAX_BITS: Final = 4096

_BARE_KEY = re.compile(r"[A-Za-z0-9_-]{1,40}")


@dataclass(frozen=True, slots=True)
class Place:
    """A place in a design file: the file and the path of keys and positions."""

    source: str
    path: str = ""

    def __str__(self) -> str:
        return f"{self.source}: {self.path}" if self.path else self.source

    def key(self, name: str) -> "Place":
        """The place of a key in the table here."""
        shown = name if _BARE_KEY.fullmatch(name) else excerpt(name)
        return Place(self.source, f"{self.path}.{shown}" if self.path else shown)

    def item(self, position: int) -> "Place":
        """The place of an entry in the list here, counting from 0."""
        return Place(self.source, f"{self.path}[{position}]")

    def expected(self, expectation: str, got: object) -> DesignError:
        """The refusal of a value found here."""
        return DesignError(f"{self}: expected {expectation}, got {shown(got)}")

    def unsupported(self, what: str) -> DesignError:
        """The refusal of a key or value here that belongs to an unfinished feature."""
        return DesignError(f"{self}: {what} not supported yet")


def shown(value: object) -> str:
    """Say in a few words what was found; None stands for nothing there."""
    match value:
        case None:
            return "nothing"
        case bool():
            return "true" if value else "false"
        case int() if value.bit_length() > 128:
            return f"an integer of {value.bit_length()} bits"
        case int() | float():
            return str(value)
        case Fraction():
            return shortened(format_rational(value))
        case Number(text):
            return shortened(text)
        case str():
            return excerpt(value)
        case Mapping():
            return "a table"
        case list() | tuple():
            return f"a list of {len(value)}"
        case _:
            return f"a {type(value).__name__}"


def number(value: object, place: Place) -> Fraction:
    """Read an integer, a decimal or a fraction exactly, in a string too; a binary float by its shortest decimal."""
    if type(value) is int or isinstance(value, Fraction):
        x = Fraction(value)
    else:
        match value:
            case Number(text) | str(text):
                pass
            case float():
                text = float.__repr__(value)
            case _:
                raise place.expected("a number", value)
        try:
            x = parse_rational(text, what=str(place))
        except RationalError as error:
            raise DesignError(str(error)) from None
    if not fits_a_design(x):
        raise place.expected(f"numerator and denominator below 2^{MAX_BITS}", value)
    return x


def fits_a_design(x: Fraction) -> bool:
    """Whether a design may hold this number: numerator and denominator are below 2^4096."""
    return max(x.numerator.bit_length(), x.denominator.bit_length()) <= MAX_BITS


def positive(value: object, place: Place, what: str = "a number") -> Fraction:
    """Read a number > 0."""
    x = number(value, place)
    if x <= 0:
        raise place.expected(f"{what} > 0", value)
    return x


def count(value: object, place: Place, low: int, high: int | None = None) -> int:
    """Read an integer >= low, and <= high where there is one."""
    if type(value) is not int or value < low or (high is not None and value > high):
        raise place.expected(f"an integer >= {low}" + ("" if high is None else f" and <= {high}"), value)
    return value


def sequence(value: object, place: Place, expectation: str, length: int | None = None) -> list[object]:
    """Read a list, of the given length where there is one."""
    if not isinstance(value, list | tuple) or (length is not None and len(value) != length):
        raise place.expected(expectation, value)
    return list(value)


def table(value: object, place: Place, known: Iterable[str]) -> Mapping[str, object]:
    """Read a table that has known keys only; the nearest known one is suggested for another."""
    if not isinstance(value, Mapping):
        raise place.expected("a table", value)
    names = tuple(known)
    for name in value:
        if name not in names:
            where = place.key(str(name))
            raise DesignError(f"{where}: unknown key; {nearest(str(name), names) or 'expected ' + one_of(names)}")
    return value


def choice(value: object, place: Place, what: str, names: tuple[str, ...]) -> str:
    """Read one of the given names; the nearest one is suggested for another."""
    if isinstance(value, str) and value in names:
        return value
    suggestion = nearest(value, names) if isinstance(value, str) else ""
    expectation = what if suggestion else f"{what}, {one_of(names)}"
    refusal = place.expected(expectation, value)
    raise DesignError(f"{refusal}; {suggestion}") if suggestion else refusal


def nearest(name: str, names: Iterable[str]) -> str:
    """Suggest the nearest of some names, or return an empty text."""
    # A long text is no misspelling, and comparing it would take its length squared.
    matches = get_close_matches(name, names, n=1) if len(name) <= 40 else []
    return f"did you mean {matches[0]}?" if matches else ""


def one_of(names: Iterable[str]) -> str:
    """Word a choice."""
    return "one of " + ", ".join(names)
