"""Certificates about large networks built by hand, at sizes at which numpy says what is true of them."""

import hashlib
import io
import json
from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import mpmath
import numpy as np

from fomas_verify.checker import STATEMENTS, Report, check

Json = dict[str, Any]
Edges = list[tuple[int, int, Fraction]]
IDS = [name for name in STATEMENTS if name != "trajectory-norm-bound"]
NAME = "graph.edges"
CLEAR = 1e-7
"""What floats say is taken for true beyond this distance from a tie."""


def joined(pairs: Iterable[tuple[int, int]], weight: Fraction = Fraction(1)) -> Edges:
    return sorted({(*ends, weight) for i, j in pairs for ends in ((i, j), (j, i))})


def lattice(rows: int, columns: int, wrap: bool) -> Edges:
    cells = [(r, c) for r in range(rows) for c in range(columns)]
    number = {cell: i + 1 for i, cell in enumerate(cells)}
    right = [((r, c), (r, (c + 1) % columns)) for r, c in cells if wrap or c + 1 < columns]
    below = [((r, c), ((r + 1) % rows, c)) for r, c in cells if wrap or r + 1 < rows]
    return joined((number[a], number[b]) for a, b in right + below)


def family_edges(graph: Json, n: int) -> Edges:
    """The edges of a family, from what its name says."""
    name = graph["family"]
    if name in ("torus", "grid"):
        return lattice(*graph["shape"], wrap=name == "torus")
    everyone = range(1, n + 1)
    if name == "directed-cycle":
        return sorted((i, i % n + 1, Fraction(1)) for i in everyone)
    pairs = {
        "cycle": [(i, i % n + 1) for i in everyone],
        "path": [(i, i + 1) for i in everyone if i < n],
        "star": [(1, i) for i in everyone if i > 1],
        "complete": [(i, j) for i in everyone for j in everyone if i < j],
        "hypercube": [(i, j) for i in everyone for j in everyone if bin((i - 1) ^ (j - 1)).count("1") == 1],
    }
    return joined(pairs[name])


def edge_list(edges: Edges) -> bytes:
    return "".join(f"{i} {j} {w}\n" for i, j, w in sorted(edges)).encode()


def file_graph(data: bytes) -> Json:
    return {"file": NAME, "sha256": hashlib.sha256(data).hexdigest(), "edges": data.count(b"\n")}


def laplacian(edges: Edges, n: int) -> np.ndarray:
    result = np.zeros((n, n))
    for source, target, weight in edges:
        result[target - 1, source - 1] -= float(weight)
        result[target - 1, target - 1] += float(weight)
    return result


@dataclass(frozen=True)
class Oracle:
    """What numpy finds of a graph, mu and alpha; Assumption 1 holds."""

    edges: Edges
    n: int
    alpha: float
    mu: float

    @property
    def matrix(self) -> np.ndarray:
        return laplacian(self.edges, self.n)

    @property
    def basis(self) -> np.ndarray:
        """An orthonormal basis of the vectors that sum to 0, in columns."""
        return np.linalg.qr(np.eye(self.n) - 1 / self.n)[0][:, : self.n - 1]

    @property
    def step(self) -> np.ndarray:
        """P on 1perp."""
        return np.eye(self.n - 1) - self.mu * self.basis.T @ self.matrix @ self.basis

    @property
    def gaps(self) -> np.ndarray:
        """The eigenvalues of L_s on 1perp, ascending."""
        return np.linalg.eigvalsh(self.basis.T @ (self.matrix + self.matrix.T) / 2 @ self.basis)

    @property
    def sigma(self) -> float:
        return float(np.linalg.norm(self.step, 2))

    def peak(self, samples: int = 150) -> float:
        """The largest norm of Phi_k seen."""
        k = np.arange(samples + 2.0)
        c = (k + 1) ** self.alpha - k**self.alpha
        f = np.concatenate([[1.0], c[1:] - c[:-1]])
        r = np.zeros(samples)
        r[0] = 1.0
        for n in range(1, samples):
            r[n] = -f[1 : n + 1] @ r[n - 1 :: -1]
        step, phi, largest = self.step, np.eye(self.n - 1), 0.0
        for n in range(1, samples):
            phi = step @ phi + r[n] * np.eye(self.n - 1)
            largest = max(largest, float(np.linalg.norm(phi, 2)))
            if largest > 1e6:
                break
        return largest

    def excesses(self) -> dict[str, float]:
        """For each claim a number: the claim is true where it is below 0, false where it is above."""
        c1, c2 = 2**self.alpha - 1, 3**self.alpha - 2**self.alpha
        beta = 1 - self.mu * self.gaps[0]
        radius = max(abs(np.linalg.eigvals(self.step))) - 1
        step = self.sigma - beta
        return {
            "gain-bound": self.mu * max(np.diag(self.matrix)) - 1,
            "memory-inequality": max(beta - c1, -np.sqrt(c2) - beta),
            "beta-contraction": step if step > CLEAR else -1.0,
            "repaired-condition": self.sigma - c1,
            "control-norm-bound": self.peak() - 1,
            **dict.fromkeys(("perron-eigenvalues", "control-bounded", "average-consensus"), radius),
        }


