"""How far alpha may move: the truth at many alpha by mpmath and numpy, and where nothing is or can be seen."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

import numpy as np
import pytest
from mpmath import mp

from fomas_verify.design import design_from_mapping
from fomas_verify.enclosure.interval import Interval
from fomas_verify.spectrum import alpha_margins, slabs
from fomas_verify.spectrum.alpha_margins import alpha_margin
from fomas_verify.spectrum.loop import Loop
from fomas_verify.spectrum.slabs import Chords, Truth

PAPER = {"adjacency": [[0, 0, 0, 1, 1], [1, 0, 1, 0, 0], [1, 1, 0, 0, 0], [0, 1, 1, 0, 0], [0, 0, 0, 1, 0]]}
GAP = Fraction(1, 10**6)
POINTS = 400
CLAIMS: dict[str, Callable[[Loop], Truth]] = {
    "gain-bound": slabs.gain_bound,
    "memory-inequality": slabs.memory_inequality,
    "perron-eigenvalues": slabs.perron_eigenvalues,
    "repaired-condition": slabs.repaired_condition,
}


def random_balanced(seed: int) -> dict[str, object]:
    rng = np.random.default_rng(seed)
    n, edges = int(rng.integers(2, 8)), set()
    for _ in range(int(rng.integers(1, 4))):
        order = rng.permutation(n) + 1
        edges |= set(zip(order.tolist(), np.roll(order, 1).tolist(), strict=True))
    heard = {i: sum(j == i for _, j in edges) - sum(j == i for j, _ in edges) for i in range(1, n + 1)}
    assert not any(heard.values()) or n > 2
    if any(heard.values()):
        edges |= {(j, i) for i, j in edges}
    return {"agents": n, "edges": [[i, j] for i, j in sorted(edges)]}


def random_loop(seed: int) -> Loop:
    rng = np.random.default_rng(seed)
    graph = random_balanced(seed)
    alpha = str(rng.integers(1, 99) / 100)
    h = str(round(10 ** rng.uniform(-2, 2), 3))
    gamma = str(round(float(10 ** rng.uniform(-2, 0)) / float(h) ** float(alpha), 6))
    return Loop(design_from_mapping({"name": "x", "alpha": alpha, "gamma": gamma, "h": h, "graph": graph}))


def laplacian(found: Loop) -> np.ndarray:
    n = found.design.graph.agents
    a = np.zeros((n, n))
    for source, target, weight in found.design.graph.edges:
        a[target - 1, source - 1] = float(weight)
    return np.diag(a.sum(axis=1)) - a


def truths(found: Loop, claim: str) -> Callable[[float], bool]:
    """Whether the claim is true at an alpha, in binary floats."""
    el, design = laplacian(found), found.design
    n = len(el)
    lambda2 = np.linalg.eigvalsh((el + el.T) / 2)[1]
    nonzero = np.array(sorted(np.linalg.eigvals(el), key=abs)[1:])
    star = min(2 * nonzero.real / abs(nonzero) ** 2)

    def at(alpha: float) -> bool:
        mu = float(design.mu or 0) or float(design.gamma) * float(design.h) ** alpha / float(mp.gamma(alpha + 1))
        c1, c2 = 2**alpha - 1, 3**alpha - 2**alpha
        if claim == "gain-bound":
            return bool(mu < 1 / el.diagonal().max())
        if claim == "memory-inequality":
            return bool(-(c2**0.5) <= 1 - mu * lambda2 <= c1)
        if claim == "perron-eigenvalues":
            return bool(mu < star)
        return bool(np.linalg.norm((np.eye(n) - mu * el) @ (np.eye(n) - 1 / n), 2) <= c1)

    return at


@pytest.mark.parametrize("claim", CLAIMS)
@pytest.mark.parametrize("seed", range(15))
def test_the_truth_inside_and_at_the_outer_ends(seed: int, claim: str) -> None:
    found = random_loop(seed)
    at, alpha = truths(found, claim), found.design.alpha
    margin = alpha_margin(CLAIMS[claim](found), alpha)
    assert margin is not None
    (a, b), (c, d) = margin.inner, margin.outer
    here = at(float(alpha))
    width = float(b - a)
    inside = [float(a) + width * (k + 0.5) / POINTS for k in range(POINTS)]
    assert all(at(x) is here for x in inside)
    for inner, outer, limit in ((a, c, 0), (b, d, 1)):
        if outer is None:
            assert inner == limit
        else:
            assert at(float(outer)) is not here
            assert abs(outer - inner) <= GAP * max(inner, outer)
            assert outer < inner <= alpha or alpha <= inner < outer


def paper(**keys: object) -> Loop:
    return Loop(design_from_mapping({"name": "x", "alpha": "9/10", "graph": PAPER, **keys}))


def test_the_papers_alpha() -> None:
    """(14) at gamma 0.15, h 0.85 is an equality at the alpha where ``mu(alpha) = 2 - 2^alpha``."""
    found = paper(gamma="0.15", h="0.85")
    margin = alpha_margin(slabs.memory_inequality(found), found.design.alpha)
    assert margin is not None
    with mp.workdps(30):
        h = mp.mpf("0.85")
        end = mp.findroot(lambda x: mp.mpf("0.15") * h**x / mp.gamma(x + 1) - 2 + mp.mpf(2) ** x, mp.mpf("0.899"))
    assert margin.outer[0] is not None
    assert float(margin.outer[0]) < end < float(margin.inner[0]) < 0.9
    assert margin.inner[1] == 1


@pytest.mark.parametrize("mu", ["0.5", "0.4999999", "0.6", "2/3"])
def test_what_depends_on_mu_alone_does_not_depend_on_alpha_where_mu_is_given(mu: str) -> None:
    found = paper(mu=mu)
    margin = alpha_margin(slabs.gain_bound(found), found.design.alpha)
    assert margin is not None
    assert margin.inner == (0, 1)
    assert margin.outer == (None, None)


def test_nothing_is_said_where_the_truth_at_the_design_is_a_tie() -> None:
    """P4, alpha 1/2, mu 1: beta = 2^alpha - 1 exactly, which no range decides."""
    graph = {"family": "path", "agents": 4}
    found = Loop(design_from_mapping({"name": "x", "alpha": "1/2", "mu": "1", "graph": graph}))
    assert alpha_margin(slabs.memory_inequality(found), found.design.alpha) is None


def test_nothing_is_said_of_eigenvalues_where_no_mu_will_do() -> None:
    found = Loop(design_from_mapping({"name": "x", "alpha": "1/2", "mu": "1", "graph": {"agents": 2, "edges": []}}))
    assert alpha_margin(slabs.perron_eigenvalues(found), found.design.alpha) is None
    margin = alpha_margin(slabs.gain_bound(found), found.design.alpha)
    assert margin is not None
    assert margin.inner == (0, 1)


@pytest.mark.parametrize("digits", [7, 12, 15])
def test_a_change_right_beside_the_design(digits: int) -> None:
    """mu crosses 1/D within 10^-digits of alpha: the stretch ends at alpha or beside it, never beyond the change."""
    alpha, h = Fraction(3, 10), 8
    with mp.workdps(40):
        end = mp.mpf(3) / 10 + mp.mpf(10) ** -digits
        gamma = mp.gamma(end + 1) / mp.mpf(h) ** end / 2
        text = mp.nstr(gamma, 35)
    found = paper(alpha="3/10", gamma=text, h=h)
    margin = alpha_margin(slabs.gain_bound(found), alpha)
    assert margin is not None
    assert alpha <= margin.inner[1] <= alpha + Fraction(1, 10**digits)
    assert margin.outer[1] is None or margin.outer[1] > alpha + Fraction(1, 10 ** (digits + 1))


def test_a_truth_seen_at_points_only_reaches_nowhere(monkeypatch: pytest.MonkeyPatch) -> None:
    margin = alpha_margin(lambda slab: True if slab.is_exact else None, Fraction(1, 3))
    assert margin is not None
    assert margin.inner == (Fraction(1, 3), Fraction(1, 3))
    assert margin.outer == (None, None)


def test_the_stretch_is_one_that_halving_sees(monkeypatch: pytest.MonkeyPatch) -> None:
    """What is true on slabs below 1/1000 wide only needs 1000 parts: with fewer allowed, less is said."""

    def narrow(slab: Interval) -> bool | None:
        return True if slab.width < Fraction(1, 1000) else None

    monkeypatch.setattr(alpha_margins, "MOST_STEPS", 5000)
    monkeypatch.setattr(alpha_margins, "MOST_PARTS", 5000)
    wide = alpha_margin(narrow, Fraction(1, 2))
    monkeypatch.setattr(alpha_margins, "MOST_PARTS", 100)
    short = alpha_margin(narrow, Fraction(1, 2))
    assert wide is not None
    assert short is not None
    assert wide.inner == (0, 1)
    assert 0 < short.inner[0] < Fraction(1, 2) < short.inner[1] < 1


@pytest.mark.parametrize("seed", range(4))
def test_chords_bound_sigma(seed: int) -> None:
    """What is said of ``sigma(mu) > level`` is so, and from a millionth off something is said."""
    found = random_loop(seed)
    el, chords = laplacian(found), Chords(found)
    n, rng = len(el), np.random.default_rng(seed)
    for mu in rng.uniform(0, 3 / el.diagonal().max(), 40):
        sigma = np.linalg.norm((np.eye(n) - mu * el) @ (np.eye(n) - 1 / n), 2)
        for level in (sigma + 1e-6, sigma - 1e-6, rng.uniform(0, 2)):
            said = chords.exceeds(Fraction(mu), Fraction(level))
            assert said is bool(sigma > level)


def test_chords_stop_at_their_bound(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(slabs, "KNOT_WORK", 0)
    chords = Chords(paper(mu="1/10"))
    answers = [chords.exceeds(Fraction(k, 50), Fraction(83, 100)) for k in range(1, 40)]
    assert None in answers
    assert len(chords._knots) == slabs.FEWEST_KNOTS
