"""Each page of docs/ that shows commands, followed line by line in an empty folder."""

from pathlib import Path

import pytest

from tests.docs.console import agrees, follow

pytestmark = pytest.mark.slow

DOCS = Path(__file__).resolve().parents[2] / "docs"
PAGES = {
    path.relative_to(DOCS).as_posix(): path for path in sorted(DOCS.rglob("*.md")) if "```console" in path.read_text()
}


@pytest.mark.parametrize("name", PAGES)
def test_a_page_is_what_happens(name: str, tmp_path: Path) -> None:
    follow(PAGES[name].read_text("utf-8"), tmp_path)


def test_the_tutorial_and_the_how_to_pages_are_followed() -> None:
    assert "tutorial.md" in PAGES
    assert len([name for name in PAGES if name.startswith("how-to/")]) >= 4


@pytest.mark.parametrize(
    ("shown", "printed"),
    [("one\n", "two\n"), ("one\n", "one\ntwo\n"), ("one\n...\n", "zero\none\n"), ("", "one\n"), ("a...\n", "abc\n")],
)
def test_another_output_is_seen(shown: str, printed: str) -> None:
    assert not agrees(shown, printed)


def test_an_elision_stands_for_lines() -> None:
    assert agrees("one\n...\nfour\n", "one\n  two\nthree\nfour\n")
    assert agrees("...\n", "")
