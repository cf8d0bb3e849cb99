"""How much room is left, in words: one line a claim, and what binds. A bound without dots is rounded to the safe side.

Source: theory, section 8.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction

from fomas_verify.claims.remedy import BITS, in_users_terms
from fomas_verify.claims.verdict import Verdict
from fomas_verify.enclosure.digits import decimal, rounded_down, rounded_up
from fomas_verify.enclosure.interval import Interval
from fomas_verify.prover import Proof
from fomas_verify.prover.neighbourhood import Neighbourhood
from fomas_verify.spectrum.loop import Loop
from fomas_verify.spectrum.margins import MuMargin

DIGITS, NEAR_DIGITS, PERCENT_DIGITS = 6, 18, 3
STANDS_FOR = {"control-bounded": "perron-eigenvalues", "average-consensus": "perron-eigenvalues"}
"""Claims that are equivalent to another under Assumption 1."""


def margin_lines(proof: Proof) -> Iterator[tuple[str, str]]:
    """Claim and sentence, for each claim that has a margin."""
    for name, margin in proof.margins.items():
        verdict = proof.decisions[name].verdict
        if margin.near:
            yield name, f"{'true' if verdict is Verdict.PROVED else 'false'} for " + _near(proof, margin.near)
        gains = "" if margin.mu is None else _factors(proof.loop, margin.mu, verdict)
        alphas = "" if margin.alpha is None else _alphas(*margin.alpha.inner, proof.design.alpha)
        if verdict is Verdict.REFUTED and (gains or alphas):
            parts = [gains and f"false here; true for {gains}", alphas and f"false for {alphas}"]
            yield name, "; ".join(filter(None, parts))
        elif gains or alphas:
            yield name, "true for " + ", ".join(filter(None, [gains, alphas]))


def _near(proof: Proof, near: Mapping[str, Neighbourhood]) -> str:
    texts = []
    if "mu" in near:
        low, high = (in_users_terms(proof.loop, Interval.exactly(x)) for x in near["mu"].inner)
        texts += [f"{name} times {_between(low[name][0], high[name][0])}" for name in high if name in low]
    if "alpha" in near:
        texts.append(_alphas(*near["alpha"].inner, proof.design.alpha))
    return ", ".join(texts) + ", and perhaps further"


def _between(low: Interval, high: Interval) -> str:
    return f"{rounded_up(low.upper, DIGITS)} to {rounded_down(high.lower, DIGITS)}"


def _factors(loop: Loop, margin: MuMargin, verdict: Verdict) -> str:
    """``gamma times 0.99 to 14, h times ...``; where the claim is refuted, with the value at the near end."""
    low = None if margin.lower.upper == 0 else in_users_terms(loop, margin.lower)
    high = in_users_terms(loop, margin.upper)
    rises = loop.mu(BITS).mid < margin.inner[0]
    texts = []
    for name, (factor, value) in high.items():
        least = low.get(name) if low is not None else None
        text = f"less than {rounded_down(factor.lower, DIGITS)}"
        if least is not None:
            text = _between(least[0], factor)
        if verdict is Verdict.REFUTED:
            end, bound = (least[1], "at least") if rises and least else (value, "at most")
            text += f" ({name} = {decimal(end, NEAR_DIGITS)} {bound})"
        texts.append(f"{name} times {text}")
    return ", ".join(texts)


def _alphas(low: Fraction, high: Fraction, alpha: Fraction) -> str:
    least = "" if low == 0 else _outside(low, alpha, up=True)
    most = "" if high == 1 else _outside(high, alpha, up=False)
    if least and most:
        return f"alpha from {least} to {most}"
    return f"alpha at least {least}" if least else f"alpha at most {most}" if most else "every alpha"


def _outside(end: Fraction, alpha: Fraction, *, up: bool) -> str:
    """The end, rounded towards alpha but not beyond it."""
    for digits in (DIGITS, 2 * DIGITS, 4 * DIGITS):
        text = rounded_up(end, digits) if up else rounded_down(end, digits)
        if Fraction(text) <= alpha if up else Fraction(text) >= alpha:
            return text
    return decimal(Interval.exactly(alpha), NEAR_DIGITS)


@dataclass(frozen=True)
class End:
    """An end of a stretch on which a claim is true, and the claim."""

    at: Interval
    claim: str


def binding(proof: Proof) -> str:
    """How far each number may move alone before a required claim fails, and which claim that is; empty where a
    required claim is not proved, or none has a margin.
    """
    required = dict.fromkeys(STANDS_FOR.get(name, name) for name in proof.design.require if name != "graph-assumption")
    if any(proof.decisions[name].verdict is not Verdict.PROVED for name in proof.design.require):
        return ""
    words = [*_of_gains(proof, list(required)), *_of_alpha(proof, list(required))]
    missing = [name for name in required if name not in proof.margins or proof.margins[name].near]
    return "; ".join(words) + (f" ({', '.join(missing)} not counted)" if words and missing else "")


def _of_gains(proof: Proof, names: list[str]) -> Iterator[str]:
    found = [(name, proof.margins[name].mu) for name in names if name in proof.margins]
    lows = [End(margin.lower, name) for name, margin in found if margin and margin.lower.upper > 0]
    highs = [End(margin.upper, name) for name, margin in found if margin]
    if not highs:
        return
    high = min(highs, key=lambda end: end.at.lower)
    low = max(lows, key=lambda end: end.at.upper, default=None)
    falls = {} if low is None else in_users_terms(proof.loop, low.at)
    for name, (factor, _) in in_users_terms(proof.loop, high.at).items():
        fall = "to any positive number"
        if low and name in falls:
            fall = f"by {_percent(1 - falls[name][0])} ({low.claim} binds)"
        yield f"{name} may fall {fall} and rise by {_percent(factor - 1)} ({high.claim} binds)"


def _of_alpha(proof: Proof, names: list[str]) -> Iterator[str]:
    """The stretch of alpha on which all of them stay true, its ends among those of ``inner``."""
    found = [(name, proof.margins[name].alpha) for name in names if name in proof.margins]
    stretches = [(name, margin) for name, margin in found if margin]
    if not stretches:
        return
    low, falls = max(((margin.inner[0], name) for name, margin in stretches), key=lambda end: end[0])
    high, rises = min(((margin.inner[1], name) for name, margin in stretches), key=lambda end: end[0])
    alpha = proof.design.alpha
    fall = f"to {_outside(low, alpha, up=True)} ({falls} binds)" if low > 0 else "to any positive number"
    rise = f"to {_outside(high, alpha, up=False)} ({rises} binds)" if high < 1 else "to any number below 1"
    yield f"alpha may fall {fall} and rise {rise}"


def _percent(x: Interval) -> str:
    return f"{rounded_down(max(x.lower, Fraction(0)) * 100, PERCENT_DIGITS)} %"
