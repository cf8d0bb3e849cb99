"""``--baseline``: a margin that shrank fails, however true the claims still are."""

import json
from fractions import Fraction
from pathlib import Path

import pytest

from fomas_verify.cli import main
from fomas_verify.gate import baseline as baseline_margins
from fomas_verify.gate.baseline import margins_of

PAPER = """name = "{name}"
alpha = 0.9
gamma = {gamma}
h = 0.85
[graph]
adjacency = [[0,0,0,1,1], [1,0,1,0,0], [1,1,0,0,0], [0,1,1,0,0], [0,0,0,1,0]]
[gate]
require = {require}
"""


@pytest.fixture(scope="module")
def baseline(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The certificate of the paper's design, as `gate -o` writes it."""
    folder = tmp_path_factory.mktemp("baseline")
    (folder / "plant.toml").write_text(design())
    assert main(["gate", str(folder / "plant.toml"), "-o", str(folder / "certificates")]) == 0
    return folder / "certificates"


def design(gamma: str = "0.15", name: str = "the plant/1", require: tuple[str, ...] = ("memory-inequality",)) -> str:
    return PAPER.format(gamma=gamma, name=name, require=json.dumps(require))


def gate(folder: Path, text: str, baseline: Path, *options: str) -> int:
    (folder / "x.design.toml").write_text(text)
    return main(["gate", str(folder), "--baseline", str(baseline), *options])


def test_the_margins_of_the_paper(baseline: Path) -> None:
    """(14) asks for mu >= (2 - 2^0.9)/lambda2 = 0.133934016926385..., gain-bound for mu < 1/2, stability for 2/3."""
    (file,) = baseline.iterdir()
    assert file.name == "the plant%2F1.json"
    certificate = json.loads(file.read_text())
    mu, least = Fraction("0.134740746183943825882"), Fraction("0.133934016926385168037")
    margins = {
        claim: margins_of(certificate, claim)["mu"] for claim in certificate["values"]["margins"] if claim[0] in "gmp"
    }
    assert abs(margins["memory-inequality"] - (1 - least / mu)) < Fraction(1, 10**9)
    assert margins["gain-bound"] == margins["perron-eigenvalues"] == 1
    assert margins_of(certificate, "graph-assumption") == {}
    assert margins_of(certificate, "control-norm-bound") == {}


@pytest.mark.parametrize(
    ("gamma", "options", "status"),
    [
        ("0.15", ("--loss", "0"), 0),
        ("0.1501", ("--loss", "0"), 0),
        ("0.1499", (), 1),  # 11 per cent of the margin of 0.6 per cent
        ("0.14995", (), 0),
        ("0.1495", (), 1),
        ("0.1495", ("--loss", "3/5"), 0),
        ("0.1495", ("--loss", "50%"), 1),
        ("0.1492", ("--loss", "1"), 0),
        ("0.149", ("--loss", "1"), 1),  # refuted
    ],
)
def test_a_shrunk_margin(
    baseline: Path,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    gamma: str,
    options: tuple[str, ...],
    status: int,
) -> None:
    assert gate(tmp_path, design(gamma), baseline, *options) == status
    out = capsys.readouterr().out
    assert ("the margin of memory-inequality in mu shrank: 0.00" in out) == (status == 1 and gamma != "0.149")


def test_only_required_claims_are_compared(baseline: Path, tmp_path: Path) -> None:
    assert gate(tmp_path, design("0.1495", require=("gain-bound", "average-consensus")), baseline) == 0
    assert gate(tmp_path, design("0.4", require=("gain-bound",)), baseline) == 1
    assert gate(tmp_path, design("0.72", require=("average-consensus",)), baseline) == 1
    assert gate(tmp_path, design("0.3", require=("average-consensus",)), baseline) == 0


def test_a_design_without_a_baseline_fails_unless_it_may_be_new(
    baseline: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A design that is renamed as its margin shrinks does not get past; what is left of it is named."""
    assert gate(tmp_path, design("0.1495", name="another"), baseline) == 2
    lines = capsys.readouterr().out.splitlines()
    assert "x.design.toml: no certificate of 'another' in the baseline: a new design needs --new-ok" in lines[0]
    assert lines[1:] == ["1 design: 1 error", "baseline of no design here: the plant%2F1.json"]
    assert gate(tmp_path, design("0.1495", name="another"), baseline, "--new-ok") == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0].endswith("proved and checked (new: no baseline)")
    assert lines[2:] == ["new: no baseline: another", "baseline of no design here: the plant%2F1.json"]
    assert gate(tmp_path, design(), baseline, "--new-ok") == 0
    assert len(capsys.readouterr().out.splitlines()) == 2
    assert gate(tmp_path, design("0.1495"), baseline, "--new-ok") == 1


def test_a_missing_baseline_in_the_reports(baseline: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = tmp_path / "out"
    out.mkdir()
    (tmp_path / "in").mkdir()
    options = ("--json", "--sarif", str(out / "s"), "--markdown", str(out / "m"), "--junit", str(out / "j"))
    assert gate(tmp_path / "in", design(name="another"), baseline, *options) == 2
    document = json.loads(capsys.readouterr().out)
    assert document["unmatched_baselines"] == ["the plant%2F1.json"]
    (finding,) = document["designs"][0]["findings"]
    assert (finding["rule"], finding["status"], finding["line"]) == ("baseline-missing", 2, 1)
    (result,) = json.loads((out / "s").read_text())["runs"][0]["results"]
    assert result["ruleId"] == "baseline-missing"
    assert "baseline of no design here" in (out / "m").read_text()
    assert 'name="baseline-missing"' in (out / "j").read_text()


def test_a_margin_that_is_no_longer_found_is_undecided() -> None:
    """Where the baseline has one; a margin in alpha may be without end."""
    former = {"mu": Fraction(1, 2), "alpha": Fraction(1, 3)}
    (finding,) = baseline_margins._compared("gain-bound", former, {}, Fraction(1, 10))
    assert (finding.status, "was not found" in finding.reason) == (3, True)
    assert list(baseline_margins._compared("gain-bound", {"mu": Fraction(-1)}, {}, Fraction(0))) == []


def test_a_baseline_without_the_value_mu_is_compared_in_alpha(baseline: Path, tmp_path: Path) -> None:
    (file,) = baseline.iterdir()
    certificate = json.loads(file.read_text())
    del certificate["values"]["mu"]
    assert margins_of(certificate, "memory-inequality").keys() == {"alpha"}
    (tmp_path / file.name).write_text(json.dumps(certificate))
    (tmp_path / "designs").mkdir()
    assert gate(tmp_path / "designs", design(), tmp_path) == 0
    assert gate(tmp_path / "designs", design("0.1492"), tmp_path) == 1


def test_new_ok_is_about_a_baseline(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "x.design.toml").write_text(design())
    assert main(["gate", str(tmp_path), "--new-ok"]) == 2
    assert "give --baseline" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("damage", "reason"),
    [
        (lambda text: "{", "expected a certificate, got: $: not JSON"),
        (
            lambda text: text.replace('"verdict": "refuted"', '"verdict": "proved"'),
            "expected a certificate, got: $.",
        ),
        (
            lambda text: text.replace('"lower": "1"', '"lower": "1/2"', 1).replace('"upper": "2"', '"upper": "1"'),
            "refuses it",
        ),
    ],
)
def test_a_false_baseline_is_wrong_input(
    baseline: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], damage, reason: str
) -> None:
    (file,) = baseline.iterdir()
    false = tmp_path / "false"
    false.mkdir()
    (false / file.name).write_text(damage(file.read_text()))
    (tmp_path / "in").mkdir()
    assert gate(tmp_path / "in", design(), false) == 2
    assert reason in capsys.readouterr().out


def test_a_baseline_that_is_no_folder(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for folder in (tmp_path / "missing", tmp_path / "x.design.toml"):
        assert gate(tmp_path, design(), folder) == 2
        assert capsys.readouterr().out == ""
    (tmp_path / "b").mkdir()
    (tmp_path / "b" / "the plant%2F1.json").mkdir()
    assert gate(tmp_path, design(), tmp_path / "b") == 2


def test_a_failing_run_does_not_become_the_baseline(baseline: Path, tmp_path: Path) -> None:
    former = {path: path.read_bytes() for path in baseline.iterdir()}
    assert gate(tmp_path, design("0.3"), baseline, "-o", str(baseline)) == 2
    assert gate(tmp_path, design("0.3"), baseline, "-o", f"{baseline}/../{baseline.name}") == 2
    assert {path: path.read_bytes() for path in baseline.iterdir()} == former


def test_an_interval_does_not_slip_past_the_baseline(
    baseline: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = design("0.2").replace("alpha = 0.9", "alpha = [0.895, 0.905]")
    assert gate(tmp_path, text, baseline) == 1
    assert "margins cannot be compared with the baseline's: the design has an interval" in capsys.readouterr().out
