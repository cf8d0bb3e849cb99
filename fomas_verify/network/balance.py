"""Balance of a digraph: what each agent hears against how much it is heard.

Source: the paper's Assumption 1, `sum_j a_ij = sum_j a_ji` for every agent i.
"""

from dataclasses import dataclass
from fractions import Fraction

from fomas_verify.network.digraph import Digraph
from fomas_verify.network.matrices import in_degrees, out_degrees


@dataclass(frozen=True)
class Imbalance:
    """An agent that breaks the balance: `in_ = sum_j a_ij` differs from `out = sum_j a_ji`."""

    agent: int
    in_: Fraction
    out: Fraction


def imbalances(graph: Digraph) -> tuple[Imbalance, ...]:
    """Return the agents that break the balance, in order; empty iff the digraph is balanced. Exact."""
    degrees = zip(in_degrees(graph), out_degrees(graph), strict=True)
    return tuple(Imbalance(agent, in_, out) for agent, (in_, out) in enumerate(degrees, 1) if in_ != out)
