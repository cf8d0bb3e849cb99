"""Uncertain designs: what holds for every member is accepted, what fails for one is not; boxes that leave a gap.

K2: lambda2 = 2, D = 1, beta = 1 - 2 mu, sigma = abs(beta). The paper's graph: lambda2 = 1, D = 2, mu* = 2/3.
"""

import copy
from fractions import Fraction
from typing import Any

import mpmath
import pytest

from fomas_verify.checker import Malformed
from tests.checker.builder import (
    CONSENSUS,
    PAPER_EDGES,
    Json,
    certificate,
    checked,
    claim,
    complete,
    decimal,
    design,
    directed_cycle,
    lyapunov,
    outcome,
    path,
)
from tests.checker.sampled import real

WORST = ["0", "-1", "-1", "-1", "1"]
EVERY, ONE = "control-norm-bound", "trajectory-norm-bound"
K2: Json = {**design(path(2), 2), "alpha": ["3/5", "9/10"], "mu": ["1/4", "1/2"], "x0": ["1", "0"]}
PAPER: Json = {
    **design(PAPER_EDGES, 5, x0=["9/2", "5", "6", "3/2", "-1"]),
    "alpha": ["89/100", "91/100"],
    "gamma": ["24/100", "26/100"],
    "h": ["84/100", "86/100"],
}
PAPER_MEMBER = {"alpha": "9/10", "gamma": "25/100", "h": "17/20"}
ROUND: Json = {**design(path(2), 2), "alpha": ["3/10", "7/10"], "gamma": "1", "h": "1"}


def box(alpha: tuple[Any, Any], mu: tuple[Any, Any], /, **witness: Any) -> Json:
    return {"alpha": [str(x) for x in alpha], "mu": [str(x) for x in mu], "witness": witness}


def ruled(about: Json, name: str, verdict: str, witness: Json) -> tuple[str, str]:
    return outcome(certificate(about, [{**claim(name, verdict), "witness": witness}]), name)


def near(x: Any, digits: int, up: bool) -> str:
    with mpmath.workdps(50):
        return decimal(x, digits, up)


def mu_at(alpha: str, gamma: str, h: str) -> Any:
    return real(gamma) * real(h) ** real(alpha) / mpmath.gamma(1 + real(alpha))


with mpmath.workdps(40):
    # mu falls where log h < psi(1 + alpha), as it does with h < 1 and alpha > 0.4617.
    LEAST, GREATEST = mu_at("91/100", "24/100", "84/100"), mu_at("89/100", "26/100", "86/100")
    SUMMIT = 1 / mpmath.gamma(mpmath.findroot(mpmath.digamma, 1.46))
T = near(GREATEST, 20, True)
STABLE = {"mu": T, "Q": lyapunov(PAPER_EDGES, 5, Fraction(T), 40)}
COVER = [box(("89/100", "91/100"), (near(LEAST, 4, False), near(GREATEST, 4, True)))]

