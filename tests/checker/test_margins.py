"""Margins in mu and alpha against closed forms on K2, K5, P4 and the paper's graph, and each end one step too far.

K2: lambda2 = 2, D = 1, sigma = abs(1 - 2 mu). K5: all eigenvalues 5, D = 4. P4: lambda2 = 2 - sqrt 2.
The paper's graph: lambda2 = 1, D = 2, mu* = 2/3; its interval of repaired-condition as theory, section 5, prints it.
"""

import copy
from fractions import Fraction
from typing import Any

import mpmath
import pytest

from fomas_verify.checker import Malformed
from tests.checker.builder import (
    PAPER_EDGES,
    Json,
    certificate,
    checked,
    complete,
    decimal,
    design,
    directed_cycle,
    lyapunov,
    outcome,
    path,
)
from tests.checker.cases import rooted_and_unbalanced
from tests.checker.sampled import norm, real, step_matrix

WORST = ["0", "-1", "-1", "-1", "1"]
STEP = Fraction(1, 10**12)
PAPER = design(PAPER_EDGES, 5, gamma="3/20", h="17/20")
K2 = design(path(2), 2, mu="1/4")
K5 = design(complete(5), 5, mu="1/5")
P4 = design(path(4), 4, "1/2", mu="1")
ROUND = design(path(2), 2, gamma="9/10", h="1")


def margins(about: Json, **parts: Json) -> Json:
    """A certificate with these margins: `gain_bound={"mu": ..., "alpha": ...}`."""
    document = certificate(about)
    document["values"] = {"margins": {name.replace("_", "-"): part for name, part in parts.items()}}
    return document


def ruled(about: Json, claim: str, which: str, margin: Json, beside: Json | None = None) -> tuple[str, str]:
    part = {which: margin} if beside is None else {"mu": beside, which: margin}
    return outcome(margins(about, **{claim: part}), f"margins.{claim}.{which}")


def ends(inner: tuple[Any, Any], outer: tuple[Any, Any], **witness: Any) -> Json:
    text = [[None if x is None else str(x) for x in pair] for pair in (inner, outer)]
    return {"inner": text[0], "outer": text[1], **witness}


def near(x: Any, up: bool, digits: int = 15) -> str:
    with mpmath.workdps(40):
        return decimal(x, digits, up)


def bisected(f: Any, a: Any, b: Any) -> Any:
    """A zero of f between a and b, where its signs differ."""
    with mpmath.workdps(40):
        a, b = real(a), real(b)
        positive = f(a) > 0
        assert positive != (f(b) > 0)
        for _ in range(110):
            middle = (a + b) / 2
            a, b = (middle, b) if (f(middle) > 0) == positive else (a, middle)
        return a


def mu_of(alpha: Any, gamma: str = "3/20", h: str = "17/20") -> Any:
    return real(gamma) * real(h) ** alpha / mpmath.gamma(1 + alpha)


def sigma_of(mu: Any) -> Any:
    matrix = step_matrix({**design(PAPER_EDGES, 5), "mu": "0"})
    for source, target, _ in PAPER_EDGES:
        matrix[target - 1, source - 1] += mu
        matrix[target - 1, target - 1] -= mu
    return norm(matrix)


def bracket(lower: Any, upper: Any) -> Json:
    """The closest decimals inside and outside an interval of mu."""
    return ends((near(lower, True), near(upper, False)), (near(lower, False), near(upper, True)))


with mpmath.workdps(40):
    C1 = mpmath.mpf(2) ** mpmath.mpf("0.9") - 1
    C2 = mpmath.sqrt(mpmath.mpf(3) ** mpmath.mpf("0.9") - mpmath.mpf(2) ** mpmath.mpf("0.9"))
    # The first 11 digits stand in theory, section 5.
    REPAIRED = [bisected(lambda mu: sigma_of(mu) - C1, *around) for around in (("1/10", "1/5"), ("3/10", "1/2"))]
    MEMORY_OPENS = bisected(lambda a: mu_of(a) - (2 - 2**a), "4/5", "19/20")
    REPAIRED_OPENS = bisected(lambda a: 2**a - 1 - sigma_of(mu_of(a)), "9/10", "19/20")
    GAMMA_CROSSES = bisected(lambda a: mpmath.gamma(1 + a) - real("9/10"), "1/2", "9/10")
    MEMORY = [bracket((1 - C1) / lambda2, (1 + C2) / lambda2) for lambda2 in (1, 2, 5)]
    CONTRACTION = [bracket((1 - C1) / x, (1 + C1) / x) for x in (2, 5)]
    LOG = mpmath.log(real("3/2"), 2)


