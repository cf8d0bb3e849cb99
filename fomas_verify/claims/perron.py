"""The Perron matrix, and the two claims that are equivalent to its statement under Assumption 1.

``perron-eigenvalues``: 1 is a simple eigenvalue of P and every other lies in the open unit disc; true iff 0 < mu < mu*.
Under Assumption 1 that is equivalent to ``control-bounded`` and to ``average-consensus`` (theory, section 3, "Three
claims are one").
"""

from __future__ import annotations

from fomas_verify.claims.remedy import lower_mu
from fomas_verify.claims.verdict import Decision, Verdict, undecided
from fomas_verify.enclosure.digits import decimal
from fomas_verify.spectrum.loop import Loop
from fomas_verify.spectrum.stability import Side, Stability, stability


def decide(loop: Loop, *, proved: str, refuted: str) -> Decision:
    """The common decision, with each claim's own words for what it means."""
    found = stability(loop)
    mu = decimal(loop.mu(128), 20)
    if found.side is Side.UNKNOWN:
        return undecided(found.witness["bits"], f"mu = {mu} and mu* = {_mu_star(found)}")
    if found.side is Side.INSIDE:
        return Decision(Verdict.PROVED, found.witness, f"mu = {mu} < mu* = {_mu_star(found)}: {proved}")
    if found.mu_star is None:
        reason = "the graph has no agent from which every other is reached: 1 is a multiple eigenvalue of P at every mu"
        remedy = "add edges until one agent reaches every other"
    else:
        relation = ">=" if found.side is Side.BOUNDARY else ">"
        reason = f"mu = {mu} {relation} mu* = {_mu_star(found)}: an eigenvalue of P has modulus {_modulus(found)}"
        remedy = lower_mu(loop, found.mu_star.lower, strict=True)
    return Decision(Verdict.REFUTED, found.witness, reason, refuted, remedy)


def _mu_star(found: Stability) -> str:
    return decimal(found.mu_star, 20) if found.mu_star else "(not enclosed)"


def _modulus(found: Stability) -> str:
    return "exactly 1" if found.side is Side.BOUNDARY else "above 1"
