"""From a command's end to an exit status and a line for the user."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import click

from fomas_verify.exact.errors import FomasError

WRONG_INPUT = 2


def outcome(run: Callable[[], Any]) -> tuple[int, str]:
    """Run, and give the exit status with what is to be said; the line is empty where nothing is.

    Raises
    ------
    KeyboardInterrupt
        It was aborted. What is neither a refusal nor a wrong call is raised too.
    """
    try:
        return int(run() or 0), ""
    except click.exceptions.NoArgsIsHelpError as error:
        click.echo(error.format_message(), err=True)
        return WRONG_INPUT, ""
    except click.exceptions.Abort:
        raise KeyboardInterrupt from None
    except click.ClickException as error:
        return WRONG_INPUT, " ".join(error.format_message().split())
    except FomasError as error:
        return error.exit_status, str(error)
