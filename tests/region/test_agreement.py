"""The LMI against the direct search, with clarabel, and with solvers that fail or answer nonsense."""

import math
import sys
from dataclasses import replace
from fractions import Fraction
from typing import Any

import pytest

from fomas_verify.design import design_from_mapping
from fomas_verify.enclosure.reference import DisagreementError
from fomas_verify.region import Region, certificate, find_region
from fomas_verify.region.agreement import agreement
from fomas_verify.region.lmi import Goal, MissingExtraError, Proposal, by_clarabel, need_solver
from fomas_verify.spectrum.loop import Loop

PAPER = {"adjacency": [[0, 0, 0, 1, 1], [1, 0, 1, 0, 0], [1, 1, 0, 0, 0], [0, 1, 1, 0, 0], [0, 0, 0, 1, 0]]}
UNBALANCED = {"agents": 3, "edges": [[1, 2], [2, 3], [3, 1], [1, 3]]}
EVERY = tuple(goal.value for goal in Goal)


def region(graph: dict[str, Any], alpha: str) -> Region:
    return find_region(design_from_mapping({"alpha": alpha, "graph": graph}))


def family(name: str, agents: int) -> dict[str, Any]:
    return {"family": name, "agents": agents}


@pytest.mark.parametrize(
    ("graph", "alpha", "goals"),
    [
        (PAPER, "9/10", EVERY),
        (PAPER, "4/5", EVERY[:1]),
        (PAPER, "863038/1000000", EVERY),
        (PAPER, "86303/100000", EVERY[:1]),
        (family("complete", 2), "1/2", EVERY),
        (family("complete", 4), "1/2", EVERY),
        (family("star", 6), "19/20", EVERY),
        (family("directed-cycle", 6), "99/100", EVERY),
    ],
)
def test_clarabel_agrees(graph: dict[str, Any], alpha: str, goals: tuple[str, ...]) -> None:
    """Where `repaired` is empty its dual, rounded, is a proof too."""
    told = agreement(region(graph, alpha))
    assert (told.agreed, told.failed) == (goals, ())


def test_weights_of_any_size_make_no_difference() -> None:
    edges = [[i, i % 4 + 1, weight] for i in range(1, 5) for weight in ["1/1000000000"]]
    assert agreement(region({"agents": 4, "edges": edges}, "19/20")).failed == ()


def nonsense(kind: str) -> Any:
    """Clarabel's answer spoilt, as a solver might that calls it optimal."""

    def propose(loop: Loop, goal: Goal, bound: Fraction, attempt: int) -> Proposal | None:
        good = by_clarabel(loop, goal, bound, attempt)
        assert good is not None
        match kind:
            case "nothing":
                return None
            case "no mu":
                return replace(good, mu=math.nan)
            case "no sigma":
                return replace(good, rho=math.inf)
            case "outside":
                return replace(good, mu=float(2 / loop.degree_max))
            case "negative":
                return replace(good, mu=-0.01)
            case "violated":
                return replace(good, rho=good.rho - 1e-5)
            case _:
                return replace(good, pairs=())

    return propose


@pytest.mark.parametrize(
    ("kind", "reason"),
    [
        ("nothing", "the solver failed"),
        ("no mu", "no number"),
        ("no sigma", "no number"),
        ("outside", "outside"),
        ("negative", "outside"),
        ("violated", "violates its own inequality"),
    ],
)
@pytest.mark.parametrize("alpha", ["9/10", "4/5"])
def test_nonsense_is_a_failure_of_the_solver_and_changes_no_certificate(kind: str, reason: str, alpha: str) -> None:
    found = region(PAPER, alpha)
    before = certificate(found)
    told = agreement(found, nonsense(kind))
    assert told.agreed == ()
    assert all(reason in line for line in told.failed)
    assert len(told.failed) == (3 if alpha == "9/10" else 1)
    assert certificate(found) == before


@pytest.mark.parametrize("spoilt", ["none", "not a number", "too many", "of another graph"])
def test_a_dual_that_proves_nothing_is_none(spoilt: str) -> None:
    def propose(loop: Loop, goal: Goal, bound: Fraction, attempt: int) -> Proposal | None:
        good = by_clarabel(loop, goal, bound, attempt)
        assert good is not None
        u = [1.0, -1.0, 0.0, 0.0, 0.0]
        pairs = {
            "none": (),
            "not a number": (([math.nan] * 5, u),),
            "too many": good.pairs * 65,
            "of another graph": ((u, u[::-1]),),
        }[spoilt]
        return replace(good, pairs=pairs)

    told = agreement(region(PAPER, "4/5"), propose)
    assert told.agreed == ()
    assert "no proof" in told.failed[0]


def test_a_second_answer_may_mend_the_first() -> None:
    def propose(loop: Loop, goal: Goal, bound: Fraction, attempt: int) -> Proposal | None:
        return by_clarabel(loop, goal, bound, attempt) if attempt else Proposal(math.nan, math.nan)

    assert agreement(region(PAPER, "9/10"), propose).agreed == EVERY


@pytest.mark.parametrize("goal", Goal)
def test_a_sound_answer_elsewhere_is_a_contradiction(goal: Goal) -> None:
    """Feasible, but no optimum: sigma at mu = 3/10 is below 0.82."""

    def propose(loop: Loop, asked: Goal, bound: Fraction, attempt: int) -> Proposal | None:
        return Proposal(0.3, 0.82) if asked is goal else by_clarabel(loop, asked, bound, attempt)

    with pytest.raises(DisagreementError, match=f"{goal.value}: the LMI finds"):
        agreement(region(PAPER, "9/10"), propose)


def test_a_contradiction_that_is_not_repeated_is_none() -> None:
    def propose(loop: Loop, goal: Goal, bound: Fraction, attempt: int) -> Proposal | None:
        return Proposal(0.3, 0.82) if attempt == 0 else None

    told = agreement(region(PAPER, "9/10"), propose)
    assert told.agreed == ()
    assert all("the solver failed" in line for line in told.failed)


def test_what_the_lmi_is_not_asked() -> None:
    assert "Assumption 1" in agreement(region(UNBALANCED, "9/10")).failed[0]
    assert "more than 40 agents" in agreement(region(family("cycle", 41), "9/10")).failed[0]


@pytest.mark.parametrize("name", ["cvxpy", "clarabel"])
def test_a_missing_extra_is_named_in_one_line(monkeypatch: pytest.MonkeyPatch, name: str) -> None:
    monkeypatch.setitem(sys.modules, name, None)
    with pytest.raises(MissingExtraError, match=rf"^an LMI needs {name}, which the extra `region` brings: "):
        need_solver()
