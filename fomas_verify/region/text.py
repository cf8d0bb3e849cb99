"""The region as a table."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING

from fomas_verify.enclosure.digits import decimal
from fomas_verify.enclosure.interval import Interval
from fomas_verify.exact.rational import format_rational
from fomas_verify.region.gains import Span, section, span_of
from fomas_verify.region.model import Region, Strip
from fomas_verify.spectrum.margins import BITS

if TYPE_CHECKING:
    from fomas_verify.region.polygon import Room

DIGITS, CORNER = 18, 12
SHOWN = 3
"""Polyhedra of one condition that are shown, one for each number of samples."""


def region_text(region: Region, left: Sequence[Room] = ()) -> str:
    """All that was found, for a reader; with what the limits leave of each condition, where there are limits."""
    parts = [_heading(region), _table(region), _cut(region), _left(region, left), _best(region), _own(region)]
    return "\n\n".join("\n".join(part) for part in map(list, parts) if part)


def _heading(region: Region) -> Iterator[str]:
    design = region.loop.design
    yield f"{design.name}: {design.graph.agents} agents, alpha = {format_rational(design.alpha)}"
    yield "mu = gamma h^alpha / Gamma(alpha + 1)"
    if not region.loop.assumption1:
        yield "Assumption 1 fails: every condition but gain-bound presupposes it."


def _table(region: Region) -> Iterator[str]:
    rows = [(strip.condition.value, _span(span_of(region, strip)), _opening(strip)) for strip in region.strips]
    return _aligned([("condition", "mu", "opens at alpha"), *rows])


def _cut(region: Region) -> Iterator[str]:
    cut = section(region)
    if cut is not None:
        yield from _aligned(
            [("condition", f"{cut.free} at {cut.at}"), *((x.value, _cut_span(s)) for x, s in cut.spans)]
        )


def _left(region: Region, left: Sequence[Room]) -> Iterator[str]:
    """The corners of what the limits leave, or what clashes."""
    if not left:
        return
    yield f"What the limits leave ({', '.join(_limits(region))}), by its corners (gamma, h):"
    for room in left:
        if not room.pieces:
            yield f"  {room.condition}: {'not decided' if room.clash is None else f'nothing: {room.clash}'}"
        for piece in room.pieces[:SHOWN]:
            samples = "" if piece.samples is None else f", {piece.samples} samples"
            corners = " ".join(f"({decimal(v.gamma, CORNER)}, {decimal(v.h, CORNER)})" for v in piece.vertices)
            yield f"  {room.condition}{samples}: {corners}{' unbounded' if piece.unbounded else ''}"
        if room.more or len(room.pieces) > SHOWN:
            last = "more" if room.more else f"up to {room.pieces[-1].samples} samples"
            yield f"  {room.condition}, {last}: in --json"
    if region.loop.design.limits.u_max is not None and any(room.pieces and room.peak_bound is None for room in left):
        names = ", ".join(room.condition for room in left if room.pieces and room.peak_bound is None)
        yield f"  (in {names} the peak has no bound on the strip: there u_max limits the first control only)"


def _limits(region: Region) -> Iterator[str]:
    limits = region.loop.design.limits
    for name, ends in (("h", limits.h), ("gamma", limits.gamma)):
        if ends is not None:
            yield f"{name} in [{format_rational(ends[0])}, {format_rational(ends[1])}]"
    for name, x in (("u_max", limits.u_max), ("settle_within", limits.settle_within)):
        if x is not None:
            yield f"{name} = {format_rational(x)}"


def _best(region: Region) -> Iterator[str]:
    if region.best is not None:
        sigma = decimal(Interval(region.best.lower, region.best.upper), DIGITS)
        yield f"Best contraction up to mu = 1/Delta_max: sigma = {sigma}, near mu = {float(region.best.mu):.5g}"


def _own(region: Region) -> Iterator[str]:
    """Which conditions the design's own mu satisfies, where it gives one."""
    design = region.loop.design
    if design.mu is None and (design.gamma is None or design.h is None):
        return
    mu = region.loop.mu(BITS)
    yield f"The design's own mu = {decimal(mu, DIGITS)}"
    for place in ("inside", "outside", "too near an end to say of"):
        names = [strip.condition.value for strip in region.strips if _place(strip, mu) == place]
        if names:
            yield f"  {place} {', '.join(names)}"


def _place(strip: Strip, mu: Interval) -> str:
    found = strip.mu
    if found is None or mu.upper < found.outer[0] or mu.lower > found.outer[1]:
        return "outside"
    inside = found.inner[0] <= mu.lower and mu.upper <= found.inner[1]
    return "inside" if inside else "too near an end to say of"


def _opening(strip: Strip) -> str:
    if strip.opening is not None:
        return decimal(strip.opening.alpha, DIGITS)
    return "none" if strip.mu is None else "every"


def _cut_span(span: Span | None) -> str:
    return "an end is beyond 2^-8192 or 2^8192" if span is None else _span(span)


def _span(span: Span | None) -> str:
    if span is None:
        return "empty"
    left, right = "[" if span.closed[0] else "(", "]" if span.closed[1] else ")"
    return f"{left}{decimal(span.lower, DIGITS)}, {decimal(span.upper, DIGITS)}{right}"


def _aligned(rows: Iterable[tuple[str, ...]]) -> Iterator[str]:
    table = list(rows)
    widths = [max(len(row[i]) for row in table) for i in range(len(table[0]))]
    for row in table:
        yield "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip()
