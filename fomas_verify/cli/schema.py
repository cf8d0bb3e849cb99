"""``verify-design schema``."""

from __future__ import annotations

import json
from importlib.resources import files

import click

SCHEMAS = {"design": "fomas_verify.design", "certificate": "fomas_verify.certificate"}


@click.command("schema")
@click.argument("kind", type=click.Choice((*SCHEMAS, "grid")))
def command(kind: str) -> int:
    """Print the JSON Schema of the design file, of the certificate or of the grid of a sweep, for editors and other
    programs.

    \b
    Example:  verify-design schema design > design.schema.json
    """
    click.echo(_of_grids() if kind == "grid" else _shipped(kind), nl=False)
    return 0


def _shipped(kind: str) -> str:
    return files(SCHEMAS[kind]).joinpath(f"{kind}.schema.json").read_text("utf-8")


def _of_grids() -> str:
    from fomas_verify.sweep.grid_schema import grid_schema

    return json.dumps(grid_schema(), indent=2) + "\n"
