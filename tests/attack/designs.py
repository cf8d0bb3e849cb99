"""Named designs: the published ones, the ties of docs/theory, and neighbours whose verdicts the oracle gives.

`KNOWN` holds verdicts that come from a publication or a hand computation named beside them, never from the tool.
"""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

from .model import Design, Edge, Uncertain

F = Fraction
PAPER_ADJACENCY = ((0, 0, 0, 1, 1), (1, 0, 1, 0, 0), (1, 1, 0, 0, 0), (0, 1, 1, 0, 0), (0, 0, 0, 1, 0))


def directed_cycle(n: int, weight: Fraction = F(1)) -> tuple[Edge, ...]:
    """Agent i hears i-1."""
    return tuple((i, i % n + 1, weight) for i in range(1, n + 1))


def both_ways(pairs: list[tuple[int, int]], weight: Fraction = F(1)) -> tuple[Edge, ...]:
    """Each pair hears each other."""
    return tuple(edge for i, j in pairs for edge in ((i, j, weight), (j, i, weight)))


def cycle(n: int) -> tuple[Edge, ...]:
    """The undirected n-cycle."""
    return both_ways([(i, i % n + 1) for i in range(1, n + 1)])


def path(n: int) -> tuple[Edge, ...]:
    """The undirected path."""
    return both_ways([(i, i + 1) for i in range(1, n)])


def star(n: int) -> tuple[Edge, ...]:
    """Agent 1 in the centre."""
    return both_ways([(1, i) for i in range(2, n + 1)])


def complete(n: int) -> tuple[Edge, ...]:
    """Every pair."""
    return both_ways([(i, j) for i in range(1, n + 1) for j in range(i + 1, n + 1)])


def bipartite(m: int, n: int) -> tuple[Edge, ...]:
    """K_{m,n}."""
    return both_ways([(i, m + j) for i in range(1, m + 1) for j in range(1, n + 1)])


def from_adjacency(rows: tuple[tuple[int, ...], ...]) -> tuple[Edge, ...]:
    """Edges of a 0/1 or integer matrix a_ij: agent i hears agent j."""
    return tuple((j, i, F(a)) for i, row in enumerate(rows, 1) for j, a in enumerate(row, 1) if a)


def circulant(n: int, steps: dict[int, Fraction]) -> tuple[Edge, ...]:
    """Agent i hears i - s with the weight given to step s; balanced."""
    return tuple((i, (i + s - 1) % n + 1, w) for s, w in steps.items() for i in range(1, n + 1))


def gain(alpha: str, n: int, edges: tuple[Edge, ...], gamma: str, h: str) -> Design:
    """A design whose gain is given by gamma and h."""
    return Design(F(alpha), n, edges, gamma=F(gamma), h=F(h))


def at(alpha: str, n: int, edges: tuple[Edge, ...], mu: str) -> Design:
    """A design whose integrated gain is given."""
    return Design(F(alpha), n, edges, mu=F(mu))


PAPER_EDGES = from_adjacency(PAPER_ADJACENCY)
# gamma with beta = 2^alpha - 1 + 1e-45 and - 1e-45 on the paper's graph, by solving for gamma at 90 digits
NEAR_ABOVE = "0.149101909466431182828467768954484656989202996149490111640579"
NEAR_BELOW = "0.149101909466431182828467768954484656989202998375988097561256"

PUBLISHED: dict[str, Design] = {
    "paper": gain("9/10", 5, PAPER_EDGES, "0.15", "0.85"),
    "paper-as-mu": at("9/10", 5, PAPER_EDGES, "0.1347"),
    "paper-repaired": gain("9/10", 5, PAPER_EDGES, "0.1746", "0.85"),
    "paper-below-repaired": gain("9/10", 5, PAPER_EDGES, "0.1745", "0.85"),
    "paper-mu-star": at("9/10", 5, PAPER_EDGES, "2/3"),
    "paper-past-gain-bound": at("9/10", 5, PAPER_EDGES, "3/5"),
    "paper-past-mu-star": at("9/10", 5, PAPER_EDGES, "0.67"),
    "paper-at-gain-bound": at("9/10", 5, PAPER_EDGES, "1/2"),
}

