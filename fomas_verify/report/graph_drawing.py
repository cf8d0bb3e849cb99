"""The digraph as TikZ: agents on a circle, an arrow from the agent heard to its hearer; larger ones as a pattern of A.

Coordinates are angles and rational numbers only, so the drawing is the same on every machine.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

from fomas_verify.enclosure.digits import decimal
from fomas_verify.enclosure.interval import Interval
from fomas_verify.network import Digraph
from fomas_verify.report.latex_text import Tex
from fomas_verify.report.math_text import math_number

MOST_AGENTS_DRAWN = 30
MOST_WEIGHTS_SHOWN = 30
MOST_AGENTS_PATTERN = 200
MOST_EDGES_PATTERN = 4000
_PATTERN_SIZE = Fraction(56, 10)


def draw_graph(graph: Digraph) -> Tex | None:
    """A picture of the graph; None where it would not be one."""
    if graph.agents <= MOST_AGENTS_DRAWN:
        lines = [*_nodes(graph.agents), *_arrows(graph)]
        return Tex("\\begin{tikzpicture}[fomas graph]\n" + "\n".join(lines) + "\n\\end{tikzpicture}")
    if graph.agents <= MOST_AGENTS_PATTERN and len(graph.edges) <= MOST_EDGES_PATTERN:
        return Tex("\\begin{tikzpicture}\n" + "\n".join(_pattern(graph)) + "\n\\end{tikzpicture}")
    return None


def one_weight(graph: Digraph) -> Fraction | None:
    """The weight that every edge has, if there is one."""
    weights = {weight for _, _, weight in graph.edges}
    return weights.pop() if len(weights) == 1 else None


def shows_weights(graph: Digraph) -> bool:
    """Whether the drawing writes each weight at its arrow."""
    return one_weight(graph) is None and graph.agents <= MOST_AGENTS_DRAWN and len(graph.edges) <= MOST_WEIGHTS_SHOWN


def _nodes(agents: int) -> Iterator[str]:
    radius = fixed(Fraction(2) if agents <= 10 else Fraction(agents + 10, 10), 2)
    style = "agent" if agents <= 16 else "small agent"
    for i in range(agents):
        angle = fixed(90 - Fraction(360 * i, agents), 3)
        yield rf"\node[{style}] ({i + 1}) at ({angle}:{radius}) {{{i + 1}}};"


def _arrows(graph: Digraph) -> Iterator[str]:
    weights = {(source, target): weight for source, target, weight in graph.edges}
    for (source, target), weight in weights.items():
        back = weights.get((target, source))
        label = _label(weight) if shows_weights(graph) else ""
        if back is None:
            yield rf"\draw[hears] ({source}) to{label} ({target});"
        elif back != weight:
            yield rf"\draw[hears] ({source}) to[bend left=14]{label} ({target});"
        elif source < target:
            yield rf"\draw[hears both] ({source}) to{label} ({target});"


def _label(weight: Fraction) -> str:
    return rf" node[weight] {{${math_number(decimal(Interval.exactly(weight), 4))}$}}"


def _pattern(graph: Digraph) -> Iterator[str]:
    """A dot in row i, column j where agent i hears agent j; runs along a row are joined."""
    cell = _PATTERN_SIZE / graph.agents
    size = fixed(_PATTERN_SIZE, 3)
    yield rf"\draw[gray] (0,0) rectangle ({size},{size});"
    heard = sorted((target, source) for source, target, _ in graph.edges)
    start = 0
    for index, (i, j) in enumerate(heard):
        if index + 1 < len(heard) and heard[index + 1] == (i, j + 1):
            continue
        first = heard[start][1]
        left, bottom = fixed(cell * (first - 1), 3), fixed(_PATTERN_SIZE - cell * i, 3)
        right, top = fixed(cell * j, 3), fixed(_PATTERN_SIZE - cell * (i - 1), 3)
        yield rf"\fill ({left},{bottom}) rectangle ({right},{top});"
        start = index + 1


def fixed(x: Fraction, places: int) -> str:
    """x rounded to so many decimals, without an exponent."""
    scaled = round(x * 10**places)
    whole, rest = divmod(abs(scaled), 10**places)
    return f"{'-' if scaled < 0 else ''}{whole}.{rest:0{places}d}"
