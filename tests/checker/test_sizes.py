"""Peak, settling, rate, reach and limit: true bounds are accepted, false ones refused with their reasons.

Numbers by hand: K_N has P = (1 - mu N) I on 1perp; a directed cycle has a normal P. The paper's by mpmath.
"""

import random
from fractions import Fraction

import mpmath
import numpy as np
import pytest

from fomas_verify.checker import decay, schur
from tests.checker.builder import (
    PAPER_EDGES,
    Json,
    both_ways,
    bounds,
    certificate,
    checked,
    complete,
    design,
    directed_cycle,
    outcome,
    path,
)
from tests.checker.sampled import integrated_gain, power_norm, power_norms_by_floats, sample_norm

PAPER = design(PAPER_EDGES, 5, gamma="3/20", h="17/20", x0=["9/2", "5", "6", "3/2", "-1"])
K8 = design(complete(8), 8, mu="1/10", h="1/4", x0=[str(i) for i in range(8)])
DEADBEAT = design(complete(4), 4, "1/2", mu="1/4")
CIRCLE = design(directed_cycle(4), 4, mu="1", h="1", x0=["1", "0", "0", "0"])
BEYOND = design(directed_cycle(4), 4, mu="11/10", h="1", x0=["1", "0", "0", "0"])
NONNORMAL = design([[1, 2, "1"], [2, 3, "1"], [3, 4, "2"], [4, 1, "2"], [1, 3, "1"]], 4, "1/2", mu="3/5", h="2")
UNBALANCED = design([[1, 2, "1"], [2, 1, "2"]], 2, mu="1/10", h="1", x0=["1", "2"])
TRUE = "accepted"


def said(about: Json, name: str, **keys: object) -> tuple[str, str]:
    document = certificate(about)
    document["values"] = {name: keys}
    return outcome(document, name)


def refused(reason: str) -> tuple[str, str]:
    return "refused", f"not true: {reason}"


def between(about: Json, name: str, lower: str, upper: str, **more: object) -> tuple[str, str]:
    return said(about, name, lower=lower, upper=upper, **more)


def paper_peak(digits: int = 20) -> tuple[str, str]:
    mpmath.mp.dps = 60
    exact = sample_norm(PAPER, 1)
    assert mpmath.nstr(exact, 21).startswith("1.0128320165816517157")
    return bounds(exact, digits)


def moved(end: str, parts: int) -> str:
    return str(Fraction(end) * (1 + Fraction(parts, 10**12)))


def test_peak_of_the_paper() -> None:
    lower, upper = paper_peak(40)
    above = "norm Phi_j <= upper for every j"
    below = "lower <= norm Phi_at"
    assert between(PAPER, "peak_control", lower, upper, at=1)[0] == TRUE
    assert between(PAPER, "peak_control", "-3", "2", at=0)[0] == TRUE
    assert between(PAPER, "peak_control", "1", "2", at=0)[0] == TRUE
    assert between(PAPER, "peak_control", "1/2", upper, at=3)[0] == TRUE
    assert between(PAPER, "peak_control", moved(lower, 1), upper, at=1) == refused(below)
    assert between(PAPER, "peak_control", lower, upper, at=0) == refused(below)
    assert between(PAPER, "peak_control", lower, upper, at=2) == refused(below)
    assert between(PAPER, "peak_control", "-1", moved(upper, -1), at=1) == refused(above)
    assert between(PAPER, "peak_control", "-1", "1", at=1) == refused(above)
    assert between(PAPER, "peak_control", "-1", "99/100", at=1) == refused(above)
    assert between(PAPER, "peak_control", lower, upper, at=10**9)[0] == "undecided"


def test_peak_that_is_one() -> None:
    assert between(DEADBEAT, "peak_control", "1", "1", at=0)[0] == TRUE
    assert between(K8, "peak_control", "1", "1", at=0)[0] == TRUE
    assert between(K8, "peak_control", "1", "1", at=1) == refused("lower <= norm Phi_at")
    assert between(K8, "peak_control", "1000001/1000000", "2", at=0) == refused("lower <= norm Phi_at")
    assert between(K8, "peak_control", "0", "999999/1000000", at=0) == refused("norm Phi_j <= upper for every j")


