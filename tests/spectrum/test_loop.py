"""lambda2, beta, sigma, mu*, eigenvalues: against numpy on random graphs, against closed forms at any precision."""

import random
from fractions import Fraction

import numpy as np
import pytest
from mpmath import mp

from fomas_verify.design import design_from_mapping
from fomas_verify.enclosure.interval import Interval
from fomas_verify.exact import matrix as exact
from fomas_verify.spectrum import loop as loops
from fomas_verify.spectrum.loop import Loop, least_decrease

PAPER = [[0, 0, 0, 1, 1], [1, 0, 1, 0, 0], [1, 1, 0, 0, 0], [0, 1, 1, 0, 0], [0, 0, 0, 1, 0]]


def loop(graph: dict[str, object], **numbers: str) -> Loop:
    return Loop(design_from_mapping({"name": "x", "alpha": "9/10", "graph": graph, **(numbers or {"mu": "1/5"})}))


def family(name: str, agents: int, **numbers: str) -> Loop:
    return loop({"family": name, "agents": agents}, **numbers)


def balanced(seed: random.Random) -> dict[str, object]:
    """Directed cycles laid over each other, with integer weights."""
    n = seed.randint(2, 7)
    rows = [[0] * n for _ in range(n)]
    for k in range(seed.randint(1, 4)):
        agents = seed.sample(range(n), n if k == 0 else seed.randint(2, n))
        weight = seed.randint(1, 5)
        for i, j in zip(agents, agents[1:] + agents[:1], strict=True):
            rows[j][i] += weight
    return {"adjacency": rows}


@pytest.mark.parametrize("number", range(40))
def test_random_balanced_graphs_against_numpy(number: int) -> None:
    seed = random.Random(number)
    graph = balanced(seed)
    mu = Fraction(seed.randint(1, 60), 100)
    found = loop(graph, mu=str(mu))
    a = np.array(graph["adjacency"], dtype=float)
    n = len(a)
    el = np.diag(a.sum(1)) - a
    v = np.linalg.qr(np.column_stack([np.ones(n), np.eye(n)[:, 1:]]))[0][:, 1:]
    symmetric = np.linalg.eigvalsh(v.T @ (el + el.T) @ v / 2)
    assert float(found.lambda2(128).mid) == pytest.approx(symmetric[0], rel=1e-9)
    sizes = [float(x.mid) for x, m in found.symmetric_spectrum(128) for _ in range(m)]
    assert sizes == pytest.approx(symmetric, rel=1e-9)
    sigma = np.linalg.norm(v - float(mu) * el @ v, 2)
    assert float(found.sigma(128).mid) == pytest.approx(sigma, rel=1e-9, abs=1e-9)
    assert float(found.beta(128).mid) == pytest.approx(1 - float(mu) * symmetric[0], rel=1e-9, abs=1e-9)
    eigenvalues = np.linalg.eigvals(v.T @ el @ v)
    expected = min(2 * z.real / abs(z) ** 2 for z in eigenvalues)
    star = found.mu_star(128)
    assert star is not None
    assert float(star.mid) == pytest.approx(expected, rel=1e-6)
    assert sum(r.multiplicity for r in found.disagreement_eigenvalues(128)) == n - 1
    assert max(x.width for x in (found.sigma(128), found.lambda2(128))) < Fraction(1, 10**30)


