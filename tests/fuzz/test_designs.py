"""Whatever the text, reading it gives a design or the refusal of one in one line, never another exception."""

import json
from typing import Literal

from hypothesis import given
from hypothesis import strategies as st

from fomas_verify.design import Design, DesignError, design_from_mapping, parse_design

SEED = """format = "fomas-design/1"
name = "paper"
alpha = 0.9
gamma = "3/20"
h = 85e-2
x0 = [4.5, 5, 6]
horizon = 1000
[graph]
agents = 3
edges = [[1,2], [2,3,"1/2"], [3,1,2]]
[gate]
require = ["gain-bound"]
"""
FRAGMENTS = [
    *'[]{}"\\.=\n\r-e_\0\ud800',
    "[[",
    '"""',
    "'''",
    "nan",
    "inf",
    "true",
    "1e9999",
    "9" * 4400,
    "0x" + "f" * 5000,
]
FRAGMENTS += ["alpha", "mu = 1", "graph.", "adjacency", "family", 'family = "torus"', "2024-13-01"]
KEYS = ["name", "alpha", "gamma", "mu", "h", "x0", "horizon", "graph", "gate", "format", "adjacency", "edges", "agents"]
KEYS += ["family", "shape", "require", "file", "limits"]
LEAVES = st.one_of(
    st.none(),
    st.booleans(),
    st.integers(),
    st.floats(),
    st.text(max_size=8),
    st.sampled_from([1, 2, 3, "1/2", 0.9, "path", "torus", "gain-bound", 10**4200, "1e5000", []]),
)
TREES = st.recursive(
    LEAVES,
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.sampled_from(KEYS) | st.text(max_size=3), inner),
    max_leaves=12,
)
TABLES = st.dictionaries(st.sampled_from(KEYS), TREES)


def outcome(text: str, format_: Literal["toml", "json"]) -> Design | str:
    try:
        return parse_design(text, format_, "a.design")
    except DesignError as error:
        return one_line(error)


def one_line(error: DesignError) -> str:
    message = str(error)
    assert message.isprintable()
    assert message.startswith("a.design: ")
    assert len(message) < 500
    return message


def test_the_seed_is_a_design() -> None:
    assert isinstance(outcome(SEED, "toml"), Design)


@given(st.text(), st.sampled_from(["toml", "json"]))
def test_random_text(text: str, format_: Literal["toml", "json"]) -> None:
    outcome(text, format_)


@given(st.lists(st.tuples(st.integers(0, len(SEED)), st.integers(0, 12), st.sampled_from(FRAGMENTS)), max_size=4))
def test_mutated_toml(edits: list[tuple[int, int, str]]) -> None:
    text = SEED
    for start, length, fragment in edits:
        text = text[:start] + fragment + text[start + length :]
    outcome(text, "toml")


@given(st.text(st.sampled_from('[]{}":,.0123456789eE+-_/ \n\\tfnalphmug'), max_size=60))
def test_text_of_structure_characters(text: str) -> None:
    outcome(text, "toml")
    outcome(text, "json")
    outcome('{"alpha": ' + text + "}", "json")


@given(TABLES)
def test_tables_with_known_keys(table: dict[str, object]) -> None:
    for candidate in (table, {**table, "alpha": "1/2", "graph": {"family": "path", "agents": 3}}):
        try:
            design = design_from_mapping(candidate, "a.design")
        except DesignError as error:
            one_line(error)
        else:
            assert 0 < design.alpha < 1


@given(TABLES)
def test_a_graph_is_a_graph_or_is_refused(table: dict[str, object]) -> None:
    try:
        graph = design_from_mapping({"alpha": "1/2", "graph": table}, "a.design").graph
    except DesignError as error:
        one_line(error)
    else:
        assert 2 <= graph.agents <= 10_000
        assert list(graph.edges) == sorted({edge[:2]: edge for edge in graph.edges}.values())


@given(st.recursive(st.integers() | st.floats(allow_nan=False, allow_infinity=False), st.lists, max_leaves=8))
def test_json_and_mapping_agree(x0: object) -> None:
    table = {"alpha": "1/2", "graph": {"family": "path", "agents": 2}, "x0": x0}
    try:
        expected: object = design_from_mapping(table, "a.design").x0
    except DesignError as error:
        expected = str(error)
    found = outcome(json.dumps(table), "json")
    assert (found.x0 if isinstance(found, Design) else found) == expected
