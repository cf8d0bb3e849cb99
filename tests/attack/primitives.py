"""Every enclosure primitive between MPFR's two directed roundings.

Arguments are binary fractions, which MPFR holds exactly; at 500 bits its roundings down and up bound the true value.
An enclosure must contain both bounds up to their own width, so it must overlap and reach at least as far as the
nearer of them.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import gmpy2

BITS = 160
MPFR_BITS = 500
EDGES = (Fraction(1, 2**62), Fraction(1, 2**30), Fraction(1, 2), 1 - Fraction(1, 2**30), 1 - Fraction(1, 2**62))


@dataclass(frozen=True)
class Point:
    """A base, an exponent in (0, 1)."""

    base: Fraction
    exponent: Fraction


def points(seed: int, count: int) -> Iterator[Point]:
    """The edges first, then random ones over many orders of magnitude."""
    source = random.Random(seed)
    for exponent in EDGES:
        for base in (Fraction(1), Fraction(2), Fraction(1, 2**200), Fraction(2**200), 1 + Fraction(1, 2**60)):
            yield Point(base, exponent)
    for _ in range(count - 5 * len(EDGES)):
        base = Fraction(source.randint(1, 2**40), 2**20) * Fraction(2) ** source.randint(-60, 60)
        yield Point(base, Fraction(source.randint(1, 2**40 - 1), 2**40))


def mpfr_ends(function: Callable[..., Any], *arguments: Fraction) -> tuple[Fraction, Fraction]:
    """The function of exactly represented arguments, rounded down and up."""
    ends = []
    for rounding in (gmpy2.RoundDown, gmpy2.RoundUp):
        with gmpy2.context(precision=MPFR_BITS, round=rounding):
            floats = [gmpy2.mpfr(gmpy2.mpq(x.numerator, x.denominator)) for x in arguments]
            ends.append(Fraction(*map(int, function(*floats).as_integer_ratio())))
    return min(ends), max(ends)


FUNCTIONS: dict[str, Callable[[Point], tuple[Fraction, Fraction]]] = {
    "power": lambda p: mpfr_ends(lambda b, e: b**e, p.base, p.exponent),
    "gamma": lambda p: mpfr_ends(gmpy2.gamma, 1 + p.exponent),
    "square root": lambda p: mpfr_ends(gmpy2.sqrt, p.base),
    "log2": lambda p: mpfr_ends(gmpy2.log2, p.base),
}


def misses(enclose: dict[str, Callable[[Point], tuple[Fraction, Fraction]]], seed: int, count: int) -> list[str]:
    """The points at which an enclosure does not contain the true value, or is wider than 2^-100 of it."""
    found = []
    for point in points(seed, count):
        for name, function in enclose.items():
            low, high = FUNCTIONS[name](point)
            lower, upper = function(point)
            slack = (high - low) * 2
            wide = upper - lower > max(abs(low), abs(high), Fraction(1, 2**64)) / 2**90
            if lower > low + slack or upper < high - slack or wide:
                found.append(f"{name} at {point}: [{float(lower)}, {float(upper)}]")
    return found
