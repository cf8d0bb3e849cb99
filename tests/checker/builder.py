"""Certificates built by hand: designs, witnesses by numpy and scipy, numbers by mpmath."""

import json
from collections.abc import Iterable
from fractions import Fraction
from typing import Any

import mpmath
import numpy as np
from scipy.linalg import solve_discrete_lyapunov

from fomas_verify.checker import STATEMENTS, Report, check

CONSENSUS = ("perron-eigenvalues", "control-bounded", "average-consensus")
PAPER_EDGES = [[4, 1, "1"], [5, 1, "1"], [1, 2, "1"], [3, 2, "1"], [1, 3, "1"], [2, 3, "1"], [2, 4, "1"], [3, 4, "1"],
               [4, 5, "1"]]  # fmt: skip

Json = dict[str, Any]


def both_ways(pairs: Iterable[tuple[int, int]], weight: str = "1") -> list[list[Any]]:
    return [[i, j, weight] for a, b in pairs for i, j in ((a, b), (b, a))]


def path(n: int) -> list[list[Any]]:
    return both_ways((i, i + 1) for i in range(1, n))


def cycle(n: int) -> list[list[Any]]:
    return both_ways((i, i % n + 1) for i in range(1, n + 1))


def directed_cycle(n: int, weight: str = "1") -> list[list[Any]]:
    return [[i, i % n + 1, weight] for i in range(1, n + 1)]


def complete(n: int, weight: str = "1") -> list[list[Any]]:
    return both_ways(((i, j) for i in range(1, n + 1) for j in range(i + 1, n + 1)), weight)


def design(edges: list[list[Any]], agents: int, alpha: str = "9/10", **more: Any) -> Json:
    copied = [list(edge) for edge in edges]
    return {"alpha": alpha, **more, "agents": agents, "edges": copied, "require": more.get("require", ["gain-bound"])}


def claim(name: str, verdict: str, **witness: Any) -> Json:
    return {"id": name, "verdict": verdict, "statement": STATEMENTS[name], "witness": witness}


def certificate(about: Json, claims: list[Json] | None = None, **values: tuple[str, str]) -> Json:
    return {
        "format": "fomas-certificate/1",
        "kind": "design",
        "design": about,
        "values": {name: {"lower": lower, "upper": upper} for name, (lower, upper) in values.items()},
        "claims": claims or [claim("gain-bound", "undecided", bits=4096)],
        "tool": {"name": "fomas_verify", "version": "0.1.0"},
    }


def checked(document: Json) -> Report:
    return check(json.dumps(document).encode())


def outcome(document: Json, name: str) -> tuple[str, str]:
    """Status and reason of the value or claim of that name."""
    return next((o.status, o.reason) for o in checked(document).outcomes if o.id == name)


def laplacian(edges: list[list[Any]], agents: int) -> np.ndarray:
    result = np.zeros((agents, agents))
    for source, target, weight in edges:
        result[target - 1, source - 1] -= float(Fraction(weight))
        result[target - 1, target - 1] += float(Fraction(weight))
    return result


def lyapunov(edges: list[list[Any]], agents: int, t: Fraction, bits: int = 30) -> list[list[str]]:
    """A solution of Q - Pc(t)^T Q Pc(t) = I, rounded to multiples of 2^-bits."""
    matrix = laplacian(edges, agents)
    step = np.eye(agents - 1) - float(t) * (matrix[:-1, :-1] - matrix[-1, :-1])
    solution = solve_discrete_lyapunov(step.T, np.eye(agents - 1))
    return [[str(Fraction(round(solution[i, j] * 2**bits), 2**bits)) for j in range(i + 1)] for i in range(agents - 1)]


def decimal(x: mpmath.mpf, digits: int, up: bool) -> str:
    """x rounded to a rational with 10^digits below it."""
    scaled = mpmath.ceil(x * 10**digits) if up else mpmath.floor(x * 10**digits)
    return f"{int(scaled)}/{10**digits}"


def bounds(x: mpmath.mpf, digits: int = 30) -> tuple[str, str]:
    return decimal(x, digits, False), decimal(x, digits, True)


def paper(digits: int = 30) -> Json:
    """The certificate of the paper's design, all eight claims and all six values."""
    mpmath.mp.dps = digits + 40
    mu = mpmath.mpf("0.15") * mpmath.mpf("0.85") ** mpmath.mpf("0.9") / mpmath.gamma(mpmath.mpf("1.9"))
    about = design(PAPER_EDGES, 5, gamma="3/20", h="17/20", x0=["9/2", "5", "6", "3/2", "-1"], require=list(CONSENSUS))
    t = Fraction(decimal(mu, 20, True))
    matrix = mpmath.matrix(laplacian(PAPER_EDGES, 5).tolist())
    step = mpmath.eye(5) - mu * matrix
    deviation = step - mpmath.ones(5) / 5
    sigma = mpmath.sqrt(max(mpmath.eigsy(deviation.T * deviation, eigvals_only=True)))
    stable = {"mu": str(t), "Q": lyapunov(PAPER_EDGES, 5, t)}
    vector = ["-1", "-3", "-3", "1", "6"]
    claims = [
        claim("graph-assumption", "proved"),
        claim("gain-bound", "proved"),
        claim("memory-inequality", "proved"),
        claim("perron-eigenvalues", "proved", **stable),
        claim("beta-contraction", "refuted", e=vector),
        claim("repaired-condition", "refuted", e=vector),
        claim("control-bounded", "proved", **stable),
        claim("average-consensus", "proved", **stable),
    ]
    return certificate(
        about,
        claims,
        mu=bounds(mu, digits),
        threshold=bounds(mpmath.mpf(2) ** mpmath.mpf("0.9") - 1, digits),
        degree_max=("2", "2"),
        lambda2=("1", "1"),
        beta=bounds(1 - mu, digits),
        sigma=bounds(sigma, 14),
    )
