"""Syntheses built by hand on K2, where everything has a closed form; and each changed until false.

K2 at alpha = 1/2: L has the eigenvalue 2 on 1perp, sigma = abs(1 - 2 mu), 1/Delta_max = 1, m(h) = 2 sqrt(h/pi). The
condition repaired is LOW <= mu <= HIGH, LOW = (2 - sqrt 2)/2, HIGH = sqrt 2/2. x_0 = (1, -1) has norm(L x_0) = sqrt 8.
"""

import copy
from collections.abc import Callable
from typing import Any

import mpmath
import pytest

from fomas_verify.checker import Malformed, regions
from fomas_verify.checker.statements import TASK_CLAIMS
from tests.checker.builder import Json, checked, claim, decimal, path
from tests.checker.test_region import HIGH, LOW, MOST, condition, region, strip

PI = mpmath.pi
PAIR = [[["1", "-1"], ["1", "-1"]]]  # sigma >= 1 - 2 mu
OTHER = [[["1", "-1"], ["-1", "1"]]]  # sigma >= 2 mu - 1
END = {"from": 1, "to": None}
STATED = (2 - mpmath.sqrt(2)) / 2


def repaired() -> Json:
    return condition("repaired", "proved", mu=strip(LOW, HIGH))


def synthesis(
    limits: Json,
    claims: list[Json],
    objective: str = "most-robust",
    about: Json | None = None,
    meets: Json | None = None,
) -> Json:
    """A task on K2 at alpha = 1/2; `about`: gamma, h and x0 of the design."""
    document = region(path(2), 2, "1/2", **(about or {}))
    task = {"condition": meets or repaired(), "limits": limits, "objective": objective, "claims": claims}
    return {**document, "kind": "synthesis", "claims": [], "task": task}


def said(name: str, verdict: str, **witness: Any) -> Json:
    return {"id": name, "verdict": verdict, "statement": TASK_CLAIMS[name], "witness": witness}


def feasible(limits: Json, about: Json | None = None, **more: Any) -> Json:
    return synthesis(limits, [said("feasible", "proved")], about=about or {"gamma": "3/10", "h": "2"}, **more)


def impossible(limits: Json, *blocks: Json, **more: Any) -> Json:
    return synthesis(limits, [said("feasible", "refuted", blocks=list(blocks))], **more)


def best(limits: Json, objective: str, bound: str, *blocks: Json, **more: Any) -> Json:
    return synthesis(limits, [said("best", "proved", bound=bound, blocks=list(blocks))], objective, **more)


def answer(document: Json) -> tuple[int, list[str]]:
    report = checked(document)
    return report.exit_status, [x.reason for x in report.outcomes if x.kind == "task"]


def accepted(document: Json) -> None:
    assert answer(document)[0] == 0, checked(document).outcomes


def refused(document: Json, reason: str) -> None:
    status, reasons = answer(document)
    assert status == 1
    assert any(reason in x for x in reasons), reasons


# mu = 3/10 m(2) = 0.6 sqrt(2/pi) = 0.4787, sigma = 0.0426
ALL = {"h": ["1", "3"], "gamma": ["0", "1"], "u_max": "9/10", "settle_within": "5", "settle_to": "1/100"}
START = {"gamma": "3/10", "h": "2", "x0": ["1", "-1"]}


def test_a_design_within_every_limit() -> None:
    """0.3 sqrt 8 = 0.8486 <= 0.9, and floor(5/2) = 2 samples: 0.0426^2 < 1/100."""
    accepted(feasible(ALL, START))
    accepted(feasible({}))
    accepted(feasible({"settle_within": "7/2", "settle_to": "43/1000"}))  # one sample


