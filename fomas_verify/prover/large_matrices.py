"""Consensus of at most 200 agents where bounds leave it open: from matrices, shown by the witnesses of a small design.

Source: docs/certificate-format.md, sections 4 and 11.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

from fomas_verify.claims import control_norm_bound, trajectory_norm_bound
from fomas_verify.claims.registry import CLAIMS
from fomas_verify.claims.verdict import Decision, Verdict
from fomas_verify.design import LargeDesign
from fomas_verify.design.model import MOST_AGENTS_EXACTLY
from fomas_verify.spectrum.loop import Loop

MOST_AGENTS: Final = 200
"""Of a claim's matrices in the certificate of a large design."""
MOST_BITS: Final = 128
"""Of a weight over the common denominator: the work grows with them."""


def decided_by_matrices(design: LargeDesign, decisions: Mapping[str, Decision]) -> dict[str, Decision]:
    """The decisions, those that were undecided decided as to the claim's truth where that is affordable; rigorous."""
    unknown = {name for name, found in decisions.items() if found.verdict is Verdict.UNDECIDED}
    if design.graph.agents > MOST_AGENTS_EXACTLY:
        unknown -= {control_norm_bound.ID, trajectory_norm_bound.ID}  # their samples take minutes there
    if not unknown or design.graph.agents > MOST_AGENTS or max(_bits(design)) > MOST_BITS:
        return dict(decisions)
    loop = Loop(design.listed())
    found = {claim.ID: claim.decide(loop) for claim in CLAIMS if claim.ID in unknown}
    # Without a witness the checker would go by the bounds, which showed neither side.
    told = {name: x for name, x in found.items() if x.verdict is not Verdict.UNDECIDED and x.witness}
    return {**decisions, **told}


def _bits(design: LargeDesign) -> list[int]:
    graph = design.graph.sparse
    return [int(x).bit_length() for x in (graph.denominator, graph.weights.max())]
