"""What is certified of a design, for a simulation to be compared with."""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction
from typing import TYPE_CHECKING

from fomas_verify.design import Design
from fomas_verify.network import imbalances, unreachable_pair

if TYPE_CHECKING:
    from fomas_verify.simulate.against import Bounds

MOST_AGENTS = 40
"""Agents up to which the certified sizes are computed for a comparison: some seconds."""

BITS = 128


@dataclass(frozen=True)
class Certified:
    """``limit``: what every agent tends to where they agree; None where no agent reaches every other, or it was not
    sought. ``beta = 1 - mu lambda2`` and the bounds under Assumption 1; without bounds, ``reason`` says why.
    """

    limit: tuple[Fraction, ...] | None
    beta: float | None = None
    bounds: Bounds | None = None
    reason: str = ""

    def without_bounds(self, reason: str) -> Certified:
        """The same where the bounds do not apply."""
        return replace(self, bounds=None, reason=reason)


def certified_of(design: Design) -> Certified:
    """The limit, beta and the sizes that `prove` measures, rigorous; without the sizes beyond 40 agents."""
    balanced = unreachable_pair(design.graph) is None and not imbalances(design.graph)
    if design.graph.agents > MOST_AGENTS:
        return Certified(_mean(design) if balanced else None, reason=f"more than {MOST_AGENTS} agents")
    from fomas_verify.prover.sizes import measure
    from fomas_verify.simulate.against import Bounds
    from fomas_verify.spectrum.loop import Loop
    from fomas_verify.spectrum.stability import Side, stability

    loop = Loop(design)
    if not balanced:
        weights = loop.agreement_weights
        limit = None if weights is None else _weighted(design, weights)
        return Certified(limit, reason="the graph is not strongly connected and balanced")
    limit, beta = _mean(design), float(loop.beta(BITS).mid)
    stable = stability(loop).side is Side.INSIDE
    sizes = measure(loop, decided_stable=stable)
    if not stable or sizes.limit is None:
        return Certified(limit, beta, reason="consensus is not proved of this design")
    kappa, rho = (None, None) if sizes.rate is None else (sizes.rate.kappa, sizes.rate.rho)
    peak = None if sizes.peak is None else sizes.peak.value
    bounds = Bounds(
        sizes.limit, kappa, rho, sizes.settle_to, sizes.settling, peak, sizes.reach, sizes.overshoot
    )  # fmt: skip
    return Certified(limit, beta, bounds)


def _mean(design: Design) -> tuple[Fraction, ...]:
    return _weighted(design, [Fraction(1, design.graph.agents)] * design.graph.agents)


def _weighted(design: Design, weights: list[Fraction]) -> tuple[Fraction, ...]:
    rows = design.components or ()
    return tuple(sum((w * x for w, x in zip(weights, row, strict=True)), Fraction(0)) for row in rows)
