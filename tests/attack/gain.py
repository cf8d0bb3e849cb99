"""Three-valued answers about a design's gain: mu against a rational, and the sign of a number known to any digits."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import Any

from . import oracle
from .model import Design

Truth = bool | None


def both(*parts: Truth) -> Truth:
    """Three-valued and."""
    return False if False in parts else None if None in parts else True


def positive(design: Design, margin: Callable[[int], Any], exact: Callable[[], Truth] | None = None) -> Truth:
    """Whether a real number is >= 0, given its value at any number of digits; ties by the exact test or not at all."""
    return oracle.settle(design, margin, exact).truth


def mu_at_most(design: Design, t: Fraction) -> Truth:
    """mu <= t."""
    if design.mu is not None:
        return design.mu <= t
    return positive(design, lambda dps: oracle.real(t) - oracle.mu(design, dps + 10))


def mu_at_least(design: Design, t: Fraction) -> Truth:
    """mu >= t."""
    if design.mu is not None:
        return design.mu >= t
    return positive(design, lambda dps: oracle.mu(design, dps + 10) - oracle.real(t))