Q_PAPER = lyapunov(PAPER_EDGES, 5, Fraction(6666, 10000), 40)
PERRON_PAPER = ends((0, "6666/10000"), (0, "6667/10000"), Q=Q_PAPER, power=10**6)
PERRON_K2 = ends((0, "999/1000"), (0, 1), Q=[["1"]], Y=[["2"]])

IN_MU: list[tuple[Json, str, Json]] = [
    (PAPER, "gain-bound", ends((0, "1/2"), (0, "1/2"))),
    (PAPER, "memory-inequality", MEMORY[0]),
    (PAPER, "perron-eigenvalues", PERRON_PAPER),
    (PAPER, "repaired-condition", bracket(*REPAIRED)),
    (K2, "gain-bound", ends((0, 1), (0, 1))),
    (K2, "memory-inequality", MEMORY[1]),
    (K2, "perron-eigenvalues", PERRON_K2),
    (K2, "repaired-condition", CONTRACTION[0]),
    (K5, "gain-bound", ends((0, "1/4"), (0, "1/4"))),
    (K5, "memory-inequality", MEMORY[2]),
    (K5, "repaired-condition", CONTRACTION[1]),
    (design(directed_cycle(3), 3, mu="1"), "perron-eigenvalues",
     ends((0, "99/100"), (0, 1), Q=lyapunov(directed_cycle(3), 3, Fraction(99, 100), 40), Y=[["2"], ["-1", "2"]])),
]  # fmt: skip


@pytest.mark.parametrize(("about", "claim", "margin"), IN_MU)
def test_margins_in_mu(about: Json, claim: str, margin: Json) -> None:
    assert ruled(about, claim, "mu", margin)[0] == "accepted"
    for lower, upper in (("inner", 1), ("outer", -1)):
        wide = copy.deepcopy(margin)
        wide[lower] = [str(max(Fraction(wide[lower][0]) + upper * STEP, Fraction(0))), wide[lower][1]]
        if wide["outer"][0] != "0" or claim in ("memory-inequality", "repaired-condition"):
            assert ruled(about, claim, "mu", wide)[0] == "accepted"


@pytest.mark.parametrize(("about", "claim", "margin"), IN_MU)
@pytest.mark.parametrize("which", ["inner", "outer"])
@pytest.mark.parametrize("end", [0, 1])
def test_an_end_in_mu_one_step_too_far(about: Json, claim: str, margin: Json, which: str, end: int) -> None:
    step = Fraction(1, 100) if claim == "perron-eigenvalues" else STEP
    moved = copy.deepcopy(margin)
    outward = (end == 1) == (which == "inner")
    moved[which][end] = str(Fraction(moved[which][end]) + (step if outward else -step))
    assert ruled(about, claim, "mu", moved)[0] == "refused"


def test_where_the_margins_of_theory_lie() -> None:
    assert [near(x, False, 11) for x in REPAIRED] == ["15678262217/100000000000", "39651947232/100000000000"]


def test_the_exact_end_of_a_tie() -> None:
    """P4 at alpha = 1/2: (2 - sqrt 2)/lambda2 = 1 exactly; the other end is (1 + sqrt(sqrt 3 - sqrt 2))/lambda2."""
    with mpmath.workdps(40):
        upper = (1 + mpmath.sqrt(mpmath.sqrt(3) - mpmath.sqrt(2))) / (2 - mpmath.sqrt(2))
    margin = ends((1, near(upper, False)), (1, near(upper, True)))
    assert ruled(P4, "memory-inequality", "mu", margin)[0] == "accepted"
    for moved in (ends((1 - STEP, 2), (0, 3)), ends((1 + 2 * STEP, 2), (1 + STEP, 3))):
        assert ruled(P4, "memory-inequality", "mu", moved)[0] == "refused"


