"""The checker as a command: a certificate in, one line for each value and claim out, an exit status."""

import argparse
import os
import sys
from collections.abc import Sequence
from pathlib import Path

from fomas_verify.checker.edge_list import beside
from fomas_verify.checker.report import Report, check
from fomas_verify.checker.statements import STATEMENTS
from fomas_verify.checker.text import MAX_BYTES, Malformed


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the checker on a file.

    Returns
    -------
    int
        0 everything in the certificate is true, and the required claims are proved; 1 something is false, or a required
        claim is refuted, inapplicable or absent; 2 the file is not a certificate, or cannot be read; 3 undecided.
    """
    options = _parser().parse_args(arguments)
    try:
        with Path(options.certificate).open("rb") as file:
            report = check(file.read(MAX_BYTES + 1), opener=beside(Path(options.certificate)))
    except OSError as error:
        return _refuse(f"{options.certificate!a}: {error.strerror}")
    except Malformed as error:
        return _refuse(f"{options.certificate!a}: {error}")
    required = report.design.require if options.require == ("design",) else options.require
    lines, status = _answer(report, required)
    sys.stdout.write("".join(f"{line}\n" for line in lines))
    sys.stdout.flush()
    return status


def run() -> int:
    """`main`, with 4 and one line on standard error for whatever else goes wrong."""
    try:
        return main()
    except (Exception, KeyboardInterrupt) as error:
        sys.stderr.write(f"internal error: {type(error).__name__}: {str(error)[:200]!a}\n")
        # What is left in a closed pipe's buffer would raise again at exit.
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
        return 4


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="checker",
        description="Decide anew, with the standard library alone, whether a certificate is true.",
        epilog="example: python -I -S fomas_verify/checker CERT.json --require design",
    )
    parser.add_argument("certificate", metavar="CERT.json")
    parser.add_argument(
        "--require",
        metavar="IDS",
        type=_ids,
        default=(),
        help='claims that must be proved, separated by commas; "design": those that the design requires',
    )
    return parser


def _ids(text: str) -> tuple[str, ...]:
    names = tuple(text.split(","))
    if names != ("design",):
        for name in names:
            if name not in STATEMENTS:
                raise argparse.ArgumentTypeError(f"{name!a} is not the id of a claim")
    return names


def _refuse(message: str) -> int:
    sys.stderr.write(f"{message}\n")
    return 2


def _answer(report: Report, required: Sequence[str]) -> tuple[list[str], int]:
    lines = []
    for outcome in report.outcomes:
        verdict = "" if outcome.verdict is None else f" ({outcome.verdict})"
        lines.append(f"{outcome.kind} {outcome.id}{verdict}: {outcome.status}: {outcome.reason}")
    shortfalls = report.shortfalls(required)
    lines += [f"required {shortfall.id}: not proved: {shortfall.reason}" for shortfall in shortfalls]
    found = {report.exit_status, *(shortfall.exit_status for shortfall in shortfalls)}
    status = 1 if 1 in found else 3 if 3 in found else 0
    counts = [outcome.status for outcome in report.outcomes]
    tally = ", ".join(f"{counts.count(kind)} {kind}" for kind in ("accepted", "refused", "undecided"))
    lines.append(f"{tally}; {len(shortfalls)} required not proved; exit status {status}")
    return lines, status
