"""The best gamma and h under a condition and limits: searched directly, rounded, proved; or the proof that none exist.

Source: theory, section 5. What is sought by floats is only proposed; every point, every refutation and every bound of
the best is decided in exact and interval arithmetic.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any

from fomas_verify.enclosure.digits import rounded_down, rounded_up
from fomas_verify.region.errors import UndecidedRegionError
from fomas_verify.region.refutation import as_given, better_than, blocks, most_robust_is_at_most
from fomas_verify.region.rounding import Point, rounded
from fomas_verify.region.task import Objective, Task
from fomas_verify.region.tradeoff import Best, best_piece

SLACKS = (1e-9, 1e-6, 1e-4, 1e-2)
"""By how much of itself a bound of the best lies beyond what the search found, tried in turn."""

BOUND_DIGITS = 12


@dataclass(frozen=True)
class Answer:
    """What is the answer to a task.

    Attributes
    ----------
    point : Point or None
        A proved gamma and h; None: none exist, as `blocks` show.
    piece : Best or None
        Where the search found the best, before it was rounded.
    bound : Fraction or None
        Nothing that satisfies condition and limits is as good: no h at or above it, no gamma or settling time at or
        below it, no factor at or above it. None: how near the point is to the best was not proved.
    blocks : list
        What shows it, by docs/certificate-format.md, section 9.
    """

    task: Task
    point: Point | None
    piece: Best | None = None
    bound: Fraction | None = None
    blocks: list[Mapping[str, Any]] = field(default_factory=list)


def synthesize(task: Task) -> Answer:
    """Answer a task, by the direct search. Rigorous but for `piece`.

    Raises
    ------
    UndecidedRegionError
        No point was proved, and that there is none neither.
    """
    found = best_piece(task)
    point = None if found is None else rounded(task, found.piece)
    if found is None or point is None:
        shown = blocks(as_given(task))
        if shown is None:
            raise UndecidedRegionError(
                f"{task.design.source}: neither a design within the limits nor the proof that there is none was found"
            )
        return Answer(task, None, blocks=[*shown])
    bound, proof = _bounded(task, found.bound)
    return Answer(task, point, found, bound, proof)


def _bounded(task: Task, cost: float) -> tuple[Fraction | None, list[Mapping[str, Any]]]:
    """A number that nothing is as good as, near what the search found, and what shows it; rigorous."""
    larger = task.objective in (Objective.SLOWEST, Objective.ROBUST)
    if not math.isfinite(cost) or abs(cost) > 700 or (task.objective is Objective.ROBUST and cost >= 0):
        return None, []
    best = math.exp(-cost if larger else cost)
    for slack in SLACKS:
        moved = Fraction(best * (1 + slack if larger else 1 - slack))
        bound = Fraction((rounded_up if larger else rounded_down)(moved, BOUND_DIGITS))
        if task.objective is Objective.ROBUST:
            if most_robust_is_at_most(task, bound):
                return bound, []
        elif (shown := blocks(better_than(task, bound))) is not None:
            return bound, [*shown]
    return None, []
