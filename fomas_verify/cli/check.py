"""``verify-design check``."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from fomas_verify.checker import STATEMENTS, Malformed, Report, check
from fomas_verify.exact.errors import FomasError

if TYPE_CHECKING:
    from fomas_verify.design import Design

LARGEST = 64 << 20
FALSE, UNDECIDED = 1, 3
ENDINGS = {0: "Accepted.", FALSE: "Refused.", UNDECIDED: "Not decided within the work allowed."}


class CertificateError(FomasError):
    """The file cannot be read as a certificate."""


@click.command("check")
@click.argument("certificate", type=click.Path(path_type=Path), metavar="CERT.json")
@click.option("--design", type=click.Path(path_type=Path), metavar="DESIGN", help="it must be about that design")
@click.option(
    "--require", metavar="IDS", help="these claims must be proved (comma-separated); 'design': the design's own"
)
def command(certificate: Path, design: Path | None, require: str | None) -> int:
    """Check CERT.json with the independent checker: every value and every claim in it is decided anew.

    \b
    Example:  verify-design check certificate.json --design examples/paper.toml --require design
    """
    names = _ids(require)
    meant = None if design is None else _read_design(design)
    try:
        report = check(_read(certificate))
    except Malformed as error:
        raise CertificateError(f"{certificate}: {error}") from None
    for outcome in report.outcomes:
        verdict = f" {outcome.verdict}" if outcome.verdict else ""
        click.echo(f"{outcome.status:<10} {outcome.id}{verdict}: {outcome.reason}")
    statuses = {report.exit_status, _compare(report, meant), _require(report, names)}
    status = FALSE if FALSE in statuses else UNDECIDED if UNDECIDED in statuses else 0
    click.echo(ENDINGS[status])
    return status


def _read(certificate: Path) -> bytes:
    try:
        with certificate.open("rb") as file:
            return file.read(LARGEST + 1)
    except OSError as error:
        raise CertificateError(f"{certificate}: expected a certificate, got {error.strerror}") from None


def _ids(require: str | None) -> list[str]:
    names = require.split(",") if require else []
    for name in names:
        if name not in STATEMENTS and names != ["design"]:
            raise click.BadParameter(f"expected claim ids or 'design', got {name[:60]!r}", param_hint="--require")
    return names


def _read_design(path: Path) -> Design:
    from fomas_verify.design import read_design

    return read_design(path)


def _compare(report: Report, design: Design | None) -> int:
    """Whether the certificate is about the user's own design."""
    if design is None:
        return 0
    different = differences(report, design)
    if different:
        click.echo(f"refused    design: not the design of {design.source}: {', '.join(different)} differ")
        return FALSE
    click.echo(f"accepted   design: the design of {design.source}")
    return 0


def differences(report: Report, design: Design) -> list[str]:
    """The keys in which the certificate's design and the user's are not the same, as exact numbers."""
    named = report.design
    pairs = {
        "alpha": (named.alpha, design.alpha),
        "gamma": (named.gamma, design.gamma),
        "mu": (named.mu, design.mu),
        "h": (named.h, design.h),
        "agents": (named.agents, design.graph.agents),
        "edges": (sorted(named.edges), sorted(design.graph.edges)),
        "x0": (named.x0, design.x0),
        "require": (set(named.require), set(design.require)),
    }
    return [key for key, (theirs, ours) in pairs.items() if theirs != ours]


def _require(report: Report, names: list[str]) -> int:
    """Whether the claims asked for are proved."""
    required = report.design.require if names == ["design"] else names
    shortfalls = report.shortfalls(required)
    for shortfall in shortfalls:
        click.echo(f"required   {shortfall.id}: {shortfall.reason}")
    if required and not shortfalls:
        click.echo(f"required   all {len(required)} claims are proved")
    return max((s.exit_status for s in shortfalls if s.exit_status == FALSE), default=UNDECIDED if shortfalls else 0)
