"""``sigma <= 2^alpha - 1``: the repaired Theorem 1's condition, for which norm u_k <= norm u_0 for every k and every
x_0.

Equality never happens for a rational mu (theory, section 7). Source: theory, section 3, "Repaired Theorem 1".
"""

from __future__ import annotations

from typing import Any

from fomas_verify.claims.remedy import DIGITS, lower_mu, raise_mu
from fomas_verify.claims.verdict import Decision, Verdict, undecided
from fomas_verify.enclosure.digits import decimal, rounded_down, rounded_up
from fomas_verify.spectrum import margins
from fomas_verify.spectrum.boxes import sigma_at_most_threshold
from fomas_verify.spectrum.contraction import direction_above
from fomas_verify.spectrum.loop import Loop
from fomas_verify.spectrum.margins import repaired_region
from fomas_verify.spectrum.precision import PRECISIONS
from fomas_verify.spectrum.remembered import of_loop
from fomas_verify.spectrum.samples import Box

ID = "repaired-condition"
STATEMENT = "norm of P e <= (2^alpha - 1) norm of e for every e that sums to 0 (sigma <= 2^alpha - 1)"
SOURCE = "theory, section 3"
COQ = "theorem1_repaired"
MEANING = (
    "The repaired Theorem 1 does not cover this design: "
    "it does not establish that norm u_k never exceeds norm u_0 for every initial state."
)


def decide(loop: Loop) -> Decision:
    """Compare sigma with 2^alpha - 1, as to the truth."""
    for bits in PRECISIONS:
        sigma, threshold = loop.sigma(bits), loop.threshold(bits)
        numbers = f"sigma = {decimal(sigma, 18)}", f"2^alpha - 1 = {decimal(threshold, 18)}"
        if sigma.upper < threshold.lower:
            return Decision(Verdict.PROVED, {}, " < ".join(numbers))
        if sigma.lower > threshold.upper and (e := direction_above(loop, threshold, bits)) is not None:
            return Decision(Verdict.REFUTED, {"e": e}, " > ".join(numbers), MEANING, remedy(loop))
    return undecided(bits, " and ".join(numbers))


def holds_over(loop: Loop, box: Box, bits: int) -> dict[str, Any] | None:
    """The witness that it holds for every (alpha, mu) of a box; None where that was not seen. Rigorous."""
    return {} if sigma_at_most_threshold(loop, box, bits) else None


@of_loop
def remedy(loop: Loop) -> str:
    """The nearest mu that satisfies the condition, seen to satisfy it; or that there is none."""
    region, margin = repaired_region(loop), margins.repaired_condition(loop)
    if region is None:
        return "no gamma and no h gives it on this graph at this alpha: no mu at all has sigma <= 2^alpha - 1"
    if margin is None:
        lower, upper = rounded_down(region.lower, DIGITS), rounded_up(region.upper, DIGITS)
        return f"only mu between {lower} and {upper} can have it"
    least, most = margin.inner
    low = loop.mu(128).mid < region.mid
    beyond = " (beyond the gain bound (15))" if (least if low else most) * loop.degree_max >= 1 else ""
    return (raise_mu(loop, least, below=most) if low else lower_mu(loop, most, above=least)) + beyond
