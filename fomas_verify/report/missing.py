"""What is said where a library is not installed."""

from fomas_verify.exact.errors import FomasError


class MissingExtraError(FomasError):
    """A library of an extra is not installed."""
