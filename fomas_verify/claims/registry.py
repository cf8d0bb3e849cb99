"""All claims, in the order of the contract."""

from __future__ import annotations

from typing import Protocol

from fomas_verify.claims import (
    average_consensus,
    beta_contraction,
    control_bounded,
    control_norm_bound,
    gain_bound,
    graph_assumption,
    memory_inequality,
    perron_eigenvalues,
    repaired_condition,
    trajectory_norm_bound,
)
from fomas_verify.claims.verdict import Decision
from fomas_verify.spectrum.loop import Loop


class Claim(Protocol):
    """What each claim's module offers."""

    ID: str
    STATEMENT: str
    SOURCE: str
    COQ: str

    def decide(self, loop: Loop) -> Decision:
        """The verdict on this claim for this design."""
        ...


CLAIMS: tuple[Claim, ...] = (
    graph_assumption,
    gain_bound,
    memory_inequality,
    perron_eigenvalues,
    beta_contraction,
    repaired_condition,
    control_norm_bound,
    trajectory_norm_bound,
    control_bounded,
    average_consensus,
)

ON_ANY_GRAPH = frozenset({graph_assumption.ID, gain_bound.ID, perron_eigenvalues.ID})
"""The claims that do not presuppose Assumption 1."""
