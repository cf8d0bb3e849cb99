"""``average-consensus``. Source: the paper, Theorem 1; theory, section 3. Decided by mu < mu*, not by (15)."""

from __future__ import annotations

from fomas_verify.claims import perron
from fomas_verify.claims.verdict import Decision
from fomas_verify.spectrum.loop import Loop

ID = "average-consensus"
STATEMENT = "for every x_0 and every i, x_i(t) tends to the mean of x_0 as t tends to infinity"
SOURCE = "Theorem 1"
COQ = "claims_are_one"
MEANING = "For some initial state the agents never agree on the mean."


def decide(loop: Loop) -> Decision:
    """Whether P is Schur on the disagreement, as to the truth."""
    return perron.decide(
        loop,
        proved="the agents agree on the mean, between the samples too",
        refuted=MEANING,
    )
