"""A graph file of a grid is read once, where the sweep is started: those who compute have its edges."""

import json
from pathlib import Path

import pytest

from fomas_verify.design import DesignError
from fomas_verify.sweep.grid import read_grid
from fomas_verify.sweep.plan import make_plan
from tests.sweep.conftest import PAPER, parts, rows

CSV = "\n".join(",".join(map(str, row)) for row in PAPER) + "\n"


def write(folder: Path, csv: str = CSV, **grid: object) -> Path:
    (folder / "g.csv").write_text(csv)
    graph = {"file": "g.csv", "orientation": "hears"}
    path = folder / "grid.json"
    path.write_text(json.dumps({"alpha": "0.9", "graph": graph, "grid": {"mu": ["0.1", "0.3"], **grid}}))
    return path


def test_the_grid_is_that_of_the_same_edges(tmp_path: Path) -> None:
    """a_14 = 1: agent 1 hears agent 4."""
    found = read_grid(write(tmp_path))
    assert [4, 1, "1"] in found.base["graph"]["edges"]
    assert [1, 4, "1"] not in found.base["graph"]["edges"]
    (tmp_path / "g.csv").unlink()
    design = found.design_on(0)
    assert (design.graph.agents, len(design.graph.edges)) == (5, 9)


def test_another_content_under_the_same_name_is_another_sweep(tmp_path: Path) -> None:
    """Rows of two graphs must not stand in one dataset."""
    first = make_plan(read_grid(write(tmp_path)))
    second = make_plan(read_grid(write(tmp_path, CSV.replace("1", "2"))))
    assert first.digest != second.digest


def test_what_binary_floats_are_read_as_is_told(tmp_path: Path) -> None:
    import numpy as np

    np.savez(tmp_path / "g.npz", A=np.array(PAPER) * 0.1)
    path = tmp_path / "grid.json"
    graph = {"file": "g.npz", "orientation": "hears"}
    path.write_text(json.dumps({"alpha": "0.9", "graph": graph, "grid": {"mu": ["0.1"]}}))
    found = read_grid(path)
    assert [4, 1, "1/10"] in found.base["graph"]["edges"]
    assert "0.1 is 1/10" in found.remarks[0]


@pytest.mark.parametrize("grid", [{"family": ["star"]}, {"agents": [4]}, {"shape": [[3, 3]]}])
def test_a_file_goes_with_no_swept_graph(tmp_path: Path, grid: dict) -> None:
    key = next(iter(grid))
    with pytest.raises(DesignError, match=f"grid.{key}: expected no {key} where the graph is a file's"):
        read_grid(write(tmp_path, **grid))


def test_a_file_outside_of_the_folder_takes_the_option(tmp_path: Path) -> None:
    (tmp_path / "below").mkdir()
    path = write(tmp_path).rename(tmp_path / "below" / "grid.json")
    path.write_text(path.read_text().replace("g.csv", "../g.csv"))
    with pytest.raises(DesignError, match="--allow-outside"):
        read_grid(path)
    assert read_grid(path, allow_outside=True).design_on(0).graph.agents == 5


@pytest.mark.slow
def test_workers_need_no_file(sweep, scheduler, worker, tmp_path: Path) -> None:
    """Rows by a Dask worker and by this machine's processes from a file are those from the edges, to the byte."""
    path = write(tmp_path)
    worker()
    folders = [tmp_path / name for name in ("there", "here")]
    for folder, options in zip(folders, (("--scheduler", scheduler), ("--jobs", "2")), strict=True):
        run = sweep(path, "-o", folder, "--part-rows", 1, *options)
        out, err = run.communicate(timeout=120)
        assert (run.returncode, err) == (0, ""), out
    assert parts(folders[0]) == parts(folders[1])
    assert [row["verdict_average-consensus"] for row in rows(folders[0])] == ["proved", "proved"]
