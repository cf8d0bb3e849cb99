"""A minute of the fuzzer, what ever failed, and proof that it sees each kind of failure.

`python -m tests.fuzz` does it at any size; the same numbers are the same inputs everywhere.
"""

from __future__ import annotations

import time
from pathlib import Path

import pytest

from . import campaign as watched
from . import worker
from .campaign import Figures, campaign
from .targets import REFUSAL, TARGETS, draw

FAILED = sorted((Path(__file__).parent / "failed").iterdir())
COUNTS = {"design": 1500, "graph": 1500, "grid": 1500, "certificate": 400, "gate": 400, "prove": 120, "report": 25}


@pytest.mark.parametrize("path", FAILED, ids=lambda path: path.stem)
def test_what_ever_failed_is_refused(path: Path, tmp_path: Path) -> None:
    assert TARGETS[path.stem.split("-")[0]](path.read_bytes(), tmp_path) == REFUSAL


def test_an_input_is_known_by_its_number() -> None:
    for target in TARGETS:
        drawn = [draw(target, 3, index) for index in range(20)]
        assert drawn == [draw(target, 3, index) for index in range(20)]
        assert len(set(drawn)) > 10
        assert max(map(len, drawn)) <= 1_100_000


@pytest.mark.slow
@pytest.mark.parametrize("target", COUNTS)
def test_verdicts_and_refusals_only(target: str) -> None:
    assert set(COUNTS) == set(TARGETS)
    figures = campaign(target, 2026, count=COUNTS[target])
    assert figures.failures == {}
    assert figures.inputs == COUNTS[target]
    assert figures.outcomes["verdict"] > 0
    assert figures.outcomes["refusal"] > 0


@pytest.mark.slow
@pytest.mark.parametrize(
    ("code", "reason"),
    [
        ("raise ZeroDivisionError('by a crafted input')", "ZeroDivisionError"),
        ("raise SystemExit(0)", "SystemExit"),
        ("bytearray(2**31)", "MemoryError"),
        ("while True: pass", "ended by SIGPROF"),
        ("import ctypes; ctypes.string_at(0)", "ended by SIGSEGV"),
        ("from tests.fuzz.targets import _one_line; _one_line('two\\nlines')", "no refusal in one line"),
    ],
)
def test_each_kind_of_failure_is_seen(code: str, reason: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Of the inputs 0 to 4 the one with the number 3 misbehaves; those after it are tried all the same."""
    script = tmp_path / "bad.py"
    script.write_text(
        "import sys\n"
        f"sys.path.insert(0, {str(watched.ROOT)!r})\n"
        "from tests.fuzz import worker\n"
        "worker.SECONDS = 0.5\n"
        "worker.draw = lambda target, seed, index: b'%d' % index\n"
        f"def run(data, folder):\n    if data == b'3':\n        {code}\n    return 'refusal'\n"
        "worker.TARGETS['design'] = run\n"
        "worker.main(sys.argv[1], *map(int, sys.argv[2:6]))\n"
    )
    monkeypatch.setattr(watched, "WORKER", (str(script),))
    monkeypatch.setattr(watched, "FAILURES", tmp_path / "failures")
    figures = campaign("design", 1, count=5)
    assert list(figures.failures) == [3]
    assert reason in figures.failures[3]
    assert figures.outcomes == {"refusal": 4, "failure": 1}
    assert (tmp_path / "failures" / "design-1-3.input").read_bytes() == draw("design", 1, 3)


def test_the_limits_are_those_that_are_stated() -> None:
    assert (worker.SECONDS, worker.MEMORY) == (10, 2**30)


def test_a_campaign_ends_when_its_time_is_over() -> None:
    began = time.monotonic()
    figures: Figures = campaign("grid", 1, seconds=1)
    assert figures.failures == {}
    assert time.monotonic() - began < watched.WALL_SECONDS
