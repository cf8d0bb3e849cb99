"""What the linters do not check: sizes, what the checker imports, traces of one machine or registry."""

import ast
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

MOST_LINES = 400
# Written in pieces, so that this file does not offend.
TRACES = re.compile(
    "|".join(
        [
            r"(?<![\w.])/" + r"(?:work|root|home|Users|opt)/\w",
            r"(?i:[A-Z]:\\" + r"Users\\)",
            "pypi" + r"\.org",
            "python" + r"hosted\.org",
            "deb" + r"\.debian\.org",
            "npmjs" + r"\.(?:org|com)",
            r"--(?:extra-)?index" + "-url",
            "--find" + "-links",
            r"^-f " + r"\S",
        ]
    ),
    re.MULTILINE,
)


def too_long(source: str) -> bool:
    return source.count("\n") > MOST_LINES


def traces(text: str) -> list[str]:
    return TRACES.findall(text)


def foreign_imports(source: str) -> list[str]:
    """Modules imported anywhere in a checker source that are neither the standard library's nor the checker's own."""
    names = []
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import):
            names += [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom) and not node.level:
            names.append(node.module or "")
        elif isinstance(node, ast.ImportFrom) and node.level > 1:
            names.append("." * node.level)
        elif isinstance(node, ast.Name | ast.Attribute):
            names += [word for word in ("__import__", "import_module") if word in ast.unparse(node).split(".")]
    own = "fomas_verify.checker"
    return [
        name
        for name in names
        if name.split(".")[0] not in sys.stdlib_module_names and name != own and not name.startswith(own + ".")
    ]


def tracked(checkout: Path) -> Iterator[tuple[Path, str]]:
    """Every text file that is, or is about to be, under version control."""
    if not (checkout / ".git").exists():
        pytest.skip("not a git checkout")
    command = ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
    listing = subprocess.run(command, cwd=checkout, capture_output=True, text=True, check=True).stdout
    for name in filter(None, listing.split("\0")):
        path = checkout / name
        data = path.read_bytes() if path.is_file() else b"\0"
        if b"\0" not in data:
            yield path, data.decode("utf-8", errors="replace")


def test_no_traces_of_a_machine_or_a_registry(checkout: Path) -> None:
    found = {str(path.relative_to(checkout)): hits for path, text in tracked(checkout) if (hits := traces(text))}
    assert found == {}


@pytest.mark.parametrize(
    "line",
    [
        "#   -r /wo" + "rk/main/requirements.txt",
        "see /ho" + "me/me/notes",
        "C:\\" + "Users\\me",
        "--index" + "-url https://example.invalid/simple",
        "--find" + "-links wheels",
        "https://files.python" + "hosted.org/packages/x",
    ],
)
def test_traces_are_seen(line: str) -> None:
    assert traces(f"fine\n{line}\n")


@pytest.mark.parametrize(
    "line", ["reports/paper/", "tests/homework/one", "#!/usr/bin/env bash", "x = a /root", "/dev/full"]
)
def test_other_paths_are_left_alone(line: str) -> None:
    assert not traces(line)


def test_files_stay_short(checkout: Path) -> None:
    files = sorted((checkout / "fomas_verify").rglob("*.py"))
    assert len(files) > 10
    assert [str(path) for path in files if too_long(path.read_text("utf-8"))] == []
    assert too_long("x = 1\n" * (MOST_LINES + 1))


def test_checker_imports_the_standard_library_only(checkout: Path) -> None:
    files = sorted((checkout / "fomas_verify" / "checker").rglob("*.py"))
    assert files
    assert {path.name: names for path in files if (names := foreign_imports(path.read_text("utf-8")))} == {}


@pytest.mark.parametrize(
    ("source", "name"),
    [
        ("import numpy", "numpy"),
        ("def f():\n    import flint", "flint"),
        ("from fomas_verify import exact", "fomas_verify"),
        ("from fomas_verify.checkers import x", "fomas_verify.checkers"),
        ("from .. import exact", ".."),
        ("x = __import__('flint')", "__import__"),
        ("import importlib\nimportlib.import_module('flint')", "import_module"),
    ],
)
def test_foreign_imports_are_seen(source: str, name: str) -> None:
    assert foreign_imports(source) == [name]


@pytest.mark.parametrize("source", ["import json", "from . import form", "from fomas_verify.checker.form import read"])
def test_own_imports_are_left_alone(source: str) -> None:
    assert foreign_imports(source) == []
