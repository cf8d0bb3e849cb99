"""import-linter keeps the house: green on the tree, red on each kind of arrow that must not be."""

from pathlib import Path

import pytest

CONTRACTS = {
    "house": "The house: a room imports only from rooms below it",
    "checker-apart": "The checker is imported by the outermost rooms only",
    "checker-standard-library": "The checker needs the standard library only",
    "flint": "python-flint is known in exact and enclosure only",
    "mpmath": "mpmath is known in enclosure only",
    "click": "click is known in cli only",
    "pytest": "pytest is known in pytest_plugin only",
    "jinja2": "jinja2 is known in report only",
    "solvers": "cvxpy and clarabel are known in region only",
}


def test_green_on_the_tree(copy: Path, gate) -> None:
    run = gate(copy, "lint-imports", "--no-cache")
    assert run.returncode == 0, run.stdout
    assert all(f"{name} KEPT" in run.stdout for name in CONTRACTS.values())


@pytest.mark.parametrize(
    ("room", "line", "broken"),
    [
        ("exact", "import fomas_verify.enclosure", "house"),
        ("enclosure", "import fomas_verify.kernel", "house"),
        ("kernel", "import fomas_verify.network", "house"),
        ("network", "import fomas_verify.design", "house"),
        ("design", "import fomas_verify.spectrum", "house"),
        ("spectrum", "import fomas_verify.claims", "house"),
        ("claims", "import fomas_verify.certificate", "house"),
        ("certificate", "import fomas_verify.prover", "house"),
        ("prover", "import fomas_verify.report", "house"),
        ("report", "import fomas_verify.cli", "house"),
        ("gate", "import fomas_verify.report", "house"),
        ("sweep", "import fomas_verify.gate", "house"),
        ("gate", "def late():\n    import fomas_verify.cli", "house"),
        ("cli", "import fomas_verify._entry", "house"),
        ("checker", "import fomas_verify.exact", "house"),
        ("checker", "def late():\n    import fomas_verify.certificate", "house"),
        ("prover", "import fomas_verify.checker", "checker-apart"),
        ("certificate", "def late():\n    from fomas_verify.checker import check", "checker-apart"),
        ("checker", "import flint", "checker-standard-library"),
        ("checker", "import mpmath", "checker-standard-library"),
        ("claims", "import flint", "flint"),
        ("kernel", "import mpmath", "mpmath"),
        ("prover", "import click", "click"),
        ("gate", "import pytest", "pytest"),
        ("cli", "import jinja2", "jinja2"),
        ("spectrum", "import cvxpy", "solvers"),
        ("report", "def late():\n    import clarabel", "solvers"),
    ],
)
def test_red_on_a_forbidden_arrow(copy: Path, gate, room: str, line: str, broken: str) -> None:
    (copy / "fomas_verify" / room / "intruder.py").write_text(line + "\n")
    run = gate(copy, "lint-imports", "--no-cache")
    assert run.returncode == 1, run.stdout
    assert f"{CONTRACTS[broken]} BROKEN" in run.stdout
    assert f"fomas_verify.{room}.intruder" in run.stdout


def test_red_on_a_room_that_no_layer_names(copy: Path, gate) -> None:
    (copy / "fomas_verify" / "attic.py").write_text("")
    run = gate(copy, "lint-imports", "--no-cache")
    assert run.returncode == 1, run.stdout
    assert f"{CONTRACTS['house']} BROKEN" in run.stdout
    assert "fomas_verify.attic" in run.stdout
