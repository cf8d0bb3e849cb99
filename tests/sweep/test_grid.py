"""Which designs a grid is, and which grids are refused."""

from fractions import Fraction

import pytest

from fomas_verify.design import DesignError
from fomas_verify.design.document import parse_document
from fomas_verify.sweep.errors import SweepError
from fomas_verify.sweep.grid import grid_from_mapping
from fomas_verify.sweep.plan import make_plan

RING = {"family": "cycle", "agents": 5}


def grid(swept, **keys):
    return grid_from_mapping({"grid": swept, "alpha": "0.9", "graph": RING, **keys}, "g.toml")


def test_the_range_of_the_contract_is_exact() -> None:
    text = '[grid]\nalpha = {from = "0.5", to = "0.99", steps = 50}\n[graph]\nfamily = "cycle"\nagents = 5\n'
    found = grid_from_mapping(parse_document("mu = 0.1\n" + text, "toml", "g.toml"), "g.toml")
    assert [found.numbers(row)["alpha"] for row in range(found.rows)] == [Fraction(n, 100) for n in range(50, 100)]


def test_rows_run_through_every_combination_once() -> None:
    found = grid(
        {"h": [1, 2, 3], "gamma": ["0.1", "1/3"], "family": ["path", "torus"], "agents": [4, 9]},
        graph={"shape": [3, 3]},
    )
    each = found.rows_of_a_graph
    met = [(row // each, *found.numbers(row % each).values()) for row in range(found.rows)]
    assert len(met) == len(set(met)) == 3 * 2 * 3
    assert met == sorted(met)
    assert [found.graph_value(i, "agents") for i in range(3)] == [4, 9, 9]
    assert [found.design_on(i).graph.agents for i in range(3)] == [4, 9, 9]


def test_a_grid_file_is_a_design_without_what_is_swept() -> None:
    found = grid({"mu": ["0.1"]}, x0=[1, 2, 3, 4, 5], gate={"require": ["gain-bound"]})
    assert found.design_on(0).require == ("gain-bound",)


@pytest.mark.parametrize(
    ("swept", "keys", "words"),
    [
        (None, {}, "grid: expected a table"),
        ({}, {}, "grid: expected at least one of alpha"),
        ({"alfa": [1]}, {}, "grid.alfa: unknown key; did you mean alpha"),
        ({"mu": []}, {}, "grid.mu: expected a list of 1 to 10000 values"),
        ({"mu": 1}, {}, "grid.mu: expected a list, or a range"),
        ({"mu": ["0.1", "1/10"]}, {}, r"grid.mu\[1\]: expected each value once, got '1/10'"),
        ({"mu": ["0.1", 0]}, {}, r"grid.mu\[1\]: expected a number > 0, got 0"),
        ({"mu": ["nan"]}, {}, r"grid.mu\[0\]: expected a decimal or a fraction"),
        ({"alpha": ["1.2"], "mu": [1]}, {"alpha": None}, r"grid.alpha\[0\]: expected a number between 0 and 1"),
        ({"alpha": ["0.5"], "mu": [1]}, {}, "grid.alpha: expected alpha either in .grid. or above it, got both"),
        ({"mu": {"from": 2, "to": 1, "steps": 3}}, {}, "grid.mu.to: expected a number above 2"),
        ({"mu": {"from": 1, "to": 2, "steps": 1}}, {}, "grid.mu.steps: expected an integer >= 2"),
        ({"mu": {"from": 1, "steps": 2}}, {}, "grid.mu.to: expected a number"),
        ({"mu": {"from": 1, "to": 2, "step": 2}}, {}, "grid.mu.step: unknown key; did you mean steps"),
        ({"gamma": [1], "mu": [1]}, {}, "mu: expected either gamma or mu, got both"),
        ({"gamma": [1]}, {}, "h: sweep needs mu, or gamma and h"),
        ({"mu": [1], "agents": [3]}, {}, "grid.agents: expected agents either in .grid. or in .graph., got both"),
        ({"mu": [1], "family": ["cube"]}, {"graph": {"agents": 4}}, r"family\[0\]: .* did you mean hypercube"),
        ({"mu": [1], "family": ["path"]}, {"graph": {}}, "graph.agents: expected an integer >= 2, got nothing"),
        ({"mu": [1], "agents": [1]}, {"graph": {"family": "path"}}, r"grid.agents\[0\]: expected an integer >= 2"),
        ({"mu": [1], "agents": {"from": 2, "to": 5, "steps": 3}}, {"graph": {"family": "path"}}, "a range of integers"),
        ({"mu": [1], "family": ["path"]}, {"graph": {"agents": 3, "edges": [[1, 2]]}}, "graph: expected exactly one"),
        ({"mu": [1], "agents": [3, 5]}, {"graph": {"family": "hypercube"}}, "expected a power of 2"),
        ({"mu": [1]}, {"x0": [1, 2]}, "x0: expected a list of 5 numbers"),
        ({"mu": [1]}, {"beta": 2}, "beta: unknown key"),
        ({"mu": [1]}, {"alpha": ["0.5", "0.6"]}, "alpha: expected a number, got an interval"),
        ({"mu": [1]}, {"graph": None, "graphs": [RING]}, "graphs: expected one .graph."),
    ],
)  # fmt: skip
def test_refused(swept, keys, words) -> None:
    mapping = {"grid": swept, "alpha": "0.9", "graph": RING, **keys}
    with pytest.raises(DesignError, match=words) as caught:
        grid_from_mapping({key: value for key, value in mapping.items() if value is not None}, "g.toml")
    assert str(caught.value).startswith("g.toml: ")
    assert "\n" not in str(caught.value)


def test_too_many_rows_are_refused_with_their_number() -> None:
    found = grid({"gamma": {"from": 1, "to": 2, "steps": 10**5}, "h": {"from": 1, "to": 2, "steps": 10**4}})
    with pytest.raises(SweepError, match=r"at most 1000000 rows, got 1000000000 \(100000 gamma x 10000 h\)"):
        make_plan(found)
    assert make_plan(found, most_rows=10**9).parts == 10**5


def test_a_plan_is_told_apart_by_everything_that_makes_its_rows() -> None:
    plans = [
        make_plan(grid({"mu": ["0.1", "0.2"]})),
        make_plan(grid({"mu": ["0.1", "0.3"]})),
        make_plan(grid({"mu": ["0.1", "0.2"]}, alpha="0.8")),
        make_plan(grid({"mu": ["0.1", "0.2"]}), only=("gain-bound",)),
        make_plan(grid({"mu": ["0.1", "0.2"]}), part_rows=1),
    ]
    assert len({plan.digest for plan in plans}) == len(plans)
    assert plans[0].digest == make_plan(grid({"mu": ["1/10", "0.20"]})).digest


def test_claims_about_x0_need_one() -> None:
    with pytest.raises(DesignError, match="x0: trajectory-norm-bound is about x0"):
        make_plan(grid({"mu": [1]}), only=("trajectory-norm-bound",))
