"""What was measured of a method, and the power law through it."""

from __future__ import annotations

import math
from dataclasses import dataclass

from benchmarks.topics import Method

SECONDS, MEMORY = 60.0, 8192.0
"""The budget within which a method is called usable: seconds, and MB."""

LEAST_SECONDS, LEAST_MEMORY = 0.02, 5.0
"""What is smaller is start-up and says nothing of how a method grows."""


@dataclass(frozen=True)
class Point:
    """At a size: CPU seconds of the work, peak memory in MB of its process."""

    size: int
    seconds: float
    memory: float


@dataclass(frozen=True)
class Power:
    """``value = factor size^exponent``."""

    factor: float
    exponent: float

    def at(self, size: float) -> float:
        return self.factor * size**self.exponent

    def size_for(self, value: float) -> float:
        """The size at which it is reached; infinite where it does not grow."""
        return (value / self.factor) ** (1 / self.exponent) if self.exponent > 0.05 else math.inf


def fit(pairs: list[tuple[float, float]]) -> Power | None:
    """The least squares line in logarithms; None through fewer than two sizes."""
    if len({x for x, _ in pairs}) < 2:
        return None
    xs, ys = [math.log(x) for x, _ in pairs], [math.log(y) for _, y in pairs]
    x, y = sum(xs) / len(xs), sum(ys) / len(ys)
    exponent = sum((a - x) * (b - y) for a, b in zip(xs, ys, strict=True)) / sum((a - x) ** 2 for a in xs)
    return Power(math.exp(y - exponent * x), exponent)


@dataclass(frozen=True)
class Series:
    """A method's points by size."""

    method: Method
    points: tuple[Point, ...]

    @property
    def time(self) -> Power | None:
        """The model of its time, from the sizes that take more than start-up; from the last two where none do."""
        long = [(p.size, p.seconds) for p in self.points if p.seconds >= LEAST_SECONDS]
        return fit(long if len(long) > 1 else [(p.size, max(p.seconds, 1e-6)) for p in self.points[-2:]])

    @property
    def grows(self) -> bool:
        """Whether its memory does."""
        return max(p.memory for p in self.points) - min(p.memory for p in self.points) >= LEAST_MEMORY

    @property
    def growth(self) -> Power | None:
        """The model of the memory beyond that of its smallest size; None where fewer than two sizes need more."""
        least = min(p.memory for p in self.points)
        return fit([(p.size, p.memory - least) for p in self.points if p.memory - least >= LEAST_MEMORY])

    @property
    def usable(self) -> tuple[float, str] | None:
        """The size up to which it stays within the budget, and what ends it."""
        if self.time is None:
            return None
        by_time = self.time.size_for(SECONDS)
        least = min(p.memory for p in self.points)
        by_memory = math.inf if self.growth is None else self.growth.size_for(MEMORY - least)
        return (by_time, "time") if by_time <= by_memory else (by_memory, "memory")

    def at(self, size: int) -> float | None:
        """Seconds at a size, where it was measured."""
        return next((p.seconds for p in self.points if p.size == size), None)

    def between(self, size: int) -> float | None:
        """Seconds by the power law through the next smaller and the next larger size."""
        pairs = [(p.size, max(p.seconds, 1e-6)) for p in self.points]
        below, above = [x for x in pairs if x[0] < size], [x for x in pairs if x[0] > size]
        line = fit([max(below), min(above)]) if below and above else None
        return None if line is None else line.at(size)
