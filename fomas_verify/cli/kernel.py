"""``verify-design kernel``."""

from __future__ import annotations

import csv
import io
import json
from pathlib import Path

import click

from fomas_verify.cli.limits import limited
from fomas_verify.cli.options import allow_outside_option, design_argument, digits_option, json_option
from fomas_verify.design import read_single
from fomas_verify.enclosure.digits import decimal
from fomas_verify.enclosure.interval import Interval
from fomas_verify.kernel.table import Row, kernel_rows

LARGEST_J = 10**30
HEADER = ("j", "f", "c", "partial_sum", "r")


@click.command("kernel")
@design_argument
@click.option("--terms", type=click.IntRange(1, 20_000), metavar="J", help="j = 1..J  [default: 10]")
@click.option("--at", "at", metavar="J1,J2", help="these j instead, or besides")
@digits_option
@click.option("--csv", "csv_file", type=click.Path(path_type=Path), metavar="FILE", help="write the rows to a CSV file")
@allow_outside_option
@json_option
@limited()
def command(
    design: Path,
    terms: int | None,
    at: str | None,
    digits: int,
    csv_file: Path | None,
    *,
    allow_outside: bool,
    as_json: bool,
) -> int:
    """Print f(j), c_j, the partial sums of abs f and the resolvent r_j for the order alpha of DESIGN.

    Numbers are truncated: every digit shown is a digit of the exact number. f(0) = c_0 = r_0 = 1.

    \b
    Example:  verify-design kernel examples/paper.toml --terms 5 --at 1000000000000 --digits 30
    """
    chosen = _indices(at) if at is not None else []
    indices = sorted({*range(1, (terms or (0 if chosen else 10)) + 1), *chosen})
    alpha = read_single(design, allow_outside=allow_outside).alpha
    rows = [_cells(row, digits) for row in kernel_rows(alpha, indices, digits)]
    if csv_file is not None:
        from fomas_verify.report.files import write_whole

        text = io.StringIO()
        csv.writer(text, lineterminator="\n").writerows(
            [HEADER, *([x.replace("...", "") for x in row] for row in rows)]
        )
        write_whole(csv_file, text.getvalue().encode())
    elif as_json:
        click.echo(json.dumps([_record(row) for row in rows], indent=2))
    else:
        _print_table(rows)
    return 0


def _record(row: tuple[str, ...]) -> dict[str, int | str | None]:
    """A row by its names; the numbers stay text, since no binary float holds their digits."""
    return {"j": int(row[0])} | {
        name: x.replace("...", "") or None for name, x in zip(HEADER[1:], row[1:], strict=True)
    }


def _print_table(rows: list[tuple[str, ...]]) -> None:
    widths = [max(len(row[i]) for row in [HEADER, *rows]) for i in range(len(HEADER))]
    for row in [HEADER, *rows]:
        click.echo("  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip())


def _indices(text: str) -> list[int]:
    parts = text.split(",")
    if not all(part.strip().isascii() and part.strip().isdigit() and len(part) <= 40 for part in parts):
        raise click.BadParameter(
            f"expected positive whole numbers separated by commas, got {text[:40]!r}", param_hint="--at"
        )
    found = [int(part) for part in parts]
    if not all(1 <= j <= LARGEST_J for j in found):
        raise click.BadParameter("expected numbers from 1 to 10^30", param_hint="--at")
    return found


def _cells(row: Row, digits: int) -> tuple[str, ...]:
    def cell(x: Interval | None) -> str:
        return "" if x is None else decimal(x, digits)

    return (str(row.j), cell(row.f), cell(row.c), cell(row.partial_sum), cell(row.r))
