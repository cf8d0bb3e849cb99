"""The sizes of things that an engineer needs: peak of the control, rate, settling, actuator reach, limit, overshoot.

Definitions and proofs: theory, sections 3 and 4; docs/certificate-format.md, section 3.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from fomas_verify.enclosure.interval import Interval
from fomas_verify.enclosure.real import square_root
from fomas_verify.exact.matrix import apply, norm_squared
from fomas_verify.kernel.memory import one_step_weight
from fomas_verify.spectrum.control import Rate, certified_rate, settling_samples
from fomas_verify.spectrum.loop import Loop
from fomas_verify.spectrum.precision import SAMPLE_PRECISIONS
from fomas_verify.spectrum.samples import Peak, search

BITS = 192
KEPT_BITS = 96


@dataclass(frozen=True)
class Sizes:
    """What was measured; None where a thing does not exist for the design, or was not reached within the work allowed.

    ``peak`` is ``sup_k norm Phi_k`` on 1perp, ``reach`` bounds ``sup_k norm u_k`` for the given x_0 by ``peak gamma
    norm(L x_0)``, ``limit`` is the mean of x_0, a number for each component, ``overshoot`` bounds
    ``norm(x(t) - x(t_k))`` inside the sampling interval k, for every k, by ``2 m reach``.
    """

    peak: Peak | None = None
    rate: Rate | None = None
    settle_to: Fraction | None = None
    settling: int | None = None
    settling_time: Fraction | None = None
    reach: Interval | None = None
    overshoot: Interval | None = None
    limit: tuple[Fraction, ...] | None = None

    def entries(self) -> dict[str, dict[str, Any]]:
        """As the certificate writes them."""
        found: dict[str, dict[str, Any]] = {}
        if self.peak is not None:
            found["peak_control"] = {**_ends(self.peak.value.rounded(KEPT_BITS)), "at": self.peak.at}
        if self.settling is not None:
            found["settling_samples"] = {"settle_to": self.settle_to, **_point(Fraction(self.settling))}
        if self.settling_time is not None:
            found["settling_time"] = {"settle_to": self.settle_to, **_point(self.settling_time)}
        if self.rate is not None:
            found["rate"] = {"kappa": self.rate.kappa, "rho": self.rate.rho}
        if self.reach is not None:
            found["actuator_reach"] = _ends(self.reach.rounded(KEPT_BITS))
        if self.limit is not None and len(self.limit) == 1:
            found["limit"] = _point(self.limit[0])
        return found


def _ends(x: Interval) -> dict[str, Fraction]:
    return {"lower": x.lower, "upper": x.upper}


def _point(x: Fraction) -> dict[str, Fraction]:
    return {"lower": x, "upper": x}


def measure(loop: Loop, *, decided_stable: bool) -> Sizes:
    """Everything that exists: under Assumption 1 and with P Schur on 1perp; nothing otherwise. Rigorous."""
    if not (loop.assumption1 and decided_stable):
        return Sizes()
    design = loop.design
    peak = search(loop, BITS).peak
    rate = next((rate for bits in SAMPLE_PRECISIONS if (rate := certified_rate(loop, bits)) is not None), None)
    settling = None if design.settle_to is None else settling_samples(loop, design.settle_to, BITS)
    time = None if settling is None or design.h is None else settling * design.h
    reach, weight = (
        actuator_reach(loop, peak),
        None if design.h is None else one_step_weight(design.alpha, design.h, BITS),
    )
    overshoot = None if reach is None or weight is None else weight * reach * 2
    limit = None
    if design.components is not None:
        limit = tuple(sum(x, Fraction(0)) / design.graph.agents for x in design.components)
    return Sizes(peak, rate, design.settle_to, settling, time, reach, overshoot, limit)


def actuator_reach(loop: Loop, peak: Peak | None) -> Interval | None:
    """``peak gamma norm(L x_0)``; None without x_0, or where neither gamma nor h is given."""
    design = loop.design
    if peak is None or design.components is None or (design.gamma is None and design.h is None):
        return None
    square = sum((norm_squared(apply(loop.laplacian, x)) for x in design.components), Fraction(0))
    error = square_root(Interval.exactly(square), BITS)
    gain = Interval.exactly(design.gamma) if design.gamma is not None else None
    if gain is None and design.h is not None:
        gain = loop.mu(BITS) / one_step_weight(design.alpha, design.h, BITS)
    return None if gain is None else peak.value * gain * error
