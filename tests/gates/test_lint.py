"""ruff and mypy: green on the tree, red on one small offence of each kind that the project relies on."""

from pathlib import Path

import pytest

SOUND = '"""A module."""\n\n\ndef double(x: int) -> int:\n    """Return 2 x."""\n    return 2 * x\n'


@pytest.mark.parametrize("arguments", [["check", "--no-cache", "."], ["format", "--check", "--no-cache", "."]])
def test_ruff_is_green_on_the_tree(checkout: Path, gate, arguments: list[str]) -> None:
    run = gate(checkout, "ruff", *arguments)
    assert run.returncode == 0, run.stdout


def test_mypy_is_green_on_the_tree(checkout: Path, gate) -> None:
    run = gate(checkout, "mypy")
    assert run.returncode == 0, run.stdout


@pytest.mark.parametrize("arguments", [["check"], ["format", "--check"]])
def test_ruff_is_green_on_sound_code(copy: Path, gate, arguments: list[str]) -> None:
    intruder = copy / "fomas_verify" / "exact" / "intruder.py"
    intruder.write_text(SOUND)
    assert gate(copy, "ruff", *arguments, "--no-cache", str(intruder)).returncode == 0


@pytest.mark.parametrize(
    ("code", "offence"),
    [
        ("S101", "    assert x > 0\n"),
        ("T201", "    print(x)\n"),
        ("F401", "    import math\n"),
        ("F821", "    x = missing\n"),
        ("B006", "\n\ndef other(x: list = []) -> int:\n    return len(x)\n"),
        ("D103", "\n\ndef other(x: int) -> int:\n    return x\n"),
        ("S307", "    x = eval('1')\n"),
        ("FIX002", "    # TO" + "DO: later\n"),
        ("ERA001", "    # x = 3\n"),
        ("E501", f"    x = {'1' * 130}\n"),
        ("PGH003", "    x = 1  # type: ig" + "nore\n"),
    ],
)
def test_ruff_goes_red(copy: Path, gate, code: str, offence: str) -> None:
    intruder = copy / "fomas_verify" / "exact" / "intruder.py"
    intruder.write_text(SOUND + offence)
    run = gate(copy, "ruff", "check", "--no-cache", str(intruder))
    assert run.returncode == 1
    assert code in run.stdout


def test_ruff_format_goes_red(copy: Path, gate) -> None:
    intruder = copy / "fomas_verify" / "exact" / "intruder.py"
    intruder.write_text(SOUND.replace("2 * x", "2*x"))
    run = gate(copy, "ruff", "format", "--check", "--no-cache", str(intruder))
    assert run.returncode == 1


@pytest.mark.parametrize(
    ("code", "source"),
    [
        ("no-untyped-def", "def double(x):\n    return 2 * x\n"),
        ("type-arg", "def first(x: list) -> int:\n    return len(x)\n"),
        ("no-any-return", "from typing import Any\n\n\ndef first(x: Any) -> int:\n    return x\n"),
        ("return-value", "def double(x: int) -> int:\n    return str(x)\n"),
        ("ignore-without-code", "def double(x: int) -> int:\n    return str(x)  # type: ig" + "nore\n"),
        ("unreachable", "def double(x: int) -> int:\n    return x\n    return 2 * x\n"),
    ],
)
def test_mypy_goes_red(tmp_path: Path, checkout: Path, gate, code: str, source: str) -> None:
    intruder = tmp_path / "intruder.py"
    configuration = ["--config-file", str(checkout / "pyproject.toml"), "--cache-dir", str(tmp_path / "cache")]
    intruder.write_text(SOUND)
    assert gate(tmp_path, "mypy", *configuration, str(intruder)).returncode == 0
    intruder.write_text(source)
    run = gate(tmp_path, "mypy", *configuration, str(intruder))
    assert run.returncode == 1
    assert f"[{code}]" in run.stdout
