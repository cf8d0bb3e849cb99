"""Exactly at a boundary, and a hair from it on either side, where one test alone stands between true and false."""

from fractions import Fraction

import mpmath
import pytest

from fomas_verify.checker import corners, relation
from fomas_verify.checker.field import isolate
from fomas_verify.checker.operators import compare_peak
from fomas_verify.checker.powers import Enclosure, point
from fomas_verify.checker.ruling import Refused, Undecided, need, need_that
from tests.checker.builder import PAPER_EDGES, Json, both_ways, certificate, checked, claim, complete, design, outcome
from tests.checker.test_samples import facts

FEEBLE = both_ways([(1, 2), (2, 3), (1, 3), (4, 5), (5, 6), (4, 6)]) + both_ways([(3, 4)], "1/10")
DECAY = ("refused", "not true: norm(P^m) c_{K+1} <= c_{K+1+m}")


def said(about: Json, name: str, verdict: str, **witness: object) -> tuple[str, str]:
    return outcome(certificate(about, [claim(name, verdict, **witness)]), name)


@pytest.mark.parametrize(("powers", "status"), [(1, DECAY[0]), (4, DECAY[0]), (10, "accepted"), (20, "accepted")])
def test_a_trajectory_at_rest_after_one_step_still_needs_the_decay(powers: int, status: str) -> None:
    """Two triangles, a feeble bond, mu = 1/3: P e = 0 for e = (3, -3, 0, ...), and norm P is 0.979."""
    about = design(FEEBLE, 6, mu="1/3", x0=["1", "-1", "0", "0", "0", "0"])
    found = said(about, "trajectory-norm-bound", "proved", samples=0, powers=powers)
    assert found == DECAY if status == "refused" else found[0] == status


@pytest.mark.parametrize(("samples", "status"), [(0, "refused"), (1, "refused")])
def test_the_last_of_the_samples_is_looked_at(samples: int, status: str) -> None:
    """On the paper's design norm u_1 is 1.011 norm u_0 from this x_0, and no later control is larger than u_0."""
    about = design(PAPER_EDGES, 5, gamma="3/20", h="17/20", x0=["0", "-1", "-1", "-1", "1"])
    found = said(about, "trajectory-norm-bound", "proved", samples=samples, powers=1)
    reason = "norm(P^n e) <= c_n norm(e) for n = K+1..K+m" if samples == 0 else "norm(Phi_k e) <= norm(e) for k = 1..K"
    assert found == (status, f"not true: {reason}")


def hair(x: mpmath.mpf, digits: int) -> tuple[str, str]:
    scaled = x * mpmath.mpf(10) ** digits
    return f"{int(mpmath.floor(scaled))}/{10**digits}", f"{int(mpmath.ceil(scaled))}/{10**digits}"


@pytest.mark.parametrize("alpha", ["1/2", "9/10", "1/7", "49/50"])
@pytest.mark.parametrize("weight", ["1", "3", "2/7"])
@pytest.mark.parametrize("digits", [20, 39, 45, 100])
def test_the_memory_inequality_a_hair_from_either_end(alpha: str, weight: str, digits: int) -> None:
    """K_4 has lambda2 = 4 w: beta = c_1 at mu = (1 - c_1) / (4 w), beta = -sqrt(c_2) at mu = (1 + sqrt c_2) / (4 w)."""
    with mpmath.workdps(digits + 30):
        a, w = (mpmath.mpf(Fraction(x).numerator) / Fraction(x).denominator for x in (alpha, weight))
        first = hair((2 - 2**a) / (4 * w), digits)
        second = hair((1 + mpmath.sqrt(mpmath.mpf(3) ** a - mpmath.mpf(2) ** a)) / (4 * w), digits)
    for (below, above), k, holds in ((first, 0, 1), (second, 1, 0)):
        for mu, at in ((below, 0), (above, 1)):
            about = design(complete(4, weight), 4, alpha, mu=mu)
            true = at == holds
            assert said(about, "memory-inequality", "proved")[0] == ("accepted" if true else "refused")
            assert said(about, "memory-inequality", "refuted", k=k)[0] == ("refused" if true else "accepted")


