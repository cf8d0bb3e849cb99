"""``perron-eigenvalues``. Source: the paper, after eqxik_3; theory, section 3. Decided by mu < mu*, not by (15)."""

from __future__ import annotations

from fomas_verify.claims import perron
from fomas_verify.claims.verdict import Decision
from fomas_verify.spectrum.loop import Loop

ID = "perron-eigenvalues"
STATEMENT = "1 is a simple eigenvalue of P and every other eigenvalue of P lies in the open unit disc"
SOURCE = "after eqxik_3"
COQ = "eigenvalues_decide"
MEANING = "Some disagreement between the agents does not die out."


def decide(loop: Loop) -> Decision:
    """Whether P is Schur on the disagreement, as to the truth."""
    return perron.decide(
        loop,
        proved="every other eigenvalue of P lies in the open unit disc",
        refuted=MEANING,
    )
