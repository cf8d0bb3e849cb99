"""The report as Markdown for a pull request's comment, formulas in the notation that GitHub and GitLab show."""

from __future__ import annotations

import re
from collections.abc import Mapping

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
from fomas_verify.report.latex_tree import Group, Macro, Math, Node, Nodes, Text

_MARKS = {"textit": "*", "emph": "*", "mbox": ""}
_SPECIAL = re.compile(r"[\\`*_{}\[\]|~$!]")
_REFERENCES = re.compile(r"([@#])(?=\w)")


def markdown(body: Document) -> str:
    """The document; what a user wrote stands in it as text only, and names nobody and no issue."""
    return _Writer(body.numbers).blocks(body.blocks).strip() + "\n"


def escaped(text: str) -> str:
    """Text that Markdown prints as it is."""
    text = text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
    return _REFERENCES.sub(r"\1<!-- -->", _SPECIAL.sub(r"\\\g<0>", text))


class _Writer:
    """Blocks to Markdown."""

    def __init__(self, numbers: Mapping[str, str]) -> None:
        self.numbers = numbers

    def blocks(self, blocks: Blocks) -> str:
        return "\n\n".join(text for block in blocks if (text := self._block(block)))

    def _block(self, block: Block) -> str:
        match block:
            case Heading():
                return f"{'#' * (block.level + 1)} {block.number} {self.line(block.text)}".replace("  ", " ")
            case Lead() | Paragraph():
                return self.line(block.text)
            case Formula():
                return f"```math\n{block.source}\n```"
            case Table():
                return self._table(block)
            case Items():
                return "\n".join(self._item(self.line(x.term), x.blocks) for x in block.entries)
            case Row():
                return "\n\n".join(text for part in block.parts if (text := self.blocks(part)))
            case Figure():
                return f"*Figure {block.number}, in the other formats:* {self.line(block.caption)}"
            case Slot():
                return ""

    def _item(self, term: str, blocks: Blocks) -> str:
        body = self.blocks(blocks).replace("\n", "\n  ")
        return f"- *{term}:* {body}" if term else f"- {body}"

    def _table(self, table: Table) -> str:
        rows = [[self.line(cell) for cell in row] for row in (*table.head, *table.body)]
        width = max(map(len, rows))
        if not table.head:
            rows.insert(0, [""] * width)
        lines = ["| " + " | ".join(row + [""] * (width - len(row))) + " |" for row in rows]
        return "\n".join([lines[0], "|" + "---|" * width, *lines[1:]])

    def line(self, nodes: Nodes) -> str:
        return SPACES.sub(" ", "".join(map(self._node, nodes))).strip(" ")

    def _node(self, node: Node) -> str:
        match node:
            case Text():
                return escaped(node.text)
            case Math():
                source = node.source.replace(r"\allowbreak", "").replace(r"\displaystyle", "").strip()
                return f"$`{SPACES.sub(' ', source)}`$"
            case Group():
                return "".join(map(self._node, node.body))
            case Macro():
                return self._macro(node)
        raise TypeError(f"a block in the line: {node}")

    def _macro(self, node: Macro) -> str:
        if node.name in VERDICTS:
            return f"**{node.name}**"
        if node.name in ("allowbreak", "\\"):
            return "" if node.name == "allowbreak" else "<br>"
        if node.name == "ref":
            return self.numbers[plain(node.arguments[0])]
        inner = "".join(map(self._node, node.arguments[0])).strip()
        if node.name in ("texttt", "claimid", "paperlabel"):
            return f"<code>{inner}</code>"
        if node.name == "textbf":
            return f"<b>{inner}</b>"
        mark = _MARKS[node.name]
        return f"{mark}{inner}{mark}"
