"""The gain bound (15) [eqh]: ``0 < mu < 1/Delta_max``.

Source: the paper's eqh. Decided by an enclosure of mu, or exactly where the design gives mu.
"""

from __future__ import annotations

from fractions import Fraction

from fomas_verify.claims.remedy import lower_mu
from fomas_verify.claims.verdict import Decision, Verdict, undecided
from fomas_verify.enclosure.digits import decimal
from fomas_verify.enclosure.interval import Interval
from fomas_verify.spectrum.loop import Loop
from fomas_verify.spectrum.precision import PRECISIONS

ID = "gain-bound"
STATEMENT = "0 < mu < 1/Delta_max (gain bound (15) [eqh])"
SOURCE = "eqh"
COQ = ""
MEANING = "The paper's Theorem 1 does not apply; perron-eigenvalues says whether the agents still agree."


def decide(loop: Loop) -> Decision:
    """Compare mu with 1/D as to the truth."""
    if loop.degree_max == 0:
        return Decision(Verdict.PROVED, {}, "no edges: Delta_max = 0 and 1/Delta_max is infinite")
    bound = 1 / loop.degree_max
    for bits in PRECISIONS:
        mu = loop.mu(bits)
        if mu.upper < bound:
            return Decision(Verdict.PROVED, {}, _numbers(mu, "<", bound))
        if mu.lower >= bound:
            return Decision(
                Verdict.REFUTED,
                {},
                _numbers(mu, "=" if mu.lower == mu.upper == bound else ">", bound),
                meaning=MEANING,
                remedy=lower_mu(loop, bound, strict=True),
            )
    return undecided(bits, _numbers(mu, "compared with", bound))


def _numbers(mu: Interval, relation: str, bound: Fraction) -> str:
    return f"mu = {decimal(mu, 20)} {relation} 1/Delta_max = {decimal(Interval.exactly(bound), 20)}"
