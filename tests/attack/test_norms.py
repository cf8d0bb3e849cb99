"""The oracle for eqL3, the peak and the other sizes against published numbers, hand computations and brute force."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from mpmath import mp

from . import oracle, sizes
from .bounds import by_samples, closed_form, is_symmetric
from .designs import FURTHER, NAMED, PUBLISHED, STARTED, TIES, complete, directed_cycle, path
from .model import Design, laplacian
from .response import kernel, on_1perp

pytestmark = pytest.mark.slow

F = Fraction
PAPER = STARTED["paper-trajectory"]


def shown(x: object, count: int) -> str:
    with mp.workdps(60):
        return mp.nstr(x, 45)[: count + 2]


def test_peak_of_the_paper():  # issue text: 1.01283201658165171577..., attained at k = 1
    assert sizes.peak(PAPER).at == 1
    assert shown(on_1perp(PAPER).exact_control_norm(1), 20) == "1.01283201658165171577"[:22]


@pytest.mark.parametrize(
    ("mu", "verdict"), [("0.15185", "refuted"), ("0.15187", "proved"), ("0.4684", "proved"), ("0.4685", "refuted")]
)
def test_interval_of_mu_where_the_bound_holds(mu, verdict):  # docs/theory section 5: [0.15186, 0.46844]
    assert oracle.verdict(Design(F(9, 10), 5, PAPER.edges, mu=F(mu)), "control-norm-bound") == verdict


def test_resolvent_inverts_the_memory():  # sum_j c_{n-j} r_j = 1, docs/theory section 2
    k = kernel(F(3, 10), 60)
    with mp.workdps(60):
        for n in (0, 1, 7, 40):
            total = mp.fsum(k.c(n - j) * k.r(j) for j in range(n + 1))
            assert abs(total - 1) < mp.mpf(10) ** -55
            assert 0 < k.r(n) <= mp.mpf(n + 1) ** (-mp.mpf(3) / 10)


def _sizes_by_the_controller(design: Design, samples: int) -> np.ndarray:
    """The largest norm(u_k)/norm(u_0): u_k = -gamma L x_k - sum f(l) u_{k-l}, x_{k+1} = P x_k, for every unit x_0."""
    alpha, n = float(design.alpha), design.agents
    gain = float(oracle.mu(design, 30))
    lap = np.array([[float(x) for x in row] for row in laplacian(design)])
    steps = np.arange(0, samples + 2, dtype=float)
    f = np.diff((steps + 1) ** alpha - steps**alpha)
    x, u = np.eye(n), []
    for k in range(samples):
        u.append(-lap @ x - sum((f[j - 1] * u[k - j] for j in range(1, k + 1)), np.zeros((n, n))))
        x = x - gain * lap @ x
    first = np.linalg.pinv(u[0])
    return np.array([np.linalg.norm(v @ first, 2) for v in u])


@pytest.mark.parametrize(
    "name", ["paper", "paper-repaired", "alpha-small", "weighted-cycles", "h-large", "c4-third", "star6"]
)
def test_norms_agree_with_the_controller_as_it_is_written(name):
    found = _sizes_by_the_controller(NAMED[name], 60)
    response = on_1perp(NAMED[name])
    assert max(abs(float(response.control_norm(k)) - size) for k, size in enumerate(found)) < 1e-9
    assert abs(float(sizes.peak(NAMED[name]).size) - max(found)) < 1e-9


@pytest.mark.parametrize("name", [n for n, d in {**TIES, **FURTHER}.items() if is_symmetric(d)])
def test_closed_form_and_samples_agree_on_symmetric_graphs(name):
    seen = by_samples(NAMED[name]).truth
    assert seen is None or seen == closed_form(NAMED[name]).truth


@pytest.mark.parametrize(("settle_to", "k"), [("1/2", 1), ("1/4", 2), ("1/5", 3), ("1/1024", 10)])
def test_settling_of_two_agents(settle_to, k):  # P is 1/2 on 1perp; ties included
    assert sizes.settling(Design(F(9, 10), 2, path(2), mu=F(1, 4)), F(settle_to)) == k


def test_settling_of_a_slow_pair():  # (1 - 2e-6)^k <= 1/100 from k = ln 100 / -ln(1 - 2e-6)
    slow = Design(F(9, 10), 2, path(2), mu=F(1, 10**6))
    with mp.workdps(40):
        assert sizes.settling(slow, F(1, 100)) == int(mp.ceil(mp.log(100) / -mp.log1p(-mp.mpf(2) / 10**6)))


def test_radius_of_directed_cycles():  # abs(1 - mu + mu z) at z = exp(2 pi i/n)
    with mp.workdps(50):
        for n in (3, 5, 8):
            z = mp.expjpi(mp.mpf(2) / n)
            expected = abs(mp.mpf(2) / 3 + z / 3)
            assert abs(sizes.radius(Design(F(1, 2), n, directed_cycle(n), mu=F(1, 3))) - expected) < mp.mpf(10) ** -45


@pytest.mark.parametrize(
    ("kappa", "rho", "holds"),
    [("1", "3/5", True), ("1", "59/100", False), ("9/10", "3/5", False), ("1000", "59/100", False), ("1", "1", False)],
)
def test_rate_of_two_agents(kappa, rho, holds):  # P is -3/5 on 1perp
    design = Design(F(9, 10), 2, path(2), mu=F(4, 5))
    assert sizes.rate_holds(design, F(kappa), F(rho) + (F(1, 10**20) if rho == "3/5" else 0)) is holds


def test_rate_of_a_matrix_that_is_not_normal():  # kappa below sigma/rho fails at k = 1
    design = FURTHER["weighted-cycles"]
    rho = F(float(sizes.radius(design))) + F(1, 1000)
    with mp.workdps(40):
        least = oracle.sigma(design, 40) / oracle.real(rho)
        assert least > 1
        assert sizes.rate_holds(design, F(float(least)) - F(1, 1000), rho) is False
    assert sizes.rate_holds(design, F(100), rho) is True


def test_limit_and_reach_of_the_paper():
    """Limit and peak: issue text. L x_0 = (17/2, -1/2, 5/2, -8, -5/2) by hand, so norm(L x_0)^2 = 149; gamma = 3/20."""
    assert sizes.limit_bounds(PAPER, F(16, 5), F(16, 5)) == (True, True)
    with mp.workdps(40):
        expected = F(str(mp.nstr(mp.mpf("1.01283201658165171577") * mp.mpf(3) / 20 * mp.sqrt(149), 30)))
    step = F(1, 10**18)
    assert sizes.reach_bounds(PAPER, expected - step, expected + step) == (True, True)
    assert sizes.reach_bounds(PAPER, expected + step, expected - step) == (False, False)


def test_reach_where_the_first_control_is_the_largest():  # K2: peak 1, norm(L x_0) = sqrt 2
    design = Design(F(9, 10), 2, path(2), gamma=F(1, 2), h=F(1), x0=(F(1), F(0)))
    assert sizes.reach_bounds(design, F(7071067, 10**7), F(7071068, 10**7)) == (True, True)
    assert sizes.reach_bounds(design, F(7071068, 10**7), F(7071067, 10**7)) == (False, False)


def test_a_trajectory_within_a_stable_space_of_an_unstable_loop():
    """C4 at mu = 0.6 has eigenvalues 1 - 0.6 (0, 2, 2, 4); x_0 = (1, 0, -1, 0) moves by -1/5 alone: Phi_k < 1."""
    design = replace(TIES["c4-third"], mu=F(3, 5), x0=tuple(map(F, (1, 0, -1, 0))))
    assert oracle.verdict(design, "control-norm-bound") == "refuted"
    assert oracle.verdict(design, "trajectory-norm-bound") == "proved"
    assert oracle.verdict(replace(design, x0=tuple(map(F, (1, -1, 1, -1)))), "trajectory-norm-bound") == "refuted"


@pytest.mark.parametrize("n", [2, 3, 4])
def test_at_rest_and_deadbeat(n):
    design = Design(F(1, 10), n, complete(n), mu=F(1, n), x0=(F(1),) * n)
    assert oracle.verdict(design, "trajectory-norm-bound") == "proved"
    assert sizes.settling(design, F(1, 10**9)) == 1
    assert (sizes.peak(design).size, sizes.peak(design).at) == (1, 0)


@pytest.mark.parametrize("key", sizes.SIZES)
def test_no_size_without_a_stable_loop(key):
    design = replace(PUBLISHED["paper-past-mu-star"], x0=PAPER.x0, h=F(1))
    assert sizes.exists(design, key) is False
    assert sizes.exists(PAPER, key) is True
