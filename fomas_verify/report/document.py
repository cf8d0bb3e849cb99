"""A report as headings, paragraphs, tables, lists and figures, numbered as LaTeX numbers them."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from fomas_verify.report.latex_tree import PARAGRAPH, Environment, Group, Macro, Math, Node, Nodes, Text

VERDICTS = ("proved", "refuted", "undecided", "inapplicable")
"""Macros that print a verdict."""
SPACES = re.compile(r"[ \n]+")
"""What LaTeX prints as one space."""
_BLOCKS = ("reporttitle", "reportlead", "section", "section*", "subsection", "caption")


@dataclass(frozen=True)
class Heading:
    """``level`` 1 for the title, 2 for a section, 3 for one of its parts; ``number`` is empty where it has none."""

    level: int
    number: str
    label: str
    text: Nodes


@dataclass(frozen=True)
class Lead:
    """A line below the title."""

    text: Nodes


@dataclass(frozen=True)
class Paragraph:
    """Text and formulas."""

    text: Nodes


@dataclass(frozen=True)
class Formula:
    """A displayed formula."""

    source: str


@dataclass(frozen=True)
class Table:
    """Rows of cells; ``head`` has at most one."""

    head: tuple[tuple[Nodes, ...], ...]
    body: tuple[tuple[Nodes, ...], ...]


@dataclass(frozen=True)
class Item:
    """An entry of a list, with its term where it has one."""

    term: Nodes
    blocks: Blocks


@dataclass(frozen=True)
class Items:
    """A list."""

    entries: tuple[Item, ...]


@dataclass(frozen=True)
class Slot:
    """The place of a figure of the model."""

    name: str


@dataclass(frozen=True)
class Row:
    """Things side by side where there is room."""

    parts: tuple[Blocks, ...]


@dataclass(frozen=True)
class Figure:
    """Figures with a numbered caption."""

    number: str
    label: str
    blocks: Blocks
    caption: Nodes


Block = Heading | Lead | Paragraph | Formula | Table | Items | Slot | Row | Figure
Blocks = tuple[Block, ...]


@dataclass(frozen=True)
class Document:
    """The blocks, and the number of each label."""

    blocks: Blocks
    numbers: Mapping[str, str]


def document(nodes: Nodes) -> Document:
    """The blocks of a body."""
    writer = _Writer()
    return Document(writer.blocks(nodes), writer.numbers)


class _Writer:
    """Counters and what has a label."""

    def __init__(self) -> None:
        self.sections, self.parts, self.figures = 0, 0, 0
        self.numbers: dict[str, str] = {}

    def blocks(self, nodes: Nodes) -> Blocks:
        found: list[Block] = []
        run: list[Node] = []
        waiting: list[Blocks] = []
        pending = list(_spliced(nodes))
        for index, node in enumerate(pending):
            beside = _is_beside(node)
            if waiting and not (beside or _is_blank(node)):
                found.append(Row(tuple(waiting)))
                waiting = []
            if beside or _is_block(node):
                found += _paragraph(run)
                run = []
            if beside:
                waiting.append(self._part(node))
            elif _is_block(node):
                found += self._block(node, pending[index + 1 :])
            elif not (isinstance(node, Macro) and node.name == "label"):
                run.append(node)
        return tuple(found + _paragraph(run) + ([Row(tuple(waiting))] if waiting else []))

    def _part(self, node: Node) -> Blocks:
        if isinstance(node, Macro):
            return (Slot(plain(node.arguments[0])),)
        return self.blocks(node.body) if isinstance(node, Environment) else ()

    def _block(self, node: Node, following: list[Node]) -> list[Block]:
        if isinstance(node, Math):
            return [Formula(node.source)]
        if isinstance(node, Macro):
            if node.name == "reportlead":
                return [Lead(node.arguments[0])]
            return [] if node.name == "caption" else [self._heading(node, following)]
        if not isinstance(node, Environment):
            return []
        if node.name in ("tabular", "tabularx"):
            return [_table(node.body)]
        if node.name in ("itemize", "claim"):
            return [self._items(node.body)]
        if node.name == "figure":
            return [self._figure(node)]
        return list(self.blocks(node.body))

    def _heading(self, node: Macro, following: list[Node]) -> Heading:
        level = {"reporttitle": 1, "subsection": 3}.get(node.name, 2)
        number = ""
        if node.name == "section":
            self.sections, self.parts = self.sections + 1, 0
            number = str(self.sections)
        elif level == 3:
            self.parts += 1
            number = f"{self.sections}.{self.parts}"
        label = self._labelled(following[:1], number)
        return Heading(level, number, label, node.arguments[0])

    def _labelled(self, nodes: list[Node], number: str) -> str:
        for node in nodes:
            if isinstance(node, Macro) and node.name == "label":
                label = plain(node.arguments[0])
                self.numbers[label] = number
                return label
        return ""

    def _figure(self, node: Environment) -> Figure:
        self.figures += 1
        caption = next(x.arguments[0] for x in node.body if isinstance(x, Macro) and x.name == "caption")
        label = self._labelled(list(node.body), str(self.figures))
        return Figure(str(self.figures), label, self.blocks(node.body), caption)

    def _items(self, nodes: Nodes) -> Items:
        entries: list[tuple[Nodes, list[Node]]] = []
        for node in _spliced(nodes):
            if isinstance(node, Macro) and node.name == "item":
                entries.append((node.option, []))
            elif entries:
                entries[-1][1].append(node)
        return Items(tuple(Item(term, self.blocks(tuple(body))) for term, body in entries))


def _spliced(nodes: Nodes) -> Iterator[Node]:
    """The nodes, groups that hold blocks or end paragraphs opened."""
    for node in nodes:
        inner = node.body if isinstance(node, Group) else ()
        if any(_is_block(x) or _is_beside(x) or x == Text(PARAGRAPH) for x in _spliced(inner)):
            yield from _spliced(inner)
        else:
            yield node


def _is_beside(node: Node) -> bool:
    is_slot = isinstance(node, Macro) and node.name == "figureslot"
    return is_slot or (isinstance(node, Environment) and node.name == "minipage")


def _is_block(node: Node) -> bool:
    if isinstance(node, Macro):
        return node.name in _BLOCKS
    return isinstance(node, Environment) or (isinstance(node, Math) and node.display)


def _is_blank(node: Node) -> bool:
    return isinstance(node, Text) and not node.text.strip()


def _paragraph(run: list[Node]) -> list[Block]:
    """A run of the line as paragraphs, ends where there is an empty line."""
    found: list[Block] = []
    piece: list[Node] = []
    for node in [*run, Text(PARAGRAPH)]:
        if node != Text(PARAGRAPH):
            piece.append(node)
            continue
        if not all(map(_is_blank, piece)):
            found.append(Paragraph(tuple(piece)))
        piece = []
    return found


def _table(nodes: Nodes) -> Table:
    rows: list[list[list[Node]]] = [[[]]]
    heads = 0
    for node in nodes:
        name = node.name if isinstance(node, Macro) else ""
        if name == "\\":
            rows.append([[]])
        elif name == "&":
            rows[-1].append([])
        elif name == "midrule":
            heads = len(rows) - 1
        elif name not in ("toprule", "bottomrule") and node != Text(PARAGRAPH):
            rows[-1][-1].append(node)
    cells = [tuple(tuple(cell) for cell in row) for row in rows if not all(_is_blank(x) for cell in row for x in cell)]
    return Table(tuple(cells[:heads]), tuple(cells[heads:]))


def plain(nodes: Nodes) -> str:
    """The text of nodes that hold nothing else."""
    return "".join(node.text for node in nodes if isinstance(node, Text))
