"""`prove`, `region`, `synthesize`, `simulate` and `check` give what the commands give."""

import json
import logging
import subprocess
import sys
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from fomas_verify.api import Design, FomasError, Verdict, check, prove, region, simulate, simulations, synthesize
from fomas_verify.checker import check as checker

PAPER = "examples/paper.toml"


def run(checkout: Path, *arguments: object) -> "subprocess.CompletedProcess[str]":
    call = [sys.executable, "-m", "fomas_verify", *map(str, arguments)]
    return subprocess.run(call, cwd=checkout, capture_output=True, text=True, check=False)


@pytest.mark.slow
@pytest.mark.parametrize("example", ["paper", "unbalanced", "switching"])
def test_prove_as_the_command_does(checkout: Path, example: str, tmp_path: Path) -> None:
    path = checkout / "examples" / f"{example}.toml"
    proof, done = prove(path), run(checkout, "prove", path, "--json")
    assert proof.certificate == done.stdout
    assert proof.exit_status == done.returncode
    assert str(proof) + "\n" == run(checkout, "prove", path).stdout
    proof.save(tmp_path / "c.json")
    assert (tmp_path / "c.json").read_text() == done.stdout


def test_the_verdicts_and_values_of_the_paper(checkout: Path) -> None:
    """The numbers of theory, section 3."""
    proof = prove(checkout / PAPER)
    assert proof.verdicts["average-consensus"] is Verdict.PROVED
    assert proof.verdicts["beta-contraction"] == "refuted"
    assert "0.881292727478182555" in proof.decisions["beta-contraction"].reason
    lower, upper = proof.values["mu"]
    assert lower <= Fraction("0.134740746183943825883")
    assert upper >= Fraction("0.134740746183943825882")
    assert upper - lower < Fraction(1, 10**30)
    assert repr(proof) == "<Proof of 'paper': 6 of 6 required claims proved>"


def test_an_uncertain_design() -> None:
    proof = prove(Design(alpha=("1/2", "3/5"), mu="1/4", graph="complete", agents=2))
    assert checker(proof.certificate.encode()).exit_status == 0
    assert proof.values["mu"] == (Fraction(1, 4), Fraction(1, 4))
    with pytest.raises(FomasError, match="horizon is not supported yet with an interval"):
        prove(proof.design, horizon=3)
    with pytest.raises(FomasError, match="alpha: expected a number, got an interval"):
        region(proof.design)


def test_nothing_has_a_truth_value() -> None:
    proof = prove(Design(alpha="9/10", mu="1/4", graph="complete", agents=2))
    for result in (proof, check(proof), proof.verdicts["gain-bound"]):
        with pytest.raises(TypeError, match=r"a (result|verdict) has"):
            bool(result)


@pytest.mark.slow
@pytest.mark.parametrize("example", ["paper", "limits", "switching"])
def test_region_as_the_command_does(checkout: Path, example: str) -> None:
    path = checkout / "examples" / f"{example}.toml"
    found = region(path)
    assert json.loads(json.dumps(found.record, default=str)) == json.loads(
        run(checkout, "region", path, "--json").stdout
    )
    assert str(found) + "\n" == run(checkout, "region", path).stdout
    assert check(found).exit_status == 0


def test_a_strip_that_is_empty() -> None:
    found = region(Design(alpha="1/10", graph="cycle", agents=7))
    assert (found.strips["repaired"].inner, found.strips["repaired"].outer) == (None, None)
    assert found.strips["gain-bound"].outer == (0, Fraction(1, 2))


@pytest.mark.slow
def test_synthesize_as_the_command_does(checkout: Path, tmp_path: Path) -> None:
    path = checkout / "examples" / "limits.toml"
    found = synthesize(path, "gentlest")
    call = ("synthesize", path, "--objective", "gentlest", "--direct")
    done = run(checkout, *call, "-o", tmp_path / "cli.toml")
    assert str(found) + "\n" == done.stdout
    found.save(tmp_path / "api.toml")
    for ending in (".toml", ".json"):
        assert (tmp_path / f"api{ending}").read_bytes() == (tmp_path / f"cli{ending}").read_bytes()
    assert (found.design.gamma, found.design.h) == (found.gamma, found.h)
    assert found.proof.exit_status == 0
    assert check(found, design=Design.read(tmp_path / "api.toml")).exit_status == 0


def test_no_design_exists(tmp_path: Path) -> None:
    """The strip needs gamma h^alpha of a size that these limits exclude."""
    found = synthesize(Design(alpha="9/10", graph="path", agents=2, limits={"h": [0, 1], "gamma": [0, "1/1000"]}))
    assert (found.exit_status, found.design, found.proof, found.gamma) == (1, None, None, None)
    assert found.clash
    assert check(found).exit_status == 0
    with pytest.raises(FomasError, match=r"no\.toml: no design exists that could be written"):
        found.save(tmp_path / "no.toml")
    assert "satisfy condition and limits" in found._repr_html_()


@pytest.mark.slow
def test_simulate_as_the_command_does(checkout: Path, tmp_path: Path) -> None:
    run(checkout, "simulate", PAPER, "--samples", 20, "--controller", "proposed", "--csv", tmp_path / "a.csv")
    rows = [line.split(",") for line in (tmp_path / "a.csv").read_text().splitlines()[1:]]
    found = simulate(checkout / PAPER, 20)
    assert np.array([row[3:8] for row in rows], dtype=float).tolist() == found.x.tolist()
    assert np.array([row[8:] for row in rows], dtype=float).tolist() == found.u.tolist()
    assert np.array([row[1] for row in rows], dtype=float).tolist() == found.t.tolist()


