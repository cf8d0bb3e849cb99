"""Designs with known answers, as certificates that are true in every line; the reasons stand beside them.

Spectra: path P_n has 2 - 2 cos(pi k / n), cycle C_n 2 - 2 cos(2 pi k / n), complete K_n n; a directed cycle
at mu = 1 is a permutation. P4: 2 - sqrt 2, 2, 2 + sqrt 2. P5: (3 -+ sqrt 5)/2, (5 -+ sqrt 5)/2.
"""

from fractions import Fraction
from typing import Any

from tests.checker.builder import (
    CONSENSUS,
    Json,
    certificate,
    claim,
    complete,
    cycle,
    design,
    directed_cycle,
    lyapunov,
    paper,
    path,
)

Edges = list[list[Any]]

P4_LAMBDA2 = {"polynomial": ["2", "-4", "1"], "lower": "0", "upper": "1"}
P5_LAMBDA2 = {"polynomial": ["1", "-3", "1"], "lower": "0", "upper": "1"}
TWO_ROTORS = directed_cycle(3) + [[i + 3, j + 3, w] for i, j, w in directed_cycle(3)] + [
    edge for i in (1, 2, 3) for j in (4, 5, 6) for edge in ([i, j, "1/10"], [j, i, "1/10"])
]  # fmt: skip
CENTRED_4 = [["3/4"], ["-1/4", "3/4"], ["-1/4", "-1/4", "3/4"]]
ALTERNATING_4 = [["1"], ["-1", "1"], ["1", "-1", "1"]]
INAPPLICABLE = [
    claim(name, "inapplicable")
    for name in (
        "memory-inequality",
        "beta-contraction",
        "repaired-condition",
        "control-bounded",
        "average-consensus",
    )
]


def stable(edges: Edges, agents: int, mu: str) -> list[Json]:
    rows = lyapunov(edges, agents, Fraction(mu))
    return [claim(name, "proved", mu=mu, Q=rows) for name in CONSENSUS]


def unstable(**witness: Any) -> list[Json]:
    return [claim(name, "refuted", **witness) for name in CONSENSUS]


def k2_on_the_circle() -> Json:
    """K2 at mu = 1: Pc = -1; sigma = 1."""
    claims = [
        claim("graph-assumption", "proved"),
        claim("gain-bound", "refuted"),
        claim("memory-inequality", "refuted", k=1),
        claim("beta-contraction", "refuted", e=["1", "-1"]),
        claim("repaired-condition", "refuted", e=["-2/3", "2/3"]),
        *unstable(mu="1", Y=[["7/2"]]),
    ]
    values = {"mu": ("1", "1"), "degree_max": ("1", "1"), "lambda2": ("2", "2"), "beta": ("-1", "-1")}
    return certificate(design(path(2), 2, mu="1"), claims, **values, sigma=("1", "1"))


def k2_beyond() -> Json:
    """K2 at mu = 3/2: Pc = -2."""
    claims = [claim("gain-bound", "refuted"), *unstable(mu="5/4", power=3)]
    return certificate(design(path(2), 2, mu="3/2", h="1/2"), claims, sigma=("2", "2"), beta=("-4/2", "-1"))


def directed_cycle_permutation() -> Json:
    """A directed 4-cycle at mu = 1: P is a permutation, norm of x minus its mean stays."""
    claims = [
        claim("graph-assumption", "proved"),
        claim("gain-bound", "refuted"),
        claim("memory-inequality", "proved"),
        claim("beta-contraction", "refuted", e=["1", "0", "-1", "0"]),
        claim("repaired-condition", "refuted", e=["1", "0", "-1", "0"]),
        *unstable(mu="1", Y=CENTRED_4),
    ]
    values = {"lambda2": ("1", "1"), "beta": ("0", "0"), "sigma": ("1", "1"), "degree_max": ("1", "1")}
    return certificate(design(directed_cycle(4), 4, mu="1"), claims, **values)


