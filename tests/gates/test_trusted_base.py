"""The line counts of docs/trusted-base.md are within a tenth of the truth."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
TABLE = (ROOT / "docs" / "trusted-base.md").read_text()


def lines(*patterns: str) -> int:
    files = [path for pattern in patterns for path in ROOT.glob(pattern)]
    return sum(len(path.read_text().splitlines()) for path in files)


@pytest.mark.parametrize(
    ("row", "patterns"),
    [
        ("`fomas_verify/checker/`", ["fomas_verify/checker/*.py"]),
        ("certificate-format.md", ["docs/certificate-format.md"]),
        ("theory.md", ["docs/theory.md"]),
        (
            "`proofs/Statements.v`, `proofs/Statements/` and `proofs/Model/`",
            ["proofs/Statements.v", "proofs/Statements/*.v", "proofs/Model/*.v"],
        ),
    ],
)
def test_the_count(row: str, patterns: list[str]) -> None:
    found = re.search(rf"^\|[^|]*{re.escape(row)}[^|]*\| ([\d ]+) \|", TABLE, re.MULTILINE)
    assert found is not None
    assert abs(int(found[1].replace(" ", "")) - lines(*patterns)) <= lines(*patterns) / 10