@pytest.mark.parametrize(
    ("limits", "reason"),
    [
        ({"h": ["21/10", "3"]}, "h lies within"),
        ({"h": ["1", "19/10"]}, "h lies within"),
        ({"gamma": ["31/100", "1"]}, "gamma lies within"),
        ({"gamma": ["0", "29/100"]}, "gamma lies within"),
        ({"u_max": "84/100"}, "gamma norm(L x_0) <= u_max"),
        ({"settle_within": "19/10"}, "h <= settle_within"),
        ({"settle_to": "1/1000"}, "sigma^2 <= settle_to"),
        ({"settle_within": "39/10"}, "sigma^1 <= settle_to"),
    ],
)
def test_a_design_outside_a_limit(limits: Json, reason: str) -> None:
    refused(feasible(ALL | limits, START), reason)


@pytest.mark.parametrize(("gamma", "reason"), [("18/100", "mu >= inner[0]"), ("45/100", "mu <= inner[1]")])
def test_a_design_outside_the_strip(gamma: str, reason: str) -> None:
    """mu = 0.287 and 0.718."""
    refused(feasible({}, {"gamma": gamma, "h": "2"}), reason)


def test_a_design_without_gamma() -> None:
    for about in ({"h": "2"}, {"mu": "1/2"}, {"gamma": "3/10"}):
        refused(synthesis({}, [said("feasible", "proved")], about=about), "the design has gamma and h")


def test_the_actuator_needs_a_start_and_where_agents_agree_it_needs_nothing() -> None:
    refused(feasible({"u_max": "1"}), "u_max has an x0")
    refused(impossible({"u_max": "1"}, END), "u_max has an x0")
    accepted(feasible({"u_max": "1/1000"}, {**START, "x0": ["1", "1"]}))
    refused(impossible({"u_max": "1/1000", "h": ["0", "1"]}, END, about={"x0": ["1", "1"]}), "leaves no mu")


def test_the_actuator_where_no_theorem_says_that_the_peak_is_1() -> None:
    """As stated holds at mu = 3/4, where P = -1/2 and so norm Phi_k <= 1 = norm Phi_0: the reach is gamma sqrt 8."""
    with mpmath.workdps(30):
        gamma = decimal(mpmath.mpf("0.75") * mpmath.sqrt(PI) / 2, 12, True)
        reach = mpmath.mpf("0.75") * mpmath.sqrt(PI) / 2 * mpmath.sqrt(8)
    meets = condition("as-stated", "proved", mu=strip(STATED, MOST))
    about = {"gamma": gamma, "h": "1", "x0": ["1", "-1"]}
    accepted(feasible({"u_max": decimal(reach + mpmath.mpf("1e-9"), 12, True)}, about, meets=meets))
    low = feasible({"u_max": decimal(reach - mpmath.mpf("1e-9"), 12, True)}, about, meets=meets)
    refused(low, "peak gamma norm(L x_0) <= u_max")


def test_the_condition_carries_its_claims() -> None:
    false = feasible(ALL, START)
    false["task"]["condition"]["witness"]["mu"]["inner"][0] = "1/4"
    refused(false, "the condition repaired, on which it rests, is refused")
    none = {"id": "repaired", "verdict": "refuted", "statement": repaired()["statement"], "witness": {}}
    refused(feasible({}, meets=none), "on which it rests, is refused")


UNBALANCED = [[1, 2, "1"], [2, 3, "1"], [3, 1, "1"], [1, 3, "1"]]


def test_a_condition_of_no_mu_needs_no_more() -> None:
    none = condition("repaired", "refuted")
    for one in (said("feasible", "refuted", blocks=[]), said("best", "proved", bound="1", blocks=[])):
        document = synthesis({}, [one], meets=none)
        document["design"] |= {"agents": 3, "edges": UNBALANCED}
        accepted(document)
    document = feasible({}, meets=none)
    document["design"] |= {"agents": 3, "edges": UNBALANCED}
    refused(document, "some mu satisfies the condition")


