"""``verify-design region``."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING

import click

from fomas_verify.cli.limits import limited
from fomas_verify.cli.options import allow_outside_option, design_argument, json_option, tell_notes
from fomas_verify.design import DesignError, LargeDesign, Limits, SwitchedDesign, UncertainDesign, read_named
from fomas_verify.region import Region, certificate, find_region, record, region_text
from fomas_verify.report.files import write_all, write_whole

if TYPE_CHECKING:
    from fomas_verify.region.polygon import Room

FORMATS = ("pdf", "png", "svg")


@click.command("region")
@design_argument
@click.option("-o", "--output", type=click.Path(path_type=Path), metavar="CERT.json", help="write the certificate")
@click.option("--plot", type=click.Path(path_type=Path), metavar="FILE", help="draw the strips: .pdf, .png or .svg")
@click.option(
    "--solver",
    type=click.Choice(["direct", "lmi"]),
    default="direct",
    show_default=True,
    help="lmi: hold what was found against the LMI, solved by clarabel",
)
@allow_outside_option
@json_option
@limited()
def command(
    design: Path, output: Path | None, plot: Path | None, solver: str, *, allow_outside: bool, as_json: bool
) -> int:
    """Print on which mu, and so on which (gamma, h), each condition holds, every end of it certified.

    DESIGN needs no gamma and no h. With h the table shows the gamma that go with it, with gamma alone the h; with a
    table [limits] what they leave of each condition, or what clashes.

    \b
    Example:  verify-design region examples/paper.toml -o region.json
    """
    file_format = None if plot is None else _format(plot)
    named = read_named(design, allow_outside=allow_outside)
    tell_notes(named)
    if isinstance(named, UncertainDesign):
        where = next(iter(named.ranges))
        only = "only prove, check and gate take one"
        raise DesignError(f"{named.least.source}: {where}: expected a number, got an interval: {only}")
    if isinstance(named, SwitchedDesign):
        for option, asked in {"--plot": plot is not None, "--solver": solver == "lmi"}.items():
            if asked:
                raise DesignError(f"{named.first.source}: {option} is not supported yet with [[graphs]]")
        return _switched(named, output, as_json=as_json)
    if solver == "lmi":
        from fomas_verify.region.lmi import need_solver

        need_solver()
    found = find_region(named.listed() if isinstance(named, LargeDesign) else named)
    if solver == "lmi":
        _hold_against_lmi(found)
    left = _left(found)
    drawn = {}
    if plot is not None and file_format is not None:
        from fomas_verify.region.drawing import draw

        drawn[plot] = draw(found, file_format)
    write_all(drawn, {output: certificate(found).encode()} if output is not None else {})
    click.echo(json.dumps(record(found, left), indent=2) if as_json else region_text(found, left))
    return 0


def _switched(design: SwitchedDesign, output: Path | None, *, as_json: bool) -> int:
    from fomas_verify.region.switching_region import find_switched_region
    from fomas_verify.report.switched_text import switched_region_text

    found = find_switched_region(design)
    if output is not None:
        write_whole(output, found.certificate().encode())
    click.echo(json.dumps(found.record(), indent=2) if as_json else switched_region_text(found))
    return 0


def _hold_against_lmi(found: Region) -> None:
    """Say on standard error what the LMI confirms and of what it gives no usable answer."""
    from fomas_verify.region.agreement import agreement

    told = agreement(found)
    if told.agreed:
        click.echo(f"the LMI agrees: {', '.join(told.agreed)}", err=True)
    for reason in told.failed:
        click.echo(f"no answer from the LMI, the direct search stands: {reason}", err=True)


def _left(found: Region) -> tuple[Room, ...]:
    """What the limits leave, where the design gives limits."""
    if found.loop.design.limits == Limits():
        return ()
    from fomas_verify.region.polygon import rooms

    return rooms(found)


def _format(plot: Path) -> str:
    """The format that the name of a figure's file asks for."""
    ending = plot.suffix[1:].lower()
    if ending not in FORMATS:
        raise click.BadParameter(
            f"expected a name that ends in .pdf, .png or .svg, got {plot.name!r}", param_hint="--plot"
        )
    return ending
