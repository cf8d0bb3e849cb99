"""Every file in examples/ is decided, and the commands that it shows do their work."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

from fomas_verify.design import LargeDesign, SwitchedDesign, read_named
from fomas_verify.prover import prove, prove_large

pytestmark = pytest.mark.slow

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
# What the comment at the head of each file says of it: claims that are proved, and claims that are refuted.
SAYS = {
    "complete8": (["beta-contraction", "control-norm-bound", "average-consensus"], []),
    "limits": (["average-consensus"], []),
    "paper": (["memory-inequality", "average-consensus"], ["beta-contraction", "control-norm-bound"]),
    "path4": (["memory-inequality"], ["gain-bound", "average-consensus"]),
    "repaired": (["repaired-condition", "control-norm-bound"], ["beta-contraction"]),
    "ring10": (["memory-inequality", "average-consensus"], []),
    "swarm": (["gain-bound", "average-consensus"], ["memory-inequality", "control-norm-bound"]),
    "unbalanced": (["gain-bound", "perron-eigenvalues"], ["graph-assumption"]),
}
NAMES = sorted(path.stem for path in EXAMPLES.glob("*.toml"))


@pytest.mark.parametrize("name", NAMES)
def test_an_example_is_what_it_says(name: str) -> None:
    design = read_named(EXAMPLES / f"{name}.toml")
    if isinstance(design, SwitchedDesign):
        done = start("prove", f"examples/{name}.toml")
        assert (done.returncode, "All 3 required claims are proved." in done.stdout) == (0, True)
        return
    proof = prove_large(design) if isinstance(design, LargeDesign) else prove(design)
    verdicts = {name: decision.verdict.value for name, decision in proof.decisions.items()}
    proved, refuted = SAYS[name]
    assert {verdicts[x] for x in proved} == {"proved"}
    assert {verdicts[x] for x in refuted} <= {"refuted"}
    assert proof.exit_status == 0


@pytest.mark.parametrize(
    ("name", "arguments"),
    [
        (path.stem, line.split())
        for path in sorted(EXAMPLES.rglob("*.toml"))
        for line in re.findall(r"^#.*?verify-design ([^`\n]+)", path.read_text("utf-8"), re.MULTILINE)
    ],
)
def test_a_command_that_an_example_shows(name: str, arguments: list[str], tmp_path: Path) -> None:
    if "-o" in arguments:
        place = arguments.index("-o") + 1
        arguments[place] = str(tmp_path / arguments[place])
    done = start(*arguments)
    assert done.returncode == 0, done.stderr
    assert ("-o" in arguments) == any(tmp_path.iterdir())


def start(*arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-m", "fomas_verify", *arguments],
        cwd=EXAMPLES.parent,
        capture_output=True,
        text=True,
        check=False,
    )
