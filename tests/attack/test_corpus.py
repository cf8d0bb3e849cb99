"""The corpus of certificates: each is answered with the status and the reason that stand beside it."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from .adapter import ROOT, check_status, command_line_status
from .kinds import contradictions
from .switched_truth import contradiction
from .truth import judge

CORPUS = ROOT / "tests" / "corpus"
DESERVES = {"accepted": ("true", "0"), "rejected": ("false", "1"), "malformed": ("malformed", "2")}
OTHER_KINDS = ("region-", "synthesis-", "switched")
FILES = sorted(CORPUS.glob("*/certificates/*.json"))


def folder(path: Path) -> str:
    return path.parent.parent.name


def is_true(path: Path) -> bool:
    """What the oracle of the certificate's kind says of one of good form."""
    document = json.loads(path.read_bytes())
    if "graphs" not in document["design"]:
        return contradictions(path.read_bytes()) == []
    kind = "condition" if document["kind"] == "region" else "claim"
    said = [(claim["id"], kind) for claim in document["claims"]] + [(key, "value") for key in document["values"]]
    return not any(contradiction(document, *one) for one in said)


@pytest.mark.parametrize("path", FILES, ids=lambda path: f"{folder(path)}/{path.stem}")
def test_status_and_reason(path):
    word, status = DESERVES[folder(path)]
    expected, reason = path.with_suffix(".expected").read_text(encoding="utf-8").splitlines()
    if path.stem.startswith(OTHER_KINDS):
        assert word == "malformed" or is_true(path) == (word == "true")
    else:
        assert judge(path.read_bytes()).word == word
    assert expected == status
    answer, printed = command_line_status(path.read_bytes())
    assert answer == check_status(path.read_bytes()) == int(expected)
    assert reason in printed


def test_more_is_refused_than_accepted():
    counts = {name: sum(folder(path) == name for path in FILES) for name in DESERVES}
    assert counts["accepted"] >= 40
    assert min(counts["rejected"], counts["malformed"]) >= counts["accepted"]
    assert {path.stem for path in CORPUS.glob("*/certificates/*.expected")} == {path.stem for path in FILES}
