"""Regions built by hand, by closed forms on K2 and numpy's singular vectors elsewhere; and each changed until false.

K2: lambda2 = 2, D = 1, sigma = abs(1 - 2 mu), mu* = 1, so that at alpha = 1/2, t = sqrt 2 - 1, the condition repaired
and its closed form are (1 - t)/2 <= mu <= (1 + t)/2, and as stated mu <= (1 + sqrt(sqrt 3 - sqrt 2))/2. The paper's
graph at alpha 4/5 and the numbers at which it opens: theory, section 5.
"""

import copy
from collections.abc import Callable
from fractions import Fraction
from typing import Any

import mpmath
import numpy as np
import pytest

from fomas_verify.checker import Malformed
from fomas_verify.checker.statements import CONDITIONS
from tests.checker.builder import (
    PAPER_EDGES,
    Json,
    certificate,
    checked,
    decimal,
    directed_cycle,
    laplacian,
    lyapunov,
    path,
)

STEP = Fraction(1, 10**6)
with mpmath.workdps(40):
    LOW, HIGH = (2 - mpmath.sqrt(2)) / 2, mpmath.sqrt(2) / 2
    MOST = (1 + mpmath.sqrt(mpmath.sqrt(3) - mpmath.sqrt(2))) / 2
    MEMORY = 2 - mpmath.mpf(2) ** mpmath.mpf("0.8")
UNBALANCED = [[1, 2, "1"], [2, 3, "1"], [3, 1, "1"], [1, 3, "1"]]


def real(x: Any) -> Any:
    return mpmath.mpf(x)


def condition(name: str, verdict: str, **witness: Any) -> Json:
    return {"id": name, "verdict": verdict, "statement": CONDITIONS[name], "witness": witness}


def region(edges: list[list[Any]], agents: int, alpha: str, *claims: Json, **more: str) -> Json:
    about = {"alpha": alpha, **more, "agents": agents, "edges": copy.deepcopy(edges), "require": ["gain-bound"]}
    return {**certificate(about, list(claims)), "kind": "region"}


def strip(low: Any, high: Any, **witness: Any) -> Json:
    """Ends 1e-15 apart around these; a rational end is exact in outer, and 0 or 1 itself not in inner."""
    with mpmath.workdps(40):
        inner = [
            decimal(real(low) + real("1e-16"), 15, True),
            decimal(high - real("1e-16"), 15, False),
        ]
        outer = [str(x) if isinstance(x, int) else decimal(x, 15, up) for x, up in ((low, False), (high, True))]
    return {"inner": inner, "outer": outer, **witness}


def pairs(edges: list[list[Any]], agents: int, mus: tuple[float, float], bits: int = 30) -> list[list[list[str]]]:
    """The largest singular pairs of P at two mu, their slopes cancelling, as integers that sum to 0."""
    el, found = laplacian(edges, agents), []
    basis = np.linalg.qr(np.vstack([np.eye(agents - 1), -np.ones(agents - 1)]))[0]
    for mu in mus:
        left, _, right = np.linalg.svd(basis.T @ (np.eye(agents) - mu * el) @ basis)
        u, v = basis @ left[:, 0], basis @ right[0]
        found.append((u, v, abs(u @ el @ v)))
    return [
        [integers(np.sqrt(other) * x, bits) for x in (u, v)]
        for (u, v, _), other in zip(found, (found[1][2], found[0][2]), strict=True)
    ]


def integers(vector: np.ndarray, bits: int) -> list[str]:
    rounded = [round(x * 2**bits) for x in vector[:-1]]
    return [str(x) for x in (*rounded, -sum(rounded))]


OPEN_K2 = {"lower": "0", "upper": "1"}
K2 = region(
    path(2), 2, "1/2",
    condition("as-stated", "proved", mu=strip(LOW, MOST)),
    condition("repaired-closed-form", "proved", mu=strip(LOW, HIGH), alpha_opens=OPEN_K2),
    condition("repaired", "proved", mu=strip(LOW, HIGH)),
    condition("gain-bound", "proved", mu=strip(0, 1)),
    condition("consensus", "proved", mu=strip(0, 1, Q=[["1"]], Y=[["1"]])),
    gamma="1",
)  # fmt: skip
# log2(3/2); lambda2 = 2 D (1 - (2^alpha - 1)^2) at (2^alpha - 1)^2 = 3/4; the least sigma, by mpmath
ROUND = real("0.81886418198664402077")
SHUT = pairs(PAPER_EDGES, 5, (0.16, 0.4))
OPENS = pairs(PAPER_EDGES, 5, (0.285966, 0.285967), 50)


