"""Many designs at once: mu over intervals of alpha, the memory between two alphas, boxes, and margins shown by them."""

import json
import random
from fractions import Fraction
from typing import Any

import mpmath
import pytest

from fomas_verify.checker import Malformed, check, corners, definite, facts, parts
from fomas_verify.checker.box import Box, require_over
from fomas_verify.checker.corners import first_sign, lambda2, second_sign, sigma_sign
from fomas_verify.checker.gain import Gain
from fomas_verify.checker.graph import Graph
from fomas_verify.checker.operators import operators
from fomas_verify.checker.parts import throughout
from fomas_verify.checker.powers import point
from fomas_verify.checker.resolvent import KernelBetween, kernel
from fomas_verify.checker.ruling import Refused, Undecided
from fomas_verify.checker.witness import Lemma
from tests.checker.builder import PAPER_EDGES, Json, certificate, checked, complete, cycle, design, outcome, path
from tests.checker.sampled import DIGITS, power_norm, real, resolvent, sample_norm

BITS = 128
WORST = ["0", "-1", "-1", "-1", "1"]
EVERY = "control-norm-bound"
PAPER = design(PAPER_EDGES, 5, gamma="3/20", h="17/20")
REPAIRED = design(PAPER_EDGES, 5, gamma="9/50", h="17/20")
K2 = design(path(2), 2, mu="1/2")
K5 = design(complete(5), 5, mu="1/5")


def graph(about: Json) -> Graph:
    return Graph(check(json.dumps(certificate(about)).encode()).design)


def box(about: Json, alpha: tuple[str, str], mu: tuple[str, str]) -> Box:
    return Box(graph(about), (Fraction(alpha[0]), Fraction(alpha[1])), (Fraction(mu[0]), Fraction(mu[1])))


@pytest.mark.parametrize("h", ["1/1000", "1/2", "17/20", "1", "6/5", "3/2", "100"])
@pytest.mark.parametrize("ends", [("0", "1"), ("1/10", "1/5"), ("0", "1/2"), ("2/5", "9/10"), ("89/100", "9/10")])
def test_mu_over_an_interval(h: str, ends: tuple[str, str]) -> None:
    """Every mu lies between the bounds; over a slab they are as close as the format's page promises."""
    first, last = map(Fraction, ends)
    gain = Gain((Fraction(1, 5), Fraction(1, 4)), None, (Fraction(h), Fraction(h) * 2))
    wide, close = gain.over(first, last, BITS), gain.over_slab(first, last, BITS)
    choose = random.Random(h + ends[0])
    with mpmath.workdps(40):
        found = []
        for alpha in (first, last, *(first + (last - first) * Fraction(choose.random()) for _ in range(200))):
            a = mpmath.mpf(alpha.numerator) / alpha.denominator
            for gamma, step in ((real("1/5"), real(h)), (real("1/4"), 2 * real(h))):
                found.append(gamma * step**a / mpmath.gamma(1 + a))
        for bounds in (wide, close):
            assert bounds.lower <= Fraction(mpmath.nstr(min(found), 30)) * (1 + Fraction(1, 10**25))
            assert bounds.upper >= Fraction(mpmath.nstr(max(found), 30)) * (1 - Fraction(1, 10**25))
        room = 1 + (real(ends[1]) - real(ends[0])) * (abs(mpmath.log(2 * real(h))) + abs(mpmath.log(real(h))) + 1) / 8
        assert close.upper <= Fraction(mpmath.nstr(max(found) * room, 30))
        assert close.lower * Fraction(mpmath.nstr(room, 30)) >= Fraction(mpmath.nstr(min(found), 30))


def test_mu_that_is_given_is_the_same_for_every_alpha() -> None:
    gain = Gain(None, (Fraction(1, 3), Fraction(1, 2)), None)
    for found in (gain.at(Fraction(1, 2), BITS), gain.over(Fraction(0), Fraction(1), BITS)):
        assert (found.lower, found.upper) == (Fraction(1, 3), Fraction(1, 2))


