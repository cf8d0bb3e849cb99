"""On which mu each claim is true: the ends against numpy and mpmath, which share no code, and where there are none."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
import sympy
from mpmath import mp

from fomas_verify.design import design_from_mapping
from fomas_verify.spectrum import margins
from fomas_verify.spectrum.loop import Loop
from fomas_verify.spectrum.margins import MuMargin

PAPER = {"adjacency": [[0, 0, 0, 1, 1], [1, 0, 1, 0, 0], [1, 1, 0, 0, 0], [0, 1, 1, 0, 0], [0, 0, 0, 1, 0]]}
FINE, COARSE = Fraction(1, 2**70), Fraction(1, 2**24)
ROUNDING = 1e-11
"""What numpy's singular values of a well-scaled matrix of ten rows may lose, times ten."""


def family(name: str, agents: int) -> dict[str, object]:
    return {"family": name, "agents": agents}


def random_balanced(seed: int) -> dict[str, object]:
    """A weighted sum of cycles through all agents: balanced and strongly connected."""
    rng = np.random.default_rng(seed)
    n, edges = int(rng.integers(3, 10)), {}
    for _ in range(int(rng.integers(1, 4))):
        order, weight = rng.permutation(n) + 1, Fraction(int(rng.integers(1, 9)), int(rng.integers(1, 5)))
        for edge in zip(order.tolist(), np.roll(order, 1).tolist(), strict=True):
            edges[edge] = edges.get(edge, Fraction(0)) + weight
    return {"agents": n, "edges": [[i, j, str(w)] for (i, j), w in edges.items()]}


def loop(graph: dict[str, object], alpha: str = "9/10", mu: str = "1/10") -> Loop:
    return Loop(design_from_mapping({"name": "x", "alpha": alpha, "mu": mu, "graph": graph}))


def laplacian(found: Loop) -> np.ndarray:
    n = found.design.graph.agents
    a = np.zeros((n, n))
    for source, target, weight in found.design.graph.edges:
        a[target - 1, source - 1] = float(weight)
    return np.diag(a.sum(axis=1)) - a


def sigma(el: np.ndarray, mu: float) -> float:
    n = len(el)
    return float(np.linalg.norm((np.eye(n) - mu * el) @ (np.eye(n) - 1 / n), 2))


def assert_shape(margin: MuMargin, gap: Fraction) -> None:
    """``0 <= c <= a < b <= d``, the ends next to each other, and the enclosures of the true ends between them."""
    (a, b), (c, d) = margin.inner, margin.outer
    assert 0 <= c <= margin.lower.lower <= margin.lower.upper <= a < b
    assert b <= margin.upper.lower <= margin.upper.upper <= d
    assert a - c <= gap * c
    assert d - b <= gap * d


@pytest.mark.parametrize("seed", range(12))
def test_ends_of_random_graphs_against_numpy(seed: int) -> None:
    found = loop(random_balanced(seed), "0.97")
    el = laplacian(found)
    symmetric = np.linalg.eigvalsh((el + el.T) / 2)
    c1, c2 = 2**0.97 - 1, 3**0.97 - 2**0.97
    memory = margins.memory_inequality(found)
    assert_shape(memory, FINE)
    assert float(memory.inner[0]) == pytest.approx((1 - c1) / symmetric[1], rel=ROUNDING)
    assert float(memory.inner[1]) == pytest.approx((1 + c2**0.5) / symmetric[1], rel=ROUNDING)
    nonzero = np.array(sorted(np.linalg.eigvals(el), key=abs)[1:])
    perron = margins.perron_eigenvalues(found)
    assert perron is not None
    assert_shape(perron, COARSE)
    assert float(perron.upper.mid) == pytest.approx(min(2 * nonzero.real / abs(nonzero) ** 2), rel=1e-9)
    repaired = margins.repaired_condition(found)
    grid = [sigma(el, mu) for mu in np.linspace(1e-3, 2, 2000) / el.diagonal().max()]
    assert (repaired is not None) == (min(grid) < c1)
    if repaired is not None:
        assert_shape(repaired, FINE)
        for end in repaired.inner:
            assert sigma(el, float(end)) == pytest.approx(c1, rel=ROUNDING)


@pytest.mark.parametrize("seed", range(6))
def test_witnesses_of_the_last_stable_mu_and_of_one_beyond(seed: int) -> None:
    """docs/certificate-format.md: Q at b, and a power, or Y, at d; tested by sympy on the matrices written there."""
    found = loop(random_balanced(seed) if seed else PAPER)
    margin = margins.perron_eigenvalues(found)
    assert margin is not None
    n = found.design.graph.agents - 1
    el = [[sympy.Rational(x.numerator, x.denominator) for x in row] for row in exact_laplacian(found)]
    differences = sympy.Matrix(n, n, lambda i, j: el[i][j] - el[n][j])
    inside, beyond = (
        sympy.eye(n) - sympy.Rational(t.numerator, t.denominator) * differences
        for t in (margin.inner[1], margin.outer[1])
    )
    q = symmetric(margin.witness["Q"])
    assert q.is_positive_definite
    assert (q - inside.T * q * inside).is_positive_definite
    if "Y" in margin.witness:
        y = symmetric(margin.witness["Y"])
        assert not y.is_zero_matrix
        assert (beyond.T * y * beyond - y).is_positive_semidefinite
    else:
        with mp.workdps(60):
            roots = mp.eig(mp.matrix(beyond.evalf(60).tolist()), left=False, right=False)
            assert abs(sum(z ** margin.witness["power"] for z in roots)) > n + mp.mpf(1) / 4