def weighted_directed_cycle() -> Json:
    """Weights 2/3: at mu = 3/2 the same permutation; here a little earlier."""
    edges = directed_cycle(4, "2/3")
    claims = [claim("gain-bound", "proved"), claim("graph-assumption", "proved"), *stable(edges, 4, "29/20")]
    return certificate(design(edges, 4, mu="29/20"), claims, degree_max=("2/3", "4/6"), lambda2=("2/3", "2/3"))


def square_alternating() -> Json:
    """C4 at mu = 1/2: lambda = 4 gives the eigenvalue -1 of P."""
    claims = [
        claim("gain-bound", "refuted"),
        claim("memory-inequality", "proved"),
        claim("beta-contraction", "refuted", e=["1", "-1", "1", "-1"]),
        *unstable(mu="1/2", Y=ALTERNATING_4),
    ]
    return certificate(design(cycle(4), 4, mu="1/2"), claims, sigma=("1", "1"), beta=("0", "0"))


def square_contraction_tie() -> Json:
    """C4 at mu = 1/3: mu (lambda2 + lambda_max) = 2 exactly."""
    bounds = {"mu": "1/3", "lambda2_upper": "2", "lambda_max_upper": "4"}
    claims = [claim("beta-contraction", "proved", **bounds), claim("gain-bound", "proved")]
    return certificate(design(cycle(4), 4, mu="1/3"), claims, sigma=("1/3", "1/3"), beta=("1/3", "1/3"))


def path4_tie() -> Json:
    """P4, alpha = 1/2, mu = 1: beta = sqrt 2 - 1 = 2^alpha - 1."""
    claims = [
        claim("graph-assumption", "proved"),
        claim("gain-bound", "refuted"),
        claim("memory-inequality", "proved"),
        claim("beta-contraction", "refuted", e=["5", "-12", "12", "-5"]),
        claim("repaired-condition", "refuted", e=["1", "-2", "2", "-1"]),
        *unstable(mu="9/10", power=2),
    ]
    values = {"beta": ("414213/1000000", "414214/1000000"), "sigma": ("2414213/1000000", "2414214/1000000")}
    return certificate(design(path(4), 4, "1/2", mu="1"), claims, **values)


def path4_contraction() -> Json:
    """P4 at mu = 1/2: mu (lambda2 + lambda_max) = 2, both irrational."""
    claims = [claim("beta-contraction", "proved", mu="1/2", lambda2=P4_LAMBDA2), *stable(path(4), 4, "1/2")]
    return certificate(design(path(4), 4, mu="1/2"), claims)


def path5_contraction() -> Json:
    """P5 at mu = 1/2, the same tie; at a polynomial of degree 4 that splits."""
    reducible = {"polynomial": ["5", "-20", "21", "-8", "1"], "lower": "0", "upper": "1"}
    return certificate(design(path(5), 5, mu="1/2"), [claim("beta-contraction", "proved", mu="1/2", lambda2=reducible)])


def path5_irrational_mu() -> Json:
    """P5 well below the tie: with a rational bound of mu above it, both witnesses show the step."""
    lambda2 = {**P5_LAMBDA2, "polynomial": ["2/7", "-6/7", "2/7"]}
    about = design(path(5), 5, "9/10", gamma="1/5", h="1")
    return certificate(about, [claim("beta-contraction", "proved", mu="1/4", lambda2=lambda2)])


def complete_deadbeat() -> Json:
    """K5 at mu = 1/5: P = J, beta = sigma = 0."""
    bounds = {"mu": "1/5", "lambda2_upper": "5", "lambda_max_upper": "5"}
    claims = [
        claim("gain-bound", "proved"),
        claim("memory-inequality", "proved"),
        claim("beta-contraction", "proved", **bounds),
        claim("repaired-condition", "proved"),
        *stable(complete(5), 5, "1/5"),
    ]
    values = {"sigma": ("0", "0"), "beta": ("0", "0"), "lambda2": ("5", "5"), "degree_max": ("4", "4")}
    return certificate(design(complete(5), 5, mu="1/5"), claims, **values)


