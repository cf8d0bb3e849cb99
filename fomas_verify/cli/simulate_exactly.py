"""``simulate --digits`` and ``--enclose``: the trajectory beyond floats, which must agree with the one in floats."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING

import click

from fomas_verify.design import Design

if TYPE_CHECKING:
    from collections.abc import Callable

    from fomas_verify.simulate.laws import Law
    from fomas_verify.simulate.trajectory import Trajectory

DIGITS = 40
LONG_SAMPLES = 500


@dataclass(frozen=True)
class Beyond:
    """The table of what was computed beyond floats, and what to say of it."""

    csv: Iterable[bytes]
    lines: tuple[str, ...]


@contextmanager
def progress_bar(label: str, length: int, *, shown: bool) -> Iterator[Callable[[int], None]]:
    """A bar on standard error where that is a terminal; gives the function to be told what is done."""
    with click.progressbar(
        length=length, label=label, file=sys.stderr, hidden=not (shown and sys.stderr.isatty())
    ) as bar:
        yield lambda done: bar.update(done - bar.pos)


def to_digits(
    design: Design,
    laws: Sequence[Law],
    runs: Sequence[Trajectory],
    tuned: Fraction | None,
    *,
    between: int,
    digits: int,
) -> Beyond:
    """By mpmath."""
    from numpy import array

    from fomas_verify.simulate.against import check_same
    from fomas_verify.simulate.digits import simulate_to
    from fomas_verify.simulate.table import long_csv_parts

    found = []
    for law, run in zip(laws, runs, strict=True):
        with progress_bar(f"{law.name}, {digits} digits", run.last + 1, shown=run.last >= LONG_SAMPLES) as progress:
            long = simulate_to(
                design, law, run.last, digits, alpha_controller=tuned, between=between, progress=progress
            )  # fmt: skip
        check_same(run, array([[[float(x) for x in xs] for xs in row] for row in long.states]), "mpmath")
        found.append(long)
    return Beyond(long_csv_parts(found), ())


def enclosed(
    design: Design,
    laws: Sequence[Law],
    runs: Sequence[Trajectory],
    tuned: Fraction | None,
    *,
    between: int,
    digits: int,
    table: bool = True,
) -> Beyond:
    """By ball arithmetic; the table only where it is wanted."""
    from numpy import array

    from fomas_verify.enclosure.digits import rounded_up
    from fomas_verify.simulate.against import check_same
    from fomas_verify.simulate.enclosed import enclose
    from fomas_verify.simulate.table import tube_csv_parts

    tubes, lines = [], []
    for law, run in zip(laws, runs, strict=True):
        with progress_bar(f"{law.name}, enclosed digits", digits, shown=run.last >= LONG_SAMPLES) as progress:
            tube = enclose(
                design, law, run.last, alpha_controller=tuned, between=between, digits=digits, progress=progress
            )
        check_same(run, array([[[float(x.mid) for x in xs] for xs in row] for row in tube.states]), "the enclosure")
        lines.append(f"{law.name}: each state and input enclosed within {rounded_up(tube.widest, 2)}")
        tubes.append(tube)
    return Beyond(tube_csv_parts(tubes, digits) if table else (), tuple(lines))
