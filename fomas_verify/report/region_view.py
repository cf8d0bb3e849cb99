"""The feasible region for the report: its strips in (h, gamma) with the design's point, and a table of their ends.

Each end is enclosed; the figure is drawn from the middles. Source: theory, section 5.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from fomas_verify.enclosure.digits import rounded_down, rounded_up
from fomas_verify.enclosure.interval import Interval
from fomas_verify.exact.errors import FomasError
from fomas_verify.kernel.memory import one_step_weight
from fomas_verify.region import Condition, Region, Strip, find_region
from fomas_verify.region.gains import Span, span_of
from fomas_verify.report.latex_text import Tex
from fomas_verify.report.math_text import digits
from fomas_verify.report.plot import Band, Plot
from fomas_verify.spectrum.loop import Loop

MOST_AGENTS = 60
BITS = 128
DIGITS = 12
STATEMENTS = {
    Condition.AS_STATED: Tex(r"(15) and (14), as the paper states them"),
    Condition.CLOSED_FORM: Tex(r"$1-2\mu\lambda_2(1-\mu\Delta_{\max})\le(2^\alpha-1)^2$ and (15)"),
    Condition.REPAIRED: Tex(r"$\sigma\le2^\alpha-1$ and (15)"),
    Condition.GAIN_BOUND: Tex(r"(15)"),
    Condition.CONSENSUS: Tex(r"$0<\mu<\mu^\ast$"),
}
_DRAWN = (Condition.CONSENSUS, Condition.GAIN_BOUND, Condition.AS_STATED, Condition.REPAIRED, Condition.CLOSED_FORM)


@dataclass(frozen=True)
class RegionRow:
    """One condition: on which mu and, at the design's h, on which gamma it holds, the alpha that opens it, and where
    the design's own mu lies.
    """

    name: str
    statement: Tex
    mu: Tex
    gamma: Tex
    opens: Tex
    place: str


@dataclass(frozen=True)
class RegionView:
    """The rows and the figure; without rows, ``reason`` says why. No figure where the design gives mu alone."""

    rows: tuple[RegionRow, ...] = ()
    plot: Plot | None = None
    reason: str = ""


def region_view(loop: Loop) -> RegionView:
    """The region of the design's alpha and graph; rigorous where it shows digits."""
    design = loop.design
    if design.graph.agents > MOST_AGENTS:
        return RegionView(reason=f"With more than {MOST_AGENTS} agents the region is left to the command region.")
    try:
        region = find_region(design)
    except FomasError as error:
        return RegionView(reason=f"Not shown: {str(error).removeprefix(f'{design.source}: ')}.")
    weight = None if design.h is None else one_step_weight(design.alpha, design.h, BITS)
    rows = tuple(_row(region, strip, weight, loop.mu(BITS)) for strip in region.strips)
    return RegionView(rows, _plot(region) if design.gamma is not None and design.h is not None else None)


def _row(region: Region, strip: Strip, weight: Interval | None, mu: Interval) -> RegionRow:
    span = span_of(region, strip)
    opens = digits(strip.opening.alpha, DIGITS) if strip.opening else Tex("" if span is None else "0")
    gamma = Tex("") if span is None or weight is None else _span(span.lower / weight, span.upper / weight, span)
    shown = Tex("") if span is None else _span(span.lower, span.upper, span)
    return RegionRow(strip.condition.value, STATEMENTS[strip.condition], shown, gamma, opens, _place(strip, mu))


def _span(lower: Interval, upper: Interval, span: Span) -> Tex:
    left, right = "[" if span.closed[0] else "(", "]" if span.closed[1] else ")"
    return Tex(rf"{left}{digits(lower, DIGITS)},\allowbreak\,{digits(upper, DIGITS)}{right}")


def _place(strip: Strip, mu: Interval) -> str:
    found = strip.mu
    if found is None:
        return "empty"
    if mu.upper < found.outer[0] or mu.lower > found.outer[1]:
        return "outside"
    return "inside" if found.inner[0] <= mu.lower and mu.upper <= found.inner[1] else "at an end"


def _plot(region: Region) -> Plot:
    """Strips between two lines each on logarithmic axes, the widest first, a decade around the design's h."""
    design = region.loop.design
    h, gamma = design.h or Fraction(1), design.gamma or Fraction(1)
    ends = Fraction(rounded_down(h / 10, 3)), Fraction(rounded_up(h * 10, 3))
    at_ends = [one_step_weight(design.alpha, end, BITS).mid for end in ends]

    def line(mu: Fraction) -> tuple[Fraction, Fraction]:
        return mu / at_ends[0], mu / at_ends[1]

    strips = [(i, strip) for i, c in enumerate(_DRAWN) if (strip := region.strip(c)).mu is not None]
    least = min([x for _, strip in strips if strip.mu and (x := strip.mu.lower.mid or strip.mu.upper.mid)])
    floor = min(line(least)[1], gamma) / 3
    top = max(gamma, *(line(strip.mu.upper.mid)[0] for _, strip in strips if strip.mu)) * Fraction(3, 2)
    bands = tuple(
        Band(
            line(strip.mu.lower.mid) if strip.mu.outer[0] else (floor, floor),
            line(strip.mu.upper.mid),
            shade,
            Tex(rf"\claimid{{{strip.condition.value}}}"),
        )
        for shade, strip in strips
        if strip.mu
    )
    y_range = Fraction(rounded_down(floor, 2)), Fraction(rounded_up(top, 2))
    return Plot(
        Tex(""), "h [s]", ends, y_range, bands=bands, marked=(h, gamma, Tex("this design")),
        x_log=True, y_log=True, y_label="γ", wide=True,
    )  # fmt: skip
