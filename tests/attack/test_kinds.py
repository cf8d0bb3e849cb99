"""Mutants of certificates of regions and syntheses: no false one accepted, nearly every true one accepted."""

from __future__ import annotations

import json
from collections.abc import Callable
from fractions import Fraction
from typing import Any

import pytest

from .adapter import check_status
from .kinds import attack, contradictions, golden

pytestmark = pytest.mark.slow

MUTANTS = 600


@pytest.fixture(scope="module")
def certificates() -> dict[str, bytes]:
    return golden()


def test_what_the_prover_writes_is_accepted_and_true(certificates: dict[str, bytes]) -> None:
    for name, data in certificates.items():
        assert (name, check_status(data), contradictions(data)) == (name, 0, [])


def test_six_hundred_mutants(certificates: dict[str, bytes]) -> None:
    tally = attack(certificates, 21, MUTANTS)
    assert tally.faults == []
    assert tally.stood
    assert min(tally.accepted, tally.refused, tally.malformed) > MUTANTS / 12


Edit = Callable[[dict[str, Any]], None]


def scaled(factor: str, *at: Any) -> Edit:
    """An edit that multiplies one number."""

    def edit(document: dict[str, Any]) -> None:
        place: Any = document
        for key in at[:-1]:
            place = place[key]
        place[at[-1]] = str(Fraction(place[at[-1]]) * Fraction(factor))

    return edit


@pytest.mark.parametrize(
    ("name", "edit", "wrong"),
    [
        ("region of paper", scaled("999999/1000000", "claims", 0, "witness", "mu", "inner", 0), "as-stated"),
        ("region of paper", scaled("1001/1000", "claims", 1, "witness", "mu", "outer", 0), "repaired-closed-form"),
        ("region of paper", scaled("1000001/1000000", "claims", 2, "witness", "mu", "inner", 1), "repaired"),
        ("region of paper", scaled("2", "claims", 3, "witness", "mu", "inner", 1), "gain-bound"),
        ("region of ring", scaled("9/10", "claims", 4, "witness", "mu", "outer", 1), "consensus"),
        ("synthesis, paper, fastest", scaled("1000001/1000000", "task", "claims", 1, "witness", "bound"), "best"),
        ("synthesis, paper, gentlest", scaled("1000001/1000000", "task", "claims", 1, "witness", "bound"), "best"),
        ("synthesis, paper, slowest-sampling", scaled("999/1000", "task", "claims", 1, "witness", "bound"), "best"),
        ("synthesis, K2, no limits", scaled("999/1000", "task", "claims", 1, "witness", "bound"), "best"),
        ("synthesis, actuator", scaled("1/5", "task", "limits", "u_max"), "feasible"),
        ("synthesis, too soon", scaled("90", "task", "limits", "settle_within"), "feasible"),
    ],
)  # fmt: skip
def test_the_oracle_sees_what_is_false(certificates: dict[str, bytes], name: str, edit: Edit, wrong: str) -> None:
    document = json.loads(certificates[name])
    edit(document)
    data = json.dumps(document).encode()
    assert wrong in contradictions(data)
    assert check_status(data) == 1
