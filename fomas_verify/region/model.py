"""What is found of one condition: on which mu it holds, at one alpha and graph, and which alpha open it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Any

from fomas_verify.enclosure.interval import Interval
from fomas_verify.region.least_factor import LeastFactor
from fomas_verify.spectrum.loop import Loop
from fomas_verify.spectrum.margins import MuMargin


class Condition(StrEnum):
    """The conditions of theory, section 5, in the order in which they are shown."""

    AS_STATED = "as-stated"
    CLOSED_FORM = "repaired-closed-form"
    REPAIRED = "repaired"
    GAIN_BOUND = "gain-bound"
    CONSENSUS = "consensus"


@dataclass(frozen=True)
class Opening:
    """No mu will do for any alpha below ``alpha.lower``, some mu will for every alpha above ``alpha.upper``."""

    alpha: Interval
    witness: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class Strip:
    """The mu of one condition.

    Attributes
    ----------
    condition : Condition
        Which.
    mu : MuMargin or None
        Every mu of ``inner``, ends included, is feasible, none outside ``outer`` is; None where none is at all.
    opening : Opening or None
        Which alpha open it; None where every alpha of (0, 1) does, or none.
    empty : mapping
        What shows that no mu is feasible, where that takes more than a comparison.
    """

    condition: Condition
    mu: MuMargin | None
    opening: Opening | None = None
    empty: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class Region:
    """The strips of one design, one for each condition, and the best contraction (None: agreement in one step, or
    Assumption 1 fails).
    """

    loop: Loop
    strips: tuple[Strip, ...]
    best: LeastFactor | None

    def strip(self, condition: Condition) -> Strip:
        """That of one condition."""
        return next(strip for strip in self.strips if strip.condition is condition)
