"""``verify-design check``."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING

import click

from fomas_verify.cli.limits import limited
from fomas_verify.cli.numeric import needed_redo
from fomas_verify.cli.options import allow_outside_option, json_option, tell_notes
from fomas_verify.cli.require import require_option
from fomas_verify.exact.errors import source_name
from fomas_verify.gate.answer import answer_to, read_certificate

if TYPE_CHECKING:
    from fomas_verify.design import AnyDesign


@click.command("check")
@click.argument("certificate", type=click.Path(path_type=Path), metavar="CERT.json")
@click.option("--design", type=click.Path(path_type=Path), metavar="DESIGN", help="it must be about that design")
@require_option
@allow_outside_option
@click.option("--numeric", is_flag=True, help="redo what takes a sparse factor, with scipy and qdldl")
@json_option
@limited()
def command(
    certificate: Path,
    design: Path | None,
    require: tuple[str, ...],
    *,
    allow_outside: bool,
    numeric: bool,
    as_json: bool,
) -> int:
    """Check CERT.json with the independent checker: every value and every claim in it is decided anew.

    \b
    Example:  verify-design check certificate.json --design examples/paper.toml --require design
    """
    meant = None if design is None else _read_design(design, allow_outside=allow_outside)
    redo = needed_redo() if numeric else None
    answer = answer_to(read_certificate(certificate), source_name(certificate), meant, require, certificate, redo)
    click.echo(json.dumps(answer.record(), indent=2) if as_json else "\n".join(answer.lines()))
    return answer.status


def _read_design(path: Path, *, allow_outside: bool) -> AnyDesign:
    from fomas_verify.design import read_named

    named = read_named(path, allow_outside=allow_outside)
    tell_notes(named)
    return named