@pytest.mark.parametrize(
    ("about", "reason"),
    [
        (CIRCLE, "{} exists (P is Schur on 1perp)"),
        (BEYOND, "{} exists (P is Schur on 1perp)"),
        (UNBALANCED, "{} exists (Assumption 1 fails)"),
    ],
)
def test_values_that_do_not_exist(about: Json, reason: str) -> None:
    wide = {"lower": "-100", "upper": "100"}
    values: Json = dict.fromkeys(("actuator_reach", "limit"), wide)
    values |= {name: {**wide, "settle_to": "1/2"} for name in ("settling_samples", "settling_time")}
    values |= {"peak_control": {**wide, "at": 0}, "rate": {"kappa": "100", "rho": "99/100"}}
    document = certificate(about)
    document["values"] = values
    for found in checked(document).outcomes:
        if found.kind == "value":
            assert (found.status, found.reason) == refused(reason.format(found.id))


@pytest.mark.parametrize(
    ("about", "name", "reason"),
    [
        (design(path(2), 2, mu="1/10", x0=["0", "1"]), "settling_time", "h"),
        (design(path(2), 2, mu="1/10", x0=["0", "1"]), "actuator_reach", "gamma and no h"),
        (design(path(2), 2, mu="1/10", h="1"), "actuator_reach", "x0"),
        (design(path(2), 2, mu="1/10", h="1"), "limit", "x0 of plain numbers"),
        (design(path(2), 2, mu="1/10", x0=[["0"], ["1"]]), "limit", "x0 of plain numbers"),
    ],
)
def test_values_for_which_the_design_lacks_something(about: Json, name: str, reason: str) -> None:
    more = {"settle_to": "1/2"} if name == "settling_time" else {}
    assert between(about, name, "-100", "100", **more) == refused(f"{name} exists (the design has no {reason})")


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("peak_control", {"lower": "1", "upper": "2"}),
        ("peak_control", {"lower": "1", "upper": "2", "at": -1}),
        ("peak_control", {"lower": "1", "upper": "2", "at": "1"}),
        ("settling_samples", {"lower": "1", "upper": "2"}),
        ("settling_time", {"lower": "1", "upper": "2", "settle_to": 1}),
        ("rate", {"lower": "1", "upper": "2"}),
        ("rate", {"kappa": "1"}),
        ("limit", {"lower": "1", "upper": "2", "at": 1}),
    ],
)
def test_form(name: str, value: Json) -> None:
    from fomas_verify.checker import Malformed

    document = certificate(K8)
    document["values"] = {name: value}
    with pytest.raises(Malformed) as caught:
        checked(document)
    assert caught.value.path.startswith(f"$.values.{name}")


def settled(about: Json, settle_to: str, lower: str, upper: str, name: str = "settling_samples") -> tuple[str, str]:
    return between(about, name, lower, upper, settle_to=settle_to)


def test_settling_at_a_tie() -> None:
    """K_8 at mu = 1/10: norm P^k = 5^-k."""
    for lower, upper in (("3", "3"), ("5/2", "7/2"), ("-7", "1000"), ("1", "1" + "0" * 60)):
        assert settled(K8, "1/125", lower, upper)[0] == TRUE
    for lower, upper in (("3/4", "3/4"), ("5/8", "7/8")):
        assert settled(K8, "1/125", lower, upper, "settling_time")[0] == TRUE
    assert settled(K8, "1/126", "4", "4")[0] == TRUE
    above, below = refused("lower <= settling_samples"), refused("settling_samples <= upper")
    assert settled(K8, "1/125", "4", "4") == above
    assert settled(K8, "1/125", "301/100", "4") == above
    assert settled(K8, "1/125", "2", "2") == below
    assert settled(K8, "1/125", "2", "299/100") == below
    assert settled(K8, "1/126", "3", "3") == below
    assert settled(K8, "1/124", "4", "4") == above
    assert settled(K8, "1/125", "-5", "0") == below
    assert settled(K8, "1/125", "1" + "0" * 60, "1" + "0" * 70) == above
    assert settled(K8, "1/125", "1", "1", "settling_time") == refused("lower <= settling_time")
    assert settled(K8, "1/125", "3", "3", "settling_time") == refused("lower <= settling_time")
    for outside in ("0", "1", "2", "-1/2"):
        assert settled(K8, outside, "1", "1000") == refused("0 < settle_to < 1")


