"""Valid designs, each number exact, in TOML, JSON and from Python."""

import json
from fractions import Fraction
from pathlib import Path

import pytest

from fomas_verify.design import (
    CLAIM_IDS,
    DEFAULT_REQUIRE,
    Design,
    UncertainDesign,
    design_from_mapping,
    parse_design,
    read_design,
)
from fomas_verify.design.document import MAX_NESTING, parse_document
from fomas_verify.design.reading import any_from_mapping
from fomas_verify.enclosure.interval import Interval

PAPER = """
name  = "paper"
alpha = 0.9
gamma = 0.15
h     = 0.85
x0    = [4.5, 5, 6, 1.5, -1]
horizon = 1000
[graph]
adjacency = [[0,0,0,1,1], [1,0,1,0,0], [1,1,0,0,0], [0,1,1,0,0], [0,0,0,1,0]]
"""
# (i, j) where agent i hears agent j, read off the matrix above.
HEARS = {(1, 4), (1, 5), (2, 1), (2, 3), (3, 1), (3, 2), (4, 2), (4, 3), (5, 4)}
GRAPH = {"family": "path", "agents": 3}


def design(**keys: object) -> Design:
    return design_from_mapping({"alpha": "1/2", "graph": GRAPH, **keys})


def test_the_paper_design() -> None:
    paper = parse_design(PAPER, "toml", "examples/paper.toml")
    assert (paper.name, paper.source, paper.horizon, paper.notes) == ("paper", "examples/paper.toml", 1000, ())
    assert (paper.alpha, paper.gamma, paper.h, paper.mu) == (Fraction(9, 10), Fraction(3, 20), Fraction(17, 20), None)
    assert paper.components == ((Fraction(9, 2), 5, 6, Fraction(3, 2), -1),)
    assert paper.graph.agents == 5
    assert {(target, source) for source, target, _ in paper.graph.edges} == HEARS
    assert {weight for *_, weight in paper.graph.edges} == {1}
    assert paper.require == DEFAULT_REQUIRE


def test_edges_say_that_to_hears_from() -> None:
    edges = [[hears, agent] for agent, hears in HEARS]
    from_edges = design_from_mapping({"alpha": "9/10", "graph": {"agents": 5, "edges": edges}})
    assert from_edges.graph == parse_design(PAPER, "toml", "paper").graph


def test_json_reads_as_toml_does() -> None:
    keys = {"alpha": 0.9, "gamma": 0.15, "h": 0.85, "x0": [4.5, 5, 6, 1.5, -1], "horizon": 1000, "name": "paper"}
    adjacency = [[int((i, j) in HEARS) for j in range(1, 6)] for i in range(1, 6)]
    text = json.dumps({**keys, "graph": {"adjacency": adjacency}})
    assert parse_design(text, "json", "paper") == parse_design(PAPER, "toml", "paper")


@pytest.mark.parametrize(
    ("literal", "mu"),
    [
        ("0.1", Fraction(1, 10)),
        ('"1/10"', Fraction(1, 10)),
        ("0.1000000000000000055511151231257827", Fraction(1000000000000000055511151231257827, 10**34)),
        ("1e-3", Fraction(1, 1000)),
        ('"+1"', Fraction(1)),
        ("+1.5E+2", Fraction(150)),
        ("1_000.5", Fraction(2001, 2)),
        ("0x10", Fraction(16)),
        ("7", Fraction(7)),
        ('"1e-400"', Fraction(1, 10**400)),
    ],
)
def test_numbers_are_read_exactly(literal: str, mu: Fraction) -> None:
    text = f'alpha = 0.5\nmu = {literal}\n[graph]\nfamily = "path"\nagents = 3\n'
    assert parse_design(text, "toml", "a.toml").mu == mu


def test_python_floats_are_shortest_decimals_and_noted() -> None:
    noted = design(mu=0.1, x0=[0.1, 1, "0.3"])
    assert noted.mu == Fraction(1, 10)
    assert noted.x0 == ((Fraction(1, 10),), (1,), (Fraction(3, 10),))
    assert noted.notes == ("mu, x0: binary floats are read as their shortest decimals (0.1 is 1/10)",)
    assert design(mu=Fraction(1, 3)).mu == Fraction(1, 3)
    weighted = design_from_mapping({"alpha": 0.5, "graph": {"adjacency": [[0, 0.25], [1, 0]]}})
    assert weighted.graph.edges == ((1, 2, Fraction(1)), (2, 1, Fraction(1, 4)))
    assert weighted.notes[0].startswith("alpha, graph: binary floats")


def test_the_largest_and_finest_numbers_allowed() -> None:
    assert design(mu=Fraction(2**4096 - 1)).mu == 2**4096 - 1
    assert design(alpha=Fraction(1, 2**64 - 1)).alpha.denominator == 2**64 - 1
    weight = Fraction(1, 2**255)
    graph = design(graph={"agents": 2, "edges": [[1, 2, weight], [2, 1, "1/2"]]}).graph
    assert graph.edges[0] == (1, 2, weight)


