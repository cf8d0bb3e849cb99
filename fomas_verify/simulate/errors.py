"""What a simulation refuses, and why."""

from __future__ import annotations

from fomas_verify.exact.errors import FomasError


class SimulationError(FomasError):
    """The call asks for what cannot be simulated; one line."""


class NoEnclosureError(FomasError):
    """The trajectory could not be enclosed within the work allowed."""

    exit_status = 3
