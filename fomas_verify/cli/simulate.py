"""``verify-design simulate``."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction
from importlib import import_module
from pathlib import Path
from textwrap import fill
from typing import TYPE_CHECKING

import click

from fomas_verify.cli.certified import Certified, certified_of
from fomas_verify.cli.limits import limited
from fomas_verify.cli.options import Count, allow_outside_option, design_argument, json_option
from fomas_verify.cli.simulate_exactly import DIGITS, Beyond, enclosed, progress_bar, to_digits
from fomas_verify.design import Design, DesignError, LargeDesign, read_single
from fomas_verify.enclosure.digits import decimal
from fomas_verify.enclosure.interval import Interval

if TYPE_CHECKING:
    from fomas_verify.simulate.laws import Law
    from fomas_verify.simulate.plant import Plant
    from fomas_verify.simulate.trajectory import Trajectory

CONTROLLERS = ("proposed", "memoryless", "truncated")
MOST_AGENTS = 100_000
LONG = 20_000_000
"""Samples times agents from which on progress is shown."""

POINTS_IN_FIGURES = 9
FILE = click.Path(path_type=Path)


class ExtraMissingError(DesignError):
    """A library that a command needs is not installed."""


def controllers(_: click.Context, __: click.Parameter, value: str) -> tuple[str, ...]:
    """The names, each once."""
    names = tuple(dict.fromkeys(part.strip() for part in value.split(",")))
    for name in names:
        if name not in CONTROLLERS:
            raise click.BadParameter(f"expected some of {', '.join(CONTROLLERS)}, got {name[:40]!r}")
    return names


def order(_: click.Context, __: click.Parameter, value: str | None) -> Fraction | None:
    """An order between 0 and 1, exact."""
    if value is None:
        return None
    try:
        found = Fraction(value) if len(value) <= 40 and "e" not in value.lower() else Fraction(0)
    except (ValueError, ZeroDivisionError):
        found = Fraction(0)
    if not 0 < found < 1:
        raise click.BadParameter(f"expected a number between 0 and 1, such as 0.85 or 17/20, got {value[:40]!r}")
    return found


@click.command("simulate")
@design_argument
@click.option("--samples", type=Count(min=1), default=200, show_default=True, metavar="K", help="samples k = 0..K")
@click.option(
    "--controller", "names", default="proposed,memoryless", show_default=True, callback=controllers, metavar="NAMES",
    help="some of proposed, memoryless, truncated",
)  # fmt: skip
@click.option("--between", type=click.IntRange(0, 10_000), default=0, metavar="M", help="M points inside each interval")
@click.option("--keep", type=click.IntRange(0), metavar="M", help="truncated: the last M inputs are kept")
@click.option("--alpha-controller", callback=order, metavar="ALPHA", help="order that the controllers are tuned for")
@click.option("--digits", type=click.IntRange(17, 10_000), metavar="D", help="digits of the CSV file, by mpmath")
@click.option("--enclose", is_flag=True, help="lower and upper ends of each number, rigorous, in the CSV file")
@click.option("--csv", "csv_file", type=FILE, metavar="FILE", help="write the samples to a CSV file")
@click.option("--parquet", type=FILE, metavar="FILE", help="write them to a Parquet file")
@allow_outside_option
@json_option
@click.option("--plot", type=FILE, metavar="DIR", help="draw the paper's figures and two more into DIR")
@click.option(
    "--format", "file_format", type=click.Choice(["pdf", "png", "svg"]), default="pdf", show_default=True,
    help="of the figures",
)  # fmt: skip
@limited()
def command(
    design: Path,
    samples: int,
    names: tuple[str, ...],
    between: int,
    keep: int | None,
    alpha_controller: Fraction | None,
    digits: int | None,
    csv_file: Path | None,
    parquet: Path | None,
    plot: Path | None,
    file_format: str,
    *,
    enclose: bool,
    allow_outside: bool,
    as_json: bool,
) -> int:
    """Simulate the closed loop of DESIGN: the exact sampled plant under one controller or several.

    The controllers are the paper's (proposed), the memory-free law of Yu et al. as the paper describes it (memoryless)
    and the paper's with only its last inputs kept (truncated). Numbers are floats, or have D digits, or
    are enclosed. What is certified of the design is compared with the paper's loop: a mismatch is exit status 4.

    \b
    Example:  verify-design simulate examples/paper.toml --samples 200 --csv loop.csv --plot figures
    """
    _must_go_together(names, keep, csv_file, parquet, digits, enclose=enclose)
    read = _read(design, allow_outside=allow_outside)
    plant = _plant(read)
    points = max(between, POINTS_IN_FIGURES if plot is not None else 0)
    _must_fit(plant, samples, len(names), points, table=parquet is not None or enclose or digits is not None)
    laws = [_law(name, keep) for name in names]
    runs = _runs(plant, laws, samples, alpha_controller, between)
    known = certified_of(read)
    if alpha_controller not in (None, read.alpha):
        known = known.without_bounds("the controller is tuned for another order than the plant's")
    compared, beyond = _compared(plant, runs, known), None
    if enclose:
        beyond = enclosed(read, laws, runs, alpha_controller, between=between, digits=digits or DIGITS,
                          table=csv_file is not None)  # fmt: skip
    elif digits is not None:
        beyond = to_digits(read, laws, runs, alpha_controller, between=between, digits=digits)
    _write(runs, csv_file, parquet, beyond, {} if plot is None else _figures(plant, runs, known, plot, file_format))
    remarks = (compared, *(beyond.lines if beyond else ()))
    for line in (_json(read, runs, known, remarks),) if as_json else (*_lines(read, runs, known, keep), *remarks):
        click.echo(line)
    return 0


def _must_go_together(
    names: tuple[str, ...],
    keep: int | None,
    csv_file: Path | None,
    parquet: Path | None,
    digits: int | None,
    *,
    enclose: bool,
) -> None:
    if ("truncated" in names) != (keep is not None):
        raise click.UsageError("--keep M says how many inputs the controller truncated keeps: give both or neither")
    if csv_file is not None and parquet is not None and csv_file.resolve() == parquet.resolve():
        raise click.UsageError("--csv and --parquet need a file each")
    if digits is not None and csv_file is None:
        raise click.UsageError("--digits D says how many digits the CSV file has: give --csv FILE too")
    if parquet is not None and (digits is not None or enclose):
        raise click.UsageError("--parquet holds floats: leave out --digits and --enclose")


def _read(path: Path, *, allow_outside: bool) -> Design:
    found = read_single(path, allow_outside=allow_outside)
    return found.listed(most=MOST_AGENTS) if isinstance(found, LargeDesign) else found


def _plant(design: Design) -> Plant:
    for name in ("numpy", "scipy"):
        try:
            import_module(name)
        except ImportError:
            raise ExtraMissingError(
                f"simulate needs {name}, which the extra `simulate` brings: pip install 'fomas_verify[simulate]'"
            ) from None
    from fomas_verify.simulate.plant import plant_of

    return plant_of(design)


def _must_fit(plant: Plant, samples: int, controllers: int, between: int, *, table: bool) -> None:
    from fomas_verify.simulate.need import available_bytes, must_fit, needed_bytes

    needed = needed_bytes(plant.x0.size, samples, controllers=controllers, between=between, table=table)
    must_fit(needed, available_bytes(), samples)


def _law(name: str, keep: int | None) -> Law:
    from fomas_verify.simulate.laws import MEMORYLESS, PROPOSED, truncated

    if keep is not None and name == "truncated":
        return truncated(keep)
    return {law.name: law for law in (PROPOSED, MEMORYLESS)}[name]


def _runs(plant: Plant, laws: Sequence[Law], samples: int, tuned: Fraction | None, between: int) -> list[Trajectory]:
    from fomas_verify.simulate.loop import simulate, with_between

    alpha, runs = None if tuned is None else float(tuned), []
    for law in laws:
        with progress_bar(law.name, samples + 1, shown=samples * plant.x0.size >= LONG) as progress:
            run = simulate(plant, law, samples, alpha_controller=alpha, progress=progress)
        runs.append(with_between(plant, run, between))
    return runs


def _compared(plant: Plant, runs: Sequence[Trajectory], known: Certified) -> str:
    """Every trajectory against the plant, the paper's against what is certified; in words."""
    from fomas_verify.simulate.against import check_against, check_driven

    for run in runs:
        check_driven(plant, run)
    for run in runs:
        if run.controller == "proposed":
            if known.bounds is None:
                return f"proposed: nothing certified to compare with: {known.reason}"
            names = ", ".join(x.name for x in check_against(run, known.bounds))
            return fill(f"proposed: bounded at every sample as certified: {names}", 116, subsequent_indent="  ")
    return "nothing is certified of the controllers simulated here"


