"""The judge of margins against numbers known by hand, and margins that are a little too wide."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from typing import Any

import pytest
from mpmath import mp

from . import margins
from .alpha_range import gain_span, truth_over, turning_point
from .designs import BROKEN, PUBLISHED, TIES, complete, path
from .handmade_margins import margins as made_by_hand
from .model import Design

F = Fraction
PAPER = PUBLISHED["paper"]
STEP = F(1, 10**30)
NOTHING = {"inner": (F(0), F(1)), "outer": (None, None)}


def moved(ends: tuple[Fraction, Fraction], which: int, by: Fraction) -> tuple[Fraction, Fraction]:
    return (ends[0] + by, ends[1]) if which == 0 else (ends[0], ends[1] + by)


def number(text: str) -> Fraction:
    return F(text)


# docs/theory section 5: sigma <= 2^alpha - 1 on [0.15678262217..., 0.39651947232...] for the paper's graph; the gain
# bound ends at 1/2; beta = 1 - mu, so (14) holds from 2 - 2^0.9 = 0.13393401692638516804...
PAPER_ENDS = {
    "gain-bound": (("0", "0.5"), ("0", "0.5")),
    "memory-inequality": (("0.133934016926386", "1.9"), ("0.133934016926385", "2")),
    "repaired-condition": (("0.15678262218", "0.39651947232"), ("0.15678262217", "0.39651947233")),
}


def entry(inner: tuple[str, str], outer: tuple[str, str]) -> dict[str, Any]:
    return {"inner": tuple(map(F, inner)), "outer": tuple(map(F, outer))}


@pytest.mark.parametrize("claim", PAPER_ENDS)
def test_published_ends_of_the_paper(claim):
    good = entry(*PAPER_ENDS[claim])
    assert margins.holds(PAPER, {claim: {"mu": good}}) is True
    for key, sign in (("inner", 1), ("outer", -1)):
        for which in (0, 1):
            if claim == "gain-bound" and which == 0:
                continue
            by = (1 if which else -1) * sign * F(1, 5)
            assert margins.holds(PAPER, {claim: {"mu": {**good, key: moved(good[key], which, by)}}}) is False


def _complete_ends(n: int, alpha: Fraction) -> dict[str, tuple[Any, Any]]:
    """K_N has the eigenvalues 0 and N: beta = sigma's signed value = 1 - mu N."""
    a = mp.mpf(alpha.numerator) / alpha.denominator
    two, three = mp.mpf(2) ** a, mp.mpf(3) ** a
    return {
        "memory-inequality": ((2 - two) / n, (1 + mp.sqrt(three - two)) / n),
        "repaired-condition": ((2 - two) / n, two / n),
    }


@pytest.mark.parametrize("claim", ["memory-inequality", "repaired-condition"])
@pytest.mark.parametrize("n", [2, 3, 5])
@pytest.mark.parametrize("alpha", [F(1, 3), F(9, 10), F(1, 50)])
def test_ends_of_complete_graphs(claim, n, alpha):
    design = Design(alpha, n, complete(n), mu=F(1, n))
    with mp.workdps(80):
        low, high = (F(int(mp.nint(x * 10**40)), 10**40) for x in _complete_ends(n, alpha)[claim])
    good = {"inner": (low + STEP, high - STEP), "outer": (low - STEP, high + STEP)}
    assert margins.holds(design, {claim: {"mu": good}}) is True
    for key, which in (("inner", 0), ("inner", 1), ("outer", 0), ("outer", 1)):
        by = 2 * STEP * (-1 if (key == "inner") == (which == 0) else 1)
        assert margins.holds(design, {claim: {"mu": {**good, key: moved(good[key], which, by)}}}) is False


def test_an_end_that_is_a_tie():  # P4 at alpha = 1/2: (14) begins at mu = 1 exactly
    p4 = TIES["p4-root-tie"]
    good = {"inner": (F(1), F(2)), "outer": (F(1), F(3))}
    assert margins.holds(p4, {"memory-inequality": {"mu": good}}) is True
    for ends in ({"inner": (1 - STEP, F(2))}, {"outer": (1 + STEP, F(3))}, {"inner": (F(1), F(4))}):
        assert margins.holds(p4, {"memory-inequality": {"mu": {**good, **ends}}}) is False


def test_two_agents_stay_stable_below_one():  # P is 1 - 2 mu on 1perp
    k2 = TIES["k2-deadbeat"]
    good = {"inner": (F(0), F(99, 100)), "outer": (F(0), F(1)), "Q": [[F(1)]], "Y": [[F(1)]]}
    assert margins.holds(k2, {"perron-eigenvalues": {"mu": good}}) is True
    false = (
        {"inner": (F(0), F(1))},
        {"outer": (F(0), F(999, 1000))},
        {"outer": (F(1, 100), F(1)), "inner": (F(1, 10), F(1, 2))},
        {"Q": [[F(-1)]]},
        {"Y": [[F(0)]]},
    )
    for change in false:
        assert margins.holds(k2, {"perron-eigenvalues": {"mu": {**good, **change}}}) is False


