"""Weights as they are written, exact, over one common denominator.

A binary float is read as its shortest decimal: 0.1 is 1/10, never the nearest binary float.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Sequence
from decimal import Decimal
from math import gcd, lcm
from numbers import Rational
from typing import TYPE_CHECKING, Any, Final

from fomas_verify.exact.rational import excerpt

if TYPE_CHECKING:
    from numpy.typing import NDArray

MAX_DENOMINATOR_BITS: Final = 256
SHORTEST: Final = "weights that are binary floats are read as their shortest decimals (0.1 is 1/10)"

_MAX_BITS, _MAX_CHARACTERS = 4096, 4000
# Of these characters whatever `int` reads without its point is a decimal, but for a sign after the point.
_PLAIN = re.compile(r"[0-9.e+\n-]*")
_POWERS = [10**k for k in range(30)]
_DECIMAL = re.compile(r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]{1,4})?")
_FRACTION = re.compile(r"([+-]?[0-9]+)/([0-9]+)")

Ratio = tuple[int, int]


class WeightError(ValueError):
    """Some weight is none: `expected` and `got` in words, and its position among the weights."""

    def __init__(self, position: int, expected: str, got: str) -> None:
        super().__init__(f"expected {expected}, got {got}")
        self.position, self.expected, self.got = position, expected, got


def common_denominator(ratios: Sequence[Ratio]) -> tuple[list[int], int]:
    """The numerators over the least common denominator, and it.

    Raises
    ------
    WeightError
        The denominator has more than 256 bits, or a numerator is 2^4096 at least.
    """
    denominator = lcm(*{d for _, d in ratios})
    if denominator.bit_length() > MAX_DENOMINATOR_BITS:
        ratios = [(n // gcd(n, d), d // gcd(n, d)) for n, d in ratios]
        denominator = _bounded({d: i for i, (_, d) in reversed(list(enumerate(ratios)))})
    scale = {d: denominator // d for _, d in ratios}
    numerators = [n * scale[d] for n, d in ratios]
    if any(x.bit_length() > _MAX_BITS for x in (max(numerators, default=0), min(numerators, default=0))):
        position = next(i for i, x in enumerate(numerators) if x.bit_length() > _MAX_BITS)
        raise WeightError(position, f"weights below 2^{_MAX_BITS} over their common denominator", "one beyond")
    common = gcd(denominator, *numerators)
    return ([n // common for n in numerators] if common > 1 else numerators), denominator // common


def _bounded(positions: dict[int, int]) -> int:
    """The least common multiple of some denominators, with the position of each."""
    denominator = 1
    for found, position in positions.items():
        denominator = lcm(denominator, found)
        if denominator.bit_length() > MAX_DENOMINATOR_BITS:
            bound = f"weights whose common denominator has at most {MAX_DENOMINATOR_BITS} bits"
            raise WeightError(position, bound, "more")
    return denominator


def ratios_of_texts(texts: Iterable[str]) -> list[Ratio]:
    """Numerators and denominators of decimals and fractions; raises `WeightError` where one is neither."""
    listed = list(texts)
    found: list[Ratio] = []
    joined = "\n".join(listed)
    if not _PLAIN.fullmatch(joined) or ".+" in joined or ".-" in joined:
        return [_checked(i, text, _ratio_of_text) for i, text in enumerate(listed)]
    for text in listed:
        mantissa, marked, power = text.partition("e")
        whole, _, decimals = mantissa.partition(".")
        try:
            digits, shift = int(whole + decimals), len(decimals) - (int(power) if marked else 0)
        except ValueError:
            shift = -1
        if 0 <= shift < len(_POWERS):
            found.append((digits, _POWERS[shift]))
        else:
            found.append(_checked(len(found), text, _ratio_of_text))
    return found


def ratios_of_objects(values: Iterable[object]) -> list[Ratio]:
    """The same of Python's numbers and numpy's, and of texts; raises `WeightError` where one is no number."""
    return [_checked(i, value, _ratio_of_object) for i, value in enumerate(values)]


def ratios_of_array(values: NDArray[Any]) -> list[Ratio]:
    """The same of an array of integers, truth values or finite floats."""
    if values.dtype.kind in "biu":
        return [(int(x), 1) for x in values.tolist()]
    texts = map(repr, values.tolist()) if values.dtype.itemsize == 8 else (str(x) for x in values)
    return ratios_of_texts(texts)


def is_float(value: object) -> bool:
    """Say whether a number is a binary float, Python's or numpy's."""
    return isinstance(value, float) or (hasattr(value, "dtype") and value.dtype.kind == "f")


def _checked(position: int, value: Any, read: Callable[[Any], Ratio | None]) -> Ratio:
    found = read(value)
    if found is None:
        raise WeightError(position, "a finite number such as 2, 0.5 or 1/2", _shown(value))
    return found


def _ratio_of_text(text: str) -> Ratio | None:
    if len(text) > _MAX_CHARACTERS:
        return None
    if _DECIMAL.fullmatch(text):
        return Decimal(text).as_integer_ratio()
    match = _FRACTION.fullmatch(text)
    return (int(match[1]), int(match[2])) if match and int(match[2]) else None


def _ratio_of_object(value: Any) -> Ratio | None:
    if isinstance(value, bool) or value is None:
        return None
    if isinstance(value, str):
        return _ratio_of_text(value)
    if isinstance(value, Rational):
        return int(value.numerator), int(value.denominator)
    if isinstance(value, float):
        return _ratio_of_text(float.__repr__(value))
    if isinstance(value, Decimal) or is_float(value):
        return _ratio_of_text(str(value))
    if hasattr(value, "dtype") and value.dtype.kind in "iu" and getattr(value, "ndim", 1) == 0:
        return int(value), 1
    return None


def _shown(value: object) -> str:
    match value:
        case str() | bytes():
            return excerpt(value if isinstance(value, str) else value.decode("latin-1"))
        case None | bool() | int() | float():
            return str(value)[:60]
        case _ if hasattr(value, "dtype"):
            return str(value)[:60]
        case _:
            return f"a {type(value).__name__}"
