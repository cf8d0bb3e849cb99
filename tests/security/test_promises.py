"""Every promise of SECURITY.md names a test that exists, and every defect listed under Security in CHANGELOG.md too."""

import re
from pathlib import Path

import pytest

NAMED = re.compile(r"`(tests/[\w/.]+\.py)(?:::(\w+))?`")


def missing(text: str, root: Path) -> list[str]:
    """Tests that a text names and that do not exist."""
    return [
        f"{file}::{test}"
        for file, test in NAMED.findall(text)
        if not (root / file).is_file() or (test and f"def {test}(" not in (root / file).read_text("utf-8"))
    ]


def test_each_promise_has_its_test(checkout: Path) -> None:
    text = (checkout / "SECURITY.md").read_text("utf-8")
    rows = re.findall(r"^\| \*\*.*$", text, re.MULTILINE)
    assert len(rows) >= 8
    assert [row for row in rows if not NAMED.search(row)] == []
    assert missing(text, checkout) == []


def test_each_listed_defect_has_its_test(checkout: Path) -> None:
    text = (checkout / "CHANGELOG.md").read_text("utf-8")
    assert len(NAMED.findall(text)) > 10
    assert missing(text, checkout) == []


@pytest.mark.parametrize("name", ["tests/security/test_none.py", "tests/security/test_promises.py::test_none"])
def test_a_missing_test_is_seen(checkout: Path, name: str) -> None:
    assert len(missing(f"see `{name}`", checkout)) == 1
