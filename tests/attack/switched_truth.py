"""Certificates about graphs to switch among, mutated, and judged by numpy: what the checker accepts must be so.

The oracle shares no code with the checker: it rebuilds Laplacians in floats, and looks at eigenvalues, spectral radii
and products of P_1, P_2, ... instead of exact forms. A mutant within 1e-9 of an equality counts for neither side.
"""

from __future__ import annotations

import itertools
import json
import random
from fractions import Fraction
from typing import Any

import mpmath
import numpy as np

from fomas_verify.checker import Malformed, check
from tests.checker import switched

from .tally import Tally

NEAR = 1e-9
BASES = [
    switched.proved(),
    switched.proved(["1/10", "13/20"]),
    switched.slow(),
    switched.undecided(),
    switched.in_turn(),
    switched.region_by_dual(),
    switched.region_by_graph(),
]


def numbers_in(value: Any) -> list[tuple[Any, Any]]:
    """Every place that holds a rational in a string, but for the statements."""
    found: list[tuple[Any, Any]] = []
    for key, entry in value.items() if isinstance(value, dict) else enumerate(value):
        if isinstance(entry, dict | list):
            found += numbers_in(entry)
        elif isinstance(entry, str) and entry.lstrip("-").replace("/", "").isdigit():
            found.append((value, key))
    return found


def mutant(source: random.Random) -> dict[str, Any]:
    document = json.loads(json.dumps(source.choice(BASES)))
    for _ in range(source.choice((1, 1, 2))):
        places = numbers_in({key: document[key] for key in ("design", "values", "claims")})
        place, key = source.choice(places)
        x = Fraction(place[key])
        step = Fraction(1, 10 ** source.choice((1, 2, 3, 4, 6)))
        place[key] = str(
            source.choice((x * (1 + step), x * (1 - step), x + step, x - step, -x, 2 * x, Fraction(0), x / 2))
        )
    if source.random() < 0.2:
        claim = source.choice(document["claims"])
        claim["verdict"] = source.choice(("proved", "refuted", "undecided"))
    if source.random() < 0.1 and len(document["design"]["graphs"]) > 1:
        document["design"]["graphs"].reverse()
    return document


class Oracle:
    """What is true of the design of a document, in floats."""

    def __init__(self, document: dict[str, Any]) -> None:
        design = document["design"]
        self.agents = n = design["agents"]
        self.laplacians = []
        for edges in design["graphs"]:
            el = np.zeros((n, n))
            for source, target, weight in edges:
                el[target - 1, source - 1] -= float(Fraction(weight))
                el[target - 1, target - 1] += float(Fraction(weight))
            self.laplacians.append(el)
        self.degree = max(float(np.diag(el).max()) for el in self.laplacians)
        self.connected = all(self._agrees(el) for el in self.laplacians)
        self.imbalance = max(float(np.abs(el.sum(axis=0)).max()) for el in self.laplacians)
        mu = design.get("mu")
        if mu is None and "gamma" in design and "h" in design:
            alpha, gamma, h = (mpmath.mpf(x.numerator) / x.denominator for x in map(Fraction, (
                design["alpha"], design["gamma"], design["h"])))  # fmt: skip
            mu = str(Fraction(float(gamma * h**alpha / mpmath.gamma(alpha + 1))))
        ends = mu if isinstance(mu, list) else [mu, mu]
        self.mu = tuple(float(Fraction(x)) for x in ends) if mu is not None else (0.0, 0.0)

    def _agrees(self, el: np.ndarray) -> bool:
        reach = np.linalg.matrix_power(np.eye(self.agents) + (el < 0), self.agents)
        return bool((reach > 0).all())

    def steps(self, t: float) -> list[np.ndarray]:
        return [np.eye(self.agents) - t * el - 1 / self.agents for el in self.laplacians]

    def radius(self, t: float, i: int) -> float:
        return float(max(abs(np.linalg.eigvals(self.steps(t)[i]))))

    def worst_products(self, t: float, length: int = 7) -> list[float]:
        """The largest norm of a product of each length, and the largest spectral radius, normed to one step."""
        products, largest = [np.eye(self.agents)], []
        for _ in range(length):
            products = [p @ w for p, w in itertools.product(self.steps(t), products)]
            largest.append(max(float(np.linalg.norm(w, 2)) for w in products))
        return largest

    def growth(self, t: float, length: int = 6) -> float:
        """A lower bound of the joint spectral radius."""
        products, best = [np.eye(self.agents)], 0.0
        for k in range(1, length + 1):
            products = [p @ w for p, w in itertools.product(self.steps(t), products)]
            best = max(best, *(float(max(abs(np.linalg.eigvals(w)))) ** (1 / k) for w in products))
        return best

    def in_turn(self, t: float, word: list[int]) -> float:
        product = np.eye(self.agents)
        for letter in word:
            product = self.steps(t)[letter - 1] @ product
        return float(max(abs(np.linalg.eigvals(product))))

    def differences(self, t: float) -> list[np.ndarray]:
        return [np.eye(self.agents - 1) - t * (el[:-1, :-1] - el[-1, :-1]) for el in self.laplacians]