@pytest.mark.parametrize("edges", [[[1, 2, "1"]], [[1, 2, "1"], [2, 1, "1/2"]]])
def test_peak_and_sigma_mean_nothing_without_assumption_1(edges: list[list[Any]]) -> None:
    """gain-bound is met by mu = 1/2 m(1/4) = 0.2821 on any graph; agent 2 alone moves, or more, so the mean moves."""
    meets = condition("gain-bound", "proved", mu={"inner": ["1/100", "99/100"], "outer": ["0", "1"]})
    about = {"gamma": "1/2", "h": "1/4", "x0": ["1", "-1"]}
    for limits in ({"u_max": "100"}, {"settle_within": "1000", "settle_to": "1/10"}):
        shut = limits | {"gamma": ["2", "3"], "h": ["9", "10"]}
        for document in (feasible(limits, about, meets=meets), impossible(shut, END, about=about, meets=meets)):
            document["design"]["edges"] = edges
            refused(document, "u_max and settle_to have a meaning (Assumption 1 fails)")
    free = feasible({"h": ["0", "1"]}, about, meets=meets)
    free["design"]["edges"] = edges
    accepted(free)


def test_more_samples_than_can_be_printed() -> None:
    """2 mu = 0.9575, so sigma = 0.0425; where mu = 1e-6000, no precision decides between sigma and the root."""
    endless = {"settle_within": "9" * 5000, "settle_to": "1/100"}
    accepted(feasible(endless, START))
    meets = condition("gain-bound", "proved", mu={"inner": ["1/1" + "0" * 7000, "99/100"], "outer": ["0", "1"]})
    status, reasons = answer(feasible(endless, {"gamma": "1/1" + "0" * 6000, "h": "1"}, meets=meets))
    assert status == 3
    assert "sigma^floor(settle_within/h) <= settle_to" in reasons[0]


def test_limits_that_leave_no_mu() -> None:
    """gamma_1 m(h_1): m(1) = 1.1284, LOW = 0.29289, so gamma reaches at h = 1 to 0.25957 at least; HIGH likewise."""
    accepted(impossible({"h": ["0", "1"], "gamma": ["0", "259/1000"]}, END))
    refused(impossible({"h": ["0", "1"], "gamma": ["0", "260/1000"]}, END), "leaves no mu")
    accepted(impossible({"h": ["1", "2"], "gamma": ["627/1000", "1"]}, END))  # HIGH / m(1) = 0.62666
    refused(impossible({"h": ["1", "2"], "gamma": ["626/1000", "1"]}, END), "leaves no mu")
    start = {"x0": ["1", "-1"]}
    accepted(impossible({"h": ["0", "1"], "u_max": "734/1000"}, END, about=start))  # 0.25957 sqrt 8 = 0.73418
    refused(impossible({"h": ["0", "1"], "u_max": "735/1000"}, END, about=start), "leaves no mu")
    accepted(impossible({"gamma": ["1/2", "1"], "u_max": "1"}, END, about=start))  # sqrt 8 / 2 > 1
    for free in ({}, {"h": ["0", "1"]}, {"gamma": ["0", "1/1000"]}, {"gamma": ["1", "1"]}, {"h": ["1", "1"]}):
        refused(impossible(free, END), "leaves no mu")


# with h at most T, gamma at most 1: k = 1 asks mu >= 0.495, so h >= 0.19244; k = 2 asks 2 h >= 0.318
HASTE = {"gamma": ["0", "1"], "settle_within": "1924/10000", "settle_to": "1/100"}
ONE, TWO = {"from": 1, "to": 1, "pairs": PAIR}, {"from": 2, "to": 2, "pairs": PAIR}
AFTER = {"from": 3, "to": None}


def test_blocks_of_samples() -> None:
    accepted(impossible(HASTE, ONE, TWO, AFTER))
    assert answer(impossible(HASTE, ONE, TWO, AFTER))[1] == ["no gamma and h satisfy the condition and the limits"]
    refused(impossible(HASTE | {"settle_within": "1925/10000"}, ONE, TWO, AFTER), "the pairs of blocks[0]")
    accepted(impossible(HASTE | {"settle_within": "1/10", "h": ["11/100", "1"]}, END))  # h_0 > T


