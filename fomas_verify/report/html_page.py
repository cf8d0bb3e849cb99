"""The report as one HTML page that needs nothing else: style, figures and formulas stand in it, without a script."""

from __future__ import annotations

import html
import re
from collections.abc import Mapping
from importlib.resources import files

from fomas_verify.report.document import (
    SPACES,
    VERDICTS,
    Block,
    Blocks,
    Document,
    Figure,
    Formula,
    Heading,
    Items,
    Lead,
    Paragraph,
    Row,
    Slot,
    Table,
    plain,
)
from fomas_verify.report.latex_tree import Group, Macro, Math, Node, Nodes, Text, tree
from fomas_verify.report.mathml import mathml
from fomas_verify.report.picture import Picture
from fomas_verify.report.plot import Plot
from fomas_verify.report.plot_svg import band_sample, legend_sample, svg_plot

_TAGS = {"textbf": "b", "textit": "i", "emph": "em", "texttt": "code", "claimid": "code", "mbox": "span"}
_POLICY = "default-src 'none'; style-src 'unsafe-inline'; base-uri 'none'; form-action 'none'"
_PUNCTUATED = re.compile(r"(<math\b(?:(?!<math\b).)*?</math>)([,.;:)]+)")
"""A formula and what must stay on its line."""


def html_page(body: Document, title: str, figures: Mapping[str, Picture | Plot]) -> str:
    """The page, UTF-8 text; the same input gives the same bytes."""
    style = files("fomas_verify.report").joinpath("templates/report.css").read_text("utf-8")
    content = _Writer(body.numbers, figures).blocks(body.blocks)
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        f'<meta http-equiv="Content-Security-Policy" content="{_POLICY}">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f"<title>{html.escape(title)}</title>\n<style>\n{style}</style>\n</head>\n<body>\n<main>\n{content}"
        "</main>\n</body>\n</html>\n"
    )


def html_fragment(blocks: Blocks) -> str:
    """Blocks without figures and references, for a page of others."""
    return _Writer({}, {}).blocks(blocks)


class _Writer:
    """Blocks to HTML."""

    def __init__(self, numbers: Mapping[str, str], figures: Mapping[str, Picture | Plot]) -> None:
        self.numbers, self.figures = numbers, figures

    def blocks(self, blocks: Blocks) -> str:
        return "".join(self._block(block) + "\n" for block in blocks)

    def _block(self, block: Block) -> str:
        match block:
            case Heading():
                number = f"{block.number}\u2002" if block.number else ""
                name = f' id="{html.escape(block.label)}"' if block.label else ""
                return f"<h{block.level}{name}>{number}{self.line(block.text)}</h{block.level}>"
            case Lead():
                return f'<p class="lead">{self.line(block.text)}</p>'
            case Paragraph():
                return f"<p>{self.line(block.text)}</p>"
            case Formula():
                return f'<div class="scroll">{mathml(block.source, display=True)}</div>'
            case Table():
                return self._table(block)
            case Items():
                return self._items(block)
            case Slot():
                return self._figure(block.name)
            case Row():
                parts = "".join(f"<div>\n{self.blocks(part)}</div>\n" for part in block.parts)
                return f'<div class="row">\n{parts}</div>'
            case Figure():
                caption = f"<figcaption>Figure {block.number}: {self.line(block.caption)}</figcaption>"
                return f"<figure>\n{self.blocks(block.blocks)}{caption}\n</figure>"

    def _table(self, table: Table) -> str:
        head = "".join(f"<tr>{''.join(f'<th>{self.line(cell)}</th>' for cell in row)}</tr>" for row in table.head)
        body = "\n".join(f"<tr>{''.join(f'<td>{self.line(cell)}</td>' for cell in row)}</tr>" for row in table.body)
        head = f"<thead>{head}</thead>\n" if head else ""
        return f'<div class="scroll"><table>\n{head}<tbody>\n{body}\n</tbody>\n</table></div>'

    def _items(self, items: Items) -> str:
        if any(item.term for item in items.entries):
            rows = (f"<dt>{self.line(x.term)}</dt>\n<dd>{self.blocks(x.blocks)}</dd>\n" for x in items.entries)
            return f"<dl>\n{''.join(rows)}</dl>"
        return f"<ul>\n{''.join(f'<li>{self.blocks(x.blocks)}</li>' for x in items.entries)}</ul>"

    def _figure(self, name: str) -> str:
        figure = self.figures[name]
        if isinstance(figure, Picture):
            return f'<div class="picture">{figure.svg(name)}</div>'
        entries = [(legend_sample(curve), curve.label) for curve in figure.curves if curve.label]
        entries += [(band_sample(band.shade), band.label) for band in figure.bands]
        if figure.marked is not None:
            dot = '<svg viewBox="0 0 24 12" class="sample" aria-hidden="true"><circle cx="12" cy="6" r="4"/></svg>'
            entries.append((dot, figure.marked[2]))
        legend = "".join(f"<span>{sample} {self.line(tree(label))}</span>\n" for sample, label in entries)
        title = f'<div class="title">{self.line(tree(figure.title))}</div>' if figure.title else ""
        return f'<div class="plot">{title}{svg_plot(figure, name)}<div class="legend">{legend}</div></div>'

    def line(self, nodes: Nodes) -> str:
        text = SPACES.sub(" ", "".join(map(self._node, nodes))).strip(" ")
        return _PUNCTUATED.sub(r'<span class="whole">\1\2</span>', text)

    def _node(self, node: Node) -> str:
        match node:
            case Text():
                return html.escape(node.text)
            case Math():
                return mathml(node.source)
            case Group():
                return "".join(map(self._node, node.body))
            case Macro():
                return self._macro(node)
        raise TypeError(f"a block in the line: {node}")

    def _macro(self, node: Macro) -> str:
        if node.name in VERDICTS:
            return f'<span class="{node.name}">{node.name}</span>'
        if node.name == "allowbreak":
            return "<wbr>"
        if node.name == "\\":
            return "<br>"
        if node.name == "ref":
            label = plain(node.arguments[0])
            return f'<a href="#{html.escape(label)}">{self.numbers[label]}</a>'
        inner = "".join(map(self._node, node.arguments[0]))
        if node.name == "paperlabel":
            return f'<span class="label">{inner}</span>'
        tag = _TAGS[node.name]
        return f"<{tag}>{inner}</{tag}>"
