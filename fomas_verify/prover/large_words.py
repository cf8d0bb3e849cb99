"""The numbers that decide a claim about a large design, in words: exact to the digits shown, or as a range."""

from __future__ import annotations

from fomas_verify.enclosure.digits import decimal, rounded_down, rounded_up
from fomas_verify.enclosure.interval import Interval
from fomas_verify.enclosure.real import square_root
from fomas_verify.spectrum.large_loop import LargeLoop

DIGITS, FEW = 12, 6
TIGHT = 10**DIGITS
"""An enclosure is printed as a number where its width is below this share of it."""


def numbers(loop: LargeLoop, bits: int, *names: str) -> str:
    """``mu = 0.1..., 1/Delta_max = 1/4``: each of these that exists."""
    found = {name: _named(loop, bits, name) for name in names}
    return ", ".join(f"{name} = {bounded(x)}" for name, x in found.items() if x is not None)


def compared(loop: LargeLoop, bits: int, one: str, other: str) -> str:
    """``mu = 0.1... < 1/Delta_max = 1/4``; a comma for the sign where the enclosures do not tell."""
    x, y = _named(loop, bits, one), _named(loop, bits, other)
    if x is None or y is None:
        return numbers(loop, bits, one, other)
    order = x.compare(y)
    sign = ", " if order is None else (" < ", " = ", " > ")[order + 1]
    return f"{one} = {bounded(x)}{sign}{other} = {bounded(y)}"


def bounded(x: Interval) -> str:
    """The number, or what it lies between."""
    if x.is_exact or x.width * TIGHT < max(abs(x.lower), abs(x.upper)):
        return decimal(x, DIGITS)
    return f"[{rounded_down(x.lower, FEW)}, {rounded_up(x.upper, FEW)}]"


def _named(loop: LargeLoop, bits: int, name: str) -> Interval | None:
    match name:
        case "1/Delta_max":
            return None if loop.degree_max == 0 else Interval.exactly(1 / loop.degree_max)
        case "mu":
            return loop.mu(bits)
        case "beta":
            return loop.beta(bits)
        case "sigma":
            return square_root(loop.sigma_square(bits), bits)
        case "mu lambda_max":
            return loop.reach(bits) if loop.facts.is_symmetric else None
        case "2^alpha - 1":
            return loop.threshold(bits)
        case "-sqrt(3^alpha - 2^alpha)":
            return loop.lower_threshold(bits)
    raise ValueError(name)
