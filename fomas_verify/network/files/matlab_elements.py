"""The elements that a MATLAB file of version 5 to 7.2 is built of, looked at before scipy reads their numbers.

scipy looks a number's type up in a table without bounds: a damaged type ends the whole program, by a signal.
Source: MAT-File Level 5 File Format, MathWorks, chapter 1.
"""

from __future__ import annotations

import struct
import zlib
from collections.abc import Iterator
from os import SEEK_CUR
from pathlib import Path
from typing import Final

_HEADER: Final = 128
_MATRIX: Final = 14
_COMPRESSED: Final = 15
_PIECE: Final = 1 << 20

_FLAGS, _DIMENSIONS, _NAME = 6, 5, 1  # uint32, int32, int8
_NUMBERS: Final = {1: 1, 2: 1, 3: 2, 4: 2, 5: 4, 6: 4, 7: 4, 9: 8, 12: 8, 13: 8}  # a type, and the bytes of a number
_NUMERIC_CLASSES: Final = range(5, 16)  # sparse, floats and integers


def unpacked_sizes(path: Path) -> Iterator[int]:
    """The sizes to which a file of version 5 to 7.2 unpacks, piece by piece; nothing where it is of version 4."""
    with path.open("rb") as file:
        order = _order(file.read(_HEADER))
        while order and len(tag := file.read(8)) == 8:
            kind, size = struct.unpack(f"{order}II", tag)
            if kind != _COMPRESSED:
                yield size
                file.seek(size + -size % 8, SEEK_CUR)
                continue
            unpack, data = zlib.decompressobj(), file.read(size)
            while data and not unpack.eof:
                yield len(unpack.decompress(data, _PIECE))
                data = unpack.unconsumed_tail


def must_be_sound(path: Path) -> None:
    """Raise `ValueError` where an array of numbers holds anything else, or a name stands twice (not of version 4)."""
    names: set[bytes] = set()
    with path.open("rb") as file:
        order = _order(file.read(_HEADER))
        while order and len(tag := file.read(8)) == 8:
            kind, size = struct.unpack(f"{order}II", tag)
            data = file.read(size)
            if kind == _COMPRESSED:
                data = zlib.decompressobj().decompress(data)
                (kind,) = struct.unpack(f"{order}I", data[:4])
                data = data[8:]
            else:
                file.seek(-size % 8, SEEK_CUR)
            if kind != _MATRIX:
                raise ValueError("an element that is no array")
            name = _name_of_sound(data, order)
            if name in names:
                raise ValueError("a name twice")
            names.add(name)


def _order(header: bytes) -> str:
    """The order of bytes; empty for version 4, whose first bytes are no text, and for 7.3.

    Raises `ValueError` for text without the mark of a MATLAB file, which is none: its sizes would mean nothing.
    """
    if 0 not in header[:4] and header[126:] not in (b"IM", b"MI"):
        raise ValueError("no mark of a MATLAB file")
    order = "<" if header[126:] == b"IM" else ">"
    newer = header[124:126] == (b"\x00\x02" if order == "<" else b"\x02\x00")
    return "" if 0 in header[:4] or newer else order


def _name_of_sound(data: bytes, order: str) -> bytes:
    elements = _elements(data, order)
    (_, flags), (_, _), (_, name) = (_expected(elements, kind) for kind in (_FLAGS, _DIMENSIONS, _NAME))
    if len(flags) != 8:
        raise ValueError("flags of another length")
    if struct.unpack(f"{order}I", flags[:4])[0] & 0xFF in _NUMERIC_CLASSES:
        for kind, content in elements:
            if kind not in _NUMBERS or len(content) % _NUMBERS[kind]:
                raise ValueError("numbers of no known type")
    return name


def _expected(elements: Iterator[tuple[int, bytes]], kind: int) -> tuple[int, bytes]:
    found = next(elements, (0, b""))
    if found[0] != kind:
        raise ValueError(f"an element of type {found[0]} in place of {kind}")
    return found


def _elements(data: bytes, order: str) -> Iterator[tuple[int, bytes]]:
    """The type and content of each element of an array; up to four bytes stand in the tag itself."""
    place = 0
    while place < len(data):
        if len(data) - place < 8:
            raise ValueError("an element that is cut off")
        kind, size = struct.unpack(f"{order}II", data[place : place + 8])
        start = place + 8
        if kind >> 16:
            kind, size, start = kind & 0xFFFF, kind >> 16, place + 4
        place = start + size + -(start + size) % 8
        if (size > 4 and start % 8) or start + size > len(data):
            raise ValueError("an element that is cut off")
        yield kind, data[start : start + size]
