"""``norm u_k <= norm u_0`` for every k, for the x_0 of the design. Source: the paper's eqL3; theory, section 3."""

from __future__ import annotations

from typing import Any

from fomas_verify.claims.control_norm_bound import symmetric_witness, the_point
from fomas_verify.claims.verdict import Decision, Verdict, undecided
from fomas_verify.enclosure.digits import decimal
from fomas_verify.exact.matrix import apply
from fomas_verify.spectrum.boxes import sigma_at_most_threshold, tail_over
from fomas_verify.spectrum.control import follow
from fomas_verify.spectrum.loop import Loop
from fomas_verify.spectrum.precision import SAMPLE_PRECISIONS
from fomas_verify.spectrum.samples import UNSTABLE_SAMPLES, Box, sample_limit
from fomas_verify.spectrum.stability import Side, stability

ID = "trajectory-norm-bound"
STATEMENT = "norm u_k <= norm u_0 for every k >= 0, for the x_0 of the design"
SOURCE = "eqL3"
COQ = "control_resolvent"
MEANING = "From this initial state a later control exceeds the first: size the actuator for the peak."


def decide(loop: Loop) -> Decision:
    """Follow the trajectory until its tail is bounded, as to the truth."""
    components = loop.design.components or ()
    if not any(any(apply(loop.laplacian, x)) for x in components):
        return Decision(Verdict.PROVED, {}, "the agents agree already: u_k = 0 for every k")
    limit = sample_limit(loop)
    limit = limit if stability(loop).side is Side.INSIDE else min(limit, UNSTABLE_SAMPLES)
    for bits in SAMPLE_PRECISIONS:
        if loop.sigma(bits).upper <= loop.threshold(bits).lower:
            return Decision(Verdict.PROVED, {}, "it holds for every x_0: sigma <= 2^alpha - 1, the repaired Theorem 1")
        if (every := symmetric_witness(loop, the_point(loop, bits), bits)) is not None:
            return Decision(Verdict.PROVED, every, "it holds for every x_0 (control-norm-bound)")
        found = follow(loop, components, bits, limit)
        if found.above is not None:
            reason = f"norm u_{found.above} / norm u_0 = {decimal(found.largest, 18)}"
            return Decision(
                Verdict.REFUTED,
                {"k": found.above},
                reason,
                MEANING,
                "see control-norm-bound",
            )
        if found.tail is not None:
            largest = f"norm u_{found.at} / norm u_0 = {decimal(found.largest, 18)} is the largest seen"
            witness = {"samples": found.tail.last, "powers": found.tail.powers}
            return Decision(Verdict.PROVED, witness, f"{largest}; no later one exceeds 1, by the decay of P^n")
        if found.examined == limit:
            break
    return undecided(bits, f"{found.examined} samples do not tell")


def holds_over(loop: Loop, box: Box, bits: int) -> dict[str, Any] | None:
    """The witness that it holds for every (alpha, mu) of a box; None where that was not seen. Rigorous."""
    components = loop.design.components or ()
    if not any(any(apply(loop.laplacian, x)) for x in components) or sigma_at_most_threshold(loop, box, bits):
        return {}
    if (every := symmetric_witness(loop, box, bits)) is not None:
        return every
    tail = tail_over(loop, box, bits, components)
    return None if tail is None else {"samples": tail.last, "powers": tail.powers}