def exact_laplacian(found: Loop) -> list[list[Fraction]]:
    n = found.design.graph.agents
    rows = [[Fraction(0)] * n for _ in range(n)]
    for source, target, weight in found.design.graph.edges:
        rows[target - 1][target - 1] += weight
        rows[target - 1][source - 1] -= weight
    return rows


def symmetric(triangle: list[list[Fraction]]) -> sympy.Matrix:
    return sympy.Matrix(
        len(triangle),
        len(triangle),
        lambda i, j: sympy.Rational(*triangle[max(i, j)][min(i, j)].as_integer_ratio()),
    )


def test_the_papers_ends() -> None:
    """Theory, section 5: [0.15678262217..., 0.39651947232...] for sigma, mu* = 2/3, 1/D = 1/2; lambda2 = 1."""
    found = loop(PAPER)
    gain, repaired = margins.gain_bound(found), margins.repaired_condition(found)
    assert gain is not None
    assert gain.inner == gain.outer == (0, Fraction(1, 2))
    assert repaired is not None
    assert Fraction("0.15678262217") < repaired.outer[0] < repaired.inner[0] < Fraction("0.15678262218")
    assert Fraction("0.39651947232") < repaired.inner[1] < repaired.outer[1] < Fraction("0.39651947233")
    memory, perron = margins.memory_inequality(found), margins.perron_eigenvalues(found)
    with mp.workdps(40):
        least, most = (
            2 - mp.mpf(2) ** mp.mpf("0.9"),
            1 + mp.sqrt(mp.mpf(3) ** mp.mpf("0.9") - mp.mpf(2) ** mp.mpf("0.9")),
        )
        for end, (inner, outer) in zip((least, most), zip(memory.inner, memory.outer, strict=True), strict=True):
            assert abs(float(end - mp.mpf(inner.numerator) / inner.denominator)) < 1e-20
            assert abs(float(end - mp.mpf(outer.numerator) / outer.denominator)) < 1e-20
    assert perron is not None
    assert perron.inner[1] < Fraction(2, 3) < perron.outer[1]


@pytest.mark.parametrize(
    ("graph", "star"), [(family("directed-cycle", 7), 1), (family("path", 2), 1), (family("cycle", 4), Fraction(1, 2))]
)
def test_a_short_mu_star_is_the_outer_end_itself(graph: dict[str, object], star: Fraction) -> None:
    margin = margins.perron_eigenvalues(loop(graph))
    assert margin is not None
    assert margin.outer[1] == star
    assert "Y" in margin.witness


@pytest.mark.parametrize(
    ("graph", "alpha"),
    [(family("directed-cycle", 10), "9/10"), (PAPER, "0.86303"), (family("star", 9), "0.4"), (PAPER, "1/1000")],
)
def test_no_mu_contracts_enough(graph: dict[str, object], alpha: str) -> None:
    """Theory, section 5: the paper's graph opens at alpha 0.86303781...; on a ring of ten sigma > 0.95."""
    found = loop(graph, alpha)
    assert margins.repaired_region(found) is None
    assert margins.repaired_condition(found) is None


def test_a_region_that_barely_opens_is_found() -> None:
    """At alpha 0.863038 the minimum of sigma, 0.818864182..., lies 1.6e-7 below the threshold."""
    repaired = margins.repaired_condition(loop(PAPER, "0.863038"))
    assert repaired is not None
    assert_shape(repaired, FINE)
    assert repaired.inner[1] - repaired.inner[0] < Fraction(1, 1000)


def test_without_edges_every_mu_is_below_the_gain_bound_and_none_stable() -> None:
    found = loop({"agents": 3, "edges": []})
    assert margins.gain_bound(found) is None
    assert margins.perron_eigenvalues(found) is None


@pytest.mark.parametrize("edges", [[[1, 3], [2, 3]], [[1, 2], [2, 1], [3, 4], [4, 3]]])
def test_no_mu_is_stable_on_a_graph_without_a_root(edges: list[list[int]]) -> None:
    found = loop({"agents": max(map(max, edges)), "edges": edges})
    assert margins.perron_eigenvalues(found) is None
    assert margins.gain_bound(found) is not None


@pytest.mark.parametrize("agents", [3, 9, 24])
def test_an_eigenvalue_of_many_steps_leaves_a_wider_gap_or_none(agents: int) -> None:
    """A directed path: L has the eigenvalue 1 in one block, mu* = 2, and Lyapunov forms that grow with the agents."""
    margin = margins.perron_eigenvalues(loop({"agents": agents, "edges": [[i, i + 1] for i in range(1, agents)]}))
    assert margin is not None
    assert margin.inner[1] < 2 <= margin.outer[1]


@pytest.mark.parametrize("mu", ["1e-300", "1e200", "1/3"])
@pytest.mark.parametrize("weight", ["1e-60", "1e60", "7/3"])
def test_ends_do_not_depend_on_mu_and_scale_with_the_weights(mu: str, weight: str) -> None:
    edges = [[i, j, weight] for i, j in [(1, 2), (2, 3), (3, 1), (1, 3), (3, 2), (2, 1)]]
    one, other = loop(family("complete", 3), mu="1/7"), loop({"agents": 3, "edges": edges}, mu=mu)
    for of in (margins.gain_bound, margins.memory_inequality, margins.perron_eigenvalues, margins.repaired_condition):
        left, right = of(one), of(other)
        assert left is not None
        assert right is not None
        scaled = [right.upper.lower * Fraction(weight), right.upper.upper * Fraction(weight)]
        assert scaled[0] <= left.upper.upper * (1 + FINE)
        assert left.upper.lower <= scaled[1] * (1 + FINE)
