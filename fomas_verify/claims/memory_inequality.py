"""Inequality (14) [eqT2]: ``beta^(k+1) + sum_{l=1}^{k+1} abs f(l) <= 1`` for every k >= 0.

By telescoping and log-convexity of c_n it holds for every k iff ``-sqrt(c_2) <= beta <= c_1``, with ``c_1 = 2^alpha
- 1`` and ``c_2 = 3^alpha - 2^alpha`` (theory, section 2). Equality on the left never happens, on the right with a
rational mu
only at alpha = 1/2 (theory, section 7), where it is decided exactly.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from fomas_verify.claims.remedy import Gained, lower_mu, raise_mu
from fomas_verify.claims.verdict import Decision, Verdict, undecided
from fomas_verify.enclosure.digits import decimal, rounded_up
from fomas_verify.enclosure.interval import Interval
from fomas_verify.enclosure.real import log2, square_root
from fomas_verify.exact.polynomial import divides, polynomial, scaled_roots
from fomas_verify.kernel.memory import step_response
from fomas_verify.spectrum import margins
from fomas_verify.spectrum.boxes import beta_at_most_threshold, beta_over
from fomas_verify.spectrum.loop import Loop
from fomas_verify.spectrum.precision import PRECISIONS
from fomas_verify.spectrum.samples import Box

ID = "memory-inequality"
STATEMENT = "beta^(k+1) + sum_{l=1}^{k+1} abs f(l) <= 1 for every k >= 0 (inequality (14) [eqT2])"
SOURCE = "eqT2"
COQ = "eqT2_closed_form"
FIRST = "The paper's condition (14) fails, and with it relation eqL3: some initial state has norm u_1 > norm u_0."
SECOND = "The paper's condition (14) fails, so its Theorem 1 says nothing about this design."


def decide(loop: Loop) -> Decision:
    """Compare beta with both ends of the closed form, as to the truth."""
    for bits in PRECISIONS:
        beta, upper, lower = loop.beta(bits), loop.threshold(bits), loop.lower_threshold(bits)
        if beta.upper < upper.lower and beta.lower > lower.upper:
            slack = decimal(upper - beta, 12)
            return Decision(
                Verdict.PROVED,
                {},
                f"beta = {decimal(beta, 20)} < 2^alpha - 1 = {decimal(upper, 20)}; difference {slack}",
            )
        if beta.lower > upper.upper:
            return _refuted_at_first_sample(loop, beta, upper, bits)
        if beta.upper < lower.lower:
            return _refuted_at_second_sample(loop, beta, lower)
        if beta.overlaps(upper) and _is_tie(loop, bits):
            return Decision(Verdict.PROVED, {}, f"beta = 2^alpha - 1 = {decimal(upper, 20)} exactly: equality at k = 0")
    return undecided(bits, f"beta = {decimal(beta, 20)} and 2^alpha - 1 = {decimal(upper, 20)}")


def holds_over(loop: Loop, box: Box, bits: int) -> dict[str, Any] | None:
    """The witness that it holds for every (alpha, mu) of a box; None where that was not seen. Rigorous.

    ``c_1`` and ``c_2`` increase with alpha, so the least alpha decides.
    """
    lower = -square_root(step_response(box.alpha.lower, 2, bits), bits)
    holds = beta_at_most_threshold(loop, box, bits) and beta_over(loop, box, bits).lower >= lower.upper
    return {} if holds else None


def _refuted_at_first_sample(loop: Loop, beta: Interval, threshold: Interval, bits: int) -> Decision:
    return Decision(
        Verdict.REFUTED,
        {"k": 0},
        f"beta = {decimal(beta, 20)} > 2^alpha - 1 = {decimal(threshold, 20)}: it fails at k = 0",
        meaning=FIRST,
        remedy=raise_or_none(loop, margins.memory_inequality(loop).lower, bits),
    )


def raise_or_none(loop: Gained, least: Interval, bits: int) -> str:
    """The least mu for (14), unless the gain bound (15) excludes it."""
    bound = 1 / loop.degree_max
    if least.upper < bound:
        return raise_mu(loop, least.upper, below=bound)
    if least.lower < bound:
        return f"(14) needs mu >= {decimal(least, 30)}, at the very edge of (15)"
    alpha = log2(2 - loop.lambda2(bits) / loop.degree_max, bits)
    return (
        "no gamma and no h meets (14) and (15) together on this graph at this alpha: "
        f"(14) needs mu >= {decimal(least, 6)}, "
        f"(15) mu < {decimal(Interval.exactly(bound), 6)}; an alpha above {rounded_up(alpha.upper, 6)} opens a region"
    )


def _refuted_at_second_sample(loop: Loop, beta: Interval, lower: Interval) -> Decision:
    return Decision(
        Verdict.REFUTED,
        {"k": 1},
        f"beta = {decimal(beta, 20)} < -sqrt(3^alpha - 2^alpha) = {decimal(lower, 20)}: it fails at k = 1",
        meaning=SECOND,
        remedy=lower_mu(loop, margins.memory_inequality(loop).inner[1]),
    )


def _is_tie(loop: Loop, bits: int) -> bool:
    """Whether ``mu lambda2 = 2 - sqrt 2`` exactly: the polynomial of 2 -+ sqrt 2, scaled, divides that of L_s, and
    lambda2 is its smaller root.
    """
    mu = loop.mu(bits)
    if loop.design.alpha != Fraction(1, 2) or not mu.is_exact:
        return False
    quadratic = scaled_roots(polynomial([2, -4, 1]), loop.symmetric_scale / mu.lower)
    lambda2 = loop.lambda2(bits)
    tie = (1 - loop.threshold(bits)) / mu
    neighbours = [root for root, _ in loop.symmetric_spectrum(bits) if root.overlaps(tie)]
    isolated = len(neighbours) == 1 and neighbours[0].overlaps(lambda2)
    return isolated and divides(quadratic, loop.symmetric_characteristic)