def test_alpha_of_two_agents():
    """K2 at mu = 1/10: beta = 4/5, so (14) holds from 2^alpha = 9/5, alpha = log2(9/5) = 0.84799690655495..."""
    design = Design(F(9, 10), 2, path(2), mu=F(1, 10))
    good = {"inner": (F("0.848"), F(1)), "outer": (F("0.847996"), None)}
    assert margins.holds(design, {"memory-inequality": {"alpha": good}}) is True
    assert margins.holds(design, {"memory-inequality": {"alpha": {**good, "inner": (F("0.8479969"), F(1))}}}) is False
    assert margins.holds(design, {"memory-inequality": {"alpha": {**good, "outer": (F("0.8479970"), None)}}}) is False
    below = replace(design, alpha=F(1, 2))
    good = {"inner": (F(0), F("0.847996")), "outer": (None, F("0.848"))}
    assert margins.holds(below, {"memory-inequality": {"alpha": good}}) is True
    assert margins.holds(below, {"memory-inequality": {"alpha": {**good, "inner": (F(0), F("0.848"))}}}) is False
    assert margins.holds(below, {"memory-inequality": {"alpha": {**good, "outer": (None, F("0.847996"))}}}) is False


def test_the_gain_is_largest_between_the_ends_where_h_is_near_one():
    """At h = 1 mu = gamma/Gamma(alpha + 1), largest where Gamma is least, at alpha = 0.4616321449683623..."""
    design = Design(F(1, 2), 2, path(2), gamma=F(1), h=F(1))
    with mp.workdps(60):
        assert mp.nstr(turning_point(F(1)), 19) == "0.4616321449683623413"
        low, high = gain_span(design, mp.mpf(0), mp.mpf(1))
        assert (low, mp.nstr(1 / high, 16)) == (1, "0.8856031944108887")
        assert (turning_point(F(2)), turning_point(F(1, 2))) == (1, 0)


def test_a_gain_between_the_ends_of_alpha_counts():
    """gamma = 0.8857: mu D exceeds 1 only next to alpha = 0.46, where Gamma(alpha + 1) = 0.88560319... < 0.8857."""
    design = Design(F(9, 10), 2, path(2), gamma=F("0.8857"), h=F(1))
    for alpha, truth in ((NOTHING, False), ({"inner": (F("0.6"), F(1)), "outer": (F("0.46"), None)}, True)):
        assert margins.holds(design, {"gain-bound": {"alpha": alpha}}) is truth
    assert margins.holds(replace(design, gamma=F("0.8856")), {"gain-bound": {"alpha": NOTHING}}) is True


def test_where_a_margin_cannot_be():
    for name, claim in (("unbalanced", "memory-inequality"), ("two-islands", "control-norm-bound")):
        assert margins.holds(BROKEN[name], {claim: {"alpha": NOTHING}}) is False
    always = entry(("0", "1"), ("0", "1"))
    assert margins.holds(BROKEN["no-edges"], {"gain-bound": {"mu": always}}) is False
    assert margins.holds(BROKEN["no-edges"], {"gain-bound": {"alpha": NOTHING}}) is True


def _near(design: Design, verdict: str, witness: dict[str, Any], *ends: str) -> dict[str, Any]:
    return {"control-norm-bound": {"mu": {"inner": tuple(map(F, ends)), "verdict": verdict, "witness": witness}}}


def test_neighbourhoods_of_the_paper():
    """docs/theory section 5: eqL3 holds on [0.15186, 0.46844]; section 3: (0, -1, -1, -1, 1) refutes it at k = 1."""
    start = {"x0": list(map(F, (0, -1, -1, -1, 1))), "k": 1}
    assert margins.holds(PAPER, _near(PAPER, "refuted", start, "0.13", "0.135")) is True
    assert margins.holds(PAPER, _near(PAPER, "refuted", start, "0.13", "0.16")) is False
    assert margins.holds(PAPER, _near(PAPER, "refuted", start, "0.135", "0.14")) is False
    assert margins.holds(PAPER, _near(PAPER, "proved", {}, "0.13", "0.135")) is False
    inside = replace(PAPER, gamma=None, mu=F("0.3"))
    assert margins.holds(inside, _near(inside, "proved", {}, "0.157", "0.396")) is True
    assert margins.holds(inside, _near(inside, "proved", {}, "0.156", "0.396")) is False
    tail = {"samples": 6, "powers": 20}
    assert margins.holds(inside, _near(inside, "proved", tail, "0.29", "0.31")) is True
    assert margins.holds(inside, _near(inside, "proved", tail, "0.15", "0.45")) is False


@pytest.mark.parametrize("name", ["paper", "k2-swap", "c4-third", "unbalanced", "two-islands"])
def test_margins_made_by_hand_hold(name):
    design = {**PUBLISHED, **TIES, **BROKEN}[name]
    made = made_by_hand(design)
    assert {"gain-bound", "perron-eigenvalues"} - made.keys() <= {"perron-eigenvalues"}
    assert len(made) >= 1


@pytest.mark.parametrize(
    ("weight", "gamma", "truth"),
    [(F(1), F(10**400), False), (F(10**400), F(1, 3 * 10**400), True), (F(1, 10**400), F(10**400, 3), True)],
)
def test_an_interval_of_alpha_for_numbers_beyond_floats(weight, gamma, truth):
    """Two agents: sigma = abs(1 - 2 w mu) = 0.307 where w gamma = 1/3, and 2^alpha - 1 = 0.866."""
    pair = ((1, 2, weight), (2, 1, weight))
    design = replace(PAPER, agents=2, edges=pair, x0=None, mu=None, gamma=gamma, h=F(1))
    ends = F(9, 10), F(9, 10)
    assert truth_over(design, "repaired-condition", truth, *ends) is True
    assert truth_over(design, "repaired-condition", not truth, *ends) is False