TIES: dict[str, Design] = {
    "k2-swap": at("9/10", 2, path(2), "1"),
    "k2-deadbeat": at("9/10", 2, path(2), "1/2"),
    "k2-root-tie": at("1/2", 2, path(2), "0.29"),
    "directed-cycle-5-tie": at("9/10", 5, directed_cycle(5), "1"),
    "directed-cycle-4-tie": at("3/4", 4, directed_cycle(4), "1"),
    "directed-cycle-6-inside": at("9/10", 6, directed_cycle(6), "99/100"),
    "c4-half": at("9/10", 4, cycle(4), "1/2"),
    "c4-third": at("9/10", 4, cycle(4), "1/3"),
    "c4-below-third": at("9/10", 4, cycle(4), "33333333333333333333333333333/100000000000000000000000000000"),
    "c4-above-third": at("9/10", 4, cycle(4), "33333333333333333333333333334/100000000000000000000000000000"),
    "p4-root-tie": at("1/2", 4, path(4), "1"),
    "p4-root-above": at("1/2", 4, path(4), "999999999999999999999999999999/1000000000000000000000000000000"),
    "p5-half": at("9/10", 5, path(5), "1/2"),
    "k44": at("9/10", 8, bipartite(4, 4), "0.2375"),
    "k33-tie": at("9/10", 6, bipartite(3, 3), "1/3"),
    **{f"k{n}-deadbeat": at("9/10", n, complete(n), f"1/{n}") for n in (3, 4, 5)},
    "k5-negative-beta": at("1/2", 5, complete(5), "0.32"),
    "k5-negative-beta-holds": at("9/10", 5, complete(5), "0.25"),
    "k4-outside": at("9/10", 4, complete(4), "0.6"),
    "k4-tie": at("9/10", 4, complete(4), "1/2"),
    "star5-tie": at("9/10", 5, star(5), "2/5"),
    "star5-contraction-tie": at("9/10", 5, star(5), "1/3"),
    "weighted-triangle-tie": at("9/10", 3, directed_cycle(3, F(7, 3)), "3/7"),
    "near-above": gain("9/10", 5, PAPER_EDGES, NEAR_ABOVE, "0.85"),
    "near-below": gain("9/10", 5, PAPER_EDGES, NEAR_BELOW, "0.85"),
}

BROKEN: dict[str, Design] = {
    "no-edges": at("9/10", 3, (), "1/2"),
    "two-islands": at("9/10", 4, both_ways([(1, 2), (3, 4)]), "1/4"),
    "two-islands-outside": at("9/10", 4, both_ways([(1, 2), (3, 4)]), "3/2"),
    "unbalanced": at("9/10", 3, ((1, 2, F(1)), (2, 3, F(1)), (3, 1, F(1)), (1, 3, F(1))), "1/4"),
    "unbalanced-past": at("9/10", 3, ((1, 2, F(1)), (2, 3, F(1)), (3, 1, F(1)), (1, 3, F(1))), "3"),
    "rooted": at("9/10", 4, ((1, 2, F(1)), (2, 3, F(1)), (3, 4, F(1))), "1/2"),
    "rooted-gamma": gain("1/2", 4, ((1, 2, F(1)), (2, 3, F(2)), (1, 4, F(1, 3))), "0.4", "1.1"),
    "rooted-tie": at("9/10", 3, ((1, 2, F(1)), (2, 3, F(1))), "2"),
    "two-roots": gain("9/10", 3, ((1, 3, F(1)), (2, 3, F(1))), "0.3", "1"),
    "almost-balanced": at("9/10", 3, ((1, 2, F(1)), (2, 3, F(1)), (3, 1, F(10**30 + 1, 10**30))), "1/2"),
    "pair-one-way": at("1/3", 2, ((1, 2, F(1)),), "1/3"),
}