def opens(t: Any, **witness: Any) -> Json:
    """The alpha with 2^alpha - 1 = t, to ten digits."""
    with mpmath.workdps(30):
        alpha = mpmath.log(1 + t, 2)
        return {"lower": decimal(alpha, 10, False), "upper": decimal(alpha, 10, True), **witness}


LEAST = opens(ROUND, pairs=OPENS, mu="2859664/10000000")
K2_WIDER = region(
    path(2), 2, "1/2",
    *(condition(name, "proved", mu={"inner": ["1/2", "1/2"], "outer": ["0", "1"]})
      for name in ("as-stated", "repaired-closed-form", "repaired", "gain-bound")),
)  # fmt: skip
PAPER = region(
    PAPER_EDGES, 5, "4/5",
    condition("as-stated", "proved", mu=strip(MEMORY, real("0.5")), alpha_opens=opens(0.5)),
    condition("repaired-closed-form", "refuted", alpha_opens=opens(mpmath.sqrt(3) / 2)),
    condition("repaired", "refuted", pairs=SHUT, alpha_opens=LEAST),
    condition("gain-bound", "proved", mu={"inner": ["1/1000000", "4999/10000"], "outer": ["0", "1/2"]}),
    condition("consensus", "proved", mu={"inner": ["1/9", "3/5"], "outer": ["0", "3/4"],
                                         "Q": lyapunov(PAPER_EDGES, 5, Fraction(3, 5)), "power": 200}),
    h="17/20", x0="",
)  # fmt: skip
del PAPER["design"]["x0"]
PAPER["claims"][0]["witness"]["mu"]["outer"][1] = "1/2"
WIDE = region(
    directed_cycle(6), 6, "1/2",
    condition("as-stated", "refuted"),
    condition("repaired-closed-form", "refuted", alpha_opens=OPEN_K2),
    condition("repaired", "refuted", pairs=pairs(directed_cycle(6), 6, (0.4, 0.6)),
              alpha_opens={"lower": "0", "upper": "1", "pairs": [[["0"] * 6] * 2], "mu": "-1"}),
)  # fmt: skip
FAILS = region(
    UNBALANCED, 3, "9/10",
    *(condition(name, "refuted") for name in CONDITIONS if name != "gain-bound"),
    condition("gain-bound", "proved", mu={"inner": ["1/9", "1/3"], "outer": ["0", "1/2"]}),
)  # fmt: skip
GOOD = {"K2": K2, "K2, wider": K2_WIDER, "paper": PAPER, "cycle": WIDE, "unbalanced": FAILS}


def ruled(document: Json) -> dict[str, tuple[str, str]]:
    return {outcome.id: (outcome.status, outcome.reason) for outcome in checked(document).outcomes}


@pytest.mark.parametrize("name", GOOD)
def test_what_is_true_is_accepted(name: str) -> None:
    found = ruled(GOOD[name])
    assert {status for status, _ in found.values()} == {"accepted"}, found
    assert len(found) == len(GOOD[name]["claims"])


def test_a_condition_proves_no_claim() -> None:
    """The id gain-bound is that of a claim about one mu, too."""
    report = checked(K2)
    assert {outcome.kind for outcome in report.outcomes} == {"condition"}
    assert report.verdicts == {}
    assert [x.exit_status for x in report.shortfalls(report.design.require)] == [1]


def at(document: Json, name: str) -> Json:
    return next(claim for claim in document["claims"] if claim["id"] == name)


def moved(i: int, inner: Fraction, outer: Fraction) -> Callable[[Json], None]:
    """Move the lower or the upper end of inner, and of outer."""

    def change(claim: Json) -> None:
        for key, by in (("inner", inner), ("outer", outer)):
            ends = claim["witness"]["mu"][key]
            ends[i] = str(Fraction(ends[i]) + by)

    return change


def put(*keys: Any) -> Callable[[Json], None]:
    """Put the last of these at the place that the others name."""

    def change(claim: Json) -> None:
        place: Any = claim
        for key in keys[:-2]:
            place = place[key]
        place[keys[-2]] = keys[-1]

    return change


