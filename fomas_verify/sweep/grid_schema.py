"""The JSON Schema of a grid file: that of a design, with what the table [grid] adds and what it leaves out.

It is made from the schema of the design, so that it cannot fall behind it.
"""

from __future__ import annotations

import json
from importlib.resources import files
from typing import Any, Final

from fomas_verify.design.model import MAX_LISTED_AGENTS
from fomas_verify.network import FAMILIES, SHAPED_FAMILIES
from fomas_verify.sweep.axes import MAX_LISTED, MAX_STEPS, RANGE
from fomas_verify.sweep.grid import OF_GRAPHS

Schema = dict[str, Any]

NUMBERS: Final = {
    "alpha": ("share", "Order of the Caputo derivative, between 0 and 1"),
    "gamma": ("positive", "Control gain"),
    "mu": ("positive", "Integrated gain gamma h^alpha / Gamma(alpha + 1), in place of gamma"),
    "h": ("positive", "Sampling period in seconds"),
}
"""The numbers that may be swept: what each is, and its words."""

NAMES: Final = [*FAMILIES, *SHAPED_FAMILIES]
SHAPE: Final = {"type": "array", "items": {"type": "integer", "minimum": 1}, "minItems": 2, "maxItems": 2}


def grid_schema() -> Schema:
    """The schema, of draft 7.

    What the reader of grids accepts is valid. What is valid may still be refused for what JSON Schema cannot say, such
    as a range that ends before it begins.
    """
    found: Schema = json.loads(files("fomas_verify.design").joinpath("design.schema.json").read_text("utf-8"))
    single = {name: {**_ref(kind), "description": f"{words}."} for name, (kind, words) in NUMBERS.items()}
    del found["oneOf"], found["properties"]["graphs"]
    found["definitions"]["agents"]["maximum"] = MAX_LISTED_AGENTS
    found |= {
        "$id": "urn:fomas-verify:fomas-grid/1",
        "title": "fomas-grid/1",
        "description": "For verify-design sweep: a design, and in [grid] what is swept and stands nowhere else.",
        "required": ["grid"],
        "properties": {**found["properties"], **single, "graph": True, "grid": _grid()},
        "allOf": [*found["allOf"], *_numbers(), *_graph(found["definitions"]["graph"]["oneOf"])],
    }
    return found


def _ref(name: str) -> Schema:
    return {"allOf": [{"$ref": f"#/definitions/{name}"}]}


def _grid() -> Schema:
    """The table [grid]."""
    properties = {
        name: {"description": f"{words}: a list or a range of it.", "anyOf": [_list(_ref(kind)), _range(_ref(kind))]}
        for name, (kind, words) in NUMBERS.items()
    }
    properties |= {
        "family": {"description": "Families of graphs.", **_list({"enum": NAMES})},
        "agents": {
            "description": "Numbers of agents, of every family but torus and grid: a list or a range of integers.",
            "anyOf": [_list(_ref("agents")), _range(_ref("positive"))],
        },
        "shape": {
            "description": "Shapes [rows, columns] of torus and grid.",
            **_list(SHAPE),
        },
    }
    return {
        "type": "object",
        "additionalProperties": False,
        "minProperties": 1,
        "not": {"required": ["gamma", "mu"]},
        "properties": properties,
        "description": "What is swept: every combination of these is a design.",
    }


def _list(item: Schema) -> Schema:
    return {"type": "array", "minItems": 1, "maxItems": MAX_LISTED, "uniqueItems": True, "items": item}


def _range(end: Schema) -> Schema:
    """Both ends are values, and the others are at equal distances."""
    steps = {"type": "integer", "minimum": 2, "maximum": MAX_STEPS}
    properties = dict(zip(RANGE, (end, end, steps), strict=True))
    return {"type": "object", "additionalProperties": False, "required": list(RANGE), "properties": properties}


def _swept(*names: str) -> Schema:
    return {"required": ["grid"], "properties": {"grid": {"required": list(names)}}}


def _given(name: str) -> Schema:
    """A number stands in [grid] or above it."""
    return {"anyOf": [{"required": [name]}, _swept(name)]}


def _numbers() -> list[Schema]:
    """Each number in one place; alpha, and mu or gamma and h."""
    once = [{"not": {"allOf": [{"required": [name]}, _swept(name)]}} for name in NUMBERS]
    one_gain = {"not": {"allOf": [_given("gamma"), _given("mu")]}}
    return [*once, one_gain, _given("alpha"), {"anyOf": [_given("mu"), {"allOf": [_given("gamma"), _given("h")]}]}]


def _graph(forms: list[Schema]) -> list[Schema]:
    """The table [graph] is that of a design; where graphs are swept it has the other keys only, and no file."""
    edges = next(form["properties"]["edges"] for form in forms if "edges" in form["properties"])
    of_a_design = {"required": ["graph"], "properties": {"graph": {"$ref": "#/definitions/graph"}}}
    beside = {"agents": _ref("agents"), "shape": SHAPE, "family": {"enum": NAMES}}
    rest = {"type": "object", "additionalProperties": False, "properties": {**beside, "edges": edges}}
    graphs_are_swept = {"anyOf": [_swept(name) for name in OF_GRAPHS]}
    return [
        {"if": graphs_are_swept, "then": {"properties": {"graph": rest}}, "else": of_a_design},
        *({"if": _swept(name), "then": {"properties": {"graph": {"properties": {name: False}}}}} for name in OF_GRAPHS),
    ]
