"""What to change, in the user's terms: gamma and h where the design gives them, mu otherwise. Bounds are rounded to
the safe side.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Protocol

from fomas_verify.design.model import Given
from fomas_verify.enclosure.digits import rounded_down, rounded_up
from fomas_verify.enclosure.interval import Interval
from fomas_verify.enclosure.real import log2, power_of

DIGITS = 6
BITS = 192
LARGEST = 4096
"""No factor of h is told beyond ``2^4096``, where alpha is near 0."""


class Gained(Protocol):
    """The closed loop of a design of any size."""

    @property
    def design(self) -> Given:
        """What gives gamma and h, or mu."""

    @property
    def degree_max(self) -> Fraction:
        """D."""

    def mu(self, bits: int) -> Interval:
        """The integrated gain."""

    def lambda2(self, bits: int) -> Interval:
        """The smallest eigenvalue of L_s on 1perp."""


def raise_mu(loop: Gained, least: Fraction, *, below: Fraction | None = None) -> str:
    """Words for ``mu >= least``, with as many digits as it takes to stay below a bound."""
    digits = DIGITS
    while below is not None and Fraction(rounded_up(least, digits - 2)) >= below:
        digits *= 2
    return _change(loop, least, "raise", "to at least", up=True, digits=digits)


def lower_mu(loop: Gained, most: Fraction, *, strict: bool = False, above: Fraction | None = None) -> str:
    """Words for ``mu <= most``, or ``mu < most``, with as many digits as it takes to stay above a bound."""
    digits = DIGITS
    while above is not None and Fraction(rounded_down(most, digits - 2)) <= above:
        digits *= 2
    return _change(loop, most, "lower", "below" if strict else "to at most", up=False, digits=digits)


def in_users_terms(loop: Gained, end: Interval) -> dict[str, tuple[Interval, Interval]]:
    """What makes mu equal to the end, each number moved alone: its factor and its value.

    Of gamma and h where the design gives both, of mu otherwise; h is absent where its factor is beyond all bounds.
    """
    design = loop.design
    factor = end / loop.mu(BITS)
    if design.gamma is None or design.h is None:
        return {"mu": (factor, end)}
    found = {"gamma": (factor, factor * design.gamma)}
    if factor.lower > 0 and abs(log2(factor, 64).upper / design.alpha) < LARGEST:
        of_h = power_of(factor, 1 / design.alpha, BITS)
        found["h"] = (of_h, of_h * design.h)
    return found


def _change(loop: Gained, bound: Fraction, verb: str, word: str, *, up: bool, digits: int) -> str:
    rounded = rounded_up if up else rounded_down
    moved = {
        name: rounded(value.upper if up else value.lower, digits)
        for name, (_, value) in in_users_terms(loop, Interval.exactly(bound)).items()
    }
    if "gamma" not in moved:
        return f"{verb} mu {word} {moved['mu']}"
    or_h = f", or h {word} {moved['h']} (with gamma as it is)" if "h" in moved else ""
    return f"{verb} gamma {word} {moved['gamma']} (with h as it is){or_h}"