def test_settling_of_the_paper() -> None:
    with mpmath.workdps(60):
        k = next(k for k in range(1, 200) if power_norm(PAPER, k) <= mpmath.mpf(1) / 100)
    assert settled(PAPER, "1/100", str(k), str(k))[0] == TRUE
    assert settled(PAPER, "1/100", str(k + 1), str(k + 1)) == refused("lower <= settling_samples")
    assert settled(PAPER, "1/100", str(k - 1), str(k - 1)) == refused("settling_samples <= upper")
    seconds = str(k * Fraction(17, 20))
    assert settled(PAPER, "1/100", seconds, seconds, "settling_time")[0] == TRUE


def test_settling_where_norms_can_rise() -> None:
    """sigma > 1, P Schur: the first k is looked for one by one."""
    with mpmath.workdps(60):
        assert power_norm(NONNORMAL, 1) > 1
        norms = [power_norm(NONNORMAL, k) for k in range(80)]
    assert norms[-1] < 1
    target = Fraction(int(norms[30] * 10**6), 10**6)
    k = next(k for k, size in enumerate(norms) if size <= float(target))
    assert settled(NONNORMAL, str(target), str(k), str(k))[0] == TRUE
    assert settled(NONNORMAL, str(target), str(k + 1), str(k + 3)) == refused("lower <= settling_samples")
    assert settled(NONNORMAL, str(target), "1", str(k - 1)) == refused("settling_samples <= upper")


def rate(about: Json, kappa: str, rho: str) -> tuple[str, str]:
    return said(about, "rate", kappa=kappa, rho=rho)


RATE = "norm(P^k) <= kappa rho^k for every k >= 0"


def test_rate_of_the_paper() -> None:
    """The largest norm P^k / rho^k by the norms themselves; rho is 0.744, r 0.7413."""
    rho = "381/512"
    sizes = power_norms_by_floats(PAPER, 381 / 512, 800)
    assert sizes[-1] < 1
    k = sizes.index(max(sizes)) + 1
    with mpmath.workdps(60):
        lower, upper = bounds(power_norm(PAPER, k) * (mpmath.mpf(512) / 381) ** k, 12)
    assert rate(PAPER, "6", rho)[0] == TRUE
    assert rate(PAPER, upper, rho)[0] == TRUE
    assert rate(PAPER, "1", "9/10")[0] == TRUE
    assert rate(PAPER, "1000", "9/10")[0] == TRUE
    assert rate(PAPER, lower, rho) == refused(RATE)
    assert rate(PAPER, "1", rho) == refused(RATE)
    assert rate(PAPER, "1000000", "74/100") == refused(RATE)
    assert rate(PAPER, "999999/1000000", "9/10") == refused("1 <= kappa")
    for outside in ("0", "1", "-1/2", "3/2"):
        assert rate(PAPER, "2", outside) == refused("0 < rho < 1")


def test_rate_at_a_tie() -> None:
    """K_8: norm P^k = 5^-k; nothing is below it."""
    assert rate(K8, "1", "1/5")[0] == TRUE
    assert rate(K8, "1", "199999/1000000") == refused(RATE)
    assert rate(K8, "1000000", "199999/1000000") == refused(RATE)


