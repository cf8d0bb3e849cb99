"""Rational numbers from text and back, exactly and within stated limits.

A decimal is the rational it writes: `0.9` is 9/10, never the nearest binary float. Length and exponent are examined
before anything is expanded, so `1e999999999` costs nothing.
"""

import re
from fractions import Fraction
from typing import Final

from fomas_verify.exact.errors import FomasError

MAX_CHARACTERS: Final = 4000
MAX_EXPONENT: Final = 4000

_DECIMAL = re.compile(r"([+-]?)([0-9]+)(?:\.([0-9]+))?(?:[eE]([+-]?[0-9]+))?")
_FRACTION = re.compile(r"([+-]?[0-9]+)/([0-9]+)")
_EXCERPT_CHARACTERS = 40
# str(int) is limited to 4300 digits by default; 10^4000 is safely below.
_CHUNK_DIGITS = 4000
_CHUNK_LIMIT = 10**_CHUNK_DIGITS


class RationalError(FomasError, ValueError):
    """A text is not a rational number, or is one beyond the limits."""


def parse_rational(text: str, *, what: str) -> Fraction:
    """Read a decimal or a fraction exactly.

    Parameters
    ----------
    text : str
        `-2`, `+0.9`, `1e-3` or `9/10`: ASCII digits, a point with digits on both sides, an exponent of absolute value
        at most 4000, or one slash; at most 4000 characters; no white space, underscore, NaN or infinity.
    what : str
        Name of the number in the error message, such as `design.toml: alpha`.

    Returns
    -------
    Fraction
        The number itself, exact.

    Raises
    ------
    RationalError
        The text is anything else, or its denominator is zero. The message is one line and quotes long input in part.

    Examples
    --------
    >>> parse_rational("0.9", what="alpha")
    Fraction(9, 10)
    """
    if len(text) > MAX_CHARACTERS:
        raise _refused(what, f"a number of at most {MAX_CHARACTERS} characters", text)
    if match := _DECIMAL.fullmatch(text):
        sign, whole, decimals, exponent_text = match.groups(default="")
        exponent = int(exponent_text or "0")
        if abs(exponent) > MAX_EXPONENT:
            raise _refused(what, f"an exponent between -{MAX_EXPONENT} and {MAX_EXPONENT}", text)
        mantissa = int(sign + whole + decimals)
        shift = exponent - len(decimals)
        return Fraction(mantissa * 10**shift) if shift >= 0 else Fraction(mantissa, 10**-shift)
    if match := _FRACTION.fullmatch(text):
        numerator, denominator = map(int, match.groups())
        if denominator == 0:
            raise _refused(what, "a denominator that is not zero", text)
        return Fraction(numerator, denominator)
    raise _refused(what, "a decimal or a fraction such as 0.9 or 9/10", text)


def format_rational(x: Fraction) -> str:
    """Write a rational in lowest terms as `p/q`, or `p` when q = 1, with as many digits as it has.

    Examples
    --------
    >>> format_rational(Fraction(-6, 4))
    '-3/2'
    """
    sign = "-" if x < 0 else ""
    numerator = _digits(abs(x.numerator))
    return f"{sign}{numerator}" if x.denominator == 1 else f"{sign}{numerator}/{_digits(x.denominator)}"


def excerpt(text: str) -> str:
    """Quote text for an error message: one printable line, long text in part with its length."""
    if len(text) <= _EXCERPT_CHARACTERS:
        return repr(text)
    return f"{text[:_EXCERPT_CHARACTERS]!r}... ({len(text)} characters)"


def shortened(digits: str) -> str:
    """Show a printable text without quotes, long text in part with its length."""
    if len(digits) <= _EXCERPT_CHARACTERS:
        return digits
    return f"{digits[:_EXCERPT_CHARACTERS]}... ({len(digits)} characters)"


def _refused(what: str, expected: str, text: str) -> RationalError:
    return RationalError(f"{what}: expected {expected}, got {excerpt(text)}")


def _digits(n: int) -> str:
    """Decimal digits of n >= 0 by halving, independent of the interpreter's limit on int to str."""
    if n < _CHUNK_LIMIT:
        return str(n)
    half = max(_CHUNK_DIGITS, int(n.bit_length() * 0.15))
    upper, lower = divmod(n, 10**half)
    return _digits(upper) + _digits(lower).zfill(half)
