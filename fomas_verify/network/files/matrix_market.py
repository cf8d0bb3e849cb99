"""Matrix Market files, coordinate or array: scipy reads the header; the numbers are exact as they are written.

A symmetric matrix stores each pair once and means both ways. Source: the NIST description of the exchange format.
"""

from __future__ import annotations

from pathlib import Path
from typing import IO, TYPE_CHECKING, Any, Final

from fomas_verify.network.files.entries import Entries
from fomas_verify.network.files.lines import LineError, Lines, read_lines
from fomas_verify.network.files.refusals import need_extra, reading, refused
from fomas_verify.network.files.weights import ratios_of_texts

if TYPE_CHECKING:
    from numpy.typing import NDArray

EXPECTED: Final = "a Matrix Market file"

_FIELDS = ("real", "integer", "unsigned-integer", "double", "pattern")


def read(path: Path, name: str) -> Entries:
    """Read a Matrix Market file; raises `GraphFileError`."""
    need_extra("numpy", "scipy.io")
    from scipy.io import mminfo

    with reading(path, name, EXPECTED, EXPECTED):
        rows, columns, stored, form, kind, symmetry = mminfo(path)
    if kind not in _FIELDS:
        raise refused(name, "a matrix of real numbers", f"one whose field is {kind}")
    if symmetry not in ("general", "symmetric"):
        raise refused(name, "a general or symmetric matrix", f"one that is {symmetry}")
    if rows != columns:
        raise refused(name, "a square matrix", f"{rows} x {columns}")
    with path.open("rb") as file:
        line = _skip_head(file)
        try:
            if form == "array":
                return _array(file, rows, symmetry == "symmetric", name)
            lines = read_lines(file, line, 2 if kind == "pattern" else 3)
        except LineError as error:
            expected = "row and column" if kind == "pattern" else "row, column and weight"
            raise refused(f"{name}: line {error.line}", expected, error.got) from None
    return _coordinates(lines, rows, stored, symmetry == "symmetric", name)


def _skip_head(file: IO[bytes]) -> int:
    """Leave the file after its line of sizes; the number of the next line."""
    for number, line in enumerate(file, 1):
        if line.strip() and not line.lstrip().startswith(b"%"):
            return number + 1
    return 1


def _coordinates(lines: Lines, agents: int, stored: int, symmetric: bool, name: str) -> Entries:
    if lines.first.size != stored:
        raise refused(name, f"{stored} entries, as its header says", f"{lines.first.size}")
    return Entries(agents, lines.first - 1, lines.second - 1, lines.codes, lines.ratios, lines.place, symmetric)


def _array(file: IO[bytes], agents: int, symmetric: bool, name: str) -> Entries:
    """A dense matrix, column after column, of a symmetric one the lower triangle."""
    import numpy as np

    texts = file.read().split()
    count = agents * (agents + 1) // 2 if symmetric else agents**2
    if len(texts) != count:
        raise refused(name, f"{count} numbers, as its header says", f"{len(texts)}")
    rows, columns = _lower(agents) if symmetric else _full(agents)
    index: dict[bytes, int] = {}
    codes = np.fromiter((index.setdefault(text, len(index)) for text in texts), np.int64, len(texts))
    return Entries(
        agents, rows, columns, codes, lambda: ratios_of_texts(text.decode("latin-1") for text in index),
        lambda entry: f"row {rows[entry] + 1}, column {columns[entry] + 1}", symmetric,
    )  # fmt: skip


def _full(agents: int) -> tuple[NDArray[Any], NDArray[Any]]:
    import numpy as np

    columns, rows = np.divmod(np.arange(agents * agents, dtype=np.int64), agents)
    return rows, columns


def _lower(agents: int) -> tuple[NDArray[Any], NDArray[Any]]:
    import numpy as np

    columns, rows = np.triu_indices(agents)
    return rows.astype(np.int64), columns.astype(np.int64)