MORE_IN_MU: list[tuple[Json, str, Json, str]] = [
    (PAPER, "gain-bound", ends(("1/3", "1/3"), (0, 1)), "0 <= outer[0] <= inner[0] < inner[1] <= outer[1]"),
    (PAPER, "gain-bound", ends((-1, "1/3"), (-1, 1)), "0 <= outer[0] <= inner[0] < inner[1] <= outer[1]"),
    (PAPER, "gain-bound", ends(("1/10", "1/3"), ("1/20", 1)), "outer[0] = 0"),
    (PAPER, "perron-eigenvalues", {**PERRON_PAPER, "outer": ["1/9", "1"], "inner": ["1/8", "1/4"]}, "outer[0] = 0"),
    (PAPER, "perron-eigenvalues", {**PERRON_PAPER, "inner": ["0", "6667/10000"]}, "Q - Pc(t)^T Q Pc(t) > 0"),
    (PAPER, "perron-eigenvalues", {**PERRON_PAPER, "power": 3}, "abs trace(Pc(outer[1])^power) > N - 1"),
    (K2, "perron-eigenvalues", {**PERRON_K2, "Q": [["0"]]}, "Q > 0"),
    (K2, "perron-eigenvalues", {**PERRON_K2, "Y": [["0"]]}, "Y != 0"),
    (K2, "memory-inequality", ends((0, "1/4"), (0, 2)), "beta <= 2^alpha - 1 at mu = inner[0]"),
    (K2, "memory-inequality", ends(("1/4", 1), (0, 2)), "beta >= -sqrt(3^alpha - 2^alpha) at mu = inner[1]"),
    (K2, "memory-inequality", ends(("1/4", "1/3"), ("1/8", 2)), "beta >= 2^alpha - 1 at mu = outer[0]"),
    (K2, "memory-inequality", ends(("1/4", "1/3"), (0, "1/2")), "beta <= -sqrt(3^alpha - 2^alpha) at mu = outer[1]"),
    (K2, "repaired-condition", ends((0, "1/4"), (0, 2)), "sigma <= 2^alpha - 1 at mu = inner[0]"),
    (K2, "repaired-condition", ends(("1/4", 1), (0, 2)), "sigma <= 2^alpha - 1 at mu = inner[1]"),
    (K2, "repaired-condition", ends(("1/4", "1/3"), ("1/8", 2)), "sigma > 2^alpha - 1 at mu = outer[0]"),
    (K2, "repaired-condition", ends(("1/4", "1/3"), (0, "1/2")), "sigma > 2^alpha - 1 at mu = outer[1]"),
    (design([], 3, mu="1"), "gain-bound", ends((0, 1), (0, 2)), "1/Delta_max <= outer[1]"),
    (design([], 3, mu="1"), "perron-eigenvalues", ends((0, 1), (0, 2), Q=[["2"], ["1", "2"]], Y=[["1"], ["0", "1"]]),
     "Q - Pc(t)^T Q Pc(t) > 0"),
    (design([[1, 2, "1"]], 2, mu="1"), "memory-inequality", ends((0, 1), (0, 2)),
     "the margin of memory-inequality exists (Assumption 1 fails)"),
    (design([[1, 2, "1"]], 2, mu="1"), "repaired-condition", ends((0, 1), (0, 2)),
     "the margin of repaired-condition exists (Assumption 1 fails)"),
]  # fmt: skip


@pytest.mark.parametrize(("about", "claim", "margin", "reason"), MORE_IN_MU)
def test_margins_in_mu_refused(about: Json, claim: str, margin: Json, reason: str) -> None:
    assert ruled(about, claim, "mu", margin) == ("refused", f"not true: {reason}")


