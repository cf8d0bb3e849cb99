"""Why a region is not given."""

from __future__ import annotations

from fomas_verify.exact.errors import FomasError


class UndecidedRegionError(FomasError):
    """A condition's interval was not decided, or not to be sought, within the work allowed."""

    exit_status = 3


class NoDesignError(FomasError):
    """It is proved that no design does what was asked for; one line."""

    exit_status = 1
