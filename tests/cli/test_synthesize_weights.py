"""``verify-design synthesize --weights``: weights, then gamma and h, as a design with its certificate."""

import json
import re
import tomllib
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from subprocess import CompletedProcess

import pytest

pytestmark = pytest.mark.slow

Verify = Callable[..., CompletedProcess[str]]

PAPER = "examples/paper.toml"


def test_the_papers_graph(verify: Verify, tmp_path: Path) -> None:
    """Equal weights reach 0.818864181986644... at their best mu; no weights have less than 0.78464043..."""
    found, certificate = tmp_path / "best.toml", tmp_path / "best.json"
    run = verify("synthesize", PAPER, "--weights", "-o", found)
    assert (run.returncode, run.stderr) == (0, "")
    for pattern in (
        r"^  sigma with the chosen weights    0\.7846404\d+\.\.\., at mu = 1$",
        r"^  sigma as given, at the best mu   0\.818864181986\.\.\.$",
        r"^  every choice of weights has      at least 0\.7846404\d+$",
        r"^   4   1  0: the edge is left out$",
        r"^All 6 required claims are proved of it",
    ):
        assert re.search(pattern, run.stdout, re.MULTILINE), pattern
    text = found.read_text()
    assert text.startswith("# found by: verify-design synthesize --objective most-robust --weights; clarabel proposed")
    edges = tomllib.loads(text, parse_float=Fraction)["graph"]["edges"]
    for agent in range(1, 6):
        assert sum(w for _, j, w in edges if j == agent) == sum(w for i, _, w in edges if i == agent)
    assert json.loads(certificate.read_text())["task"]["solver"] == "clarabel"
    checked = verify("check", certificate, "--design", found, "--require", "design")
    assert (checked.returncode, checked.stderr) == (0, "")
    document = json.loads(certificate.read_text())
    document["design"]["edges"][0][2] = str(Fraction(document["design"]["edges"][0][2]) + Fraction(1, 10**6))
    certificate.write_text(json.dumps(document))
    assert verify("check", certificate).returncode == 1


def test_for_programs_and_symmetric(verify: Verify) -> None:
    """On a path every probability 1/2 is best, and sigma = cos(pi/4)."""
    run = verify("synthesize", "examples/path4.toml", "--weights", "--symmetric", "--json")
    assert run.returncode in (0, 1), run.stderr
    weights = json.loads(run.stdout)["weights"]
    assert len({w for _, _, w in weights["edges"]}) == 1
    root = Fraction("0.70710678118654752440")
    assert Fraction(weights["least_sigma"]) <= root < Fraction(weights["sigma"]["upper"]) < root + Fraction(1, 10**4)
    assert "weights" not in json.loads(verify("synthesize", PAPER, "--json").stdout)


@pytest.mark.parametrize(
    ("arguments", "status", "message"),
    [
        (
            ["--weights", "--symmetric"],
            1,
            "no weights do: agent 1 does not reach agent 2 over edges in both directions",
        ),
        (["--symmetric"], 2, "--symmetric: expected with --weights only"),
    ],
)
def test_what_is_refused(verify: Verify, arguments: list[str], status: int, message: str) -> None:
    run = verify("synthesize", PAPER, *arguments)
    assert (run.returncode, run.stdout) == (status, "")
    assert message in run.stderr
    assert run.stderr.count("\n") == 1
