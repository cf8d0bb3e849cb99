"""How much room is left: how far mu and alpha may move before a claim's truth changes.

Source: theory, section 8; docs/certificate-format.md, section 3, "margins".
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

from fomas_verify.claims import (
    control_norm_bound,
    gain_bound,
    memory_inequality,
    perron_eigenvalues,
    repaired_condition,
)
from fomas_verify.claims.registry import ON_ANY_GRAPH
from fomas_verify.claims.verdict import Decision, Verdict
from fomas_verify.enclosure.interval import Interval
from fomas_verify.enclosure.reference import DisagreementError
from fomas_verify.prover.neighbourhood import Neighbourhood, neighbourhoods
from fomas_verify.spectrum import margins as of_mu
from fomas_verify.spectrum import slabs
from fomas_verify.spectrum.alpha_margins import AlphaMargin, alpha_margin
from fomas_verify.spectrum.loop import Loop
from fomas_verify.spectrum.margins import MuMargin
from fomas_verify.spectrum.slabs import Truth


@dataclass(frozen=True)
class Margin:
    """On which mu a claim is true, and how far alpha may move before its truth changes; None where that does not exist
    or was not found. Or, ``near``, on which mu and on which alpha it is certainly as it is.
    """

    mu: MuMargin | None
    alpha: AlphaMargin | None
    near: Mapping[str, Neighbourhood] = field(default_factory=dict)

    def entry(self) -> dict[str, Any]:
        """As the certificate writes it."""
        found: dict[str, Any] = {name: near.entry() for name, near in self.near.items()}
        if self.mu is not None:
            found["mu"] = {"inner": [*self.mu.inner], "outer": [*self.mu.outer], **self.mu.witness}
        if self.alpha is not None:
            found["alpha"] = {"inner": [*self.alpha.inner], "outer": [*self.alpha.outer]}
        return found


Margins = Mapping[str, Margin]

CLAIMS: Mapping[str, tuple[Callable[[Loop], MuMargin | None], Callable[[Loop], Truth]]] = {
    gain_bound.ID: (of_mu.gain_bound, slabs.gain_bound),
    memory_inequality.ID: (of_mu.memory_inequality, slabs.memory_inequality),
    perron_eigenvalues.ID: (of_mu.perron_eigenvalues, slabs.perron_eigenvalues),
    repaired_condition.ID: (of_mu.repaired_condition, slabs.repaired_condition),
}
"""The interval of mu and the truth over a slab of alpha, in the order of the certificate."""


def margins(loop: Loop, decisions: Mapping[str, Decision]) -> dict[str, Margin]:
    """The margins of those of the five claims that are applicable; rigorous.

    Raises
    ------
    DisagreementError
        A margin and a verdict contradict each other.
    """
    found = {}
    for name, (in_mu, truth_of) in CLAIMS.items():
        if loop.assumption1 or name in ON_ANY_GRAPH:
            truth = truth_of(loop)
            _must_agree(name, truth(Interval.exactly(loop.design.alpha)), decisions[name].verdict)
            found[name] = Margin(in_mu(loop), alpha_margin(truth, loop.design.alpha))
    if loop.assumption1:
        found[control_norm_bound.ID] = Margin(None, None, neighbourhoods(loop, decisions[control_norm_bound.ID]))
    return found


def entries(found: Margins) -> dict[str, Any]:
    """As the certificate writes them: what is empty is left out."""
    return {name: entry for name, margin in found.items() if (entry := margin.entry())}


def _must_agree(name: str, seen: bool | None, verdict: Verdict) -> None:
    """Raise :class:`DisagreementError` where the ranges at the design's own alpha contradict the verdict."""
    if seen is not None and verdict is (Verdict.REFUTED if seen else Verdict.PROVED):
        raise DisagreementError(f"{name}: {verdict}, but by the margins it is {str(seen).lower()}")
