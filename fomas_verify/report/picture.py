"""Line drawings without a format: graph, pattern of A, spectrum. `tikz` and `svg` write the same shapes.

Coordinates are centimetres, x to the right, y upwards, rounded to thousandths, so that a drawing is the same on every
machine.
"""

from __future__ import annotations

import html
import math
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction

from fomas_verify.report.latex_text import Tex

Point = tuple[Fraction, Fraction]
PLACES = 3
PIXELS = 40
"""SVG units of a centimetre."""

_DASHES = {"gershgorin": "6 3", "sigma circle": "1.5 3", "beta line": "7 3 1.5 3"}
_WIDTHS = {"unit circle": 1.8, "sigma circle": 1.8, "axis": 0.7}
_BEND = 0.125
"""How far the middle of a bent arrow lies aside, as a share of its length: TikZ's ``bend left=14``."""


@dataclass(frozen=True)
class Agent:
    """A numbered disc."""

    number: int
    at: Point
    small: bool


@dataclass(frozen=True)
class Arrow:
    """From one agent to another, at both ends where ``both``, aside where ``bent``; ``label`` is its weight."""

    source: Agent
    target: Agent
    both: bool = False
    bent: bool = False
    label: str = ""
    label_tex: Tex | None = None


@dataclass(frozen=True)
class Segment:
    """A straight line in one of the styles of the preamble."""

    style: str
    start: Point
    end: Point


@dataclass(frozen=True)
class Ring:
    """A circle in one of these styles."""

    style: str
    centre: Point
    radius: Fraction


@dataclass(frozen=True)
class Dot:
    """A small disc, hollow or full."""

    at: Point
    hollow: bool = False


@dataclass(frozen=True)
class Box:
    """A rectangle, full or only its frame."""

    low: Point
    high: Point
    full: bool = True


Shape = Agent | Arrow | Segment | Ring | Dot | Box


@dataclass(frozen=True)
class Picture:
    """Shapes in drawing order; ``style`` is the TikZ style of all; ``title`` says in words what is drawn."""

    title: str
    style: str
    shapes: tuple[Shape, ...]

    def tikz(self) -> Tex:
        """The drawing as LaTeX."""
        lines = [_TIKZ[type(shape)](shape) for shape in self.shapes]
        return Tex(f"\\begin{{tikzpicture}}[{self.style}]\n" + "\n".join(lines) + "\n\\end{tikzpicture}")

    def svg(self, key: str) -> str:
        """The drawing as an SVG element that scales with its surroundings; ``key`` tells its names from others'."""
        corners = [corner for shape in self.shapes for corner in _extent(shape)]
        xs, ys = [x for x, _ in corners], [y for _, y in corners]
        left, top, pad = min(xs), -max(ys), Fraction(1, 5)
        width, height = max(xs) - left + 2 * pad, -min(ys) - top + 2 * pad
        box = " ".join(number(x * PIXELS) for x in (left - pad, top - pad, width, height))
        shapes = "".join(_SVG[type(shape)](shape) for shape in self.shapes)
        drawn = (_HEADS + shapes).replace("head-", f"head-{key}")
        size = f'style="width:{number(width * PIXELS)}px"'
        return f'<svg viewBox="{box}" {size} role="img" aria-label="{html.escape(self.title)}">{drawn}</svg>'


_HEADS = (
    '<defs><marker id="head-" viewBox="0 0 10 10" refX="9" refY="5" markerWidth="7" markerHeight="7" '
    'orient="auto-start-reverse"><path d="M0 1 10 5 0 9z"/></marker></defs>'
)


def fixed(x: Fraction, places: int) -> str:
    """x rounded to so many decimals, without an exponent."""
    scaled = round(x * 10**places)
    whole, rest = divmod(abs(scaled), 10**places)
    return f"{'-' if scaled < 0 else ''}{whole}.{rest:0{places}d}"


def number(x: Fraction | float) -> str:
    """A coordinate of an SVG: two decimals at most."""
    text = f"{float(x):.2f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def on_circle(turn: Fraction, radius: Fraction) -> Point:
    """The point at so many turns from the top, clockwise; rounded, approximate."""
    angle = 2 * math.pi * float(turn)
    return Fraction(round(float(radius) * math.sin(angle), PLACES)), Fraction(
        round(float(radius) * math.cos(angle), PLACES)
    )


def _at(point: Point) -> str:
    return f"({fixed(point[0], PLACES)},{fixed(point[1], PLACES)})"


def _tikz_agent(shape: Agent) -> str:
    style = "small agent" if shape.small else "agent"
    return rf"\node[{style}] ({shape.number}) at {_at(shape.at)} {{{shape.number}}};"


def _tikz_arrow(shape: Arrow) -> str:
    style, bend = "hears both" if shape.both else "hears", "[bend left=14]" if shape.bent else ""
    label = rf" node[weight] {{${shape.label_tex}$}}" if shape.label_tex else ""
    return rf"\draw[{style}] ({shape.source.number}) to{bend}{label} ({shape.target.number});"


def _tikz_segment(shape: Segment) -> str:
    return rf"\draw[{shape.style}] {_at(shape.start)} -- {_at(shape.end)};"


