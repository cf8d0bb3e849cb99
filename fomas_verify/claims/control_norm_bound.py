"""Relation eqL3: ``norm u_k <= norm u_0`` for every k and every x_0.

``u_k = Phi_k(P) u_0``, so it holds iff no ``Phi_k`` has a norm above 1 on 1perp. Finitely many samples decide
(theory, section 3, peak control). On a symmetric graph it holds iff ``beta <= 2^alpha - 1`` and ``mu lambda_N <= 2``
(theory, section 7).
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from fomas_verify.claims import repaired_condition
from fomas_verify.claims.verdict import Decision, Verdict, undecided
from fomas_verify.enclosure.digits import decimal
from fomas_verify.enclosure.interval import Interval, short_dyadic
from fomas_verify.spectrum.boxes import beta_at_most_threshold, sigma_at_most_threshold, tail_over
from fomas_verify.spectrum.control import state_above
from fomas_verify.spectrum.loop import Loop
from fomas_verify.spectrum.precision import SAMPLE_PRECISIONS
from fomas_verify.spectrum.samples import Box, Search, first_above, search
from fomas_verify.spectrum.stability import Side, stability

ID = "control-norm-bound"
STATEMENT = "norm u_k <= norm u_0 for every k >= 0 and every x_0 (relation eqL3)"
SOURCE = "eqL3"
COQ = "peak_lemma"
MEANING = (
    "The paper's relation eqL3 is false for this design: from some initial states a later control exceeds the first, "
    "so size the actuator for the peak, not for u_0."
)


def decide(loop: Loop) -> Decision:
    """Whether the peak of the control is its first value, as to the truth."""
    for bits in SAMPLE_PRECISIONS:
        if loop.sigma(bits).upper <= loop.threshold(bits).lower:
            return Decision(Verdict.PROVED, {}, "sigma <= 2^alpha - 1: the repaired Theorem 1")
        if (witness := symmetric_witness(loop, the_point(loop, bits), bits)) is not None:
            return Decision(Verdict.PROVED, witness, "symmetric graph, beta <= 2^alpha - 1 and mu lambda_N <= 2")
        found = examine(loop, bits)
        if found.above is not None and (x0 := state_above(loop, found.above, bits)) is not None:
            return Decision(Verdict.REFUTED, {"x0": x0, "k": found.above}, _reason(found), MEANING, remedy(loop))
        if found.peak is not None and found.peak.decided and found.above is None:
            tail = found.peak.tail
            reason = f"no Phi_k has a norm above 1: k = 1..{tail.last} one by one, and the rest by the decay of P^n"
            reason = reason if tail.last else "no Phi_k has a norm above 1, by the decay of P^n"
            return Decision(Verdict.PROVED, {"samples": tail.last, "powers": tail.powers}, reason)
        if found.peak is None:
            break
    if "power" in (growth := stability(loop).witness):
        return Decision(Verdict.REFUTED, growth, "norm u_k grows without bound", MEANING, remedy(loop))
    return undecided(bits, "the samples within the work allowed do not tell whether every norm Phi_k is at most 1")


def examine(loop: Loop, bits: int) -> Search:
    """The search of the peak where there is one, and of a sample above 1 otherwise."""
    if stability(loop).side is Side.INSIDE:
        return search(loop, bits)
    return Search(None, first_above(loop, bits))


def holds_over(loop: Loop, box: Box, bits: int) -> dict[str, Any] | None:
    """The witness that it holds for every (alpha, mu) of a box; None where that was not seen. Rigorous."""
    if sigma_at_most_threshold(loop, box, bits):
        return {}
    if (witness := symmetric_witness(loop, box, bits)) is not None:
        return witness
    tail = tail_over(loop, box, bits)
    return None if tail is None else {"samples": tail.last, "powers": tail.powers}


def the_point(loop: Loop, bits: int) -> Box:
    """The loop's own alpha and mu."""
    return Box(Interval.exactly(loop.design.alpha), loop.mu(bits))


def symmetric_witness(loop: Loop, box: Box, bits: int) -> dict[str, Any] | None:
    """What shows it on a symmetric graph at this precision, all over a box: ``mu lambda_N <= 2`` in short numbers, and
    beta below the threshold.
    """
    if loop.laplacian != loop.laplacian.transpose() or not beta_at_most_threshold(loop, box, bits):
        return None
    mu, largest = box.mu.upper, loop.lambda_max(bits).upper
    room = (2 / (mu * largest) - 1) / 3
    if room < 0:
        return None
    if room > 0:
        mu, largest = (short_dyadic(x, x * (1 + min(room, Fraction(1)))) for x in (mu, largest))
    return {"mu": mu, "lambda_max_upper": largest}


def _reason(found: Search) -> str:
    if found.peak is None:
        return f"norm Phi_{found.above} > 1 on the vectors that sum to 0"
    peak = found.peak
    return f"the peak of norm u_k / norm u_0 over every x_0 is {decimal(peak.value, 18)}, at k = {peak.at}"


def remedy(loop: Loop) -> str:
    """The repaired condition suffices."""
    found = repaired_condition.remedy(loop)
    if found.startswith("no gamma"):
        return f"none by the repaired condition, which would suffice: {found}"
    return f"the repaired condition suffices: {found}"
