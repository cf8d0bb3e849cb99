"""Why no gamma and h satisfy a condition and limits, in words; the numbers are rounded so that what is said is true."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction

from fomas_verify.enclosure.digits import decimal, exact_decimal, rounded_down, rounded_up
from fomas_verify.enclosure.interval import Interval
from fomas_verify.enclosure.real import root_of, square_root
from fomas_verify.exact.rational import format_rational
from fomas_verify.kernel.memory import one_step_weight
from fomas_verify.region.errors import UndecidedRegionError
from fomas_verify.region.refutation import as_given, blocks
from fomas_verify.region.synthesize import synthesize
from fomas_verify.region.task import Objective, Task
from fomas_verify.spectrum.margins import BITS

DIGITS = 4


def clash(task: Task) -> str | None:
    """What clashes, in one sentence; None where nothing was proved to. Rigorous."""
    if task.strip is None:
        return _no_mu(task)
    timeless = replace(task, objective=Objective.ROBUST, limits=replace(task.limits, settle_within=None))
    if as_given(timeless).left(1) is None:
        return _no_room(timeless)
    if task.within is None or blocks(as_given(task)) is None:
        return None
    bound = _least_time(replace(timeless, objective=Objective.FASTEST))
    said = f"settle_within = {plain(task.within)}"
    named = [*_names(task, upper=True), *_names(task, upper=False)]
    others = f" with {' and '.join(named)}" if named else ""
    if bound is None:
        return f"{said}{others} leaves no number of samples"
    least = rounded_down(bound, DIGITS)
    return (
        f"{said} leaves no number of samples: settling to {plain(task.settle_to or 0)}{others} takes {least} s at least"
    )


def _least_time(task: Task) -> Fraction | None:
    """A time that settling certainly takes longer than; None where none was found."""
    try:
        return synthesize(task).bound
    except UndecidedRegionError:
        return None


def _no_mu(task: Task) -> str:
    if not task.loop.assumption1:
        return f"Assumption 1 fails, which {task.condition} presupposes"
    opening = task.region.strip(task.condition).opening
    alpha = f"{task.condition} holds for no mu at alpha = {plain(task.design.alpha)}"
    return alpha if opening is None else f"{alpha}; it opens at alpha = {decimal(opening.alpha, 10)}"


def _no_room(task: Task) -> str:
    box, strip, alpha = task.box, task.strip, task.design.alpha
    most, h = box.gamma_most, box.h
    if most is not None and box.gamma_least > most:
        least = square_root(Interval.exactly(task.error_squared), BITS) * box.gamma_least
        named = f"gamma >= {plain(box.gamma_least)} and u_max = {plain(task.limits.u_max or 0)}"
        return f"{named} leave no gamma: u_max must reach at least {rounded_down(least.lower, DIGITS)}"
    if strip is None or h[1] is None or most is None or not _falls_short(task):
        return _too_large(task)
    (c, _), gamma = strip.outer, task.gamma_function
    needed = root_of(gamma * c / most, alpha, BITS)
    other = c / one_step_weight(alpha, h[1], BITS).upper
    name, factor = "gamma", Fraction(1)
    if _actuator_binds(task):
        name, factor = "u_max", square_root(Interval.exactly(task.error_squared), BITS).lower
    of_h = "" if needed is None else f"h must reach at least {rounded_down(needed.lower, DIGITS)}, or "
    of_other = f"{name}{' must reach' if needed is None else ''} at least {rounded_down(other * factor, DIGITS)}"
    return f"{' and '.join(_names(task, upper=True))} leave no gamma: {of_h}{of_other}"


def _falls_short(task: Task) -> bool:
    """Whether even the largest gamma and h give too small a mu."""
    strip, most, h = task.strip, task.box.gamma_most, task.box.h[1]
    if strip is None or most is None or h is None:
        return False
    return (one_step_weight(task.design.alpha, h, BITS) * most).upper < strip.outer[0]


def _too_large(task: Task) -> str:
    """Even the smallest gamma and h give too large a mu."""
    box, strip, alpha = task.box, task.strip, task.design.alpha
    named = " and ".join(_names(task, upper=False))
    if strip is None or not box.h[0] or not box.gamma_least:
        return f"{named} leave no gamma"
    needed = root_of(task.gamma_function * strip.outer[1] / box.gamma_least, alpha, BITS)
    other = strip.outer[1] / one_step_weight(alpha, box.h[0], BITS).lower
    of_h = "" if needed is None else f"h must fall to at most {rounded_up(needed.upper, DIGITS)}, or "
    of_gamma = f"gamma{' must fall' if needed is None else ''} to at most {rounded_up(other, DIGITS)}"
    return f"{named} leave no gamma: {of_h}{of_gamma}"


def _actuator_binds(task: Task) -> bool:
    """Whether u_max bounds gamma below its own limit."""
    most = task.box.gamma_most
    return task.limits.u_max is not None and most is not None and (task.limits.gamma or (0, None))[1] != most


def _names(task: Task, *, upper: bool) -> Iterator[str]:
    """The limits on one side, as the user wrote them."""
    h, gamma = task.limits.h, task.limits.gamma
    if upper:
        if h is not None:
            yield f"h <= {plain(h[1])}"
        if _actuator_binds(task):
            yield f"u_max = {plain(task.limits.u_max or 0)}"
        elif gamma is not None:
            yield f"gamma <= {plain(gamma[1])}"
        return
    if h is not None and h[0]:
        yield f"h >= {plain(h[0])}"
    if gamma is not None and gamma[0]:
        yield f"gamma >= {plain(gamma[0])}"


def plain(x: Fraction | int) -> str:
    """A number as a short decimal, or as a fraction."""
    return exact_decimal(Fraction(x), 20) or format_rational(Fraction(x))