def complete_negative_beta() -> Json:
    """K5 at mu = 39/100: beta = -0.95 < -sqrt(3^0.9 - 2^0.9) = -0.909; still stable, as sigma = 0.95."""
    claims = [
        claim("memory-inequality", "refuted", k=1),
        claim("gain-bound", "refuted"),
        claim("beta-contraction", "refuted", e=["1", "0", "0", "0", "-1"]),
        claim("repaired-condition", "refuted", e=["1", "0", "0", "0", "-1"]),
        *stable(complete(5), 5, "39/100"),
    ]
    return certificate(design(complete(5), 5, mu="39/100"), claims, beta=("-19/20", "-19/20"), sigma=("19/20", "1"))


def bipartite() -> Json:
    """K_{4,4} at mu = 0.95/4: lambda = 4, 8, so beta = 0.05, sigma = 0.9 > 2^0.9 - 1."""
    edges = [edge for i in range(1, 5) for j in range(5, 9) for edge in ([i, j, "1"], [j, i, "1"])]
    e = ["1"] * 4 + ["-1"] * 4
    claims = [
        claim("gain-bound", "proved"),
        claim("memory-inequality", "proved"),
        claim("beta-contraction", "refuted", e=e),
        claim("repaired-condition", "refuted", e=e),
        *stable(edges, 8, "19/80"),
    ]
    return certificate(design(edges, 8, mu="19/80"), claims, beta=("1/20", "1/20"), sigma=("9/10", "9/10"))


def two_rotors() -> Json:
    """Two directed triangles joined by a weak symmetric bond: lambda2 = 3/5, where L is symmetric; the step holds."""
    lambda2 = {"polynomial": ["-3/5", "1"], "lower": "1/2", "upper": "3/5"}
    claims = [
        claim("beta-contraction", "proved", mu="1/10", lambda2=lambda2),
        claim("memory-inequality", "refuted", k=0),
        *stable(TWO_ROTORS, 6, "1/10"),
    ]
    return certificate(design(TWO_ROTORS, 6, mu="1/10"), claims, lambda2=("3/5", "3/5"), beta=("47/50", "47/50"))


def no_edges() -> Json:
    """Nobody hears anybody: P = I."""
    claims = [
        claim("graph-assumption", "refuted", unreachable=[3, 1]),
        claim("gain-bound", "proved"),
        claim("perron-eigenvalues", "refuted", mu="1", Y=[["1"], ["0", "1"]]),
        *INAPPLICABLE,
    ]
    return certificate(design([], 3, gamma="1", h="8"), claims, degree_max=("0", "0"))


def rooted_and_unbalanced() -> Json:
    """1 -> 2 -> 3 : eigenvalue 1 of P is simple, although the graph is neither connected both ways nor balanced."""
    edges = [[1, 2, "1"], [2, 3, "2"]]
    claims = [
        claim("graph-assumption", "refuted", unreachable=[2, 1], imbalance={"agent": 2, "in": "1", "out": "2"}),
        claim("gain-bound", "proved"),
        claim("perron-eigenvalues", "proved", mu="1/3", Q=[["30"], ["-10", "9"]]),
        *INAPPLICABLE,
    ]
    claims[2]["witness"]["Q"] = lyapunov(edges, 3, Fraction(1, 3))
    return certificate(design(edges, 3, mu="1/3"), claims, degree_max=("2", "2"))


def unbalanced() -> Json:
    """Strongly connected, not balanced."""
    claims = [
        claim("graph-assumption", "refuted", imbalance={"agent": 1, "in": "2", "out": "1"}),
        claim("perron-eigenvalues", "refuted", mu="1", power=1),
        *INAPPLICABLE,
    ]
    return certificate(design([[1, 2, "1"], [2, 1, "2"]], 2, mu="3/2"), claims)


CASES = {
    make.__name__: make
    for make in (
        paper,
        k2_on_the_circle,
        k2_beyond,
        directed_cycle_permutation,
        weighted_directed_cycle,
        square_alternating,
        square_contraction_tie,
        path4_tie,
        path4_contraction,
        path5_contraction,
        path5_irrational_mu,
        complete_deadbeat,
        complete_negative_beta,
        bipartite,
        two_rotors,
        no_edges,
        rooted_and_unbalanced,
        unbalanced,
    )
}
