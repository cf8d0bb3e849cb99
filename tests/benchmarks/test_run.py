"""``python -m benchmarks --quick``: the page and the chart, from one run of everything at its smallest sizes."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from benchmarks.topics import STARTS, TOPICS


@pytest.mark.slow
def test_a_quick_run_writes_the_page_and_its_chart(tmp_path: Path, checkout: Path) -> None:
    run = subprocess.run(
        [sys.executable, "-m", "benchmarks", "--quick", "-o", str(tmp_path)],
        cwd=checkout, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert run.returncode == 0, run.stderr
    assert sorted(x.name for x in tmp_path.iterdir()) == ["benchmarks.md", "benchmarks.svg"]
    page = (tmp_path / "benchmarks.md").read_text()
    assert page in run.stdout
    tables = [line for line in page.splitlines() if line.startswith("|")]
    for topic in TOPICS:
        assert f"## {topic.title}" in page
        for method in (m for m in topic.methods if not m.missing):
            measured = [
                line for line in tables if line.startswith(f"| {method.words} | {topic.shown(method.sizes[0]):,} |")
            ]
            assert measured
            assert sum(line.startswith(f"| {topic.title} | {method.words} |") for line in tables) == 1
    for process in STARTS:
        assert any(line.startswith(f"| {process} |") for line in tables)
    assert "machine: " in page
    assert os.uname().nodename not in page
    drawn = (tmp_path / "benchmarks.svg").read_text()
    assert drawn.count("CPU seconds") == len(TOPICS)
    assert "metadata" not in drawn


def test_the_stored_page_is_of_a_full_run(checkout: Path) -> None:
    page = (checkout / "docs" / "benchmarks.md").read_text()
    assert (checkout / "docs" / "benchmarks.svg").is_file()
    for topic in TOPICS:
        for method in topic.methods:
            assert f"{topic.shown(method.sizes[-1]):,} | " in page.partition(f"## {topic.title}")[2]
            assert method.words in page
