"""``verify-design region``."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING

import click

from fomas_verify.cli.options import design_argument, json_option
from fomas_verify.design import Limits, read_design
from fomas_verify.region import Region, certificate, find_region, record, region_text
from fomas_verify.report.files import write_whole

if TYPE_CHECKING:
    from fomas_verify.region.polygon import Room

FORMATS = ("pdf", "png", "svg")


@click.command("region")
@design_argument
@click.option("-o", "--output", type=click.Path(path_type=Path), metavar="CERT.json", help="write the certificate")
@click.option("--plot", type=click.Path(path_type=Path), metavar="FILE", help="draw the strips: .pdf, .png or .svg")
@json_option
def command(design: Path, output: Path | None, plot: Path | None, *, as_json: bool) -> int:
    """Print on which mu, and so on which (gamma, h), each condition holds, every end of it certified.

    DESIGN needs no gamma and no h. With h the table shows the gamma that go with it, with gamma alone the h; with a
    table [limits] what they leave of each condition, or what clashes.

    \b
    Example:  verify-design region examples/paper.toml -o region.json
    """
    file_format = None if plot is None else _format(plot)
    found = find_region(read_design(design))
    left = _left(found)
    if plot is not None and file_format is not None:
        from fomas_verify.region.drawing import draw

        write_whole(plot, draw(found, file_format))
    if output is not None:
        write_whole(output, certificate(found).encode())
    click.echo(json.dumps(record(found, left), indent=2) if as_json else region_text(found, left))
    return 0


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