def test_the_work_of_all_blocks_is_bounded(monkeypatch: pytest.MonkeyPatch) -> None:
    """A block has one pair with entries of one bit on two agents, the weights one bit too: 4 * 65^2, three times."""
    monkeypatch.setattr(regions, "MAX_PAIRS_WORK", 3 * 4 * 65**2)
    accepted(impossible(HASTE, ONE, TWO, AFTER))
    monkeypatch.setattr(regions, "MAX_PAIRS_WORK", 3 * 4 * 65**2 - 1)
    status, reasons = answer(impossible(HASTE, ONE, TWO, AFTER))
    assert (status, reasons) == (3, ["as many pairs of vectors are beyond the work allowed"])


@pytest.mark.parametrize(
    ("blocks", "reason"),
    [
        ([], "there are blocks"),
        ([ONE, TWO], "the last block has no end"),
        ([ONE, AFTER], "blocks[1] begins where the one before ends"),
        ([TWO, AFTER], "blocks[0] begins where the one before ends"),
        ([ONE, ONE, TWO, AFTER], "blocks[1] begins where the one before ends"),
        ([{**ONE, "to": None}, TWO], "blocks[0] leaves no mu, or has pairs"),
        ([ONE, {**AFTER, "from": 2}], "blocks[1] leaves no mu, or has pairs"),
        ([{"from": 1, "to": 2, "pairs": PAIR}, AFTER], "the pairs of blocks[0]"),
        ([{**ONE, "pairs": OTHER}, TWO, AFTER], "the pairs of blocks[0]"),
        ([{**ONE, "pairs": [[["1", "0"], ["1", "-1"]]]}, TWO, AFTER], "sums to 0"),
        ([{**ONE, "pairs": [[["0", "0"], ["0", "0"]]]}, TWO, AFTER], "not all vectors"),
        ([ONE, TWO, AFTER, {"from": 4, "to": None}], "blocks[3] begins where the one before ends"),
    ],
)
def test_blocks_that_show_nothing(blocks: list[Json], reason: str) -> None:
    refused(impossible(HASTE, *blocks), reason)


def test_pairs_do_nothing_without_a_time() -> None:
    free = {"gamma": ["0", "1"], "h": ["0", "1"]}
    refused(impossible(free, {"from": 1, "to": 1, "pairs": PAIR}, {"from": 2, "to": None}), "blocks[0] leaves no mu")
    document = impossible({**free, "settle_to": "1/100"}, ONE, TWO, AFTER)
    document["task"]["objective"] = "fastest"
    refused(document, "blocks[0] leaves no mu")


def test_the_slowest() -> None:
    """gamma >= 1/2 and mu <= HIGH: h <= pi/2."""
    limits = {"gamma": ["1/2", "1"]}
    accepted(best(limits, "slowest-sampling", "1571/1000", END))
    refused(best(limits, "slowest-sampling", "157/100", END), "blocks[0] leaves no mu")
    accepted(best({"h": ["0", "1"]}, "slowest-sampling", "1001/1000", END))
    refused(best({"h": ["0", "1"]}, "slowest-sampling", "1", END), "blocks[0] leaves no mu")
    refused(best({"h": ["1/2", "1"]}, "slowest-sampling", "1/4", END), "blocks[0] leaves no mu")


def test_the_gentlest() -> None:
    accepted(best({"h": ["0", "1"]}, "gentlest", "2595/10000", END))
    refused(best({"h": ["0", "1"]}, "gentlest", "2596/10000", END), "blocks[0] leaves no mu")
    accepted(best({"h": ["0", "1"], "gamma": ["0", "1"]}, "gentlest", "2595/10000", END))


