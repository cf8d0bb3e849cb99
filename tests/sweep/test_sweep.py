"""A sweep on this machine: its dataset, what goes on and what is refused, and how it ends."""

import fcntl
import json
import resource
import signal
import subprocess
import sys
from pathlib import Path

import pyarrow.dataset
import pyarrow.parquet as pq
import pytest

from .conftest import parts, rows, wait_until

SMALL = {"mu": ["0.1", "0.2", "0.4"]}
TERMINAL = 130


def ended(process: subprocess.Popen) -> tuple[int, str, str]:
    out, err = process.communicate(timeout=120)
    return process.returncode, out, err


@pytest.fixture
def done(sweep, write_grid, tmp_path):
    """A finished sweep of three designs: its grid and folder."""
    grid, folder = write_grid(SMALL, alpha="0.9"), tmp_path / "rows"
    assert ended(sweep(grid, "-o", folder, "-j", 1))[0] == 0
    return grid, folder


def test_the_dataset_reads_as_one(done) -> None:
    table = pyarrow.dataset.dataset(done[1], format="parquet").to_table().to_pydict()
    assert table["row"] == [0, 1, 2]
    assert table["mu_exact"] == ["1/10", "1/5", "2/5"]
    assert table["mu"] == [0.1, 0.2, 0.4]
    assert table["status"] == [1, 0, 0]
    assert table["verdict_memory-inequality"] == ["refuted", "proved", "proved"]
    assert table["message"] == [None] * 3


def test_the_summary_counts_and_comes_again_without_work(sweep, done) -> None:
    grid, folder = done
    before = parts(folder)
    status, out, err = ended(sweep(grid, "-o", folder))
    assert (status, err) == (0, "")
    lines = [line.split() for line in out.splitlines()]
    assert ["3", "designs", "over", "mu"] in lines
    assert ["memory-inequality", "2", "1", "0", "0"] in lines
    assert ["2", "every", "required", "claim", "proved"] in lines
    assert parts(folder) == before


@pytest.mark.parametrize("damage", ["missing", "truncated", "foreign"])
def test_a_part_that_is_not_whole_is_computed_again(sweep, done, damage: str) -> None:
    grid, folder = done
    before = parts(folder)
    file = next(folder.glob("part-*"))
    if damage == "missing":
        file.unlink()
    elif damage == "truncated":
        file.write_bytes(file.read_bytes()[:-20])
    else:
        pq.write_table(pq.read_table(file).replace_schema_metadata(), file)
    (folder / f".{file.name}.0123456789abcdef.tmp").write_bytes(b"half")
    assert ended(sweep(grid, "-o", folder, "-j", 1))[0] == 0
    assert parts(folder) == before
    assert not list(folder.glob(".*"))


@pytest.mark.parametrize(
    ("grid", "options", "words"),
    [
        ({"mu": ["0.1", "0.2"]}, (), "holds rows of another grid"),
        (SMALL, ("--claims", "gain-bound"), "holds rows of other --claims"),
        (SMALL, ("--part-rows", 2), "holds rows in parts of 10 rows"),
    ],
)
def test_rows_of_another_sweep_are_left_alone(sweep, write_grid, done, grid, options, words: str) -> None:
    before = parts(done[1])
    status, out, err = ended(sweep(write_grid(grid, alpha="0.9"), "-o", done[1], *options))
    assert (status, out) == (2, "")
    assert err == f"verify-design: {done[1]}: {words}; nothing was changed: give another -o DIR\n"
    assert parts(done[1]) == before


def test_rows_of_another_version_are_left_alone(sweep, done) -> None:
    grid, folder = done
    manifest = json.loads((folder / "_sweep.json").read_text())
    manifest["plan"]["version"], manifest["digest"] = "0.0.1", "0" * 64
    (folder / "_sweep.json").write_text(json.dumps(manifest))
    status, _, err = ended(sweep(grid, "-o", folder))
    assert status == 2
    assert "holds rows of fomas_verify 0.0.1, this is " in err


@pytest.mark.parametrize("name", ["notes.txt", "part-00000007.parquet"])
def test_other_files_are_not_mixed_with_rows(sweep, write_grid, done, tmp_path: Path, name: str) -> None:
    grid, folder = done
    (folder / name).write_text("mine")
    assert ended(sweep(grid, "-o", folder)) == (
        2, "", f"verify-design: {folder}: expected the parts of this sweep only, found {name}\n"
    )  # fmt: skip
    other = tmp_path / "other"
    other.mkdir()
    (other / name).write_text("mine")
    assert f"expected an empty folder or one of this sweep, found {name}" in ended(sweep(grid, "-o", other))[2]
    assert [(path.name, path.read_text()) for path in other.iterdir()] == [(name, "mine")]


