"""The JSON Schema of the grid of a sweep against its reader, both ways, as the others are."""

import random
import re
import tomllib
from decimal import Decimal
from pathlib import Path
from typing import Any

import pytest

from fomas_verify.design import DesignError
from fomas_verify.design.graph_file import Folder
from fomas_verify.sweep.grid import grid_from_mapping
from fomas_verify.sweep.grid_schema import grid_schema

from .test_schemas import FILES, MUTANTS, UNSAYABLE_OF_DESIGNS, VALUES, agree, decimal, mutated, validator, written

ROOT = Path(__file__).resolve().parents[2]
SCHEMA = grid_schema()
GRIDS = validator(SCHEMA)
UNSAYABLE = [
    *UNSAYABLE_OF_DESIGNS,
    r"grid\.(alpha|gamma|mu|h)(\[\d+\])?(\.from)?: expected each value once",
    r"\.to: expected a number above .*, where the range begins",
    r"grid\.alpha(\[\d+\]|\.from|\.to): expected a number between 0 and 1, both excluded, got ('|\")",
    r"grid\.agents: expected a range of integers",
    # what one graph of several must have, which depends on its family
    r"graph(\.agents|\.shape)?: expected ",
    r"graph\.(agents|shape): cycle|graph\.(agents|shape): .* (power of 2|at least)",
]
RING = {"family": "cycle", "agents": 5}
HALF = {"from": "1/4", "to": "1/2", "steps": 3}
GOOD: list[dict[str, Any]] = [
    tomllib.loads((ROOT / "examples/sweeps/grid.toml").read_text(), parse_float=decimal),
    {"grid": {"alpha": HALF, "mu": [1, "1/2", Decimal("0.1")]}, "graph": RING},
    {"alpha": "9/10", "mu": "0.1", "grid": {"family": ["path", "torus"], "agents": [2, 3], "shape": [[3, 4], [1, 1]]}},
    {"alpha": "9/10", "mu": "0.1", "grid": {"family": ["path", "hypercube"]}, "graph": {"agents": 6}},
    {
        "alpha": "9/10",
        "h": 1,
        "grid": {"gamma": [1], "agents": {"from": 2, "to": "6", "steps": 3}},
        "graph": {"family": "star"},
    },
    {
        "alpha": "9/10",
        "gamma": 1,
        "grid": {"h": HALF},
        "graph": RING,
        "x0": [1, 2, 3, 4, 5],
        "gate": {"require": ["trajectory-norm-bound"]},
    },
    {"alpha": "9/10", "mu": 1, "grid": {"agents": [2, 3]}, "graph": {"edges": [[1, 2], [2, 1, "1/2"]]}},
    {"alpha": "9/10", "mu": 1, "grid": {"h": [1, 2]}, "graph": {"file": "paper.csv", "orientation": "hears"}},
    {
        "name": "g",
        "format": "fomas-design/1",
        "alpha": "9/10",
        "grid": {"mu": [1]},
        "graph": RING,
        "horizon": 3,
        "settle_to": "1/2",
    },
]
BAD: list[dict[str, Any]] = [
    {},
    {"alpha": "9/10", "mu": 1, "graph": RING},
    {"alpha": "9/10", "mu": 1, "graph": RING, "grid": {}},
    {"alpha": "9/10", "mu": 1, "graph": RING, "grid": {"beta": [1]}},
    {"alpha": "9/10", "mu": 1, "graph": RING, "grid": {"mu": [1]}},
    {"alpha": "9/10", "mu": 1, "graph": RING, "grid": {"gamma": [1]}},
    {"alpha": "9/10", "graph": RING, "grid": {"gamma": [1]}},
    {"mu": 1, "graph": RING, "grid": {"h": [1]}},
    {"alpha": "9/10", "graph": RING, "grid": {"mu": []}},
    {"alpha": "9/10", "graph": RING, "grid": {"mu": [0]}},
    {"alpha": "9/10", "graph": RING, "grid": {"mu": 1}},
    {"alpha": "9/10", "graph": RING, "grid": {"mu": [1, 1]}},
    {"alpha": "9/10", "graph": RING, "grid": {"mu": {**HALF, "steps": 1}}},
    {"alpha": "9/10", "graph": RING, "grid": {"mu": {**HALF, "step": 1}}},
    {"alpha": "9/10", "graph": RING, "grid": {"mu": {"from": 1, "to": 2}}},
    {"alpha": ["1/2", "3/4"], "graph": RING, "grid": {"mu": [1]}},
    {"alpha": "9/10", "graphs": [RING, RING], "grid": {"mu": [1]}},
    {"alpha": "9/10", "graph": RING, "grid": {"mu": [1], "agents": [3]}},
    {"alpha": "9/10", "graph": {"family": "path", "agents": 3}, "grid": {"mu": [1], "family": ["star"]}},
    {"alpha": "9/10", "graph": {"agents": 3}, "grid": {"mu": [1], "family": ["cube"]}},
    {"alpha": "9/10", "graph": {"agents": 1}, "grid": {"mu": [1], "family": ["torus"], "shape": [[3, 3]]}},
    {"alpha": "9/10", "graph": {"shape": [3]}, "grid": {"mu": [1], "family": ["star"], "agents": [3]}},
    {"alpha": "9/10", "graph": 3, "grid": {"mu": [1], "family": ["star"], "agents": [3]}},
    {"alpha": "9/10", "graph": {"file": "paper.graphml"}, "grid": {"mu": [1], "agents": [3]}},
]  # fmt: skip


def refusal(document: object) -> str:
    """Why the reader refuses a grid; empty where it does not."""
    try:
        grid_from_mapping(written(document), "g", Folder(FILES))
    except DesignError as error:
        return str(error)
    return ""


@pytest.mark.parametrize("document", GOOD, ids=range(len(GOOD)))
def test_both_accept_a_good_grid(document: dict[str, Any]) -> None:
    assert refusal(document) == ""
    GRIDS.validate(document)


@pytest.mark.parametrize("document", BAD, ids=range(len(BAD)))
def test_both_refuse_a_bad_grid(document: dict[str, Any]) -> None:
    assert refusal(document)
    assert not GRIDS.is_valid(document)


def test_mutants_of_grids() -> None:
    source = random.Random(4)
    keys = ["alpha", "mu", "gamma", "h", "family", "agents", "shape", "graph", "graphs", "from", "to", "steps", "edges"]
    values = [*VALUES, [2, 3], ["path"], ["grid", "star"], [[3, 3]], HALF, {"from": 2, "to": 4, "steps": 3}]
    accepted = 0
    for _ in range(2 * MUTANTS):
        document = mutated(source.choice(GOOD), source, keys, values)
        agree(document, GRIDS, refusal, UNSAYABLE)
        accepted += not refusal(document)
    assert 0.05 * MUTANTS < accepted < 1.8 * MUTANTS


def test_it_explains_every_key() -> None:
    grid = SCHEMA["properties"]["grid"]
    assert [key for key, entry in grid["properties"].items() if "description" not in entry] == []
    assert not re.search("interval", " ".join(str(SCHEMA["properties"][key]) for key in ("alpha", "gamma", "mu", "h")))


def test_versioned_and_closed() -> None:
    assert SCHEMA["$id"] == "urn:fomas-verify:fomas-grid/1"
    assert SCHEMA["title"] == "fomas-grid/1"
    assert SCHEMA["additionalProperties"] is SCHEMA["properties"]["grid"]["additionalProperties"] is False
