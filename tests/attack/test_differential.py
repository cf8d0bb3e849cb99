"""Prover, checker and oracle on the named designs and on random ones."""

from __future__ import annotations

import json
from collections import Counter

import pytest

from .adapter import command_line_proof, prove
from .designs import KNOWN, NAMED, NORM_BOUNDS
from .differential import Comparison, compare
from .oracle import CLAIMS
from .strata import STRATA, design_at, designs
from .test_oracle import UNKNOWN

pytestmark = pytest.mark.slow


def assert_agreed(comparisons: list[Comparison]) -> None:
    assert {c.name: (c.faults, c.design) for c in comparisons if c.faults} == {}
    assert sum(c.undecided for c in comparisons) < 0.01 * len(CLAIMS) * len(comparisons)


@pytest.mark.parametrize("name", sorted(NAMED))
def test_named_design(name):
    comparison = compare(name, NAMED[name])
    assert comparison.faults == ()
    assert comparison.undecided == len(UNKNOWN.get(name, ()))


@pytest.mark.parametrize("name", sorted(KNOWN))
def test_verdicts_known_without_the_oracle(name):
    document = json.loads(compare(name, NAMED[name]).certificate)
    given = {claim["id"]: claim["verdict"] for claim in document["claims"]}
    assert {claim: word for claim, word in given.items() if claim in KNOWN[name]} == {
        claim: word for claim, word in KNOWN[name].items() if claim in given
    }
    assert KNOWN[name].keys() - given.keys() <= {*NORM_BOUNDS}


def test_forty_random_designs():
    assert_agreed([compare(name, design) for name, design in designs(21, 40)])


def test_three_hundred_random_designs():
    comparisons = [compare(name, design) for name, design in designs(22, 300)]
    assert_agreed(comparisons)
    assert sum(comparison.undecided for comparison in comparisons) <= 2
    seen = Counter(pair for comparison in comparisons for pair in comparison.verdicts)
    assert {(c, word): n for c in CLAIMS for word in ("proved", "refuted") if (n := seen[c, word]) < 10} == {}


@pytest.mark.parametrize("name", ["paper", "k2-deadbeat-trajectory", "unbalanced"])
def test_the_command_line_proves_as_the_function_does(name):
    design = NAMED[name].mapping(name)
    assert command_line_proof(design) == prove(design)


def test_the_strata_take_turns():
    names = [name for name, _ in designs(0, len(STRATA))]
    assert [name.rsplit(" ", 1)[0] for name in names] == list(STRATA)
    assert list(designs(3, 24)) == list(designs(3, 24))


@pytest.mark.parametrize(("seed", "index"), [(2, 297), (3, 101), (3, 38)])
def test_margins_close_in_where_slack_is_small_and_where_eigenvalues_are_defective(seed, index):
    assert compare(*design_at(seed, index)).faults == ()
