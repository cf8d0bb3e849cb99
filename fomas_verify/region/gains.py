"""From the mu of a strip to its gamma at one h, or its h at one gamma: ``mu = gamma h^alpha / Gamma(alpha + 1)``."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from fomas_verify.enclosure.interval import Interval
from fomas_verify.enclosure.real import root_of
from fomas_verify.exact.rational import format_rational
from fomas_verify.kernel.memory import one_step_weight
from fomas_verify.region.model import Condition, Region, Strip
from fomas_verify.spectrum.margins import BITS


@dataclass(frozen=True)
class Span:
    """An interval of mu, gamma or h, its ends enclosed, and which of them belong to it."""

    lower: Interval
    upper: Interval
    closed: tuple[bool, bool]


@dataclass(frozen=True)
class Section:
    """The strips at the design's own h or gamma: the name of the number that is left free, and where they are cut; None
    where an end of that is beyond all numbers given.
    """

    free: str
    at: str
    spans: tuple[tuple[Condition, Span | None], ...]


def span_of(region: Region, strip: Strip) -> Span | None:
    """The mu of a strip; None where it is empty."""
    if strip.mu is None:
        return None
    strict = strip.condition is Condition.CONSENSUS or strip.mu.upper == Interval.exactly(1 / region.loop.degree_max)
    return Span(strip.mu.lower, strip.mu.upper, (strip.mu.outer[0] > 0, not strict))


def section(region: Region) -> Section | None:
    """The gamma that go with the design's h; where it gives gamma alone, the h that go with that; None without both."""
    design = region.loop.design
    spans = [(strip.condition, span) for strip in region.strips if (span := span_of(region, strip)) is not None]
    if design.h is not None:
        weight = one_step_weight(design.alpha, design.h, BITS)
        of_h = tuple((name, Span(x.lower / weight, x.upper / weight, x.closed)) for name, x in spans)
        return Section("gamma", f"h = {format_rational(design.h)}", of_h)
    if design.gamma is None:
        return None
    at_one = one_step_weight(design.alpha, Fraction(1), BITS) * design.gamma
    cut = []
    for name, x in spans:
        lower, upper = (_root(end / at_one, design.alpha) for end in (x.lower, x.upper))
        cut.append((name, None if lower is None or upper is None else Span(lower, upper, x.closed)))
    return Section("h", f"gamma = {format_rational(design.gamma)}", tuple(cut))


def _root(x: Interval, alpha: Fraction) -> Interval | None:
    """``x^(1/alpha)``; exact at 0."""
    return x if x.upper == 0 else root_of(x, alpha, BITS)
