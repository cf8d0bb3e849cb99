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

pytestmark = pytest.mark.slow

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


def test_six_hundred_mutants_of_margins(with_margins, golden):
    proved = {name: data for name, data in golden.items() if name.endswith("proved")}
    assert_stood(duel(drawn({**with_margins, **proved}, 600)))


def test_two_hundred_mutants(golden):
    assert_stood(duel(mutants(golden, 11, 200)))


def test_two_thousand_mutants(golden):
    assert_stood(duel(mutants(golden, 12, 2000)))


@pytest.mark.parametrize(
    ("name", "refused", "accepted"), [("paper", 200, 50), ("c4-third", 20, 20), ("unbalanced", 5, 5)]
)
def test_edits_of_every_field(golden, name, refused, accepted):
    """Each fifth of the edits that fit; `python -m tests.attack --fields` tries all."""
    score = duel(sweep(name, golden[f"{name}, proved"], 5))
    assert_stood(score)
    assert score.counts["false", 1] + score.counts["false", 2] >= refused
    assert score.accepted("true") >= accepted


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
