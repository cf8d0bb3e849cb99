"""The checker as a command: lines, exit statuses, and its independence of everything but the standard library."""

import ast
import json
import os
import re
import runpy
import subprocess
import sys
from pathlib import Path

import pytest

from fomas_verify.checker import STATEMENTS, command, text
from fomas_verify.checker.statements import CONDITIONS
from tests.checker.builder import PAPER_EDGES, Json, certificate, claim, design, paper
from tests.checker.cases import CASES

ROOT = Path(__file__).resolve().parents[2]
FOLDER = ROOT / "fomas_verify" / "checker"
WAYS = {
    "folder": [sys.executable, "-I", "-S", "-W", "error", str(FOLDER)],
    "optimised": [sys.executable, "-I", "-S", "-O", "-W", "error", str(FOLDER)],
    "module": [sys.executable, "-W", "error", "-m", "fomas_verify.checker"],
}


def written(folder: Path, document: Json) -> str:
    file = folder / "cert.json"
    file.write_text(json.dumps(document))
    return str(file)


def run(way: str, *arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run([*WAYS[way], *arguments], cwd=ROOT, capture_output=True, text=True, timeout=120, check=False)


@pytest.mark.parametrize("way", WAYS)
def test_every_way_to_start_it_says_the_same(way: str, tmp_path: Path) -> None:
    file = written(tmp_path, paper())
    found = run(way, file, "--require", "design")
    assert (found.returncode, found.stderr) == (0, "")
    assert found.stdout.splitlines() == [
        *(f"value {name}: accepted: lower <= {name} <= upper" for name in paper()["values"]),
        *(
            f"claim {c['id']} ({c['verdict']}): accepted: true" + (", and the witness shows it" if c["witness"] else "")
            for c in paper()["claims"]
        ),
        "14 accepted, 0 refused, 0 undecided; 0 required not proved; exit status 0",
    ]
    false = paper()
    false["claims"][1]["verdict"] = "refuted"
    refused = run(way, written(tmp_path, false))
    assert (refused.returncode, refused.stderr) == (1, "")
    assert "claim gain-bound (refuted): refused: not true: mu >= 1/Delta_max" in refused.stdout.splitlines()
    malformed = run(way, written(tmp_path, []))
    assert (malformed.returncode, malformed.stdout) == (2, "")
    assert malformed.stderr.endswith(": $: expected an object, got an array of 0\n")


def test_it_runs_from_another_folder_and_by_a_relative_path(tmp_path: Path) -> None:
    written(tmp_path, paper())
    for here, folder in ((tmp_path, os.path.relpath(FOLDER, tmp_path)), (FOLDER, ".")):
        call = [sys.executable, "-I", "-S", folder, str(tmp_path / "cert.json")]
        assert subprocess.run(call, cwd=here, capture_output=True, timeout=120, check=False).returncode == 0


LATE = certificate(
    design(PAPER_EDGES, 5, mu="1/10"),
    [claim("gain-bound", "undecided", bits=4096), claim("memory-inequality", "proved")],
)


@pytest.mark.parametrize(
    ("document", "require", "status", "lines"),
    [
        (paper(), "gain-bound,memory-inequality", 0, []),
        (paper(), "design", 0, []),
        (paper(), "beta-contraction", 1, ["required beta-contraction: not proved: refuted"]),
        (
            paper(),
            "repaired-condition,gain-bound,beta-contraction",
            1,
            ["required repaired-condition: not proved: refuted", "required beta-contraction: not proved: refuted"],
        ),
        (CASES["no_edges"](), "average-consensus", 1, ["required average-consensus: not proved: inapplicable"]),
        (
            CASES["square_contraction_tie"](),
            "average-consensus",
            1,
            ["required average-consensus: not proved: absent from the certificate"],
        ),
        (
            {**LATE, "claims": LATE["claims"][:1]},
            "gain-bound",
            3,
            ["required gain-bound: not proved: undecided"],
        ),
        ({**LATE, "claims": LATE["claims"][:1]}, "design", 3, ["required gain-bound: not proved: undecided"]),
        (LATE, "memory-inequality", 1, ["required memory-inequality: not proved: refused by the checker"]),
    ],
)
def test_require(
    document: Json, require: str, status: int, lines: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert command.main([written(tmp_path, document), "--require", require]) == status
    out = capsys.readouterr().out.splitlines()
    assert [line for line in out if line.startswith("required")] == lines
    assert out[-1].endswith(f"{len(lines)} required not proved; exit status {status}")


def test_required_of_too_many_agents_is_undecided(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    document = certificate(design([], 2001, mu="1"), [claim("gain-bound", "proved")])
    assert command.main([written(tmp_path, document)]) == 3
    assert command.main([written(tmp_path, document), "--require", "gain-bound"]) == 3
    out = capsys.readouterr().out
    assert "required gain-bound: not proved: undecided by the checker" in out
    assert "claim gain-bound (proved): undecided: more than 2000 agents are beyond this checker" in out


@pytest.mark.parametrize("names", ["", "gain-bound,", "gain bound", "design,gain-bound", "all", "\udcff"])
def test_unknown_ids_are_a_wrong_call(names: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as caught:
        command.main([written(tmp_path, paper()), "--require", names])
    assert caught.value.code == 2
    assert "is not the id of a claim" in capsys.readouterr().err


@pytest.mark.parametrize("name", ["absent.json", ".", "cert.json/x"])
def test_files_that_cannot_be_read(name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    written(tmp_path, paper())
    assert command.main([str(tmp_path / name)]) == 2
    caught = capsys.readouterr()
    assert caught.out == ""
    assert re.fullmatch(r"'.*': (No such file or directory|Is a directory|Not a directory)\n", caught.err)


def test_what_is_no_certificate_is_2(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert command.main([written(tmp_path, {})]) == 2
    caught = capsys.readouterr()
    assert caught.out == ""
    assert caught.err.endswith('cert.json\': $: missing key "format"\n')


def test_not_a_byte_more_than_is_allowed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """What stands behind the last byte that is allowed is not cut off and then forgotten."""
    file = Path(written(tmp_path, paper()))
    for module in (command, text):
        monkeypatch.setattr(module, "MAX_BYTES", file.stat().st_size)
    assert command.main([str(file)]) == 0
    file.write_text(file.read_text() + " ")
    assert command.main([str(file)]) == 2
    assert "larger than" in capsys.readouterr().err


@pytest.mark.parametrize("error", [ValueError("some\nthing"), RecursionError(), MemoryError(), KeyboardInterrupt()])
def test_whatever_else_goes_wrong_is_4(
    error: BaseException, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    def fail(_: bytes, **_more: object) -> None:
        raise error

    monkeypatch.setattr(command, "check", fail)
    monkeypatch.setattr(sys, "argv", ["checker", written(tmp_path, paper())])
    descriptor = os.dup(1)
    try:
        assert command.run() == 4
    finally:
        os.dup2(descriptor, 1)
        os.close(descriptor)
    found = capfd.readouterr()
    assert found.err == f"internal error: {type(error).__name__}: {str(error)!a}\n"
    assert found.out == ""


def test_a_closed_pipe_is_4_and_one_line(tmp_path: Path) -> None:
    read, write = os.pipe()
    os.close(read)
    found = subprocess.run(
        [*WAYS["folder"], written(tmp_path, paper())],
        stdout=write,
        stderr=subprocess.PIPE,
        text=True,
        timeout=120,
        check=False,
    )
    os.close(write)
    assert found.returncode == 4
    assert found.stderr == "internal error: BrokenPipeError: '[Errno 32] Broken pipe'\n"


@pytest.fixture
def plain_imports(monkeypatch: pytest.MonkeyPatch) -> None:
    """Imports without pytest's hook, whose loader runpy cannot use; it takes the package for a plugin of pytest."""
    monkeypatch.setattr(sys, "meta_path", [finder for finder in sys.meta_path if not hasattr(finder, "mark_rewrite")])


@pytest.mark.usefixtures("plain_imports")
def test_a_failed_import_is_4(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setitem(sys.modules, "fomas_verify.checker.command", None)
    with pytest.raises(SystemExit) as caught:
        runpy.run_module("fomas_verify.checker", run_name="__main__")
    assert caught.value.code == 4
    assert capsys.readouterr().err.startswith("internal error: ModuleNotFoundError")


def test_as_a_folder_the_root_stands_in_for_the_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "argv", ["checker", written(tmp_path, paper())])
    monkeypatch.setattr(sys, "path", list(sys.path))
    with pytest.raises(SystemExit) as caught:
        runpy.run_path(str(FOLDER), run_name="__main__")
    assert caught.value.code == 0
    assert sys.path.count(str(FOLDER)) == 0


@pytest.mark.usefixtures("plain_imports")
def test_imported_it_does_nothing() -> None:
    assert "_run" in runpy.run_module("fomas_verify.checker.__main__", run_name="other")


def foreign_imports(source: str) -> set[str]:
    """What a module of the checker imports beside the standard library and the checker."""
    found = set()
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            found.add("." * node.level + (node.module or ""))
        elif (
            isinstance(node, ast.Call)
            and isinstance(node.func, ast.Name)
            and node.func.id in ("__import__", "exec", "eval")
        ):
            found.add(node.func.id)
    own = re.compile(r"fomas_verify\.checker(\..*)?")
    dynamic = {"importlib", "imp", "runpy", "pkgutil", "ctypes", "subprocess"}
    return {
        name
        for name in found
        if not own.fullmatch(name)
        and (name.split(".")[0] not in sys.stdlib_module_names or name.split(".")[0] in dynamic)
    }


def floats(source: str) -> list[str]:
    """Where a module could compute in binary floats: literals, true division of what `math` gives, and the like."""
    names = {"float", "complex", "sqrt", "log", "log2", "exp", "pow", "fsum", "time", "random"}
    nodes = list(ast.walk(ast.parse(source)))
    literals = [repr(n.value) for n in nodes if isinstance(n, ast.Constant) and isinstance(n.value, float | complex)]
    return sorted(literals + [n.id for n in nodes if isinstance(n, ast.Name) and n.id in names])


def digests(source: str) -> list[str]:
    """Where a module could know a certificate again instead of deciding it: digests taken, and digests kept."""
    modules = {"hashlib", "hmac", "zlib", "binascii", "base64", "pickle", "marshal", "shelve", "sqlite3"}
    names = {"hash", "digest", "hexdigest", "crc32", "adler32"}
    found = []
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import | ast.ImportFrom):
            imported = [alias.name for alias in node.names] + [getattr(node, "module", None) or ""]
            found += [name for name in imported if name.split(".")[0] in modules]
        elif isinstance(node, ast.Name | ast.Attribute):
            name = node.id if isinstance(node, ast.Name) else node.attr
            found += [name] if name in names else []
        elif isinstance(node, ast.Constant):
            kept = node.value.decode("latin-1") if isinstance(node.value, bytes) else str(node.value)
            found += re.findall(r"[0-9A-Za-z+/_-]{32,}", kept)
    return found


@pytest.mark.parametrize("file", sorted(FOLDER.glob("*.py")), ids=lambda file: file.name)
def test_sources_import_the_standard_library_only_and_hold_no_floats_nor_digests(file: Path) -> None:
    source = file.read_text()
    assert foreign_imports(source) == set()
    assert floats(source) == []
    # One digest is taken: of the edge list that a certificate names, whose every line is read and decided about.
    assert set(digests(source)) == ({"hashlib", "hexdigest"} if file.name == "edge_list.py" else set())
    assert not any(isinstance(node, ast.Assert) for node in ast.walk(ast.parse(source)))


@pytest.mark.parametrize(
    ("source", "found"),
    [
        ("import flint", {"flint"}),
        ("from numpy.linalg import eigh", {"numpy.linalg"}),
        ("def f():\n    import mpmath as m", {"mpmath"}),
        ("from fomas_verify import exact", {"fomas_verify"}),
        ("from fomas_verify.exact.rational import x", {"fomas_verify.exact.rational"}),
        ("from fomas_verify.checkers import x", {"fomas_verify.checkers"}),
        ("from . import text", {"."}),
        ("import importlib; importlib.import_module('flint')", {"importlib"}),
        ("__import__('flint')", {"__import__"}),
        ("import json\nfrom fomas_verify.checker.text import parse", set()),
    ],
)
def test_the_import_gate_goes_red(source: str, found: set[str]) -> None:
    assert foreign_imports(source) == found


def test_the_float_gate_goes_red() -> None:
    assert floats("x = 0.5 * float(2) + 1j") == ["0.5", "1j", "float"]


@pytest.mark.parametrize(
    "source",
    [
        "import hashlib",
        "from zlib import crc32 as seen",
        "def f(data):\n    return hash(data) in KNOWN",
        "x = y.hexdigest()",
        "KNOWN = {'" + "9f86d081884c7d65" * 4 + "'}",
        "KNOWN = (b'" + "n4bQgYhMfWWaL+qgxVrQFaO/TxsrC4Is" + "',)",
        "KNOWN = 0x" + "9f86d081884c7d65" * 4,
    ],
)
def test_the_digest_gate_goes_red(source: str) -> None:
    assert digests(source) != []


def test_the_statements_are_those_of_the_format() -> None:
    page = (ROOT / "docs" / "certificate-format.md").read_text()
    for heading, statements in (("## 4.", STATEMENTS), ("## 8.", CONDITIONS)):
        section = page.partition(heading)[2].partition("\n## ")[0]
        assert dict(re.findall(r"^\| `([a-z-]+)` \| `([^`]+)` \|$", section, re.MULTILINE)) == statements
