"""The digraph: agents on a circle, an arrow from the agent heard to its hearer; larger ones as a pattern of A."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

from fomas_verify.enclosure.digits import decimal
from fomas_verify.enclosure.interval import Interval
from fomas_verify.network import Digraph
from fomas_verify.report.math_text import math_number
from fomas_verify.report.picture import Agent, Arrow, Box, Picture, Shape, on_circle

MOST_AGENTS_DRAWN = 30
MOST_WEIGHTS_SHOWN = 30
MOST_AGENTS_PATTERN = 200
MOST_EDGES_PATTERN = 4000
_PATTERN_SIZE = Fraction(56, 10)


def draw_graph(graph: Digraph) -> Picture | None:
    """A picture of the graph; None where it would not be one."""
    if graph.agents <= MOST_AGENTS_DRAWN:
        agents = _agents(graph.agents)
        shapes: list[Shape] = [*agents, *_arrows(graph, agents)]
        return Picture("the graph", "fomas graph", tuple(shapes))
    if graph.agents <= MOST_AGENTS_PATTERN and len(graph.edges) <= MOST_EDGES_PATTERN:
        return Picture("the pattern of A", "", tuple(_pattern(graph)))
    return None


def one_weight(graph: Digraph) -> Fraction | None:
    """The weight that every edge has, if there is one."""
    weights = {weight for _, _, weight in graph.edges}
    return weights.pop() if len(weights) == 1 else None


def shows_weights(graph: Digraph) -> bool:
    """Whether the drawing writes each weight at its arrow."""
    return one_weight(graph) is None and graph.agents <= MOST_AGENTS_DRAWN and len(graph.edges) <= MOST_WEIGHTS_SHOWN


def _agents(count: int) -> list[Agent]:
    radius = Fraction(2) if count <= 10 else Fraction(count + 10, 10)
    return [Agent(i + 1, on_circle(Fraction(i, count), radius), count > 16) for i in range(count)]


def _arrows(graph: Digraph, agents: list[Agent]) -> Iterator[Arrow]:
    weights = {(source, target): weight for source, target, weight in graph.edges}
    for (source, target), weight in weights.items():
        back = weights.get((target, source))
        if back == weight and source > target:
            continue
        label = decimal(Interval.exactly(weight), 4) if shows_weights(graph) else ""
        ends = agents[source - 1], agents[target - 1]
        yield Arrow(
            *ends,
            both=back == weight,
            bent=back not in (None, weight),
            label=label,
            label_tex=math_number(label) if label else None,
        )


def _pattern(graph: Digraph) -> Iterator[Box]:
    """A dot in row i, column j where agent i hears agent j; runs along a row are joined."""
    cell, zero = _PATTERN_SIZE / graph.agents, Fraction(0)
    yield Box((zero, zero), (_PATTERN_SIZE, _PATTERN_SIZE), full=False)
    heard = sorted((target, source) for source, target, _ in graph.edges)
    start = 0
    for index, (i, j) in enumerate(heard):
        if index + 1 < len(heard) and heard[index + 1] == (i, j + 1):
            continue
        first = heard[start][1]
        yield Box((cell * (first - 1), _PATTERN_SIZE - cell * i), (cell * j, _PATTERN_SIZE - cell * (i - 1)))
        start = index + 1
