"""Directions that show a large factor, and proofs of the paper's step, tested in exact arithmetic written here."""

from fractions import Fraction
from typing import Any

import pytest
import sympy
from mpmath import mp

from fomas_verify.design import design_from_mapping
from fomas_verify.enclosure.interval import Interval
from fomas_verify.spectrum.contraction import beta_contraction_witness, contraction_interval, direction_above
from fomas_verify.spectrum.loop import Loop

PAPER = {"adjacency": [[0, 0, 0, 1, 1], [1, 0, 1, 0, 0], [1, 1, 0, 0, 0], [0, 1, 1, 0, 0], [0, 0, 0, 1, 0]]}
HAIR = Fraction(1, 10**50)
Edges = list[tuple[int, int, str]]

RING3: Edges = [(1, 2, "1"), (2, 3, "1"), (3, 1, "1")]
QUARTER_PAIR: Edges = [(1, 2, "1/4"), (2, 1, "1/4")]
PATH4: Edges = [(i, j, "1") for i, j in [(1, 2), (2, 1), (2, 3), (3, 2), (3, 4), (4, 3)]]


def product(first: Edges, m: int, second: Edges, n: int) -> dict[str, object]:
    """The Cartesian product: L = L_1 (x) I + I (x) L_2."""
    edges: list[list[object]] = [[(i - 1) * n + k, (j - 1) * n + k, w] for i, j, w in first for k in range(1, n + 1)]
    edges += [[k * n + i, k * n + j, w] for i, j, w in second for k in range(m)]
    return {"agents": m * n, "edges": edges}


def loop(graph: dict[str, object], mu: Fraction | str) -> Loop:
    return Loop(design_from_mapping({"name": "x", "alpha": "9/10", "mu": str(mu), "graph": graph}))


def laplacian(found: Loop) -> sympy.Matrix:
    n = found.design.graph.agents
    el = sympy.zeros(n)
    for source, target, weight in found.design.graph.edges:
        w = sympy.Rational(weight.numerator, weight.denominator)
        el[target - 1, target - 1] += w
        el[target - 1, source - 1] -= w
    return el


def assert_witness(found: Loop, witness: Any, mu: Fraction) -> None:
    """docs/certificate-format.md, section 4, with the field's form decided by its eigenvalues at 60 digits."""
    el = laplacian(found)
    t = sympy.Rational(witness["mu"].numerator, witness["mu"].denominator)
    eigenvalues = sorted(mp.eigsy(mp.matrix(((el + el.T) / 2).evalf(70).tolist()), eigvals_only=True))
    assert witness["mu"] >= mu
    if "lambda2_upper" in witness:
        assert el == el.T
        s, r = witness["lambda2_upper"], witness["lambda_max_upper"]
        assert Fraction(mp.nstr(eigenvalues[1], 55)) - Fraction(1, 10**50) <= s
        assert Fraction(mp.nstr(eigenvalues[-1], 55)) - Fraction(1, 10**50) <= r
        assert witness["mu"] * s <= 1
        assert witness["mu"] * (s + r) <= 2
        return
    root = witness["lambda2"]
    z = sympy.Symbol("z")
    p = sympy.Poly([sympy.Rational(c.numerator, c.denominator) for c in reversed(root["polynomial"])], z)
    lower, upper = (sympy.Rational(x.numerator, x.denominator) for x in (root["lower"], root["upper"]))
    assert p.count_roots(lower, upper) - (1 if p.eval(lower) == 0 else 0) == 1
    assert p.is_irreducible
    theta = eigenvalues[1]
    slack = Fraction(1, 10**50)
    assert root["lower"] - slack <= Fraction(mp.nstr(theta, 60)) <= root["upper"] + slack
    n = el.rows
    v = sympy.Matrix(n, n - 1, lambda i, j: 1 if i == j else -1 if i == n - 1 else 0)
    exact_theta = sympy.Float(mp.nstr(theta, 65), 65)
    form = v.T * (el + el.T - 2 * exact_theta * sympy.eye(n) - t * (el.T * el - exact_theta**2 * sympy.eye(n))) * v
    assert min(mp.eigsy(mp.matrix(form.evalf(65).tolist()), eigvals_only=True)) > -(mp.mpf(10) ** -45)


PROVED = [
    ({"family": "cycle", "agents": 4}, "1/3"),
    ({"family": "cycle", "agents": 4}, Fraction(1, 3) - HAIR),
    ({"family": "path", "agents": 4}, "1/2"),  # 2 - sqrt 2 and 2 + sqrt 2: a tie at an irrational lambda2
    ({"family": "path", "agents": 9}, "1/2"),
    ({"family": "path", "agents": 6}, "1/4"),
    ({"family": "star", "agents": 5}, "1/3"),
    ({"family": "complete", "agents": 5}, "1/5"),
    ({"family": "complete", "agents": 5}, "1/9"),
    ({"family": "cycle", "agents": 5}, "2/5"),
    (product(RING3, 3, QUARTER_PAIR, 2), "2/3"),  # not symmetric; the skew part vanishes where lambda2 lives
    (product(RING3, 3, QUARTER_PAIR, 2), Fraction(2, 3) - HAIR),
    (product(RING3, 3, QUARTER_PAIR, 2), "1/9"),
    (product(RING3, 3, PATH4, 4), "1/4"),
]


