"""What was found about a large design, for a terminal."""

from __future__ import annotations

from fomas_verify.claims.verdict import Verdict
from fomas_verify.enclosure.digits import decimal, rounded_down, rounded_up
from fomas_verify.enclosure.interval import Interval
from fomas_verify.prover import LargeProof
from fomas_verify.report.text import DIGITS, NAMES, ending, heading, horizon_text, refutation_text, verdict_table

ENDS = 12
KNOWN = 10**20
"""A value is printed with its digits where it is known to this share of it, otherwise as a range."""


def large_proof_text(proof: LargeProof) -> str:
    """The verdict table, the values, what a refutation means, and how it ends."""
    design, decisions = proof.design, proof.decisions
    width = max(map(len, NAMES.values()))
    values = [f"  {NAMES[name]:{width}}  {_value(x)}" for name, x in proof.values.items()]
    parts = [heading(design), verdict_table(decisions, design.require), "\n".join(values) + "\n"]
    if proof.loop.family is not None:
        parts.append(f"  the graph is a {proof.loop.family.name}, whose eigenvalues are known\n")
    if proof.horizon is not None:
        parts.append(horizon_text(proof.horizon))
    parts += [refutation_text(name, x) for name, x in decisions.items() if x.verdict is Verdict.REFUTED]
    parts.append(ending(decisions, design.require))
    return "\n".join(parts)


def _value(x: Interval) -> str:
    if x.is_exact or x.width * KNOWN <= max(abs(x.lower), abs(x.upper)):
        return decimal(x, DIGITS)
    return f"[{rounded_down(x.lower, ENDS)}, {rounded_up(x.upper, ENDS)}]"
