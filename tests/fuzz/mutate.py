"""Inputs made from real files: bytes flipped, slices moved, tokens exchanged, numbers exploded, trees rearranged.

Everything is drawn from the `Random` that is given, so that a seed and an index name an input.
"""

from __future__ import annotations

import io
import json
import re
import tomllib
import zipfile
import zlib
from collections.abc import Callable
from copy import deepcopy
from random import Random

LARGEST = 1_000_000
"""Bytes of an input at most."""

MOST_PLACES = 3000
"""Of a tree that is changed once more: a change may repeat a part 300 times."""

NUMBERS = [
    *(
        "0",
        "-1",
        "1",
        "2",
        "0.9",
        "1/2",
        "-0",
        "0.0",
        "1e4000",
        "1e-4000",
        "1e999999999",
        "-1e-999999999",
        "1/0",
        "2/2",
    ),
    *("nan", "inf", "-inf", "1_000", "0x10", "1e", ".5", "5.", "+1", "10000", "10001", "200", "201", "2001", "1000000"),
    *("123456789/987654321987", "18446744073709551615/18446744073709551616", "1/18446744073709551557"),
    *("0.99999999999999999999", "1e-19", "9007199254740993/9007199254740992", "18446744073709551616", "4294967297"),
    *("9" * 80, "9" * 81, "9" * 999, "9" * 3999, "9" * 4301, "1/" + "7" * 77, "1/" + "7" * 3990, "0." + "3" * 1000),
    *("٣", "１", "1/٣", "1e+٣", "0" * 200 + "1", "-" * 50 + "1"),
]
WORDS = [
    *("alpha", "gamma", "mu", "h", "x0", "horizon", "settle_to", "graph", "graphs", "adjacency", "edges", "agents"),
    *(
        "family",
        "shape",
        "file",
        "orientation",
        "gate",
        "require",
        "limits",
        "u_max",
        "settle_within",
        "name",
        "format",
    ),
    *("path", "star", "torus", "grid", "hypercube", "complete", "cycle", "directed-cycle", "from-to", "hears"),
    *("design", "region", "synthesis", "claims", "values", "witness", "verdict", "statement", "id", "task", "tool"),
    *("proved", "refuted", "undecided", "inapplicable", "gain-bound", "memory-inequality", "average-consensus"),
    *("grid", "from", "to", "steps", "<f8", "|O", "fortran_order", "descr", "coordinate", "symmetric", "pattern"),
    *("lower", "upper", "true", "false", "null", "lambda2", "sigma", "margins", "kappa", "rho", "bits", "members"),
]
TEXTS = [
    *("", "\0", "\ud7ff", "\ufeff", "\u202e", "\x1b[2J", "\r\n", "\u2028", "é" * 30, "🜚", "a" * 5000, "]]>", "<&>\"'"),
    *("\\input{/etc/passwd}", "$$\\undefined", "%s%n", "{{7*7}}", "<script>", "|`_*#", "../../x", "\\end{document}"),
    *(
        '<!DOCTYPE a [<!ENTITY b "b">]>',
        "&b;",
        "<edge source='n0' target='n1'/>",
        "%%MatrixMarket matrix array real general",
    ),
    *(
        "{",
        "[",
        "[[",
        "]",
        "}",
        '"',
        '"""',
        "'''",
        "=",
        ",",
        ":",
        "#",
        "\\u0000",
        "\\ud800",
        "\n[graph]\n",
        "\n[[graphs]]\n",
    ),
]
DEEP = ["[" * 17, "[" * 5000, '{"a":' * 40, "[" * 100_000, "a." * 200 + "a = 1\n", "(" * 1000]
_TOKEN = re.compile(rb'"[^"\n]{0,200}"|[A-Za-z_][A-Za-z0-9_-]*|[-+]?[0-9][0-9./eE+-]*|[\[\]{}=,:#]')
_NUMBER = re.compile(rb"[-+]?[0-9][0-9./eE+-]*")

Edit = Callable[[bytes, bytes, Random], bytes]


def mutate(data: bytes, other: bytes, random: Random) -> bytes:
    """One to four edits, by tree, tokens or bytes; `other` is a second file that parts are taken from."""
    if random.random() < 0.5:
        data = _by_tree(data, other, random)
    for _ in range(random.choice((0, 1, 1, 2, 4)) if random.random() < 0.7 else 0):
        data = random.choice(EDITS)(data, other, random)
    return data[:LARGEST]


def mutate_packed(data: bytes, other: bytes, random: Random) -> bytes:
    """A file of arrays: its bytes edited, or what a zip archive or a compressed element of a .mat file holds."""
    if data[:2] == b"PK" and random.random() < 0.8:
        made = io.BytesIO()
        with zipfile.ZipFile(io.BytesIO(data)) as old, zipfile.ZipFile(made, "w") as new:
            names = old.namelist()
            chosen = random.choice(names)
            for name in names:
                content = _packed_edit(old.read(name), random) if name == chosen else old.read(name)
                other_name = name if random.random() < 0.97 else random.choice(("a.npy", "../x.npy", "A.txt"))
                new.writestr(zipfile.ZipInfo(other_name), content, zipfile.ZIP_DEFLATED)
        return made.getvalue()[:LARGEST]
    if data[:6] == b"MATLAB" and data[128:129] == b"\x0f" and random.random() < 0.8:
        inner = zlib.compress(_packed_edit(zlib.decompress(data[136:]), random))
        return data[:132] + len(inner).to_bytes(4, "little") + inner
    return _packed_edit(data, random)


