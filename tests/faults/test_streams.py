"""Standard output that is full, closed or read by nobody: the right status, at most one line, no traceback."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import pytest

from .commands import NEW, call, environment, found, lay
from .processes import told

pytestmark = pytest.mark.slow
CALLS = [
    "prove plant.toml",
    "prove plant.toml --json",
    "check kept.json",
    "check kept.json --json",
    "kernel plant.toml --terms 2000",
    "region plant.toml",
    "region plant.toml --json",
    "synthesize plant.toml --objective gentlest --direct",
    "simulate plant.toml --samples 50 --json",
    "gate designs -j 1",
    "gate designs -j 1 --json",
    "sweep grid.toml -o rows -j 1",
    "report plant.toml -o report --format md",
    "init made",
    "schema design",
    "completion bash",
    "selftest",
    "prove --help",
    "--version",
]


@pytest.fixture
def folder(room: Path, checkout: Path) -> Path:
    lay({**NEW, "kept.json": (checkout / "reports" / "paper" / "certificate.json").read_bytes()}, room)
    return room


def started(words: str, folder: Path, stdout: int, prefix: tuple[str, ...] = ()) -> subprocess.CompletedProcess[str]:
    return told([*prefix, *call(tuple(words.split()))], folder, stdout=stdout)


@pytest.mark.parametrize("words", CALLS)
def test_standard_output_on_a_full_disk(words: str, folder: Path) -> None:
    if not Path("/dev/full").exists():
        pytest.skip("this system has no /dev/full")
    full = os.open("/dev/full", os.O_WRONLY)
    run = started(words, folder, full)
    os.close(full)
    assert (run.returncode, run.stderr.splitlines()[-1:]) == (
        2,
        ["verify-design: standard output: cannot write: No space left on device"],
    )
    assert "Traceback" not in run.stderr


@pytest.mark.parametrize("words", CALLS)
def test_a_reader_that_went_away(words: str, folder: Path) -> None:
    reader, writer = os.pipe()
    os.close(reader)
    run = started(words, folder, writer)
    os.close(writer)
    assert (run.returncode, run.stderr) == (141, "")


@pytest.mark.parametrize("words", CALLS)
def test_no_standard_output_at_all(words: str, folder: Path) -> None:
    """Closed before the start: the status says what came of it."""
    run = started(words, folder, subprocess.DEVNULL, ("/bin/sh", "-c", 'exec "$0" "$@" >&-'))
    assert (run.returncode, run.stderr) == (0, "")
    if words == "init made":
        assert found(folder)["made/plant.design.toml"]


def test_both_streams_on_a_full_disk(folder: Path) -> None:
    with Path("/dev/full").open("w") as full:
        run = subprocess.run(
            call(("prove", "no-such-file.toml")), cwd=folder, env=environment(), stdout=full, stderr=full, check=False
        )
    assert run.returncode == 2
