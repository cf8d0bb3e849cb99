"""Proofs that no gamma and h satisfy a condition and limits: that a task has no answer, or none better than a bound.

For the samples from k1 to k2 at once: h is at most ``H = min(h_1, T/k1)``, so mu lies between ``gamma_0 m(h_0)`` and
``gamma_1 m(H)``, ``m(h) = h^alpha / Gamma(alpha + 1)``; none of these mu satisfies the condition, or pairs of vectors
show ``sigma > eps^(1/k2)`` on what is left of them. Source: docs/certificate-format.md, section 9.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

from fomas_verify.enclosure.interval import Interval, short_dyadic
from fomas_verify.kernel.memory import one_step_weight
from fomas_verify.region.least_factor import VECTOR_BITS, Pair, line_at, lower_bound, scaled_pair
from fomas_verify.region.levels import factor, known_lines, level
from fomas_verify.region.task import Objective, Task
from fomas_verify.spectrum.margins import BITS

MOST_BLOCKS, MOST_SAMPLES = 600, 1 << 40


@dataclass(frozen=True)
class Tightened:
    """The limits that are to be shown impossible; None for no limit. ``gamma[1]``: no larger gamma keeps to u_max."""

    task: Task
    h: tuple[Fraction, Fraction | None]
    gamma: tuple[Fraction, Fraction | None]
    within: Fraction | None

    def longest(self, first: int) -> Fraction | None:
        """The largest h with `first` samples or more."""
        ends = [x for x in (self.h[1], None if self.within is None else self.within / first) if x is not None]
        return min(ends, default=None)

    def left(self, first: int) -> Interval | None:
        """The mu of the condition that are left with `first` samples or more; None where none is. Rigorous."""
        strip, h = self.task.strip, self.longest(first)
        (least, most), alpha = self.gamma, self.task.design.alpha
        if strip is None or (h is not None and self.h[0] > h) or (most is not None and least > most):
            return None
        low, high = strip.outer
        if least and self.h[0]:
            low = max(low, (one_step_weight(alpha, self.h[0], BITS) * least).lower)
        if most is not None and h is not None:
            high = min(high, (one_step_weight(alpha, h, BITS) * most).upper)
        return None if low > high else Interval(low, high)


def as_given(task: Task) -> Tightened:
    """The limits of the task."""
    box = task.box
    return Tightened(task, box.h, (box.gamma_least, box.gamma_most), task.within)


def better_than(task: Task, bound: Fraction) -> Tightened:
    """The limits of the task, and that the objective (h, gamma, or the settling time) is at the bound or better."""
    given = as_given(task)
    if task.objective is Objective.SLOWEST:
        return replace(given, h=(max(given.h[0], bound), given.h[1]))
    if task.objective is Objective.GENTLEST:
        return replace(given, gamma=(given.gamma[0], _smaller(given.gamma[1], bound)))
    return replace(given, within=_smaller(given.within, bound))


def _smaller(x: Fraction | None, bound: Fraction) -> Fraction:
    return bound if x is None else min(x, bound)


def blocks(tight: Tightened) -> list[dict[str, Any]] | None:
    """The blocks of a certificate, from 1 to no end; None where the limits are possible, or no proof was found."""
    if tight.task.strip is None:
        return []
    if tight.task.settle_to is None or tight.within is None:
        return [{"from": 1, "to": None}] if tight.left(1) is None else None
    end = _end(tight)
    if end is None:
        return None
    found: list[dict[str, Any]] = []
    open_parts = [(1, end - 1)] if end > 1 else []
    while open_parts:
        first, last = open_parts.pop()
        entry = _block(tight, first, last)
        if entry is not None:
            found.append(entry)
        elif first == last or len(found) + len(open_parts) > MOST_BLOCKS:
            return None
        else:
            middle = (first + last) // 2
            open_parts += [(middle + 1, last), (first, middle)]
    return [*found, {"from": end, "to": None}]


def _end(tight: Tightened) -> int | None:
    """The fewest samples from which on the limits leave no mu at all; None where there is no such number."""
    low, high = 0, 1
    while tight.left(high) is not None:
        low, high = high, 2 * high
        if high > MOST_SAMPLES:
            return None
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (middle, high) if tight.left(middle) is not None else (low, middle)
    return high


def _block(tight: Tightened, first: int, last: int) -> dict[str, Any] | None:
    task, left = tight.task, tight.left(first)
    if left is None:
        return {"from": first, "to": last}
    if task.settle_to is None:
        return None
    beyond = factor(task.settle_to, last).upper
    pairs = _known(task, left, beyond) or _least(task, left, beyond)
    if pairs is None and first == last:
        pairs = _nearest(task, left, last)
    return None if pairs is None else {"from": first, "to": last, "pairs": pairs}


def _known(task: Task, left: Interval, beyond: Fraction) -> list[Pair] | None:
    """The same by a line that is known already."""
    for line in known_lines(task.loop):
        if min(map(line.at, left.ends)) > beyond and (pairs := _short(task, line.pair, left, beyond)) is not None:
            return pairs
    return None


def _short(task: Task, pair: Pair, left: Interval, beyond: Fraction) -> list[Pair] | None:
    """The pair with the shortest integers that still show sigma > beyond on `left`."""
    for bits in VECTOR_BITS:
        pairs = [scaled_pair(pair, Fraction(1), bits)]
        if any(pairs[0][1]) and lower_bound(task.loop, pairs, left) > beyond:
            return pairs
    return None


def _least(task: Task, left: Interval, beyond: Fraction) -> list[Pair] | None:
    """The same by the pairs at the least sigma of all mu up to 1/D."""
    best = task.region.best
    if best is None or best.lower <= beyond:
        return None
    found = (best.pairs(bits) for bits in VECTOR_BITS)
    return next((pairs for pairs in found if pairs and lower_bound(task.loop, pairs, left) > beyond), None)


def _nearest(task: Task, left: Interval, samples: int) -> list[Pair] | None:
    """The same by the line that touches sigma between `left` and the mu that settle; None where these meet."""
    if task.settle_to is None:
        return None
    allowed = level(task.loop, task.settle_to, samples)
    if allowed is None or allowed.overlaps(left):
        return None
    below = left.upper < allowed.lower
    gap = Interval(left.upper, allowed.lower) if below else Interval(allowed.upper, left.lower)
    line = line_at(task.loop, short_dyadic(*((gap.lower, gap.mid) if below else (gap.mid, gap.upper))))
    known_lines(task.loop).append(line)
    return _short(task, line.pair, left, factor(task.settle_to, samples).upper)


def most_robust_is_at_most(task: Task, bound: Fraction) -> bool:
    """Whether it is certain that no point lets gamma and h be off by the factor bound > 1, either way. Rigorous.

    Without a settling limit only.
    """
    strip, box, alpha = task.strip, task.box, task.design.alpha
    if strip is None or task.settle_to is not None:
        return strip is None
    square = bound**2
    of_h = one_step_weight(alpha, square, BITS) * task.gamma_function
    spread = (of_h.lower if task.moves[1] else Fraction(1)) * (square if task.moves[0] else 1)
    if spread * strip.outer[0] > strip.outer[1]:
        return True
    if task.moves[1] and box.h[1] is not None and box.h[0] * square > box.h[1]:
        return True
    if task.moves[0] and box.gamma_most is not None and box.gamma_least * square > box.gamma_most:
        return True
    if box.h[0] and one_step_weight(alpha, box.h[0], BITS).lower * box.gamma_least * spread > strip.outer[1]:
        return True
    if box.h[1] is None or box.gamma_most is None:
        return False
    return one_step_weight(alpha, box.h[1], BITS).upper * box.gamma_most < strip.outer[0] * spread
