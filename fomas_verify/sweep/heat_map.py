"""The verdicts on one claim over two swept parameters, as a figure.

A cell is the rows with its two values. Where they differ among themselves the cell is *mixed*, and shows what share is
proved. Colours are told apart by hatches too.
"""

from __future__ import annotations

import io
from collections.abc import Callable, Mapping
from itertools import pairwise
from pathlib import Path
from typing import Any, Final

from fomas_verify.design.fields import nearest as nearest_name
from fomas_verify.exact.rational import format_rational, parse_rational
from fomas_verify.sweep.errors import SweepError
from fomas_verify.sweep.plan import Plan
from fomas_verify.sweep.store import part_name
from fomas_verify.sweep.summary import VERDICTS
from fomas_verify.sweep.table import columns_of

FORMATS: Final = ("pdf", "png", "svg")
KINDS: Final = (*VERDICTS, "mixed", "no verdict")
COLORS: Final = ("#2f7f57", "#d98c7a", "#f2cf8d", "#d5d5d5", "#b9cfe4", "#ffffff")
HATCHES: Final = ("", "//", "..", "xx", "--", "")
MOST_NUMBERS: Final = 24
"""Shares are written into mixed cells where an axis has at most so many values."""

MOST_CELLS: Final = 4_000_000
MOST_TICKS: Final = 12

_STYLE: Final[dict[str, Any]] = {"font.size": 8, "hatch.linewidth": 0.4, "svg.hashsalt": "fomas_verify"}
_NO_DATE: Final[dict[str, dict[str, Any]]] = {"pdf": {"CreationDate": None}, "svg": {"Date": None}, "png": {}}


def prepare(
    plan: Plan, file_format: str, across: str, up: str, claim: str | None, at: Mapping[str, str]
) -> Callable[[Path], bytes]:
    """Make sure that the figure can be drawn; what draws it from the folder of the finished sweep.

    Raises
    ------
    SweepError
        An axis, a fixed value or the claim is not among what is swept, the format is unknown, or matplotlib is missing.
    """
    if file_format not in FORMATS:
        raise SweepError(f"--plot: expected a name that ends in .pdf, .png or .svg, got .{file_format}")
    try:
        import matplotlib  # noqa: F401
    except ImportError as error:
        raise SweepError(
            f"a plot needs {error.name}, which the extra `plot` brings: pip install 'fomas_verify[plot]'"
        ) from None
    values = swept_values(plan)
    for option, name in {"--x": across, "--y": up, **{f"--at {name}": name for name in at}}.items():
        if name not in values:
            hint = nearest_name(name, values) or f"one of {', '.join(values)}"
            raise SweepError(f"{option}: expected a swept parameter, got {name[:40]!r}; {hint}")
    if across == up or {across, up} & set(at):
        raise SweepError("--x, --y, --at: expected different parameters")
    if len(values[across]) * len(values[up]) > MOST_CELLS:
        raise SweepError(f"--plot: expected at most {MOST_CELLS} cells")
    fixed = {name: _position(values[name], name, text) for name, text in at.items()}
    shown = claim or ("average-consensus" if "average-consensus" in plan.claims else plan.claims[0])
    if shown not in plan.claims:
        raise SweepError(f"--claim: expected one of the claims that are decided, got {shown}")

    def draw(folder: Path) -> bytes:
        counts = _counted(plan, folder, shown, values, (across, up), fixed)
        return _drawn(plan, counts, shown, values, (across, up), fixed, file_format)

    return draw


def swept_values(plan: Plan) -> dict[str, list[str]]:
    """The values of each swept parameter as text, in the order of the rows; a family's sizes by their own names."""
    found: dict[str, list[str]] = {
        name: list(dict.fromkeys(_graph_value(plan, i, name) for i in range(len(plan.grid.graphs))))
        for name in plan.grid.graph_axes
    }
    for axis in plan.grid.axes:
        found[axis.name] = [format_rational(axis.values[i]) for i in range(len(axis.values))]
    return found


def _graph_value(plan: Plan, graph: int, name: str) -> str:
    value = plan.grid.graph_value(graph, name)
    return "-" if value is None else str(value)


def _position(values: list[str], name: str, text: str) -> int:
    if text not in values and values[0][:1].isdigit():
        text = format_rational(parse_rational(text, what=f"--at {name}"))
    if text not in values:
        raise SweepError(f"--at {name}: expected one of its values, got {text[:40]}")
    return values.index(text)


def _counted(
    plan: Plan,
    folder: Path,
    claim: str,
    values: Mapping[str, list[str]],
    axes: tuple[str, str],
    fixed: Mapping[str, int],
) -> Any:
    """How many rows of each kind each cell has: an array (y, x, kind), the last kind being no verdict."""
    import numpy as np
    import pyarrow.compute as pc

    shape = len(values[axes[1]]), len(values[axes[0]]), len(VERDICTS) + 1
    counts = np.zeros(np.prod(shape), dtype=np.int64)
    for part in range(plan.parts):
        table = columns_of(folder / part_name(part), ["row", f"verdict_{claim}"])
        rows = table["row"].to_numpy()
        kinds = pc.index_in(table[f"verdict_{claim}"], value_set=_strings(VERDICTS))
        kind = pc.fill_null(kinds, len(VERDICTS)).to_numpy()
        keep = np.ones(len(rows), dtype=bool)
        for name, i in fixed.items():
            keep &= _indices(plan, values, name, rows) == i
        x, y = (_indices(plan, values, name, rows) for name in axes)
        cells = (y * shape[1] + x) * shape[2] + kind
        counts += np.bincount(cells[keep], minlength=len(counts))
    return counts.reshape(shape)


