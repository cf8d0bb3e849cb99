"""``verify-design synthesize``: the paper's graph, files, refusals, and certificates changed until false."""

import json
import tomllib
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from subprocess import CompletedProcess

import pytest

from fomas_verify.checker import Malformed, check
from fomas_verify.cli.app import main
from fomas_verify.design import read_design

pytestmark = pytest.mark.slow

Verify = Callable[..., CompletedProcess[str]]

GRAPH = """[graph]
adjacency = [[0,0,0,1,1], [1,0,1,0,0], [1,1,0,0,0], [0,1,1,0,0], [0,0,0,1,0]]
"""
START = "x0 = [4.5, 5, 6, 1.5, -1]\nsettle_to = 0.01\n"
# theory, section 5: at h = 0.85 the repaired condition asks for this gamma at least
LEAST_GAMMA = Fraction("0.174538096247815173")


def design(folder: Path, limits: str, alpha: str = "0.9") -> Path:
    path = folder / "plant.toml"
    path.write_text(f"alpha = {alpha}\n{START}{GRAPH}[limits]\n{limits}\n")
    return path


@pytest.fixture(scope="module")
def gentlest(tmp_path_factory: pytest.TempPathFactory, checkout: Path) -> Path:
    """The folder with what is gentlest at h = 0.85: design, certificate, and what was printed."""
    import subprocess
    import sys

    folder = tmp_path_factory.mktemp("gentlest")
    path = design(folder, "h = [0.85, 0.85]")
    command = ["synthesize", path, "--objective", "gentlest", "-o", folder / "best.toml"]
    done = subprocess.run(
        [sys.executable, "-m", "fomas_verify", *map(str, command)],
        cwd=checkout, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert (done.returncode, done.stderr) == (0, "")
    (folder / "printed").write_text(done.stdout)
    return folder


def test_the_least_gamma_at_the_papers_h(gentlest: Path) -> None:
    found = tomllib.loads((gentlest / "best.toml").read_text())
    gamma, h = Fraction(str(found["gamma"])), Fraction(str(found["h"]))
    assert (h, gamma >= LEAST_GAMMA) == (Fraction("0.85"), True)
    assert gamma < LEAST_GAMMA * Fraction("1.001")
    printed = (gentlest / "printed").read_text()
    assert "gamma = 0.1746, h = 0.85" in printed
    assert "the geometric program (cvxpy, clarabel) agrees" in printed
    assert "All 6 required claims are proved" in printed
    best = next(x for x in json.loads((gentlest / "best.json").read_text())["task"]["claims"] if x["id"] == "best")
    bound = Fraction(best["witness"]["bound"])
    assert LEAST_GAMMA * (1 - Fraction(1, 10**8)) < bound < LEAST_GAMMA


def test_the_certificate_is_accepted_and_is_about_the_new_design(verify: Verify, gentlest: Path) -> None:
    done = verify("check", gentlest / "best.json", "--design", gentlest / "best.toml", "--require", "design")
    assert (done.returncode, done.stderr) == (0, "")
    assert "accepted   feasible proved" in done.stdout
    other = verify("check", gentlest / "best.json", "--design", gentlest / "plant.toml")
    assert other.returncode == 1
    assert "gamma, h differ" in other.stdout
    looser = (gentlest / "best.toml").read_text().replace("h = [0.85, 0.85]", "h = [0.85, 0.86]")
    (gentlest / "looser.toml").write_text(looser)
    assert "limits differ" in verify("check", gentlest / "best.json", "--design", gentlest / "looser.toml").stdout


def test_the_new_design_is_proved_again_by_prove(verify: Verify, gentlest: Path) -> None:
    done = verify("prove", gentlest / "best.toml")
    assert done.returncode == 0
    assert "repaired-condition     proved" in done.stdout
    assert read_design(gentlest / "best.toml").limits.h == (Fraction("0.85"), Fraction("0.85"))


def _at(document: dict, *keys: object) -> object:
    place = document
    for key in keys:
        place = place[key]
    return place


@pytest.mark.parametrize(
    "tamper",
    [
        lambda d: d["design"].update(gamma="1745/10000"),  # below the least
        lambda d: d["design"].update(h="17/21"),
        lambda d: d["task"]["limits"].update(h=["0", "1/2"]),
        lambda d: d["task"]["limits"].update(gamma=["0", "17/100"]),
        lambda d: d["task"]["limits"].update(u_max="1"),
        lambda d: d["task"].update(objective="slowest-sampling"),
        lambda d: d["task"]["claims"][1]["witness"].update(bound="1746/10000"),
        lambda d: d["task"]["claims"][1]["witness"].update(blocks=[]),
        lambda d: d["task"]["condition"]["witness"]["mu"]["outer"].__setitem__(0, "1567827/10000000"),
        lambda d: d["task"]["condition"]["witness"]["mu"]["inner"].__setitem__(0, "1567826/10000000"),
        lambda d: d["task"]["condition"].update(statement="some mu will do"),
        lambda d: d["values"]["mu"].update(lower="1/6"),
        lambda d: d["claims"][6].update(verdict="refuted", witness={"x0": ["1"] * 5, "k": 1}),
    ],
)
def test_a_certificate_that_was_changed_is_refused(gentlest: Path, tamper: Callable[[dict], None]) -> None:
    document = json.loads((gentlest / "best.json").read_text())
    tamper(document)
    try:
        assert check(json.dumps(document).encode()).exit_status == 1
    except Malformed:
        pytest.fail("a defect of form, which shows nothing of the tests")


def test_an_output_of_another_kind_is_refused(verify: Verify, tmp_path: Path) -> None:
    done = verify("synthesize", design(tmp_path, "h = [0.1, 2]"), "-o", tmp_path / "best.yaml")
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.endswith("best.yaml: expected a folder or a name that ends in .toml\n")
    assert done.stderr.count("\n") == 1
    assert not (tmp_path / "best.yaml").exists()


@pytest.mark.parametrize("alpha", ["0.8", "0.86"])
def test_no_design_where_no_mu_is_repaired(verify: Verify, tmp_path: Path, alpha: str) -> None:
    path = design(tmp_path, "h = [0.1, 2]", alpha)
    done = verify("synthesize", path, "-o", tmp_path / "none.toml")
    assert (done.returncode, done.stderr) == (1, "")
    assert "it opens at alpha = 0.863037818" in done.stdout
    assert not (tmp_path / "none.toml").exists()
    checked = verify("check", tmp_path / "none.json")
    assert checked.returncode == 0
    assert "accepted   feasible refuted" in checked.stdout


@pytest.mark.parametrize(
    ("limits", "words"),
    [
        # h needs (0.156782622 Gamma(1.9) norm(L x_0) / 3)^(10/9) = 0.58112 s, norm(L x_0) = 12.20656
        ("h = [0.1, 0.2]\nu_max = 3", "h <= 0.2 and u_max = 3 leave no gamma: h must reach at least 0.5811"),
        # 0.174538 at h = 0.85
        ("h = [0.1, 0.85]\ngamma = [0, 0.1]", "or gamma at least 0.1745"),
        ("h = [1, 2]\ngamma = [3, 4]", "h >= 1 and gamma >= 3 leave no gamma: h must fall to at most "),
        ("gamma = [1, 2]\nu_max = 3", "gamma >= 1 and u_max = 3 leave no gamma: u_max must reach at least 12.2"),
        (
            "h = [0.1, 2]\nu_max = 3\nsettle_within = 5",
            "settling to 0.01 with h <= 2 and u_max = 3 and h >= 0.1 takes 18.6",
        ),
    ],
)
def test_what_clashes_is_named(verify: Verify, tmp_path: Path, limits: str, words: str) -> None:
    done = verify("synthesize", design(tmp_path, limits), "-o", tmp_path / "none")
    assert (done.returncode, done.stderr) == (1, "")
    assert words in " ".join(done.stdout.split())
    assert verify("check", tmp_path / "none" / "plant-most-robust.certificate.json").returncode == 0


@pytest.mark.parametrize(
    ("limits", "options", "message"),
    [
        ("", ("--objective", "gentlest"), "limits: gentlest needs an upper limit of h, or a lower one of gamma"),
        ("", ("--objective", "fastest"), "limits: fastest needs a lower limit of h, or an upper one of gamma"),
        ("gamma = [0, 1]", ("--objective", "fastest", "--condition", "consensus"), "whose mu does not begin at 0"),
        ("", ("--condition", "gain-bound"), "limits: most-robust needs limits of h on both sides"),
        ("u_max = 3", ("--condition", "consensus"), "limits.u_max: expected a condition that bounds the peak"),
    ],
)  # fmt: skip
def test_what_is_not_to_be_answered(
    verify: Verify, tmp_path: Path, limits: str, options: tuple[str, ...], message: str
) -> None:
    done = verify("synthesize", design(tmp_path, limits), "--direct", *options)
    assert (done.returncode, done.stdout) == (2, "")
    assert message in done.stderr
    assert done.stderr.count("\n") == 1


@pytest.mark.parametrize(("limit", "key"), [("u_max = 3", "x0"), ("settle_within = 60", "settle_to")])
def test_a_limit_of_something_that_is_missing(verify: Verify, tmp_path: Path, limit: str, key: str) -> None:
    path = tmp_path / "plant.toml"
    path.write_text(f"alpha = 0.9\n{GRAPH}[limits]\n{limit}\n")
    done = verify("synthesize", path, "--direct")
    assert (done.returncode, done.stdout) == (2, "")
    assert f"{key}: limits.{limit.split()[0]} needs {key}; got no {key}" in done.stderr


def test_a_design_is_never_overwritten_but_the_same_answer_may_be_written_again(verify: Verify, tmp_path: Path) -> None:
    path, out = design(tmp_path, "h = [0.85, 0.85]"), tmp_path / "out"
    for _ in range(2):
        assert verify("synthesize", path, "--direct", "-o", out).returncode == 0
    before = path.read_bytes()
    done = verify("synthesize", path, "--direct", "-o", path)
    assert done.returncode == 2
    assert "found a design" in done.stderr
    assert path.read_bytes() == before
    assert list(tmp_path.rglob("*.tmp")) == []
    assert sorted(x.name for x in tmp_path.iterdir()) == ["out", "plant.toml"]


def test_the_gate_takes_what_was_written_for_one_design(verify: Verify, tmp_path: Path) -> None:
    """The certificate of NAME.design.toml has no name that the gate knows as a design's."""
    path = design(tmp_path, "h = [0.85, 0.85]")
    out = tmp_path / "designs"
    out.mkdir()
    assert verify("synthesize", path, "--direct", "-o", out / "best.design.toml").returncode == 0
    assert sorted(x.name for x in out.iterdir()) == ["best.certificate.json", "best.design.toml"]
    done = verify("gate", out)
    assert done.returncode == 0, done.stdout
    assert "\n1 design: 1 pass\n" in done.stdout


@pytest.mark.parametrize("condition", ["repaired-closed-form", "as-stated", "gain-bound", "consensus"])
@pytest.mark.parametrize("objective", ["fastest", "most-robust"])
def test_the_other_strips(tmp_path: Path, capsys: pytest.CaptureFixture[str], condition: str, objective: str) -> None:
    """What is said in JSON is what the certificate says, and the checker accepts it; no strip is taken for another."""
    path = design(tmp_path, "h = [0.5, 2]\ngamma = [0.01, 1]\nsettle_within = 90")
    path.write_text(path.read_text() + '[gate]\nrequire = ["average-consensus"]\n')
    call = ["synthesize", str(path), "--direct", "--json", "--objective", objective, "--condition", condition]
    assert main([*call, "-o", str(tmp_path / "found.toml")]) == 0
    said, document = json.loads(capsys.readouterr().out), json.loads((tmp_path / "found.json").read_text())
    task = document["task"]
    assert said["condition"] == condition == task["condition"]["id"]
    assert (said["found"]["gamma"], said["found"]["h"]) == (document["design"]["gamma"], document["design"]["h"])
    best = [claim["witness"]["bound"] for claim in task["claims"] if claim["id"] == "best"]
    assert best == ([] if said["bound"] is None else [said["bound"]])
    if best and objective == "fastest":
        assert Fraction(best[0]) < Fraction(said["found"]["h"]) * said["found"]["samples"]
    assert check(json.dumps(document).encode()).exit_status == 0


def test_what_is_proved_to_be_impossible_is_so_where_words_are_hard_to_find(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The least settling time is not found there within the work allowed; the proof does not need it."""
    path = tmp_path / "plant.toml"
    graph = '[graph]\nfamily = "star"\nagents = 4\n'
    path.write_text(f'alpha = 0.9\nsettle_to = "1e-300"\n{graph}[limits]\nh = [7, "1e300"]\nsettle_within = 7\n')
    assert main(["synthesize", str(path), "--condition", "consensus", "-o", str(tmp_path / "none.toml")]) == 1
    assert "settle_within = 7 with h <= 1e+300 and h >= 7 leaves no number of samples" in capsys.readouterr().out
    assert check((tmp_path / "none.json").read_bytes()).exit_status == 0


def test_no_design_is_written_that_a_file_cannot_hold(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """With h free and alpha = 0.01, the slowest h is about 10^100000."""
    monkeypatch.chdir(tmp_path)
    path = design(tmp_path, 'gamma = ["1e-1000", 1]', "0.01")
    call = ["synthesize", str(path), "--objective", "slowest-sampling", "--condition", "consensus", "-o", "best"]
    assert main(call) == 3
    assert "neither a design within the limits nor the proof" in capsys.readouterr().err
    assert [x.name for x in tmp_path.iterdir()] == ["plant.toml"]