def test_an_unbalanced_graph_has_margins_of_the_claims_about_every_graph() -> None:
    """1 -> 2 -> 3 with weights 1 and 2: eigenvalues 1 - mu and 1 - 2 mu, so mu* = 1."""
    about = rooted_and_unbalanced()["design"]
    edges = about["edges"]
    stable = ends((0, "99/100"), (0, "101/100"), Q=lyapunov(edges, 3, Fraction(99, 100), 40), power=10**4)
    assert ruled(about, "perron-eigenvalues", "mu", stable)[0] == "accepted"
    assert ruled(about, "gain-bound", "mu", ends((0, "1/2"), (0, "1/2")))[0] == "accepted"


OPEN = near(LOG, True)
IN_ALPHA: list[tuple[Json, str, Json, Json | None]] = [
    (PAPER, "gain-bound", ends((0, 1), (None, None)), None),
    (PAPER, "memory-inequality", ends((near(MEMORY_OPENS, True), 1), (near(MEMORY_OPENS, False), None)), None),
    (PAPER, "perron-eigenvalues", ends((0, 1), (None, None)), PERRON_PAPER),
    (PAPER, "repaired-condition", ends((0, near(REPAIRED_OPENS, False)), (None, near(REPAIRED_OPENS, True))), None),
    (K2, "gain-bound", ends((0, 1), (None, None)), None),
    (K2, "memory-inequality", ends((OPEN, 1), (near(LOG, False), None)), None),
    (K2, "repaired-condition", ends((OPEN, 1), ("1/2", None)), None),
    (K2, "perron-eigenvalues", ends((0, 1), (None, None)), PERRON_K2),
    ({**K2, "mu": "1/2"}, "memory-inequality", ends((0, 1), (None, None)), None),
    ({**K2, "mu": "1/2"}, "repaired-condition", ends((0, 1), (None, None)), None),
    ({**K2, "mu": "1"}, "memory-inequality", ends((0, 1), (None, None)), None),
    ({**K2, "mu": "1"}, "repaired-condition", ends((0, 1), (None, None)), None),
    ({**K2, "mu": "1"}, "gain-bound", ends((0, 1), (None, None)), None),
    ({**K2, "mu": "1"}, "perron-eigenvalues", ends((0, 1), (None, None)), PERRON_K2),
    ({**K2, "alpha": "1/2"}, "memory-inequality", ends((0, near(LOG, False)), (None, OPEN)), None),
    ({**K2, "alpha": "1/2"}, "repaired-condition", ends((0, near(LOG, False)), (None, OPEN)), None),
    (P4, "memory-inequality", ends(("1/2", 1), ("4999/10000", None)), None),
    (K5, "repaired-condition", ends((0, 1), (None, None)), None),
    (ROUND, "gain-bound", ends((near(GAMMA_CROSSES, True), 1), (near(GAMMA_CROSSES, False), None)), None),
    (ROUND, "gain-bound", ends(("9/10", "9/10"), ("1/2", None)), None),
    (ROUND, "perron-eigenvalues", ends((near(GAMMA_CROSSES + 0.01, True), 1), ("1/2", None)), PERRON_K2),
    ({**ROUND, "alpha": "1/2"}, "gain-bound", ends(("2/5", "3/5"), ("1/10", "9/10")), None),
    ({**ROUND, "alpha": "1/2"}, "perron-eigenvalues", ends(("2/5", "3/5"), ("1/10", "9/10")), PERRON_K2),
    (design([], 2, gamma="1", h="8"), "gain-bound", ends((0, 1), (None, None)), None),
]


@pytest.mark.parametrize(("about", "claim", "margin", "beside"), IN_ALPHA)
def test_margins_in_alpha(about: Json, claim: str, margin: Json, beside: Json | None) -> None:
    assert ruled(about, claim, "alpha", margin, beside)[0] == "accepted"
    narrow = {"inner": [about["alpha"], about["alpha"]], "outer": [None, None]}
    assert ruled(about, claim, "alpha", narrow, beside)[0] == "accepted"


