"""Mutants of certificates about graphs to switch among, judged by numpy."""

from __future__ import annotations

import json

import pytest

from fomas_verify.checker import check
from tests.checker import switched

from .switched_truth import BASES, attack, contradiction

MUTANTS = 1500


def test_no_false_mutant_is_accepted() -> None:
    tally = attack(11, MUTANTS)
    assert tally.faults == []
    assert min(tally.accepted, tally.refused) > MUTANTS / 4
    assert tally.malformed < MUTANTS / 2


@pytest.mark.parametrize("number", range(len(BASES)))
def test_the_oracle_accepts_what_is_true(number: int) -> None:
    document = BASES[number]
    for outcome in check(json.dumps(document).encode()).outcomes:
        assert outcome.status == "accepted"
        assert contradiction(document, outcome.id, outcome.kind) == ""


def test_the_oracle_sees_what_is_false() -> None:
    document = switched.proved("7/10")
    assert contradiction(document, "average-consensus", "claim") == "consensus"
    document = switched.slow()
    document["values"]["rate"]["rho"] = "4/5"
    assert contradiction(document, "rate", "value") == "rate at k = 1"
    document = switched.region_by_dual()
    document["claims"][1]["witness"]["mu"]["outer"][1] = "1/2"
    assert contradiction(document, "common-form", "condition") == "dual"
