"""Arguments and options that several commands share."""

from __future__ import annotations

from pathlib import Path

import click

design_argument = click.argument("design", type=click.Path(path_type=Path), metavar="DESIGN")
digits_option = click.option(
    "--digits", type=click.IntRange(20, 10_000), default=50, show_default=True, help="significant digits of the values"
)
json_option = click.option("--json", "as_json", is_flag=True, help="print JSON in place of the table")