def design(graph: Json, agents: int, alpha: str = "9/10", **more: Any) -> Json:
    return {"alpha": alpha, **more, "agents": agents, "graph": graph, "require": ["gain-bound"]}


def claim(name: str, verdict: str, **witness: Any) -> Json:
    return {"id": name, "verdict": verdict, "statement": STATEMENTS[name], "witness": witness}


def certificate(about: Json, *claims: Json, spectrum: Json | None = None, **values: tuple[str, str]) -> Json:
    found = {
        "format": "fomas-certificate/1",
        "kind": "design",
        "scale": "large",
        "design": about,
        "values": {name: {"lower": lower, "upper": upper} for name, (lower, upper) in values.items()},
        "claims": list(claims) or [claim("gain-bound", "undecided")],
        "tool": {"name": "fomas_verify", "version": "0.1.0"},
    }
    return found if spectrum is None else {**found, "spectrum": spectrum}


class Dense:
    """Redoes bounds with dense eigenvalues: an oracle for tests, with floats' own margin."""

    def _oracle(self, network: Any, mu: float = 0.0) -> Oracle:
        ends = zip(network.sources, network.targets, network.weights, strict=True)
        edges = [(s + 1, t + 1, Fraction(w, network.denominator)) for s, t, w in ends]
        return Oracle(edges, network.agents, 0.5, mu)

    def lambda2_at_least(self, network: Any, bound: Fraction) -> bool | None:
        return _sign(self._oracle(network).gaps[0] - float(bound))

    def lambda_max_at_most(self, network: Any, bound: Fraction) -> bool | None:
        return _sign(float(bound) - self._oracle(network).gaps[-1])

    def sigma_at_most(self, network: Any, mu: tuple[Fraction, Fraction], bound: Fraction) -> bool | None:
        return _sign(float(bound) - self._oracle(network, float(mu[1])).sigma)


def _sign(margin: float) -> bool | None:
    return None if abs(margin) < 1e-12 else bool(margin > 0)


def checked(document: Json, data: bytes = b"", numeric: Any = None) -> Report:
    def opener(name: str) -> io.BytesIO:
        assert name == NAME
        return io.BytesIO(data)

    return check(json.dumps(document).encode(), opener=opener, numeric=numeric)


def slow_vector(edges: Edges, n: int, scale: int = 10**6) -> list[int]:
    """An integer vector near the eigenvector of lambda2."""
    matrix = laplacian(edges, n)
    _, vectors = np.linalg.eigh(matrix + matrix.T + 4 * n * np.ones((n, n)) * abs(matrix).max())
    entries = [round(x * scale) for x in vectors[:, 0]]
    entries[0] -= sum(entries)
    return entries


def gain(alpha: str, gamma: str, h: str) -> float:
    """mu of gamma and h."""
    a, g, step = (mpmath.mpf(Fraction(x).numerator) / Fraction(x).denominator for x in (alpha, gamma, h))
    return float(g * step**a / mpmath.gamma(a + 1))
