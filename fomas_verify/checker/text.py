"""Strict JSON and the scalars of the format: what the Python parser lets pass and the format does not, ends here.

A JSON value that the format forbids wherever it stands (a float, NaN, an object with a repeated key) is parsed to
`Forbidden`, which no rule of the schema accepts: so the refusal can name its path.
Source: docs/certificate-format.md, section 1.
"""

import json
import re
from dataclasses import dataclass
from fractions import Fraction

MAX_BYTES = 64 * 2**20
MAX_DEPTH = 16
MAX_DIGITS = 100_000
MAX_COUNT_DIGITS = 80

_TOKEN = re.compile(r'"(?:[^"\\]++|\\.)*+"?|[\[\]{}]', re.DOTALL)
_RATIONAL = re.compile(r"(-?)([0-9]+)(?:/([0-9]+))?")
_CHUNK = 600


class Malformed(Exception):
    """The document is not a certificate (exit status 2).

    Attributes
    ----------
    path : where, as a JSON path that starts with `$`
    message : what was expected and what was found
    """

    def __init__(self, path: str, message: str) -> None:
        super().__init__(f"{path}: {message}")
        self.path = path
        self.message = message


@dataclass(frozen=True)
class Forbidden:
    """A JSON value that the format has no place for."""

    reason: str


def parse(data: bytes) -> object:
    """Parse a certificate's bytes to lists, dicts, strings, ints, bools, None and `Forbidden`.

    Raises
    ------
    Malformed
        If the bytes are more than 64 MiB, not UTF-8 without a byte-order mark, nested deeper than 16, or not JSON.
    """
    if len(data) > MAX_BYTES:
        raise Malformed("$", f"larger than {MAX_BYTES} bytes")
    try:
        text = data.decode("utf-8")
    except UnicodeDecodeError as error:
        raise Malformed("$", f"not UTF-8 at byte {error.start}") from None
    if text.startswith("\ufeff"):
        raise Malformed("$", "starts with a byte-order mark")
    _check_depth(text)
    try:
        return json.loads(
            text, object_pairs_hook=_object, parse_int=_count, parse_float=_float, parse_constant=_constant
        )
    except json.JSONDecodeError as error:
        raise Malformed("$", f"not JSON: {error.msg} at line {error.lineno}, column {error.colno}") from None


def _check_depth(text: str) -> None:
    """The recursive parser only sees a text that is nested at most 16 deep (brackets in strings do not count)."""
    depth = 0
    for token in _TOKEN.finditer(text):
        bracket = token.group()
        if bracket in "[{":
            depth += 1
        elif bracket in "]}":
            depth -= 1
        if depth > MAX_DEPTH:
            raise Malformed("$", f"nested deeper than {MAX_DEPTH}")


def _object(pairs: list[tuple[str, object]]) -> object:
    result: dict[str, object] = {}
    for key, value in pairs:
        if key in result:
            return Forbidden(f"the key {shown(key)} occurs twice")
        result[key] = value
    return result


def _count(digits: str) -> object:
    return int(digits) if len(digits) <= MAX_COUNT_DIGITS else Forbidden("an integer of too many digits")


def _float(_: str) -> Forbidden:
    return Forbidden("a number with a fraction or an exponent")


def _constant(name: str) -> Forbidden:
    return Forbidden(f"{name} is not a number")


def shown(value: object) -> str:
    """A short ASCII picture of a parsed JSON value, for messages."""
    if isinstance(value, Forbidden):
        return value.reason
    if isinstance(value, dict):
        return "an object"
    if isinstance(value, list):
        return f"an array of {len(value)}"
    if isinstance(value, str):
        return ascii(value if len(value) <= 40 else value[:40] + "...")
    return {None: "null", True: "true", False: "false"}[value] if isinstance(value, bool | None) else str(value)


def expected(path: str, what: str, value: object) -> Malformed:
    """The refusal of `value` at `path`, where `what` was expected."""
    return Malformed(path, f"expected {what}, got {shown(value)}")


def rational(value: object, path: str) -> Fraction:
    """A rational in a string: "-?digits" or "-?digits/digits", at most 100 000 digits in all."""
    match = _RATIONAL.fullmatch(value) if isinstance(value, str) and len(value) <= MAX_DIGITS + 2 else None
    if match is None:
        raise expected(path, 'a rational "-?digits" or "-?digits/digits" in a string', value)
    sign, numerator, denominator = match.group(1), match.group(2), match.group(3) or "1"
    if len(numerator) + len(match.group(3) or "") > MAX_DIGITS:
        raise Malformed(path, f"more than {MAX_DIGITS} digits")
    below = _integer(denominator)
    if below == 0:
        raise Malformed(path, "the denominator is zero")
    above = _integer(numerator)
    return Fraction(-above if sign else above, below)


def _integer(digits: str) -> int:
    """The integer with these decimal digits, by halves: no process-wide limit on their number is met or changed."""
    if len(digits) <= _CHUNK:
        return int(digits)
    low = len(digits) // 2
    return int(_integer(digits[:-low]) * 10**low + _integer(digits[-low:]))


def count(value: object, path: str, least: int, most: int | None = None) -> int:
    """A JSON integer between `least` and `most`."""
    if type(value) is not int or value < least or (most is not None and value > most):
        limit = f"of at least {least}" if most is None else f"from {least} to {most}"
        raise expected(path, f"an integer {limit}", value)
    return value


def string(value: object, path: str) -> str:
    """A JSON string of Unicode characters."""
    if not isinstance(value, str) or not _is_unicode(value):
        raise expected(path, "a string", value)
    return value


def _is_unicode(value: str) -> bool:
    return not any("\ud800" <= character <= "\udfff" for character in value)


def array(value: object, path: str, what: str, length: int | None = None) -> list[object]:
    """A JSON array, of `length` elements where one is given."""
    if not isinstance(value, list) or (length is not None and len(value) != length):
        raise expected(path, what, value)
    return value


def fields(value: object, path: str, required: tuple[str, ...], optional: tuple[str, ...] = ()) -> dict[str, object]:
    """A JSON object with all of the keys `required`, and no others but those that are `optional`."""
    if not isinstance(value, dict):
        raise expected(path, "an object", value)
    for key in value:
        if key not in required and key not in optional:
            raise Malformed(path, f"unknown key {shown(key)}")
    for key in required:
        if key not in value:
            raise Malformed(path, f'missing key "{key}"')
    return value
