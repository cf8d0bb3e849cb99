"""The prover's enclosures (Arb) at 10^5 points and the checker's (integers) at 10^3, against MPFR."""

from __future__ import annotations

import os
from fractions import Fraction

import pytest

from fomas_verify.checker import powers
from fomas_verify.enclosure import real
from fomas_verify.enclosure.interval import Interval

from .primitives import BITS, Point, misses

ARB_POINTS = int(os.environ.get("FOMAS_PRIMITIVE_POINTS", "100000"))
CHECKER_POINTS = 1000


def ends(x: Interval | powers.Enclosure) -> tuple[Fraction, Fraction]:
    return x.lower, x.upper


ARB = {
    "power": lambda p: ends(real.power(p.base, p.exponent, BITS)),
    "gamma": lambda p: ends(real.gamma_function(1 + p.exponent, BITS)),
    "square root": lambda p: ends(real.square_root(Interval.exactly(p.base), BITS)),
    "log2": lambda p: ends(real.log2(Interval.exactly(p.base), BITS)),
}
CHECKER = {
    "power": lambda p: ends(powers.power(p.base, p.exponent, BITS)),
    "gamma": lambda p: ends(powers.gamma_one_plus(p.exponent, BITS)),
    "square root": lambda p: ends(powers.square_root(powers.point(p.base), BITS)),
}


@pytest.mark.slow
@pytest.mark.parametrize("name", ARB)
def test_arb_at_many_points(name: str) -> None:
    assert misses({name: ARB[name]}, 1, ARB_POINTS) == []


@pytest.mark.parametrize("name", CHECKER)
def test_the_checkers_own_at_a_thousand_points(name: str) -> None:
    assert misses({name: CHECKER[name]}, 2, CHECKER_POINTS) == []


def test_an_enclosure_rounded_to_nearest_is_seen() -> None:
    """A float power, widened by nothing, misses at nearly every point; one rounded inward by a hair too."""

    def nearest(p: Point) -> tuple[Fraction, Fraction]:
        x = real.power(p.base, p.exponent, BITS).mid
        return x + abs(x) / 2**140, x + abs(x) / 2**139

    assert len(misses({"power": nearest}, 3, 200)) > 150
