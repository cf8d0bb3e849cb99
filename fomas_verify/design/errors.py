"""The refusal of a design."""

from fomas_verify.exact.errors import FomasError


class DesignError(FomasError):
    """A design cannot be read, or lacks what a command needs; one line: `FILE: key.path[i]: expected ..., got ...`."""
