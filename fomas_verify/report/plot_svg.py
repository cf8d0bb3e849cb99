"""A diagram as SVG: axes with ticks, curves, bands; and the samples of its legend. Approximate."""

from __future__ import annotations

import html
import math
from collections.abc import Callable, Iterable, Iterator
from fractions import Fraction

from fomas_verify.enclosure.digits import rounded_down
from fomas_verify.report.picture import number
from fomas_verify.report.plot import Curve, Plot

COLORS = ("#005a6e", "#aa3200", "#5b2a86", "#7a6a00", "#1b1b1b", "#0a7a3c")
BANDS = ("#e3e3e3", "#b9cfe4", "#f2cf8d", "#8fc79a", "#2f7f57")
DASHES = ("", "6 3", "2 2", "7 3 2 3", "7 3 2 3 2 3", "9 5")
_LEFT, _RIGHT, _TOP, _BOTTOM, _WIDTH, _HEIGHT = 58, 12, 8, 40, 420, 260
_TICKS = 6
_DOUBLES = 300

Scale = Callable[[Fraction], float]
"""From a number to its place on the page."""


def svg_plot(plot: Plot, key: str) -> str:
    """The diagram as an SVG element that scales with its surroundings, without its legend; ``key`` is its name."""
    x, y = (
        _scale(plot.x_range, plot.x_log, _LEFT, _WIDTH - _RIGHT),
        _scale(plot.y_range, plot.y_log, _HEIGHT - _BOTTOM, _TOP),
    )
    parts = [*_axes(plot, x, y), f'<g clip-path="url(#inside-{key})">', *_drawn(plot, x, y), "</g>"]
    return (
        f'<svg viewBox="0 0 {_WIDTH} {_HEIGHT}" role="img" aria-label="{key}">'
        f'<defs><clipPath id="inside-{key}"><rect x="{_LEFT}" y="{_TOP}" width="{_WIDTH - _LEFT - _RIGHT}" '
        f'height="{_HEIGHT - _TOP - _BOTTOM}"/></clipPath></defs>{"".join(parts)}</svg>'
    )


def legend_sample(curve: Curve) -> str:
    """A short piece of a curve, for its legend."""
    mark = _marks(curve, [(12.0, 6.0)])
    return f'<svg viewBox="0 0 24 12" class="sample" aria-hidden="true"><path d="M0 6H24"{_stroke(curve)}/>{mark}</svg>'


def band_sample(shade: int) -> str:
    """A patch in a band's colour."""
    return (
        '<svg viewBox="0 0 24 12" class="sample" aria-hidden="true">'
        f'<rect width="24" height="12" fill="{BANDS[shade]}" stroke="#666"/></svg>'
    )


def _scale(ends: tuple[Fraction, Fraction], log: bool, low: int, high: int) -> Scale:
    def place(value: Fraction) -> float:
        first, z, last = (_log10(x) if log else x for x in (ends[0], value, ends[1]))
        return low + float((z - first) / (last - first)) * (high - low)

    return place


def _log10(x: Fraction) -> float:
    return math.log10(x.numerator) - math.log10(x.denominator)


def _axes(plot: Plot, x: Scale, y: Scale) -> Iterator[str]:
    bottom, right = _HEIGHT - _BOTTOM, _WIDTH - _RIGHT
    for value, text in _ticks(plot.x_range, log=plot.x_log):
        at = number(x(value))
        yield f'<path d="M{at} {_TOP}V{bottom}" class="grid"/>'
        yield f'<text x="{at}" y="{bottom + 15}" text-anchor="middle">{text}</text>'
    for value, text in _ticks(plot.y_range, log=plot.y_log):
        at = number(y(value))
        yield f'<path d="M{_LEFT} {at}H{right}" class="grid"/>'
        yield f'<text x="{_LEFT - 5}" y="{at}" dy="0.35em" text-anchor="end">{text}</text>'
    yield f'<rect x="{_LEFT}" y="{_TOP}" width="{right - _LEFT}" height="{bottom - _TOP}" class="line"/>'
    middle, centre = (_LEFT + right) // 2, (_TOP + bottom) // 2
    yield f'<text x="{middle}" y="{_HEIGHT - 6}" text-anchor="middle">{html.escape(plot.x_label)}</text>'
    if plot.y_label:
        turned = f'transform="translate(12 {centre})rotate(-90)"'
        yield f'<text {turned} text-anchor="middle">{html.escape(plot.y_label)}</text>'


