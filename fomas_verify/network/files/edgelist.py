"""Edge lists as networkx writes them: a line ``from to``, ``from to weight`` or ``from to {'weight': weight}`` an edge.

`#` begins a comment. Weights are exact as they are written. Lines of numbers are read as arrays; any other file, with
names that are no integers or with further attributes, line by line.
"""

from __future__ import annotations

import ast
import re
from pathlib import Path
from typing import Final

from fomas_verify.exact.rational import excerpt
from fomas_verify.network.files.entries import Entries
from fomas_verify.network.files.lines import LineError, read_lines
from fomas_verify.network.files.names import numbering, remark_on
from fomas_verify.network.files.refusals import GraphFileError, lies, refused
from fomas_verify.network.files.weights import ratios_of_texts

EXPECTED: Final = "an edge list"

_COMMENT = re.compile(rb"#[^\n]*")
_WEIGHT = re.compile(rb"\{'weight': ([0-9.eE+-]+)\}(?=[ \t\r]*\n)")
_NOTHING = re.compile(rb"\{\}(?=[ \t\r]*\n)")


def read(path: Path, name: str) -> Entries:
    """Read an edge list; raises `GraphFileError`."""
    try:
        with path.open("rb") as file:
            lines = read_lines(file, clean=_clean, plain=True)
    except LineError:
        return _by_name(path, name)
    if not lines.first.size:
        raise lies(path, name, f"{EXPECTED} with at least one edge", "no edge")
    import numpy as np

    names, agents = np.unique(np.concatenate([lines.first, lines.second]), return_inverse=True)
    first, second = np.split(agents.astype(np.int64), 2)
    return Entries(len(names), first, second, lines.codes, lines.ratios, lines.place, remarks=remark_on(names.tolist()))


def _clean(block: bytes) -> bytes:
    """The block without comments, and with the attributes that networkx writes as plain weights."""
    if b"#" in block:
        block = _COMMENT.sub(b"", block)
    if b"{" in block:
        block = _NOTHING.sub(b"", _WEIGHT.sub(rb"\1", block))
    return block


def _by_name(path: Path, name: str) -> Entries:
    """The edges line by line, nodes by their names."""
    import numpy as np

    names: dict[str, int] = {}
    weights: dict[str, int] = {}
    first, second, codes, numbers = [], [], [], []
    for number, line in enumerate(_text(path, name).split("\n"), 1):
        words = line.partition("#")[0].split(None, 2)
        if not words:
            continue
        if len(words) == 1:
            raise refused(f"{name}: line {number}", "an edge `from to` or `from to weight`", excerpt(line.strip()))
        weight = _weight(words[2].strip(), f"{name}: line {number}") if len(words) == 3 else ""
        first.append(names.setdefault(words[0], len(names)))
        second.append(names.setdefault(words[1], len(names)))
        codes.append(weights.setdefault(weight, len(weights)))
        numbers.append(number)
    if not names:
        raise lies(path, name, f"{EXPECTED} with at least one edge", "no edge")
    if "" in weights and len(weights) > 1:
        number = numbers[codes.index(weights[""])]
        raise refused(
            f"{name}: line {number}", "a weight on every edge or on none", "none, though other edges have one"
        )
    agents, remarks = numbering(list(names))
    order = np.array(agents, dtype=np.int64)
    texts = [text or "1" for text in weights]
    return Entries(
        len(names), order[first], order[second], np.array(codes, dtype=np.int64), lambda: ratios_of_texts(texts),
        lambda entry: f"line {numbers[entry]}", remarks=remarks,
    )  # fmt: skip


def _text(path: Path, name: str) -> str:
    data = path.read_bytes()
    if b"\0" in data:
        raise lies(path, name, EXPECTED, "a binary file")
    try:
        text = data.decode("utf-8").replace("\r\n", "\n")
    except UnicodeDecodeError:
        raise lies(path, name, EXPECTED, "a text that is not UTF-8") from None
    if text.lstrip().startswith(("<", "%%MatrixMarket", "{")):
        raise lies(path, name, EXPECTED)
    return text


def _weight(text: str, where: str) -> str:
    """The weight as it is written, plain or as an attribute; empty where the attributes have none."""
    if not text.startswith("{"):
        return text
    try:
        found = ast.parse(text, mode="eval").body
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        raise refused(where, "a weight, or attributes in braces", excerpt(text)) from None
    if not isinstance(found, ast.Dict):
        raise _no_attributes(where, text)
    for key, value in zip(found.keys, found.values, strict=True):
        if isinstance(key, ast.Constant) and key.value == "weight":
            written = ast.get_source_segment(text, value) or ""
            quoted = isinstance(value, ast.Constant) and isinstance(value.value, str)
            return str(ast.literal_eval(value)) if quoted else written
    return ""


def _no_attributes(where: str, text: str) -> GraphFileError:
    return refused(where, "attributes {'name': value, ...}", excerpt(text))