WEIGHTED_CYCLES = ((1, 2, F(3)), (2, 1, F(1)), (2, 3, F(2)), (3, 1, F(2)), (3, 4, F(1, 5)), (4, 3, F(1, 5)))
FURTHER: dict[str, Design] = {
    "alpha-small": gain("0.02", 5, PAPER_EDGES, "0.3", "1"),
    "alpha-small-complete": at("0.02", 4, complete(4), "0.247"),
    "alpha-large": gain("0.995", 5, PAPER_EDGES, "0.01", "1"),
    "alpha-large-directed": at("0.995", 6, directed_cycle(6), "1/2"),
    "alpha-third": gain("1/3", 4, cycle(4), "1/4", "2"),
    "directed-cycle-3": gain("9/10", 3, directed_cycle(3), "0.5", "1"),
    "weighted-circulant": gain("0.8", 5, circulant(5, {1: F(1), 2: F(1, 2)}), "0.4", "0.5"),
    "weighted-circulant-wide": gain("0.7", 4, circulant(4, {1: F(1000), 3: F(1, 1000)}), "0.0006", "1"),
    "weighted-cycles": at("0.9", 4, WEIGHTED_CYCLES, "0.2"),
    "symmetric-wide": gain("0.9", 3, both_ways([(1, 2)], F(1000)) + both_ways([(2, 3)], F(1, 1000)), "0.0004", "1"),
    "p3-gamma": gain("0.6", 3, path(3), "0.5", "0.3"),
    "p4-gamma-repaired": gain("0.95", 4, path(4), "0.4", "0.9"),
    "star6": gain("0.9", 6, star(6), "0.18", "0.9"),
    "star6-past": gain("0.9", 6, star(6), "0.5", "0.9"),
    "k6": gain("0.9", 6, complete(6), "0.1", "0.9"),
    "k3-gamma-negative": gain("0.5", 3, complete(3), "0.5", "0.8"),
    "c6-inside": gain("0.9", 6, cycle(6), "0.3", "1"),
    "c5-golden": at("0.9", 5, cycle(5), "0.4"),
    "c5-golden-tie": at("0.9", 5, cycle(5), "2/5"),
    "c8-close": at("0.9", 8, cycle(8), "0.4999999999999999999999999999999999999999"),
    "bidirected-lollipop": gain("0.85", 5, both_ways([(1, 2), (2, 3), (1, 3), (3, 4), (4, 5)]), "0.25", "1.2"),
    "h-large": gain("0.9", 5, PAPER_EDGES, "0.000001", "100000"),
    "h-small": gain("0.3", 5, PAPER_EDGES, "3", "0.0001"),
    "gamma-fraction": gain("7/9", 5, PAPER_EDGES, "1/7", "13/11"),
    "alpha-tiny": at("0.00000001", 5, PAPER_EDGES, "1/4"),
    "alpha-nearly-one": at("0.99999999", 5, PAPER_EDGES, "1/4"),
    "mu-tiny": Design(F(9, 10), 5, PAPER_EDGES, mu=F(1, 10**40)),
    "mu-huge": Design(F(9, 10), 5, PAPER_EDGES, mu=F(10**40)),
    "h-beyond-floats": Design(F(9, 10), 5, PAPER_EDGES, gamma=F(13, 10**182), h=F(10**200)),
    "directed-cycle-5-just-inside": Design(F(9, 10), 5, directed_cycle(5), mu=1 - F(1, 10**60)),
    "directed-cycle-5-just-outside": Design(F(9, 10), 5, directed_cycle(5), mu=1 + F(1, 10**60)),
    "c8-root-tie": at("1/2", 8, cycle(8), "1"),
    "c5-golden-just-above": Design(F(9, 10), 5, cycle(5), mu=F(2, 5) + F(1, 10**60)),
    "paper-transposed": gain("9/10", 5, tuple((j, i, w) for i, j, w in PAPER_EDGES), "0.15", "0.85"),
}
PAPER_X0 = tuple(map(F, ("4.5", "5", "6", "1.5", "-1")))
STARTED: dict[str, Design] = {
    "paper-trajectory": replace(PUBLISHED["paper"], x0=PAPER_X0, settle_to=F(1, 100)),
    "paper-worst-trajectory": replace(PUBLISHED["paper"], x0=tuple(map(F, (0, -1, -1, -1, 1)))),
    "paper-at-rest": replace(PUBLISHED["paper"], x0=(F(7, 3),) * 5),
    "k2-deadbeat-trajectory": replace(TIES["k2-deadbeat"], x0=(F(1), F(0)), h=F(1, 3), settle_to=F(1, 2)),
    "weighted-cycles-trajectory": replace(FURTHER["weighted-cycles"], x0=tuple(map(F, (1, -2, 5, 0)))),
    "unbalanced-trajectory": replace(BROKEN["unbalanced"], x0=(F(1), F(2), F(4))),
}
NAMED = {**PUBLISHED, **TIES, **BROKEN, **FURTHER, **STARTED}

