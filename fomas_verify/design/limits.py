"""The table [limits]: what a user can build, for `region` and `synthesize`.

Source: the section on the design file in the README.
"""

from dataclasses import dataclass
from fractions import Fraction
from typing import Final

from fomas_verify.design.fields import Place, number, positive, sequence, shown, table

Range = tuple[Fraction, Fraction]
_RANGES, _NUMBERS = ("h", "gamma"), ("u_max", "settle_within")


@dataclass(frozen=True)
class Limits:
    """What gamma and h have to keep to; None where there is no limit.

    Attributes
    ----------
    h : (lower, upper) or None
        The sampling period in seconds, 0 <= lower <= upper, upper > 0.
    gamma : (lower, upper) or None
        The control gain, likewise.
    u_max : Fraction or None
        What ``peak gamma norm(L x_0)`` must not exceed, > 0.
    settle_within : Fraction or None
        Seconds within which the disagreement must have shrunk to `settle_to`, > 0.
    """

    h: Range | None = None
    gamma: Range | None = None
    u_max: Fraction | None = None
    settle_within: Fraction | None = None


NO_LIMITS: Final = Limits()


def read_limits(value: object, place: Place) -> Limits:
    """Read the table [limits]; raises `DesignError` for an unknown key, a negative number or lower > upper."""
    given = table(value, place, (*_RANGES, *_NUMBERS))
    u_max, within = (positive(given[key], place.key(key)) if key in given else None for key in _NUMBERS)
    h, gamma = (_range(given[key], place.key(key)) if key in given else None for key in _RANGES)
    return Limits(h, gamma, u_max, within)


def _range(value: object, place: Place) -> Range:
    lower, upper = sequence(value, place, "a list [lower, upper] of two numbers", 2)
    low, high = number(lower, place.item(0)), positive(upper, place.item(1))
    if low < 0:
        raise place.item(0).expected("a number >= 0", lower)
    if low > high:
        raise place.item(1).expected(f"a number at or above {shown(low)}, the lower end", upper)
    return low, high