def test_the_fastest() -> None:
    limits = {"gamma": ["0", "1"], "settle_to": "1/100"}
    accepted(best(limits, "fastest", "1924/10000", ONE, TWO, AFTER))
    refused(best(limits, "fastest", "1925/10000", ONE, TWO, AFTER), "the pairs of blocks[0]")
    refused(
        best({**limits, "settle_within": "1/5"}, "fastest", "1925/10000", ONE, TWO, AFTER), "the pairs of blocks[0]"
    )


@pytest.mark.parametrize(
    ("limits", "enough", "too_little"),
    [
        ({}, "1342/1000", "1341/1000"),  # q^3 = HIGH/LOW
        ({"h": ["1", "1"]}, "1554/1000", "1553/1000"),  # q^2 = HIGH/LOW
        ({"gamma": ["3/10", "3/10"]}, "2415/1000", "2414/1000"),  # q = HIGH/LOW
        ({"h": ["1", "3/2"]}, "123/100", "122/100"),  # q^2 = 3/2
        ({"gamma": ["1/4", "3/8"]}, "123/100", "122/100"),
        ({"gamma": ["1/2", "9"], "h": ["1", "9"]}, "1079/1000", "1078/1000"),  # q^3 = HIGH / (m(1)/2)
        ({"gamma": ["0", "1/3"], "h": ["0", "1"]}, "1087/1000", "1086/1000"),  # q^3 = m(1)/3 / LOW
    ],
)
def test_the_most_robust(limits: Json, enough: str, too_little: str) -> None:
    accepted(best(limits, "most-robust", enough))
    refused(best(limits, "most-robust", too_little), "nothing leaves gamma and h the factor")


def test_what_is_said_of_the_most_robust_without_proof() -> None:
    refused(best({}, "most-robust", "1"), "bound > 1")
    refused(best({"settle_within": "9", "settle_to": "1/2"}, "most-robust", "9"), "there is no settle_within")
    refused(best({}, "most-robust", "1342/1000", END), "there are no blocks")


def test_another_statement() -> None:
    document = feasible({})
    document["task"]["claims"][0]["statement"] += " "
    refused(document, "the statement is the one of this id")


def test_it_says_things_about_its_design_too() -> None:
    document = feasible({})
    document["claims"] = [claim("gain-bound", "proved")]
    document["values"] = {"degree_max": {"lower": "1", "upper": "1"}}
    report = checked(document)
    assert [x.kind for x in report.outcomes] == ["value", "claim", "condition", "task"]
    assert report.exit_status == 0
    assert report.shortfalls(["gain-bound"]) == ()
    assert [x.id for x in report.shortfalls(["feasible"])] == ["feasible"]
    assert report.limits is not None
    document["claims"][0]["verdict"] = "refuted"
    assert checked(document).exit_status == 1


