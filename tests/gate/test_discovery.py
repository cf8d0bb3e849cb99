"""Which files are designs: the contract's rules, and whatever else may lie in a folder."""

import errno
import os
from pathlib import Path

import pytest

from fomas_verify.gate.discovery import find_designs
from fomas_verify.gate.model import Result, Skipped

DESIGN = 'alpha = 0.9\nmu = 0.1\n[graph]\nfamily = "path"\nagents = 2\n'
JSON = '{"alpha": "0.9", "mu": "0.1", "graph": {"family": "path", "agents": 2}}'
MARK = 'format = "fomas-design/1"\n'


def found(*paths: Path) -> tuple[list[str], list[str], list[str]]:
    """Names of designs, of refused and of skipped files."""
    entries = list(find_designs(paths))
    designs = [entry.name for entry in entries if isinstance(entry, Path)]
    refused = [Path(entry.path).name for entry in entries if isinstance(entry, Result)]
    return designs, refused, [Path(entry.source).name for entry in entries if isinstance(entry, Skipped)]


def why(folder: Path) -> str:
    (entry,) = [entry for entry in find_designs([folder]) if not isinstance(entry, Path)]
    return entry.findings[0].text if isinstance(entry, Result) else entry.reason


def write(folder: Path, **texts: str) -> None:
    for name, text in texts.items():
        (folder / name.replace("__", ".")).write_text(text)


def test_designs_by_name_and_by_mark(tmp_path: Path) -> None:
    (tmp_path / "sub").mkdir()
    write(tmp_path, b__design__toml="anything", a__design__json="", c__toml=MARK + DESIGN, D__DESIGN__TOML=DESIGN)
    write(tmp_path / "sub", e__json='{"format": "fomas-design/1"}', f__toml='format = "fomas-design/9"')
    assert found(tmp_path) == (
        ["D.DESIGN.TOML", "a.design.json", "b.design.toml", "c.toml", "e.json", "f.toml"],
        [],
        [],
    )


@pytest.mark.parametrize("space", ["", "\n  "])
def test_a_certificate_is_no_design_whatever_its_name(tmp_path: Path, space: str) -> None:
    """`gate -o` names certificates after their designs; a design cannot begin so."""
    write(
        tmp_path,
        a__design__toml=DESIGN,
        a__design__json=f'{{{space}"format": "fomas-certificate/1", "kind": "design"}}',
    )
    assert found(tmp_path) == (["a.design.toml"], [], ["a.design.json"])
    assert why(tmp_path) == "a certificate"
    write(tmp_path, a__design__json=f'{{"name": "format", {JSON[1:]}')
    assert found(tmp_path) == (["a.design.json", "a.design.toml"], [], [])


def test_a_file_given_by_name_is_a_design_whatever_it_is(tmp_path: Path) -> None:
    write(tmp_path, notes__txt="x", x__toml="", y__json="[]")
    paths = [tmp_path / name for name in ("y.json", "notes.txt", "x.toml", "missing")]
    assert found(*paths) == (["y.json", "notes.txt", "x.toml", "missing"], [], [])


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("x.toml", DESIGN),
        ("x.json", JSON),
        ("x.TOML", DESIGN),
        ("x.toml", DESIGN.replace("[graph]", "[[graphs]]")),
        ("x.toml", 'format = "other"\n' + DESIGN),
    ],
)
def test_a_design_without_a_mark_is_an_error_that_says_how_to_mark_it(tmp_path: Path, name: str, text: str) -> None:
    (tmp_path / name).write_text(text)
    assert found(tmp_path) == ([], [name], [])
    assert f".design.{name[2:].lower()} or format = " in why(tmp_path)


