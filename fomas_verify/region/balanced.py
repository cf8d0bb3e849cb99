"""From nearly balanced weights to decimals whose row and column sums are exactly equal.

The balanced weights are the circulations of the digraph. The edges off a spanning tree are coordinates of that space:
they are rounded, and the tree's weights follow from the balance, agent by agent from the leaves inwards.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction

Ends = tuple[int, int]


def balanced_weights(
    agents: int, weights: Mapping[Ends, float], places: int, *, symmetric: bool
) -> dict[Ends, Fraction] | None:
    """Round finite weights to so many decimals, exactly balanced; those that round to 0 are left out. Exact.

    Returns None where the edges that remain do not join all agents, or one of the tree's weights would not be positive.
    """
    scale = 10**places
    rounded = {ends: Fraction(round(x * scale), scale) for ends, x in weights.items()}
    if symmetric:
        rounded = {(i, j): rounded[min(i, j), max(i, j)] for i, j in rounded}
        return {ends: w for ends, w in rounded.items() if w > 0}
    kept = {ends: w for ends, w in rounded.items() if w > 0}
    tree = _spanning_tree(agents, kept)
    if tree is None:
        return None
    found = {ends: w for ends, w in kept.items() if ends not in tree}
    surplus = [Fraction(0)] * (agents + 1)  # what an agent hears, less that with which it is heard
    for (source, target), w in found.items():
        surplus[target] += w
        surplus[source] -= w
    left = set(tree)
    while left:
        leaf, ends = next((i, touching[0]) for i in range(1, agents + 1) if len(touching := _at(i, left)) == 1)
        source, target = ends
        w = surplus[leaf] if source == leaf else -surplus[leaf]
        if w <= 0:
            return None
        found[ends] = w
        surplus[target] += w
        surplus[source] -= w
        left.remove(ends)
    return found


def _at(agent: int, edges: set[Ends]) -> list[Ends]:
    return [ends for ends in edges if agent in ends]


def _spanning_tree(agents: int, weights: Mapping[Ends, Fraction]) -> set[Ends] | None:
    """A spanning tree, directions aside, of the largest weights, so that what rounding moves there is little."""
    group = list(range(agents + 1))
    tree = set()
    for source, target in sorted(weights, key=lambda ends: (-weights[ends], ends)):
        one, other = group[source], group[target]
        if one != other:
            tree.add((source, target))
            group = [one if x == other else x for x in group]
    return tree if len(tree) == agents - 1 else None