_ALL = (
    "graph-assumption",
    "gain-bound",
    "memory-inequality",
    "perron-eigenvalues",
    "beta-contraction",
    "repaired-condition",
)

NORM_BOUNDS = ("control-norm-bound", "trajectory-norm-bound")


def _known(letters: str) -> dict[str, str]:
    words = {"p": "proved", "r": "refuted", "i": "inapplicable"}
    verdicts = {claim: words[letter] for claim, letter in zip(_ALL, letters, strict=False)}
    spectral = "inapplicable" if letters[0] == "r" else verdicts["perron-eigenvalues"]
    known = {**verdicts, "control-bounded": spectral, "average-consensus": spectral}
    return {**known, **{claim: words[letter] for claim, letter in zip(NORM_BOUNDS, letters[len(_ALL) :], strict=False)}}


# Letters in the order of _ALL. paper: issue text and docs/theory section 3; the ties: docs/theory, "Ties"; the rest by
# hand: K2 at mu = 1 swaps (P = [[0, 1], [1, 0]]); K_N at mu = 1/N has P = J, so sigma = beta = 0; C4 has eigenvalues
# 0, 2, 2, 4, so mu = 1/2 gives 1, 0, 0, -1 and mu = 1/3 gives sigma = beta = 1/3 < 0.866; K_{4,4} has 0, 4, ..., 4, 8,
# so mu = 0.2375 gives beta = 0.05, sigma = 0.9; P5 at mu = 1/2 has (1 - lambda_5/2) = -0.809, beta = 0.809 = cos 36;
# K5 at alpha = 1/2, mu = 0.32 has sigma = 0.6 = -beta > sqrt(3^0.5 - 2^0.5) = 0.5638. The letters after these are the
# norm bounds: paper, its x_0 and (0, -1, -1, -1, 1) by issue text and docs/theory section 3; symmetric graphs by the
# closed form of section 7 (K2, C4, K_N, K_{4,4}: mu lambda_N <= 2; P4 at mu = 1: mu lambda_4 = 2 + sqrt 2); the 5-cycle
# has z = exp(2 pi i/5) and abs(z + a)^2 = 1 + a^2 + 2 a cos 72 > 1; at rest L x_0 = 0. Missing: not known by hand.
KNOWN: dict[str, dict[str, str]] = {
    "paper": _known("pppprrr"),
    "paper-transposed": _known("pppprrr"),
    "paper-mu-star": _known("prprrr"),
    "paper-at-gain-bound": _known("prpprr"),
    "k2-swap": _known("prrrrrp"),
    "k2-deadbeat": _known("ppppppp"),
    "directed-cycle-5-tie": _known("prprrrr"),
    "c4-half": _known("prprrrp"),
    "c4-third": _known("ppppppp"),
    "c4-below-third": _known("ppppppp"),
    "c4-above-third": _known("pppprpp"),
    "p4-root-tie": _known("prprrrr"),
    "k44": _known("pppprrp"),
    "k3-deadbeat": _known("ppppppp"),
    "k5-negative-beta": _known("prrprrp"),
    "no-edges": _known("rpiriii"),
    "two-islands": _known("rpiriii"),
    "unbalanced": _known("rpipiii"),
    "rooted": _known("rpipiii"),
    "rooted-tie": _known("rririii"),
    "paper-trajectory": _known("pppprrrp"),
    "paper-worst-trajectory": _known("pppprrrr"),
    "paper-at-rest": _known("pppprrrp"),
    "k2-deadbeat-trajectory": _known("pppppppp"),
    "unbalanced-trajectory": _known("rpipiiii"),
}


