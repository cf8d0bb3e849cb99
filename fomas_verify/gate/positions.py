"""Where a key or an entry stands in a design's text: line and column, for TOML and JSON.

A path is that of `DesignError`: keys, and positions in lists from 0, as in ``graph.edges[3]``. The text need not be
valid; what a broken text leaves open is answered with the nearest place above it.
"""

from __future__ import annotations

import re
from typing import Final

from fomas_verify.design.document import MAX_NESTING, Format
from fomas_verify.gate.model import Position

KeyPath = tuple[str | int, ...]

LARGEST: Final = 2**20

_TOKEN: Final = re.compile(
    r'(?P<text>"""(?:[^"\\]|\\.|"{1,2}(?!"))*+(?:"{3,5})?+'
    r"|'''(?:[^']|'{1,2}(?!'))*+(?:'{3,5})?+"
    r'|"(?:[^"\\\n]|\\.)*+"?+'
    r"|'[^'\n]*+'?+)"
    r"|(?P<space>[ \t\r]+|\#[^\n]*+)"
    r"|(?P<mark>[\[\]{},=:\n])"
    r"|(?P<bare>[^\s\[\]{},=:\"'#]++)",
    re.DOTALL,
)
_STEP: Final = re.compile(r"\[(\d+)\]|([A-Za-z0-9_-]+)|\.")
_SYNTAX_ERROR: Final = re.compile(r"(?:at )?line (\d+),? column (\d+)")


def position_of_error(message: str, source: str, text: str, format_: Format) -> Position:
    """The place that a reader's refusal, ``FILE: key.path[i]: ...`` or ``... line L, column C``, is about."""
    rest = message.removeprefix(f"{source}: ")
    syntax = _SYNTAX_ERROR.search(rest)
    if rest.startswith("expected ") and syntax:
        return Position(int(syntax[1]), int(syntax[2]))
    head = rest.partition(": ")[0]
    return position_of(text, format_, _steps(head)) if re.fullmatch(r"[\w.\[\]-]+", head) else Position()


def position_of(text: str, format_: Format, path: KeyPath) -> Position:
    """The place of a key's name, or of a list's entry; of the nearest one above it where there is none.

    In a text of more than 2^20 characters nothing is looked for.
    """
    if len(text) > LARGEST:
        return Position()
    offsets = _Scan(text).toml() if format_ == "toml" else _Scan(text).json()
    while path and path not in offsets:
        path = path[:-1]
    offset = offsets.get(path, 0)
    return Position(text.count("\n", 0, offset) + 1, offset - text.rfind("\n", 0, offset))


def _steps(path: str) -> KeyPath:
    return tuple(int(step[1]) if step[1] else step[2] for step in _STEP.finditer(path) if step[0] != ".")


class _Scan:
    """One pass over the tokens; `found` maps each path to the offset where its key or entry begins."""

    def __init__(self, text: str) -> None:
        self.tokens = [match for match in _TOKEN.finditer(text) if match.lastgroup != "space"]
        self.at = 0
        self.found: dict[KeyPath, int] = {}

    def toml(self) -> dict[KeyPath, int]:
        table: KeyPath = ()
        counts: dict[KeyPath, int] = {}
        while (mark := self._peek()) is not None:
            if mark == "\n":
                self.at += 1
            elif mark == "[":
                double = self._skip("[") and self._skip("[")
                table = self._key(())
                if double:
                    counts[table] = counts.get(table, -1) + 1
                    table = (*table, counts[table])
                    self.found.setdefault(table, self.found.get(table[:-1], 0))
                self._to_line_end()
            else:
                self._pair(table, "=")
                self._to_line_end()
        return self.found

    def json(self) -> dict[KeyPath, int]:
        self.tokens = [token for token in self.tokens if token.group() != "\n"]
        while self._peek() is not None:
            self._value((), ":")
            self.at += 1
        return self.found

    def _peek(self) -> str | None:
        return self.tokens[self.at].group() if self.at < len(self.tokens) else None

    def _skip(self, mark: str) -> bool:
        if self._peek() == mark:
            self.at += 1
            return True
        return False

    def _key(self, table: KeyPath) -> KeyPath:
        """A key with its dots, to a bounded depth."""
        path = table
        while self.at < len(self.tokens) and self.tokens[self.at].lastgroup != "mark":
            token = self.tokens[self.at]
            quoted = token.lastgroup == "text"
            for part in [token.group()[1:-1]] if quoted else filter(None, token.group().split(".")):
                if len(path) > MAX_NESTING:
                    break
                path = (*path, part)
                self.found.setdefault(path, token.start())
            self.at += 1
        return path

    def _pair(self, table: KeyPath, sign: str) -> None:
        path = self._key(table)
        if self._skip(sign):
            self._value(path, sign)

    def _value(self, path: KeyPath, sign: str) -> None:
        if len(path) > MAX_NESTING:
            self.at += 1
        elif self._skip("["):
            self._list(path, sign)
        elif self._skip("{"):
            while (mark := self._peek()) is not None and mark != "}":
                if self.tokens[self.at].lastgroup == "mark":
                    self.at += 1
                else:
                    self._pair(path, sign)
            self._skip("}")
        else:
            while self.at < len(self.tokens) and self.tokens[self.at].lastgroup != "mark":
                self.at += 1

    def _list(self, path: KeyPath, sign: str) -> None:
        position = 0
        while (mark := self._peek()) is not None and mark != "]":
            if mark == "\n":
                self.at += 1
                continue
            self.found.setdefault((*path, position), self.tokens[self.at].start())
            before = self.at
            self._value((*path, position), sign)
            if self._skip(","):
                position += 1
            elif self.at == before:
                self.at += 1
        self._skip("]")

    def _to_line_end(self) -> None:
        while (mark := self._peek()) is not None and mark != "\n":
            self.at += 1
