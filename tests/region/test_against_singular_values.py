"""The ends against floating-point root finding on numpy's largest singular value, on 50 random balanced digraphs."""

import random
from collections.abc import Callable
from fractions import Fraction

import mpmath
import numpy as np
import pytest
from scipy.optimize import brentq, minimize_scalar

from fomas_verify.checker import check
from fomas_verify.design import Design, design_from_mapping
from fomas_verify.region import Condition, Region, certificate, find_region

CLOSE = 1e-9
SEEDS = range(50)
WEIGHTS = ("1", "1/2", "2", "3/7", "5/4")


def digraph(seed: int) -> tuple[int, list[list[object]]]:
    """Sums of weighted cycles through all agents: balanced and strongly connected."""
    chosen = random.Random(seed)
    agents = chosen.randint(3, 10)
    weights: dict[tuple[int, int], Fraction] = {}
    for _ in range(chosen.randint(1, 3)):
        order, weight = chosen.sample(range(1, agents + 1), agents), Fraction(chosen.choice(WEIGHTS))
        for pair in zip(order, [*order[1:], order[0]], strict=True):
            weights[pair] = weights.get(pair, Fraction(0)) + weight
    return agents, [[i, j, str(weight)] for (i, j), weight in weights.items()]


class Oracle:
    """L in floats, an orthonormal basis of 1perp, and the largest singular value of P on it."""

    def __init__(self, agents: int, edges: list[list[object]]) -> None:
        rows = [[Fraction(0)] * agents for _ in range(agents)]
        for source, target, weight in edges:
            rows[target - 1][source - 1] -= Fraction(weight)
            rows[target - 1][target - 1] += Fraction(weight)
        el = np.array(rows, dtype=float)
        # On the differences from the last agent, times 28, the least common denominator of the weights.
        self.exact = [[int(28 * (x - y)) for x, y in zip(row[:-1], rows[-1], strict=False)] for row in rows[:-1]]
        basis = np.linalg.qr(np.eye(agents)[:, :-1] - 1 / agents)[0]
        self.step, self.el = np.eye(agents - 1), basis.T @ el @ basis
        self.top = 1 / el.diagonal().max()
        self.lambda2 = np.linalg.eigvalsh((self.el + self.el.T) / 2)[0]
        found = minimize_scalar(self.sigma, bounds=(0, self.top), method="bounded", options={"xatol": 1e-12})
        self.best = min([found.x, self.top], key=self.sigma)

    def sigma(self, mu: float) -> float:
        return float(np.linalg.norm(self.step - mu * self.el, 2))

    def star(self) -> float:
        """mu*; with 60 digits, since an eigenvalue of L may be defective."""
        with mpmath.workdps(60):
            roots = mpmath.eig(mpmath.matrix(self.exact), left=False, right=False)
            return float(min(56 * x.real / abs(x) ** 2 for x in roots))

    def below(self, t: float) -> tuple[float, float]:
        """Where sigma <= t and mu <= 1/D, around the best mu."""
        last = self.top if self.sigma(self.top) <= t else self.root(t, self.best, self.top)
        return self.root(t, 0.0, self.best), last

    def root(self, t: float, low: float, high: float) -> float:
        return float(brentq(lambda mu: self.sigma(mu) - t, low, high, xtol=1e-15, rtol=1e-14))


def near(alpha: float) -> Fraction:
    return Fraction(alpha).limit_denominator(10**9)


def region_at(seed: int, alpha_of: Callable[[Oracle], float]) -> tuple[Region, Oracle, float]:
    agents, edges = digraph(seed)
    oracle = Oracle(agents, edges)
    alpha = near(alpha_of(oracle))
    design: Design = design_from_mapping({"alpha": str(alpha), "graph": {"agents": agents, "edges": edges}})
    return find_region(design), oracle, 2.0 ** float(alpha) - 1


def assert_ends(region: Region, condition: Condition, low: float, high: float) -> None:
    mu = region.strip(condition).mu
    assert mu is not None
    for end, (inner, outer) in zip((low, high), zip(mu.inner, mu.outer, strict=True), strict=True):
        assert abs(float(inner) - end) < CLOSE * high
        assert abs(float(outer) - end) < CLOSE * high
    assert mu.outer[0] <= mu.inner[0] <= mu.inner[1] <= mu.outer[1]
    assert max(mu.inner[0] - mu.outer[0], mu.outer[1] - mu.inner[1]) < Fraction(1, 10**9) * mu.outer[1]


@pytest.mark.parametrize("seed", SEEDS)
def test_the_ends_where_repaired_is_open(seed: int) -> None:
    """A third of the way from the least sigma to 1."""
    region, oracle, t = region_at(seed, lambda o: np.log2(1 + o.sigma(o.best) + (1 - o.sigma(o.best)) / 3))
    assert_ends(region, Condition.REPAIRED, *oracle.below(t))
    assert_ends(region, Condition.GAIN_BOUND, 0, oracle.top)
    assert_ends(region, Condition.CONSENSUS, 0, oracle.star())
    if (1 - t) / oracle.lambda2 < oracle.top:
        most = (1 + np.sqrt(3 ** np.log2(1 + t) - 1 - t)) / oracle.lambda2
        assert_ends(region, Condition.AS_STATED, (1 - t) / oracle.lambda2, min(most, oracle.top))
    else:
        assert region.strip(Condition.AS_STATED).mu is None
    room = 1 - 2 * (1 - t**2) / (oracle.lambda2 * oracle.top)
    if room > 0:
        assert_ends(region, Condition.CLOSED_FORM, *(oracle.top / 2 * (1 + sign * np.sqrt(room)) for sign in (-1, 1)))
    else:
        assert region.strip(Condition.CLOSED_FORM).mu is None


@pytest.mark.parametrize("seed", SEEDS)
def test_where_repaired_is_empty_and_where_it_opens(seed: int) -> None:
    region, oracle, _ = region_at(seed, lambda o: np.log2(1 + o.sigma(o.best) * (1 - 1e-6)))
    strip = region.strip(Condition.REPAIRED)
    assert strip.mu is None
    assert strip.opening is not None
    for end in strip.opening.alpha.ends:
        assert abs(float(end) - np.log2(1 + oracle.sigma(oracle.best))) < CLOSE
    assert {outcome.status for outcome in check(certificate(region).encode()).outcomes} == {"accepted"}
