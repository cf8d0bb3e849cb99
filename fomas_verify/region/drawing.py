"""The strips in (h, gamma) on logarithmic axes, where each lies between two parallel lines, the limits, the design's
point.
"""

from __future__ import annotations

import io
import math
from fractions import Fraction
from typing import Any, Final

from fomas_verify.design import Limits
from fomas_verify.exact.errors import FomasError
from fomas_verify.kernel.memory import one_step_weight
from fomas_verify.region.model import Condition, Region, Strip
from fomas_verify.region.task import Objective, Task, require_complete
from fomas_verify.spectrum.margins import BITS

COLORS: Final = {  # widest first
    Condition.CONSENSUS: "#e3e3e3",
    Condition.GAIN_BOUND: "#b9cfe4",
    Condition.AS_STATED: "#f2cf8d",
    Condition.REPAIRED: "#8fc79a",
    Condition.CLOSED_FORM: "#2f7f57",
}
DECADES: Final = 1
"""How far h reaches on either side of the design's own (or of 1 s), in powers of ten."""

_STYLE: Final[dict[str, Any]] = {
    "font.size": 8,
    "axes.titlesize": 8,
    "svg.hashsalt": "fomas_verify",
    "savefig.dpi": 200,
}
_NO_DATE: Final[dict[str, dict[str, Any]]] = {"pdf": {"CreationDate": None}, "svg": {"Date": None}, "png": {}}


class DrawingError(FomasError):
    """The figure cannot be drawn; one line."""


def draw(region: Region, file_format: str) -> bytes:
    """One figure as a file of that format; approximate, the same bytes in every run.

    Raises
    ------
    DrawingError
        matplotlib is missing, or a number is beyond what it can draw.
    """
    try:
        import matplotlib
        from matplotlib.figure import Figure
    except ImportError as error:
        raise DrawingError(
            f"a plot needs {error.name}, which the extra `plot` brings: pip install 'fomas_verify[plot]'"
        ) from None
    with matplotlib.rc_context(_STYLE):
        figure = Figure(figsize=(5.2, 3.6), layout="constrained")
        axes = figure.add_subplot()
        try:
            _draw(axes, region)
        except (OverflowError, ValueError):
            raise DrawingError(
                f"{region.loop.design.source}: --plot draws numbers from 1e-300 to 1e300: gamma, h or a limit is beyond"
            ) from None
        stream = io.BytesIO()
        figure.savefig(stream, format=file_format, metadata=_NO_DATE[file_format])
    return stream.getvalue()


def _draw(axes: Any, region: Region) -> None:
    """The strips, widest first: each condition implies the next, so that the narrower lie on the wider."""
    design = region.loop.design
    weight = float(one_step_weight(design.alpha, Fraction(1), BITS).mid)
    middle = 1.0 if design.h is None else float(design.h)
    own = [float(h) for h in design.limits.h or () if h]
    ends = [min([middle, *own]) * 10**-DECADES, max([middle, *own]) * 10**DECADES]

    def line(mu: Fraction) -> list[float]:
        """The gamma that make this mu at both ends: ``mu Gamma(alpha + 1) / h^alpha``."""
        return [float(mu) / weight * math.pow(h, -float(design.alpha)) for h in ends]

    strips = {condition: region.strip(condition).mu for condition in COLORS}
    margins = {condition: mu for condition, mu in strips.items() if mu is not None}
    floor = min(line(mu.lower.mid or mu.upper.mid)[1] for mu in margins.values()) / 4
    for condition, mu in margins.items():
        low = line(mu.lower.mid) if mu.outer[0] else [floor, floor]
        axes.fill_between(ends, low, line(mu.upper.mid), label=condition.value, color=COLORS[condition], linewidth=0)
    if design.gamma is not None and design.h is not None:
        axes.plot([float(design.h)], [float(design.gamma)], "k.", label="the design")
    _draw_limits(axes, region)
    axes.set(xscale="log", yscale="log", xlabel="h in seconds", ylabel="gamma", xlim=ends)
    axes.set_ylim(bottom=floor)
    axes.set_title(f"{design.name}: alpha = {float(design.alpha):.6g}{_empty(region.strips)}")
    axes.legend(fontsize=6.5)


def _draw_limits(axes: Any, region: Region) -> None:
    """The limits of h, of gamma, and of gamma by u_max where the peak is 1, as lines."""
    design = region.loop.design
    if design.limits == Limits():
        return
    require_complete(design)
    box = Task(region, Condition.REPAIRED, Objective.ROBUST, design.limits).box
    style = {"color": "black", "linewidth": 0.8, "linestyle": "--"}
    lines = [(axes.axvline, x) for x in box.h if x] + [
        (axes.axhline, x) for x in (box.gamma_least, box.gamma_most) if x
    ]
    for i, (line, x) in enumerate(lines):
        line(float(x), label=None if i else "the limits", **style)


def _empty(strips: tuple[Strip, ...]) -> str:
    names = [strip.condition.value for strip in strips if strip.mu is None]
    return f"; empty: {', '.join(names)}" if names else ""
