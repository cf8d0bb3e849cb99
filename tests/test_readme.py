"""What README.md shows is what the commands print."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
BLOCKS = re.findall(r"```console\n\$ verify-design ([^\n]+)\n(.*?)```", (ROOT / "README.md").read_text(), re.DOTALL)


@pytest.mark.parametrize(("call", "shown"), BLOCKS, ids=[call for call, _ in BLOCKS])
def test_shown_output_is_real(call: str, shown: str, tmp_path: Path) -> None:
    """Each console block of README.md, to the letter; what is written goes elsewhere."""
    arguments = call.split()
    if "-o" in arguments:
        arguments[arguments.index("-o") + 1] = str(tmp_path / "written")
    done = subprocess.run(
        [sys.executable, "-m", "fomas_verify", *arguments], cwd=ROOT, capture_output=True, text=True, check=False
    )
    assert done.stdout.strip() == shown.strip()


def test_there_is_output_to_compare() -> None:
    """The pattern above finds the blocks."""
    assert len(BLOCKS) >= 1
