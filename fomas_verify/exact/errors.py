"""The base of the project's own errors."""

from typing import ClassVar


class FomasError(Exception):
    """Base class: what went wrong is one line of text, written for the user; the command ends with ``exit_status``."""

    exit_status: ClassVar[int] = 2
