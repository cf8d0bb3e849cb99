"""Inequality (14) sample by sample up to a horizon: the sum is added term by term, not telescoped.

It must agree with the closed form. The slack that matters is relative, ``1 - beta^(k+1)/c_(k+1)``: the absolute one,
``c_(k+1) - beta^(k+1)``, tends to 0 for every design.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from fomas_verify.enclosure.horizon import scan_horizon
from fomas_verify.enclosure.interval import Interval


@dataclass(frozen=True)
class Horizon:
    """What was seen at the samples k = 0 .. ``last``.

    ``first_failure`` is the first sample at which (14) certainly fails; ``not_decided`` the samples at which the
    enclosure met equality; ``least_slack`` the smallest relative slack, at sample ``least_slack_at``.
    """

    last: int
    first_failure: int | None
    not_decided: tuple[int, ...]
    least_slack: Interval
    least_slack_at: int


def check_horizon(alpha: Fraction, beta: Interval, last: int, digits: int) -> Horizon:
    """Evaluate (14) at k = 0 .. last with about ``digits`` correct digits; rigorous. Memory does not grow with
    ``last``.
    """
    return Horizon(last, *scan_horizon(alpha, beta, last, digits))
