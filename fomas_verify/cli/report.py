"""``verify-design report``."""

from __future__ import annotations

import shlex
from pathlib import Path

import click

from fomas_verify.cli.options import digits_option
from fomas_verify.design import read_design
from fomas_verify.prover import prove


@click.command("report")
@click.argument("design", type=click.Path(path_type=Path), metavar="DESIGN")
@click.option(
    "-o", "--output", type=click.Path(path_type=Path), default=Path("report"), show_default=True, metavar="DIR"
)
@digits_option
def command(design: Path, output: Path, digits: int) -> int:
    """Write the LaTeX report of DESIGN into DIR, and its PDF where a LaTeX is at hand.

    \b
    Example:  verify-design report examples/paper.toml -o reports/paper
    """
    from fomas_verify.report import write_report

    parts = ["verify-design", "report", design.as_posix(), "-o", output.as_posix()]
    parts += ["--digits", str(digits)] if digits != 50 else []
    files = write_report(prove(read_design(design), digits=digits), output, command=shlex.join(parts))
    for line in files.lines():
        click.echo(line)
    return 0