@pytest.mark.parametrize("alpha", ["1/2", "9/10", "1/7"])
@pytest.mark.parametrize("weight", ["1", "3", "2/7"])
@pytest.mark.parametrize("digits", [10, 39, 45, 100])
def test_corners_a_hair_from_either_end(alpha: str, weight: str, digits: int) -> None:
    """The same thresholds of the same K_4, and sigma = abs(1 - 4 w mu) against c_1 on both sides of 1 / (4 w)."""
    graph = facts(design(complete(4, weight), 4, alpha, mu="1")).graph
    with mpmath.workdps(digits + 30):
        a, w = (mpmath.mpf(Fraction(x).numerator) / Fraction(x).denominator for x in (alpha, weight))
        root = mpmath.sqrt(mpmath.mpf(3) ** a - mpmath.mpf(2) ** a)
        tests = [
            (corners.first_sign, hair((2 - 2**a) / (4 * w), digits), (-1, 1)),
            (corners.second_sign, hair((1 + root) / (4 * w), digits), (-1, 1)),
            (corners.sigma_sign, hair((2 - 2**a) / (4 * w), digits), (-1, 1)),
            (corners.sigma_sign, hair(2**a / (4 * w), digits), (1, -1)),
        ]
    for ask, ends, signs in tests:
        for mu, sign in zip(ends, signs, strict=True):
            assert ask(graph, Fraction(alpha), Fraction(mu)) == sign
            assert ask(graph, Fraction(alpha), Fraction(mu), False) in (sign, None)


@pytest.mark.parametrize("alpha", ["1/2", "9/10", "1/7"])
@pytest.mark.parametrize("digits", [10, 39, 45, 100])
def test_corners_a_hair_from_either_end_where_lambda2_is_found_exactly(alpha: str, digits: int) -> None:
    """The paper's graph has lambda2 = 1: the ends are at mu = 1 - c_1 and 1 + sqrt c_2."""
    graph = facts(design(PAPER_EDGES, 5, alpha, mu="1")).graph
    assert corners.lambda2(graph) == point(Fraction(1))
    with mpmath.workdps(digits + 30):
        a = mpmath.mpf(Fraction(alpha).numerator) / Fraction(alpha).denominator
        first, second = hair(2 - 2**a, digits), hair(1 + mpmath.sqrt(mpmath.mpf(3) ** a - mpmath.mpf(2) ** a), digits)
    for ask, ends in ((corners.first_sign, first), (corners.second_sign, second)):
        for mu, sign in zip(ends, (-1, 1), strict=True):
            assert ask(graph, Fraction(alpha), Fraction(mu)) == sign
            assert ask(graph, Fraction(alpha), Fraction(mu), False) in (sign, None)
    assert [corners.first_sign(graph, Fraction(0), mu) for mu in (Fraction(9, 10), Fraction(1), Fraction(2))] == [
        -1,
        0,
        1,
    ]


def test_corners_at_the_ends_of_alpha() -> None:
    """K_4: beta = sigma = 0 = c_1 at alpha = 0, mu = 1/4, where c_2 = 0 too; c_1 = c_2 = 1 at alpha = 1."""
    graph = facts(design(complete(4), 4, mu="1")).graph
    zero, one, hair_more = Fraction(0), Fraction(1), Fraction(1, 4) + Fraction(1, 10**60)
    for ask in (corners.first_sign, corners.second_sign, corners.sigma_sign):
        assert ask(graph, zero, Fraction(1, 4)) == 0
    assert [ask(graph, zero, hair_more) for ask in (corners.first_sign, corners.second_sign)] == [1, 1]
    assert corners.sigma_sign(graph, zero, hair_more) == -1
    assert [corners.second_sign(graph, one, mu) for mu in (Fraction(49, 100), Fraction(1, 2), Fraction(51, 100))] == [
        -1,
        0,
        1,
    ]
    assert [corners.sigma_sign(graph, one, mu) for mu in (Fraction(49, 100), Fraction(1, 2), Fraction(51, 100))] == [
        1,
        0,
        -1,
    ]
    assert corners.first_sign(graph, one, Fraction(1, 10**30)) == 1


@pytest.mark.parametrize(("lower", "upper"), [("1/2", "2"), ("1/2", "7/3"), ("1/3", "3/2")])
def test_a_root_at_the_excluded_end_is_divided_out(lower: str, upper: str) -> None:
    """(x - lower)(x^2 - 2) on (lower, upper] is sqrt 2."""
    a = Fraction(lower)
    root = isolate([2 * a, Fraction(-2), -a, Fraction(1)], a, Fraction(upper))
    assert root is not None
    for coefficients, sign in (((-2, 0, 1), 0), ((-7, 5), 1), ((-17, 12), -1), ((-a, 1), 1)):
        exact = [Fraction(c) for c in coefficients]
        assert root.element(exact, root.integer_scale(exact)).sign() == sign


def test_a_number_that_may_be_less_than_the_peak_is_not_taken_for_it() -> None:
    """K_4 at mu = 1/4: the peak is 1."""
    found = facts(design(complete(4), 4, mu="1/4"))
    for lower, upper, sign in (("9/10", "1", None), ("9/10", "11/10", None), ("9/10", "19/20", -1), ("1", "1", 0)):
        u = Enclosure(Fraction(lower), Fraction(upper))
        assert compare_peak(found, lambda _, u=u: u) == sign


