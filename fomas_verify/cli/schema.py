"""``verify-design schema``."""

from __future__ import annotations

from importlib.resources import files

import click

SCHEMAS = {"design": "fomas_verify.design", "certificate": "fomas_verify.certificate"}


@click.command("schema")
@click.argument("kind", type=click.Choice(tuple(SCHEMAS)))
def command(kind: str) -> int:
    """Print the JSON Schema of the design file or of the certificate, for editors and other programs.

    \b
    Example:  verify-design schema design > design.schema.json
    """
    click.echo(files(SCHEMAS[kind]).joinpath(f"{kind}.schema.json").read_text("utf-8"), nl=False)
    return 0
