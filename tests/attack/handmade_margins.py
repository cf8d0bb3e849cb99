"""Margins made by the oracle and by search, without the prover.

Ends of mu come from the closed forms of docs/theory (2 - 2^alpha)/lambda2, (1 + sqrt c_2)/lambda2, 1/D, and by halving
where sigma is not at hand in closed form; ends of alpha by halving between neighbours on a grid. Everything is
rounded to the safe side.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from fractions import Fraction
from typing import Any

from mpmath import mp

from . import oracle
from .alpha_range import DPS, last_stable_gain
from .form_margins import INTERVALS
from .handmade import candidates, growing_powers, invariant_forms, lyapunov_forms, outward
from .margins import at_alpha, at_gain, holds
from .model import Design, assumption_1, degree_max
from .spectral_witness import leaves, stays

STEPS = 24
HALVINGS = 60
NEAR = Fraction(1, 10**9)
Test = Callable[[Fraction], bool | None]


def turn(test: Test, inside: Fraction, outside: Fraction, halvings: int = HALVINGS) -> tuple[Fraction, Fraction]:
    """Neighbours (true, false) of the test between a point where it is true and one where it is false."""
    for _ in range(halvings):
        middle = (inside + outside) / 2
        if test(middle):
            inside = middle
        else:
            outside = middle
    return inside, outside


def _between(low: tuple[Fraction, Fraction], high: tuple[Fraction, Fraction]) -> dict[str, Any]:
    return {"inner": (low[1], high[0]), "outer": (max(low[0], Fraction(0)), high[1])}


def _memory(design: Design) -> dict[str, Any]:
    with mp.workdps(DPS):
        alpha, lam = oracle.real(design.alpha), oracle.lambda2(design, DPS)
        first = (2 - mp.mpf(2) ** alpha) / lam
        last = (1 + mp.sqrt(mp.mpf(3) ** alpha - mp.mpf(2) ** alpha)) / lam
        return _between(outward(first), outward(last))


def _repaired(design: Design) -> dict[str, Any] | None:
    def test(t: Fraction) -> bool | None:
        return oracle.decide(at_gain(design, t), "repaired-condition").truth

    low, high = Fraction(0), 2 / degree_max(design) * design.agents
    for _ in range(80):  # sigma is convex
        left, right = (2 * low + high) / 3, (low + 2 * high) / 3
        sizes = [oracle.sigma(at_gain(design, t), 30) for t in (left, right)]
        low, high = (left, high) if sizes[0] > sizes[1] else (low, right)
        low, high = (Fraction(int(t * 2**60), 2**60) for t in (low, high))
    if not test(low):
        return None
    first, last = turn(test, low, Fraction(0)), turn(test, low, 2 / degree_max(design) * design.agents)
    return _between(first[::-1], last)


def _perron(design: Design) -> dict[str, Any] | None:
    end = last_stable_gain(design)
    if end <= 0:
        return None
    low, high = outward(end)
    b, d = low * (1 - NEAR), high * (1 + NEAR)
    tie = Fraction(float((low + high) / 2)).limit_denominator(10**4)
    forms = (given["Q"] for given in lyapunov_forms(at_gain(design, b)) if stays(design, b, given["Q"]))
    growths = (given for given in _growths(design, tie, d) if leaves(design, given["mu"], given))
    q, growth = next(forms, None), next(growths, None)
    if q is None or growth is None:
        return None
    return {"inner": (Fraction(0), b), "outer": (Fraction(0), growth.pop("mu")), "Q": q, **growth}


def _growths(design: Design, tie: Fraction, beyond: Fraction) -> Iterator[dict[str, Any]]:
    yield from invariant_forms(at_gain(design, tie))
    yield from growing_powers(at_gain(design, beyond))


def of_mu(design: Design, claim: str) -> dict[str, Any] | None:
    """The margin of a claim in mu; None where there is none."""
    if claim == "gain-bound":
        most = degree_max(design)
        return {"inner": (Fraction(0), 1 / most), "outer": (Fraction(0), 1 / most)} if most else None
    by_claim = {"memory-inequality": _memory, "repaired-condition": _repaired, "perron-eigenvalues": _perron}
    found = by_claim[claim](design)
    return found if found and holds(design, {claim: {"mu": found}}) else None


def of_alpha(design: Design, claim: str, ends: dict[str, Any] | None) -> dict[str, Any] | None:
    """The margin of a claim in alpha: the nearest changes on a grid, halved."""
    truth = oracle.decide(design, claim).truth

    def same(alpha: Fraction) -> bool:
        return oracle.decide(at_alpha(design, alpha), claim).truth == truth

    inner, outer = [Fraction(0), Fraction(1)], [None, None]
    for side, end in enumerate((Fraction(1, 1000), Fraction(999, 1000))):
        last = design.alpha
        for k in range(1, STEPS + 1):
            alpha = design.alpha + (end - design.alpha) * Fraction(k, STEPS)
            if not same(alpha):
                inner[side], outer[side] = turn(same, last, alpha, 30)
                break
            last = alpha
    for slack in (Fraction(0), Fraction(1, 10**6), Fraction(1, 100)):
        shrunk = tuple(end + slack * (design.alpha - end) for end in inner)
        entry = {"inner": shrunk, "outer": tuple(outer)}
        parts = {"alpha": entry, **({"mu": ends} if ends else {})}
        if holds(design, {claim: parts}):
            return entry
    return None


def of_control(design: Design, key: str) -> dict[str, Any] | None:
    """A neighbourhood of mu, or alpha, in which `control-norm-bound` keeps its truth."""
    claim = "control-norm-bound"
    verdict = oracle.verdict(design, claim)
    if verdict is None:
        return None
    middle = outward(oracle.mu(design, DPS)) if key == "mu" else (design.alpha, design.alpha)
    for part in (Fraction(1, 10**4), Fraction(1, 10**6), Fraction(1, 10**9)):
        inner = middle[0] * (1 - part), middle[1] * (1 + part)
        source = at_gain(design, inner[1]) if key == "mu" and verdict == "proved" else design
        for given in candidates(source, claim, verdict):
            entry = {"inner": inner, "verdict": verdict, "witness": given}
            if holds(design, {claim: {key: entry}}):
                return {"inner": inner, "witness": {"verdict": verdict, "witness": given}}
    return None


def margins(design: Design) -> dict[str, dict[str, Any]]:
    """Every margin for which one was found."""
    out: dict[str, dict[str, Any]] = {}
    for claim in INTERVALS:
        if claim not in oracle.ANY_GRAPH and not assumption_1(design):
            continue
        ends = of_mu(design, claim)
        parts = {"mu": ends, "alpha": of_alpha(design, claim, ends)}
        out[claim] = {key: entry for key, entry in parts.items() if entry}
    if assumption_1(design):
        out["control-norm-bound"] = {key: entry for key in ("mu", "alpha") if (entry := of_control(design, key))}
    return {claim: parts for claim, parts in out.items() if parts}
