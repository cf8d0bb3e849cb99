"""Adjacency matrices as comma-separated values, a row a line, exact as they are written.

A first line that begins with an empty cell names the columns, and each line then begins with the same name, as pandas
writes them; `#` begins a comment, as numpy writes it.
"""

from __future__ import annotations

import csv
from collections.abc import Iterator
from pathlib import Path
from typing import Final

from fomas_verify.exact.rational import excerpt
from fomas_verify.network.files.entries import Entries
from fomas_verify.network.files.names import numbering
from fomas_verify.network.files.refusals import lies, need_extra, refused
from fomas_verify.network.files.weights import ratios_of_texts

EXPECTED: Final = "a matrix of comma-separated numbers"

Row = tuple[int, list[str]]


def read(path: Path, name: str) -> Entries:
    """Read an adjacency matrix; raises `GraphFileError`."""
    need_extra("numpy")
    import numpy as np

    rows: list[int] = []
    columns: list[int] = []
    codes: list[int] = []
    lines: list[int] = []
    index: dict[str, int] = {}
    names: list[str] = []
    width = 0
    for number, cells in _numbers(path, name, names):
        width = len(cells)
        for column, cell in enumerate(cells):
            if cell != "0":
                rows.append(len(lines))
                columns.append(column)
                codes.append(index.setdefault(cell.strip(), len(index)))
        lines.append(number)
    if width < 2:
        raise lies(path, name, f"{EXPECTED}, 2 x 2 at least", "a single column" if lines else "no row of numbers")
    if len(lines) != width:
        raise refused(name, "a square matrix", f"{len(lines)} x {width}")
    order, remarks = numbering(_different(names, name)) if names else (list(range(width)), ())
    places = np.array(order, dtype=np.int64)
    return Entries(
        width, places[rows], places[columns], np.array(codes, dtype=np.int64), lambda: ratios_of_texts(index),
        lambda entry: f"line {lines[rows[entry]]}, column {columns[entry] + 1}", remarks=remarks,
    )  # fmt: skip


def _numbers(path: Path, name: str, names: list[str]) -> Iterator[Row]:
    """The rows without their names; the names, where there are any, are put into `names` before the first."""
    width = 0
    row = 0
    for number, cells in _rows(path, name):
        if not width:
            width = len(cells)
            if width > 1 and not cells[0].strip():
                names += [cell.strip() for cell in cells[1:]]
                continue
        if len(cells) != width:
            raise refused(f"{name}: line {number}", f"{width} cells, as in the first line", str(len(cells)))
        yield number, _without_name(cells, names, row, f"{name}: line {number}") if names else cells
        row += 1


def _rows(path: Path, name: str) -> Iterator[Row]:
    """The lines that hold something, with their numbers."""
    try:
        with path.open(encoding="utf-8-sig", newline="") as file:
            reader = csv.reader(file, strict=True)
            for cells in reader:
                if cells and not cells[0].lstrip().startswith("#") and any(cell.strip() for cell in cells):
                    yield reader.line_num, cells
    except UnicodeDecodeError:
        raise lies(path, name, EXPECTED, "a text that is not UTF-8") from None
    except csv.Error as error:
        raise lies(path, name, EXPECTED, str(error)) from None


def _without_name(cells: list[str], names: list[str], row: int, where: str) -> list[str]:
    expected = names[row] if row < len(names) else None
    if cells[0].strip() != expected:
        wanted = "no further line" if expected is None else f"the name {excerpt(expected)}, as of its column"
        raise refused(where, wanted, excerpt(cells[0]))
    return cells[1:]


def _different(names: list[str], name: str) -> list[str]:
    if len(set(names)) != len(names):
        twice = next(x for i, x in enumerate(names) if x in names[:i])
        raise refused(name, "columns with different names", f"{excerpt(twice)} twice")
    return names