def test_the_shapes_of_a_simulation() -> None:
    given: dict[str, Any] = {"alpha": "9/10", "mu": "1/4", "h": 1, "graph": "complete", "agents": 2}
    flat = simulate(Design(**given, x0=[0, 1]), 5, between=3)
    assert (flat.t.shape, flat.x.shape, flat.u.shape, flat.between.shape) == ((6,), (6, 2), (6, 2), (5, 3, 2))
    deep = simulate(Design(**given, x0=[[0, 1, 2], [3, 4, 5]]), 5, between=1, controller="truncated", memory=2)
    assert (deep.x.shape, deep.u.shape, deep.between.shape) == ((6, 2, 3), (6, 2, 3), (5, 1, 2, 3))
    assert deep.x[0].tolist() == [[0, 1, 2], [3, 4, 5]]


@pytest.mark.parametrize(
    ("call", "reason"),
    [
        ({"controller": "own"}, "controller: expected one of proposed, memoryless, truncated, got 'own'"),
        ({"controller": "truncated"}, "memory: expected with the controller truncated"),
        ({"memory": 3}, "memory: expected with the controller truncated"),
        ({"samples": 0}, "samples: expected an integer >= 1, got 0"),
        ({"samples": 1.5}, "samples: expected an integer >= 1, got 1.5"),
        ({"between": -1}, "between: expected an integer >= 0 and <= 10000, got -1"),
        ({"alpha_controller": 1.5}, "alpha_controller: expected a number between 0 and 1, got 1.5"),
        ({"samples": 10**15}, "of memory"),
    ],
)
def test_a_simulation_that_is_refused(checkout: Path, call: dict[str, Any], reason: str) -> None:
    with pytest.raises(FomasError) as caught:
        simulate(checkout / PAPER, **call)
    assert reason in str(caught.value)
    assert str(caught.value).isprintable()


def test_check_takes_a_path_a_text_bytes_and_a_proof(tmp_path: Path) -> None:
    design = Design(alpha="9/10", mu="1/4", graph="complete", agents=2)
    proof = prove(design)
    proof.save(tmp_path / "c.json")
    for certificate in (
        proof,
        proof.certificate,
        proof.certificate.encode(),
        tmp_path / "c.json",
        str(tmp_path / "c.json"),
    ):
        found = check(certificate, design=design, require=["design", "repaired-condition"])
        assert (found.exit_status, found.differences) == (0, [])
        assert found.verdicts["gain-bound"] == "proved"


def test_check_refuses_what_is_false_and_what_is_another_design() -> None:
    design = Design(alpha="9/10", mu="1/4", graph="complete", agents=2)
    document = json.loads(prove(design).certificate)
    claim = next(x for x in document["claims"] if x["id"] == "gain-bound")
    claim["verdict"] = "refuted"
    found = check(json.dumps(document))
    assert (found.exit_status, [x.id for x in found.outcomes if x.status == "refused"]) == (1, ["gain-bound"])
    other = check(prove(design), design=Design(alpha="9/10", mu="1/5", graph="complete", agents=2))
    assert (other.exit_status, other.differences) == (1, ["mu"])
    missing = check(prove(design), require="trajectory-norm-bound")
    assert missing.exit_status == 1


@pytest.mark.parametrize(
    ("certificate", "reason"),
    [
        ("{", "certificate: "),
        (b"\xff", "certificate: "),
        ("none.json", "none.json: expected a certificate, got No such file or directory"),
        (7, "certificate: expected a text, a path or a result, got a int"),
    ],
)
def test_what_is_no_certificate(certificate: Any, reason: str) -> None:
    with pytest.raises(FomasError) as caught:
        check(certificate)
    assert str(caught.value).startswith(reason)


def test_an_unknown_objective_and_an_unknown_claim(checkout: Path) -> None:
    with pytest.raises(
        FomasError, match=r"^synthesize: objective: expected one of fastest, .*, most-robust, got 'best'$"
    ):
        synthesize(checkout / PAPER, "best")
    with pytest.raises(FomasError, match=r"^synthesize: condition: expected one of "):
        synthesize(checkout / PAPER, condition="best")
    with pytest.raises(FomasError, match=r"^check: require: expected claim ids or 'design', got 'gain'$"):
        check("{}", require=["gain"])


def test_what_it_does_is_logged(caplog: pytest.LogCaptureFixture) -> None:
    with caplog.at_level(logging.INFO, logger="fomas_verify"):
        prove(Design(name="pair", alpha=0.9, mu="1/4", graph="complete", agents=2))
    assert "pair: alpha: binary floats are read as their shortest decimals (0.1 is 1/10)" in caplog.messages
    assert "pair: gain-bound: proved" in caplog.messages


def test_it_is_silent_by_itself() -> None:
    script = (
        "from fomas_verify import Design, prove\n"
        "import logging; logging.getLogger('fomas_verify').warning('no handler but that of the package')\n"
        "prove(Design(alpha=0.9, mu='1/4', graph='complete', agents=2))"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert (done.stdout, done.stderr) == ("", "")


@pytest.mark.parametrize("terminal", [True, False])
def test_progress_is_shown_on_a_terminal_only(
    terminal: bool, capfd: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(simulations, "LONG", 0)
    for name in ("FORCE_COLOR", "NO_COLOR"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("TTY_COMPATIBLE", "1" if terminal else "0")
    simulate(Design(alpha="1/2", mu="1/4", h=1, graph="complete", agents=2, x0=[0, 1]), 5)
    out, err = capfd.readouterr()
    assert out == ""
    assert ("proposed" in err) == terminal
