"""Wrong calls and inputs: status 2, one line on standard error, nothing on standard output, no file; 4 where two
computations disagree."""

from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from subprocess import CompletedProcess

import pytest

from fomas_verify.cli import main

Verify = Callable[..., CompletedProcess[str]]
PAPER = "examples/paper.toml"


@pytest.mark.parametrize(
    "arguments",
    [
        ["prove"],
        ["prove", "no-such-file.toml"],
        ["prove", "examples"],
        ["prove", PAPER, "extra"],
        ["prove", PAPER, "--no-such-option"],
        ["prove", PAPER, "--digits", "19"],
        ["prove", PAPER, "--digits", "5001"],
        ["prove", PAPER, "--digits", "1e3"],
        ["prove", PAPER, "--digits"],
        ["prove", PAPER, "--horizon", "-1"],
        ["prove", PAPER, "--horizon", "1.5"],
        ["prove", PAPER, "--horizon", "99999999999999999999"],
        ["kernel"],
        ["kernel", PAPER, "--terms", "0"],
        ["kernel", PAPER, "--terms", "20001"],
        ["kernel", PAPER, "--at", ""],
        ["kernel", PAPER, "--at", "0"],
        ["kernel", PAPER, "--at", "1,,2"],
        ["kernel", PAPER, "--at", "-3"],
        ["kernel", PAPER, "--at", "1.5"],
        ["kernel", PAPER, "--at", "٣"],
        ["kernel", PAPER, "--at", "1" * 41],
        ["kernel", PAPER, "--at", "1" + "0" * 31],
        ["kernel", "no-such-file.toml"],
        ["no-such-command"],
        ["--no-such-option"],
    ],
)
def test_one_line_and_status_2(verify: Verify, arguments: list[str]) -> None:
    run = verify(*arguments)
    assert run.returncode == 2
    assert run.stdout == ""
    assert run.stderr.startswith("verify-design: ")
    assert run.stderr.count("\n") == 1
    assert len(run.stderr) < 300


@pytest.mark.parametrize("command", ["prove", "kernel"])
def test_a_bad_call_writes_no_file(verify: Verify, tmp_path: Path, command: str) -> None:
    option = {"prove": "-o", "kernel": "--csv"}[command]
    bad = tmp_path / "bad.toml"
    bad.write_text("alpha = 2\n")
    run = verify(command, bad, option, tmp_path / "out")
    assert run.returncode == 2
    assert [path.name for path in tmp_path.iterdir()] == ["bad.toml"]


@pytest.mark.parametrize(("command", "option"), [("prove", "-o"), ("kernel", "--csv")])
def test_an_output_that_cannot_be_written(verify: Verify, tmp_path: Path, command: str, option: str) -> None:
    file = tmp_path / "file"
    file.write_text("x")
    for target in (tmp_path, file / "below", tmp_path / "no" / "folder" / "out.json"):
        run = verify(command, PAPER, option, target)
        assert run.returncode == 2
        assert run.stdout == ""
        assert run.stderr.count("\n") == 1
        assert str(target) in run.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["file"]
    assert file.read_text() == "x"


def test_a_call_without_a_command_shows_help_and_is_status_2(verify: Verify) -> None:
    run = verify()
    assert run.returncode == 2
    assert run.stdout == ""
    assert "Usage: verify-design" in run.stderr


@pytest.mark.parametrize("command", [[], ["prove"], ["kernel"]])
def test_help_shows_an_example(verify: Verify, command: list[str]) -> None:
    run = verify(*command, "--help")
    assert (run.returncode, run.stderr) == (0, "")
    assert "Example:  verify-design" in run.stdout


def test_disagreement_is_status_4(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], checkout: Path
) -> None:
    module = __import__("fomas_verify.prover.prove", fromlist=["prove"])
    monkeypatch.setattr(module, "approx_gain_and_threshold", lambda *a: {"threshold": Fraction(1, 2)})
    assert main(["prove", str(checkout / PAPER)]) == 4
    out, err = capsys.readouterr()
    assert (out, err) == ("", "verify-design: threshold: the enclosure and mpmath disagree at 50 digits\n")


def test_disagreement_in_the_kernel_is_status_4(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], checkout: Path, tmp_path: Path
) -> None:
    module = __import__("fomas_verify.kernel.table", fromlist=["kernel_rows"])
    monkeypatch.setattr(module, "approx_memory", lambda *a: (Fraction(-1, 2), Fraction(1, 2)))
    assert main(["kernel", str(checkout / PAPER), "--csv", str(tmp_path / "k.csv")]) == 4
    assert capsys.readouterr().out == ""
    assert not list(tmp_path.iterdir())
