"""What a prover's margins leave out or leave too wide; that they are true is for `margins` to say.

Wanted: the margin in mu wherever the claim holds on an interval of mu with an upper end, its ends apart by less than
1e-9 of the upper one (1e-7 for the eigenvalues, whose ends need witnesses), and margins in alpha apart by less than
1e-5 where a change is named.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from . import oracle
from .alpha_range import last_stable_gain
from .form_margins import MARGINS
from .model import Design, assumption_1, degree_max

WIDTHS = {"perron-eigenvalues": Fraction(1, 10**7)}
WIDTH, ALPHA_WIDTH = Fraction(1, 10**9), Fraction(1, 10**5)


def _bounded(design: Design, claim: str) -> bool:
    """Whether the claim holds on an interval of mu that is not empty and ends."""
    if claim == "gain-bound":
        return degree_max(design) > 0
    if claim == "perron-eigenvalues":
        return bool(last_stable_gain(design) > 0)
    return claim == "memory-inequality" or oracle.decide(design, claim).truth is True


def _wide(entry: dict[str, Any], width: Fraction) -> bool:
    gaps = [abs(x - y) for x, y in zip(entry["inner"], entry["outer"], strict=True) if y is not None]
    return max(gaps, default=Fraction(0)) > width


def margin_faults(design: Design, margins: dict[str, dict[str, Any]]) -> list[str]:
    """Margins that are missing or too wide."""
    expected = {claim for claim in MARGINS if claim in oracle.ANY_GRAPH or assumption_1(design)}
    faults = []
    for claim in expected:
        entry = margins.get(claim, {})
        if claim == "control-norm-bound":
            continue
        if "mu" not in entry:
            faults += [f"margins of {claim}: no mu"] if _bounded(design, claim) else []
        elif _wide(entry["mu"], WIDTHS.get(claim, WIDTH) * entry["mu"]["outer"][1]):
            faults.append(f"margins of {claim}: mu is too wide: {entry['mu']['inner']} {entry['mu']['outer']}")
        if "alpha" in entry and _wide(entry["alpha"], ALPHA_WIDTH):
            faults.append(f"margins of {claim}: alpha is too wide: {entry['alpha']}")
    return faults
