"""Uncertain designs at a few bits: mu between its ends, and what is said of every member; the truth is mpmath's."""

import random
from collections.abc import Iterator
from fractions import Fraction
from typing import Any

import mpmath
import pytest

from fomas_verify.checker import gain, member_values, members, powers
from fomas_verify.checker.designs import Interval
from fomas_verify.checker.gain import Gain
from fomas_verify.checker.powers import Enclosure, point
from tests.checker.builder import PAPER_EDGES, complete, design, directed_cycle, laplacian, path
from tests.checker.test_samples import facts

TINY = mpmath.mpf(10) ** -50


@pytest.fixture(autouse=True)
def _few_bits(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """No guard bits."""
    cached = (powers.power, powers.gamma_one_plus, powers._log, gain._mu)
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