@pytest.mark.parametrize("bits", [128, 256, 1024])
@pytest.mark.parametrize("n", [3, 4, 7, 10])
def test_closed_forms(n: int, bits: int) -> None:
    """Path: lambda2 = 2 - 2 cos(pi/n). Directed cycle: 1 - cos(2 pi/n), sigma^2 = 1 - 2 mu (1 - mu) lambda2."""
    with mp.workdps(bits // 3):
        path, ring = 2 - 2 * mp.cos(mp.pi / n), 1 - mp.cos(2 * mp.pi / n)
        for found, true in [
            (family("path", n).lambda2(bits), path),
            (family("directed-cycle", n).lambda2(bits), ring),
            (family("directed-cycle", n, mu="2/7").sigma(bits), mp.sqrt(1 - mp.mpf(20) / 49 * ring)),
            (family("path", n, mu="3/5").sigma(bits), max(1 - path * 3 / 5, (2 + 2 * mp.cos(mp.pi / n)) * 3 / 5 - 1)),
        ]:
            value = Fraction(mp.nstr(true, bits // 3))
            slack = Fraction(1, 10 ** (bits // 3 - 4))
            assert found.lower - slack <= value <= found.upper + slack
            assert found.width < Fraction(1, 2 ** (bits - 16))


@pytest.mark.parametrize("n", [2, 3, 8, 20])
def test_complete_graphs_are_exact(n: int) -> None:
    found = family("complete", n, mu=f"1/{n}")
    assert found.lambda2(128) == Interval.exactly(n)
    assert found.beta(128) == found.sigma(128) == Interval.exactly(0)
    assert found.mu_star(128) == Interval.exactly(Fraction(2, n))


def test_the_papers_graph() -> None:
    """Issue: eigenvalues of L 0, 2, 2 +- i, 3, lambda2 = 1, mu* = 2/3, D = 2."""
    found = loop({"adjacency": PAPER}, gamma="0.15", h="0.85")
    roots = [(r.real, r.imag, r.multiplicity) for r in found.disagreement_eigenvalues(128)]
    assert sorted((float(x.mid), float(y.mid), m) for x, y, m in roots) == [(2, -1, 1), (2, 0, 1), (2, 1, 1), (3, 0, 1)]
    assert all(x.is_exact and y.is_exact for x, y, _ in roots)
    assert found.mu_star(128) == Interval.exactly(Fraction(2, 3))
    assert (found.lambda2(128), found.degree_max) == (Interval.exactly(1), 2)
    assert found.assumption1


def test_mu_from_gamma_narrows_and_the_values_nest() -> None:
    found = loop({"adjacency": PAPER}, gamma="0.15", h="0.85")
    for name in ("mu", "beta", "sigma", "threshold", "lower_threshold"):
        coarse, fine = getattr(found, name)(128), getattr(found, name)(512)
        assert coarse.overlaps(fine)
        assert fine.width < coarse.width / 2**100


@pytest.mark.parametrize("mu", ["1e-60", "1e-6", "1e6", "1e60", "1e300"])
@pytest.mark.parametrize("weight", ["1e-60", "1", "1e60"])
def test_sigma_of_two_agents_at_any_scale(mu: str, weight: str) -> None:
    """sigma = abs(1 - 2 mu w)."""
    graph = {"agents": 2, "edges": [[1, 2, weight], [2, 1, weight]]}
    assert loop(graph, mu=mu).sigma(128).contains(abs(1 - 2 * Fraction(mu) * Fraction(weight)))


@pytest.mark.parametrize("mu", ["1e-60", "1e-120", "1e-200"])
def test_sigma_of_a_vanishing_gain(mu: str) -> None:
    """``1 - sigma`` is about ``mu lambda2``; the roots lie that near to one another."""
    found = loop({"adjacency": PAPER}, mu=mu)
    sigma = found.sigma(2048)
    assert found.beta(2048).lower <= sigma.upper
    assert sigma.lower < 1 - Fraction(mu) / 2
    assert sigma.upper > 1 - 2 * Fraction(mu)


@pytest.mark.parametrize(
    ("edges", "zero"),
    [([], 2), ([[1, 2], [2, 1]], 1), ([[1, 2]], 1), ([[1, 2], [2, 3]], 0), ([[1, 3], [2, 3]], 1)],
)
def test_zero_eigenvalues_of_graphs_without_a_root(edges: list[list[int]], zero: int) -> None:
    found = loop({"agents": 3, "edges": edges})
    counts = [r.multiplicity for r in found.disagreement_eigenvalues(128) if r.real == Interval.exactly(0)]
    assert sum(counts) == zero
    assert (found.mu_star(128) is None) == (zero > 0)
    assert not found.assumption1


@pytest.mark.parametrize("number", range(12))
def test_the_leading_bits_of_long_weights_say_the_same(number: int, monkeypatch: pytest.MonkeyPatch) -> None:
    seed = random.Random(number)
    n, weights = seed.randint(4, 7), [seed.getrandbits(3000) + 1 for _ in range(2)]
    rows = [[weights[0] * ((i - j) % n == 1) + weights[1] * ((i - j) % n == 2) for j in range(n)] for i in range(n)]
    found = loop({"adjacency": rows})
    graph = found.laplacian
    mu = Fraction(seed.choice([1, 5, 40]), 10 * int(found.degree_max))  # nu > 0, and nu < 0 for the last
    asked = []
    polynomial = loops.integer_characteristic_polynomial
    monkeypatch.setattr(loops, "integer_characteristic_polynomial", lambda a: asked.append(a) or polynomial(a))
    short = least_decrease(graph, mu, 200)
    monkeypatch.setattr(loops, "LONGEST_ENTRY", 10**6)
    exactly = least_decrease(graph, mu, 200)
    assert [exact.longest_bits(a) <= 2048 + 8 for a in asked] == [True, False]
    assert short.overlaps(exactly)
    assert short.width <= max(abs(short.lower), exactly.width) / 2**200


def test_what_the_leading_bits_do_not_show_comes_from_all() -> None:
    """A path of weights 1 and w = 2^4000: the least eigenvalue of L is 3/2 - O(1/w), below every leading bit of w."""
    w = 2**4000
    found = loop({"adjacency": [[0, 1, 0], [1, 0, str(w)], [0, str(w), 0]]})
    nu = least_decrease(found.laplacian, Fraction(1, w**2), 100)
    assert abs(nu.mid - 3) < Fraction(1, 10**30)
    assert nu.width < Fraction(1, 10**30)
