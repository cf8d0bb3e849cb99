"""The checker under mutated certificates: no false one accepted, nearly every true one accepted."""

from __future__ import annotations

from random import Random

import pytest

from .adapter import check_status, command_line_status, prove_json
from .conftest import WITH_MARGINS
from .designs import NAMED
from .duel import Score, duel, unacceptable
from .mutants import mutants, sweep
from .mutate import Mutant
from .mutate_ends import fitted
from .strict_json import loads
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
def golden(handmade: dict[str, bytes], with_margins: dict[str, bytes]) -> dict[str, bytes]:
    """The prover's certificates of some designs, and the ones made by hand of all."""
    proved = {f"{name}, proved": prove_json(NAMED[name].mapping(name)) for name in GOLDEN}
    return {**handmade, **with_margins, **proved}


@pytest.mark.parametrize("name", sorted(NAMED))
def test_certificates_made_without_the_prover_are_accepted(handmade, name):
    assert check_status(handmade[name]) == 0


@pytest.mark.parametrize("name", WITH_MARGINS)
def test_margins_made_without_the_prover_are_accepted(with_margins, name):
    assert judge(with_margins[f"{name}, margins"]).word == "true"
    assert check_status(with_margins[f"{name}, margins"]) == 0


def drawn(certificates: dict[str, bytes], count: int) -> list[Mutant]:
    """Mutants by the edits that know margins, boxes and members."""
    trees = [(name, loads(data)) for name, data in certificates.items()]
    made = (fitted(*trees[k % len(trees)], Random(f"ends {k}")) for k in range(count))
    return [mutant for mutant in made if mutant is not None]


def test_forty_mutants_of_margins(with_margins):
    assert_stood(duel(drawn(with_margins, 40)))


@pytest.mark.slow
def test_six_hundred_mutants_of_margins(with_margins, golden):
    proved = {name: data for name, data in golden.items() if name.endswith("proved")}
    assert_stood(duel(drawn({**with_margins, **proved}, 600)))


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
