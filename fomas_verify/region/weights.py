"""Edge weights for the strongest contraction in one step: ``min norm(W - J)`` over weights on the given edges.

Notation: ``W = I - mu L``, w_ij = mu a_ij >= 0 on the edges, ``W 1 = 1``, ``1^T W = 1^T``, W_ii > 0; the weights stand
for mu = 1. A solver proposes; the weights are rounded to decimals with row and column sums exactly right, and what is
said of them is decided exactly. Source: theory, section 12.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from fractions import Fraction

from fomas_verify.design import Design
from fomas_verify.enclosure.interval import Interval
from fomas_verify.exact import matrix as exact
from fomas_verify.network import Digraph, degree_max, digraph, imbalances, laplacian, unreachable_pair
from fomas_verify.region.balanced import balanced_weights
from fomas_verify.region.errors import NoDesignError, UndecidedRegionError
from fomas_verify.region.least_factor import Pair, integer_pairs, least_factor
from fomas_verify.spectrum.loop import Loop, sigma_at
from fomas_verify.spectrum.margins import BITS

PLACES = (6, 9, 12)
"""Decimals of the weights, tried in turn."""

ROOM = Fraction(1, 10**4)
"""What the solver has to leave on W's diagonal, so that W_ii > 0 after rounding; it raises sigma by at most as much."""

LOSS = Fraction(1, 10**4)
"""By how much rounding may raise sigma, and by how much more than equal weights it may be, before it is no answer."""

FARTHEST = 1000
"""Weights and sigma are at most 1; a solver's number beyond this one is nonsense."""

MOST_AGENTS = 40
ATTEMPTS = 2
VECTOR_BITS = 40

Ends = tuple[int, int]


@dataclass(frozen=True)
class WeightProposal:
    """A solver's weights, the sigma it says they have, and its dual: pairs as of the region's, and twice the potentials
    of either sign; approximate, and perhaps nonsense.
    """

    weights: Mapping[Ends, float]
    sigma: float
    pairs: tuple[tuple[list[float], list[float]], ...] = ()
    potentials: tuple[float, ...] = ()


ProposeWeights = Callable[[Digraph, bool, int], WeightProposal | None]


@dataclass(frozen=True)
class BestWeights:
    """What was found.

    Attributes
    ----------
    graph : Digraph
        With the weights, for mu = 1; strongly connected, balanced, ``Delta_max < 1``.
    sigma : Interval
        The norm of W on 1perp; rigorous.
    least : Fraction
        No nonnegative balanced (or symmetric) weights on these edges with W_ii >= 0 have a smaller sigma; exact, 0
        where not shown.
    before : Interval or None
        The least sigma over mu of the graph as it was given, where it is balanced; rigorous.
    dropped : tuple
        The edges whose weight became 0.
    """

    graph: Digraph
    sigma: Interval
    least: Fraction
    before: Interval | None
    dropped: tuple[Ends, ...]


def best_weights(design: Design, *, symmetric: bool = False, propose: ProposeWeights | None = None) -> BestWeights:
    """Choose the weights.

    Parameters
    ----------
    design : Design
        Of which the edges count, not their weights.
    symmetric : bool
        Whether ``w_ij = w_ji`` is asked for; then edges in one direction only get no weight.
    propose : callable, optional
        The solver; clarabel by default.

    Raises
    ------
    NoDesignError
        No weights do: some agent does not reach another over the edges.
    UndecidedRegionError
        The solver gave no usable answer, or the design has too many agents.
    """
    from fomas_verify.region.weights_lmi import weights_by_clarabel

    usable = _usable(design, symmetric)
    if design.graph.agents > MOST_AGENTS:
        raise UndecidedRegionError(f"{design.source}: more than {MOST_AGENTS} agents are beyond --weights: undecided")
    before = _before(design)
    for attempt in range(ATTEMPTS):
        proposal = (propose or weights_by_clarabel)(usable, symmetric, attempt)
        found = None if proposal is None else _rounded(design, usable, symmetric, proposal, before)
        if found is not None:
            return found
    raise UndecidedRegionError(f"{design.source}: the solver proposed no usable weights: undecided")