def _tikz_ring(shape: Ring) -> str:
    return rf"\draw[{shape.style}] {_at(shape.centre)} circle[radius={fixed(shape.radius, PLACES)}];"


def _tikz_dot(shape: Dot) -> str:
    command, size = (r"\draw[fill=white]", "1.7pt") if shape.hollow else (r"\fill", "1.5pt")
    return rf"{command} {_at(shape.at)} circle[radius={size}];"


def _tikz_box(shape: Box) -> str:
    return rf"{chr(92)}{'fill' if shape.full else 'draw[gray]'} {_at(shape.low)} rectangle {_at(shape.high)};"


_TIKZ: dict[type, Callable[..., str]] = {
    Agent: _tikz_agent,
    Arrow: _tikz_arrow,
    Segment: _tikz_segment,
    Ring: _tikz_ring,
    Dot: _tikz_dot,
    Box: _tikz_box,
}


def _xy(point: Point) -> tuple[str, str]:
    return number(point[0] * PIXELS), number(-point[1] * PIXELS)


def _radius(agent: Agent) -> float:
    return 0.18 if agent.small else 0.275


def _svg_agent(shape: Agent) -> str:
    x, y = _xy(shape.at)
    size = 8 if shape.small else 13
    return (
        f'<circle cx="{x}" cy="{y}" r="{number(_radius(shape) * PIXELS)}" class="hollow"/>'
        f'<text x="{x}" y="{y}" dy="0.36em" font-size="{size}" text-anchor="middle">{shape.number}</text>'
    )


def _svg_arrow(shape: Arrow) -> str:
    (x1, y1), (x2, y2) = ((float(x), float(y)) for x, y in (shape.source.at, shape.target.at))
    length = math.hypot(x2 - x1, y2 - y1)
    ux, uy = (x2 - x1) / length, (y2 - y1) / length
    aside = 2 * _BEND * length if shape.bent else 0.0
    control = (x1 + x2) / 2 - uy * aside, (y1 + y2) / 2 + ux * aside
    ends = []
    for (x, y), agent in (((x1, y1), shape.source), ((x2, y2), shape.target)):
        away = math.hypot(control[0] - x, control[1] - y)
        ends.append((x + (control[0] - x) * _radius(agent) / away, y + (control[1] - y) * _radius(agent) / away))
    (a, b), (c, d), (e, f) = (_xy((Fraction(x), Fraction(y))) for x, y in (ends[0], control, ends[1]))
    start = ' marker-start="url(#head-)"' if shape.both else ""
    line = f'<path d="M{a} {b}Q{c} {d} {e} {f}" class="line"{start} marker-end="url(#head-)"/>'
    if not shape.label:
        return line
    t = 0.36
    at = tuple(
        Fraction((1 - t) ** 2 * p + 2 * t * (1 - t) * q + t * t * r)
        for p, q, r in zip(ends[0], control, ends[1], strict=True)
    )
    left, top = _xy((at[0], at[1]))
    return f'{line}<text x="{left}" y="{top}" dy="0.36em" class="weight">{html.escape(shape.label)}</text>'


def _svg_segment(shape: Segment) -> str:
    (a, b), (c, d) = _xy(shape.start), _xy(shape.end)
    return f'<path d="M{a} {b}L{c} {d}" class="line"{_look(shape.style)}/>'


def _svg_ring(shape: Ring) -> str:
    x, y = _xy(shape.centre)
    return f'<circle cx="{x}" cy="{y}" r="{number(shape.radius * PIXELS)}" class="line"{_look(shape.style)}/>'


def _svg_dot(shape: Dot) -> str:
    x, y = _xy(shape.at)
    return f'<circle cx="{x}" cy="{y}" r="2.6"{" class=" + chr(34) + "hollow" + chr(34) if shape.hollow else ""}/>'


def _svg_box(shape: Box) -> str:
    (x, low), (right, y) = _xy(shape.low), _xy(shape.high)
    size = f'width="{number(float(right) - float(x))}" height="{number(float(low) - float(y))}"'
    return f'<rect x="{x}" y="{y}" {size}{"" if shape.full else " class=" + chr(34) + "line" + chr(34)}/>'


def _look(style: str) -> str:
    dash = f' stroke-dasharray="{_DASHES[style]}"' if style in _DASHES else ""
    return f'{dash} style="stroke-width:{_WIDTHS.get(style, 1.2)}"' + (' opacity="0.4"' if style == "axis" else "")


_SVG: dict[type, Callable[..., str]] = {
    Agent: _svg_agent,
    Arrow: _svg_arrow,
    Segment: _svg_segment,
    Ring: _svg_ring,
    Dot: _svg_dot,
    Box: _svg_box,
}


def _extent(shape: Shape) -> list[Point]:
    match shape:
        case Agent():
            return [(shape.at[0] + d, shape.at[1] + d) for d in (Fraction(-3, 10), Fraction(3, 10))]
        case Ring():
            return [(shape.centre[0] + d, shape.centre[1] + d) for d in (-shape.radius, shape.radius)]
        case Box():
            return [shape.low, shape.high]
        case Segment():
            return [shape.start, shape.end]
        case Dot():
            return [shape.at]
    return []
