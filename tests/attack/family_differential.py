"""Prover, checker and oracle on one uncertain design.

Beyond what is asked of any design: a claim proved must hold of members drawn at random and at the corners.
"""

from __future__ import annotations

from fractions import Fraction
from itertools import product
from random import Random

from . import oracle
from .differential import Comparison, compared
from .family import most_gain, verdict
from .form import Document
from .model import Design, Uncertain, assumption_1

DRAWN = 6


def members(family: Uncertain, random: Random) -> list[Design]:
    """The corners, the member of the largest gain, and some at random."""
    ends = family.ends()
    corners = [dict(zip(ends, choice, strict=True)) for choice in product(*({*pair} for pair in ends.values()))]
    drawn = [
        {key: low + (high - low) * Fraction(random.randint(0, 1000), 1000) for key, (low, high) in ends.items()}
        for _ in range(DRAWN)
    ]
    return [*(family.member(numbers) for numbers in (*corners, *drawn)), most_gain(family)]


def _failing(family: Uncertain, claims: list[str]) -> list[str]:
    found = []
    for member in members(family, Random(0)):
        found += [
            f"{claim}: proved, but false of {member}" for claim in claims if oracle.decide(member, claim).truth is False
        ]
    return found


def _faults(document: Document, family: Uncertain) -> list[str]:
    proved = [claim.id for claim in document.claims if claim.verdict == "proved"]
    expected = {"mu", "threshold", "degree_max"}
    if assumption_1(family.member({})):
        expected |= {"lambda2", "beta"}
    given = document.values.keys() - {"limit", "sigma"}
    return [f"{key}: present or absent against the contract" for key in expected ^ given] + _failing(family, proved)


def compare_family(name: str, family: Uncertain) -> Comparison:
    """Run one uncertain design through prover, checker and oracle."""
    return compared(name, family, verdict, _faults)
