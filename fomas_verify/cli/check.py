"""``verify-design check``."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import TYPE_CHECKING, cast

import click

from fomas_verify.cli.limits import limited
from fomas_verify.cli.options import allow_outside_option, json_option, tell_notes
from fomas_verify.cli.require import require_option
from fomas_verify.gate.answer import CertificateError, answer_to, read_certificate
from fomas_verify.prover.limits import allowed_memory

if TYPE_CHECKING:
    from fomas_verify.checker.large import Numeric
    from fomas_verify.design import Design, SwitchedDesign, UncertainDesign


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
    redo = _redo() if numeric else None
    answer = answer_to(read_certificate(certificate), str(certificate), meant, require, certificate, redo)
    click.echo(json.dumps(answer.record(), indent=2) if as_json else "\n".join(answer.lines()))
    return answer.status


def _redo() -> Numeric:
    """What redoes bounds that take a factor, in half of the machine's memory, or of what is allowed."""
    from importlib.util import find_spec

    from fomas_verify.numeric import SCALE, Redo

    missing = [name for name in SCALE if find_spec(name) is None]
    if missing:
        raise CertificateError(f"--numeric needs {', '.join(missing)}: pip install 'fomas_verify[scale]'")
    memory = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE") // 2 if hasattr(os, "sysconf") else 4 << 30
    return cast("Numeric", Redo(min(memory, (allowed_memory() or 2 * memory) // 2)))


def _read_design(path: Path, *, allow_outside: bool) -> Design | UncertainDesign | SwitchedDesign:
    from fomas_verify.design import read_named

    named = read_named(path, allow_outside=allow_outside)
    tell_notes(named)
    return named