def _strings(words: tuple[str, ...]) -> Any:
    import pyarrow as pa

    return pa.array(words)


def _indices(plan: Plan, values: Mapping[str, list[str]], name: str, rows: Any) -> Any:
    """The positions of the rows along a parameter."""
    import numpy as np

    grid = plan.grid
    if name in grid.graph_axes:
        of_graph = np.array([values[name].index(_graph_value(plan, i, name)) for i in range(len(grid.graphs))])
        return of_graph[rows // grid.rows_of_a_graph]
    stride = 1
    for axis in reversed(grid.axes):
        if axis.name == name:
            break
        stride *= len(axis.values)
    return rows // stride % len(values[name])


def _drawn(
    plan: Plan,
    counts: Any,
    claim: str,
    values: Mapping[str, list[str]],
    axes: tuple[str, str],
    fixed: Mapping[str, int],
    file_format: str,
) -> bytes:
    import matplotlib
    import numpy as np
    from matplotlib.colors import ListedColormap
    from matplotlib.figure import Figure
    from matplotlib.patches import Patch

    total = counts.sum(axis=2)
    pure = counts.max(axis=2) == total
    kind = np.where(total == 0, len(KINDS) - 1, np.where(pure, counts.argmax(axis=2), len(VERDICTS)))
    kind = np.where(pure & (counts.argmax(axis=2) == len(VERDICTS)), len(KINDS) - 1, kind)
    with matplotlib.rc_context(_STYLE):
        figure = Figure(figsize=(6.4, 4.4), layout="constrained")
        plane = figure.add_subplot()
        edges = [_edges(values[name], name) for name in axes]
        for i, (color, hatch) in enumerate(zip(COLORS, HATCHES, strict=True)):
            cells = np.ma.masked_where(kind != i, np.ones_like(kind))
            if cells.count():
                plane.pcolor(
                    *edges, cells, cmap=ListedColormap([color]), hatch=hatch, edgecolor="#00000055", linewidth=0
                )
        _write_shares(plane, counts, kind, edges)
        for axis, name, ends in ((plane.xaxis, axes[0], edges[0]), (plane.yaxis, axes[1], edges[1])):
            _label(axis, values[name], name, ends)
        present = [i for i in range(len(KINDS)) if (kind == i).any()]
        handles = [Patch(facecolor=COLORS[i], hatch=HATCHES[i], edgecolor="#555555", label=KINDS[i]) for i in present]
        figure.legend(handles=handles, loc="outside lower center", ncols=len(handles))
        plane.set_title(f"{claim}: {_of_what(plan, values, axes, fixed)}")
        stream = io.BytesIO()
        figure.savefig(stream, format=file_format, dpi=200, metadata=_NO_DATE[file_format])
    return stream.getvalue()


def _numeric(name: str) -> bool:
    return name in ("alpha", "gamma", "mu", "h", "agents")


def _places(values: list[str], name: str) -> list[float]:
    """Where the values stand on their axis; words, and numbers out of order, one after another."""
    from fractions import Fraction

    places = [float(Fraction(x)) for x in values] if _numeric(name) and "-" not in values else []
    return places if places and places == sorted(places) else [float(i) for i in range(len(values))]


def _edges(values: list[str], name: str) -> list[float]:
    """The ends of the cells: half way between neighbours."""
    places = _places(values, name)
    if len(places) == 1:
        return [places[0] - 0.5, places[0] + 0.5]
    middles = [(a + b) / 2 for a, b in pairwise(places)]
    return [2 * places[0] - middles[0], *middles, 2 * places[-1] - middles[-1]]


def _label(axis: Any, values: list[str], name: str, edges: list[float]) -> None:
    axis.set_label_text(f"{name} in seconds" if name == "h" else name)
    places = _places(values, name)
    if not _numeric(name) or places == [float(i) for i in range(len(values))] or len(values) <= MOST_TICKS:
        step = -(-len(values) // MOST_TICKS)
        words = [f"{x:.6g}" if _numeric(name) else v for v, x in zip(values, places, strict=True)]
        if _numeric(name) and places != [_float(v) for v in values]:
            words = values
        axis.set_ticks(places[::step], words[::step])
    axis.set_view_interval(edges[0], edges[-1], ignore=True)


def _float(text: str) -> float | None:
    from fractions import Fraction

    return None if text == "-" else float(Fraction(text))


def _write_shares(plane: Any, counts: Any, kind: Any, edges: list[list[float]]) -> None:
    if max(kind.shape) > MOST_NUMBERS:
        return
    for y in range(kind.shape[0]):
        for x in range(kind.shape[1]):
            if KINDS[kind[y, x]] == "mixed":
                middle = [(ends[i] + ends[i + 1]) / 2 for ends, i in zip(edges, (x, y), strict=True)]
                text = f"{counts[y, x, 0]}/{counts[y, x].sum()}"
                plane.text(*middle, text, ha="center", va="center", fontsize=6, backgroundcolor="#ffffffaa")


def _of_what(plan: Plan, values: Mapping[str, list[str]], axes: tuple[str, str], fixed: Mapping[str, int]) -> str:
    """What the other parameters are."""
    words = [f"{name} = {values[name][i]}" for name, i in fixed.items()]
    rest = [name for name in values if name not in (*axes, *fixed)]
    words += [f"every {name}" for name in rest]
    ending = "; mixed: share proved" if rest else ""
    return (", ".join(words) or f"{plan.grid.rows} designs") + ending
