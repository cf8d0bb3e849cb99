"""The checker under mutated certificates: no false one accepted, nearly every true one accepted."""

from __future__ import annotations

import pytest

from .adapter import check_status, command_line_status, prove_json
from .designs import NAMED
from .duel import Score, duel, unacceptable
from .mutants import mutants, sweep
from .truth import judge

GOLDEN = (
    "paper",
    "k2-swap",
    "directed-cycle-5-tie",
    "c4-third",
    "c5-golden-tie",
    "k5-negative-beta",
    "unbalanced",
    "two-islands",
    "paper-trajectory",
    "paper-worst-trajectory",
    "paper-at-rest",
    "paper-repaired",
    "weighted-cycles-trajectory",
    "k2-deadbeat-trajectory",
)


def assert_stood(score: Score) -> None:
    assert unacceptable(score) == []
    refused = [f"{mutant.label}: {status}" for word, status, mutant in score.wrong if word == "true"]
    assert score.accepted("true") >= 0.95 * score.total("true"), refused


@pytest.fixture(scope="module")
def golden(handmade: dict[str, bytes]) -> dict[str, bytes]:
    """The prover's certificates of some designs, and the ones made by hand of all."""
    return {**handmade, **{f"{name}, proved": prove_json(NAMED[name].mapping(name)) for name in GOLDEN}}


@pytest.mark.parametrize("name", sorted(NAMED))
def test_certificates_made_without_the_prover_are_accepted(handmade, name):
    assert check_status(handmade[name]) == 0


def test_two_hundred_mutants(golden):
    assert_stood(duel(mutants(golden, 11, 200)))


@pytest.mark.slow
def test_two_thousand_mutants(golden):
    assert_stood(duel(mutants(golden, 12, 2000)))


@pytest.mark.slow
@pytest.mark.parametrize("name", ["paper", "c4-third", "unbalanced"])
def test_every_edit_of_every_field(golden, name):
    assert_stood(duel(sweep(name, golden[f"{name}, proved"])))


@pytest.fixture(scope="module")
def single_edits(golden) -> dict[str, list[bytes]]:
    """Mutants of the paper's certificate by one field, by what they deserve."""
    sorted_out: dict[str, list[bytes]] = {"true": [], "false": [], "malformed": [], "unknown": []}
    for mutant in sweep("paper", golden["paper, proved"]):
        sorted_out[judge(mutant.data).word].append(mutant.data)
    return sorted_out


@pytest.mark.slow
def test_two_hundred_false_fields_are_refused(single_edits):
    assert len(single_edits["false"]) >= 200
    assert [data for data in single_edits["false"] if check_status(data) not in (1, 2)] == []


@pytest.mark.slow
def test_fifty_true_changes_are_accepted(single_edits):
    assert len(single_edits["true"]) >= 50
    assert [data for data in single_edits["true"] if check_status(data) != 0] == []


@pytest.mark.parametrize(("word", "status"), [("true", (0,)), ("false", (1,)), ("malformed", (2,))])
def test_the_command_line_answers_as_the_function_does(golden, word, status):
    drawn = [m.data for m in mutants(golden, 13, 60) if judge(m.data).word == word][:4]
    assert len(drawn) == 4
    for data in drawn:
        answer, printed = command_line_status(data)
        assert answer == check_status(data)
        assert answer in (*status, 2) if word == "false" else answer in status
        assert printed
        assert "Traceback" not in printed
