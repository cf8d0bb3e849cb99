"""Figures drawn with matplotlib, in the size of the paper's: PDF, PNG or SVG, the same bytes in every run."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING, Any, Final

from fomas_verify.simulate.errors import SimulationError

if TYPE_CHECKING:
    from fomas_verify.simulate.figures import Curve, Panel

FORMATS: Final = ("pdf", "png", "svg")
WIDTH, HEIGHT = 10.4 / 2.54, 6.4 / 2.54
BELOW = 1.2 / 2.54
"""Room for a legend below the axes."""

MOST_IN_LEGEND = 10

STYLE: Final[dict[str, Any]] = {
    "font.size": 8,
    "axes.titlesize": 8,
    "legend.fontsize": 6.5,
    "legend.handlelength": 1.5,
    "legend.handletextpad": 0.5,
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
    except ImportError as error:
        raise SimulationError(
            f"figures need {error.name}, which the extra `plot` brings: pip install 'fomas_verify[plot]'"
        ) from None
    with matplotlib.rc_context(STYLE):
        stream = io.BytesIO()
        figure_of(panel).savefig(stream, format=file_format, metadata=_NO_DATE[file_format])
    return stream.getvalue()


def figure_of(panel: Panel) -> Any:
    """The figure as matplotlib's object, in matplotlib's present style."""
    from matplotlib.figure import Figure

    height = HEIGHT + (BELOW if panel.legend == "below" else 0)
    figure = Figure(figsize=(WIDTH, height), layout="constrained")
    axes = figure.add_subplot()
    for curve in panel.curves:
        _draw_curve(axes, curve)
    if panel.logarithmic and any(max(curve.y, default=0) > 0 for curve in panel.curves):
        axes.set_xscale("log")
        axes.set_yscale("log")
    axes.set(title=panel.title, xlabel=panel.x_label, ylabel=panel.y_label)
    if 1 < len(panel.curves) <= MOST_IN_LEGEND:
        _add_legend(figure, axes, panel.legend)
    return figure


def _add_legend(figure: Any, axes: Any, place: str) -> None:
    if place == "inside":
        axes.legend()
    elif place == "beside":
        figure.legend(loc="outside right upper")
    else:
        figure.legend(
            loc="outside lower center", ncols=len({line.get_color() for line in axes.lines}), columnspacing=1.0
        )


def _draw_curve(axes: Any, curve: Curve) -> None:
    look = _LOOKS[curve.style]
    color: dict[str, Any] = {} if curve.color is None else {"color": f"C{curve.color}"}
    axes.plot(curve.x, curve.y, label=curve.label, **(look | color))
