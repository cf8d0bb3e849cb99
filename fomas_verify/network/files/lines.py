"""Lines of numbers ``i j`` or ``i j weight``, a block at a time: memory beyond the result stays flat.

The first two are integers; a weight is kept as it is written, each different text once.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import IO, TYPE_CHECKING, Any, Final

from fomas_verify.exact.rational import excerpt
from fomas_verify.network.files.weights import Ratio, ratios_of_texts

if TYPE_CHECKING:
    from numpy.typing import NDArray

BLOCK: Final = 1 << 24
LONGEST_LINE: Final = 1 << 20

_NEWLINE = 10
_INTEGER, _PLAIN = re.compile(rb"[+-]?[0-9]{1,18}"), re.compile(rb"0|-?[1-9][0-9]{0,17}")
_SPACES: Final = b" \t\n\r\x0b\x0c"


class LineError(ValueError):
    """A line that is none of these; `line` counts from 1."""

    def __init__(self, line: int, got: str) -> None:
        super().__init__(got)
        self.line, self.got = line, got


@dataclass(eq=False)
class Lines:
    """What the lines hold: entry e is ``first[e] second[e] texts[codes[e]]``, on line ``numbers[e]``."""

    first: NDArray[Any]
    second: NDArray[Any]
    codes: NDArray[Any]
    numbers: NDArray[Any]
    columns: int
    texts: list[bytes] = field(default_factory=list)

    def place(self, entry: int) -> str:
        """Where an entry stands."""
        return f"line {self.numbers[entry]}"

    def ratios(self) -> list[Ratio]:
        """The different weights; 1 where no line has one."""
        if self.columns == 2:
            return [(1, 1)]
        return ratios_of_texts(b"\n".join(self.texts).decode("latin-1").split("\n") if self.texts else ())


def read_lines(
    file: IO[bytes],
    line: int = 1,
    columns: int | None = None,
    *,
    clean: Callable[[bytes], bytes] | None = None,
    plain: bool = False,
) -> Lines:
    """Read the lines of a file from where it stands.

    Parameters
    ----------
    file : binary file
        Its next byte begins the line with number `line`.
    columns : int, optional
        How many numbers each line has; by default 2 or 3, as the first line has.
    clean : callable, optional
        What is done to each block first; it must keep every newline.
    plain : bool
        Whether an integer with leading zeros or a plus sign is refused.

    Raises
    ------
    LineError
        A line has another number of columns, or an end that is no integer.
    """
    import numpy as np

    index: dict[bytes, int] = {}
    parts: list[tuple[NDArray[Any], ...]] = []
    for raw in _blocks(file):
        block = raw if clean is None else clean(raw)
        counts, rows = _counts(block)
        if rows.size:
            columns = _columns(counts, rows, line, columns)
            parts.append(_parsed(block.split(), columns, rows + line, index, plain=plain))
        line += len(counts)
    if not parts or columns is None:
        empty = np.zeros(0, dtype=np.int64)
        return Lines(empty, empty, empty, empty, columns or 2)
    first, second, codes, numbers = (np.concatenate(arrays) for arrays in zip(*parts, strict=True))
    return Lines(first, second, codes, numbers, columns, list(index))


def _blocks(file: IO[bytes]) -> Iterator[bytes]:
    """The rest of a file in pieces of whole lines, the last one ended too."""
    rest = b""
    while data := file.read(BLOCK):
        data = rest + data
        end = data.rfind(b"\n") + 1
        if end == 0 and len(data) > LONGEST_LINE:
            raise LineError(0, f"a line of more than {LONGEST_LINE} characters")
        if end:
            yield data[:end]
        rest = data[end:]
    if rest:
        yield rest + b"\n"


def _counts(block: bytes) -> tuple[NDArray[Any], NDArray[Any]]:
    """How many words each line has, and which lines have any."""
    import numpy as np

    table = np.zeros(256, dtype=bool)
    table[list(_SPACES)] = True
    characters = np.frombuffer(block, dtype=np.uint8)
    blank = table[characters]
    starts = np.flatnonzero(blank[:-1] & ~blank[1:]) + 1
    if not blank[0]:
        starts = np.concatenate([[0], starts])
    counts = np.diff(np.searchsorted(starts, np.flatnonzero(characters == _NEWLINE)), prepend=0)
    return counts, np.flatnonzero(counts)


def _columns(counts: NDArray[Any], rows: NDArray[Any], line: int, columns: int | None) -> int:
    found = int(counts[rows[0]]) if columns is None else columns
    bad = rows[counts[rows] != found]
    if found not in (2, 3) or bad.size:
        row = int(bad[0] if bad.size else rows[0])
        raise LineError(line + row, f"{counts[row]} words")
    return found


def _parsed(
    words: list[bytes], columns: int, numbers: NDArray[Any], index: dict[bytes, int], *, plain: bool
) -> tuple[Any, ...]:
    import numpy as np

    count = len(numbers)
    ends = [_integers(words[end::columns], numbers, plain=plain) for end in (0, 1)]
    if columns == 2:
        return (*ends, np.zeros(count, dtype=np.int64), numbers)
    codes = np.fromiter((index.setdefault(word, len(index)) for word in words[2::columns]), np.int64, count)
    return (*ends, codes, numbers)


def _integers(words: list[bytes], numbers: NDArray[Any], *, plain: bool) -> NDArray[Any]:
    import numpy as np

    try:
        found = np.fromiter(map(int, words), np.int64, len(words))
    except (ValueError, OverflowError):
        found = None
    if found is None or sum(map(len, words)) != _width(found):
        pattern = _PLAIN if plain else _INTEGER
        for position, word in enumerate(words):
            if not pattern.fullmatch(word):
                raise LineError(int(numbers[position]), excerpt(word.decode("utf-8", "replace")))
    if found is None:
        raise LineError(int(numbers[0]), "an integer that is too large")
    return found


def _width(integers: NDArray[Any]) -> int:
    """How many characters they have without leading zeros and plus signs."""
    import numpy as np

    digits = np.searchsorted(np.array([10**k for k in range(1, 19)]), np.abs(integers), side="right") + 1
    return int(digits.sum() + (integers < 0).sum())
