"""What `synthesize` is asked: a condition, limits on gamma and h, and what is best.

Everything depends on mu = gamma h^alpha / Gamma(alpha + 1), so a condition is a strip in (log gamma, log h), and the
limits are a box there: also the actuator's, ``gamma norm(L x_0) c <= u_max`` with a constant c >= peak on the strip,
and for k samples the settling limit ``sigma(mu)^k <= eps, h <= T/k``. Source: theory, section 5.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from fractions import Fraction
from functools import cached_property

from fomas_verify.design import Design, DesignError, Limits
from fomas_verify.enclosure.interval import Interval, round_down, round_up
from fomas_verify.enclosure.real import gamma_function, square_root
from fomas_verify.exact.matrix import apply, norm_squared
from fomas_verify.region.model import Condition, Region
from fomas_verify.region.peak_bound import peak_bound
from fomas_verify.spectrum.loop import Loop
from fomas_verify.spectrum.margins import BITS, MuMargin

DEFAULT_SETTLE_TO = Fraction(1, 100)
"""The share of the disagreement at which the agents count as settled, where neither design nor limits say."""


class Objective(StrEnum):
    """What is best."""

    FASTEST = "fastest"
    GENTLEST = "gentlest"
    SLOWEST = "slowest-sampling"
    ROBUST = "most-robust"


MEANINGS = {
    Objective.FASTEST: "least k h, k the samples after which sigma^k <= settle_to",
    Objective.GENTLEST: "least gamma, which bounds the control",
    Objective.SLOWEST: "largest h",
    Objective.ROBUST: "largest factor by which gamma and h may both be off, either way",
}


@dataclass(frozen=True)
class Box:
    """The gamma and h that the limits allow; an upper end of None is no limit.

    ``gamma_sure``: every gamma up to it keeps to u_max; ``gamma_most``: none beyond it does. They differ by a rounding
    where the peak is at most 1 on the strip, and by the bound of the peak elsewhere.
    """

    h: tuple[Fraction, Fraction | None]
    gamma_least: Fraction
    gamma_sure: Fraction | None
    gamma_most: Fraction | None


@dataclass(frozen=True)
class Task:
    """One question to `synthesize`, and the region that it is asked of."""

    region: Region
    condition: Condition
    objective: Objective
    limits: Limits

    @property
    def loop(self) -> Loop:
        """The graph and the order."""
        return self.region.loop

    @property
    def design(self) -> Design:
        """The user's design."""
        return self.region.loop.design

    @property
    def strip(self) -> MuMargin | None:
        """The mu of the condition; None where there is none."""
        return self.region.strip(self.condition).mu

    @cached_property
    def gamma_function(self) -> Interval:
        """``Gamma(alpha + 1)``."""
        return gamma_function(self.design.alpha + 1, BITS)

    @property
    def moves(self) -> tuple[int, int]:
        """Whether gamma and h are free to move: 0 for one that the limits fix."""
        gamma, h = (int(x is None or x[0] < x[1]) for x in (self.limits.gamma, self.limits.h))
        return gamma, h

    @property
    def within(self) -> Fraction | None:
        """The seconds within which the agents must have settled; None for no limit."""
        return self.limits.settle_within

    @property
    def settle_to(self) -> Fraction | None:
        """The share of the disagreement, where settling matters; None where it does not."""
        if self.within is None and self.objective is not Objective.FASTEST:
            return None
        return self.design.settle_to or DEFAULT_SETTLE_TO

    @cached_property
    def error_squared(self) -> Fraction:
        """``norm(L x_0)^2``."""
        rows = self.design.components or ()
        return sum((norm_squared(apply(self.loop.laplacian, x)) for x in rows), Fraction(0))

    @cached_property
    def peak(self) -> Fraction | None:
        """A number that the peak of norm u_k / norm u_0 does not exceed on the strip; None where none was found."""
        return None if self.strip is None else peak_bound(self.loop, self.condition, self.strip)

    @cached_property
    def box(self) -> Box:
        """The limits as a box."""
        limits = self.limits
        h = (Fraction(0), None) if limits.h is None else limits.h
        least, most = (Fraction(0), None) if limits.gamma is None else limits.gamma
        if limits.u_max is None or self.error_squared == 0:
            return Box(h, least, most, most)
        ceiling = Interval.exactly(limits.u_max) / square_root(Interval.exactly(self.error_squared), BITS)
        peak = self.peak or Fraction(1)
        sure, possible = round_down(ceiling.lower / peak, BITS), round_up(ceiling.upper, BITS)
        if peak == 1 and ceiling.is_exact:
            sure = possible = ceiling.lower
        return Box(h, least, _least(sure, most), _least(possible, most))


def _least(x: Fraction, limit: Fraction | None) -> Fraction:
    return x if limit is None else min(x, limit)


def pose(region: Region, condition: Condition, objective: Objective) -> Task:
    """The task; raises `DesignError` where the design lacks what it needs, or nothing keeps the best within reach."""
    design = region.loop.design
    task, limits = Task(region, condition, objective, design.limits), design.limits
    require_complete(design)
    if not task.loop.assumption1 and condition is Condition.GAIN_BOUND:
        raise DesignError(f"{design.source}: graph: synthesize with gain-bound needs Assumption 1, which fails")
    if limits.u_max is not None and task.strip is not None and task.peak is None:
        raise DesignError(
            f"{design.source}: limits.u_max: expected a condition that bounds the peak of the control (repaired, "
            f"repaired-closed-form), got {condition}"
        )
    missing = _missing(task)
    if missing and task.strip is not None:
        raise DesignError(f"{design.source}: limits: {objective} needs {missing}; got none")
    return task


def require_complete(design: Design) -> None:
    """Raise `DesignError` where the design lacks what its limits are about."""
    if design.limits.u_max is not None and design.x0 is None:
        raise DesignError(f"{design.source}: x0: limits.u_max needs x0; got no x0")
    if design.limits.settle_within is not None and design.settle_to is None:
        raise DesignError(f"{design.source}: settle_to: limits.settle_within needs settle_to; got no settle_to")


def _missing(task: Task) -> str:
    """What limit would make the best a design, not a limit at infinity; empty where it is one."""
    box, strip = task.box, task.strip
    long = box.h[1] is not None or task.within is not None
    if task.objective is Objective.SLOWEST and not long and box.gamma_least == 0:
        return "an upper limit of h, or a lower one of gamma"
    if task.objective is Objective.GENTLEST and not long and box.gamma_least == 0:
        return "an upper limit of h, or a lower one of gamma"
    if task.objective is Objective.FASTEST and box.h[0] == 0 and box.gamma_most is None:
        return "a lower limit of h, or an upper one of gamma (limits.gamma or limits.u_max)"
    if task.objective is Objective.FASTEST and box.h[0] == 0 and strip is not None and strip.outer[0] == 0:
        return "a lower limit of h, or a condition whose mu does not begin at 0"
    endless = task.objective is Objective.ROBUST and strip is not None and strip.outer[0] == 0
    if endless and (box.h[0] == 0 or (box.h[1] is None and box.gamma_least == 0)):
        return "limits of h on both sides, or lower limits of h and gamma"
    return ""
