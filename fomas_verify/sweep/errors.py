"""The refusals of a sweep."""

from fomas_verify.exact.errors import FomasError


class SweepError(FomasError):
    """A sweep cannot begin or cannot go on; one line."""