def _write(
    runs: Sequence[Trajectory],
    csv_file: Path | None,
    parquet: Path | None,
    beyond: Beyond | None,
    figures: dict[Path, bytes],
) -> None:
    from fomas_verify.report.files import make_folder, write_all
    from fomas_verify.simulate.table import csv_parts, parquet_bytes

    contents: dict[Path, bytes | Iterable[bytes]] = {}
    if csv_file is not None:
        contents[csv_file] = csv_parts(runs) if beyond is None else beyond.csv
    if parquet is not None:
        contents[parquet] = parquet_bytes(runs)
    for folder in {path.parent for path in figures}:
        make_folder(folder)
    write_all(figures, contents)


def _figures(
    plant: Plant, runs: Sequence[Trajectory], known: Certified, folder: Path, file_format: str
) -> dict[Path, bytes]:
    from numpy import array

    from fomas_verify.simulate.drawing import draw
    from fomas_verify.simulate.figures import panels
    from fomas_verify.simulate.loop import with_between

    dense = [with_between(plant, run, POINTS_IN_FIGURES) for run in runs]
    limit = None if known.limit is None else array([float(x) for x in known.limit])
    drawn = panels(dense, plant.alpha, limit, known.beta, known.bounds)
    return {folder / f"{panel.name}.{file_format}": draw(panel, file_format) for panel in drawn}


def _json(design: Design, runs: Sequence[Trajectory], known: Certified, remarks: Sequence[str]) -> str:
    from fomas_verify.simulate.record import simulation_json

    return simulation_json(design, runs, known.limit, [" ".join(line.split()) for line in remarks])


def _lines(design: Design, runs: Sequence[Trajectory], known: Certified, keep: int | None) -> Iterator[str]:
    from numpy import array

    from fomas_verify.simulate import summary

    last = max(run.last for run in runs)
    numbers = {"alpha": design.alpha, "gamma": design.gamma, "mu": design.mu, "h": design.h}
    given = ", ".join(f"{name} = {decimal(Interval.exactly(x), 20)}" for name, x in numbers.items() if x is not None)
    yield f"{design.name}: {given}; {design.graph.agents} agents, k = 0..{last}, t = 0..{last * runs[0].h:.8g} s"
    yield from (f"note: {note}" for note in design.notes)
    limit = None if known.limit is None else array([float(x) for x in known.limit])
    yield from summary.table(runs, limit)
    yield summary.limit_line(known.limit)
    if keep is not None:
        yield from summary.truncation(float(design.alpha), keep)
    for run in runs:
        if run.stopped:
            yield summary.stopped(run)