def scaled(*keys: Any) -> Callable[[Json], None]:
    """Make a vector four times as long."""

    def change(claim: Json) -> None:
        vector: Any = claim
        for key in keys:
            vector = vector[key]
        vector[:] = [str(4 * int(x)) for x in vector]

    return change


W = "witness"
FALSE: list[tuple[str, str, Callable[[Json], None], str]] = [
    # 1e-6 too wide inside, outer with it; and too narrow outside, inner with it
    *(
        ("K2", name, moved(i, side * STEP, side * STEP), f"at mu = inner[{i}]")
        for name in ("as-stated", "repaired-closed-form", "repaired")
        for i, side in ((0, -1), (1, 1))
    ),
    *(
        ("K2", name, moved(i, side * STEP * 2, side * STEP), f"at mu = outer[{i}]")
        for name in ("as-stated", "repaired-closed-form", "repaired")
        for i, side in ((0, 1), (1, -1))
    ),
    ("K2", "repaired", moved(1, STEP, Fraction(0)), "inner[1] <= outer[1]"),
    ("K2", "gain-bound", moved(1, STEP, STEP), "inner[1] < 1/Delta_max"),
    ("K2", "gain-bound", moved(1, -2 * STEP, -STEP), "1/Delta_max <= outer[1]"),
    ("K2", "gain-bound", moved(0, STEP, Fraction(1, 10**20)), "outer[0] = 0"),
    ("K2", "gain-bound", put(W, "mu", "inner", 0, "0"), "0 < inner[0]"),
    ("K2", "gain-bound", put(W, "mu", "outer", 0, "-1"), "0 <= outer[0]"),
    ("K2", "consensus", put(W, "mu", "inner", 1, "1"), "Q - Pc(t)^T Q Pc(t) > 0"),
    ("K2", "consensus", moved(1, STEP, STEP), "Q - Pc(t)^T Q Pc(t) > 0"),
    ("K2", "consensus", moved(1, -2 * STEP, -STEP), "Pc(t)^T Y Pc(t) - Y >= 0"),
    ("K2", "consensus", moved(0, STEP, Fraction(1, 10**20)), "outer[0] = 0"),
    ("K2", "consensus", put(W, "mu", "Q", [["-1"]]), "Q > 0"),
    ("K2", "consensus", put(W, "mu", "Y", [["0"]]), "Y != 0"),
    ("K2", "repaired", put("statement", "some mu > 0"), "to the letter"),
    ("K2", "gain-bound", put("statement", CONDITIONS["repaired"]), "to the letter"),
    ("paper", "consensus", put(W, "mu", "power", 2), "N - 1"),
    ("paper", "consensus", put(W, "mu", "Q", 2, 0, "1000"), "Q"),
    # pairs of vectors that are not what they are said to be
    ("paper", "repaired", scaled(W, "pairs", 0, 0), "the pairs show"),
    ("paper", "repaired", scaled(W, "pairs", 1, 1), "the pairs show"),
    ("paper", "repaired", put(W, "pairs", SHUT[:1]), "the pairs show"),
    ("paper", "repaired", put(W, "pairs", 0, 0, 0, "7"), "sums to 0"),
    ("paper", "repaired", put(W, "pairs", [[["0"] * 5] * 2]), "not all vectors"),
    ("paper", "repaired", lambda claim: claim[W].pop("pairs"), "there are pairs"),
    ("paper", "repaired", scaled(W, "alpha_opens", "pairs", 0, 0), "below alpha_opens.lower"),
    ("paper", "repaired", put(W, "alpha_opens", "lower", "8630378183/10000000000"), "below alpha_opens.lower"),
    (
        "paper",
        "repaired",
        put(W, "alpha_opens", {**LEAST, "lower": "0", "upper": "863037818/1000000000"}),
        "above alpha_opens.upper",
    ),
    ("paper", "repaired", put(W, "alpha_opens", "mu", "28/100"), "above alpha_opens.upper"),
    ("paper", "repaired", put(W, "alpha_opens", "mu", "0"), "0 < alpha_opens.mu"),
    ("paper", "repaired", put(W, "alpha_opens", "mu", "501/1000"), "0 < alpha_opens.mu"),
    ("paper", "repaired", put(W, "alpha_opens", "lower", "1"), "alpha_opens.lower <="),
    *(
        ("paper", name, put(W, "alpha_opens", end, value), "alpha_opens")
        for name, end, value in (
            ("as-stated", "lower", "5849625008/10000000000"),
            ("as-stated", "upper", "5849625007/10000000000"),
            ("repaired-closed-form", "lower", "8999686270/10000000000"),
            ("repaired-closed-form", "upper", "8999686269/10000000000"),
        )
    ),
]


