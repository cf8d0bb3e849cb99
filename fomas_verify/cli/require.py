"""The option ``--require``: claims that must be proved."""

from __future__ import annotations

import click
from click.shell_completion import CompletionItem

from fomas_verify.checker import STATEMENTS

OWN = "design"
"""Stands for the claims that the design itself requires."""


def _read(_: click.Context, __: click.Parameter, value: str | None) -> tuple[str, ...]:
    names = () if value is None else tuple(value.split(","))
    for name in names:
        if name not in STATEMENTS and name != OWN:
            raise click.BadParameter(f"expected claim ids or '{OWN}', got {name[:60]!r}", param_hint="--require")
    return tuple(dict.fromkeys(names))


def _complete(_: click.Context, __: click.Parameter, incomplete: str) -> list[CompletionItem]:
    """Continue the last id of the list."""
    head, comma, last = incomplete.rpartition(",")
    return [CompletionItem(head + comma + name) for name in (*STATEMENTS, OWN) if name.startswith(last)]


require_option = click.option(
    "--require",
    metavar="IDS",
    callback=_read,
    shell_complete=_complete,
    help="these claims must be proved (comma-separated); 'design': the design's own",
)
