r"""The body of a report, which the templates write in a small part of LaTeX, as a tree for the other formats.

Whatever stands outside of that part is refused, so that no format can leave out what another says.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass


class UnknownLatexError(Exception):
    """A template uses LaTeX that has no other form."""


@dataclass(frozen=True)
class Text:
    """Plain characters."""

    text: str


@dataclass(frozen=True)
class Math:
    """LaTeX of a formula, in the line or displayed."""

    source: str
    display: bool = False


@dataclass(frozen=True)
class Macro:
    """A command with its arguments."""

    name: str
    option: Nodes
    arguments: tuple[Nodes, ...]


@dataclass(frozen=True)
class Group:
    """What stands between braces."""

    body: Nodes


@dataclass(frozen=True)
class Environment:
    r"""``\begin{name} ... \end{name}``; ``width`` is the one of a minipage."""

    name: str
    body: Nodes
    width: str = ""


Node = Text | Math | Macro | Group | Environment
Nodes = tuple[Node, ...]

ARITY: Mapping[str, int] = {
    "section": 1, "section*": 1, "subsection": 1, "label": 1, "ref": 1, "item": 0, "caption": 1, "figureslot": 1,
    "reporttitle": 1, "reportlead": 1,
    "textbf": 1, "textit": 1, "emph": 1, "texttt": 1, "claimid": 1, "paperlabel": 1, "mbox": 1, "\\": 0,
    "proved": 0, "refuted": 0, "undecided": 0, "inapplicable": 0, "toprule": 0, "midrule": 0, "bottomrule": 0,
    "allowbreak": 0,
}  # fmt: skip
"""Commands that mean something, with the number of their arguments."""
SILENT: Mapping[str, int] = {
    "needspace": 1, "setlength": 2, "renewcommand": 2, "centering": 0, "raggedright": 0, "small": 0, "large": 0,
    "LARGE": 0, "bfseries": 0, "par": 0, "hfill": 0, "noindent": 0, "keepwithlast": 0,
    "smallskip": 0, "medskip": 0,
}  # fmt: skip
"""Commands about the look of a page."""
BREAKS = {"par", "smallskip", "medskip"}
SYMBOLS: Mapping[str, str] = {
    "textbackslash": "\\", "textasciicircum": "^", "textasciitilde": "~", "textless": "<", "textgreater": ">",
    "textbar": "|", "textquotedbl": '"', "textasciigrave": "`", "textquotesingle": "'", "textendash": "–",
    "textemdash": "—", "textquotedblleft": "“", "textquotedblright": "”", "textellipsis": "…", "textdegree": "°",
    "LaTeX": "LaTeX", "ss": "ß", "ae": "æ", "AE": "Æ", "oe": "œ", "OE": "Œ", "o": "ø", "O": "Ø", "l": "ł", "L": "Ł",
    "i": "ı", "{": "{", "}": "}", "$": "$", "&": "&", "#": "#", "%": "%", "_": "_", ",": "\u202f", " ": " ",
}  # fmt: skip
ACCENTS: Mapping[str, str] = {
    "`": "\u0300", "'": "\u0301", "^": "\u0302", "~": "\u0303", "=": "\u0304", "u": "\u0306", ".": "\u0307",
    '"': "\u0308", "r": "\u030a", "H": "\u030b", "v": "\u030c", "c": "\u0327", "k": "\u0328",
}  # fmt: skip
PARAGRAPH = "\n\n"
_COMMAND = re.compile(r"\\(section\*|[A-Za-z]+|.)", re.DOTALL)
_PLAIN = re.compile(r"[^\\{}$&~\n`'-]+")
_NUMBER = re.compile(r"-?\d+(\.\d+)?")
_COLUMNS = {"tabular": 1, "tabularx": 2}


def tree(source: str) -> Nodes:
    """The nodes of a body; raises `UnknownLatexError`."""
    reader = _Reader(source)
    nodes = reader.until("")
    if reader.at < len(source):
        raise UnknownLatexError("a brace or an environment too many")
    return nodes


class _Reader:
    """A place in the source."""

    def __init__(self, source: str) -> None:
        self.source, self.at = source, 0

    def until(self, end: str) -> Nodes:
        r"""Nodes up to ``}`` or ``\end{...}``, which is passed over; up to the end of the source where empty."""
        found: list[Node] = []
        while self.at < len(self.source):
            if end and self.source.startswith(end, self.at):
                self.at += len(end)
                return tuple(found)
            if self.source[self.at] == "}" or self.source.startswith(r"\end{", self.at):
                break
            found.append(self._node())
        if end:
            raise UnknownLatexError(f"no {end} before {self.source[self.at : self.at + 40]!r}")
        return tuple(found)

    def _node(self) -> Node:
        c = self.source[self.at]
        if c == "\\":
            return self._command()
        if c == "{":
            self.at += 1
            return Group(self.until("}"))
        if c == "$":
            return self._math(1, "$", display=False)
        if match := re.compile(r"\n[ \t]*\n\s*").match(self.source, self.at):
            self.at = match.end()
            return Text(PARAGRAPH)
        for mark, text in (("``", "“"), ("''", "”"), ("'", "’"), ("`", "‘"), ("-", "-"), ("~", "\u00a0"), ("\n", " ")):
            if self.source.startswith(mark, self.at):
                self.at += len(mark)
                return Text(text)
        if c == "&":
            self.at += 1
            return Macro("&", (), ())
        match = _PLAIN.match(self.source, self.at)
        if match is None:
            raise UnknownLatexError(repr(self.source[self.at : self.at + 20]))
        self.at = match.end()
        return Text(match.group())

    def _math(self, opening: int, closing: str, *, display: bool) -> Math | Text:
        """A formula; a short number alone is text."""
        start = self.at + opening
        end = self.source.index(closing, start)
        self.at = end + len(closing)
        inner = self.source[start:end].strip()
        if _NUMBER.fullmatch(inner):
            return Text(inner.replace("-", "\N{MINUS SIGN}"))
        return Math(inner, display)

    def _command(self) -> Node:
        match = _COMMAND.match(self.source, self.at)
        if match is None:
            raise UnknownLatexError("a backslash at the end")
        name = match.group(1)
        if name == "[":
            return self._math(2, r"\]", display=True)
        self.at = match.end()
        if name == "begin":
            return self._environment()
        if name in ACCENTS and self.source.startswith("{", self.at):
            return Text(f"{self._raw()}{ACCENTS[name]}")
        if name in SYMBOLS:
            if name.isalpha() and self.source.startswith("{}", self.at):
                self.at += 2
            return Text(SYMBOLS[name])
        if name == "ensuremath":
            return Math(self._raw())
        if name.isalpha():
            self._skip_blanks()
        if name in SILENT:
            for _ in range(SILENT[name]):
                self._raw()
            return Text(PARAGRAPH if name in BREAKS else "")
        if name not in ARITY:
            raise UnknownLatexError(f"\\{name}")
        option = self._option()
        arguments = tuple(self._argument() for _ in range(ARITY[name]))
        return Macro(name, option, arguments)

    def _environment(self) -> Environment:
        name, width = self._raw(), ""
        if name == "minipage":
            self._option()
            width = self._raw()
        elif name == "figure":
            self._option()
        for _ in range(_COLUMNS.get(name, 0)):
            self._raw()
        return Environment(name, self.until(rf"\end{{{name}}}"), width)

    def _skip_blanks(self) -> None:
        while self.source[self.at : self.at + 1] == " ":
            self.at += 1

    def _option(self) -> Nodes:
        if not self.source.startswith("[", self.at):
            return ()
        end = self.source.index("]", self.at)
        inner, self.at = self.source[self.at + 1 : end], end + 1
        return tree(inner)

    def _argument(self) -> Nodes:
        if not self.source.startswith("{", self.at):
            raise UnknownLatexError("an argument without braces")
        self.at += 1
        return self.until("}")

    def _raw(self) -> str:
        """An argument as it stands."""
        self._skip_blanks()
        if not self.source.startswith("{", self.at):
            match = _COMMAND.match(self.source, self.at)
            if match is None:
                raise UnknownLatexError("an argument without braces")
            self.at = match.end()
            return match.group()
        depth, start = 0, self.at + 1
        while True:
            c = self.source[self.at : self.at + 1]
            if not c:
                raise UnknownLatexError("a brace too few")
            depth += {"{": 1, "}": -1}.get(c, 0)
            self.at += 2 if c == "\\" else 1
            if depth == 0:
                return self.source[start : self.at - 1]
