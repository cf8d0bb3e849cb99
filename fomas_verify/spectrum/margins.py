"""On which mu each claim is true: an interval for each, its ends enclosed, with short rationals on both sides of them.

Source: theory, section 8; docs/certificate-format.md, section 3, "margins".
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any

from fomas_verify.enclosure.interval import Interval, is_dyadic, short_dyadic
from fomas_verify.spectrum.contraction import contraction_interval
from fomas_verify.spectrum.loop import Loop, sigma_at
from fomas_verify.spectrum.precision import PRECISIONS
from fomas_verify.spectrum.remembered import of_graph, of_loop, of_order
from fomas_verify.spectrum.stability import (
    at,
    invariant_form,
    large_trace_power,
    lyapunov_form_within,
    mu_star,
)

BITS = 192
FINE = 72
"""An end of memory-inequality and of repaired-condition is passed on either side by 2^-72 to 2^-71 of itself."""

STABILITY_GAPS = (26, 18, 12, 8, 5, 3)
"""The same for mu*, tried in turn: a Lyapunov form grows as its matrix nears the circle."""

LYAPUNOV_PRECISIONS, LYAPUNOV_WORK = (128, 512, 1024), 1 << 35
"""The bits at which a form is sought, and a bound on ``N^3 bits^2`` for all but the first."""

POWER_WORK = 1 << 33
"""Bound on ``N^3 log2(n)^2`` for a power n whose trace shows an eigenvalue outside the disc."""


@dataclass(frozen=True)
class MuMargin:
    """A claim is true for ``a < mu < b`` and false for ``0 < mu < c`` and ``mu > d``; ``inner`` is (a, b), ``outer``
    (c, d).

    ``lower`` and ``upper`` enclose the ends of the true interval more closely; ``witness`` shows b and d where no
    comparison does.
    """

    lower: Interval
    upper: Interval
    inner: tuple[Fraction, Fraction]
    outer: tuple[Fraction, Fraction]
    witness: Mapping[str, Any] = field(default_factory=dict)


@of_graph
def gain_bound(loop: Loop) -> MuMargin | None:
    """``mu < 1/D``, exactly; None without edges, where every mu will do."""
    if loop.degree_max == 0:
        return None
    zero, end = Fraction(0), 1 / loop.degree_max
    return MuMargin(Interval.exactly(0), Interval.exactly(end), (zero, end), (zero, end))


@of_order
def memory_inequality(loop: Loop) -> MuMargin:
    """``(2 - 2^alpha)/lambda2 <= mu <= (1 + sqrt(c_2))/lambda2``; under Assumption 1. Rigorous."""
    lambda2 = loop.lambda2(BITS)
    lower, upper = (1 - loop.threshold(BITS)) / lambda2, (1 - loop.lower_threshold(BITS)) / lambda2
    inner = above(lower.upper, FINE), below(upper.lower, FINE)
    return MuMargin(lower, upper, inner, (below(lower.lower, FINE), above(upper.upper, FINE)))


@of_order
def repaired_region(loop: Loop) -> Interval | None:
    """An interval outside which no mu has ``sigma(mu) <= 2^alpha - 1``; None where no mu at all has it. Rigorous."""
    return contraction_interval(loop, loop.threshold(BITS))


@of_order
def repaired_condition(loop: Loop) -> MuMargin | None:
    """``sigma(mu) <= 2^alpha - 1``; under Assumption 1. None where no mu has it, or none was found. Rigorous."""
    threshold, region = loop.threshold(BITS), repaired_region(loop)
    if region is None:
        return None

    def holds(mu: Fraction) -> bool:
        return sigma_at(loop.laplacian, mu, BITS).upper <= threshold.lower

    for shift in (FINE, 56, 40, 24, 12):
        a, b = above(region.lower, shift), below(region.upper, shift)
        if a < b and holds(a) and holds(b):
            outer = below(region.lower, FINE), above(region.upper, FINE)
            return MuMargin(Interval(region.lower, a), Interval(b, region.upper), (a, b), outer)
    return None


@of_loop
def perron_eigenvalues(loop: Loop, gaps: tuple[int, ...] = STABILITY_GAPS) -> MuMargin | None:
    """``mu < mu*``, passed on either side by the first of the gaps that a witness is found for; None where no mu will
    do, or no witness was found within the work allowed. Rigorous.
    """
    star = next((star for bits in PRECISIONS[:3] if (star := mu_star(loop, bits)) is not None), None)
    if star is None or star.lower <= 0:
        return None
    inside, outside = _last_stable(loop, star, gaps), _first_unstable(loop, star, gaps)
    if inside is None or outside is None:
        return None
    (b, q), (d, shown) = inside, outside
    zero = Fraction(0)
    return MuMargin(Interval.exactly(0), star, (zero, b), (zero, d), {"Q": q} | shown)


def _last_stable(loop: Loop, star: Interval, gaps: tuple[int, ...]) -> tuple[Fraction, list[list[Fraction]]] | None:
    """A number just below mu*, and a Lyapunov form there."""
    for gap in gaps:
        t = below(star.lower, gap)
        for bits in LYAPUNOV_PRECISIONS:
            within = bits == LYAPUNOV_PRECISIONS[0] or loop.design.graph.agents**3 * bits**2 <= LYAPUNOV_WORK
            if within and (form := lyapunov_form_within(at(loop, t), bits)) is not None:
                return t, form
    return None


def _first_unstable(loop: Loop, star: Interval, gaps: tuple[int, ...]) -> tuple[Fraction, dict[str, Any]] | None:
    """A number at or just above mu*, and what shows that P is not Schur there."""
    if star.is_exact and (is_dyadic(star.lower) or star.lower in (loop.design.mu, 1 / loop.degree_max)):
        form = invariant_form(loop, star.lower, PRECISIONS[0])
        if form is not None:
            return star.lower, {"Y": form}
    for gap in gaps:
        t = above(star.upper, gap)
        power = large_trace_power(loop, t, PRECISIONS[0])
        if power is not None and loop.design.graph.agents**3 * power.bit_length() ** 2 <= POWER_WORK:
            return t, {"power": power}
    return None


def above(x: Fraction, shift: int) -> Fraction:
    """A short number above x > 0, by ``2^-shift`` to ``2^(1-shift)`` of it."""
    unit = x / (1 << shift)
    return short_dyadic(x + unit, x + 2 * unit)


def below(x: Fraction, shift: int) -> Fraction:
    """A short number below x > 0, by as much."""
    unit = x / (1 << shift)
    return short_dyadic(x - 2 * unit, x - unit)
