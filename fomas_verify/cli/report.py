"""``verify-design report``."""

from __future__ import annotations

import shlex
from pathlib import Path

import click

from fomas_verify.cli.limits import limited
from fomas_verify.cli.options import allow_outside_option, digits_option, tell_notes
from fomas_verify.design import read_design
from fomas_verify.prover import prove

MOST_COMPARED = 4


@click.command("report")
@click.argument("designs", type=click.Path(path_type=Path), metavar="DESIGN...", nargs=-1, required=True)
@click.option(
    "-o", "--output", type=click.Path(path_type=Path), default=Path("report"), show_default=True, metavar="DIR"
)
@click.option(
    "--format", "form", type=click.Choice(["latex", "html", "md"]), default="latex", show_default=True,
    help="LaTeX and PDF, one HTML page that needs nothing else, or Markdown for a pull request",
)  # fmt: skip
@click.option("--brief", is_flag=True, help="one page")
@click.option("--theorem", is_flag=True, help="the corrected theorem and the counterexample, as a LaTeX fragment")
@digits_option
@allow_outside_option
@limited()
def command(
    designs: tuple[Path, ...],
    output: Path,
    form: str,
    digits: int,
    *,
    brief: bool,
    theorem: bool,
    allow_outside: bool,
) -> int:
    """Write the report of DESIGN into DIR, or the comparison of several, and its PDF where a LaTeX is at hand.

    \b
    Example:  verify-design report examples/paper.toml -o reports/paper
              verify-design report examples/paper.toml examples/repaired.toml -o comparison --format html
    """
    _must_go_together(len(designs), form, brief=brief, theorem=theorem)
    from fomas_verify.report import write_report

    parts = ["verify-design", "report", *(design.as_posix() for design in designs), "-o", output.as_posix()]
    parts += ["--format", form] if form != "latex" else []
    parts += ["--brief"] if brief else []
    parts += ["--theorem"] if theorem else []
    parts += ["--digits", str(digits)] if digits != 50 else []
    parts += ["--allow-outside"] if allow_outside else []
    named = [read_design(design, allow_outside=allow_outside) for design in designs]
    for design in named:
        tell_notes(design)
    proofs = [prove(design, digits=digits) for design in named]
    written = "theorem" if theorem else form
    files = write_report(proofs, output, command=shlex.join(parts), form=written, brief=brief)
    for line in files.lines():
        click.echo(line)
    return 0


def _must_go_together(count: int, form: str, *, brief: bool, theorem: bool) -> None:
    if count > MOST_COMPARED:
        raise click.UsageError(f"a comparison has at most {MOST_COMPARED} designs, got {count}")
    if count > 1 and (brief or theorem):
        raise click.UsageError("--brief and --theorem are about one design")
    if theorem and (brief or form != "latex"):
        raise click.UsageError("--theorem is a fragment of its own: leave out --brief and --format")