def test_a_part_of_damaged_pages_is_refused(sweep, done) -> None:
    grid, folder = done
    (file,) = folder.glob("part-*")
    column = pq.read_metadata(file).row_group(0).column(pq.read_schema(file).names.index("status"))
    data = bytearray(file.read_bytes())
    data[(column.dictionary_page_offset or column.data_page_offset) + column.total_compressed_size - 1] ^= 0xFF
    file.write_bytes(data)
    status, _, err = ended(sweep(grid, "-o", folder))
    assert (status, err.count("\n")) == (2, 1)
    assert "expected a whole part, got a damaged one: without it the same call computes it again" in err
    assert file.read_bytes() == data
    file.unlink()
    assert ended(sweep(grid, "-o", folder))[0] == 0


@pytest.mark.parametrize("text", ["{", "[" * 200_000])
def test_a_manifest_that_is_none_is_refused(sweep, done, text: str) -> None:
    (done[1] / "_sweep.json").write_text(text)
    status, _, err = ended(sweep(done[0], "-o", done[1]))
    assert status == 2
    assert "_sweep.json: expected the description of a sweep" in err


def test_two_sweeps_do_not_share_a_folder(sweep, done) -> None:
    with (done[1] / "_lock").open("ab") as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        status, _, err = ended(sweep(done[0], "-o", done[1]))
    assert status == 2
    assert "another sweep is writing into it" in err
    assert ended(sweep(done[0], "-o", done[1]))[0] == 0


def test_a_full_disk_leaves_nothing_half_written(write_grid, sweep, tmp_path: Path) -> None:
    """No file may have more than 5,000 bytes: the first part has."""
    grid, folder = write_grid({"mu": {"from": "0.1", "to": "0.4", "steps": 3}}, alpha="0.9"), tmp_path / "rows"
    process = subprocess.run(
        [sys.executable, "-m", "fomas_verify", "sweep", str(grid), "-o", str(folder), "-j", "1"],
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (5_000, 5_000)),
        capture_output=True,
        text=True,
        check=False,
    )
    assert process.returncode == 2
    assert process.stderr == f"verify-design: {folder}/part-00000000.parquet: cannot write: File too large\n"
    assert sorted(file.name for file in folder.iterdir()) == ["_lock", "_sweep.json"]
    assert ended(sweep(grid, "-o", folder, "-j", 1))[0] == 0
    assert len(rows(folder)) == 3


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (("--max-rows", 2), "expected at most 2 rows, got 3 (3 mu); --max-rows allows more"),
        (("--claims", "gain"), "expected claim ids, got 'gain'"),
        (("--x", "mu"), "--x is about the heat map: give --plot FILE too"),
        (("-o", "/dev/full"), "/dev/full: cannot write: File exists"),
        (
            ("-o", "rows", "--plot", "rows/x.svg", "--x", "mu", "--y", "h"),
            "needs a file outside of the dataset's folder",
        ),
    ],
)
def test_a_wrong_call_is_refused(sweep, write_grid, options, words: str) -> None:
    status, out, err = ended(sweep(write_grid(SMALL, alpha="0.9"), *options))
    assert (status, out) == (2, "")
    assert words in err
    assert len(err.splitlines()) == 1


def test_no_valid_design_at_all_is_status_2_and_an_internal_error_4() -> None:
    from fomas_verify.sweep.summary import Summary

    assert Summary(3, {2: 3}, {}).exit_status == 2
    assert Summary(3, {2: 2, 1: 1}, {}).exit_status == 0
    assert Summary(3, {0: 2, 4: 1}, {}).exit_status == 4


@pytest.mark.slow
def test_an_interruption_says_how_to_go_on(sweep, long_grid: Path, tmp_path: Path) -> None:
    folder = tmp_path / "rows"
    process = sweep(long_grid, "-o", folder, "--part-rows", 10, "-j", 2)
    wait_until(lambda: len(parts(folder)) > 1, process)
    process.send_signal(signal.SIGINT)
    status, out, err = ended(process)
    assert (status, out) == (TERMINAL, "")
    assert err.startswith("verify-design: interrupted: ")
    assert err.strip().endswith("the same call computes the others")
    assert len(err.strip().splitlines()) == 1