def _ticks(ends: tuple[Fraction, Fraction], *, log: bool) -> Iterator[tuple[Fraction, str]]:
    low, high = ends
    if log:
        first, last = math.ceil(_log10(low) - 1e-9), math.floor(_log10(high) + 1e-9)
        step = max(1, -(-(last - first) // _TICKS))
        for power in range(first, last + 1, step):
            yield Fraction(10) ** power, _power(power)
        return
    size = Fraction(10) ** math.floor(_log10((high - low) / _TICKS))
    width = next(size * m for m in (1, 2, 5, 10) if (high - low) / (size * m) <= _TICKS)
    for i in range(math.ceil(low / width), math.floor(high / width) + 1):
        yield i * width, _decimal(i * width).replace("-", "\N{MINUS SIGN}")


def _decimal(x: Fraction) -> str:
    """A tick's number, which no double need hold."""
    return rounded_down(x, 6) if x and abs(_log10(abs(x))) > _DOUBLES else f"{float(x):.6g}"


def _power(power: int) -> str:
    if -2 <= power <= 3:
        return f"{10.0**power:g}"
    sign = "\N{MINUS SIGN}" if power < 0 else ""
    return f'10<tspan dy="-0.45em" font-size="8">{sign}{abs(power)}</tspan>'


def _drawn(plot: Plot, x: Scale, y: Scale) -> Iterator[str]:
    for band in plot.bands:
        (x1, x2), (l1, l2), (u1, u2) = plot.x_range, band.lower, band.upper
        corners = [(x1, l1), (x2, l2), (x2, u2), (x1, u1)]
        points = " ".join(f"{number(x(a))},{number(y(b))}" for a, b in corners)
        yield f'<polygon points="{points}" fill="{BANDS[band.shade]}" stroke="#666" stroke-width="0.4"/>'
    for level in plot.levels:
        yield f'<path d="M{_LEFT} {number(y(level))}H{_WIDTH - _RIGHT}" class="line" stroke-dasharray="5 3"/>'
    for curve in plot.curves:
        if plot.table is not None:
            pairs = zip(plot.table.columns[plot.x], plot.table.columns[curve.column], strict=True)
            yield from _curve(curve, _pieces(plot, pairs, x, y))
    if plot.marked is not None:
        yield f'<circle cx="{number(x(plot.marked[0]))}" cy="{number(y(plot.marked[1]))}" r="4"/>'


def _pieces(
    plot: Plot,
    pairs: Iterable[tuple[Fraction | None, Fraction | None]],
    x: Scale,
    y: Scale,
) -> list[list[tuple[float, float]]]:
    """The points to draw, in runs without a gap."""
    pieces: list[list[tuple[float, float]]] = [[]]
    for a, b in pairs:
        if a is None or b is None or (plot.y_log and b <= 0):
            pieces.append([])
        else:
            pieces[-1].append((x(a), y(b)))
    return [piece for piece in pieces if piece]


def _curve(curve: Curve, pieces: list[list[tuple[float, float]]]) -> Iterator[str]:
    for piece in pieces:
        points = " ".join(f"{number(a)} {number(b)}" for a, b in piece)
        yield f'<path d="M{points}"{_stroke(curve)}/>'
        yield _marks(curve, piece)


def _stroke(curve: Curve) -> str:
    color = "#666" if curve.look == "guide" else COLORS[curve.color % 6]
    dash = DASHES[1 + curve.color % 5] if curve.look == "guide" else DASHES[curve.color // 6 % 6]
    return f' fill="none" stroke="{color}" stroke-width="1.3"' + (f' stroke-dasharray="{dash}"' if dash else "")


def _marks(curve: Curve, points: list[tuple[float, float]]) -> str:
    color = COLORS[curve.color % 6]
    if curve.look == "dots":
        return "".join(f'<circle cx="{number(a)}" cy="{number(b)}" r="1.8" fill="{color}"/>' for a, b in points)
    if curve.look == "squares":
        return "".join(
            f'<rect x="{number(a - 1.7)}" y="{number(b - 1.7)}" width="3.4" height="3.4" fill="{color}"/>'
            for a, b in points
        )
    return ""
