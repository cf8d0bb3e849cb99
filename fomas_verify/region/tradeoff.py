"""The best point of one convex piece in (log gamma, log h), in closed form, and of the union of pieces by branch and
bound over the number of samples. In floats: what is found here is proposed, and rounded and proved elsewhere.

Notation: a = alpha, m = mu Gamma(a + 1) = gamma h^a. Source: theory, section 5.
"""

from __future__ import annotations

import heapq
import math
from dataclasses import dataclass
from fractions import Fraction

from fomas_verify.enclosure.interval import Interval
from fomas_verify.region.levels import fewest_samples, level
from fomas_verify.region.task import Objective, Task

MOST_LEVELS, MOST_SAMPLES = 400, 1 << 24
"""Bounds on the numbers of samples whose mu are computed, and on a number of samples."""


@dataclass(frozen=True)
class Piece:
    """The samples `first` to `last` at once: a polyhedron that holds those of all of them, and is it where they are
    one. Logarithms: ``low <= log m <= high``, and gamma and h in their ranges; ``moves``: 0 where limits fix them.
    """

    first: int
    last: int
    alpha: float
    low: float
    high: float
    gamma: tuple[float, float]
    h: tuple[float, float]
    moves: tuple[int, int] = (1, 1)

    @property
    def is_empty(self) -> bool:
        """Whether no gamma and h lie in it."""
        (g0, g1), (y0, y1) = self.gamma, self.h
        crossed = self.low > self.high or g0 > g1 or y0 > y1
        return crossed or g0 + self.alpha * y0 > self.high or g1 + self.alpha * y1 < self.low

    def cost(self, objective: Objective) -> float:
        """What the best point costs; less is better, infinite where the piece is empty."""
        if self.is_empty:
            return math.inf
        (g0, g1), (y0, y1) = self.gamma, self.h
        match objective:
            case Objective.SLOWEST:
                return -min(y1, (self.high - g0) / self.alpha)
            case Objective.GENTLEST:
                return max(g0, self.low - self.alpha * y1)
            case Objective.FASTEST:
                return math.log(self.first) + max(y0, (self.low - g1) / self.alpha)
            case Objective.ROBUST:
                return -self.room

    @property
    def room(self) -> float:
        """The largest r with a point from which log gamma and log h may both move by r, either way; a number that the
        limits fix does not move, and where both are fixed it is 0.
        """
        (g0, g1), (y0, y1) = self.gamma, self.h
        across = [self.high - self.low, self.high - g0 - self.alpha * y0, g1 + self.alpha * y1 - self.low]
        both = self.moves[0] + self.alpha * self.moves[1]
        rooms = [x / (2 * both) for x in across] if both else [0.0]
        return min(
            rooms + [(x[1] - x[0]) / 2 for x, moves in zip((self.gamma, self.h), self.moves, strict=True) if moves]
        )


@dataclass(frozen=True)
class Best:
    """The best piece, and a cost that no point of any other falls below (equal, where the search came to its end)."""

    piece: Piece
    bound: float


def log(x: Fraction | None) -> float:
    """log x for x > 0; of 0 and of no limit the infinities."""
    if x is None:
        return math.inf
    return -math.inf if x == 0 else math.log(x.numerator) - math.log(x.denominator)


def piece(task: Task, first: int = 1, last: int = 1) -> Piece | None:
    """The samples from first to last; without a settling limit the only piece. None where it is seen to be empty."""
    strip, box = task.strip, task.box
    if strip is None:
        return None
    ends, longest = Interval(*strip.inner), box.h[1]
    if task.settle_to is not None:
        found = level(task.loop, task.settle_to, last)
        if found is None or not found.overlaps(ends):
            return None
        ends = Interval(max(ends.lower, found.lower), min(ends.upper, found.upper))
        if task.within is not None:
            longest = min(task.within / first, longest or task.within)
    scale = log(task.gamma_function.mid)
    low, high = log(ends.lower) + scale, log(ends.upper) + scale
    gamma, h = (log(box.gamma_least), log(box.gamma_sure)), (log(box.h[0]), log(longest))
    return Piece(first, last, float(task.design.alpha), low, high, gamma, h, task.moves)


def best_piece(task: Task) -> Best | None:
    """Where the best point lies; None where no piece holds a point, or none was found within the work allowed."""
    if task.settle_to is None:
        only = piece(task)
        return None if only is None or only.is_empty else Best(only, only.cost(task.objective))
    first, last = samples_range(task)
    open_parts: list[tuple[float, int, int, Piece]] = []

    def consider(k: int, n: int) -> None:
        part = piece(task, k, n) if k <= n else None
        if part is not None and not part.is_empty:
            heapq.heappush(open_parts, (part.cost(task.objective), k, n, part))

    consider(first, last)
    for _ in range(MOST_LEVELS):
        if not open_parts:
            return None
        bound, k, n, part = heapq.heappop(open_parts)
        if k == n:
            return Best(part, bound)
        middle = (k + n) // 2
        consider(k, middle)
        consider(middle + 1, n)
    ended = [entry for entry in open_parts if entry[1] == entry[2]]
    return Best(min(ended)[3], min(open_parts)[0]) if ended else None


def samples_range(task: Task) -> tuple[int, int]:
    """The numbers of samples between which the best lies: with fewer nothing settles, with more nothing is gained."""
    strip, settle_to = task.strip, task.settle_to
    if strip is None or settle_to is None:
        return 1, 1
    inside = strip.outer[1] * task.loop.degree_max <= 1
    first = fewest_samples(task.loop, settle_to) if inside else 1
    longest = MOST_SAMPLES
    if task.within is not None and task.box.h[0] > 0:
        longest = min(longest, int(task.within / task.box.h[0]))
    return first, min(longest, _enough(task, strip.inner, first))


def _enough(task: Task, ends: tuple[Fraction, Fraction], first: int) -> int:
    """The number of samples, in powers of two times the first, within which the whole strip settles."""
    k = first
    while k < MOST_SAMPLES:
        found = level(task.loop, task.settle_to, k) if task.settle_to else None
        if found is not None and found.lower <= ends[0] and ends[1] <= found.upper:
            return k
        k *= 2
    return k