TOO_FAR: list[tuple[Json, str, Json, Json | None, str]] = [
    (about, claim, margin, None, f"the claim is {said} for every alpha of inner")
    for about, claim, margin, said in (
        (PAPER, "memory-inequality", ends((near(MEMORY_OPENS, False), 1), (None, None)), "true"),
        (PAPER, "memory-inequality", ends(("4/5", 1), (None, None)), "true"),
        (PAPER, "repaired-condition", ends((0, near(REPAIRED_OPENS, True)), (None, None)), "false"),
        (PAPER, "repaired-condition", ends((0, 1), (None, None)), "false"),
        (K2, "memory-inequality", ends((near(LOG, False), 1), (None, None)), "true"),
        (K2, "repaired-condition", ends((0, 1), (None, None)), "true"),
        (P4, "memory-inequality", ends(("4999/10000", 1), (None, None)), "true"),
        (ROUND, "gain-bound", ends((near(GAMMA_CROSSES, False), 1), (None, None)), "true"),
        (ROUND, "gain-bound", ends(("1/10", "19/20"), (None, None)), "true"),
        (ROUND, "gain-bound", ends((0, 1), (None, None)), "true"),
        ({**ROUND, "alpha": "1/2"}, "gain-bound", ends(("1/10", "3/5"), (None, None)), "false"),
    )
] + [
    (ROUND, "perron-eigenvalues", ends((0, 1), (None, None)), PERRON_K2,
     "the claim is true for every alpha of inner"),
    (PAPER, "gain-bound", ends(("91/100", 1), (None, None)), None, "inner[0] <= alpha <= inner[1]"),
    (PAPER, "gain-bound", ends((0, "89/100"), (None, None)), None, "inner[0] <= alpha <= inner[1]"),
    (PAPER, "gain-bound", ends(("1/2", 1), ("1/2", None)), None, "outer[0] < inner[0] and inner[1] < outer[1]"),
    (PAPER, "gain-bound", ends((0, "19/20"), (None, "19/20")), None, "outer[0] < inner[0] and inner[1] < outer[1]"),
    (PAPER, "gain-bound", ends(("1/2", 1), ("1/4", None)), None, "the claim is false at alpha = outer[0]"),
    (PAPER, "memory-inequality", ends(("9/10", "19/20"), (None, "39/40")), None,
     "the claim is false at alpha = outer[1]"),
    (PAPER, "repaired-condition", ends((0, "9/10"), (None, "91/100")), None, "the claim is true at alpha = outer[1]"),
    (PAPER, "perron-eigenvalues", ends((0, 1), (None, None)), {**PERRON_PAPER, "power": 3},
     "abs trace(Pc(outer[1])^power) > N - 1"),
    (PAPER, "perron-eigenvalues", ends((0, 1), (None, None)),
     ends((0, "1/10"), (0, "6667/10000"), Q=lyapunov(PAPER_EDGES, 5, Fraction(1, 10), 40), power=10**6),
     "mu lies inside inner or outside outer of the margin in mu"),
    (design(path(2)[1:], 2, mu="1"), "memory-inequality", ends((0, 1), (None, None)), None,
     "the margin of memory-inequality exists (Assumption 1 fails)"),
]  # fmt: skip


@pytest.mark.parametrize(("about", "claim", "margin", "beside", "reason"), TOO_FAR)
def test_margins_in_alpha_refused(about: Json, claim: str, margin: Json, beside: Json | None, reason: str) -> None:
    assert ruled(about, claim, "alpha", margin, beside) == ("refused", f"not true: {reason}")


def test_a_truth_that_is_not_known_is_not_taken_for_either() -> None:
    """gamma = Gamma(3/2) to 4200 bits: mu is 1/Delta_max to as many, at alpha = 1/2."""
    with mpmath.workprec(4300):
        gamma = f"{int(mpmath.floor(mpmath.gamma(mpmath.mpf(3) / 2) * 2**4200))}/{2**4200}"
    about = design(path(2), 2, "1/2", gamma=gamma, h="1")
    late = "not decided within the work allowed: "
    for margin in (ends(("1/2", "1/2"), (None, None)), ends(("2/5", "3/5"), (None, None))):
        assert ruled(about, "gain-bound", "alpha", margin) == ("undecided", f"{late}the truth of the claim")
    margin = ends((0, "2/5"), ("1/10", None))
    assert ruled({**about, "alpha": "1/5"}, "gain-bound", "alpha", margin)[0] == "refused"
    open_ended = ends(("1/5", "2/5"), (None, "1/2"))
    assert ruled({**about, "alpha": "3/10"}, "gain-bound", "alpha", open_ended) == (
        "undecided",
        f"{late}the truth of the claim",
    )