@pytest.mark.parametrize("text", [MARK + DESIGN + "x = [", "\ufeff" + DESIGN + "x = [", '{"graph": 1,\n "alpha": 2, '])
def test_a_broken_design_is_still_taken_for_one(tmp_path: Path, text: str) -> None:
    name = "x.json" if text.startswith("{") else "x.toml"
    (tmp_path / name).write_text(text)
    assert found(tmp_path) == ([name], [], [])


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        (b"[tool.x]\nalpha = 1\n", "no alpha and no graph"),
        (b"alpha = 1\n[other]\ngraph = 2\n", "no alpha and no graph at its top level"),
        (b'{"alpha": 1}', "no alpha and no graph"),
        (b"", "no alpha and no graph"),
        (b"x = [", "no alpha and no graph"),
        (b"# alphabet, graphics\nx = [", "cannot be parsed, and has no mark"),
        (b"alpha = \xff", "not in UTF-8"),
    ],
)
def test_what_is_no_design_is_skipped_with_the_reason(tmp_path: Path, text: bytes, reason: str) -> None:
    (tmp_path / "x.toml").write_bytes(text)
    assert found(tmp_path) == ([], [], ["x.toml"])
    assert why(tmp_path) == reason


def test_what_is_not_named_toml_or_json_is_not_even_read(tmp_path: Path) -> None:
    write(tmp_path, x__txt=MARK + DESIGN, design__toml__bak=DESIGN, toml=DESIGN)
    assert found(tmp_path) == ([], [], [])


def test_each_file_once(tmp_path: Path) -> None:
    write(tmp_path, a__design__toml=DESIGN)
    (tmp_path / "b.design.toml").symlink_to("a.design.toml")
    a = tmp_path / "a.design.toml"
    assert found(a, tmp_path, tmp_path / "." / "a.design.toml") == (
        ["a.design.toml"],
        [],
        ["a.design.toml", "b.design.toml", "a.design.toml"],
    )


def test_links_that_loop_and_hidden_folders(tmp_path: Path) -> None:
    (tmp_path / "sub").mkdir()
    (tmp_path / ".git").mkdir()
    write(tmp_path / ".git", z__design__toml=DESIGN)
    write(tmp_path / "sub", a__design__toml=DESIGN)
    (tmp_path / "sub" / "up").symlink_to("..")
    (tmp_path / "sub" / "self").symlink_to("self")
    (tmp_path / "sub" / "loop.json").symlink_to("loop.json")
    (tmp_path / "sub" / "nowhere.toml").symlink_to("nothing")
    (tmp_path / "sub" / "y.design.toml").symlink_to("y.design.toml")
    assert found(tmp_path) == (
        ["a.design.toml", "y.design.toml"],
        ["loop.json", "nowhere.toml"],
        [".git", "up"],
    )


def test_a_pipe_and_a_vast_file_are_not_read(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe.toml")
    with (tmp_path / "vast.json").open("wb") as file:
        file.truncate(2**24 + 1)
    assert found(tmp_path) == ([], [], ["pipe.toml", "vast.json"])


def test_an_unreadable_folder_and_file_are_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "closed").mkdir()
    write(tmp_path, a__design__toml=DESIGN, b__toml=DESIGN)
    scan, read = os.scandir, Path.read_bytes

    def scandir(path: Path) -> object:
        if Path(path).name == "closed":
            raise PermissionError(errno.EACCES, "Permission denied")
        return scan(path)

    def read_bytes(path: Path) -> bytes:
        if path.name == "b.toml":
            raise PermissionError(errno.EACCES, "Permission denied")
        return read(path)

    monkeypatch.setattr(os, "scandir", scandir)
    monkeypatch.setattr(Path, "read_bytes", read_bytes)
    assert found(tmp_path) == (["a.design.toml"], ["b.toml", "closed"], [])
    assert [x.findings[0].text for x in find_designs([tmp_path]) if isinstance(x, Result)] == [
        "expected a readable file, got permission denied",
        "expected a readable folder, got permission denied",
    ]


def test_a_name_that_is_no_text_is_quoted(tmp_path: Path) -> None:
    Path(os.fsdecode(os.fsencode(tmp_path) + b"/\xff.toml")).write_text("x = 1\n")
    (entry,) = find_designs([tmp_path])
    assert isinstance(entry, Skipped)
    assert entry.source.isprintable()


def test_a_grid_is_passed_over_and_named(tmp_path: Path) -> None:
    write(tmp_path, x__toml=DESIGN + "[grid]\nh = [1, 2]\n")
    assert found(tmp_path) == ([], [], ["x.toml"])
    assert why(tmp_path) == "a grid for sweep"