ACCEPTED: list[tuple[Json, str, str, Json]] = [
    (K2, "graph-assumption", "proved", {}),
    (K2, "gain-bound", "proved", {}),
    (K2, "memory-inequality", "proved", {"boxes": [box(("3/5", "9/10"), ("1/4", "1/2"))]}),
    (K2, "repaired-condition", "proved", {"boxes": [box(("3/5", "9/10"), ("1/4", "1/2"))]}),
    (K2, EVERY, "proved", {"boxes": [box(("3/5", "9/10"), ("1/4", "1/2"))]}),
    (K2, ONE, "proved", {"boxes": [box(("3/5", "9/10"), ("1/4", "1/2"))]}),
    (K2, EVERY, "proved", {"boxes": [box(("59/100", "99/100"), ("1/4", "1"), mu="1", lambda_max_upper="2")]}),
    (K2, ONE, "proved", {"boxes": [box(("59/100", "99/100"), ("1/4", "1"), mu="1", lambda_max_upper="2")]}),
    (
        K2,
        "memory-inequality",
        "proved",
        {
            "boxes": [
                box(("59/100", "7/10"), ("1/4", "3/10")),
                box(("59/100", "7/10"), ("3/10", "1/2")),
                box(("69/100", "95/100"), ("1/4", "3/5")),
            ]
        },
    ),
    (K2, "beta-contraction", "proved", {"mu": "1/2", "lambda2_upper": "2", "lambda_max_upper": "2"}),
    *((K2, name, "proved", {"mu": "3/4", "Q": [["1"]]}) for name in CONSENSUS),
    ({**K2, "alpha": "3/5"}, "memory-inequality", "proved", {"boxes": [box(("3/5", "3/5"), ("1/4", "1/2"))]}),
    ({**K2, "mu": "1/3"}, "memory-inequality", "proved", {"boxes": [box(("3/5", "9/10"), ("1/3", "1/3"))]}),
    ({**K2, "x0": ["2", "2"]}, ONE, "proved", {"boxes": [box(("1/10", "9/10"), ("1/9", "5"))]}),
    (
        {**K2, "x0": ["2", "2"], "mu": ["1/4", "1/3"]},
        ONE,
        "proved",
        {"boxes": [box(("3/5", "9/10"), ("1/4", "1/3"), samples=0, powers=1)]},
    ),
    ({**design(path(2), 2), "alpha": ["1/2", "3/5"], "mu": "1"}, "gain-bound", "refuted",
     {"member": {"alpha": "1/2", "mu": "1"}, "witness": {}}),
    (design([[1, 2, "1"]], 2) | {"alpha": "1/2", "mu": ["1", "2"]}, "average-consensus", "inapplicable", {}),
    (design([[1, 2, "1"]], 2) | {"alpha": "1/2", "mu": ["1", "2"]}, "graph-assumption", "refuted",
     {"unreachable": [2, 1]}),
    (design([], 2) | {"alpha": "1/2", "mu": ["1", "2"]}, "gain-bound", "proved", {}),
    (K2, "memory-inequality", "undecided", {"bits": 4096}),
    (PAPER, "gain-bound", "proved", {}),
    (PAPER, "memory-inequality", "proved", {"boxes": COVER}),
    (PAPER, "repaired-condition", "proved", {"boxes": COVER}),
    (PAPER, EVERY, "proved", {"boxes": COVER}),
    (PAPER, ONE, "proved", {"boxes": COVER}),
    *((PAPER, name, "proved", STABLE) for name in CONSENSUS),
    (PAPER, "beta-contraction", "refuted", {"member": PAPER_MEMBER, "witness": {"e": ["-1", "-3", "-3", "1", "6"]}}),
    ({**PAPER, "gamma": ["3/20", "26/100"]}, EVERY, "refuted",
     {"member": {"alpha": "9/10", "gamma": "3/20", "h": "17/20"}, "witness": {"x0": WORST, "k": 1}}),
    ({**PAPER, "gamma": ["3/20", "26/100"], "x0": WORST}, ONE, "refuted",
     {"member": {"alpha": "9/10", "gamma": "3/20", "h": "17/20"}, "witness": {"k": 1}}),
    ({**PAPER, "gamma": ["1/10", "1"]}, "gain-bound", "refuted",
     {"member": {"alpha": "9/10", "gamma": "1", "h": "17/20"}, "witness": {}}),
    ({**PAPER, "gamma": ["1/10", "1"]}, "average-consensus", "refuted",
     {"member": {"alpha": "9/10", "gamma": "1", "h": "17/20"}, "witness": {"mu": "7/10", "power": 1000}}),
    ({**K2, "mu": ["1/5", "1/2"]}, "memory-inequality", "refuted",
     {"member": {"alpha": "3/5", "mu": "1/5"}, "witness": {"k": 0}}),
    ({**K2, "h": ["1", "2"]}, "memory-inequality", "proved", {"boxes": [box(("3/5", "9/10"), ("1/4", "1/2"))]}),
]  # fmt: skip


@pytest.mark.parametrize(("about", "name", "verdict", "witness"), ACCEPTED)
def test_claims_about_every_member(about: Json, name: str, verdict: str, witness: Json) -> None:
    assert ruled(about, name, verdict, witness)[0] == "accepted"


