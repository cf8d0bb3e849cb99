"""The heat map: what it counts, what it shows, what it refuses."""

import io
import re

import pyarrow.parquet as pq
import pytest

from fomas_verify.sweep.errors import SweepError
from fomas_verify.sweep.grid import grid_from_mapping
from fomas_verify.sweep.heat_map import prepare
from fomas_verify.sweep.plan import make_plan
from fomas_verify.sweep.store import part_name
from fomas_verify.sweep.table import compute_part

pytest.importorskip("matplotlib")
GRID = {"family": ["path", "hypercube"], "agents": [3, 4], "mu": ["0.1", "0.2", "2"]}


@pytest.fixture(scope="module")
def plan():
    return make_plan(grid_from_mapping({"grid": GRID, "alpha": "0.9"}))


@pytest.fixture(scope="module")
def folder(plan, tmp_path_factory):
    found = tmp_path_factory.mktemp("rows")
    for part in range(plan.parts):
        (found / part_name(part)).write_bytes(compute_part(plan, part))
    return found


def words(svg: bytes) -> set[str]:
    """The comments in which matplotlib repeats each text of an SVG file."""
    return {x.strip() for x in re.findall(r"<!-- (.*?) -->", svg.decode(), re.DOTALL)}


def test_shares_are_those_of_the_rows(plan, folder) -> None:
    shown = words(prepare(plan, "svg", "mu", "agents", "average-consensus", {})(folder))
    table = pq.read_table(io.BytesIO((folder / part_name(0)).read_bytes())).to_pylist()
    cell = [x["verdict_average-consensus"] for x in table if x["mu_exact"] == "1/10" and x["agents"] == 3]
    assert sorted(map(str, cell)) == ["None", "proved"]
    assert {"1/2", "mixed", "proved", "refuted", "average-consensus: every family; mixed: share proved"} <= shown


def test_a_fixed_value_leaves_its_rows(plan, folder) -> None:
    shown = words(prepare(plan, "svg", "mu", "agents", "average-consensus", {"family": "hypercube"})(folder))
    assert {"no verdict", "proved", "refuted", "average-consensus: family = hypercube"} <= shown
    assert "mixed" not in shown


def test_the_same_bytes_every_time(plan, folder) -> None:
    draw = prepare(plan, "svg", "mu", "family", None, {})
    assert draw(folder) == draw(folder)
    assert prepare(plan, "png", "mu", "family", None, {})(folder).startswith(b"\x89PNG")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("gif", "mu", "agents", None, {}), "--plot: expected a name that ends in .pdf, .png or .svg, got .gif"),
        (("svg", "m", "agents", None, {}), "--x: expected a swept parameter, got 'm'"),
        (("svg", "mu", "h", None, {}), "--y: expected a swept parameter, got 'h'"),
        (("svg", "mu", "mu", None, {}), "--x, --y, --at: expected different parameters"),
        (("svg", "mu", "agents", "trajectory-norm-bound", {}), "--claim: expected one of the claims that are decided"),
        (("svg", "mu", "agents", None, {"family": "star"}), "--at family: expected one of its values, got star"),
        (("svg", "mu", "agents", None, {"h": "1"}), "--at h: expected a swept parameter"),
    ],
)
def test_refused(plan, arguments, message: str) -> None:
    with pytest.raises(SweepError) as caught:
        prepare(plan, *arguments)
    assert str(caught.value).startswith(message)
