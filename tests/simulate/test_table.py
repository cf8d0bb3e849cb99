"""The table reads back as the trajectory, to the last bit."""

import csv
import io
from dataclasses import replace

import numpy as np
import pytest

from fomas_verify.design import design_from_mapping
from fomas_verify.simulate import MEMORYLESS, PROPOSED, Plant, plant_of, simulate, with_between
from fomas_verify.simulate.errors import SimulationError
from fomas_verify.simulate.table import csv_parts, header, parquet_bytes
from tests.simulate.designs import PAPER


def test_the_header() -> None:
    assert header(2, 1) == ["k", "t", "controller", "x_1", "x_2", "u_1", "u_2"]
    assert header(2, 2)[3:] == ["x_1_1", "x_1_2", "x_2_1", "x_2_2", "u_1_1", "u_1_2", "u_2_1", "u_2_2"]


def test_the_rows_read_back(plant: Plant) -> None:
    runs = [simulate(plant, law, 30) for law in (PROPOSED, MEMORYLESS)]
    rows = list(csv.reader(io.StringIO(b"".join(csv_parts(runs)).decode())))
    assert rows[0] == header(5, 1)
    assert [(int(row[0]), row[2]) for row in rows[1:]] == [
        (k, c) for k in range(31) for c in ("memoryless", "proposed")
    ]
    for row in rows[1:]:
        run = runs[row[2] == "memoryless"]
        k = int(row[0])
        assert float(row[1]) == k * 0.85
        assert [float(x) for x in row[3:8]] == run.states[:, 0, k].tolist()
        assert [float(x) for x in row[8:]] == run.inputs[:, 0, k].tolist()


def test_points_between(plant: Plant) -> None:
    run = with_between(plant, simulate(plant, PROPOSED, 3), 2)
    rows = [line.split(",") for line in b"".join(csv_parts([run])).decode().splitlines()[1:]]
    assert [int(row[0]) for row in rows] == [0, 0, 0, 1, 1, 1, 2, 2, 2, 3]
    assert np.allclose([float(row[1]) for row in rows], np.arange(10) * 0.85 / 3, rtol=1e-15)
    assert rows[3][8:] == rows[4][8:] == rows[5][8:]
    assert [float(x) for x in rows[4][3:8]] == run.between[0, :, 0, 1].tolist()


def test_several_numbers_an_agent() -> None:
    design = {**PAPER, "x0": [[1, 2], [3, 4], [5, 6], [7, 8], [9, 10]]}
    run = simulate(plant_of(design_from_mapping(design)), PROPOSED, 1)
    first = b"".join(csv_parts([run])).decode().splitlines()[1].split(",")
    assert [float(x) for x in first[3:13]] == list(range(1, 11))


def test_the_table_is_the_same_in_many_parts(plant: Plant, monkeypatch: pytest.MonkeyPatch) -> None:
    """One run ends long before the other; both have points between."""
    unstable = replace(plant, gamma=300 * plant.gamma)
    runs = [
        with_between(plant, simulate(plant, PROPOSED, 90), 2),
        with_between(unstable, simulate(unstable, MEMORYLESS, 90), 2),
    ]
    assert runs[1].last < 70
    whole = b"".join(csv_parts(runs))
    monkeypatch.setattr("fomas_verify.simulate.table.AT_ONCE", 100)
    parts = list(csv_parts(runs))
    assert len(parts) > 20
    assert b"".join(parts) == whole
    assert whole.count(b"\n") == 1 + 91 + 2 * 90 + 3 * runs[1].last + 1


def test_parquet_holds_the_same(plant: Plant) -> None:
    from pyarrow import BufferReader, parquet

    run = with_between(plant, simulate(plant, PROPOSED, 20), 1)
    table = parquet.read_table(BufferReader(parquet_bytes([run])))
    rows = list(csv.reader(io.StringIO(b"".join(csv_parts([run])).decode())))
    assert table.column_names == rows[0]
    for i, name in enumerate(rows[0]):
        kind = {"k": int, "controller": str}.get(name, float)
        assert table.column(name).to_pylist() == [kind(row[i]) for row in rows[1:]]


def test_parquet_without_pyarrow(plant: Plant, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(__import__("sys").modules, "pyarrow", None)
    with pytest.raises(SimulationError, match=r"pip install 'fomas_verify\[sweep\]'"):
        parquet_bytes([simulate(plant, PROPOSED, 2)])