@pytest.mark.parametrize("claim", ["gain-bound", "memory-inequality", "repaired-condition"])
def test_a_short_margin_in_mu_does_not_shorten_the_one_in_alpha(claim: str) -> None:
    about = {**K2, "mu": "2/5"}
    short = ends(("39/100", "41/100"), (0, 2))
    assert ruled(about, claim, "mu", short)[0] == "accepted"
    assert (
        ruled(about, claim, "alpha", ends(("4/5", 1), (None, None)), {**short, "inner": ["1/3", "7/20"]})[0]
        == "accepted"
    )


def test_a_margin_says_what_it_says_in_the_report() -> None:
    document = margins(K2, gain_bound={"alpha": ends((0, 1), (None, None)), "mu": ends((0, 1), (0, 1))})
    assert [(o.kind, o.id, o.verdict) for o in checked(document).outcomes[:2]] == [
        ("value", "margins.gain-bound.mu", None),
        ("value", "margins.gain-bound.alpha", None),
    ]


FORMS: list[tuple[str, Any]] = [
    ("", {}),
    ("", []),
    ("", {"gain-bounds": {}}),
    (".gain-bound", {"gain-bound": {}}),
    (".gain-bound", {"gain-bound": {"h": ends((0, 1), (0, 1))}}),
    (".gain-bound.mu", {"gain-bound": {"mu": {"inner": ["0", "1"]}}}),
    (".gain-bound.mu", {"gain-bound": {"mu": ends((0, 1), (0, 1), Q=[["1"]])}}),
    (".gain-bound.mu.inner", {"gain-bound": {"mu": ends((0, 1), (0, 1)) | {"inner": ["0"]}}}),
    (".gain-bound.mu.outer[1]", {"gain-bound": {"mu": ends((0, 1), (0, None))}}),
    (".gain-bound.alpha.inner[1]", {"gain-bound": {"alpha": ends((0, "11/10"), (None, None))}}),
    (".gain-bound.alpha.inner[0]", {"gain-bound": {"alpha": ends(("-1/10", 1), (None, None))}}),
    (".gain-bound.alpha.inner[0]", {"gain-bound": {"alpha": ends((f"1/{2**64}", 1), (None, None))}}),
    (".gain-bound.alpha.inner[0]", {"gain-bound": {"alpha": ends((None, 1), (None, None))}}),
    (".gain-bound.alpha.outer[0]", {"gain-bound": {"alpha": ends(("1/2", 1), (0, None))}}),
    (".gain-bound.alpha.outer[1]", {"gain-bound": {"alpha": ends((0, "19/20"), (None, 1))}}),
    (".gain-bound.alpha.outer", {"gain-bound": {"alpha": ends((0, 1), (None, None)) | {"outer": None}}}),
    (".perron-eigenvalues.mu", {"perron-eigenvalues": {"mu": ends((0, 1), (0, 1))}}),
    (".perron-eigenvalues.mu", {"perron-eigenvalues": {"mu": {**PERRON_PAPER, "Y": PERRON_PAPER["Q"]}}}),
    (".perron-eigenvalues.mu.Q", {"perron-eigenvalues": {"mu": {**PERRON_PAPER, "Q": [["1"]]}}}),
    (".perron-eigenvalues.mu.power", {"perron-eigenvalues": {"mu": {**PERRON_PAPER, "power": 0}}}),
    (".perron-eigenvalues.mu.power", {"perron-eigenvalues": {"mu": {**PERRON_PAPER, "power": 2**256 + 1}}}),
    (".perron-eigenvalues.alpha", {"perron-eigenvalues": {"alpha": ends((0, 1), (None, None))}}),
]


@pytest.mark.parametrize(("where", "margin"), FORMS)
def test_form(where: str, margin: Any) -> None:
    document = certificate(PAPER)
    document["values"] = {"margins": margin}
    with pytest.raises(Malformed) as caught:
        checked(document)
    assert caught.value.path == f"$.values.margins{where}"