def contradiction(document: dict[str, Any], name: str, kind: str) -> str:
    """What is wrong with an accepted value, claim or condition, in words; empty where nothing is seen to be."""
    oracle = Oracle(document)
    if kind == "value":
        return wrong_value(oracle, name, document["values"][name])
    claim = next(claim for claim in document["claims"] if claim["id"] == name)
    verdict, witness = claim["verdict"], claim["witness"]
    if kind == "condition":
        return wrong_condition(oracle, name, verdict, witness)
    top = oracle.mu[1]
    if name == "gain-bound" and verdict in ("proved", "refuted"):
        gap = top * oracle.degree - 1
        return "gain bound" if (gap > NEAR if verdict == "proved" else gap < -NEAR) else ""
    if name == "graph-assumption":
        fine = oracle.connected and oracle.imbalance < NEAR
        return "assumption" if verdict in ("proved", "refuted") and fine != (verdict == "proved") else ""
    if verdict == "proved":
        grows = oracle.growth(top) > 1 + NEAR or not oracle.connected or oracle.imbalance > NEAR
        return "consensus" if grows else ""
    if verdict == "refuted":
        if "word" in witness:
            t = float(Fraction(witness["mu"]))
            outside = not oracle.mu[0] - NEAR <= t <= oracle.mu[1] + NEAR
            return "in turn" if outside or oracle.in_turn(t, witness["word"]) < 1 - NEAR else ""
        return "stable" if max(oracle.radius(top, i) for i in range(len(oracle.laplacians))) < 1 - NEAR else ""
    return wrong_dual(oracle, float(Fraction(witness["mu"])), witness["Z"]) if "Z" in witness else ""


def wrong_value(oracle: Oracle, name: str, value: dict[str, Any]) -> str:
    if name == "rate":
        kappa, rho = (float(Fraction(value[key])) for key in ("kappa", "rho"))
        for t in oracle.mu:
            for k, size in enumerate(oracle.worst_products(t), 1):
                if size > kappa * rho**k * (1 + NEAR):
                    return f"rate at k = {k}"
        return ""
    low, high = (float(Fraction(value[end])) for end in ("lower", "upper"))
    true = oracle.mu if name == "mu" else (oracle.degree, oracle.degree)
    return name if low > true[0] * (1 + NEAR) or high < true[1] * (1 - NEAR) else ""


def wrong_condition(oracle: Oracle, name: str, verdict: str, witness: dict[str, Any]) -> str:
    if verdict == "refuted":
        return "refuted" if name == "gain-bound" or (oracle.connected and oracle.imbalance < NEAR) else ""
    mu = witness["mu"]
    inner, outer = float(Fraction(mu["inner"][1])), float(Fraction(mu["outer"][1]))
    if name == "gain-bound":
        return "gain" if inner * oracle.degree >= 1 + NEAR or outer * oracle.degree < 1 - NEAR else ""
    if oracle.growth(inner) > 1 + NEAR or not oracle.connected or oracle.imbalance > NEAR:
        return "inner"
    if "Z" in mu:
        return wrong_dual(oracle, outer, mu["Z"])
    return "outer" if oracle.radius(outer, mu["graph"] - 1) < 1 - NEAR else ""


def wrong_dual(oracle: Oracle, t: float, matrices: list[Any]) -> str:
    total = np.zeros((oracle.agents - 1,) * 2)
    size = max(abs(float(Fraction(x))) for rows in matrices for row in rows for x in row)
    for p, rows in zip(oracle.differences(t), matrices, strict=True):
        z = switched.full([[str(float(Fraction(x))) for x in row] for row in rows]) / size
        if np.linalg.eigvalsh(z)[0] < -NEAR:
            return "Z"
        total += p @ z @ p.T - z
    return "dual" if np.linalg.eigvalsh(total)[0] < -NEAR else ""


def attack(seed: int, count: int, start: int = 0) -> Tally:
    """`count` mutants, judged."""
    tally = Tally()
    for index in range(start, start + count):
        document = mutant(random.Random(f"switched {seed}/{index}"))
        tally.mutants += 1
        try:
            report = check(json.dumps(document).encode())
        except Malformed:
            tally.malformed += 1
            continue
        for outcome in report.outcomes:
            tally.accepted += outcome.status == "accepted"
            tally.refused += outcome.status == "refused"
            if outcome.status == "accepted" and (wrong := contradiction(document, outcome.id, outcome.kind)):
                tally.faults.append(f"switched {seed}/{index}: {outcome.id} accepted, though false: {wrong}")
    return tally
