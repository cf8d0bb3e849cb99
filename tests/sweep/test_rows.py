"""A row says what `prove` says, in floats that enclose."""

import math
import random
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fomas_verify.enclosure.interval import Interval
from fomas_verify.exact.rational import parse_rational
from fomas_verify.prover import prove
from fomas_verify.sweep import rows as module
from fomas_verify.sweep.grid import at_row, grid_from_mapping
from fomas_verify.sweep.plan import make_plan
from fomas_verify.sweep.rows import decide_rows, outward

from .conftest import PAPER

FAMILIES = ["directed-cycle", "path", "hypercube", "star"]
SWEPT = {"alpha": ["0.3", "1/2", "0.9"], "gamma": ["0.05", "0.3", "1", "3"], "h": ["0.4", "1", "2"]}


def plan_of(grid, **keys):
    return make_plan(grid_from_mapping({"grid": grid, **keys}))


def decided(plan):
    return list(decide_rows(plan, range(plan.grid.rows)))


@given(st.fractions(), st.fractions(min_value=0))
def test_floats_enclose(x: Fraction, width: Fraction) -> None:
    low, high = outward(Interval(x, x + width))
    assert Fraction(low) <= x <= x + width <= Fraction(high)
    assert math.nextafter(low, math.inf) > x
    assert math.nextafter(high, -math.inf) < x + width


def test_floats_enclose_what_no_float_reaches() -> None:
    huge, tiny = Fraction(10) ** 400, Fraction(1, 10**400)
    low, high = outward(Interval(-huge, huge))
    assert (low, high) == (-math.inf, math.inf)
    low, high = outward(Interval(huge, huge))
    assert 0 < low < high == math.inf
    assert outward(Interval(tiny, tiny)) == (0.0, 5e-324)


@pytest.mark.slow
@pytest.mark.parametrize("graph", [{"adjacency": PAPER}, None])
def test_a_sample_of_rows_is_what_prove_finds(graph) -> None:
    swept = SWEPT if graph else {**SWEPT, "family": FAMILIES, "agents": [2, 4]}
    plan = plan_of(swept, **({"graph": graph, "x0": ["4.5", 5, 6, "1.5", -1]} if graph else {}))
    found = decided(plan)
    each = plan.grid.rows_of_a_graph
    for row in random.Random(3).sample(range(plan.grid.rows), 5):
        design = at_row(plan.grid.design_on(row // each), plan.grid.numbers(row % each))
        proof = prove(design)
        verdicts = {f"verdict_{claim}": decision.verdict.value for claim, decision in proof.decisions.items()}
        assert verdicts.items() <= found[row].items()
        assert found[row]["status"] == proof.exit_status
        assert found[row]["row"] == row
        assert parse_rational(found[row]["gamma_exact"], what="gamma") == design.gamma
        for name, x in proof.values.items():
            lower, upper = Fraction(found[row][f"{name}_lower"]), Fraction(found[row][f"{name}_upper"])
            assert lower <= x.lower <= x.upper <= upper
            assert upper - lower <= abs(x.mid) * Fraction(1, 2**50) + Fraction(1, 2**60)


def test_the_papers_design_is_among_them() -> None:
    """mu = 0.13474..., sigma = 0.88129..., beta = 0.86525... (theory, section 3)."""
    plan = plan_of({"gamma": ["0.15", "0.2"], "h": ["0.85"]}, alpha="0.9", graph={"adjacency": PAPER})
    row = decided(plan)[0]
    assert row["mu_lower"] < Fraction("0.134740746183943825882") < row["mu_upper"]
    assert row["beta_lower"] < Fraction("0.865259253816056174117") < row["beta_upper"]
    assert row["sigma_lower"] < Fraction("0.881292727478182555") < row["sigma_upper"]
    assert row["lambda2_lower"] == row["lambda2_upper"] == 1
    assert (row["verdict_average-consensus"], row["verdict_control-norm-bound"]) == ("proved", "refuted")
    assert row["status"] == 0


def test_a_combination_that_is_no_design_is_a_row_of_status_2() -> None:
    found = decided(plan_of({"mu": ["0.1"], "family": ["hypercube"], "agents": [4, 5]}, alpha="0.9"))
    assert [row["status"] for row in found] == [0, 2]
    assert "expected a power of 2" in found[1]["message"]
    assert not any(key.startswith("verdict") for key in found[1])


def test_too_large_a_design_is_a_row_of_status_3() -> None:
    found = decided(plan_of({"mu": ["0.1"], "agents": [3, 9999]}, alpha="0.9", graph={"family": "star"}))
    assert [row["status"] for row in found] == [1, 3]


def test_an_internal_error_is_a_row_of_status_4(monkeypatch) -> None:
    def broken(design, **options):
        if design.mu == 2:
            raise ArithmeticError("lost\na bit")
        return prove(design, **options)

    monkeypatch.setattr(module, "prove", broken)
    found = decided(plan_of({"mu": ["0.1", 2, 3]}, alpha="0.9", graph={"family": "path", "agents": 3}))
    assert [row["status"] for row in found] == [1, 4, 1]
    assert found[1]["message"] == "ArithmeticError: lost a bit"


def test_only_some_claims() -> None:
    grid = grid_from_mapping({"grid": {"mu": ["0.1"]}, "alpha": "0.9", "graph": {"adjacency": PAPER}})
    plan = make_plan(grid, only=("repaired-condition", "gain-bound"))
    row = decided(plan)[0]
    assert {key for key in row if key.startswith("verdict")} == {"verdict_gain-bound", "verdict_repaired-condition"}
    assert row["status"] == 1
