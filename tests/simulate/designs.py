"""Designs to simulate, as mappings: the paper's, and random ones."""

import random
from fractions import Fraction
from typing import Any

PAPER: dict[str, Any] = {
    "alpha": "9/10",
    "gamma": "15/100",
    "h": "85/100",
    "x0": ["4.5", 5, 6, "1.5", -1],
    "graph": {
        "agents": 5,
        "edges": [[4, 1, 1], [5, 1, 1], [1, 2, 1], [3, 2, 1], [1, 3, 1], [2, 3, 1], [2, 4, 1], [3, 4, 1], [4, 5, 1]],
    },
}


def random_design(seed: int) -> dict[str, Any]:
    """A weighted balanced digraph of 2 to 6 agents, gain up to 0.95 of the gain bound."""
    source = random.Random(seed)
    agents = source.randrange(2, 7)
    weights: dict[tuple[int, int], Fraction] = {}
    for _ in range(2):
        order, weight = source.sample(range(1, agents + 1), agents), Fraction(source.randrange(1, 20), 10)
        for edge in zip(order, order[1:] + order[:1], strict=True):
            weights[edge] = weights.get(edge, Fraction(0)) + weight
    degree = max(sum(w for (_, to), w in weights.items() if to == i) for i in range(1, agents + 1))
    h = Fraction(source.randrange(20, 180), 100)
    gain = Fraction(source.randrange(20, 95), 100) / degree
    return {
        "alpha": Fraction(source.randrange(15, 98), 100),
        "gamma": Fraction(round(float(gain) / max(1.0, float(h)) * 10**6), 10**6),
        "h": h,
        "x0": [Fraction(source.randrange(-900, 900), 100) for _ in range(agents)],
        "graph": {"agents": agents, "edges": [[*edge, weight] for edge, weight in sorted(weights.items())]},
    }
