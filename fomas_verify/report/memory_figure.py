"""Inequality (14) [eqT2] over the first samples, as a figure.

Its left side is ``beta^(k+1) + 1 - c_(k+1)``, its relative slack ``1 - beta^(k+1)/c_(k+1)``. The absolute slack tends
to 0 for every design, so it is the relative one that says how much room there is.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from fomas_verify.enclosure.interval import Interval
from fomas_verify.kernel.memory import step_response
from fomas_verify.report.latex_text import Tex
from fomas_verify.report.plot import Curve, Plot, Table, with_room
from fomas_verify.spectrum.loop import Loop

LAST = 50
FILE = "memory-inequality.csv"
_BITS = 512
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

    def table(self) -> Table:
        """The figure's data."""
        columns = {"left_side": [x.mid for x in self.left], "relative_slack": [x.mid for x in self.slack]}
        return Table(FILE, {"k": [Fraction(k) for k in range(len(self.left))], **columns})

    def plots(self) -> tuple[Plot, Plot]:
        """The left side against 1, and the relative slack against 0."""
        table, x_range = self.table(), (Fraction(-1), Fraction(LAST + 1))
        drawn = [
            (Tex("left side of (14)"), "left_side", "dots", 0, self.left, Fraction(1)),
            (Tex(r"relative slack $1-\beta^{k+1}/c_{k+1}$"), "relative_slack", "squares", 1, self.slack, Fraction(0)),
        ]
        found = []
        for title, column, look, color, values, level in drawn:
            ends = [level, *(x.mid for x in values)]
            y_range = with_room(min(ends), max(ends))
            curves = (Curve(column, look, color),)
            found.append(Plot(title, "k", x_range, y_range, table, "k", curves, levels=(level,)))
        return found[0], found[1]


def memory_figure(loop: Loop) -> MemoryFigure | None:
    """The samples k = 0..50; None where beta does not exist, or the very first are too large to draw. Rigorous."""
    if not loop.assumption1:
        return None
    beta = loop.beta(_BITS).shortened(_BITS)
    left, slack, power = [], [], beta
    for k in range(LAST + 1):
        c = step_response(loop.design.alpha, k + 1, _BITS)
        left.append(power + (1 - c))
        slack.append(1 - power / c)
        if max(abs(left[-1].upper), abs(slack[-1].lower)) > _SHOWN_MOST:
            left.pop()
            slack.pop()
            break
        power = (power * beta).shortened(_BITS)
    return MemoryFigure(tuple(left), tuple(slack)) if left else None