def test_a_lemma_over_boxes() -> None:
    """The paper's graph near mu = 0.162: sigma is 0.863, and 2^alpha - 1 0.866; the trajectory's ratio is smaller."""
    about = {**PAPER, "alpha": ["8999/10000", "9001/10000"], "mu": ["1616/10000", "1618/10000"]}
    del about["gamma"], about["h"]
    for name, samples in ((EVERY, 0), (EVERY, 1), (ONE, 0), (ONE, 2)):
        boxes = [box(about["alpha"], about["mu"], samples=samples, powers=2)]
        assert ruled(about, name, "proved", {"boxes": boxes})[0] == "accepted"
    boxes = [box(about["alpha"], ("134/1000", "1618/10000"), samples=0, powers=2)]
    assert ruled(about, EVERY, "proved", {"boxes": boxes})[0] == "undecided"
    boxes = [box(("1/10", "95/100"), about["mu"], samples=0, powers=2)]
    assert ruled(about, EVERY, "proved", {"boxes": boxes})[0] == "undecided"
    boxes = [box(("1/10", "95/100"), ("1/100", "2/10"), samples=3, powers=2)]
    assert ruled(about, ONE, "proved", {"boxes": boxes})[0] == "undecided"


FIRST = "beta <= 2^alpha - 1"
REFUSED: list[tuple[Json, str, str, Json, str]] = [
    (K2, "memory-inequality", "proved", {"boxes": [box(("58/100", "9/10"), ("1/4", "1/2"))]}, FIRST),
    (K2, "memory-inequality", "proved", {"boxes": [box(("3/5", "9/10"), ("1/5", "1/2"))]}, FIRST),
    (K2, "memory-inequality", "proved", {"boxes": [box(("3/5", "9/10"), ("1/4", "1"))]},
     "beta >= -sqrt(3^alpha - 2^alpha)"),
    (K2, "repaired-condition", "proved", {"boxes": [box(("58/100", "9/10"), ("1/4", "1/2"))]}, "sigma <= 2^alpha - 1"),
    (K2, "repaired-condition", "proved", {"boxes": [box(("3/5", "9/10"), ("1/4", "4/5"))]}, "sigma <= 2^alpha - 1"),
    (K2, EVERY, "proved", {"boxes": [box(("58/100", "9/10"), ("1/4", "1/2"))]}, "sigma <= 2^alpha - 1"),
    (K2, ONE, "proved", {"boxes": [box(("58/100", "9/10"), ("1/4", "1/2"))]}, "sigma <= 2^alpha - 1"),
    (K2, EVERY, "proved", {"boxes": [box(("58/100", "9/10"), ("1/4", "1"), mu="1", lambda_max_upper="2")]}, FIRST),
    (K2, EVERY, "proved", {"boxes": [box(("3/5", "9/10"), ("1/4", "1"), mu="99/100", lambda_max_upper="2")]},
     "mu <= witness.mu"),
    (K2, "memory-inequality", "proved", {"boxes": [box(("61/100", "9/10"), ("1/4", "1/2"))]},
     "the first slab begins at or below the least alpha"),
    (K2, "memory-inequality", "proved", {"boxes": [box(("3/5", "89/100"), ("1/4", "1/2"))]},
     "the last slab ends at or above the greatest alpha"),
    (K2, "memory-inequality", "proved", {"boxes": [box(("3/5", "9/10"), ("26/100", "1/2"))]},
     "the first box of a slab begins at or below every member's mu"),
    (K2, "memory-inequality", "proved", {"boxes": [box(("3/5", "9/10"), ("1/4", "49/100"))]},
     "the last box of a slab ends at or above every member's mu"),
    (K2, "memory-inequality", "proved",
     {"boxes": [box(("3/5", "9/10"), ("1/4", "1/3")), box(("3/5", "9/10"), ("2/5", "1/2"))]},
     "each box of a slab begins at or below the end of the one before"),
    (K2, "memory-inequality", "proved",
     {"boxes": [box(("3/5", "7/10"), ("1/4", "1/2")), box(("71/100", "9/10"), ("1/4", "1/2"))]},
     "each slab begins in the one before and ends after it"),
    (K2, "memory-inequality", "proved",
     {"boxes": [box(("3/5", "9/10"), ("1/4", "1/2")), box(("4/5", "9/10"), ("1/4", "1/2"))]},
     "each slab begins in the one before and ends after it"),
    (K2, "memory-inequality", "proved",
     {"boxes": [box(("3/5", "4/5"), ("1/4", "1/2")), box(("4/5", "9/10"), ("1/4", "1/3"))]},
     "the last box of a slab ends at or above every member's mu"),
    (K2, "memory-inequality", "proved", {"boxes": [box(("9/10", "3/5"), ("1/4", "1/2"))]},
     "the ends of a box are in order"),
    (K2, "memory-inequality", "proved", {"boxes": [box(("3/5", "9/10"), ("1/2", "1/4"))]},
     "the ends of a box are in order"),
    (K2, "beta-contraction", "proved", {"mu": "49/100", "lambda2_upper": "2", "lambda_max_upper": "2"},
     "mu <= witness.mu for every member"),
    (K2, "beta-contraction", "proved", {"mu": "51/100", "lambda2_upper": "2", "lambda_max_upper": "2"},
     "witness.mu witness.lambda2_upper <= 1"),
    (K2, "average-consensus", "proved", {"mu": "1", "Q": [["1"]]}, "Q - Pc(t)^T Q Pc(t) > 0"),
    (K2, "average-consensus", "proved", {"mu": "1/3", "Q": [["1"]]}, "mu <= witness.mu for every member"),
    (K2, "average-consensus", "proved", {"mu": "-1", "Q": [["1"]]}, "mu <= witness.mu for every member"),
    ({**K2, "mu": ["1/4", "1"]}, "gain-bound", "proved", {}, "mu < 1/Delta_max for every member"),
    ({**K2, "mu": ["1/4", "2"]}, "gain-bound", "proved", {}, "mu < 1/Delta_max for every member"),
    (ROUND, "gain-bound", "proved", {}, "mu < 1/Delta_max for every member"),
    (K2, "gain-bound", "refuted", {"member": {"alpha": "4/5", "mu": "1/3"}, "witness": {}}, "mu >= 1/Delta_max"),
    (K2, "gain-bound", "refuted", {"member": {"alpha": "4/5", "mu": "3/2"}, "witness": {}},
     "mu of the member lies in its interval"),
    (K2, "gain-bound", "refuted", {"member": {"alpha": "1/2", "mu": "1/3"}, "witness": {}},
     "alpha of the member lies in its interval"),
    ({**K2, "mu": "1/3"}, "gain-bound", "refuted", {"member": {"alpha": "4/5", "mu": "3/2"}, "witness": {}},
     "mu of the member lies in its interval"),
    (K2, "memory-inequality", "refuted", {"member": {"alpha": "3/5", "mu": "1/4"}, "witness": {"k": 0}},
     "beta > 2^alpha - 1"),
    (PAPER, "repaired-condition", "refuted", {"member": PAPER_MEMBER, "witness": {"e": ["-1", "-3", "-3", "1", "6"]}},
     "norm(P e) > (2^alpha - 1) norm(e)"),
    (PAPER, "repaired-condition", "proved", {"boxes": [box(("89/100", "91/100"), ("21/100", "23/100"))]},
     "the last box of a slab ends at or above every member's mu"),
    (PAPER, "average-consensus", "proved", {**STABLE, "mu": "23/100"}, "mu <= witness.mu for every member"),
    ({k: v for k, v in K2.items() if k != "x0"}, ONE, "proved", {"boxes": [box(("3/5", "9/10"), ("1/4", "1/2"))]},
     "the design has x0"),
    (K2, "gain-bound", "inapplicable", {}, "Assumption 1 fails, and the claim presupposes it"),
    (design(directed_cycle(3)[1:], 3) | {"alpha": "1/2", "mu": ["1", "2"]}, "memory-inequality", "proved",
     {"boxes": [box(("1/2", "1/2"), ("1", "2"))]}, "the claim is applicable (Assumption 1 fails)"),
    (K2, "graph-assumption", "refuted", {"unreachable": [1, 2]}, "no directed path leads from agent 1 to agent 2"),
]  # fmt: skip


