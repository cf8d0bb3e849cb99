"""Uncertain designs at a few bits: mu between its ends, and what is said of every member; the truth is mpmath's."""

import random
from collections.abc import Iterator
from fractions import Fraction
from typing import Any

import mpmath
import pytest

from fomas_verify.checker import corners, gain, member_values, members, parts, powers
from fomas_verify.checker.designs import Interval
from fomas_verify.checker.gain import Gain
from fomas_verify.checker.powers import Enclosure, point
from tests.checker.builder import (
    PAPER_EDGES,
    Json,
    certificate,
    claim,
    complete,
    design,
    directed_cycle,
    laplacian,
    outcome,
    path,
)
from tests.checker.test_samples import facts

TINY = mpmath.mpf(10) ** -50


@pytest.fixture(autouse=True)
def _few_bits(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """No guard bits."""
    cached = (powers.power, powers.gamma_one_plus, powers._log, gain.mu_at)
    for function in cached:
        function.cache_clear()
    monkeypatch.setattr(powers, "_GUARD", 0)
    yield
    for function in cached:
        function.cache_clear()


def exact(x: Fraction) -> Any:
    return mpmath.mpf(x.numerator) / x.denominator


def mu(gamma: Fraction, h: Fraction, alpha: Any) -> Any:
    return exact(gamma) * exact(h) ** alpha / mpmath.gamma(1 + alpha)


def between(choose: random.Random, most: int) -> Interval:
    """An interval of positive numbers; now and then a point."""
    a, b = sorted(Fraction(choose.randint(1, most), choose.randint(1, 20)) for _ in range(2))
    return choose.choice([(a, b), (a, b), (a, a)])


def drawn(seed: int) -> tuple[Gain, Interval]:
    """gamma and h between their ends, and an interval of alpha, which may end at 0 or 1."""
    choose = random.Random(seed)
    ends = sorted(choose.sample([Fraction(k, 24) for k in range(25)], 2))
    return Gain(between(choose, 9), None, between(choose, 40)), (ends[0], ends[1])


@pytest.mark.parametrize("seed", range(60))
@pytest.mark.parametrize("bits", [3, 8, 20])
def test_mu_is_between(seed: int, bits: int) -> None:
    found, (first, last) = drawn(seed)
    assert found.gamma is not None
    assert found.h is not None
    with mpmath.workdps(60):
        over, slab = found.over(first, last, bits), found.over_slab(first, last, bits)
        for part in range(9):
            alpha = first + (last - first) * Fraction(part, 8)
            low, high = (mu(found.gamma[i], found.h[i], exact(alpha)) for i in (0, 1))
            at = found.at(alpha, bits)
            assert exact(at.lower) <= low * (1 + TINY)
            assert high * (1 - TINY) <= exact(at.upper)
            assert bits < 20 or (exact(at.lower) >= low * 0.99 and exact(at.upper) <= high * 1.01)
            for box in (over, slab):
                assert exact(box.lower) <= low * (1 + TINY)
                assert high * (1 - TINY) <= exact(box.upper)
        assert bits < 20 or slab.upper <= over.upper * Fraction(101, 100)


@pytest.mark.parametrize("seed", range(40))
@pytest.mark.parametrize("bits", [3, 8, 20])
def test_mu_is_between_where_it_is_nearly_exponential(seed: int, bits: int) -> None:
    """h of many digits and a narrow part: the bound from either end leaves no room for one that is too small."""
    choose = random.Random(seed)
    h = Fraction(choose.randint(2, 9)) ** choose.choice([-20, 20])
    found = Gain((Fraction(1), Fraction(1)), None, (h, h))
    first = Fraction(choose.randint(100, 900), 1000)
    last = first + Fraction(1, 10 ** choose.randint(2, 5))
    with mpmath.workdps(60):
        box = found.over(first, last, bits)
        for alpha in (first, (first + last) / 2, last):
            assert exact(box.lower) <= mu(Fraction(1), h, exact(alpha)) <= exact(box.upper)


@pytest.mark.parametrize("seed", range(60))
@pytest.mark.parametrize("bits", [6, 12, 60])
def test_the_least_and_the_greatest_mu(seed: int, bits: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(gain, "_BITS", bits)
    monkeypatch.setattr(gain, "_CLOSE", 1 + Fraction(1, 2 ** (bits // 2)))
    monkeypatch.setattr(gain, "MAX_PARTS", 64)
    found, (first, last) = drawn(seed)
    assert found.gamma is not None
    assert found.h is not None
    with mpmath.workdps(60):
        least = min(mu(found.gamma[0], found.h[0], exact(alpha)) for alpha in (first, last))
        box = found.least(first, last)
        assert exact(box.lower) * (1 - TINY) <= least <= exact(box.upper) * (1 + TINY)
        box = found.greatest(first, last)
        grid = [exact(first) + exact(last - first) * k / 64 for k in range(65)]
        seen = max(mu(found.gamma[1], found.h[1], alpha) for alpha in grid)
        assert seen <= exact(box.upper) * (1 + TINY)
        assert exact(box.lower) <= seen * (1 + mpmath.mpf(10) ** -2)
        assert bits < 60 or box.upper <= box.lower * Fraction(11, 10)


def test_the_bound_over_a_part_takes_the_ends_that_are_worst(monkeypatch: pytest.MonkeyPatch) -> None:
    """mu is 1 to 4 at alpha = 0 and 1 to 2 at 1/2, and concave in the logarithm: at 1 it may be 2 * 2 / 1."""
    ends = {Fraction(0): (1, 4), Fraction(1, 2): (1, 2), Fraction(1): (3, 16)}
    boxes = {alpha: Enclosure(Fraction(low), Fraction(high)) for alpha, (low, high) in ends.items()}
    monkeypatch.setattr(Gain, "_ends", lambda self, alpha, bits: (boxes[alpha], boxes[alpha]))
    one = Fraction(1)
    box = Gain((one, one), None, (one, one)).over(Fraction(1, 2), one, 20)
    assert Fraction(99, 100) <= box.lower <= 1
    assert 4 <= box.upper <= Fraction(401, 100)


def test_the_bound_over_a_part_by_an_end_of_many_bits(monkeypatch: pytest.MonkeyPatch) -> None:
    """mu is 9/8 at the ends of the part, a hair above 1/2 beyond the last; below alpha = 0 nothing is asked."""
    beyond = Fraction(1, 2) + Fraction(1, 2**40)
    boxes = {Fraction(1, 20): Fraction(9, 8), Fraction(1, 5): Fraction(9, 8), Fraction(7, 20): beyond}
    monkeypatch.setattr(Gain, "_ends", lambda self, alpha, bits: (point(boxes[alpha]),) * 2)
    box = Gain((beyond, beyond), None, (beyond, beyond)).over(Fraction(1, 20), Fraction(1, 5), 2)
    assert Fraction(81, 64) / beyond <= box.upper <= Fraction(254, 100)


def test_the_middle_and_the_radius() -> None:
    box = Enclosure(Fraction(-1), Fraction(4))
    assert (box.middle, box.radius) == (Fraction(3, 2), Fraction(5, 2))


def test_mu_given() -> None:
    found = Gain(None, (Fraction(1, 3), Fraction(2, 3)), None)
    ends = Fraction(1, 4), Fraction(3, 4)
    for box in (found.at(ends[0], 9), found.over(*ends, 9), found.over_slab(*ends, 9)):
        assert box == Enclosure(Fraction(1, 3), Fraction(2, 3))
    assert found.least(*ends) == point(Fraction(1, 3))
    assert found.greatest(*ends) == point(Fraction(2, 3))


@pytest.mark.parametrize("seed", range(40))
@pytest.mark.parametrize("bits", [6, 128])
def test_what_is_said_of_a_part_of_alpha_is_true(seed: int, bits: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """K_n, where lambda2 and sigma are plain: seen over a part, a claim is true, or fails, at every alpha in it."""
    for module in (parts, corners):
        monkeypatch.setattr(module, "_BITS", bits)
    choose = random.Random(seed)
    n, gamma, h = choose.randint(2, 5), Fraction(choose.randint(1, 20), 40), Fraction(choose.randint(5, 30), 10)
    graph = facts(design(complete(n), n, mu="1")).graph
    curve = parts.Curve(graph, Gain((gamma, gamma), None, (h, h)))
    seen = set()
    for width in (1, 10, 60):
        first = Fraction(choose.randint(0, 100 - width), 100)
        last = first + Fraction(width, 100)
        said = {name: getattr(curve, name)(first, last) for name in ("remembers", "forgets", "contracts", "expands")}
        seen |= {name for name, truth in said.items() if truth}
        with mpmath.workdps(60):
            for k in range(1, 20):
                alpha = exact(first + (last - first) * Fraction(k, 20))
                beta = 1 - n * mu(gamma, h, alpha)
                c = 2**alpha - 1
                remembers = -mpmath.sqrt(mpmath.mpf(3) ** alpha - 2**alpha) <= beta <= c
                for name, truth in zip(said, (remembers, not remembers, abs(beta) <= c, abs(beta) > c), strict=True):
                    assert truth or not said[name], (name, first, last)
    assert seen or bits < 128


def test_what_is_seen_of_a_part_of_alpha() -> None:
    """K_5: beta = 1 - 5 mu = -19/20 is below -sqrt(c_2) > -0.95 up to alpha = 0.94; 1/2 is above c_1 up to 0.58."""
    graph = facts(design(complete(5), 5, mu="1")).graph
    low = parts.Curve(graph, Gain(None, (Fraction(39, 100), Fraction(39, 100)), None))
    high = parts.Curve(graph, Gain(None, (Fraction(1, 10), Fraction(1, 10)), None))
    for curve in (low, high):
        assert curve.forgets(Fraction(1, 10), Fraction(1, 2))
        assert curve.expands(Fraction(1, 10), Fraction(1, 2))
    assert high.remembers(Fraction(3, 5), Fraction(1))
    assert high.contracts(Fraction(3, 5), Fraction(1))
    assert not high.remembers(Fraction(1, 2), Fraction(1))


def said(about: Json, name: str, verdict: str, **witness: Any) -> tuple[str, str]:
    return outcome(certificate(about, [claim(name, verdict, **witness)]), name)


@pytest.mark.parametrize(("greatest", "status"), [("33/100", "accepted"), ("1/3", "refused"), ("1/2", "refused")])
def test_the_gain_bound_of_every_member(greatest: str, status: str) -> None:
    """K_4 has D = 3."""
    about = {**design(complete(4), 4), "alpha": "1/2", "mu": ["1/10", greatest]}
    assert said(about, "gain-bound", "proved")[0] == status


def test_the_ends_of_a_margin_in_alpha_stand_in_order() -> None:
    """K_2, mu = 1/4: beta = 1/2 <= 2^alpha - 1 from alpha = log2 1.5 = 0.58496... on; 0.5 lies below, not above."""
    document = certificate(design(path(2), 2, mu="1/4"))
    name = "margins.memory-inequality.alpha"
    for outer, status in ((["1/2", None], "accepted"), ([None, "1/2"], "refused"), (["99/100", None], "refused")):
        margin = {"inner": ["3/5", "19/20"], "outer": outer}
        document["values"] = {"margins": {"memory-inequality": {"alpha": margin}}}
        assert outcome(document, name)[0] == status
    low = certificate(design(path(2), 2, "1/2", mu="1/4"))
    for outer, status in (([None, "3/5"], "accepted"), (["3/5", None], "refused")):
        low["values"] = {"margins": {"memory-inequality": {"alpha": {"inner": ["1/4", "29/50"], "outer": outer}}}}
        assert outcome(low, name)[0] == status


def test_signs_of_what_is_enclosed() -> None:
    """1 or -1 if both ends say so, None if one does."""
    one, two, three = Fraction(1), Fraction(2), Fraction(3)
    for x, sign in ((three, 1), (two, 1), (Fraction(3, 2), None), (one, None), (Fraction(1, 2), -1)):
        assert member_values._beyond(Enclosure(one, two), lambda end, x=x: end <= x) == sign
        assert member_values._beyond(Enclosure(one, two), lambda end, x=x: end >= -x + 3) == sign
    assert [members._below(Enclosure(one, two), t) for t in (Fraction(1, 2), one, two, three)] == [-1, None, None, 1]
    assert [members._below(point(two), t) for t in (one, two, three)] == [-1, 0, 1]
    assert [member_values._either(sign, (0, 1)) for sign in (-1, 0, 1, None)] == [-1, 1, 1, None]


@pytest.mark.parametrize(
    ("edges", "agents"),
    [(PAPER_EDGES, 5), (directed_cycle(3, "5/7"), 3), (path(2), 2), (complete(4, "1/" + "9" * 30), 4), (path(5), 5)],
)
def test_bounds_of_the_norm_of_the_laplacian(edges: list[list[Any]], agents: int) -> None:
    """The Frobenius norm to 2^-30, and 2 D where that is less."""
    graph = facts(design(edges, agents, mu="1")).graph
    square = Fraction(0)
    for i in range(agents):
        row = [Fraction(weight) for _, target, weight in edges if target == i + 1]
        square += sum((w * w for w in row), Fraction(0)) + sum(row, Fraction(0)) ** 2
    assert square <= graph.frobenius**2
    unit = Fraction(1, graph.denominator << 30)
    assert (graph.frobenius - unit) ** 2 <= square
    assert graph.size == min(graph.frobenius, 2 * graph.degree_max)
    assert float(square) == pytest.approx(float((laplacian(edges, agents) ** 2).sum()))
