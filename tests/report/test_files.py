"""A file is written whole or not at all, and what cannot be written is said in one line."""

import fcntl
import os
import stat
from pathlib import Path

import pytest

from fomas_verify.exact.errors import FomasError
from fomas_verify.report.files import OutputError, make_folder, write_all, write_whole


def names(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.iterdir())


def test_writes_and_replaces(tmp_path: Path) -> None:
    file = tmp_path / "a.txt"
    for content in (b"one", b"", b"two\x00\xff"):
        write_whole(file, content)
        assert file.read_bytes() == content
    assert names(tmp_path) == ["a.txt"]


def test_permissions_are_those_of_any_new_file(tmp_path: Path) -> None:
    write_whole(tmp_path / "ours", b"")
    (tmp_path / "plain").write_bytes(b"")
    assert stat.S_IMODE((tmp_path / "ours").stat().st_mode) == stat.S_IMODE((tmp_path / "plain").stat().st_mode)


def test_follows_a_symbolic_link(tmp_path: Path) -> None:
    (tmp_path / "target").write_bytes(b"old")
    (tmp_path / "link").symlink_to("target")
    write_whole(tmp_path / "link", b"new")
    assert (tmp_path / "link").is_symlink()
    assert (tmp_path / "target").read_bytes() == b"new"


def test_writes_through_what_is_no_regular_file(tmp_path: Path) -> None:
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    reader = os.open(pipe, os.O_RDONLY | os.O_NONBLOCK)
    try:
        write_whole(pipe, b"through")
        assert os.read(reader, 100) == b"through"
    finally:
        os.close(reader)
    assert names(tmp_path) == ["pipe"]
    assert stat.S_ISFIFO(pipe.stat().st_mode)


@pytest.mark.parametrize("where", ["missing/a", "folder", "file/a", "x" * 300, "nul\0"])
def test_refuses_in_one_line_and_leaves_nothing(tmp_path: Path, where: str) -> None:
    (tmp_path / "folder").mkdir()
    (tmp_path / "file").write_bytes(b"kept")
    with pytest.raises(OutputError, match="cannot write") as refusal:
        write_whole(tmp_path / where, b"data")
    assert isinstance(refusal.value, FomasError)
    assert refusal.value.exit_status == 2
    assert "\n" not in str(refusal.value)
    assert names(tmp_path) == ["file", "folder"]
    assert names(tmp_path / "folder") == []
    assert (tmp_path / "file").read_bytes() == b"kept"


def test_one_refusal_keeps_the_others_from_being_written(tmp_path: Path) -> None:
    (tmp_path / "first").write_bytes(b"old")
    with pytest.raises(OutputError, match="second"):
        write_all({tmp_path / "first": b"new", tmp_path / "missing" / "second": b"new"})
    assert (tmp_path / "first").read_bytes() == b"old"
    assert names(tmp_path) == ["first"]