@pytest.mark.parametrize(("about", "name", "verdict", "witness", "reason"), REFUSED)
def test_claims_that_fail_for_a_member(about: Json, name: str, verdict: str, witness: Json, reason: str) -> None:
    assert ruled(about, name, verdict, witness) == ("refused", f"not true: {reason}")


def test_a_slab_outside_the_range_of_alpha_need_not_hold_a_member() -> None:
    boxes = [
        box(("59/100", "595/1000"), ("7/20", "9/25")),
        box(("595/1000", "9/10"), ("1/4", "1/2")),
        box(("9/10", "95/100"), ("1/4", "1/2")),
    ]
    assert ruled(K2, "memory-inequality", "proved", {"boxes": boxes})[0] == "accepted"
    boxes[2] = box(("9/10", "95/100"), ("1/4", "1/3"))
    assert ruled(K2, "memory-inequality", "proved", {"boxes": boxes})[0] == "refused"


def test_boxes_must_hold_every_mu_of_their_slab() -> None:
    """h = 1: mu = 1/Gamma(1 + alpha) has its greatest value, 1.129..., within the range of alpha."""
    with mpmath.workdps(40):
        low, high = 1 / mpmath.gamma(mpmath.mpf("1.7")), SUMMIT
        least = min(low, 1 / mpmath.gamma(mpmath.mpf("1.3")))
        fits = box(("3/10", "7/10"), (near(least, 6, False), near(high * (1 + mpmath.mpf("0.01")), 6, True)))
        short = box(("3/10", "7/10"), (near(least, 6, False), near(high, 6, False)))
        late = box(("3/10", "7/10"), (near(least, 6, True), near(2 * high, 6, False)))
    about = {**ROUND, "x0": ["1", "1"]}
    assert ruled(about, ONE, "proved", {"boxes": [fits]})[0] == "accepted"
    for part in (short, late):
        assert ruled(about, ONE, "proved", {"boxes": [part]})[0] == "refused"