def test_optional_keys_and_their_defaults() -> None:
    bare = design()
    assert (bare.gamma, bare.mu, bare.h, bare.x0, bare.horizon, bare.require) == (None,) * 5 + (DEFAULT_REQUIRE,)
    assert design(gate={}).require == DEFAULT_REQUIRE
    assert design(gate={"require": ["beta-contraction"]}).require == ("beta-contraction",)
    assert design(x0=[[1], [2], [3]]).x0 == design(x0=[1, 2, 3]).x0 == ((1,), (2,), (3,))
    assert design(x0=[[1, 0], [2, "1/2"], [3, 7]]).components == ((1, 2, 3), (0, Fraction(1, 2), 7))
    assert design(format="fomas-design/1", horizon=0).horizon == 0
    assert set(DEFAULT_REQUIRE) < set(CLAIM_IDS)
    assert len(set(CLAIM_IDS)) == 10


def test_a_graph_without_edges_is_a_graph() -> None:
    assert design(graph={"agents": 2, "edges": []}).graph.edges == ()
    assert design(graph={"adjacency": [[0, "0.0"], [0, 0]]}).graph.edges == ()


def test_a_shape_and_the_agents_that_agree_with_it() -> None:
    graph = {"family": "grid", "shape": [2, 3]}
    assert design(graph={**graph, "agents": 6}) == design(graph=graph)


@pytest.mark.parametrize(
    ("file", "text"),
    [
        ("ring.toml", 'alpha = 0.5\n[graph]\nfamily = "path"\nagents = 3'),
        ("ring.TOML", 'alpha = 0.5\n[graph]\nfamily = "path"\nagents = 3'),
        ("ring.json", '{"alpha": 0.5, "graph": {"family": "path", "agents": 3}}'),
        ("ring.txt", '\n {"alpha": 0.5, "graph": {"family": "path", "agents": 3}}'),
        ("ring", 'alpha = 0.5\r\n[graph]\r\nfamily = "path"\r\nagents = 3\r\n'),
    ],
)
def test_the_format_is_known_by_extension_then_content(tmp_path: Path, file: str, text: str) -> None:
    path = tmp_path / file
    path.write_bytes(text.encode())
    found = read_design(path)
    assert (found.name, found.source, found.alpha) == ("ring", str(path), Fraction(1, 2))
    assert found.graph == design().graph


def test_a_name_that_is_no_name_for_a_file_is_not_taken_over(tmp_path: Path) -> None:
    path = tmp_path / "two\nlines.json"
    path.write_text('{"alpha": 0.5, "graph": {"family": "path", "agents": 3}}')
    assert read_design(path).name.isprintable()


def test_brackets_in_strings_and_comments_are_no_nesting() -> None:
    many = "[{" * (2 * MAX_NESTING)
    text = f"a = '{many}' # {many}\nb = \"\\\"{many}\"\nc = '''\n{many}'''''\nd = \"\"\"\n\\\"{many}\"\"\"\n"
    assert parse_document(text, "toml", "a.toml")["a"] == many
    assert parse_document(json.dumps({"a": '"' + many}), "json", "a.json") == {"a": '"' + many}


def test_nesting_up_to_the_limit_is_parsed() -> None:
    deepest = "[" * (MAX_NESTING - 1) + "]" * (MAX_NESTING - 1)
    assert parse_document(f'{{"a": {deepest}}}', "json", "a.json").keys() == {"a"}
    assert parse_document(f"a = {deepest}", "toml", "a.toml").keys() == {"a"}


def test_many_decimals_and_dotted_keys_are_no_nesting() -> None:
    many = 3 * MAX_NESTING
    assert len(parse_document("a = [" + "0.5, " * many + "]", "toml", "a.toml")["a"]) == many
    assert len(parse_document("".join(f"a{i}.b = 1.5\n" for i in range(many)), "toml", "a.toml")) == many


def test_an_uncertain_design_keeps_its_intervals_exactly() -> None:
    table = {"alpha": ["0.88", 0.92], "gamma": [0.1, "1/5"], "h": 0.85, "graph": {"family": "path", "agents": 3}}
    found = any_from_mapping(table, "a.toml")
    assert isinstance(found, UncertainDesign)
    assert found.ranges == {
        "alpha": Interval(Fraction(22, 25), Fraction(23, 25)),
        "gamma": Interval(Fraction(1, 10), Fraction(1, 5)),
    }
    assert found.range_of("h") == Interval.exactly(Fraction(17, 20))
    assert found.range_of("mu") is None
    member = found.member(Fraction(9, 10), Fraction(1, 4))
    assert (member.alpha, member.gamma, member.h) == (Fraction(9, 10), Fraction(1, 8), Fraction(17, 20))
    assert found.least.notes == ("alpha, gamma, h: binary floats are read as their shortest decimals (0.1 is 1/10)",)
    assert isinstance(any_from_mapping(table | {"alpha": 0.9, "gamma": 0.1}), Design)
