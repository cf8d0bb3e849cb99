"""Assumption 1: the digraph is strongly connected and balanced.

Source: the paper, section II.B; theory, section 0. Decided by exact graph search and exact sums.
"""

from __future__ import annotations

from typing import Any

from fomas_verify.claims.verdict import Decision, Verdict
from fomas_verify.exact.rational import format_rational
from fomas_verify.network import describe_unreachable, imbalances, unreachable_pair
from fomas_verify.spectrum.loop import Loop

ID = "graph-assumption"
STATEMENT = "the digraph is strongly connected and balanced (Assumption 1)"
SOURCE = "Assumption 1"
COQ = ""
SHOWN_IMBALANCES = 5


def decide(loop: Loop) -> Decision:
    """Whether every agent reaches every other and hears as much weight as it is heard with."""
    graph = loop.design.graph
    pair, unequal = unreachable_pair(graph), imbalances(graph)
    if pair is None and not unequal:
        return Decision(Verdict.PROVED, {}, "every agent reaches every other, and in-weight = out-weight at each agent")
    witness: dict[str, Any] = {}
    reasons = []
    if pair is not None:
        witness["unreachable"] = list(pair)
        reasons.append("not strongly connected: " + "; ".join(describe_unreachable(graph)))
    if unequal:
        first = unequal[0]
        witness["imbalance"] = {"agent": first.agent, "in": first.in_, "out": first.out}
        listed = ", ".join(
            f"agent {x.agent} hears {format_rational(x.in_)} and is heard with {format_rational(x.out)}"
            for x in unequal[:SHOWN_IMBALANCES]
        )
        more = f", and {len(unequal) - SHOWN_IMBALANCES} more" if len(unequal) > SHOWN_IMBALANCES else ""
        reasons.append(f"not balanced: {listed}{more}")
    return Decision(
        Verdict.REFUTED,
        witness,
        "; ".join(reasons),
        meaning="The paper's Theorem 1 does not speak about this graph; do not expect average consensus from it.",
        remedy="add or reweight edges until every agent reaches every other and hears as much as it is heard with",
    )