def test_hostile_boxes_end() -> None:
    long = box(("3/5", "9/10"), ("1/4", "1/2" + "0" * 2000))
    status, reason = ruled(K2, "memory-inequality", "proved", {"boxes": [long]})
    assert (status, reason) == ("undecided", "boxes with ends of more than 4096 bits are beyond the work allowed")
    about = {**design(complete(20), 20), "alpha": ["3/5", "9/10"], "mu": ["1/40", "1/20"]}
    for many in (
        [box(("3/5", "9/10"), ("1/40", "1/20"), samples=2**15, powers=2**15)] * 2,
        [box(("3/5", "9/10"), ("1/40", "1/20"), samples=10**70, powers=1)],
    ):
        status, reason = ruled(about, EVERY, "proved", {"boxes": many})
        assert (status, reason) == ("undecided", "as many boxes and samples are beyond the work allowed")
    about = {**design(complete(90), 90), "alpha": ["3/5", "9/10"], "mu": ["1/400", "1/200"]}
    many = [box(("3/5", "9/10"), ("1/400", "1/200"))] * 4096
    assert ruled(about, EVERY, "proved", {"boxes": many})[0] == "undecided"


BOX = box(("3/5", "9/10"), ("1/4", "1/2"))
MEMBER = {"member": {"alpha": "3/5", "mu": "1/4"}, "witness": {"k": 0}}
FORMS: list[tuple[str, str, Any, str]] = [
    ("memory-inequality", "proved", {}, ""),
    ("memory-inequality", "proved", {"boxes": []}, ".boxes"),
    ("memory-inequality", "proved", {"boxes": {}}, ".boxes"),
    ("memory-inequality", "proved", {"boxes": [BOX] * 4097}, ".boxes"),
    ("memory-inequality", "proved", {"boxes": [{**BOX, "h": ["1", "2"]}]}, ".boxes[0]"),
    ("memory-inequality", "proved", {"boxes": [BOX, {**BOX, "alpha": ["0", "1/2"]}]}, ".boxes[1].alpha[0]"),
    ("memory-inequality", "proved", {"boxes": [{**BOX, "alpha": ["1/2", "1"]}]}, ".boxes[0].alpha[1]"),
    ("memory-inequality", "proved", {"boxes": [{**BOX, "alpha": "1/2"}]}, ".boxes[0].alpha"),
    ("memory-inequality", "proved", {"boxes": [{**BOX, "alpha": [f"1/{2**64}", "1/2"]}]}, ".boxes[0].alpha[0]"),
    ("memory-inequality", "proved", {"boxes": [{**BOX, "mu": ["0", "1/2"]}]}, ".boxes[0].mu[0]"),
    ("memory-inequality", "proved", {"boxes": [{**BOX, "mu": ["1/2"]}]}, ".boxes[0].mu"),
    ("memory-inequality", "proved", {"boxes": [{**BOX, "witness": {"k": 0}}]}, ".boxes[0].witness"),
    (EVERY, "proved", {"boxes": [{**BOX, "witness": {"samples": 1}}]}, ".boxes[0].witness"),
    ("memory-inequality", "refuted", {"k": 0}, ""),
    ("memory-inequality", "refuted", {**MEMBER, "witness": {}}, ".witness"),
    ("memory-inequality", "refuted", {**MEMBER, "member": {"alpha": "3/5"}}, ".member"),
    ("memory-inequality", "refuted", {**MEMBER, "member": {"alpha": "3/5", "mu": "1", "h": "1"}}, ".member"),
    ("memory-inequality", "refuted", {**MEMBER, "member": {"alpha": "3/5", "mu": ["1", "2"]}}, ".member.mu"),
    ("memory-inequality", "refuted", {**MEMBER, "member": {"alpha": "1", "mu": "1"}}, ".member.alpha"),
    ("memory-inequality", "refuted", {**MEMBER, "member": {"alpha": "1/2", "mu": "0"}}, ".member.mu"),
    ("gain-bound", "refuted", {}, ""),
    ("gain-bound", "proved", {"boxes": [BOX]}, ""),
    ("graph-assumption", "refuted", {"member": MEMBER["member"], "witness": {"unreachable": [1, 2]}}, ""),
]


