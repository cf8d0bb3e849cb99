"""Relative links in Markdown lead somewhere, in the checkout as on a forge."""

import re
from pathlib import Path

import pytest

LINK = re.compile(r"\]\(([^()\s]+)\)")


def broken(page: Path) -> list[str]:
    """Targets of a page that do not exist, and lines beyond a file's end."""
    found = []
    for target in LINK.findall(page.read_text("utf-8")):
        path, _, anchor = target.partition("#")
        if re.match(r"[a-z]+:", target) or not path:
            continue
        file = page.parent / path
        line = re.fullmatch(r"L(\d+)", anchor)
        if not file.exists() or (line and int(line[1]) > file.read_text("utf-8").count("\n")):
            found.append(target)
    return found


def test_links_lead_somewhere(checkout: Path) -> None:
    pages = [*checkout.glob("*.md"), *(checkout / "docs").rglob("*.md"), checkout / "proofs" / "README.md"]
    assert len(pages) > 20
    assert {str(page.relative_to(checkout)): links for page in pages if (links := broken(page))} == {}


@pytest.mark.parametrize("link", ["missing.md", "sub/", "page.md#L9"])
def test_a_broken_link_is_seen(tmp_path: Path, link: str) -> None:
    page = tmp_path / "page.md"
    page.write_text(f"[one](page.md#L1) and [two]({link})\n")
    assert broken(page) == [link]
