"""Prover, checker and oracle on the named designs and on random ones."""

from __future__ import annotations

import json

import pytest

from .designs import KNOWN, NAMED
from .differential import Comparison, compare
from .oracle import CLAIMS
from .strata import STRATA, designs


def assert_agreed(comparisons: list[Comparison]) -> None:
    assert {c.name: (c.faults, c.design) for c in comparisons if c.faults} == {}
    assert sum(c.undecided for c in comparisons) < 0.01 * len(CLAIMS) * len(comparisons)


@pytest.mark.parametrize("name", sorted(NAMED))
def test_named_design(name):
    comparison = compare(name, NAMED[name])
    assert comparison.faults == ()
    assert comparison.undecided == 0


@pytest.mark.parametrize("name", sorted(KNOWN))
def test_verdicts_known_without_the_oracle(name):
    document = json.loads(compare(name, NAMED[name]).certificate)
    assert {claim["id"]: claim["verdict"] for claim in document["claims"]} == KNOWN[name]


def test_forty_random_designs():
    assert_agreed([compare(name, design) for name, design in designs(21, 40)])


@pytest.mark.slow
def test_three_hundred_random_designs():
    assert_agreed([compare(name, design) for name, design in designs(22, 300)])


def test_the_strata_take_turns():
    names = [name for name, _ in designs(0, len(STRATA))]
    assert [name.rsplit(" ", 1)[0] for name in names] == list(STRATA)
    assert list(designs(3, 24)) == list(designs(3, 24))