def test_an_interruption_leaves_the_former_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    file = tmp_path / "a"
    file.write_bytes(b"old")

    def interrupted(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(Path, "replace", interrupted)
    with pytest.raises(KeyboardInterrupt):
        write_whole(file, b"new")
    assert file.read_bytes() == b"old"
    assert names(tmp_path) == ["a"]


LEFT = ".a.json.0123456789abcdef.tmp"


def test_what_a_killed_process_left_is_removed_by_the_next_that_writes_this_file(tmp_path: Path) -> None:
    others = [
        ".b.json.0123456789abcdef.tmp",
        ".a.json.0123456789ABCDEF.tmp",
        ".a.json.tmp",
        "a.json.0123456789abcdef.tmp",
    ]
    for name in (LEFT, *others):
        (tmp_path / name).write_bytes(b"half")
    write_whole(tmp_path / "a.json", b"whole")
    assert names(tmp_path) == sorted(["a.json", *others])


def test_a_temporary_file_that_another_process_is_writing_stays(tmp_path: Path) -> None:
    with (tmp_path / LEFT).open("wb") as held:
        fcntl.flock(held, fcntl.LOCK_EX)
        write_whole(tmp_path / "a.json", b"whole")
        assert names(tmp_path) == [LEFT, "a.json"]


def test_no_link_is_followed_and_no_folder_removed_in_place_of_a_leftover(tmp_path: Path) -> None:
    (tmp_path / "precious").write_bytes(b"kept")
    (tmp_path / LEFT).symlink_to("precious")
    folder = tmp_path / LEFT.replace("0", "f")
    folder.mkdir()
    write_whole(tmp_path / "a.json", b"whole")
    assert (tmp_path / "precious").read_bytes() == b"kept"
    assert names(tmp_path) == sorted([LEFT, folder.name, "a.json", "precious"])


def test_a_temporary_file_is_held_while_it_is_written(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """So that another process does not take it for a leftover."""
    seen = []

    def replace(temporary: Path, target: Path) -> None:
        with temporary.open("r+b") as file, pytest.raises(BlockingIOError):
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        seen.append(target.name)

    monkeypatch.setattr(Path, "replace", replace)
    write_all({tmp_path / "a": b"1", tmp_path / "b": b"2"})
    assert seen == ["a", "b"]


def test_one_that_was_removed_before_it_was_held_is_made_anew(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    removed = []

    def flock(descriptor: int, _: int) -> None:
        if not removed:
            removed.append(next(tmp_path.glob(".a.*.tmp")))
            removed[0].unlink()

    monkeypatch.setattr(fcntl, "flock", flock)
    write_whole(tmp_path / "a", b"whole")
    assert removed
    assert (tmp_path / "a").read_bytes() == b"whole"
    assert names(tmp_path) == ["a"]


def test_a_file_system_without_locks_is_written_to_and_nothing_is_removed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def flock(*_: object) -> None:
        raise OSError(95, "Operation not supported")

    monkeypatch.setattr(fcntl, "flock", flock)
    (tmp_path / LEFT).write_bytes(b"perhaps another's")
    write_whole(tmp_path / "a.json", b"whole")
    assert names(tmp_path) == [LEFT, "a.json"]


def test_a_full_device_is_refused() -> None:
    full = Path("/dev/full")
    if not full.exists():
        pytest.skip("this system has no /dev/full")
    with pytest.raises(OutputError, match="/dev/full: cannot write: No space left"):
        write_whole(full, b"x" * 10)
    assert stat.S_ISCHR(full.stat().st_mode)


def test_a_folder_under_a_file_is_refused(tmp_path: Path) -> None:
    (tmp_path / "file").write_bytes(b"")
    with pytest.raises(OutputError, match="file/sub: cannot write: Not a directory"):
        make_folder(tmp_path / "file" / "sub")


DESIGNS = [
    'alpha = 0.9\nmu = 0.1\n[graph]\nfamily = "path"\nagents = 3\n',
    "format = 'fomas-design/1'\nmu = 1\nalpha= ['1/2', 0.7]\ngraph.family = 'path'\ngraph.agents = 3\n",
    '{"alpha":0.9,"mu":"1/10","graph":{"family":"path","agents":3}}',
    '{\n  "graph": {"family": "path", "agents": 3},\n  "alpha": "9/10"\n}\n',
    "'alpha' = 0.9\nmu = 0.1\n['graph']\nfamily = \"path\"\nagents = 3\n",
    'mu = 0.1\n["graph"]\nfamily = "path"\nagents = 3\n[other]\n"grid".alpha = [0.5, 0.9]\n',
]


@pytest.mark.parametrize("text", DESIGNS)
@pytest.mark.parametrize("linked", [False, True])
def test_no_output_takes_the_place_of_a_design(tmp_path: Path, text: str, linked: bool) -> None:
    design, other = tmp_path / "plant.design.toml", tmp_path / "other.json"
    design.write_text(text)
    target = tmp_path / "link.json" if linked else design
    if linked:
        target.symlink_to(design)
    with pytest.raises(OutputError, match=r"expected a file of its own, found a design$") as caught:
        write_all({other: b"{}", target: b"{}"})
    assert caught.value.exit_status == 2
    assert design.read_text() == text
    assert not other.exists()


def test_no_two_outputs_are_one_file(tmp_path: Path) -> None:
    (tmp_path / "a").write_bytes(b"old")
    (tmp_path / "link").symlink_to("a")
    with pytest.raises(OutputError, match=r"link: cannot write: expected .*, found another output of this run$"):
        write_all({tmp_path / "a": b"1"}, {tmp_path / "link": b"2"})
    assert (tmp_path / "a").read_bytes() == b"old"
    assert names(tmp_path) == ["a", "link"]


def test_a_certificate_gives_way_to_the_next(tmp_path: Path, checkout: Path) -> None:
    """It names alpha, and graph-assumption, but it is no design."""
    path = tmp_path / "certificate.json"
    path.write_bytes((checkout / "reports" / "paper" / "certificate.json").read_bytes())
    write_whole(path, b"{}")
    assert path.read_bytes() == b"{}"
