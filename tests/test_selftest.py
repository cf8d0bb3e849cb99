"""`verify-design selftest`: green as it is, red when a primitive is wrong."""

from fractions import Fraction

import pytest
from click.testing import CliRunner
from flint import arb

from fomas_verify.cli import main
from fomas_verify.enclosure.interval import Interval
from fomas_verify.prover import selftest


def test_every_known_answer_is_right(capsys: pytest.CaptureFixture[str]) -> None:
    """Exit status 0 and one line for each primitive."""
    assert main(["selftest"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) == len(selftest.PRIMITIVES) + 3
    assert all(line.startswith("ok ") for line in lines[:-1])


@pytest.mark.parametrize(
    ("name", "wrong"),
    [
        ("power", lambda base, exponent, bits: Interval.exactly(Fraction(float(base) ** float(exponent)))),
        ("gamma_function", lambda x, bits: Interval(Fraction(0), Fraction(10**6)) + x),
        ("square_root", lambda x, bits: Interval.exactly(Fraction(float(x.mid) ** 0.5))),
        ("log2", lambda x, bits: Interval.exactly(0)),
        ("to_ball", lambda x: arb(0)),
        ("inverse_series", lambda coefficients, bits: [Interval.exactly(0)] * len(coefficients)),
        ("integer_characteristic_polynomial", lambda a: (selftest.polynomial([0, 1]), 1)),
        ("decimal", lambda x, digits: "0.66667"),
    ],
)
def test_a_wrong_primitive_is_seen(
    name: str, wrong: object, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """A primitive that answers in floats, too widely or wrongly ends in exit status 4."""
    monkeypatch.setattr(selftest, name, wrong)
    assert main(["selftest"]) == 4
    assert "WRONG" in capsys.readouterr().out


def test_help_has_an_example() -> None:
    """`--help` shows how it is called."""
    from fomas_verify.cli.selftest import command

    assert "verify-design selftest" in CliRunner().invoke(command, ["--help"]).output
