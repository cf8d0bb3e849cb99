"""Figures drawn with matplotlib, in the size of the paper's: PDF, PNG or SVG, the same bytes in every run."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING, Any, Final

from fomas_verify.simulate.errors import SimulationError

if TYPE_CHECKING:
    from fomas_verify.simulate.figures import Curve, Panel

FORMATS: Final = ("pdf", "png", "svg")
WIDTH, HEIGHT = 10.4 / 2.54, 6.4 / 2.54
MOST_IN_LEGEND = 8

_STYLE: Final[dict[str, Any]] = {
    "font.size": 8,
    "axes.titlesize": 8,
    "axes.grid": True,
    "grid.linewidth": 0.3,
    "lines.linewidth": 0.9,
    "svg.hashsalt": "fomas_verify",
    "savefig.dpi": 200,
}
_LOOKS: Final[dict[str, dict[str, Any]]] = {
    "line": {},
    "steps": {"drawstyle": "steps-post"},
    "points": {"linestyle": "none", "marker": ".", "markersize": 2.5},
    "guide": {"linestyle": "--", "color": "0.4"},
}
_NO_DATE: Final[dict[str, dict[str, Any]]] = {"pdf": {"CreationDate": None}, "svg": {"Date": None}, "png": {}}


def draw(panel: Panel, file_format: str) -> bytes:
    """One figure as a file of that format.

    Raises
    ------
    SimulationError
        matplotlib is missing.
    """
    try:
        import matplotlib
        from matplotlib.figure import Figure
    except ImportError as error:
        raise SimulationError(
            f"figures need {error.name}, which the extra `plot` brings: pip install 'fomas_verify[plot]'"
        ) from None
    with matplotlib.rc_context(_STYLE):
        figure = Figure(figsize=(WIDTH, HEIGHT), layout="constrained")
        axes = figure.add_subplot()
        for curve in panel.curves:
            _draw_curve(axes, curve)
        if panel.logarithmic and any(max(curve.y, default=0) > 0 for curve in panel.curves):
            axes.set_xscale("log")
            axes.set_yscale("log")
        axes.set(title=panel.title, xlabel=panel.x_label, ylabel=panel.y_label)
        if 1 < len(panel.curves) <= MOST_IN_LEGEND:
            axes.legend(fontsize=6.5)
        stream = io.BytesIO()
        figure.savefig(stream, format=file_format, metadata=_NO_DATE[file_format])
    return stream.getvalue()


def _draw_curve(axes: Any, curve: Curve) -> None:
    look = _LOOKS[curve.style]
    color: dict[str, Any] = {} if curve.color is None else {"color": f"C{curve.color}"}
    axes.plot(curve.x, curve.y, label=curve.label, **look, **color)
