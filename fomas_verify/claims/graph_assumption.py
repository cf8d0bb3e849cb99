"""Assumption 1: the digraph is strongly connected and balanced.

Source: the paper, section II.B; theory, section 0. Decided by exact graph search and exact sums.
"""

from __future__ import annotations

from fractions import Fraction
from operator import mul
from typing import Any

from fomas_verify.claims.verdict import Decision, Verdict
from fomas_verify.enclosure.digits import decimal
from fomas_verify.enclosure.interval import Interval
from fomas_verify.exact.rational import format_rational
from fomas_verify.network import describe_unreachable, imbalances, unreachable_pair
from fomas_verify.spectrum.loop import Loop
from fomas_verify.spectrum.stability import Side, stability

ID = "graph-assumption"
STATEMENT = "the digraph is strongly connected and balanced (Assumption 1)"
SOURCE = "Assumption 1"
COQ = ""
REMEDY = "add or reweight edges until every agent reaches every other and hears as much as it is heard with"
SHOWN_IMBALANCES = 5
SHOWN_WEIGHTS = 12


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
        meaning=_meaning(loop),
        remedy=REMEDY,
    )


def _meaning(loop: Loop) -> str:
    """What is still true: agreement on a weighted mean where some agent reaches every other and mu < mu*."""
    opening = "The paper's Theorem 1 does not speak about this graph"
    weights = loop.agreement_weights
    if weights is None or stability(loop).side is not Side.INSIDE:
        return f"{opening}; do not expect average consensus from it."
    shown = ", ".join(map(format_rational, weights[:SHOWN_WEIGHTS])) + (", ..." if len(weights) > SHOWN_WEIGHTS else "")
    means = [sum(map(mul, weights, x), Fraction(0)) for x in loop.design.components or ()]
    value = ", ".join(decimal(Interval.exactly(x), 20) for x in means)
    here = f", which is {value if len(means) == 1 else f'({value})'} for the given x_0" if means else ""
    return (
        f"{opening}. Still u_k tends to 0 and every x_i(t) to the weighted mean w_1 x_1(0) + ... + w_N x_N(0), "
        f"w = ({shown}){here}."
    )
