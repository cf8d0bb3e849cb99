"""``verify-design region``: the numbers of the paper's graph, the exit status, files and refusals."""

import json
import re
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from subprocess import CompletedProcess

import pytest

Verify = Callable[..., CompletedProcess[str]]

PAPER = "examples/paper.toml"
GRAPH = """[graph]
adjacency = [[0,0,0,1,1], [1,0,1,0,0], [1,1,0,0,0], [0,1,1,0,0], [0,0,0,1,0]]
"""
RING = '[graph]\nfamily = "directed-cycle"\nagents = 20\n'
# theory, section 5: each digit is a digit of the exact number
ENDS = {
    "as-stated": ("0.13393401692638516", "0.5"),
    "repaired": ("0.15678262217303748", "0.39651947232308543"),
    "gain-bound": ("0", "0.5"),
    "consensus": ("0", "0.66666666666666666"),
}
OPENS = {"as-stated": "0.58496250", "repaired-closed-form": "0.89996863", "repaired": "0.86303781"}


def write(folder: Path, text: str) -> Path:
    path = folder / "design.toml"
    path.write_text(text)
    return path


def conditions(run: CompletedProcess[str]) -> dict[str, dict]:
    assert (run.returncode, run.stderr) == (0, "")
    return {entry["id"]: entry for entry in json.loads(run.stdout)["conditions"]}


def assert_digits(digits: str, *values: str) -> None:
    """Every value begins with these digits, or the shortest of them ends in a rounding by one unit."""
    unit = Fraction(1, 10 ** len(digits.partition(".")[2]))
    for value in values:
        assert abs(Fraction(value) - Fraction(digits)) < unit * Fraction(101, 100), (digits, float(Fraction(value)))


def test_the_papers_graph_in_json(verify: Verify) -> None:
    found = conditions(verify("region", PAPER, "--json"))
    assert list(found) == ["as-stated", "repaired-closed-form", "repaired", "gain-bound", "consensus"]
    assert all(entry["empty"] is False for entry in found.values())
    for name, (low, high) in ENDS.items():
        inner, outer = ([Fraction(x) for x in found[name]["mu"][key]] for key in ("inner", "outer"))
        assert outer[0] <= inner[0] < inner[1] <= outer[1]
        assert max(inner[0] - outer[0], outer[1] - inner[1]) < outer[1] / 10**9
        if name != "consensus":
            assert_digits(low, *(found[name]["mu"][key][0] for key in ("inner", "outer")))
            assert_digits(high, *(found[name]["mu"][key][1] for key in ("inner", "outer")))
    assert (
        Fraction(found["consensus"]["mu"]["inner"][1])
        < Fraction(2, 3)
        <= Fraction(found["consensus"]["mu"]["outer"][1])
    )
    assert (
        Fraction(found["gain-bound"]["mu"]["inner"][1])
        < Fraction(1, 2)
        == Fraction(found["gain-bound"]["mu"]["outer"][1])
    )
    for name, digits in OPENS.items():
        assert_digits(digits, *found[name]["alpha_opens"].values())
    assert found["gain-bound"]["alpha_opens"] is found["consensus"]["alpha_opens"] is None


def test_the_papers_graph_in_the_table(verify: Verify) -> None:
    run = verify("region", PAPER)
    assert (run.returncode, run.stderr) == (0, "")
    for pattern in (
        r"^as-stated +\[0\.13393401692638516\d+\.\.\., 0\.5\) +0\.58496250\d+",
        r"^repaired +\[0\.15678262217303748\d+\.\.\., 0\.39651947232308543\d+\.\.\.\] +0\.86303781\d+",
        r"^gain-bound +\(0, 0\.5\) +every$",
        r"^consensus +\(0, 2/3\) +every$",
        r"^repaired +\[0\.174538096247815173\.\.\., ",
        r"sigma = 0\.818864181986644\d*\.\.\., near mu = 0\.28597$",
        r"^  inside as-stated, gain-bound, consensus$",
        r"^  outside repaired-closed-form, repaired$",
    ):
        assert re.search(pattern, run.stdout, re.MULTILINE), pattern


@pytest.mark.parametrize("alpha", ["0.8", "0.86"])
def test_where_no_mu_is_repaired(verify: Verify, tmp_path: Path, alpha: str) -> None:
    """Empty, with its proof, and with the alpha that would open it."""
    design, certificate = write(tmp_path, f"alpha = {alpha}\n{GRAPH}"), tmp_path / "region.json"
    found = conditions(verify("region", design, "--json", "-o", certificate))["repaired"]
    assert (found["empty"], "mu" in found) == (True, False)
    assert_digits("0.86303781", *found["alpha_opens"].values())
    (claim,) = (x for x in json.loads(certificate.read_text())["claims"] if x["id"] == "repaired")
    assert claim["verdict"] == "refuted"
    assert 1 <= len(claim["witness"]["pairs"]) <= 2
    checked = verify("check", certificate, "--design", design)
    assert (checked.returncode, checked.stderr) == (0, "")
    u, _ = max(claim["witness"]["pairs"], key=lambda pair: max(abs(int(x)) for x in pair[0]))
    u[:] = [str(9 * int(x)) for x in u]
    document = json.loads(certificate.read_text())
    document["claims"][2] = claim
    certificate.write_text(json.dumps(document))
    assert verify("check", certificate).returncode == 1


def test_a_ring_of_twenty_opens_late(verify: Verify, tmp_path: Path) -> None:
    found = conditions(verify("region", write(tmp_path, f"alpha = 0.9\n{RING}"), "--json"))
    assert found["as-stated"]["empty"] is True
    assert_digits("0.96425556", *found["as-stated"]["alpha_opens"].values())


def test_the_certificate_is_about_a_graph_and_an_order_and_proves_no_claim(verify: Verify, tmp_path: Path) -> None:
    certificate = tmp_path / "region.json"
    assert verify("region", PAPER, "-o", certificate).returncode == 0
    assert verify("check", certificate, "--design", PAPER).returncode == 0
    assert verify("check", certificate, "--design", "examples/ring10.toml").returncode == 1
    for required in ("design", "gain-bound"):
        run = verify("check", certificate, "--require", required)
        assert run.returncode == 1
        assert "gain-bound: absent from the certificate" in run.stdout


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("alpha = [0.8, 0.9]\n" + GRAPH, "alpha: expected a number, got an interval"),
        ("alpha = 0.9\n[limits]\nh = [2, 1]\n" + GRAPH, "limits.h[1]: expected a number at or above 2"),
        ("alpha = 0.9\n[graph]\nagents = 3\nedges = []\n", "graph: region needs at least one edge; got none"),
    ],
)
def test_a_design_that_is_refused(verify: Verify, tmp_path: Path, text: str, message: str) -> None:
    run = verify("region", write(tmp_path, text))
    assert (run.returncode, run.stdout) == (2, "")
    assert message in run.stderr
    assert run.stderr.count("\n") == 1


def test_the_lmi_confirms_and_changes_nothing(verify: Verify, tmp_path: Path) -> None:
    direct, lmi = tmp_path / "direct.json", tmp_path / "lmi.json"
    without = verify("region", PAPER, "--json", "-o", direct)
    confirmed = verify("region", PAPER, "--json", "-o", lmi, "--solver", "lmi")
    assert (confirmed.returncode, confirmed.stdout) == (without.returncode, without.stdout)
    assert confirmed.stderr == "the LMI agrees: least sigma, least mu, greatest mu\n"
    assert lmi.read_bytes() == direct.read_bytes()