@pytest.mark.parametrize("between", [("1/10", "3/20"), ("1/2", "1/2"), ("89/100", "91/100"), ("1/100", "99/100")])
def test_the_memory_between_two_alphas(between: tuple[str, str]) -> None:
    first, last = map(Fraction, between)
    scale = 128
    found = KernelBetween(kernel(first, scale), kernel(last, scale))
    for part in range(5):
        alpha = str(first + (last - first) * part / 4)
        exact = resolvent(alpha, 40)
        with mpmath.workdps(DIGITS):
            a = real(alpha)
            c = [mpmath.mpf(n + 1) ** a - mpmath.mpf(n) ** a for n in range(60)]
            for n in (0, 1, 2, 3, 17, 40):
                low, high = found.resolvent(n)
                assert 0 <= low <= exact[n] * 2**scale + 1
                assert exact[n] * 2**scale - 1 <= high <= 2**scale + n**2
                low, high = found.step_response(n)
                assert low <= c[n] * 2**scale <= high
                low, high = found.decay(n + 1, 7)
                assert low <= c[n + 8] / c[n + 1] * 2**scale <= high
    if first == last:
        assert all(high - low < 2**30 for low, high in map(found.resolvent, range(40)))


def test_norms_over_a_box() -> None:
    """Bounds beside the largest and the smallest of nine designs are decided, those between are not."""
    about = box(PAPER, ("89/100", "91/100"), ("134/1000", "135/1000"))
    found = operators(about, BITS)
    alphas, gains = ("89/100", "9/10", "91/100"), ("134/1000", "1345/10000", "135/1000")
    with mpmath.workdps(DIGITS):
        for k in (1, 3, 9):
            members = [design(PAPER_EDGES, 5, alpha, mu=mu) for alpha in alphas for mu in gains]
            for sign, norm_of in ((found.sample_sign, sample_norm), (found.power_sign, power_norm)):
                sizes = [norm_of(member, k) for member in members]
                low, high = int(min(sizes) * found.one), int(max(sizes) * found.one)
                slack = found.one // 50 * k
                assert sign(k, high + slack, high + slack) == 1
                assert sign(k, low - slack, low - slack) == -1
                assert sign(k, (low + high) // 2, (low + high) // 2) is None


def test_a_box_that_is_too_wide_is_left_undecided() -> None:
    with pytest.raises(Undecided, match="norm Phi_k <= 1"):
        require_over(box(REPAIRED, ("1/10", "9/10"), ("1/10", "1/5")), EVERY, "proved", Lemma(3, 2))
    with pytest.raises(Refused, match=r"c_n for n = K\+1\.\.K\+m"):
        require_over(box(PAPER, ("1/10", "1/5"), ("1/10", "1/9")), EVERY, "proved", Lemma(0, 2))


@pytest.mark.parametrize(
    ("about", "exact"),
    [
        (K2, "2"),
        (K5, "5"),
        (PAPER, "1"),
        (design(cycle(4), 4, mu="1"), "2"),
        (design(complete(5, "1/1" + "0" * 40), 5, mu="1"), "5/1" + "0" * 40),
    ],
)
def test_lambda2_is_enclosed(about: Json, exact: str) -> None:
    found = lambda2(graph(about))
    assert found.lower <= Fraction(exact) <= found.upper
    assert found.upper - found.lower <= found.lower / 2**60


def test_lambda2_where_it_is_irrational_or_beyond_the_work_allowed(monkeypatch: pytest.MonkeyPatch) -> None:
    about = graph(design(path(4), 4, "1/2", mu="1"))
    found = lambda2(about)
    assert 0 < 2 - found.upper < 2 - found.lower
    assert (2 - found.upper) ** 2 < 2 < (2 - found.lower) ** 2
    with monkeypatch.context() as poor:
        poor.setattr(corners, "_lambda2_above", lambda graph: 2 * graph.degree_max)
        halved = lambda2.__wrapped__(about)
        assert halved.lower <= found.upper
        assert found.lower <= halved.upper <= halved.lower + halved.lower / 2**60
        assert lambda2.__wrapped__(graph(PAPER)) == point(Fraction(1))
    monkeypatch.setattr(corners, "MAX_SIGN_WORK", 64 * 3)
    coarse = lambda2.__wrapped__(about)
    assert (coarse.lower, coarse.upper) == (Fraction(1, 2), 1)


def test_lambda2_where_a_tie_takes_too_much_work_to_be_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    """lambda2 = 1 on the paper's graph."""
    monkeypatch.setattr(definite, "MAX_EXACT_WORK", 1)
    found = lambda2.__wrapped__(graph(PAPER))
    assert 1 - Fraction(1, 2**60) <= found.lower < 1 <= found.upper


def test_lambda2_where_the_iteration_leads_nowhere(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where all entries end equal, (1, -1, 0, ..) stands in: on P4 its quotient is 5/2."""
    monkeypatch.setattr(corners, "iterated", lambda rows, vector: [7] * len(vector))
    found = corners._lambda2_above(graph(design(path(4), 4, "1/2", mu="1")))
    assert Fraction(5, 2) <= found < Fraction(5, 2) + Fraction(1, 2**100)
    assert corners._lambda2_above(graph(K2)) == 2


def test_corners() -> None:
    """P4 at alpha = 1/2 and mu = 1: beta = 2^alpha - 1 exactly, sigma = 1 + sqrt 2; K2 at mu = 1/2 and 1."""
    half, zero, one = Fraction(1, 2), Fraction(0), Fraction(1)
    about = graph(design(path(4), 4, "1/2", mu="1"))
    assert first_sign(about, half, one) == 0
    assert first_sign(about, half, one, exact=False) is None
    assert first_sign(about, half, one + Fraction(1, 10**30)) == 1
    assert second_sign(about, half, one) == -1
    assert sigma_sign(about, half, one) == -1
    two = graph(K2)
    assert [first_sign(two, alpha, half) for alpha in (zero, one)] == [0, 1]
    assert [second_sign(two, alpha, half) for alpha in (zero, one)] == [0, -1]
    assert [second_sign(two, alpha, one) for alpha in (zero, one)] == [1, 0]
    assert [sigma_sign(two, alpha, half) for alpha in (zero, one)] == [0, 1]
    assert [sigma_sign(two, alpha, half, exact=False) for alpha in (zero, one)] == [None, 1]
    assert [sigma_sign(two, alpha, one) for alpha in (zero, one)] == [-1, 0]
    # 100 digits from the tie mu = (1 + sqrt(sqrt 3 - sqrt 2))/2, and from sigma = 1 - 2 mu = sqrt 2 - 1
    with mpmath.workdps(120):
        for tie, sign, below in (
            ((1 + mpmath.sqrt(mpmath.sqrt(3) - mpmath.sqrt(2))) / 2, second_sign, -1),
            (1 - mpmath.sqrt(2) / 2, sigma_sign, -1),
        ):
            mu = Fraction(int(tie * 10**100), 10**100)
            assert sign(two, half, mu, exact=False) is None
            assert sign(two, half, mu) == below
            assert sign(two, half, mu + Fraction(1, 10**100)) == 1


def test_halving_ends() -> None:
    third = Fraction(1, 3)
    asked: list[Fraction] = []

    def away(low: Fraction, high: Fraction) -> bool:
        asked.append(high - low)
        return not low <= third <= high

    assert throughout(Fraction(0), Fraction(1), away, lambda p, q: False) is None
    assert min(asked) == Fraction(1, 2**parts.MAX_HALVINGS)
    assert throughout(Fraction(0), Fraction(1), away, lambda p, q: p == q < third) == -1
    asked.clear()
    assert throughout(Fraction(0), Fraction(1), lambda p, q: away(Fraction(0), q), lambda p, q: False) is None
    assert len(asked) < 2 * parts.MAX_PARTS
    assert throughout(Fraction(0), Fraction(1), lambda p, q: q - p < third, lambda p, q: False) == 1
    assert throughout(Fraction(0), Fraction(1), lambda p, q: q - p < third, lambda p, q: False, 3) is None


def margin(which: str, inner: tuple[str, str], verdict: str, witness: Json) -> Json:
    return {which: {"inner": list(inner), "witness": {"verdict": verdict, "witness": witness}}}


def ruled(about: Json, part: Json) -> tuple[str, str]:
    document = certificate(about)
    document["values"] = {"margins": {EVERY: part}}
    return outcome(document, f"margins.{EVERY}.{next(iter(part))}")


EXCESS = {"x0": WORST, "k": 1}
LARGEST = {"mu": "1", "lambda_max_upper": "2"}
ACCEPTED: list[tuple[Json, Json]] = [
    (PAPER, margin("mu", ("134/1000", "135/1000"), "refuted", EXCESS)),
    (PAPER, margin("alpha", ("899/1000", "901/1000"), "refuted", EXCESS)),
    (PAPER, margin("alpha", ("9/10", "9/10"), "refuted", EXCESS)),
    (REPAIRED, margin("mu", ("15678263/100000000", "39651947/100000000"), "proved", {})),
    (REPAIRED, margin("alpha", ("9/10", "23/25"), "proved", {})),
    (REPAIRED, margin("mu", ("1613/10000", "1621/10000"), "proved", {"samples": 0, "powers": 1})),
    (REPAIRED, margin("mu", ("1614/10000", "1619/10000"), "proved", {"samples": 2, "powers": 2})),
    (REPAIRED, margin("alpha", ("899/1000", "901/1000"), "proved", {"samples": 1, "powers": 2})),
    (K2, margin("mu", ("6697/100000", "1"), "proved", LARGEST)),
    (K2, margin("alpha", ("1/1000", "999/1000"), "proved", LARGEST)),
    (K2, margin("alpha", ("1/1000", "999/1000"), "proved", {})),
    ({**K2, "mu": "3/2"}, margin("mu", ("101/100", "1" + "0" * 50), "refuted", {"mu": "101/100", "power": 1})),
    ({**K2, "mu": "3/2"}, margin("alpha", ("1/1000", "999/1000"), "refuted", {"mu": "3/2", "power": 7})),
    ({**K2, "mu": "1/100"}, margin("mu", ("1/1000", "1/50"), "refuted", {"x0": ["1", "-1"], "k": 1})),
]


@pytest.mark.parametrize(("about", "part"), ACCEPTED)
def test_margins_of_the_norm_bound(about: Json, part: Json) -> None:
    assert ruled(about, part)[0] == "accepted"


SIGMA = "sigma <= 2^alpha - 1"
REFUSED: list[tuple[Json, Json, str]] = [
    (PAPER, margin("mu", ("135/1000", "136/1000"), "refuted", EXCESS), "inner[0] <= mu"),
    (PAPER, margin("mu", ("133/1000", "134/1000"), "refuted", EXCESS), "mu <= inner[1]"),
    (PAPER, margin("mu", ("136/1000", "133/1000"), "refuted", EXCESS), "inner[0] <= mu"),
    (PAPER, margin("alpha", ("901/1000", "902/1000"), "refuted", EXCESS), "inner[0] <= alpha <= inner[1]"),
    (PAPER, margin("alpha", ("91/100", "89/100"), "refuted", EXCESS), "inner[0] <= alpha <= inner[1]"),
    (PAPER, margin("alpha", ("899/1000", "901/1000"), "proved", {}), SIGMA),
    (REPAIRED, margin("mu", ("15678262/100000000", "39651947/100000000"), "proved", {}), SIGMA),
    (REPAIRED, margin("mu", ("15678263/100000000", "39651948/100000000"), "proved", {}), SIGMA),
    (REPAIRED, margin("alpha", ("8/10", "999/1000"), "proved", {}), SIGMA),
    (K2, margin("mu", ("6696/100000", "1"), "proved", LARGEST), "beta <= 2^alpha - 1"),
    (K2, margin("mu", ("6699/100000", "101/100"), "proved", LARGEST), "mu <= witness.mu"),
    (K2, margin("mu", ("1/4", "1"), "proved", {"mu": "1", "lambda_max_upper": "1"}),
     "every eigenvalue of L_s is <= witness.lambda_max_upper"),
    (K2, margin("mu", ("1/4", "101/100"), "proved", {"mu": "101/100", "lambda_max_upper": "2"}),
     "witness.mu witness.lambda_max_upper <= 2"),
    (REPAIRED, margin("mu", ("157/1000", "170/1000"), "proved", {"mu": "1/5", "lambda_max_upper": "4"}),
     "the graph is symmetric"),
    ({**K2, "mu": "3/2"}, margin("mu", ("1", "2"), "refuted", {"mu": "101/100", "power": 1}), "0 < witness.mu <= mu"),
    ({**K2, "mu": "3/2"}, margin("mu", ("1", "2"), "refuted", {"mu": "1", "power": 1}),
     "abs trace(Pc(witness.mu)^power) > N - 1"),
    ({**K2, "mu": "1/2"}, margin("mu", ("1/4", "3/5"), "refuted", {"mu": "0", "power": 1}), "0 < witness.mu <= mu"),
    (REPAIRED, margin("mu", ("161/1000", "163/1000"), "refuted", EXCESS), "norm(Phi_k L x_0) > norm(L x_0)"),
    (design(path(2)[1:], 2, mu="1"), margin("mu", ("1", "1"), "proved", {}),
     "the margin of control-norm-bound exists (Assumption 1 fails)"),
]  # fmt: skip


@pytest.mark.parametrize(("about", "part", "reason"), REFUSED)
def test_margins_of_the_norm_bound_refused(about: Json, part: Json, reason: str) -> None:
    assert ruled(about, part) == ("refused", f"not true: {reason}")


def test_margins_of_the_norm_bound_left_undecided() -> None:
    """True or false of every design there, but not seen over so wide an interval."""
    for about, part in (
        (PAPER, margin("mu", ("10/1000", "135/1000"), "refuted", EXCESS)),
        (REPAIRED, margin("mu", ("157/1000", "390/1000"), "proved", {"samples": 2, "powers": 2})),
    ):
        assert ruled(about, part)[0] == "undecided"


FORMS: list[tuple[str, Any]] = [
    (".mu", {"mu": {"inner": ["1", "2"]}}),
    (".mu", {"mu": {**margin("mu", ("1", "2"), "proved", {})["mu"], "outer": ["0", "3"]}}),
    (".mu.inner[0]", margin("mu", ("0", "2"), "proved", {})),
    (".mu.inner[0]", margin("mu", ("-1", "2"), "proved", {})),
    (".mu.witness.verdict", margin("mu", ("1", "2"), "undecided", {"bits": 4096})),
    (".mu.witness.verdict", margin("mu", ("1", "2"), "inapplicable", {})),
    (".mu.witness.witness", margin("mu", ("1", "2"), "refuted", {})),
    (".mu.witness.witness", margin("mu", ("1", "2"), "proved", {"k": 1})),
    (".alpha.inner[0]", margin("alpha", ("0", "9/10"), "proved", {})),
    (".alpha.inner[1]", margin("alpha", ("1/10", "1"), "proved", {})),
    (".alpha.inner[1]", margin("alpha", ("1/10", f"{2**64 - 1}/{2**64}"), "proved", {})),
]


@pytest.mark.parametrize(("where", "part"), FORMS)
def test_form(where: str, part: Json) -> None:
    document = certificate(K2)
    document["values"] = {"margins": {EVERY: part}}
    with pytest.raises(Malformed) as caught:
        checked(document)
    assert caught.value.path == f"$.values.margins.{EVERY}{where}"


def test_more_bits_are_asked_for_twice_only(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(facts, "BITS", (128, 256, 512, 1024))
    assert box(K2, ("1/2", "3/5"), ("1/3", "1/2")).precisions == (128, 256)
