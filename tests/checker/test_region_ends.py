"""Certificates of regions at the ends of what is allowed: the last that is accepted, and the first that is not."""

import copy
from collections.abc import Callable
from typing import Any

import pytest

from tests.checker.builder import PAPER_EDGES, Json, complete, cycle, directed_cycle, path
from tests.checker.test_region import (
    K2,
    K2_WIDER,
    PAPER,
    SHUT,
    STEP,
    at,
    condition,
    malformed,
    moved,
    put,
    region,
    ruled,
)

W = "witness"
# K2 at alpha 1/2: the condition repaired and its closed form hold from 0.2929 to 0.7071, as stated from 0.5858.
HIGH_ABOVE = {"inner": ["1/2", "1/2"], "outer": ["3/4", "4/5"]}


def changed(base: Json, name: str, change: Callable[[Json], Any]) -> tuple[str, str]:
    document = copy.deepcopy(base)
    change(at(document, name))
    return ruled(document)[name]


def one(edges: list[list[Any]], agents: int, claim: Json, alpha: str = "1/2") -> tuple[str, str]:
    return ruled(region(edges, agents, alpha, claim))[claim["id"]]


@pytest.mark.parametrize("name", ["as-stated", "repaired-closed-form", "repaired", "gain-bound"])
@pytest.mark.parametrize("beyond", ["1", "3/2", "7"])
def test_outer_may_end_beyond_the_gain_bound(name: str, beyond: str) -> None:
    assert changed(K2_WIDER, name, put(W, "mu", "outer", 1, beyond))[0] == "accepted"


@pytest.mark.parametrize(
    ("base", "name", "change", "reason"),
    [
        # outer in an order that is not that of the line, though the condition fails at each of its ends
        (K2_WIDER, "repaired-closed-form", put(W, "mu", HIGH_ABOVE), "outer[0] <= inner[0]"),
        (K2_WIDER, "repaired", put(W, "mu", HIGH_ABOVE), "outer[0] <= inner[0]"),
        (K2_WIDER, "repaired", put(W, "mu", "inner", ["3/5", "1/2"]), "inner[0] <= inner[1]"),
        (K2_WIDER, "gain-bound", put(W, "mu", "outer", ["-1/2", "1"]), "0 <= outer[0]"),
        (K2, "consensus", put(W, "mu", "outer", ["-1/2", "1"]), "0 <= outer[0]"),
        # the same number in both: the condition holds there, so that it does not fail there
        (K2_WIDER, "repaired", put(W, "mu", "outer", 0, "1/2"), "at mu = outer[0]"),
        (K2_WIDER, "repaired", put(W, "mu", "outer", 1, "1/2"), "at mu = outer[1]"),
        (K2_WIDER, "gain-bound", put(W, "mu", "inner", 1, "1"), "inner[1] < 1/Delta_max"),
        (K2_WIDER, "as-stated", put(W, "mu", "inner", 1, "1"), "inner[1] < 1/Delta_max"),
        (K2, "repaired", moved(0, STEP, STEP), "at mu = outer[0]"),
        # vectors whose sums are below 0, as good as those that sum to 0 if only that were forgotten
        (PAPER, "repaired", put(W, "pairs", 0, 0, 0, "-10000000000"), "sums to 0"),
        (PAPER, "repaired", put(W, "pairs", 1, 1, 4, "-10000000000"), "sums to 0"),
        (PAPER, "repaired", put(W, "alpha_opens", "pairs", 0, 0, 0, "-1000000000000000000"), "sums to 0"),
        (PAPER, "repaired", put(W, "pairs", [[["0"] * 5, ["0"] * 5]] * 3), "not all vectors"),
        (PAPER, "repaired", put(W, "alpha_opens", "mu", "-1/100"), "0 < alpha_opens.mu"),
    ],
)
def test_one_step_too_far_is_refused(base: Json, name: str, change: Callable[[Json], Any], reason: str) -> None:
    status, found = changed(base, name, change)
    assert (status, reason in found) == ("refused", True), found


@pytest.mark.parametrize(
    ("edges", "agents", "name", "upper", "more"),
    [
        # lambda2 = D: beta = 0 at mu = 1/D; lambda2 = 2 D: 1 - 2 mu lambda2 (1 - mu D) = 0 at mu = 1/(2D); sigma = 0
        (cycle(4), 4, "as-stated", "0", {}),
        (path(2), 2, "repaired-closed-form", "0", {}),
        (complete(3, "3"), 3, "repaired", "0", {"mu": "1/9"}),
        # K3: sigma = 1/2 at mu = 1/D = 1/2
        (complete(3), 3, "repaired", "3/5", {"mu": "1/2"}),
    ],
)
def test_where_it_opens_at_a_tie(edges: list[list[Any]], agents: int, name: str, upper: str, more: Json) -> None:
    strip = {"inner": ["1/9", "1/9"], "outer": ["0", "9"]}
    opens = {"lower": "0", "upper": upper, **more}
    if name == "repaired":
        opens["pairs"] = [[["1", "-1", "0"]] * 2]
    assert one(edges, agents, condition(name, "proved", mu=strip, alpha_opens=opens), "99/100")[0] == "accepted"


def test_the_reason_says_that_alpha_was_looked_at() -> None:
    found = ruled(PAPER)
    for name in ("as-stated", "repaired-closed-form", "repaired"):
        assert found[name][1].endswith("; opens with alpha as said")
    assert "opens" not in found["gain-bound"][1]


def test_no_mu_at_all_with_degrees_below_one() -> None:
    """Directed C6 of weight 1/4: lambda2 = 1/8, D = 1/4; at mu = 1/D, beta = 1/2; sqrt(3/4) at mu = 1/(2D) squared."""
    edges, light = directed_cycle(6, "1/4"), condition("as-stated", "refuted")
    # log2(3/2) = 0.58496...
    assert one(edges, 6, light, "58/100")[0] == "accepted"
    assert one(edges, 6, light, "59/100") == ("refused", "not true: beta >= 2^alpha - 1 at mu = 1/Delta_max")
    closed = condition("repaired-closed-form", "refuted")
    # log2(1 + sqrt(3/4)) = 0.89997...
    assert one(edges, 6, closed, "89/100")[0] == "accepted"
    assert one(edges, 6, closed, "9/10")[0] == "refused"


def test_the_number_of_pairs() -> None:
    most = copy.deepcopy(PAPER)
    at(most, "repaired")[W]["pairs"] = SHUT * 32
    assert ruled(most)["repaired"][0] == "accepted"
    at(most, "repaired")[W]["pairs"] = [*SHUT * 32, SHUT[0]]
    assert malformed(most).startswith("$.claims[2].witness.pairs: expected 1 to 64 pairs")


@pytest.mark.parametrize("name", ["as-stated", "repaired-closed-form", "consensus"])
def test_pairs_are_a_witness_of_the_condition_repaired_only(name: str) -> None:
    document = region(PAPER_EDGES, 5, "1/2", condition(name, "refuted", pairs=SHUT))
    assert malformed(document) == "$.claims[0].witness: unknown key 'pairs'"
