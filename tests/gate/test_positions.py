"""Line and column of keys and entries, in TOML and JSON, sound and broken."""

import pytest

from fomas_verify.design import DesignError, parse_design
from fomas_verify.gate.model import Position
from fomas_verify.gate.positions import position_of, position_of_error

TOML = """\
# alpha = 1
name = "a = [graph] # no"
  alpha   = 2
x0 = [1, "2,]",
  3, [4,
      5]]
text = '''
mu = 7
[graph]
'''
settle_to."in".x = 1
limits = {h = [0.1, 2], gamma = {low = 1}}

[graph]  # here
edges = [[1, 2], [2, 1,
   "1/2"], [1, 3, -1]]
agents = 3

[ gate . more ]
require = ["a"]
[[graphs]]
family = 1
[[graphs]]
  family = 2
"""


@pytest.mark.parametrize(
    ("path", "line", "column"),
    [
        (("name",), 2, 1),
        (("alpha",), 3, 3),
        (("x0",), 4, 1),
        (("x0", 0), 4, 7),
        (("x0", 1), 4, 10),
        (("x0", 2), 5, 3),
        (("x0", 3), 5, 6),
        (("x0", 3, 1), 6, 7),
        (("settle_to",), 11, 1),
        (("settle_to", "in", "x"), 11, 15),
        (("limits", "h"), 12, 11),
        (("limits", "h", 1), 12, 21),
        (("limits", "gamma", "low"), 12, 34),
        (("graph",), 14, 2),
        (("graph", "edges", 1, 2), 16, 4),
        (("graph", "edges", 2, 2), 16, 19),
        (("graph", "agents"), 17, 1),
        (("gate", "more", "require", 0), 20, 12),
        (("graphs", 1, "family"), 24, 3),
        (("graph", "missing"), 14, 2),
        (("x0", 9), 4, 1),
        (("mu",), 1, 1),
        ((), 1, 1),
    ],
)
def test_toml(path: tuple[str | int, ...], line: int, column: int) -> None:
    assert position_of(TOML, "toml", path) == Position(line, column)


JSON = """\
{
  "alpha": "0.9", "x": {"alpha": [1, {"a": 2}]},
  "graph": {"edges": [[1, 2],
             [2, 1, "-1"]],
  "agents"
: 2}, "gate": {"require": [1, 2]}
}
"""


@pytest.mark.parametrize(
    ("path", "line", "column"),
    [
        (("alpha",), 2, 3),
        (("x", "alpha", 1, "a"), 2, 39),
        (("graph", "edges", 1), 4, 14),
        (("graph", "edges", 1, 2), 4, 21),
        (("graph", "agents"), 5, 3),
        (("gate", "require", 1), 6, 31),
        (("none",), 1, 1),
    ],
)
def test_json(path: tuple[str | int, ...], line: int, column: int) -> None:
    assert position_of(JSON, "json", path) == Position(line, column)


@pytest.mark.parametrize(
    ("text", "line", "column"),
    [
        ('alpha = 2\nmu = 1\n[graph]\nfamily = "path"\nagents = 2\n', 1, 1),
        ('mu = 1\nalfa = 0.9\n[graph]\nfamily = "path"\nagents = 2\n', 2, 1),
        ("alpha = 0.9\nmu = 1\n[graph]\nagents = 2\nedges = [[1, 2],\n  [2, 1, -1]]\n", 6, 10),
        ("alpha = 0.9\nmu = 1\n[graph]\nadjacency = [[0, 1],\n  [-1, 0]]\n", 5, 4),
        ('alpha = 0.9\nmu = 1\n\n  [graph]\nfamily = "path"\n', 4, 4),
        ("alpha = 0.9\nmu = 1\n", 1, 1),
        ('alpha = 0.9\n"a b" = 1\n', 1, 1),
        ("alpha = 0.9\nmu = = 1\n", 2, 6),
        (
            'alpha = 0.9\nmu = 1\n[graph]\nfamily = "path"\nagents = 2\n[gate]\nrequire = ["gain-bound",\n "gain"]\n',
            8,
            2,
        ),
    ],
)
def test_where_a_refusal_points(text: str, line: int, column: int) -> None:
    with pytest.raises(DesignError) as caught:
        parse_design(text, "toml", "d: x.toml")
    assert position_of_error(str(caught.value), "d: x.toml", text, "toml") == Position(line, column)


@pytest.mark.parametrize(
    "text",
    [
        "",
        "[",
        "]",
        "=",
        "a",
        "a =",
        "a = [",
        "a = {",
        "a = {b",
        "[[",
        "[[a",
        '"',
        '"""',
        "a = [[1, {b = ]",
        "}\n{",
        "a=,]",
    ],
)
@pytest.mark.parametrize("format_", ["toml", "json"])
def test_a_broken_text_is_answered_all_the_same(text: str, format_: str) -> None:
    assert position_of(text, format_, ("a", 0, "b")).line == 1


@pytest.mark.parametrize("unit", ["[", "{", "a={", "a=[", "[[", '"', "a.", "}", "]"])
def test_a_hostile_text_neither_hangs_nor_overflows(unit: str) -> None:
    for format_ in ("toml", "json"):
        assert position_of(unit * 50_000, format_, ("a",)).line == 1
    assert position_of("\n" * 2**21 + "alpha = 2", "toml", ("alpha",)) == Position()
