"""What to change, in the user's terms: gamma and h where the design gives them, mu otherwise. Bounds are rounded to
the safe side.
"""

from __future__ import annotations

from fractions import Fraction

from fomas_verify.enclosure.digits import rounded_down, rounded_up
from fomas_verify.enclosure.interval import Interval
from fomas_verify.enclosure.real import power_of
from fomas_verify.kernel.memory import one_step_weight
from fomas_verify.spectrum.loop import Loop

DIGITS = 6
BITS = 128


def raise_mu(loop: Loop, least: Fraction, *, below: Fraction | None = None) -> str:
    """Words for ``mu >= least``, with as many digits as it takes to stay below a bound."""
    digits = DIGITS
    while below is not None and Fraction(rounded_up(least, digits - 2)) >= below:
        digits *= 2
    return _change(loop, least, "raise", "to at least", up=True, digits=digits)


def lower_mu(loop: Loop, most: Fraction, *, strict: bool = False) -> str:
    """Words for ``mu <= most``, or ``mu < most``."""
    return _change(loop, most, "lower", "below" if strict else "to at most", up=False)


def _change(loop: Loop, bound: Fraction, verb: str, word: str, *, up: bool, digits: int = DIGITS) -> str:
    design, rounded = loop.design, rounded_up if up else rounded_down
    if design.gamma is None or design.h is None:
        return f"{verb} mu {word} {rounded(bound, digits)}"
    weight = one_step_weight(design.alpha, design.h, BITS)
    gamma = Interval.exactly(bound) / weight
    h = power_of(gamma / design.gamma, 1 / design.alpha, BITS) * design.h
    gamma_text, h_text = (rounded(x.upper if up else x.lower, digits) for x in (gamma, h))
    return f"{verb} gamma {word} {gamma_text} (with h as it is), or h {word} {h_text} (with gamma as it is)"
