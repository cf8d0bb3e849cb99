"""A diagram as pgfplots. Its data is read from the table's file, beside the document."""

from __future__ import annotations

from fractions import Fraction

from fomas_verify.report.latex_text import Tex, escape
from fomas_verify.report.plot import Curve, Plot, significant

_LOOKS = {
    "dots": "mark=*,mark size=0.9pt,thin",
    "squares": "mark=square*,mark size=0.9pt,thin",
    "line": "no marks,semithick",
    "guide": "no marks,semithick",
}
DASHES = ("solid", "densely dashed", "densely dotted", "dash dot", "dash dot dot", "loosely dashed")


def latex_plot(plot: Plot) -> Tex:
    """The picture."""
    lines = [rf"\begin{{axis}}[{_options(plot)}]"]
    for band in plot.bands:
        (x1, x2), (l1, l2), (u1, u2) = plot.x_range, band.lower, band.upper
        corners = "".join(f"({significant(x)},{significant(y)})" for x, y in ((x1, l1), (x2, l2), (x2, u2), (x1, u1)))
        lines.append(
            rf"\addplot[draw=black!60,very thin,fill=band{band.shade},area legend] coordinates {{{corners}}} --cycle;"
        )
        lines.append(rf"\addlegendentry{{{band.label}}}")
    for level in plot.levels:
        ends = "".join(f"({significant(x)},{significant(level)})" for x in plot.x_range)
        lines.append(rf"\addplot[black,densely dashed,forget plot] coordinates {{{ends}}};")
    for curve in plot.curves:
        if plot.table is not None:
            data = rf"table[x={plot.x},y={curve.column},col sep=comma] {{{plot.table.file}}}"
            lines.append(rf"\addplot[{_look(curve)}] {data};")
            lines += [rf"\addlegendentry{{{curve.label}}}"] if curve.label else []
    if plot.marked is not None:
        x, y, label = plot.marked
        lines.append(
            rf"\addplot[only marks,mark=*,mark size=1.8pt] coordinates {{({significant(x)},{significant(y)})}};"
        )
        lines.append(rf"\addlegendentry{{{label}}}")
    body = "\n".join([*lines, r"\end{axis}"])
    return Tex(f"\\begin{{tikzpicture}}\n{body}\n\\end{{tikzpicture}}")


def _options(plot: Plot) -> str:
    (x1, x2), (y1, y2) = plot.x_range, plot.y_range
    parts = ["fomas wide plot" if plot.wide else "fomas plot", f"title={{{plot.title}}}"]
    parts += [f"xlabel={{{_label(plot.x_label)}}}"] + ([f"ylabel={{{_label(plot.y_label)}}}"] if plot.y_label else [])
    parts += [f"{name}={_limit(x)}" for name, x in (("xmin", x1), ("xmax", x2), ("ymin", y1), ("ymax", y2))]
    parts += [f"{axis}mode=log" for axis, log in (("x", plot.x_log), ("y", plot.y_log)) if log]
    return ",".join(parts)


def _label(text: str) -> Tex:
    """``t [s]`` with its symbol in italics."""
    symbol, *unit = text.split(" ")
    return Tex(" ".join([rf"${escape(symbol)}$", *unit]))


def _limit(x: Fraction) -> str:
    return significant(x)


def _look(curve: Curve) -> str:
    color = "black!60" if curve.look == "guide" else f"curve{curve.color % 6}"
    dash = DASHES[1 + curve.color % 5] if curve.look == "guide" else DASHES[curve.color // 6 % 6]
    return f"{color},{_LOOKS[curve.look]},{dash},unbounded coords=jump"
