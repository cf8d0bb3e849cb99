"""mu < mu*: sides, exact ties and witnesses, each witness tested in exact arithmetic written here."""

from fractions import Fraction
from typing import Any

import pytest
import sympy

from fomas_verify.design import design_from_mapping
from fomas_verify.exact.matrix import matrix
from fomas_verify.spectrum.loop import Loop
from fomas_verify.spectrum.stability import Side, lyapunov_form, stability

PAPER = {"adjacency": [[0, 0, 0, 1, 1], [1, 0, 1, 0, 0], [1, 1, 0, 0, 0], [0, 1, 1, 0, 0], [0, 0, 0, 1, 0]]}
HAIR = Fraction(1, 10**50)


def family(name: str, agents: int) -> dict[str, object]:
    return {"family": name, "agents": agents}


def circulant(n: int, steps: dict[int, str]) -> dict[str, object]:
    return {"agents": n, "edges": [[i, (i + s - 1) % n + 1, w] for s, w in steps.items() for i in range(1, n + 1)]}


def rational(x: Fraction) -> sympy.Rational:
    return sympy.Rational(x.numerator, x.denominator)


def perron(loop: Loop, t: Fraction) -> sympy.Matrix:
    """Pc(t) from the edges: rows of the differences from the last agent."""
    graph = loop.design.graph
    n = graph.agents
    el = sympy.zeros(n)
    for source, target, weight in graph.edges:
        el[target - 1, target - 1] += rational(weight)
        el[target - 1, source - 1] -= rational(weight)
    return sympy.eye(n - 1) - rational(t) * sympy.Matrix(n - 1, n - 1, lambda i, j: el[i, j] - el[n - 1, j])


def full(rows: list[list[Fraction]]) -> sympy.Matrix:
    n = len(rows)
    assert [len(row) for row in rows] == list(range(1, n + 1))
    return sympy.Matrix(n, n, lambda i, j: rational(rows[max(i, j)][min(i, j)]))


def semidefinite(a: sympy.Matrix) -> bool:
    """Its characteristic polynomial has no negative root: the signs of its coefficients alternate."""
    return all(c * (-1) ** i >= 0 for i, c in enumerate(a.charpoly().all_coeffs()))


def assert_witness(loop: Loop, side: Side, witness: Any, mu: Fraction) -> None:
    """docs/certificate-format.md, section 4."""
    t = witness["mu"]
    p = perron(loop, t)
    if side is Side.INSIDE:
        q = full(witness["Q"])
        assert t >= mu
        assert q.is_positive_definite
        assert (q - p.T * q * p).is_positive_definite
    elif "power" in witness:
        assert 0 < t <= mu
        power = p ** witness["power"] if witness["power"] < 400 else None
        if power is not None:
            assert abs(power.trace()) > p.rows
    else:
        y = full(witness["Y"])
        assert 0 < t <= mu
        assert not y.is_zero_matrix
        assert semidefinite(y)
        assert semidefinite(p.T * y * p - y)


STARS = [
    (PAPER, "2/3"),
    (family("path", 2), "1"),
    (family("cycle", 4), "1/2"),
    (family("cycle", 6), "1/2"),
    (family("complete", 5), "2/5"),
    (family("star", 5), "2/5"),
    (family("path", 3), "2/3"),
    *[(family("directed-cycle", n), "1") for n in (3, 4, 5, 6, 7, 12)],
    (circulant(3, {1: "1", 2: "1/2"}), "6/7"),
    (circulant(3, {1: "2", 2: "1/3"}), "21/43"),  # modulus 1 at no root of unity
    ({"agents": 3, "edges": [[1, 2], [2, 3]]}, "2"),
    ({"agents": 3, "edges": [[1, 2], [2, 1, "1/2"], [2, 3, "1/7"]]}, "4/3"),
]


@pytest.mark.parametrize(("graph", "star"), STARS)
@pytest.mark.parametrize("offset", [-Fraction(1, 50), -HAIR, Fraction(0), HAIR, Fraction(1, 7)])
def test_either_side_of_mu_star_and_on_it(graph: dict[str, object], star: str, offset: Fraction) -> None:
    mu = Fraction(star) + offset
    loop = Loop(design_from_mapping({"name": "x", "alpha": "9/10", "mu": str(mu), "graph": graph}))
    found = stability(loop)
    assert found.side is (Side.INSIDE if offset < 0 else Side.BOUNDARY if offset == 0 else Side.OUTSIDE)
    assert found.mu_star is not None
    assert found.mu_star.contains(Fraction(star))
    assert_witness(loop, found.side, found.witness, mu)


NEAR_MU_STAR = ["0.5857864376269049511983112757903019214303281246230519", "0.58578643762690495119832"]


@pytest.mark.parametrize("number", NEAR_MU_STAR)
def test_an_irrational_mu_star(number: str) -> None:
    """Path of 4: mu* = 2 / (2 + sqrt 2) = 2 - sqrt 2 = 0.58578643762690495119831127579030192143032812462305192683..."""
    loop = Loop(design_from_mapping({"name": "x", "alpha": "1/2", "mu": number, "graph": family("path", 4)}))
    found = stability(loop)
    assert found.side is (Side.INSIDE if (2 - Fraction(number)) ** 2 > 2 else Side.OUTSIDE)
    assert_witness(loop, found.side, found.witness, Fraction(number))


@pytest.mark.parametrize("edges", [[], [[1, 2], [2, 1], [3, 4], [4, 3]], [[1, 3], [2, 3], [3, 4]]])
@pytest.mark.parametrize("gain", [{"mu": "1/4"}, {"mu": "3"}, {"gamma": "0.2", "h": "0.5"}])
def test_without_a_root_no_gain_will_do(edges: list[list[int]], gain: dict[str, str]) -> None:
    graph = {"agents": 4, "edges": edges}
    loop = Loop(design_from_mapping({"name": "x", "alpha": "9/10", **gain, "graph": graph}))
    found = stability(loop)
    assert (found.side, found.mu_star) == (Side.BOUNDARY, None)
    assert_witness(loop, found.side, found.witness, loop.mu(128).lower)


def test_no_lyapunov_form_for_a_matrix_that_is_not_schur() -> None:
    with pytest.raises(ArithmeticError):
        lyapunov_form(matrix([[Fraction(1)]]))
    with pytest.raises(ArithmeticError):
        lyapunov_form(matrix([[Fraction(1, 2), Fraction(0)], [Fraction(5), Fraction(-11, 10)]]))