def test_settling_at_the_first_sample() -> None:
    """K_8 at mu = 1/10 has norm P^k = 5^-k: with 1/5 to reach, k is 1, neither 0 nor 2."""
    about = design(complete(8), 8, mu="1/10")
    for settle_to in ("1/5", "1/2"):
        for lower, upper, status, reason in (
            ("-5", "0", "refused", "not true: settling_samples <= upper"),
            ("-5", "99/100", "refused", "not true: settling_samples <= upper"),
            ("2", "4", "refused", "not true: lower <= settling_samples"),
            ("101/100", "4", "refused", "not true: lower <= settling_samples"),
            ("1", "1", "accepted", "lower <= settling_samples <= upper"),
        ):
            document = certificate(about)
            document["values"] = {"settling_samples": {"lower": lower, "upper": upper, "settle_to": settle_to}}
            assert outcome(document, "settling_samples") == (status, reason)


@pytest.mark.parametrize(("factor", "weight"), [(1, "1"), (3, "3"), (Fraction(2, 7), "2/7")])
@pytest.mark.parametrize("shift", [-1, 0, 1])
def test_the_memory_inequality_at_the_tie_with_a_root(factor: Fraction, weight: str, shift: int) -> None:
    """P_4 with weights w, alpha = 1/2, mu = 1/w: beta = 1 - (2 - sqrt 2) = 2^alpha - 1; with more mu it is less."""
    mu = 1 / Fraction(factor) + Fraction(shift, 10**120)
    about = design(both_ways([(1, 2), (2, 3), (3, 4)], weight), 4, "1/2", mu=str(mu))
    assert said(about, "memory-inequality", "proved")[0] == ("refused" if shift < 0 else "accepted")
    assert said(about, "memory-inequality", "refuted", k=0)[0] == ("accepted" if shift < 0 else "refused")


def test_the_reach_of_agents_with_two_components() -> None:
    """K_4 at mu = 1/4, alpha = 1/2, h = 1/2: P = J, the peak is 1, and gamma norm L x_0 = sqrt 8."""
    x0 = [["1", "1"], ["-1", "-1"], ["1", "-1"], ["-1", "1"]]
    document = certificate(design(complete(4), 4, "1/2", gamma="1/4", h="1/2", x0=x0))
    for lower, upper, status in (("2", "3", "accepted"), ("3", "4", "refused"), ("0", "2", "refused")):
        document["values"] = {"actuator_reach": {"lower": lower, "upper": upper}}
        assert outcome(document, "actuator_reach")[0] == status


def test_what_each_shortfall_calls_for() -> None:
    """A required claim that is refused, absent or refuted is 1, one that is undecided is 3."""
    document = certificate(
        design(complete(4), 4, mu="1/2"),
        [
            claim("gain-bound", "proved"),
            claim("graph-assumption", "undecided", bits=128),
            claim("repaired-condition", "refuted", e=["1", "-1", "0", "0"]),
        ],
    )
    names = ("gain-bound", "graph-assumption", "repaired-condition", "control-bounded")
    found = checked(document).shortfalls(names)
    assert [(shortfall.id, shortfall.exit_status) for shortfall in found] == list(zip(names, (1, 3, 1, 1), strict=True))
    late = checked(certificate(design([], 2001, mu="1"), [claim("gain-bound", "proved")]))
    assert [shortfall.exit_status for shortfall in late.shortfalls(names[:1])] == [3]


@pytest.mark.parametrize("sign", [-1, 0, 1, None])
@pytest.mark.parametrize("allowed", [(-1,), (0,), (1,), (-1, 0), (0, 1)])
def test_need(sign: int | None, allowed: tuple[int, ...]) -> None:
    if sign is None:
        with pytest.raises(Undecided, match=r"^not decided within the work allowed: so$"):
            need(sign, allowed, "so")
    elif sign in allowed:
        need(sign, allowed, "so")
    else:
        with pytest.raises(Refused, match=r"^not true: so$"):
            need(sign, allowed, "so")


def test_all_signs_are_looked_at() -> None:
    """1 if all are, else the first that is not."""
    signs = {1: 1, 2: None, 3: -1, 4: 0}
    asked = ((), (1,), (1, 1), (1, 2, 3), (1, 1, 3), (3, 1), (1, 4), (4, 1))
    assert [relation._all(signs.__getitem__, numbers) for numbers in asked] == [1, 1, 1, None, -1, -1, 0, 0]


@pytest.mark.parametrize(
    ("lower", "upper", "sign"), [("-9/10", "3", None), ("9/10", "3", 1), ("-3", "-1/9", -1), ("0", "7/10", -1)]
)
def test_sigma_against_a_number_of_either_sign(lower: str, upper: str, sign: int | None) -> None:
    """K_2 at mu = 1/10: sigma = 0.8."""
    box = Enclosure(Fraction(lower), Fraction(upper))
    assert facts(design(complete(2), 2, mu="1/10")).compare_sigma(lambda _: box) == sign


def test_need_that() -> None:
    need_that(True, "so")
    with pytest.raises(Refused, match=r"^not true: so$"):
        need_that(False, "so")
