"""What to change where a claim about a large design is refuted, in the user's terms and rounded to the safe side.

With c = 2^alpha - 1. Source: docs/theory.md, sections 7 and 14.
"""

from __future__ import annotations

from fomas_verify.claims.memory_inequality import raise_or_none
from fomas_verify.claims.remedy import DIGITS, lower_mu, raise_mu
from fomas_verify.enclosure.digits import rounded_up
from fomas_verify.enclosure.interval import Interval
from fomas_verify.spectrum.large_loop import LargeLoop

NONE_AT_ALL = "no gamma and no h gives it on this graph at this alpha: no mu at all has sigma <= 2^alpha - 1"
NO_GAIN = "no gamma and no h gives it on this graph at this alpha: it needs beta <= 2^alpha - 1 and mu lambda_max <= 2"
NOT_KNOWN = "lambda2 is not bounded from below, so no mu is known to give it"


def gain_bound(loop: LargeLoop, _: int) -> str:
    """mu below 1/D."""
    return lower_mu(loop, 1 / loop.degree_max, strict=True)


def memory(loop: LargeLoop, bits: int) -> str:
    """``1 - c <= mu lambda2 <= 1 + sqrt(3^alpha - 2^alpha)``."""
    lambda2 = loop.lambda2(bits)
    if loop.beta(bits).upper < loop.lower_threshold(bits).lower:
        return lower_mu(loop, ((1 - loop.lower_threshold(bits)).lower) / lambda2.upper)
    if lambda2.lower <= 0:
        return NOT_KNOWN
    return raise_or_none(loop, (1 - loop.threshold(bits)) / lambda2, bits)


def consensus(loop: LargeLoop, bits: int) -> str:
    """Below ``2 / lambda_max`` on a symmetric graph, below 1 on a directed cycle; 1/D always suffices."""
    if loop.facts.is_symmetric:
        return lower_mu(loop, 2 / loop.lambda_max(bits).upper, strict=True)
    return lower_mu(loop, 1 / loop.degree_max, strict=True)


def contraction(loop: LargeLoop, bits: int) -> str:
    """``2 / (lambda2 + lambda_max)`` on a symmetric graph."""
    if loop.facts.is_symmetric:
        return lower_mu(loop, 2 / (loop.lambda2(bits) + loop.lambda_max(bits)).upper)
    return "repaired-condition has sigma in place of beta"


def repaired(loop: LargeLoop, bits: int) -> str:
    """``(1 - c)/lambda2 <= mu <= (1 + c)/lambda_max`` on a symmetric graph; elsewhere what it needs at least."""
    c, lambda2 = loop.threshold(bits), loop.lambda2(bits)
    if loop.facts.is_symmetric:
        return _between(loop, bits, (c + 1) / loop.lambda_max(bits), NONE_AT_ALL)
    # On a directed cycle sigma^2 is least at mu = 1/2, where it is 1 - lambda2/2.
    if loop.facts.is_directed_cycle and (1 - lambda2 / 2).lower > (c * c).upper:
        return NONE_AT_ALL
    needed = (1 - c).lower / lambda2.upper
    return f"it needs mu >= {rounded_up(needed, DIGITS)} at least, for beta <= 2^alpha - 1"


def norm_bound(loop: LargeLoop, bits: int) -> str:
    """``(1 - c)/lambda2 <= mu <= 2/lambda_max`` on a symmetric graph; the repaired condition suffices elsewhere."""
    if loop.facts.is_symmetric:
        return _between(loop, bits, Interval.exactly(2) / loop.lambda_max(bits), NO_GAIN)
    found = repaired(loop, bits)
    if found.startswith("no gamma"):
        return f"none by the repaired condition, which would suffice: {found}"
    return f"the repaired condition suffices: {found}"


def _between(loop: LargeLoop, bits: int, most: Interval, none: str) -> str:
    """Words for ``(1 - c)/lambda2 <= mu <= most``, `none` where there is no such mu."""
    lambda2, mu = loop.lambda2(bits), loop.mu(bits).mid
    short = 1 - loop.threshold(bits)
    if short.lower / lambda2.upper > most.upper:
        return none
    if lambda2.lower <= 0:
        return NOT_KNOWN
    least = short.upper / lambda2.lower
    if least >= most.lower:
        return "only a single mu can have it, if any"
    if mu < least:
        beyond = " (beyond the gain bound (15))" if least * loop.degree_max >= 1 else ""
        return raise_mu(loop, least, below=most.lower) + beyond
    return lower_mu(loop, most.lower, above=least)