@pytest.mark.parametrize(("graph", "mu"), PROVED)
def test_what_proves_the_step(graph: dict[str, object], mu: Fraction | str) -> None:
    found = loop(graph, mu)
    witness = beta_contraction_witness(found, 256)
    assert witness is not None
    with mp.workdps(70):
        assert_witness(found, witness, Fraction(mu))


REFUTED = [
    ({"family": "cycle", "agents": 4}, Fraction(1, 3) + HAIR),
    ({"family": "path", "agents": 4}, Fraction(1, 2) + HAIR),
    ({"family": "cycle", "agents": 5}, Fraction(2, 5) + HAIR),
    ({"family": "complete", "agents": 5}, Fraction(1, 5) + HAIR),
    ({"family": "complete", "agents": 5}, "9"),
    ({"family": "directed-cycle", "agents": 4}, "1/1000"),
    (product(RING3, 3, QUARTER_PAIR, 2), Fraction(2, 3) + HAIR),
    (product(RING3, 3, QUARTER_PAIR, 2), "1"),
    (PAPER, "0.13474"),
    (PAPER, "1e-6"),
]


@pytest.mark.parametrize(("graph", "mu"), REFUTED)
def test_what_refutes_the_step(graph: dict[str, object], mu: Fraction | str) -> None:
    """A vector that sums to 0 and is stretched by more than beta, in exact arithmetic."""
    found = loop(graph, mu)
    assert beta_contraction_witness(found, 256) is None
    beta = found.beta(256)
    e = direction_above(found, beta, 256)
    assert e is not None
    assert any(e)
    assert sum(e) == 0
    vector = sympy.Matrix([sympy.Rational(x.numerator, x.denominator) for x in e])
    step = vector - sympy.Rational(Fraction(mu).numerator, Fraction(mu).denominator) * laplacian(found) * vector
    bound = sympy.Rational(beta.upper.numerator, beta.upper.denominator)
    assert bound < 0 or step.dot(step) > bound**2 * vector.dot(vector)


def test_no_direction_above_sigma() -> None:
    found = loop(PAPER, "0.13474")
    assert direction_above(found, Interval.exactly(found.sigma(128).upper), 128) is None
    assert direction_above(found, Interval(Fraction(0), Fraction(2)), 128) is None


@pytest.mark.parametrize(("m", "n", "weight"), [(2, 4, "1"), (3, 6, "1"), (5, 3, "1/3"), (1, 4, "1"), (4, 4, "2/7")])
def test_sigma_exactly_1(m: int, n: int, weight: str) -> None:
    """K_{m,n} at mu = 2/(m + n): the least eigenvalue of 2 L_s - mu L^T L is 0 on 1perp, as it is at the vector 1."""
    edges = [e for i in range(1, m + 1) for j in range(m + 1, m + n + 1) for e in ([i, j, weight], [j, i, weight])]
    found = loop({"agents": m + n, "edges": edges}, Fraction(2, m + n) / Fraction(weight))
    assert found.sigma(128).contains(Fraction(1))
    e = direction_above(found, found.beta(128), 128)
    assert e is not None
    assert sum(e) == 0


def test_two_singular_values_close_together() -> None:
    """A triangle with eigenvalues of L 1 - (b - 1e-12) and 1 + (b + 1e-20) at mu = 1: sigma is 1e-20 above b = 4/5."""
    b, near, nearer = Fraction(4, 5), Fraction(1, 10**12), Fraction(1, 10**20)
    least, most = 1 - (b - near), 1 + (b + nearer)
    side = least / 3
    base = str((most - side) / 2)
    pairs = [(1, 2, base), (1, 3, str(side)), (2, 3, str(side))]
    edges = [edge for i, j, w in pairs for edge in ([i, j, w], [j, i, w])]
    assert direction_above(loop({"agents": 3, "edges": edges}, 1), Interval.exactly(b), 256) is not None


def test_the_contraction_interval_of_the_papers_graph() -> None:
    """Theory, section 5: sigma <= 2^0.9 - 1 exactly on [0.15678262217..., 0.39651947232...]."""
    found = loop(PAPER, "1/5")
    region = contraction_interval(found, found.threshold(128))
    assert region is not None
    assert Fraction("0.156782") < region.lower <= Fraction("0.15678262218")
    assert Fraction("0.39651947232") <= region.upper < Fraction("0.39652")


@pytest.mark.parametrize(("graph", "alpha"), [(PAPER, "0.86303"), ({"family": "directed-cycle", "agents": 10}, "9/10")])
def test_an_empty_contraction_interval(graph: dict[str, object], alpha: str) -> None:
    """Theory, section 5: the paper's graph opens at alpha 0.86303781...; the ring needs sigma below 0.97."""
    found = Loop(design_from_mapping({"name": "x", "alpha": alpha, "mu": "1/5", "graph": graph}))
    assert contraction_interval(found, found.threshold(128)) is None