Edit = Callable[[Json], Any]
FORMS: list[tuple[Edit, str]] = [
    (lambda d: d.pop("task"), "$: "),
    (lambda d: d.update(kind="region"), "$: "),
    (lambda d: d["task"].pop("limits"), "$.task: "),
    (lambda d: d["task"].update(more=1), "$.task"),
    (lambda d: d["task"].update(objective="best"), "$.task.objective: "),
    (lambda d: d["task"].update(objective=1), "$.task.objective: "),
    (lambda d: d["task"]["condition"].update(verdict="undecided"), "$.task.condition.verdict: "),
    (lambda d: d["task"]["limits"].update(h=["2", "1"]), "$.task.limits.h: "),
    (lambda d: d["task"]["limits"].update(h=["-1", "1"]), "$.task.limits.h: "),
    (lambda d: d["task"]["limits"].update(h=["0", "0"]), "$.task.limits.h[1]: "),
    (lambda d: d["task"]["limits"].update(gamma=["1"]), "$.task.limits.gamma: "),
    (lambda d: d["task"]["limits"].update(u_max="0"), "$.task.limits.u_max: "),
    (lambda d: d["task"]["limits"].update(settle_to="1/2"), "$.task.limits: "),
    (lambda d: d["task"]["limits"].update(settle_within="1"), "$.task.limits: "),
    (lambda d: d["task"].update(objective="fastest"), "$.task.limits: "),
    (lambda d: d["task"]["limits"].update(settle_to="1", settle_within="1"), "$.task.limits.settle_to: "),
    (lambda d: d["task"].update(claims=[]), "$.task.claims: "),
    (lambda d: d["task"]["claims"].append(d["task"]["claims"][0]), "$.task.claims[1].id: "),
    (lambda d: d["task"]["claims"][0].update(id="worst"), "$.task.claims[0].id: "),
    (lambda d: d["task"]["claims"][0].update(verdict="undecided"), "$.task.claims[0].verdict: "),
    (lambda d: d["task"]["claims"][0].update(witness={"blocks": []}), "$.task.claims[0].witness"),
    (lambda d: d["task"]["claims"].append(said("best", "refuted")), "$.task.claims[1].verdict: "),
    (lambda d: d["task"]["claims"].append(said("best", "proved", bound="0", blocks=[])), "bound: "),
    (lambda d: _refute(d, {"from": 0, "to": None}), "blocks[0].from: "),
    (lambda d: _refute(d, {"from": 2, "to": 1}), "blocks[0].to: "),
    (lambda d: _refute(d, {"from": 1, "to": None, "pairs": []}), "blocks[0].pairs: "),
    (lambda d: _refute(d, *[END] * 1025), "blocks: "),
    (lambda d: d["design"].pop("h"), "$.claims: "),
    (lambda d: (d["design"].pop("h"), d.update(claims=[], values={"degree_max": {}})), "$.values"),
    (lambda d: d["design"].update(gamma=["1/4", "1/3"]), "$.design.gamma: "),
]


def _refute(document: Json, *blocks: Json) -> None:
    document["task"]["claims"] = [said("feasible", "refuted", blocks=list(blocks))]


@pytest.mark.parametrize(("edit", "where"), FORMS)
def test_what_is_no_synthesis(edit: Edit, where: str) -> None:
    document = feasible({})
    document["claims"] = [claim("gain-bound", "proved")]
    accepted(document)
    edited = copy.deepcopy(document)
    edit(edited)
    with pytest.raises(Malformed) as caught:
        checked(edited)
    assert where in str(caught.value)


def test_a_solver_may_be_named_and_changes_nothing() -> None:
    document = feasible({"h": ["1", "3"]})
    before = answer(document)
    document["task"]["solver"] = "a solver"
    assert answer(document) == before
    document["task"]["solver"] = "x" * 65
    with pytest.raises(Malformed, match="at most 64 characters"):
        checked(document)


@pytest.mark.parametrize(
    "limits", [{"h": ["2", "3"]}, {"h": ["1", "2"]}, {"gamma": ["3/10", "1"]}, {"gamma": ["0", "3/10"]}]
)
def test_the_ends_of_a_range_lie_within(limits: Json) -> None:
    accepted(feasible(ALL | limits, START))


def test_as_much_as_is_allowed_and_no_more() -> None:
    document = feasible({})
    document["task"]["solver"] = "x" * 64
    accepted(document)
    most = [{"from": i, "to": i} for i in range(1, 1024)]
    refused(impossible({"h": ["0", "1"]}, *most, {"from": 1024, "to": None}), "blocks[0] leaves no mu")
    with pytest.raises(Malformed, match="settle_to: expected a rational in"):
        checked(feasible({"settle_within": "1", "settle_to": "3/2"}))
    document = feasible({})
    document["task"]["claims"][0]["statement"] = TASK_CLAIMS["feasible"][:-1]
    refused(document, "the statement is the one of this id")
