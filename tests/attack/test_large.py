"""Certificates of large networks: a corpus with its edge lists, mutants, and an oracle that sees what is false."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from fomas_verify.checker import Malformed, beside, check
from fomas_verify.numeric import Redo

from .adapter import ROOT
from .large import MEMORY, attack, contradictions, golden, lists, status_of

CORPUS = sorted((ROOT / "tests" / "corpus").glob("*/large/*.json"))
MUTANTS = 150


@pytest.mark.parametrize("path", CORPUS, ids=lambda path: f"{path.parent.parent.name}/{path.stem}")
def test_status_and_reason(path: Path) -> None:
    """Of a file whose lines are: the status without a factor, the status with `--numeric`, and the reason then."""
    plain, numeric, reason = path.with_suffix(".expected").read_text(encoding="utf-8").split("\n")[:3]
    said = []
    for redo in (None, Redo(MEMORY)):
        try:
            report = check(path.read_bytes(), opener=beside(path), numeric=redo)
            said.append(
                (str(report.exit_status), "\n".join(x.reason for x in report.outcomes if x.status != "accepted"))
            )
        except Malformed as error:
            said.append(("2", str(error)))
    assert [status for status, _ in said] == [plain, numeric]
    assert reason in said[1][1]
    assert numeric == {"accepted": "0", "rejected": "1", "malformed": "2"}[path.parent.parent.name]
    if numeric != "2":
        known = {json.loads(path.read_bytes())["design"]["graph"].get("sha256"): _list_beside(path)}
        assert (contradictions(path.read_bytes(), known) == []) is (numeric == "0")


def _list_beside(path: Path) -> bytes:
    graph = json.loads(path.read_bytes())["design"]["graph"]
    return (path.parent / graph["file"]).read_bytes() if "file" in graph else b""


def test_the_corpus_refuses_more_than_it_accepts() -> None:
    names = [path.parent.parent.name for path in CORPUS]
    assert names.count("accepted") >= 4
    assert names.count("rejected") + names.count("malformed") > names.count("accepted")


@pytest.fixture(scope="module")
def certificates() -> dict[str, bytes]:
    return golden()


@pytest.mark.slow
def test_what_is_true_is_accepted(certificates: dict[str, bytes]) -> None:
    """Without a factor where the graph is a family or unbalanced, and else with one only."""
    for name, data in certificates.items():
        listed = "file" in json.loads(data)["design"]["graph"] and not name.startswith("unbalanced")
        statuses = [status_of(data, lists(), numeric=numeric) for numeric in (False, True)]
        assert (name, statuses) == (name, [3 if listed else 0, 0])
        assert (name, contradictions(data, lists())) == (name, [])


@pytest.mark.slow
def test_mutants(certificates: dict[str, bytes]) -> None:
    tally = attack(certificates, 31, MUTANTS)
    assert tally.faults == []
    assert tally.stood
    assert min(tally.accepted, tally.refused, tally.malformed) > MUTANTS / 12


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "at", "value", "wrong"),
    [
        ("ring, mu = 1/9", ("spectrum", "lambda2_lower"), "4681/10000", "lambda2_lower"),
        ("ring, mu = 1/9", ("spectrum", "lambda_max_upper"), "3879/1000", "lambda_max_upper"),
        ("weighted, mu = 3/10", ("spectrum", "sigma_upper"), "1/2", "sigma_upper"),
        ("ring, mu = 1/9", ("spectrum", "vectors", 0, 0), 1, "vectors[0]"),
        ("ladder, mu = 1/9", ("values", "sigma", "upper"), "9/10", "sigma"),
        ("torus, mu = 3/10", ("values", "lambda2", "lower"), "11/10", "lambda2"),
        ("path, mu = 1/100", ("values", "beta", "lower"), "1", "beta"),
        ("star, mu = 1/9", ("values", "degree_max", "upper"), "18", "degree_max"),
        ("by gamma and h", ("values", "mu", "upper"), "13/100", "mu"),
        ("complete, mu = 1/2", ("claims", 1, "verdict"), "proved", "gain-bound"),
        ("unbalanced, mu = 1/9", ("claims", 0, "verdict"), "proved", "graph-assumption"),
        ("cycle, mu = 6/5", ("claims", 8, "verdict"), "proved", "average-consensus"),
    ],
)
def test_the_oracle_sees_what_is_false(
    certificates: dict[str, bytes], name: str, at: tuple[Any, ...], value: Any, wrong: str
) -> None:
    document = json.loads(certificates[name])
    place = document
    for key in at[:-1]:
        place = place[key]
    assert place[at[-1]] != value
    place[at[-1]] = value
    data = json.dumps(document).encode()
    assert wrong in contradictions(data, lists())
    assert status_of(data, lists(), numeric=True) in (1, 2)
