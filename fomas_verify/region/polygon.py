"""What the limits leave of a strip: polyhedra in (log gamma, log h), by their vertices.

Each vertex lies on two of the lines: a limit of gamma, a limit of h, an end of the strip ``mu Gamma(alpha + 1) = gamma
h^alpha``. Its numbers are enclosed. Source: theory, section 5.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from fractions import Fraction

from fomas_verify.enclosure.interval import Interval
from fomas_verify.enclosure.real import power_of, root_of
from fomas_verify.region.clash import clash
from fomas_verify.region.levels import enclosed_level, level
from fomas_verify.region.model import Condition, Region
from fomas_verify.region.task import Objective, Task, require_complete
from fomas_verify.region.tradeoff import best_piece, log, samples_range
from fomas_verify.spectrum.margins import BITS

MOST_PIECES = 32
"""Numbers of samples whose polyhedra are given, of one condition."""

MOST_SAMPLES = 400
"""How many numbers of samples are looked at."""


class BeyondNumbersError(ArithmeticError):
    """A corner has a number that is too large or too small to be given."""


@dataclass(frozen=True)
class Vertex:
    """A corner of a polyhedron, its numbers enclosed."""

    gamma: Interval
    h: Interval


@dataclass(frozen=True)
class Polyhedron:
    """What is left for so many samples (None: settling is not limited); ``unbounded``: it reaches to where gamma, h or
    mu is 0 or has no end.
    """

    samples: int | None
    vertices: tuple[Vertex, ...]
    unbounded: bool


@dataclass(frozen=True)
class Room:
    """What the limits leave of one condition.

    Attributes
    ----------
    condition : Condition
        Which.
    pieces : tuple of Polyhedron
        Their union is what is left; at most 32 of them.
    more : bool
        Whether there are further ones.
    clash : str or None
        Why nothing is left; proved. None and no pieces: not decided.
    peak_bound : Fraction or None
        The constant that stands for the peak in the limit u_max; None: none holds on the whole strip, and u_max is
        taken for the first control alone, which does not suffice.
    """

    condition: Condition
    pieces: tuple[Polyhedron, ...]
    more: bool
    clash: str | None
    peak_bound: Fraction | None


def rooms(region: Region) -> tuple[Room, ...]:
    """What the limits of the region's design leave of each condition; rigorous."""
    design = region.loop.design
    require_complete(design)
    return tuple(_told(Task(region, strip.condition, Objective.ROBUST, design.limits)) for strip in region.strips)


def _told(task: Task) -> Room:
    """What is left, not decided where it has corners that cannot be given."""
    try:
        return _room(task)
    except BeyondNumbersError:
        return Room(task.condition, (), False, None, None)


def _room(task: Task) -> Room:
    if not task.loop.assumption1 and task.strip is not None:
        # Only gain-bound has a strip there, and nothing settles.
        task = replace(task, limits=replace(task.limits, settle_within=None, u_max=None))
    peak = task.peak if task.limits.u_max is not None else None
    if task.strip is None or best_piece(task) is None:
        return Room(task.condition, (), False, clash(task), peak)
    if task.settle_to is None:
        only = _polyhedron(task, None)
        return Room(task.condition, () if only is None else (only,), False, None, peak)
    first, last = samples_range(task)
    pieces: list[Polyhedron] = []
    for k in range(first, min(last, first + MOST_SAMPLES) + 1):
        found = _polyhedron(task, k)
        if found is not None:
            pieces.append(found)
        if len(pieces) == MOST_PIECES:
            return Room(task.condition, tuple(pieces), k < last, None, peak)
        if _whole(task, k):
            return Room(task.condition, tuple(pieces), False, None, peak)
    return Room(task.condition, tuple(pieces), last > first + MOST_SAMPLES, None, peak)


def _whole(task: Task, samples: int) -> bool:
    """Whether the whole strip settles in so many samples, so that more of them leave less."""
    strip = task.strip
    found = level(task.loop, task.settle_to, samples) if task.settle_to is not None else None
    return strip is not None and found is not None and found.lower <= strip.inner[0] and strip.inner[1] <= found.upper


def _polyhedron(task: Task, samples: int | None) -> Polyhedron | None:
    """The polyhedron of one number of samples; None where it is empty."""
    strip, box = task.strip, task.box
    if strip is None:
        return None
    ends, longest = (strip.lower, strip.upper), box.h[1]
    if samples is not None and task.settle_to is not None and task.within is not None:
        found = enclosed_level(task.loop, task.settle_to, samples)
        if found is None:
            return None
        low, high = found
        ends = max(ends[0], low, key=lambda x: x.lower), min(ends[1], high, key=lambda x: x.upper)
        longest = min(task.within / samples, longest or task.within)
    gammas, hs = (box.gamma_least, box.gamma_sure), (box.h[0], longest)
    vertices = _around(list(_vertices(task, ends, gammas, hs)))
    long_h, long_gamma = hs[1] is None and not gammas[0], gammas[1] is None and not hs[0]
    thin = ends[0].upper == 0 and not (gammas[0] and hs[0])
    unbounded = long_h or long_gamma or thin
    return Polyhedron(samples, tuple(vertices), unbounded) if vertices or unbounded else None


def _vertices(
    task: Task,
    ends: tuple[Interval, Interval],
    gammas: tuple[Fraction, Fraction | None],
    hs: tuple[Fraction, Fraction | None],
) -> Iterator[Vertex]:
    alpha, scale = task.design.alpha, task.gamma_function
    at_h = [(Interval.exactly(h), power_of(Interval.exactly(h), alpha, BITS)) for h in dict.fromkeys(hs) if h]
    at_gamma = [Interval.exactly(gamma) for gamma in dict.fromkeys(gammas) if gamma]
    low, high = ends[0] * scale, ends[1] * scale
    for h, power in at_h:
        for gamma in at_gamma:
            m = gamma * power
            if low.lower <= m.upper and m.lower <= high.upper:
                yield Vertex(gamma, h)
        for m in (low, high):
            if m.lower > 0 and _within(m / power, gammas):
                yield Vertex(m / power, h)
    for gamma in at_gamma:
        for m in (low, high):
            if m.lower <= 0:
                continue
            if (root := root_of(m / gamma, alpha, BITS)) is not None:
                if _within(root, hs):
                    yield Vertex(gamma, root)
            elif not (hs[0] if m.upper < gamma.lower else hs[1]):
                raise BeyondNumbersError("h of a corner is beyond 2^-8192 or 2^8192")


def _within(x: Interval, limits: tuple[Fraction, Fraction | None]) -> bool:
    return limits[0] <= x.upper and (limits[1] is None or x.lower <= limits[1])


def _around(vertices: list[Vertex]) -> list[Vertex]:
    """The vertices in order around their middle, each once."""
    if not vertices:
        return []
    x0, y0 = (sum(map(log, xs)) / len(xs) for xs in ([v.h.mid for v in vertices], [v.gamma.mid for v in vertices]))
    kept: list[Vertex] = []
    for v in sorted(vertices, key=lambda v: math.atan2(log(v.gamma.mid) - y0, log(v.h.mid) - x0)):
        if not any(v.gamma.overlaps(w.gamma) and v.h.overlaps(w.h) for w in kept):
            kept.append(v)
    return kept
