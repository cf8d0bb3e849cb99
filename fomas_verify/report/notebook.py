"""A result as a table for a notebook: HTML, and LaTeX that MathJax reads too.

Typeset as the reports are; without the extra `report` HTML is the text of the terminal.
"""

from __future__ import annotations

import html
from collections.abc import Sequence

from fomas_verify.exact.errors import MissingExtraError
from fomas_verify.report.document import Table
from fomas_verify.report.html_page import html_fragment
from fomas_verify.report.latex_tree import Nodes, tree
from fomas_verify.report.math_text import sentence

VERDICTS = ("proved", "refuted", "undecided", "inapplicable")


def table_html(title: str, rows: Sequence[Sequence[str]], text: str) -> str:
    """Rows of plain sentences, the first one the head; `text` in place of it where formulas cannot be set."""
    try:
        head, *body = [tuple(_nodes(cell) for cell in row) for row in rows]
        table = html_fragment((Table((head,), tuple(body)),))
    except MissingExtraError:
        return f"<pre>{html.escape(text)}</pre>"
    return f"<div><b>{html.escape(title)}</b>\n{table}</div>"


def table_latex(rows: Sequence[Sequence[str]]) -> str:
    """The same as an array in display mathematics."""
    lines = [r" & ".join(rf"\text{{{_macros(sentence(cell))}}}" for cell in row) for row in rows]
    columns = "l" * max(len(row) for row in rows)
    body = r" \\ ".join(lines[1:])
    return rf"$$\begin{{array}}{{{columns}}} {lines[0]} \\ \hline {body} \end{{array}}$$"


def _nodes(cell: str) -> Nodes:
    return tree(rf"\{cell}{{}}" if cell in VERDICTS else sentence(cell))


def _macros(source: str) -> str:
    """In place of the reports' macros those that a notebook knows."""
    return source.replace(r"\claimid{", r"\texttt{").replace(r"\paperlabel{", r"\textsf{")