def _packed_edit(data: bytes, random: Random) -> bytes:
    """Bits, words of 1 to 8 bytes, tokens of a header, moved parts."""
    for _ in range(random.choice((1, 1, 2, 3))):
        if random.random() < 0.5 and len(data) > 8:
            place, width = random.randrange(len(data) - 8), random.choice((1, 2, 4, 8))
            word = random.choice((0, 1, 2, 7, 255, 2**15, 2**31 - 1, 2**31, 2**32 - 1, 2**40, 2**63 - 1, 2**64 - 1))
            data = data[:place] + (word % 256**width).to_bytes(width, "little") + data[place + width :]
        else:
            data = random.choice((_flip, _drop, _repeat, _cut, _number, _word, _bytes))(data, data, random)
    return data


def _flip(data: bytes, other: bytes, random: Random) -> bytes:
    if not data:
        return b"\xff"
    place = random.randrange(len(data))
    return data[:place] + bytes([data[place] ^ (1 << random.randrange(8))]) + data[place + 1 :]


def _slice(data: bytes, random: Random, most: int = 400) -> tuple[int, int]:
    start = random.randint(0, len(data))
    return start, min(len(data), start + random.randint(0, most))


def _drop(data: bytes, other: bytes, random: Random) -> bytes:
    start, end = _slice(data, random)
    return data[:start] + data[end:]


def _repeat(data: bytes, other: bytes, random: Random) -> bytes:
    start, end = _slice(data, random)
    return data[:end] + data[start:end] * random.choice((1, 2, 50)) + data[end:]


def _splice(data: bytes, other: bytes, random: Random) -> bytes:
    start, end = _slice(data, random)
    first, last = _slice(other, random, 4000)
    return data[:start] + other[first:last] + data[end:]


def _cut(data: bytes, other: bytes, random: Random) -> bytes:
    return data[: random.randint(0, len(data))]


def _replace_one(pattern: re.Pattern[bytes], data: bytes, new: bytes, random: Random) -> bytes:
    found = list(pattern.finditer(data))
    if not found:
        return data + new
    token = random.choice(found)
    return data[: token.start()] + new + data[token.end() :]


def _number(data: bytes, other: bytes, random: Random) -> bytes:
    return _replace_one(_NUMBER, data, random.choice(NUMBERS).encode(), random)


def _word(data: bytes, other: bytes, random: Random) -> bytes:
    new = random.choice(random.choice((NUMBERS, WORDS, TEXTS)))
    quoted = random.choice((new, f'"{new}"'))
    return _replace_one(_TOKEN, data, quoted.encode("utf-8", "surrogatepass"), random)


def _exchange(data: bytes, other: bytes, random: Random) -> bytes:
    tokens = list(_TOKEN.finditer(other)) or [None]
    token = random.choice(tokens)
    return _replace_one(_TOKEN, data, token.group() if token else b"", random)


def _nest(data: bytes, other: bytes, random: Random) -> bytes:
    place = random.randint(0, len(data))
    return data[:place] + random.choice(DEEP).encode() + data[place:]


def _bytes(data: bytes, other: bytes, random: Random) -> bytes:
    place = random.randint(0, len(data))
    return (
        data[:place] + random.choice((b"\xff\xfe", b"\xc3", b"\xed\xa0\x80", b"\0", random.randbytes(8))) + data[place:]
    )


EDITS: list[Edit] = [_flip, _drop, _repeat, _splice, _cut, _number, _number, _word, _word, _exchange, _nest, _bytes]


def tree_of(data: bytes) -> object:
    """What a TOML or JSON file holds, or None."""
    try:
        text = data.decode()
        return (
            json.loads(text, parse_float=str) if text.lstrip().startswith("{") else tomllib.loads(text, parse_float=str)
        )
    except (ValueError, RecursionError):
        return None


def _by_tree(data: bytes, other: bytes, random: Random) -> bytes:
    """Change one place of the tree; the result is JSON, whatever it was."""
    tree = tree_of(data)
    if not isinstance(tree, dict) or not tree:
        return random.choice(EDITS)(data, other, random)
    places = list(_places(tree))
    try:
        for _ in range(random.choice((1, 1, 2, 3))):
            holder, key = random.choice(places)
            _change(holder, key, tree_of(other), random)
            places = list(_places(tree)) or [(tree, "alpha")]
            if len(places) > MOST_PLACES:
                break
        return json.dumps(tree, default=str, ensure_ascii=random.random() < 0.5).encode("utf-8", "surrogatepass")
    except (ValueError, RecursionError):
        return data


def _places(tree: object) -> list[tuple[dict | list, object]]:
    found: list[tuple[dict | list, object]] = []
    todo = [tree]
    while todo:
        node = todo.pop()
        entries = node.items() if isinstance(node, dict) else enumerate(node) if isinstance(node, list) else ()
        for key, value in entries:
            found.append((node, key))
            todo.append(value)
    return found


def _change(holder: dict | list, key: object, other: object, random: Random) -> None:
    present = key in holder if isinstance(holder, dict) else key < len(holder)
    if not present:
        return
    match random.randrange(9):
        case 0:
            del holder[key]
        case 1:
            copies = min(random.choice((1, 2, 300)), LARGEST // len(json.dumps(holder[key], default=str)) + 1)
            holder[key] = [deepcopy(holder[key]) for _ in range(copies)]
        case 2 if other is not None and (places := _places(other)):
            there, name = random.choice(places)
            holder[key] = json.loads(json.dumps(there[name], default=str))
        case 3 if isinstance(holder, dict):
            holder[random.choice(WORDS + TEXTS)] = holder[key]
        case 4:
            holder[key] = random.choice((None, True, {}, [], "", 0, -1, 10**30, 1.5))
        case 5:
            holder[key] = random.choice(WORDS + TEXTS)
        case _:
            number = random.choice(NUMBERS)
            whole = re.fullmatch("[0-9]{1,4000}", number, re.ASCII) and random.random() < 0.5
            holder[key] = int(number) if whole else number