@pytest.mark.parametrize(("base", "name", "change", "reason"), FALSE)
def test_what_is_false_is_refused(base: str, name: str, change: Callable[[Json], None], reason: str) -> None:
    document = copy.deepcopy(GOOD[base])
    change(at(document, name))
    found = ruled(document)
    assert found[name][0] == "refused", found[name]
    assert reason in found[name][1]
    assert checked(document).exit_status == 1


@pytest.mark.parametrize(
    ("edges", "agents", "alpha", "claim", "reason"),
    [
        (path(2), 2, "1/2", condition("as-stated", "refuted"), "at mu = 1/Delta_max"),
        (path(2), 2, "1/2", condition("repaired-closed-form", "refuted"), "lambda2 / (2 Delta_max)"),
        (path(2), 2, "1/2", condition("gain-bound", "refuted"), "no mu satisfies"),
        (path(2), 2, "1/2", condition("consensus", "refuted"), "no mu satisfies"),
        (PAPER_EDGES, 5, "9/10", condition("repaired", "refuted", pairs=SHUT), "the pairs show"),
        (PAPER_EDGES, 5, "4/5", condition("repaired", "proved", mu=strip(0.28, 0.29)), "inner[0]"),
        (UNBALANCED, 3, "9/10", condition("as-stated", "proved", mu=strip(0.1, 0.2)), "Assumption 1 fails"),
        (UNBALANCED, 3, "9/10", condition("consensus", "proved", mu=strip(0.1, 0.2, Q=[["1"], ["0", "1"]], power=9)),
         "Assumption 1 fails"),
        (UNBALANCED, 3, "9/10", condition("repaired", "refuted", pairs=[[["1", "-1", "0"]] * 2]),
         "the witness is empty"),
        (UNBALANCED, 3, "9/10", condition("as-stated", "refuted", alpha_opens=OPEN_K2), "the witness is empty"),
        ([], 3, "9/10", condition("gain-bound", "proved", mu=strip(0, 1)), "1/Delta_max <= outer[1]"),
    ],
)  # fmt: skip
def test_what_is_false_of_another_design(
    edges: list[list[Any]], agents: int, alpha: str, claim: Json, reason: str
) -> None:
    status, found = ruled(region(edges, agents, alpha, claim))[claim["id"]]
    assert (status, reason in found) == ("refused", True), found


def malformed(document: Json) -> str:
    with pytest.raises(Malformed) as refused:
        checked(document)
    return str(refused.value)


