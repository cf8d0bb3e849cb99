"""Certificates of known worth, each answered in this process: the corpus, and mutants that an oracle has judged.

Not collected with the other tests: the duel of the mutated checker names this file.
"""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from fomas_verify.checker import command
from tests.attack.designs import NAMED
from tests.attack.handmade import certificate
from tests.attack.mutants import mutants
from tests.attack.mutate import Mutant
from tests.attack.truth import judge

CORPUS = sorted((Path(__file__).resolve().parents[1] / "corpus").glob("*/certificates/*.json"))
STATUS = {"true": 0, "false": 1, "malformed": 2}
HANDMADE = {name: certificate(design) for name, design in NAMED.items()}
JUDGED = [(m, word) for m in mutants(HANDMADE, 21, 600) if (word := judge(m.data).word) in STATUS]


@pytest.mark.parametrize("path", CORPUS, ids=lambda path: f"{path.parent.parent.name}/{path.stem}")
def test_the_corpus(path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    status, reason = path.with_suffix(".expected").read_text(encoding="utf-8").splitlines()
    assert command.main([str(path)]) == int(status)
    printed = capsys.readouterr()
    assert reason in printed.out + printed.err


@pytest.mark.parametrize("name", HANDMADE)
def test_certificates_made_by_hand(name: str, tmp_path: Path) -> None:
    file = tmp_path / "certificate.json"
    file.write_bytes(HANDMADE[name])
    assert command.main([str(file)]) == 0
    assert json.loads(HANDMADE[name])["claims"]


@pytest.mark.parametrize(("mutant", "word"), JUDGED, ids=lambda value: getattr(value, "label", value))
def test_mutants_of_certificates(mutant: Mutant, word: str, tmp_path: Path) -> None:
    file = tmp_path / "certificate.json"
    file.write_bytes(mutant.data)
    assert command.main([str(file)]) == STATUS[word]
