"""Random digraphs with rational weights, most of them under Assumption 1, and designs on them."""

from __future__ import annotations

import random
from collections import Counter
from fractions import Fraction
from itertools import pairwise
from typing import Any

ALPHAS = ("1/2", "3/5", "9/10", "0.99", "0.999", "0.99999")
SHARES = (
    Fraction(1, 20),
    Fraction(1, 3),
    Fraction(1, 2),
    Fraction(9, 10),
    Fraction(11, 10),
    Fraction(3, 2),
    Fraction(3),
)
"""Of mu D."""

Pairs = Counter[tuple[int, int]]


def random_design(seed: int, agents: int) -> dict[str, Any]:
    """The keys of a design: symmetric, balanced, or with a defect; with x_0 every other time."""
    draw = random.Random(seed)
    kind = ("balanced", "symmetric", "balanced", "symmetric", "unbalanced", "apart")[seed % 6]
    weights = symmetric(draw, agents) if kind == "symmetric" else balanced(draw, agents)
    if kind == "unbalanced":
        weights[draw.choice(sorted(weights))] += Fraction(1, 7)
    if kind == "apart" and agents > 3:
        weights = Counter({ends: w for ends, w in weights.items() if agents not in ends})
    heard: Counter[int] = Counter()
    for (_, target), weight in weights.items():
        heard[target] += weight
    degree = max(heard.values())
    found = {
        "name": f"random {seed}",
        "alpha": draw.choice(ALPHAS),
        "mu": str(draw.choice(SHARES) / degree),
        "graph": {"agents": agents, "edges": [[i, j, str(w)] for (i, j), w in sorted(weights.items())]},
    }
    return found | ({"x0": [draw.randint(-9, 9) for _ in range(agents)]} if seed % 2 else {})


def balanced(draw: random.Random, agents: int) -> Counter[Any]:
    """A ring of all agents and random closed walks, each with a weight of its own: strongly connected and balanced."""
    weights: Counter[Any] = Counter()
    for length in [agents, *(draw.randint(2, agents) for _ in range(draw.randint(0, 4)))]:
        ring = draw.sample(range(1, agents + 1), length)
        weight = Fraction(draw.randint(1, 12), draw.randint(1, 6))
        for ends in pairwise([*ring, ring[0]]):
            weights[ends] += weight
    return weights


def symmetric(draw: random.Random, agents: int) -> Counter[Any]:
    """A random tree and a few more pairs, both ways with the same weight."""
    weights: Counter[Any] = Counter()
    pairs = {(draw.randint(1, i - 1), i) for i in range(2, agents + 1)}
    pairs |= {tuple(sorted(draw.sample(range(1, agents + 1), 2))) for _ in range(draw.randint(0, 2 * agents))}
    for i, j in sorted(pairs):
        weights[i, j] = weights[j, i] = Fraction(draw.randint(1, 12), draw.randint(1, 6))
    return weights