def _usable(design: Design, symmetric: bool) -> Digraph:
    """The edges that may get a weight, all of weight 1."""
    pairs = {(i, j) for i, j, _ in design.graph.edges}
    kept = [(i, j, Fraction(1)) for i, j in pairs if not symmetric or (j, i) in pairs]
    graph = digraph(design.graph.agents, kept)
    if (missed := unreachable_pair(graph)) is not None:
        way = " over edges in both directions" if symmetric else ""
        words = f"agent {missed[0]} does not reach agent {missed[1]}{way}"
        raise NoDesignError(f"{design.source}: graph: no weights do: {words}")
    return graph


def _before(design: Design) -> Interval | None:
    loop = Loop(design)
    if not loop.assumption1:
        return None
    best = least_factor(loop)
    return Interval.exactly(0) if best is None else Interval(best.lower, best.upper)


def _rounded(
    design: Design, usable: Digraph, symmetric: bool, proposal: WeightProposal, before: Interval | None
) -> BestWeights | None:
    """The proposal in decimals, where it is what it says; None where it is not."""
    numbers = [*proposal.weights.values(), proposal.sigma]
    if not all(abs(x) <= FARTHEST for x in numbers) or set(proposal.weights) != {edge[:2] for edge in usable.edges}:
        return None
    bound = Fraction(proposal.sigma) + LOSS
    if before is not None and not (symmetric and len(usable.edges) < len(design.graph.edges)):
        bound = min(bound, before.upper + ROOM + LOSS)
    for places in PLACES:
        weights = balanced_weights(usable.agents, proposal.weights, places, symmetric=symmetric)
        if weights is None:
            continue
        graph = digraph(usable.agents, ((*ends, w) for ends, w in weights.items()))
        if imbalances(graph) or unreachable_pair(graph) is not None or degree_max(graph) >= 1:
            continue
        sigma = sigma_at(exact.matrix(laplacian(graph)), Fraction(1), BITS)
        if sigma.upper <= bound:
            dropped = tuple(sorted({edge[:2] for edge in design.graph.edges} - set(weights)))
            return BestWeights(graph, sigma, _least(usable, symmetric, proposal), before, dropped)
    return None


def _least(usable: Digraph, symmetric: bool, proposal: WeightProposal) -> Fraction:
    """A lower bound of sigma for all weights (all symmetric ones), by the dual, whatever that is; exact.

    With c_ij = sum u_i (v_i - v_j), any potentials y and ``z_i = max(0, max_j (c_ij - y_i + y_j))``:
    ``n sigma >= sum u.v - sum_ij w_ij c_ij >= sum u.v - sum_i z_i``, since row sums are at most 1 and w is balanced;
    for symmetric w with (c_ij + c_ji)/2 in place of c_ij.
    """
    vectors = [x for pair in proposal.pairs for x in pair]
    if not all(map(math.isfinite, proposal.potentials)) or not all(math.isfinite(x) for v in vectors for x in v):
        return Fraction(0)
    exactly = [([Fraction(x) for x in u], [Fraction(x) for x in v]) for u, v in proposal.pairs]
    pairs = integer_pairs(exactly, VECTOR_BITS)
    if not pairs or len(proposal.potentials) != usable.agents:
        return Fraction(0)
    largest = max(abs(x) for pair in exactly for vector in pair for x in vector)
    scale = (Fraction(1 << VECTOR_BITS) / largest) ** 2
    potentials = [Fraction(x) * scale for x in proposal.potentials]
    shares = Fraction(-1, 2), Fraction(0), Fraction(1, 2)
    bounds = [_bound(usable, symmetric, pairs, [share * y for y in potentials]) for share in shares]
    return max(Fraction(0), *bounds)


def _bound(usable: Digraph, symmetric: bool, pairs: list[Pair], potentials: list[Fraction]) -> Fraction:
    def cost(i: int, j: int) -> Fraction:
        return sum((u[i] * (v[i] - v[j]) for u, v in pairs), Fraction(0))

    z = [Fraction(0)] * usable.agents
    for source, target, _ in usable.edges:
        i, j = target - 1, source - 1
        c = (cost(i, j) + cost(j, i)) / 2 if symmetric else cost(i, j)
        z[i] = max(z[i], c - potentials[i] + potentials[j])
    products = sum((x * y for u, v in pairs for x, y in zip(u, v, strict=True)), Fraction(0))
    n = sum((exact.norm_squared(u) + exact.norm_squared(v) for u, v in pairs), Fraction(0)) / 2
    return (products - sum(z)) / n
