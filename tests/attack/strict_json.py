"""A strict JSON reader and writer that keep what others lose: key order, repeated keys, the text of numbers.

Objects become `Obj` (pairs, in order), numbers `Num` (their text). The reader refuses what RFC 8259 and section 1 of
docs/certificate-format.md refuse: repeated keys, bytes that are not UTF-8, a byte-order mark, trailing data.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import Any

NUMBER = re.compile(r"-?(?:0|[1-9][0-9]*)(?:\.[0-9]+)?(?:[eE][+-]?[0-9]+)?")
PLAIN = re.compile(r'[^"\\\x00-\x1f]*')
NOT_PLAIN = re.compile(r'["\\\x00-\x1f\ud800-\udfff]')
SPACE = re.compile(r"[ \t\n\r]*")
ESCAPES = {'"': '"', "\\": "\\", "/": "/", "b": "\b", "f": "\f", "n": "\n", "r": "\r", "t": "\t"}
DEEPEST = 16


class Malformed(Exception):
    """The bytes are not a certificate; the message says where."""


@dataclass(frozen=True)
class Num:
    """A JSON number, as it was written (or anything to be written in a number's place)."""

    text: str


@dataclass
class Obj:
    """A JSON object: its pairs in order, a repeated key included when built by hand."""

    pairs: list[tuple[str, Any]] = field(default_factory=list)

    def __getitem__(self, key: str) -> Any:
        return next(value for name, value in self.pairs if name == key)

    def keys(self) -> list[str]:
        """The keys, in order."""
        return [key for key, _ in self.pairs]


class _Reader:
    def __init__(self, text: str) -> None:
        self.text = text
        self.at = 0

    def fail(self, why: str) -> Malformed:
        return Malformed(f"character {self.at}: {why}")

    def skip(self) -> str:
        match = SPACE.match(self.text, self.at)
        self.at = match.end() if match else self.at
        return self.text[self.at : self.at + 1]

    def expect(self, token: str) -> None:
        if not self.text.startswith(token, self.at):
            raise self.fail(f"expected {token!r}")
        self.at += len(token)

    def value(self, depth: int) -> Any:
        if depth > DEEPEST:
            raise self.fail("nested too deep")
        start = self.skip()
        if start == "{":
            return self.object(depth)
        if start == "[":
            return self.array(depth)
        if start == '"':
            return self.string()
        for word, meaning in (("true", True), ("false", False), ("null", None)):
            if self.text.startswith(word, self.at):
                self.at += len(word)
                return meaning
        match = NUMBER.match(self.text, self.at)
        if not match:
            raise self.fail("expected a value")
        self.at = match.end()
        return Num(match.group())

    def object(self, depth: int) -> Obj:
        self.expect("{")
        pairs: list[tuple[str, Any]] = []
        seen: set[str] = set()
        if self.skip() == "}":
            self.at += 1
            return Obj(pairs)
        while True:
            self.skip()
            key = self.string()
            if key in seen:
                raise self.fail(f"repeated key {key!r}")
            seen.add(key)
            self.skip()
            self.expect(":")
            pairs.append((key, self.value(depth + 1)))
            if self.skip() == "}":
                self.at += 1
                return Obj(pairs)
            self.expect(",")

    def array(self, depth: int) -> list[Any]:
        self.expect("[")
        items: list[Any] = []
        if self.skip() == "]":
            self.at += 1
            return items
        while True:
            items.append(self.value(depth + 1))
            if self.skip() == "]":
                self.at += 1
                return items
            self.expect(",")

    def string(self) -> str:
        self.expect('"')
        parts: list[str] = []
        while True:
            match = PLAIN.match(self.text, self.at)
            assert match is not None
            parts.append(match.group())
            self.at = match.end()
            if self.text.startswith('"', self.at):
                self.at += 1
                return _paired("".join(parts))
            self.expect("\\")
            parts.append(self.escape())

    def escape(self) -> str:
        kind = self.text[self.at : self.at + 1]
        if kind == "u":
            digits = self.text[self.at + 1 : self.at + 5]
            if not re.fullmatch("[0-9a-fA-F]{4}", digits):
                raise self.fail("bad escape")
            self.at += 5
            return chr(int(digits, 16))
        if kind not in ESCAPES or not kind:
            raise self.fail("bad escape")
        self.at += 1
        return ESCAPES[kind]


def _paired(text: str) -> str:
    """Escaped surrogate pairs as the characters they mean; a lone surrogate stays."""
    return text.encode("utf-16-le", errors="surrogatepass").decode("utf-16-le", errors="surrogatepass")


def loads(data: bytes) -> Any:
    """Read one JSON value, or raise `Malformed`."""
    try:
        text = data.decode("utf-8", errors="strict")
    except UnicodeDecodeError as error:
        raise Malformed(f"byte {error.start}: not UTF-8") from None
    reader = _Reader(text)
    value = reader.value(1)
    if reader.skip():
        raise reader.fail("trailing data")
    return value


def _escaped(match: re.Match[str]) -> str:
    char = match[0]
    return "\\" + char if char in '"\\' else f"\\u{ord(char):04x}"


def _quote(text: str) -> str:
    return '"' + NOT_PLAIN.sub(_escaped, text) + '"'


def dumps(value: Any, gap: str = "") -> str:
    """Write a tree as it stands, repeated keys included; `gap` is put after every comma and colon."""
    if isinstance(value, Obj):
        inner = ("," + gap).join(f"{_quote(key)}:{gap}{dumps(item, gap)}" for key, item in value.pairs)
        return "{" + inner + "}"
    if isinstance(value, list):
        return "[" + ("," + gap).join(dumps(item, gap) for item in value) + "]"
    if isinstance(value, Num):
        return value.text
    if isinstance(value, str):
        return _quote(value)
    return {True: "true", False: "false", None: "null"}[value]