@pytest.mark.parametrize(
    ("name", "change", "reason"),
    [
        ("repaired", put("id", "best"), "$.claims[2].id: expected one of as-stated, "),
        ("repaired", put("id", 1), "$.claims[2].id: expected one of as-stated, "),
        ("repaired", put("id", "as-stated"), "$.claims[2].id: as-stated occurs twice"),
        ("repaired", put("verdict", "undecided"), '$.claims[2].verdict: expected "proved" or "refuted"'),
        ("repaired", put("verdict", []), '$.claims[2].verdict: expected "proved" or "refuted"'),
        ("repaired", put("statement", None), "$.claims[2].statement: expected a string"),
        ("repaired", put("verdict", "proved"), "$.claims[2].witness: unknown key 'pairs'"),
        ("repaired", put(W, "mu", {}), "$.claims[2].witness: unknown key 'mu'"),
        ("repaired", put(W, "pairs", []), "$.claims[2].witness.pairs: expected 1 to 64 pairs"),
        ("repaired", put(W, "pairs", SHUT * 33), "$.claims[2].witness.pairs: expected 1 to 64 pairs"),
        ("repaired", put(W, "pairs", {}), "$.claims[2].witness.pairs: expected an array of pairs"),
        ("repaired", put(W, "pairs", 0, []), "$.claims[2].witness.pairs[0]: expected an array of two vectors"),
        ("repaired", put(W, "pairs", 0, 1, ["1"]), "$.claims[2].witness.pairs[0][1]: expected an array of 5 rationals"),
        ("repaired", put(W, "pairs", 0, 1, 4, 1), "$.claims[2].witness.pairs[0][1][4]: expected a rational"),
        ("repaired", put(W, "alpha_opens", {}), '$.claims[2].witness.alpha_opens: missing key "lower"'),
        ("repaired", put(W, "alpha_opens", "upper", "2"), "$.claims[2].witness.alpha_opens.upper: expected 0 <= alpha"),
        ("as-stated", put(W, "alpha_opens", "mu", "1"), "$.claims[0].witness.alpha_opens: unknown key 'mu'"),
        ("as-stated", put(W, "pairs", SHUT), "$.claims[0].witness: unknown key 'pairs'"),
        ("as-stated", put("verdict", "refuted"), "$.claims[0].witness: unknown key 'mu'"),
        ("as-stated", put(W, {}), '$.claims[0].witness: missing key "mu"'),
        ("gain-bound", put(W, "alpha_opens", {}), "$.claims[3].witness: unknown key 'alpha_opens'"),
        ("gain-bound", put(W, "mu", "Q", []), "$.claims[3].witness.mu: unknown key 'Q'"),
        ("consensus", put(W, "mu", "inner", ["1", "2", "3"]), "$.claims[4].witness.mu.inner: expected an array of two"),
        ("consensus", lambda claim: claim[W]["mu"].pop("Q"), '$.claims[4].witness.mu: missing key "Q"'),
    ],
)
def test_a_defect_of_form(name: str, change: Callable[[Json], None], reason: str) -> None:
    document = copy.deepcopy(PAPER)
    change(at(document, name))
    assert malformed(document).startswith(reason)


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        (put("claims", []), "$.claims: expected at least one condition"),
        (put("claims", {}), "$.claims: expected an array of conditions"),
        (put("values", {"mu": {"lower": "0", "upper": "1"}}), "$.values: unknown key 'mu'"),
        (put("design", "alpha", ["1/2", "3/4"]), "$.design.alpha: expected a rational"),
        (put("design", "h", ["1", "2"]), "$.design.h: expected a rational"),
        (put("design", "gamma", "0"), "$.design.gamma: expected a rational > 0"),
        (put("design", "mu", "-1"), "$.design.mu: expected a rational > 0"),
        (lambda document: document["design"].update(mu="1", gamma="1"), '$.design: expected at most one of "gamma"'),
        (lambda document: document["design"].pop("require"), '$.design: missing key "require"'),
        (put("kind", "design"), '$.design: expected exactly one of "gamma" and "mu"'),
    ],
)
def test_a_defect_of_form_of_the_whole(change: Callable[[Json], None], reason: str) -> None:
    document = copy.deepcopy(PAPER)
    change(document)
    assert malformed(document).startswith(reason)


def test_pairs_of_too_long_numbers_are_left_undecided() -> None:
    document = copy.deepcopy(PAPER)
    at(document, "repaired")[W]["pairs"][0][0][0] = f"1/1{'0' * 30000}"
    at(document, "repaired")[W]["pairs"][0][0][1] = f"-1/1{'0' * 30000}"
    at(document, "repaired")[W]["pairs"][0][0][2:] = ["0"] * 3
    assert ruled(document)["repaired"][0] == "undecided"


def test_a_closed_form_that_nearly_closes_is_decided_by_factorisation() -> None:
    """P4, lambda2 = 2 - sqrt 2, D = 2: at 1e-37 of the alpha that opens it, lambda2 to 2^-60 of it is too coarse."""
    with mpmath.workdps(60):
        alpha = mpmath.log(1 + mpmath.sqrt(1 - (2 - mpmath.sqrt(2)) / 4), 2)
        near = Fraction(int(alpha * 10**55), 10**55).limit_denominator(2**63)
        above = real(near.numerator) / near.denominator > alpha
        assert abs(real(near.numerator) / near.denominator - alpha) < real("1e-36")
    for end, true in (("upper", above), ("lower", not above)):
        claim = condition(
            "repaired-closed-form", "refuted", alpha_opens={"lower": "0", "upper": "1"} | {end: str(near)}
        )
        status, _ = ruled(region(path(4), 4, "1/2", claim))["repaired-closed-form"]
        assert status == ("accepted" if true else "refused")
