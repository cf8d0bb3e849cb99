"""``control-bounded``. Source: the paper, Theorem 1; theory, section 3. Decided by mu < mu*, not by (15)."""

from __future__ import annotations

from fomas_verify.claims import perron
from fomas_verify.claims.verdict import Decision
from fomas_verify.spectrum.loop import Loop

ID = "control-bounded"
STATEMENT = "for every x_0, norm u_k is bounded over k and u_k tends to 0"
SOURCE = "Theorem 1"
COQ = "claims_are_one"
MEANING = "For some initial state the control does not vanish, and it may grow without bound."


def decide(loop: Loop) -> Decision:
    """Whether P is Schur on the disagreement, as to the truth."""
    return perron.decide(
        loop,
        proved="u_k is bounded and vanishes for every x_0",
        refuted=MEANING,
    )
