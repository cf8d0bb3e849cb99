"""The base of the project's own errors."""

from typing import ClassVar


class FomasError(Exception):
    """Base class: what went wrong is one line of text, written for the user; the command ends with ``exit_status``."""

    exit_status: ClassVar[int] = 2


class MissingExtraError(FomasError):
    """A library of an extra is not installed; the message says which, and how to install it."""
