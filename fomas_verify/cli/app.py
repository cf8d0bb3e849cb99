"""``verify-design``: the group of commands, and how each way to fail becomes one line and an exit status."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from importlib import import_module
from typing import Any

import click

from fomas_verify.cli.outcome import outcome

COMMANDS = {
    "prove": "decide every claim about a design; write its certificate",
    "check": "check a certificate with the independent checker",
    "kernel": "f(j), c_n, partial sums and resolvent, every printed digit right",
    "region": "the certified feasible region of (gamma, h)",
    "synthesize": "the best (gamma, h) in that region under the design's limits",
    "simulate": "the closed loop under the paper's controller and others: table, figures",
    "report": "LaTeX report of a design, and its PDF where a LaTeX is at hand",
    "gate": "many designs, one exit status: the gate of a CI job",
    "sweep": "a grid of designs, on all cores or on a Dask cluster, to a Parquet dataset",
    "init": "a commented design file to start from",
    "schema": "the JSON Schema of the design file or of the certificate",
    "completion": "completion of commands and options for bash, zsh and fish",
    "selftest": "known answers of every primitive, proved again",
}


class ReaderGoneError(Exception):
    """The reader of standard output went away; click would end with status 1, which says "refuted"."""


@contextmanager
def _out_of_the_hands_of_click() -> Iterator[None]:
    try:
        yield
    except BrokenPipeError:
        raise ReaderGoneError from None


class LazyGroup(click.Group):
    """A group that imports a command when it is used, so that starting costs nothing."""

    def make_context(self, *arguments: Any, **options: Any) -> click.Context:
        """The context; this prints what --help and --version ask for."""
        with _out_of_the_hands_of_click():
            return super().make_context(*arguments, **options)

    def invoke(self, ctx: click.Context) -> Any:
        """What the command returns."""
        with _out_of_the_hands_of_click():
            return super().invoke(ctx)

    def list_commands(self, ctx: click.Context) -> list[str]:
        """The names, in the order in which a user meets them."""
        return list(COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """The command from its module."""
        if cmd_name not in COMMANDS:
            return None
        command: click.Command = import_module(f"fomas_verify.cli.{cmd_name}").command
        return command

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """The list of commands, without importing any."""
        with formatter.section("Commands"):
            formatter.write_dl(list(COMMANDS.items()))


@click.group(cls=LazyGroup, context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100})
@click.version_option(package_name="fomas_verify", prog_name="verify-design")
def app() -> None:
    """Decide whether a sampled-data consensus design for fractional-order agents is right.

    \b
    Example:  verify-design prove examples/paper.toml -o certificate.json

    \b
    Exit status: 0 required claims proved; 1 one is refuted or inapplicable, or a certificate says
    something false; 2 wrong input or call; 3 undecided within the work allowed; 4 internal error.
    """


def main(arguments: list[str] | None = None) -> int:
    """Run the command line and return the exit status."""
    try:
        status, message = outcome(lambda: app.main(args=arguments, prog_name="verify-design", standalone_mode=False))
    except ReaderGoneError:
        raise BrokenPipeError from None
    if message:
        click.echo(f"verify-design: {message}", err=True)
    return status
