"""The samples as a table: CSV with 17 digits, or Parquet; CSV with more digits, or with lower and upper ends.

Header ``k,t,controller,x_1,...,x_N,u_1,...,u_N`` (``x_1_1`` where an agent has several numbers; ``x_1_lower,x_1_upper``
for enclosures); rows sorted by k, then controller, then t, where points between the samples are asked for.
"""

from __future__ import annotations

import io
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, TypeAlias

import numpy as np

from fomas_verify.enclosure.digits import rounded_down, rounded_up
from fomas_verify.enclosure.interval import Interval
from fomas_verify.simulate.digits import LongTrajectory
from fomas_verify.simulate.enclosed import Tube
from fomas_verify.simulate.errors import SimulationError
from fomas_verify.simulate.memory import Array
from fomas_verify.simulate.trajectory import Trajectory

AT_ONCE = 1 << 16
"""About how many cells are made into text at once."""


@dataclass(frozen=True)
class Samples:
    """One controller's cells from sample ``first`` on, of ``count`` in all: a row of each sample's states, inputs, and
    states at each point of its interval.
    """

    controller: str
    h: float | Fraction
    count: int
    first: int
    states: list[list[Any]]
    inputs: list[list[Any]]
    between: list[list[list[Any]]]

    def rows(self, k: int) -> Iterator[tuple[int, float, str, list[Any]]]:
        """Those of sample k: the sample, then the points between it and the next; none beyond the end."""
        if k < self.count:
            yield k, float(k * self.h), self.controller, self.states[k - self.first] + self.inputs[k - self.first]
        if k + 1 < self.count:
            points = len(self.between) + 1
            for i, inside in enumerate(self.between, 1):
                t = k * self.h + i * self.h / points
                yield k, float(t), self.controller, inside[k - self.first] + self.inputs[k - self.first]


Source: TypeAlias = Callable[[int, int], Samples]
"""From the first sample and the one after the last to the samples."""


def header(agents: int, numbers: int, ends: Sequence[str] = ("",)) -> list[str]:
    """The names of the columns."""
    names = [f"{i}" if numbers == 1 else f"{i}_{d}" for i in range(1, agents + 1) for d in range(1, numbers + 1)]
    return ["k", "t", "controller", *(f"{letter}_{name}{end}" for letter in "xu" for name in names for end in ends)]


def csv_parts(runs: Sequence[Trajectory]) -> Iterator[bytes]:
    """The table as CSV, part after part; floats with 17 digits, which read back as the same floats."""
    shape = runs[0].states.shape
    names, longest = header(*shape[:2]), max(run.last + 1 for run in runs)
    return _csv(names, [_of_floats(run) for run in runs], longest, lambda x: format(x, ".17g"))


def long_csv_parts(runs: Sequence[LongTrajectory]) -> Iterator[bytes]:
    """The table with the digits that were asked for."""
    names = header(len(runs[0].states), len(runs[0].states[0]))
    return _csv(names, [_of_lists(run) for run in runs], _longest(runs), str)


def tube_csv_parts(tubes: Sequence[Tube], digits: int) -> Iterator[bytes]:
    """The table of enclosures: two columns for each number, rounded outward to so many digits. Rigorous."""

    def ends(x: Interval) -> str:
        return f"{rounded_down(x.lower, digits)},{rounded_up(x.upper, digits)}"

    names = header(len(tubes[0].states), len(tubes[0].states[0]), ("_lower", "_upper"))
    return _csv(names, [_of_lists(tube) for tube in tubes], _longest(tubes), ends)


def parquet_bytes(runs: Sequence[Trajectory]) -> bytes:
    """The rows of `csv_parts` as Parquet; raises `SimulationError` where pyarrow is missing."""
    try:
        import pyarrow
        from pyarrow import parquet
    except ImportError as error:
        raise SimulationError(
            f"Parquet needs {error.name}, which the extra `sweep` brings: pip install 'fomas_verify[sweep]'"
        ) from None
    names = header(*runs[0].states.shape[:2])
    rows = list(_rows([_of_floats(run) for run in runs], 0, max(run.last + 1 for run in runs)))
    numbers = np.array([row[3] for row in rows])
    columns: dict[str, Any] = {name: [row[i] for row in rows] for i, name in enumerate(names[:3])}
    columns |= {name: numbers[:, i] for i, name in enumerate(names[3:])}
    stream = io.BytesIO()
    parquet.write_table(pyarrow.table(columns), stream)
    return stream.getvalue()


def _csv(names: Sequence[str], runs: Sequence[Source], count: int, cell: Callable[[Any], str]) -> Iterator[bytes]:
    yield (",".join(names) + "\n").encode()
    some = max(1, AT_ONCE // (len(names) * len(runs)))
    for start in range(0, count, some):
        rows = _rows(runs, start, min(start + some, count))
        lines = [f"{k},{t:.17g},{controller},{','.join(map(cell, cells))}\n" for k, t, controller, cells in rows]
        yield "".join(lines).encode()


def _rows(runs: Sequence[Source], start: int, stop: int) -> Iterator[tuple[int, float, str, list[Any]]]:
    parts = sorted((run(start, stop) for run in runs), key=lambda part: part.controller)
    for k in range(start, stop):
        for part in parts:
            yield from part.rows(k)


def _of_floats(run: Trajectory) -> Source:
    def samples(start: int, stop: int) -> Samples:
        def rows(x: Array) -> list[list[float]]:
            found: list[list[float]] = x[..., start:stop].reshape(x.shape[0] * x.shape[1], -1).T.tolist()
            return found

        parts = rows(run.states), rows(run.inputs), [rows(x) for x in run.between]
        return Samples(run.controller, run.h, run.last + 1, start, *parts)

    return samples


def _of_lists(run: LongTrajectory | Tube) -> Source:
    def samples(start: int, stop: int) -> Samples:
        def rows(part: Sequence[Sequence[Sequence[Any]]]) -> list[list[Any]]:
            return [list(cells) for cells in zip(*(xs[start:stop] for row in part for xs in row), strict=True)]

        parts = rows(run.states), rows(run.inputs), [rows(x) for x in run.between]
        return Samples(run.controller, run.h, _longest([run]), start, *parts)

    return samples


def _longest(runs: Sequence[LongTrajectory | Tube]) -> int:
    return max(len(run.states[0][0]) for run in runs)
