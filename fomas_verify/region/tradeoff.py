"""The best point of one convex piece in (log gamma, log h), in closed form, and of the union of pieces by branch and
bound over the number of samples. In floats: what is found here is proposed, and rounded and proved elsewhere.

Notation: a = alpha, m = mu Gamma(a + 1) = gamma h^a. Source: theory, section 5.
"""

from __future__ import annotations

import heapq
import math
from dataclasses import dataclass
from fractions import Fraction

from fomas_verify.region.levels import fewest_samples, known_lines, level, touch
from fomas_verify.region.task import Objective, Task

MOST_LEVELS, MOST_PARTS, MOST_SAMPLES = 200, 20_000, 1 << 24
"""Bounds on the numbers of samples whose mu are computed, on the steps of the search, and on a number of samples."""

ROUNDING = 1e-12
"""How far floats may be off."""


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
    if task.settle_to is None:
        return _between(task, first, last, 0.0, math.inf)
    found = level(task.loop, task.settle_to, last)
    return None if found is None else _between(task, first, last, float(found.lower), float(found.upper))


def roughly(task: Task, first: int, last: int) -> Piece | None:
    """A polyhedron that holds that of the same samples, by the lines below sigma that are known."""
    if task.settle_to is None:
        return piece(task, first, last)
    within = math.exp(log(task.settle_to) / last)
    low, high = 0.0, math.inf
    for height, fall in _lines(task):
        if fall > 0:
            low = max(low, (height - within) / fall)
        elif fall < 0:
            high = min(high, (height - within) / fall)
        elif height > within:
            return None
    return _between(task, first, last, low * (1 - ROUNDING), high * (1 + ROUNDING))


def _lines(task: Task) -> list[tuple[float, float]]:
    return [(float(line.height), float(line.fall)) for line in known_lines(task.loop)]


def _between(task: Task, first: int, last: int, low: float, high: float) -> Piece | None:
    """The piece whose mu, those of the strip, lie between low and high."""
    strip, box = task.strip, task.box
    if strip is None or low > high:
        return None
    longest, scale = log(box.h[1]), log(task.gamma_function.mid)
    if task.within is not None:
        longest = min(longest, log(task.within) - math.log(first))
    logs = (math.log(x) if 0 < x < math.inf else math.copysign(math.inf, x - 1) for x in (low, high))
    low_log, high_log = max(log(strip.inner[0]), next(logs)), min(log(strip.inner[1]), next(logs))
    gamma, h = (log(box.gamma_least), log(box.gamma_sure)), (log(box.h[0]), longest)
    alpha = float(task.design.alpha)
    return Piece(first, last, alpha, low_log + scale, high_log + scale, gamma, h, task.moves)


def best_piece(task: Task) -> Best | None:
    """Where the best point lies; None where no piece holds a point, or none was found within the work allowed.

    The samples are halved, what looks best first, until one number of them is; its mu are computed then, and lines
    that touch sigma there tell more of the others.
    """
    if task.settle_to is None:
        only = piece(task)
        return None if only is None or only.is_empty else Best(only, only.cost(task.objective))
    queue = _Queue(task)
    queue.push(*samples_range(task))
    best: Piece | None = None
    levels = 0
    for _ in range(MOST_PARTS):
        if not queue.parts or levels > MOST_LEVELS:
            break
        bound, first, last = queue.pop()
        if best is not None and best.cost(task.objective) <= bound:
            return Best(best, best.cost(task.objective))
        if queue.push(first, last, above=bound):
            continue
        if first < last:
            middle = (first + last) // 2
            queue.push(first, middle)
            queue.push(middle + 1, last)
            continue
        levels += 1
        found = piece(task, first, first)
        mu = level(task.loop, task.settle_to, first)
        if mu is not None:
            touch(task.loop, mu)
        if found is not None and not found.is_empty:
            best = found if best is None else min(best, found, key=lambda x: x.cost(task.objective))
    if best is None:
        return None
    return Best(best, min([best.cost(task.objective), *(part[0] for part in queue.parts)]))


class _Queue:
    """Numbers of samples, what looks best first."""

    def __init__(self, task: Task) -> None:
        self.task = task
        self.parts: list[tuple[float, int, int]] = []

    def push(self, first: int, last: int, above: float = -math.inf) -> bool:
        """Enter the samples from first to last by what the known lines say, if that is certainly above a cost; whether
        that was so, or nothing is left of them.
        """
        part = roughly(self.task, first, last) if first <= last else None
        if part is None or part.is_empty:
            return True
        cost = part.cost(self.task.objective)
        if not cost > above + ROUNDING:
            return False
        heapq.heappush(self.parts, (cost, first, last))
        return True

    def pop(self) -> tuple[float, int, int]:
        """The samples that look best, and what they cost at least."""
        return heapq.heappop(self.parts)


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