@pytest.mark.parametrize(("name", "verdict", "witness", "where"), FORMS)
def test_form(name: str, verdict: str, witness: Any, where: str) -> None:
    with pytest.raises(Malformed) as caught:
        ruled(K2, name, verdict, witness)
    assert caught.value.path == f"$.claims[0].witness{where}"


INTERVALS: list[tuple[str, Any, str]] = [
    ("alpha", ["9/10", "3/5"], ".alpha"),
    ("alpha", ["3/5", "3/5"], ".alpha"),
    ("alpha", ["0", "3/5"], ".alpha[0]"),
    ("alpha", ["3/5", "1"], ".alpha[1]"),
    ("alpha", [f"1/{2**64}", "3/5"], ".alpha[0]"),
    ("alpha", ["1/5", "2/5", "3/5"], ".alpha"),
    ("mu", ["0", "1"], ".mu[0]"),
    ("mu", ["1", 2], ".mu[1]"),
    ("mu", ["2", "1"], ".mu"),
    ("h", ["1", "1"], ".h"),
    ("gamma", ["1", "2"], ""),
]


@pytest.mark.parametrize(("key", "value", "where"), INTERVALS)
def test_form_of_intervals(key: str, value: Any, where: str) -> None:
    about = copy.deepcopy(K2)
    about[key] = value
    with pytest.raises(Malformed) as caught:
        checked(certificate(about))
    assert caught.value.path == f"$.design{where}"


def test_the_design_is_given_back_with_its_intervals() -> None:
    found = checked(certificate(PAPER)).design
    assert (found.alpha, found.mu) == ((Fraction(89, 100), Fraction(91, 100)), None)
    assert (found.gamma, found.h) == ((Fraction(6, 25), Fraction(13, 50)), (Fraction(21, 25), Fraction(43, 50)))
