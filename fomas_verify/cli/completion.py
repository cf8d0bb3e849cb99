"""``verify-design completion``."""

from __future__ import annotations

import click
from click.shell_completion import get_completion_class

SHELLS = ("bash", "zsh", "fish")
PROGRAM = "verify-design"
VARIABLE = "_VERIFY_DESIGN_COMPLETE"


@click.command("completion")
@click.argument("shell", type=click.Choice(SHELLS))
@click.pass_context
def command(ctx: click.Context, shell: str) -> int:
    """Print the script that makes a shell complete commands, options, claim ids and files.

    \b
    Example:  verify-design completion bash > ~/.local/share/bash-completion/completions/verify-design
    """
    found = get_completion_class(shell)
    if found is None:
        raise click.BadParameter(f"expected one of {', '.join(SHELLS)}, got {shell!r}", param_hint="SHELL")
    complete = found(ctx.find_root().command, {}, PROGRAM, VARIABLE)
    click.echo(complete.source_template % complete.source_vars())
    return 0
