"""Random designs in the strata where a verifier is likely to be wrong, the same for the same seed and index.

Strata: mu past 1/D; bipartite balanced digraphs with mu in (0.85, 1)/D; symmetric graphs; alpha below 0.1 and above
0.99; weights over six orders of magnitude; Assumption 1 failing; exact ties.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from fractions import Fraction
from random import Random

from mpmath import mp

from .designs import bipartite, complete, cycle, directed_cycle, path, star
from .model import Design, Edge, degree_max, laplacian, symmetric_part

F = Fraction
Graph = tuple[int, tuple[Edge, ...]]


def _summed(cycles: list[tuple[list[int], Fraction]]) -> tuple[Edge, ...]:
    weights: dict[tuple[int, int], Fraction] = {}
    for agents, weight in cycles:
        for i, j in zip(agents, [*agents[1:], agents[0]], strict=True):
            weights[i, j] = weights.get((i, j), F(0)) + weight
    return tuple((i, j, w) for (i, j), w in sorted(weights.items()))


def _weight(random: Random, wide: bool = False) -> Fraction:
    if wide:
        return F(random.randint(1, 99), 10) * F(10) ** random.randint(-3, 2)
    return random.choice((F(1), F(1), F(random.randint(1, 9), random.randint(1, 9))))


def balanced(random: Random, wide: bool = False) -> Graph:
    """Directed cycles laid over each other, the first through every agent: strongly connected and balanced."""
    n = random.randint(2, 8)
    everyone = random.sample(range(1, n + 1), n)
    cycles = [(everyone, _weight(random, wide))]
    for _ in range(random.randint(0, n)):
        cycles.append((random.sample(range(1, n + 1), random.randint(2, n)), _weight(random, wide)))
    return n, _summed(cycles)


def bipartite_digraph(random: Random) -> Graph:
    """Directed cycles that alternate between two sides of equal size."""
    half = random.randint(1, 4)

    def alternating(size: int) -> list[int]:
        left = random.sample(range(1, half + 1), size)
        right = random.sample(range(half + 1, 2 * half + 1), size)
        return [agent for pair in zip(left, right, strict=True) for agent in pair]

    cycles = [(alternating(half), _weight(random))]
    for _ in range(random.randint(0, half)):
        cycles.append((alternating(random.randint(1, half)), _weight(random)))
    return 2 * half, _summed(cycles)


def symmetric(random: Random) -> Graph:
    """A weighted undirected graph that holds a random tree."""
    n = random.randint(2, 8)
    pairs = {(random.randint(1, j - 1), j) for j in range(2, n + 1)}
    for _ in range(random.randint(0, n)):
        i, j = sorted(random.sample(range(1, n + 1), 2))
        pairs.add((i, j))
    return n, _summed([([i, j], _weight(random)) for i, j in sorted(pairs)])


def broken(random: Random) -> Graph:
    """A graph that nearly always violates Assumption 1: an edge away or reweighted, two parts, edges at random."""
    n, edges = balanced(random)
    kind = random.choice(("drop", "reweigh", "parts", "random", "tree"))
    k = random.randrange(len(edges))
    if kind == "drop":
        return n, edges[:k] + edges[k + 1 :]
    if kind == "reweigh":
        i, j, w = edges[k]
        return n, (*edges[:k], (i, j, w + F(1, 10 ** random.randint(0, 40))), *edges[k + 1 :])
    if kind == "parts":
        return n + 2, (*edges, (n + 1, n + 2, F(1)), (n + 2, n + 1, F(1)))
    if kind == "tree":
        return n, tuple((random.randint(1, j - 1), j, _weight(random)) for j in range(2, n + 1))
    pairs = {tuple(random.sample(range(1, n + 1), 2)) for _ in range(random.randint(1, 2 * n))}
    return n, tuple((i, j, _weight(random)) for i, j in sorted(pairs))


def _alpha(random: Random, low: str = "0.01", high: str = "0.99") -> Fraction:
    return F(random.randint(int(F(low) * 10**4) + 1, int(F(high) * 10**4) - 1), 10**4)


def _with_gain(random: Random, graph: Graph, alpha: Fraction, low: float, high: float) -> Design:
    """mu, or gamma at a random h, drawn so that mu D lies about in (low, high)."""
    design = Design(alpha, *graph)
    aim = F(round(random.uniform(low, high) * 10**6), 10**6) / (degree_max(design) or 1)
    if random.random() < 0.5:
        return replace(design, mu=aim.limit_denominator(10 ** random.randint(2, 12)) or aim)
    h = F(random.randint(1, 400), 100)
    gain = float(aim) / float(h) ** float(alpha) * 0.95
    return replace(design, gamma=F(f"{gain:.6e}"), h=h)


def _tied(random: Random) -> Design:
    n = random.randint(2, 6)
    weight = _weight(random)
    alpha = random.choice((F(1, 2), F(9, 10), F(1, 3)))
    # eigenvalues of L, so: the gains at which P has one of modulus 1, sigma meets beta, beta vanishes, mu D = 1
    graphs: list[tuple[Graph, list[Fraction]]] = [
        ((n, complete(n)), [F(2, n), F(1, n), F(1, n - 1), F(3, 2 * n)]),
        ((4, cycle(4)), [F(1, 2), F(1, 3), F(1, 4)]),
        ((6, cycle(6)), [F(1, 2), F(2, 5), F(1, 4)]),
        ((3, path(3)), [F(2, 3), F(1, 2), F(1)]),
        ((n + 1, star(n + 1)), [F(2, n + 1), F(2, n + 2), F(1, n)]),
        ((2 * n, bipartite(n, n)), [F(1, n), F(2, 3 * n), F(1, 2 * n)]),
        ((n + 1, directed_cycle(n + 1)), [F(1), F(1, 2)]),
        ((4, path(4)), [F(1), F(1, 2)]),
        ((5, cycle(5)), [F(2, 5), F(1, 2)]),
    ]
    (agents, edges), gains = random.choice(graphs)
    nudge = random.choice((F(0), F(0), F(0), F(1, 10**20), F(-1, 10**20), F(1, 10**50), F(-1, 10**50)))
    scaled = tuple((i, j, w * weight) for i, j, w in edges)
    return Design(alpha, agents, scaled, mu=(random.choice(gains) + nudge) / weight)


def _started(random: Random, design: Design) -> Design:
    """The design with an x_0 in four cases of six, and a level to settle to in as many."""
    n, kind = design.agents, random.choice(("none", "none", "few digits", "few digits", "slowest", "near"))
    settle_to = random.choice((None, None, F(1, 2), F(1, 100), F(random.randint(1, 99), 100), F(1, 10**6)))
    design = replace(design, settle_to=settle_to)
    if kind == "none":
        return design
    few = [F(random.randint(-99, 99), 10) for _ in range(n)]
    if kind == "few digits":
        few = few if random.random() < 0.9 else [few[0]] * n
        return replace(design, x0=tuple(few) if random.random() < 0.6 else _vectors(random, few))
    return replace(design, x0=_along_an_eigenvector(design, random.choice((2, 4)) if kind == "slowest" else 15))


def _vectors(random: Random, first: list[Fraction]) -> tuple[tuple[Fraction, ...], ...]:
    """x_0 of agents with several states, of which some may agree from the start."""
    n, states = len(first), random.randint(0, 2)
    columns = [first, *([F(random.randint(-9, 9), 2) for _ in range(n)] for _ in range(states))]
    if random.random() < 0.3:
        columns.append([F(5, 3)] * n)
    return tuple(zip(*columns, strict=True))


def _along_an_eigenvector(design: Design, decimals: int) -> tuple[Fraction, ...]:
    """An eigenvector of L_s for lambda2, rounded: there a norm of u exceeds the first one soonest."""
    with mp.workdps(40):
        form = symmetric_part(laplacian(design))
        values, vectors = mp.eigsy(mp.matrix([[mp.mpf(x.numerator) / x.denominator for x in row] for row in form]))
        order = sorted(range(design.agents), key=lambda k: values[k])
        return tuple(F(int(mp.nint(vectors[i, order[1]] * 10**decimals)), 10**decimals) for i in range(design.agents))


STRATA: dict[str, Callable[[Random], Design]] = {
    "past": lambda random: _with_gain(random, balanced(random), _alpha(random), 1.0, 3.0),
    "bipartite": lambda random: _with_gain(random, bipartite_digraph(random), _alpha(random), 0.85, 1.0),
    "symmetric": lambda random: _with_gain(random, symmetric(random), _alpha(random), 0.05, 1.5),
    "small alpha": lambda random: _with_gain(random, balanced(random), _alpha(random, "0.0001", "0.1"), 0.2, 1.2),
    "large alpha": lambda random: _with_gain(random, balanced(random), _alpha(random, "0.99", "0.9999"), 0.01, 1.0),
    "wide weights": lambda random: _with_gain(random, balanced(random, wide=True), _alpha(random), 0.05, 1.3),
    "broken": lambda random: _with_gain(random, broken(random), _alpha(random), 0.1, 2.5),
    "ties": _tied,
}


def design_at(seed: int, index: int) -> tuple[str, Design]:
    """The design with this index under this seed, and its name; the strata take turns."""
    stratum = list(STRATA)[index % len(STRATA)]
    random = Random(f"{seed}/{index}")
    return f"{stratum} {seed}/{index}", _started(random, STRATA[stratum](random))


def designs(seed: int, count: int, start: int = 0) -> Iterator[tuple[str, Design]]:
    """`count` random designs from index `start`."""
    return (design_at(seed, index) for index in range(start, start + count))