def reach(about: Json, lower: str, upper: str) -> tuple[str, str]:
    return between(about, "actuator_reach", lower, upper)


def test_reach_of_the_paper() -> None:
    """L x_0 row by row from whom each agent hears, and the peak at k = 1."""
    x = [Fraction(9, 2), Fraction(5), Fraction(6), Fraction(3, 2), Fraction(-1)]
    hears = [(3, 4), (0, 2), (0, 1), (1, 2), (3,)]
    square = sum((sum(x[i] - x[j] for j in near) ** 2 for i, near in enumerate(hears)), Fraction(0))
    with mpmath.workdps(60):
        exact = sample_norm(PAPER, 1) * mpmath.sqrt(mpmath.mpf(square.numerator) / square.denominator) * 3 / 20
        lower, upper = bounds(exact, 35)
    assert reach(PAPER, lower, upper)[0] == TRUE
    assert reach(PAPER, "0", "100")[0] == TRUE
    assert reach(PAPER, moved(lower, 1), upper) == refused("lower <= actuator_reach")
    assert reach(PAPER, lower, moved(upper, -1)) == refused("actuator_reach <= upper")
    assert reach(PAPER, upper, lower) == refused("lower <= actuator_reach")


def test_reach_where_it_is_rational() -> None:
    """K_4: L x_0 = 4 x_0 has norm 8; sigma = 0 at mu = 1/4, and the peak is 1 for a mu near that."""
    edges = both_ways([(1, 2), (2, 3), (3, 4), (4, 1)]) + both_ways([(1, 3), (2, 4)])
    about = design(edges, 4, "1/2", gamma="1/4", h="1/2", x0=["1", "-1", "1", "-1"])
    assert reach(about, "2", "2")[0] == TRUE
    assert reach(about, "2000001/1000000", "3") == refused("lower <= actuator_reach")
    assert reach(about, "1", "1999999/1000000") == refused("actuator_reach <= upper")
    still = {**about, "x0": ["7"] * 4}
    assert reach(still, "0", "0")[0] == TRUE
    assert reach(still, "1/1000000", "1") == refused("lower <= actuator_reach")
    assert reach(still, "-1", "-1/1000000") == refused("actuator_reach <= upper")


def test_reach_where_mu_is_given() -> None:
    """gamma = mu Gamma(alpha + 1) / h^alpha; K_8, peak 1, L x_0 = 8 (x_0 - mean), norm 8 sqrt 42."""
    with mpmath.workdps(60):
        gain = integrated_gain({**K8, "gamma": "1"} | {"mu": "1/10"}) * mpmath.gamma(mpmath.mpf("1.9"))
        exact = gain / mpmath.mpf("0.25") ** mpmath.mpf("0.9") * 8 * mpmath.sqrt(42)
        lower, upper = bounds(exact, 30)
    assert reach(K8, lower, upper)[0] == TRUE
    assert reach(K8, upper, upper) == refused("lower <= actuator_reach")
    assert reach(K8, lower, lower) == refused("actuator_reach <= upper")


def test_limit() -> None:
    assert between(PAPER, "limit", "16/5", "16/5")[0] == TRUE
    assert between(PAPER, "limit", "3", "4")[0] == TRUE
    assert between(PAPER, "limit", "32000001/10000000", "4") == refused("lower <= limit")
    assert between(PAPER, "limit", "3", "31999999/10000000") == refused("limit <= upper")


def at_the_edge(mu: str, **gain: str) -> Json:
    """NONNORMAL has mu* = 5/8 > 1/D = 1/3."""
    return {**{k: v for k, v in NONNORMAL.items() if k != "mu"}, **(gain or {"mu": mu})}


SCHUR = refused("limit exists (P is Schur on 1perp)")


