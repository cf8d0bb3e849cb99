"""``verify-design sweep``."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from fomas_verify.cli.limits import limited
from fomas_verify.cli.machine import ended_by_sigterm, processors
from fomas_verify.cli.options import allow_outside_option
from fomas_verify.design import CLAIM_IDS
from fomas_verify.report.files import make_folder, write_whole

if TYPE_CHECKING:
    from fomas_verify.sweep.plan import Plan
    from fomas_verify.sweep.run import Listener

FILE = click.Path(path_type=Path)
MOST_ROWS = 1_000_000


def _claims(_: click.Context, __: click.Parameter, value: str | None) -> tuple[str, ...] | None:
    names = None if value is None else tuple(value.split(","))
    for name in names or ():
        if name not in CLAIM_IDS:
            raise click.BadParameter(f"expected claim ids, got {name[:60]!r}")
    return names


def _fixed(_: click.Context, __: click.Parameter, value: tuple[str, ...]) -> dict[str, str]:
    for entry in value:
        if "=" not in entry:
            raise click.BadParameter(f"expected NAME=VALUE, such as gamma=0.15, got {entry[:60]!r}")
    return dict(entry.split("=", 1) for entry in value)


@click.command("sweep")
@click.argument("grid", type=FILE, metavar="GRID")
@click.option("-o", "--output", type=FILE, metavar="DIR", help="the dataset  [default: GRID with the ending .rows]")
@click.option("-j", "--jobs", type=click.IntRange(1, 512), metavar="N", help="processes  [default: a processor each]")
@click.option("--scheduler", metavar="ADDRESS", help="compute on the workers of this Dask scheduler")
@click.option("--claims", callback=_claims, metavar="IDS", help="decide these only, and require them (comma-separated)")
@click.option("--max-rows", type=click.IntRange(1), default=MOST_ROWS, show_default=True, help="refuse a larger grid")
@click.option("--part-rows", type=click.IntRange(1, 10**6), metavar="N", help="rows of a file  [default: by the grid]")
@click.option("--plot", type=FILE, metavar="FILE", help="a heat map of verdicts: .pdf, .png or .svg")
@click.option("--x", "across", metavar="NAME", help="its horizontal axis, a swept parameter")
@click.option("--y", "up", metavar="NAME", help="its vertical axis")
@click.option("--claim", type=click.Choice(CLAIM_IDS), metavar="ID", help="its claim  [default: average-consensus]")
@click.option("--at", multiple=True, callback=_fixed, metavar="NAME=VALUE", help="show the rows with this value only")
@allow_outside_option
@limited(keeps=True)
def command(
    grid: Path,
    output: Path | None,
    jobs: int | None,
    scheduler: str | None,
    claims: tuple[str, ...] | None,
    max_rows: int,
    part_rows: int | None,
    plot: Path | None,
    across: str | None,
    up: str | None,
    claim: str | None,
    at: dict[str, str],
    *,
    allow_outside: bool,
) -> int:
    """Decide every design of GRID, a design file with a table [grid] of what is swept, and write a Parquet dataset.

    Started again with the same GRID and DIR after any end, it computes what is missing.

    \b
    Example:  verify-design sweep examples/sweeps/grid.toml -o rows --plot rows.svg --x gamma --y h
    """
    from fomas_verify.sweep.grid import read_grid
    from fomas_verify.sweep.plan import make_plan
    from fomas_verify.sweep.run import run_sweep
    from fomas_verify.sweep.store import known_part_rows
    from fomas_verify.sweep.summary import summarize, summary_text

    folder = output or Path(f"{grid.stem}.rows")
    part_rows = part_rows or (known_part_rows(folder) if folder.is_dir() else None)
    read = read_grid(grid, allow_outside=allow_outside)
    plan = make_plan(read, only=claims, part_rows=part_rows, most_rows=max_rows)
    for remark in read.remarks:
        click.echo(f"note: graph: {remark}", err=True)
    if plot is not None and plot.resolve().parent == folder.resolve():
        raise click.UsageError("--plot needs a file outside of the dataset's folder")
    draw = _drawing(plan, plot, across, up, claim, at)
    make_folder(folder)
    with ended_by_sigterm(), _listener(folder) as listener:
        run_sweep(plan, folder, _write, listener, jobs=jobs or processors(), scheduler=scheduler)
    found = summarize(plan, folder)
    if plot is not None:
        write_whole(plot, draw(folder))
    click.echo(summary_text(plan, found))
    return found.exit_status


def _write(path: Path, data: bytes) -> None:
    write_whole(path, data, durable=True)


def _drawing(
    plan: Plan, plot: Path | None, across: str | None, up: str | None, claim: str | None, at: dict[str, str]
) -> Any:
    """What draws the heat map; refuses before the sweep what cannot be drawn after it."""
    if plot is None:
        for option, value in {"--x": across, "--y": up, "--claim": claim, "--at": at}.items():
            if value:
                raise click.UsageError(f"{option} is about the heat map: give --plot FILE too")
        return None
    from fomas_verify.sweep.heat_map import prepare

    if across is None or up is None:
        raise click.UsageError("--plot needs --x NAME and --y NAME, two swept parameters")
    return prepare(plan, plot.suffix[1:].lower(), across, up, claim, at)


@contextmanager
def _listener(folder: Path) -> Iterator[Listener]:
    """On a terminal a bar; at an interruption, where the rows are and how to go on, once the bar is gone."""
    from fomas_verify.sweep.run import Listener

    seen = [0, 0]
    try:
        with _bar() as (bar, say):

            def rows(done: int, total: int) -> None:
                seen[:] = done, total
                bar(done, total)

            yield Listener(rows, say)
    except (KeyboardInterrupt, SystemExit):
        if seen[1]:
            _say(f"interrupted: {seen[0]} of {seen[1]} rows are in {folder}; the same call computes the others")
        raise
    except Exception:
        if 0 < seen[0] < seen[1]:
            _say(f"{seen[0]} of {seen[1]} rows are in {folder}; the same call computes the others")
        raise


def _say(words: str) -> None:
    click.echo(f"verify-design: {words}", err=True)


def _no_bar(_done: int, _total: int) -> None:
    """Where there is no terminal."""


@contextmanager
def _bar() -> Iterator[tuple[Any, Any]]:
    """What is told the rows done and all rows, and what says words above the bar."""
    if sys.stderr is None or not sys.stderr.isatty():
        yield _no_bar, _say
        return
    try:
        from rich.console import Console
        from rich.progress import BarColumn, MofNCompleteColumn, Progress, TimeRemainingColumn
    except ImportError:
        yield _no_bar, _say
        return
    columns = (BarColumn(), MofNCompleteColumn(), "rows", TimeRemainingColumn())
    console = Console(stderr=True, markup=False, highlight=False, soft_wrap=True)
    if console.is_dumb_terminal:
        yield _no_bar, _say
        return
    with Progress(*columns, console=console, transient=True) as progress:
        task = progress.add_task("rows")
        yield (
            lambda done, total: progress.update(task, completed=done, total=total),
            lambda words: console.print(f"verify-design: {words}"),
        )