def family(alpha: tuple[str, str], n: int, edges: tuple[Edge, ...], **ends: tuple[str, str]) -> Uncertain:
    """An uncertain design; a number that is fixed has equal ends."""
    return Uncertain((F(alpha[0]), F(alpha[1])), n, edges, **{key: (F(x), F(y)) for key, (x, y) in ends.items()})


# Gamma(alpha + 1) is least, 0.88560319441088870..., at alpha = 0.46163...: at h = 1 the largest mu is gamma times
# 1.12917388545..., inside the interval of alpha; 0.8856 and 0.8857 lie on both sides of the gain bound mu < 1 of K2.
FAMILIES: dict[str, Uncertain] = {
    "paper-alpha": family(("0.88", "0.92"), 5, PAPER_EDGES, gamma=("0.15", "0.15"), h=("0.85", "0.85")),
    "paper-repaired-box": family(("0.895", "0.905"), 5, PAPER_EDGES, gamma=("0.25", "0.26"), h=("0.85", "0.86")),
    "paper-mu": family(("0.9", "0.9"), 5, PAPER_EDGES, mu=("0.16", "0.39")),
    "paper-mu-wide": family(("0.9", "0.9"), 5, PAPER_EDGES, mu=("0.15", "0.47")),
    "k2-inside": family(("0.88", "0.92"), 2, path(2), mu=("0.3", "0.4")),
    "k2-hump-below": family(("0.3", "0.7"), 2, path(2), gamma=("0.8856", "0.8856"), h=("1", "1")),
    "k2-hump-above": family(("0.3", "0.7"), 2, path(2), gamma=("0.8857", "0.8857"), h=("1", "1")),
    "k2-hump": family(("0.3", "0.7"), 2, path(2), gamma=("0.4", "0.4"), h=("1", "1")),
    "k2-tie": family(("1/2", "0.9"), 2, path(2), mu=("1/2", "1")),
    "c4-wide": family(("0.7", "0.95"), 4, cycle(4), gamma=("0.2", "0.3"), h=("0.9", "1.4")),
    "p3-tiny": family(("0.6", "0.600001"), 3, path(3), gamma=("0.5", "0.500001"), h=("0.3", "0.3")),
    "cycles-h": family(("0.9", "0.9"), 4, WEIGHTED_CYCLES, gamma=("0.2", "0.2"), h=("0.8", "1.25")),
    "unbalanced-box": family(("0.8", "0.9"), 3, BROKEN["unbalanced"].edges, mu=("1/4", "3")),
}
FAMILIES["paper-alpha-trajectory"] = replace(FAMILIES["paper-alpha"], x0=PAPER_X0)
FAMILIES["k2-inside-at-rest"] = replace(FAMILIES["k2-inside"], x0=(F(7, 3),) * 2)

# By hand, letters as in KNOWN: the text for the paper (0.88: (14) fails); docs/theory section 5 for mu in
# [0.16, 0.39] and eqL3 up to 0.46844; K2 is 1 - 2 mu on 1perp: 0.2 to 0.4 < 2^0.88 - 1 = 0.84, and mu = 1 is
# not stable; k2-hump has mu between 0.4/0.90864 and 0.4/0.88560, so 1 - 2 mu lies between 0.0966 and 0.1196, and
# 2^0.3 - 1 = 0.23.
KNOWN_FAMILIES: dict[str, dict[str, str]] = {
    "paper-alpha": _known("pprprrr"),
    "paper-mu": _known("ppppr"),
    "paper-mu-wide": _known("pppprrr"),
    "k2-inside": _known("ppppppp"),
    "k2-hump": _known("ppppppp"),
    "k2-hump-below": {"gain-bound": "proved", "perron-eigenvalues": "proved"},
    "k2-hump-above": {"gain-bound": "refuted", "perron-eigenvalues": "refuted"},
    "k2-tie": _known("prrrrr"),
    "unbalanced-box": _known("rririii"),
    "k2-inside-at-rest": _known("pppppppp"),
}
