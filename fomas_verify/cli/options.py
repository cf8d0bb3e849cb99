"""Arguments and options that several commands share."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    from fomas_verify.design import AnyDesign


class Count(click.IntRange):
    """A whole number, which may be written as a power of ten too: ``10^7``, ``1e7``."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """The number."""
        match = re.fullmatch(r"(?:10\^|([1-9]\d{0,2})e)(\d{1,2})", value, re.ASCII) if isinstance(value, str) else None
        return super().convert(int(match[1] or 1) * 10 ** int(match[2]) if match else value, param, ctx)


design_argument = click.argument("design", type=click.Path(path_type=Path), metavar="DESIGN")
digits_option = click.option(
    "--digits", type=click.IntRange(20, 5_000), default=50, show_default=True, help="significant digits of the values"
)
allow_outside_option = click.option(
    "--allow-outside", is_flag=True, help="a graph file may lie outside the folder of its design"
)
json_option = click.option("--json", "as_json", is_flag=True, help="print JSON in place of the table")


def tell_notes(named: AnyDesign) -> None:
    """Say on standard error what the user must know about the reading of a design, where the output does not."""
    from fomas_verify.design import plain

    for note in plain(named).notes:
        click.echo(f"note: {note}", err=True)
