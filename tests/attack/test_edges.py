"""The checker at the edges where rounding, size and equality could mislead it; expected answers by hand."""

from __future__ import annotations

import json
from fractions import Fraction
from typing import Any

import pytest
from mpmath import mp

from . import oracle
from .adapter import check_status
from .designs import NAMED
from .digits import ratio
from .form import STATEMENTS

pytestmark = pytest.mark.slow

F = Fraction


def of(handmade: dict[str, bytes], name: str, *claims: dict[str, Any], **values: Any) -> dict[str, Any]:
    """The certificate of a named design with other claims (those by hand, if none) and values."""
    tree: dict[str, Any] = json.loads(handmade[name])
    return {**tree, "values": values, "claims": list(claims) or tree["claims"]}


def claim(name: str, verdict: str, **witness: Any) -> dict[str, Any]:
    return {"id": name, "verdict": verdict, "statement": STATEMENTS[name], "witness": witness}


def status(tree: dict[str, Any]) -> int:
    return check_status(json.dumps(tree).encode())


@pytest.mark.parametrize("power", [5, 10, 5 * 2**50, 5 * 2**200, 2**255])
def test_the_trace_of_a_permutation_never_exceeds(handmade, power):
    growth = claim("perron-eigenvalues", "refuted", mu="1", power=power)
    assert status(of(handmade, "directed-cycle-5-tie", growth)) in (1, 3)


@pytest.mark.parametrize("power", [5, 5 * 2**20, 5 * 2**100, 5 * 2**200, 2**256])
def test_no_growth_from_rounding_just_inside(handmade, power):
    mu = ratio(NAMED["directed-cycle-5-just-inside"].mu)
    growth = claim("perron-eigenvalues", "refuted", mu=mu, power=power)
    assert status(of(handmade, "directed-cycle-5-just-inside", growth)) in (1, 3)


def test_growth_just_outside_is_seen(handmade):
    mu = ratio(NAMED["directed-cycle-5-just-outside"].mu)
    growth = claim("perron-eigenvalues", "refuted", mu=mu, power=5 * 2**205)
    assert status(of(handmade, "directed-cycle-5-just-outside", growth)) == 0


@pytest.mark.parametrize("exponent", [50, 300, 1000])
@pytest.mark.parametrize(("name", "sigma"), [("k44", "9/10"), ("c4-third", "1/3"), ("k2-swap", "1")])
def test_sigma_to_a_thousand_digits(handmade, name, sigma, exponent):
    step = F(1, 10**exponent)
    for shift, answer in ((-step, 0), (F(0), 0), (step, 1)):
        below = {"lower": ratio(F(sigma) + shift), "upper": "2"}
        above = {"lower": "-2", "upper": ratio(F(sigma) - shift)}
        assert [status(of(handmade, name, sigma=ends)) for ends in (below, above)] == [answer, answer]


@pytest.mark.parametrize("key", ["mu", "threshold"])
@pytest.mark.parametrize("name", ["paper", "h-beyond-floats", "gamma-fraction"])
def test_powers_to_a_thousand_digits(handmade, name, key):
    with mp.workdps(1100):
        scaled = {"mu": oracle.mu, "threshold": oracle.threshold}[key](NAMED[name], 1100) * mp.mpf(10) ** 1000
        floor = int(mp.floor(scaled))
    ends = [ratio(F(floor + k, 10**1000)) for k in (-1, 0, 1, 2)]
    answers = [status(of(handmade, name, **{key: {"lower": ends[i], "upper": ends[j]}})) for i, j in ((1, 2), (0, 3))]
    assert answers == [0, 0]
    answers = [status(of(handmade, name, **{key: {"lower": ends[i], "upper": ends[j]}})) for i, j in ((2, 3), (0, 1))]
    assert answers == [1, 1]


def test_equality_at_an_irrational_gain_is_not_taken_for_excess(handmade):
    vector = claim("beta-contraction", "refuted", e=["0", "1", "-1", "0", "0", "0"])
    assert status(of(handmade, "star6", vector)) in (1, 3)


@pytest.mark.parametrize("agents", [10**4, 10**9, 10**30])
def test_agents_beyond_memory_build_no_matrix(handmade, agents):
    tree = of(handmade, "no-edges", claim("graph-assumption", "refuted", unreachable=[1, 2]))
    tree["design"]["agents"] = agents
    assert status(tree) in (0, 3)


@pytest.mark.parametrize("exponent", [30, 200, 3000])
def test_a_form_over_many_orders_of_magnitude(handmade, exponent):
    tree = of(handmade, "no-edges")
    tree["design"].update(agents=4, edges=[[2, 1, "1"], [3, 2, "1"], [4, 3, "1"]], mu="19/10")
    small = [ratio(F(1, 10 ** (k * exponent))) for k in (2, 1, 0)]
    rows = [[small[0]], ["0", small[1]], ["0", "0", small[2]]]
    tree["claims"] = [claim("perron-eigenvalues", "proved", mu="19/10", Q=rows)]
    assert status(tree) == 0
    rows[0], rows[2][2] = [small[2]], small[0]
    assert status(tree) == 1