@pytest.mark.parametrize("digits", [3, 30, 60, 400])
def test_how_near_the_edge_of_stability(digits: int) -> None:
    """Beyond 128 bits by the roots of the characteristic polynomial."""
    edge, little = Fraction(5, 8), Fraction(1, 10**digits)
    x0 = {"x0": ["4", "0", "0", "0"]}
    assert between({**at_the_edge(str(edge - little)), **x0}, "limit", "1", "1")[0] == TRUE
    assert between({**at_the_edge(str(edge + little)), **x0}, "limit", "1", "1") == SCHUR
    assert between({**at_the_edge(str(edge)), **x0}, "limit", "1", "1") == SCHUR


@pytest.mark.parametrize("digits", [45, 50])
def test_the_edge_at_an_irrational_mu(digits: int, monkeypatch: pytest.MonkeyPatch) -> None:
    with mpmath.workdps(100):
        scaled = mpmath.gamma(mpmath.mpf(3) / 2) * 5 / 8 * 10**digits
        below, above = (f"{int(end(scaled))}/{10**digits}" for end in (mpmath.floor, mpmath.ceil))
    inside, outside = (at_the_edge("", gamma=g, h="1") | {"x0": ["4", "0", "0", "0"]} for g in (below, above))
    if digits == 50:
        monkeypatch.setattr(schur, "BITS", (128,))
        assert between(inside, "limit", "1", "1")[0] == "undecided"
    else:
        assert between(inside, "limit", "1", "1")[0] == TRUE
        assert between(outside, "limit", "1", "1") == SCHUR


def test_too_many_agents_for_stability() -> None:
    about = design(directed_cycle(130), 130, mu="1", x0=["0"] * 130)
    assert between(about, "limit", "0", "0")[0] == "undecided"


@pytest.mark.parametrize("seed", range(60))
def test_roots_inside_the_disc(seed: int) -> None:
    choose = random.Random(seed)
    polynomial = (*(choose.randint(-20, 20) for _ in range(choose.randint(1, 6))), choose.randint(1, 60))
    roots = np.roots(polynomial[::-1])
    assert schur._roots_inside(polynomial) == all(abs(z) < 1 for z in roots)


def test_settling_within_a_hair_of_a_norm_that_can_rise(monkeypatch: pytest.MonkeyPatch) -> None:
    with mpmath.workdps(120):
        norms = [power_norm(NONNORMAL, k) for k in range(1, 60)]
        k = next(k for k in range(10, 60) if norms[k - 1] < min(norms[: k - 1]))
        lower, upper = bounds(norms[k - 1], 100)
        _, nearer = bounds(norms[k - 1], 101)
    assert settled(NONNORMAL, upper, str(k), str(k))[0] == TRUE
    assert settled(NONNORMAL, lower, str(k), str(k)) == refused("settling_samples <= upper")
    monkeypatch.setattr(decay, "norm_sign", lambda *_: None)
    late = f"not decided within the work allowed: norm(P^{k}) <= settle_to"
    assert settled(NONNORMAL, nearer, "1", str(k)) == ("undecided", late)


def test_beyond_the_work_allowed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(decay, "MAX_PRODUCT_WORK", 2**18)
    late = ("undecided", "as many products of matrices are beyond the work allowed")
    assert settled(PAPER, "1/1000003", "1", "1" + "0" * 30) == late
    assert settled(NONNORMAL, "1/1000003", "1", "1000000") == late
    assert rate(PAPER, "1000", "742/1000") == late


def test_settling_later_than_every_power_looked_at() -> None:
    """sigma is 1 - 1e-40: after 2^64 samples nothing has changed."""
    slow = design(path(2), 2, mu="1/2" + "0" * 40, x0=["0", "1"])
    late = "not decided within the work allowed: "
    assert settled(slow, "1/2", "1" + "0" * 30, "1" + "0" * 60) == ("undecided", late + "lower <= settling_samples")
    assert settled(slow, "1/2", "1", "1" + "0" * 60) == ("undecided", late + "settling_samples <= upper")
    assert settled(slow, "1/2", "1", "1" + "0" * 15) == refused("settling_samples <= upper")
