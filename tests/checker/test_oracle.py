"""Random designs: the truth by eigenvalues and singular values in doubles, with margins; both verdicts tried."""

import random
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

from tests.checker.builder import CONSENSUS, Json, certificate, claim, design, laplacian, lyapunov, outcome

MARGIN = 1e-6


def balanced(choose: random.Random, agents: int) -> list[list[Any]]:
    """A sum of cycles through some of the agents, the first through all; sometimes made symmetric."""
    weights: dict[tuple[int, int], Fraction] = {}
    symmetric = choose.random() < 0.4
    for k in range(choose.randint(1, 3)):
        order = choose.sample(range(1, agents + 1), agents if k == 0 else choose.randint(2, agents))
        weight = Fraction(choose.randint(1, 5), choose.choice([1, 1, 3]))
        for i, source in enumerate(order):
            pairs = [(source, order[(i + 1) % len(order)])]
            for pair in pairs + [(b, a) for a, b in pairs] * symmetric:
                weights[pair] = weights.get(pair, Fraction(0)) + weight
    return [[i, j, str(w)] for (i, j), w in weights.items()]


class Truth:
    """What holds of a design, as doubles tell it."""

    def __init__(self, edges: list[list[Any]], agents: int, alpha: Fraction, mu: Fraction) -> None:
        matrix = laplacian(edges, agents)
        mean = np.ones((agents, agents)) / agents
        part = (matrix + matrix.T) / 2
        self.lambda2 = float(np.linalg.eigvalsh(part + 1e3 * mean)[0])
        self.beta = 1 - float(mu) * self.lambda2
        step = np.eye(agents) - float(mu) * matrix - mean
        _, singular, right = np.linalg.svd(step)
        self.sigma = float(singular[0])
        self.radius = float(max(abs(np.linalg.eigvals(step))))
        self.step = step
        self.vector = [Fraction(round(float(x) * 2**40), 2**40) for x in right[0]]
        self.vector[-1] -= sum(self.vector)
        self.threshold = 2 ** float(alpha) - 1
        self.second = -np.sqrt(3 ** float(alpha) - 2 ** float(alpha))
        self.degree = float(max(np.diag(matrix)))
        self.gain = float(mu) * self.degree

    def margins(self) -> list[float]:
        return [
            self.beta - self.threshold,
            self.beta - self.second,
            self.sigma - self.threshold,
            self.radius - 1,
            self.gain - 1,
        ]


def claims(truth: Truth, edges: list[list[Any]], agents: int, mu: Fraction) -> list[tuple[Json, bool]]:
    """Claims with the best witness there is, and whether they are true."""
    e = [str(x) for x in truth.vector]
    power = 1
    while abs(np.trace(np.linalg.matrix_power(truth.step, power))) <= agents - 1 + MARGIN and power < 10**5:
        power += max(power // 7, 1)
    unstable = {"mu": str(mu), "power": power}
    stable = {"mu": str(mu), "Q": lyapunov(edges, agents, mu, 60)} if truth.radius < 1 - MARGIN else None
    first, second = truth.beta > truth.threshold, truth.beta < truth.second
    found = [
        (claim("gain-bound", "proved"), truth.gain < 1),
        (claim("gain-bound", "refuted"), truth.gain > 1),
        (claim("memory-inequality", "proved"), not first and not second),
        (claim("memory-inequality", "refuted", k=0), first),
        (claim("memory-inequality", "refuted", k=1), second),
        (claim("repaired-condition", "proved"), truth.sigma < truth.threshold),
        (claim("repaired-condition", "refuted", e=e), truth.sigma > truth.threshold),
    ]
    if abs(truth.sigma - truth.beta) > MARGIN:
        found.append((claim("beta-contraction", "refuted", e=e), True))
    for name in CONSENSUS:
        found.append((claim(name, "refuted", **unstable), truth.radius > 1 and power < 10**5))
        if stable is not None:
            found.append((claim(name, "proved", **stable), True))
            found.append((claim(name, "refuted", mu=str(mu), Y=stable["Q"]), False))
    return found


@pytest.mark.parametrize("seed", range(60))
def test_random_designs(seed: int) -> None:
    choose = random.Random(seed)
    agents = choose.randint(2, 7)
    edges = balanced(choose, agents)
    alpha = Fraction(choose.randint(1, 19), 20)
    degree = max(np.diag(laplacian(edges, agents)))
    mu = Fraction(choose.randint(1, 60), 29) / Fraction(str(degree)).limit_denominator(9)
    truth = Truth(edges, agents, alpha, mu)
    if min(abs(margin) for margin in truth.margins()) < MARGIN:
        mu += Fraction(1, 1009)
        truth = Truth(edges, agents, alpha, mu)
    assert min(abs(margin) for margin in truth.margins()) >= MARGIN
    document = certificate(design(edges, agents, str(alpha), mu=str(mu)))
    for entry, true in claims(truth, edges, agents, mu):
        document["claims"] = [entry]
        status, reason = outcome(document, entry["id"])
        assert status == ("accepted" if true else "refused"), (entry["id"], entry["verdict"], reason)
    for name, value in (("lambda2", truth.lambda2), ("beta", truth.beta), ("sigma", truth.sigma)):
        exact = Fraction(value)
        for low, high in ((-1, 1), (1, 2), (-2, -1)):
            ends = {"lower": str(exact + low * Fraction(1, 10**9)), "upper": str(exact + high * Fraction(1, 10**9))}
            document["values"] = {name: ends}
            assert outcome(document, name)[0] == ("accepted" if low < 0 < high else "refused")
