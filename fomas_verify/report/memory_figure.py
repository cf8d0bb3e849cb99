"""Inequality (14) [eqT2] over the first samples, as a figure.

Its left side is ``beta^(k+1) + 1 - c_(k+1)``, its relative slack ``1 - beta^(k+1)/c_(k+1)``. The absolute slack tends
to 0 for every design, so it is the relative one that says how much room there is.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from fomas_verify.enclosure.interval import Interval
from fomas_verify.kernel.memory import step_response
from fomas_verify.spectrum.loop import Loop

LAST = 50
FILE = "memory-inequality.csv"
_BITS = 512
_DIGITS = 12
_SHOWN_MOST = 4


@dataclass(frozen=True)
class MemoryFigure:
    """The samples k = 0, 1, ..., each with left side and relative slack, enclosed.

    Where abs beta >= 1 the left side grows without bound: then the samples end before it passes `_SHOWN_MOST`.
    """

    left: tuple[Interval, ...]
    slack: tuple[Interval, ...]

    @property
    def last(self) -> int:
        """The last sample."""
        return len(self.left) - 1

    @property
    def least_slack_at(self) -> int:
        """The sample of the smallest relative slack; the first where several cannot be told apart."""
        least = min(slack.upper for slack in self.slack)
        return next(k for k, slack in enumerate(self.slack) if slack.lower <= least)

    @property
    def least_slack(self) -> Interval:
        """The smallest relative slack among the samples."""
        return self.slack[self.least_slack_at]

    def csv(self) -> bytes:
        """The figure's data: header ``k,left_side,relative_slack``, 12 decimals."""
        rows = [
            f"{k},{plain(x.mid)},{plain(y.mid)}" for k, (x, y) in enumerate(zip(self.left, self.slack, strict=True))
        ]
        return "\n".join(["k,left_side,relative_slack", *rows, ""]).encode()


def memory_figure(loop: Loop) -> MemoryFigure | None:
    """The samples k = 0..50; None where beta does not exist, or the very first are too large to draw. Rigorous."""
    if not loop.assumption1:
        return None
    beta = loop.beta(_BITS)
    left, slack, power = [], [], beta
    for k in range(LAST + 1):
        c = step_response(loop.design.alpha, k + 1, _BITS)
        left.append(power + (1 - c))
        slack.append(1 - power / c)
        if max(abs(left[-1].upper), abs(slack[-1].lower)) > _SHOWN_MOST:
            left.pop()
            slack.pop()
            break
        power = (power * beta).rounded(_BITS)
    return MemoryFigure(tuple(left), tuple(slack)) if left else None


def plain(x: Fraction) -> str:
    """x as a decimal with 12 digits after the point, rounded to nearest."""
    scaled = round(x * 10**_DIGITS)
    whole, rest = divmod(abs(scaled), 10**_DIGITS)
    return f"{'-' if scaled < 0 else ''}{whole}.{rest:0{_DIGITS}d}"
