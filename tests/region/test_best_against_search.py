"""The best gamma and h against floating-point root finding and enumeration, on random balanced digraphs.

The oracle shares no code with the search: singular values by numpy, ends by Brent's method, the union over the number
of samples by trying each, and the corners of every polyhedron by hand.
"""

import math
from fractions import Fraction

import pytest

from fomas_verify.region.model import Condition
from fomas_verify.region.synthesize import Answer, synthesize
from fomas_verify.region.task import Objective, pose
from tests.region.test_against_singular_values import Oracle, design_from_mapping, digraph, find_region

SEEDS = range(10)
LIMITS = {"h": ["1/10", "2"], "gamma": ["1/50", "1"]}
EPS = 0.05


class Plan:
    """Where the repaired condition is opened by an alpha above the least one, and what is best there."""

    def __init__(self, seed: int) -> None:
        self.agents, self.edges = digraph(seed)
        self.oracle = Oracle(self.agents, self.edges)
        best = self.oracle.sigma(self.oracle.best)
        self.alpha = Fraction((1 + 2 * math.log2(1 + best)) / 3).limit_denominator(1000)
        self.order = float(self.alpha)
        self.scale = math.gamma(1 + self.order)

    def answer(self, objective: Objective, **limits: object) -> Answer:
        graph = {"agents": self.agents, "edges": self.edges}
        mapping = {"alpha": str(self.alpha), "graph": graph, "settle_to": "1/20", "limits": limits}
        return synthesize(pose(find_region(design_from_mapping(mapping)), Condition.REPAIRED, objective))

    def weight(self, h: float) -> float:
        return h**self.order / self.scale

    def period(self, mu: float, gamma: float) -> float:
        """The h with which this gamma gives mu."""
        return (mu * self.scale / gamma) ** (1 / self.order)

    def strip(self, samples: int = 0) -> tuple[float, float] | None:
        """The mu with sigma <= 2^alpha - 1, and with sigma^samples <= EPS."""
        t = 2**self.order - 1
        if samples:
            t = min(t, EPS ** (1 / samples))
        return None if self.oracle.sigma(self.oracle.best) > t else self.oracle.below(t)


@pytest.fixture(scope="module", params=SEEDS)
def plan(request: pytest.FixtureRequest) -> Plan:
    return Plan(request.param)


def assert_near(answer: Answer, best: float, reached: Fraction, larger: bool) -> None:
    """The bound is at the oracle's best, and the point within rounding of it on the right side."""
    assert answer.bound is not None
    assert float(answer.bound) == pytest.approx(best, rel=1e-6)
    assert (reached < answer.bound) if larger else (reached > answer.bound)
    assert float(reached) == pytest.approx(best, rel=2e-3)


def test_the_slowest(plan: Plan) -> None:
    low, high = plan.strip()
    best = min(2, plan.period(high, 1 / 50))
    if low > plan.weight(2) or plan.weight(0.1) / 50 > high:
        assert plan.answer(Objective.SLOWEST, **LIMITS).point is None
        return
    answer = plan.answer(Objective.SLOWEST, **LIMITS)
    assert_near(answer, best, answer.point.h, larger=True)


def test_the_gentlest(plan: Plan) -> None:
    low, _ = plan.strip()
    answer = plan.answer(Objective.GENTLEST, **LIMITS)
    if low > plan.weight(2):
        assert answer.point is None
        return
    assert_near(answer, max(1 / 50, low / plan.weight(2)), answer.point.gamma, larger=False)


def test_the_fastest(plan: Plan) -> None:
    times = []
    for k in range(1, 2000):
        ends = plan.strip(k)
        if ends is None or plan.weight(2) < ends[0]:
            continue
        times.append(k * max(0.1, plan.period(ends[0], 1)))
        if k * 0.1 > min(times) or EPS ** (1 / k) > 2**plan.order - 1:
            break
    answer = plan.answer(Objective.FASTEST, **LIMITS)
    if not times:
        assert answer.point is None
        return
    assert_near(answer, min(times), answer.point.h * answer.point.samples, larger=False)
    mu = float(answer.point.gamma) * plan.weight(float(answer.point.h))
    assert plan.oracle.sigma(mu) ** answer.point.samples <= EPS * (1 + 1e-9)


def test_the_most_robust(plan: Plan) -> None:
    """Without limits the strip alone counts, and its middle has room for (high/low)^(1/(2 + 2 alpha))."""
    low, high = plan.strip()
    answer = plan.answer(Objective.ROBUST)
    best = (high / low) ** (1 / (2 + 2 * plan.order))
    assert answer.bound is not None
    assert float(answer.bound) == pytest.approx(best, rel=1e-6)
    mu = float(answer.point.gamma) * plan.weight(float(answer.point.h))
    assert min(mu / low, high / mu) ** (1 / (1 + plan.order)) == pytest.approx(best, rel=2e-3)


def test_no_time_is_too_short_to_be_refuted_nor_long_enough_to_be_missed(plan: Plan) -> None:
    """A limit of time just below the least is impossible, and one just above it is not."""
    fastest = plan.answer(Objective.FASTEST, **LIMITS)
    if fastest.point is None:
        return
    for factor, possible in ((Fraction(999, 1000), False), (Fraction(1003, 1000), True)):
        answer = plan.answer(Objective.GENTLEST, **LIMITS, settle_within=str(fastest.bound * factor))
        assert (answer.point is not None) == possible
