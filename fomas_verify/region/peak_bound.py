"""A constant that the peak of the control does not exceed on a whole strip.

Notation: p_n = norm of P^n on 1perp, c_n the memory's step response. Lemma (theory, section 3, with K = 0): M >= 1 and
``p_n <= M c_n`` for every n >= 1 give ``norm Phi_k <= M`` for every k. With ``sigma <= s < 1`` on the strip ``p_n <=
s^n``, and ``c_{n+1}/c_n`` does not decrease, so ``s^n/c_n`` rises until the first n with ``s c_n <= c_{n+1}`` and falls
from there on: the largest is found among finitely many.
"""

from __future__ import annotations

from fractions import Fraction

from fomas_verify.enclosure.interval import round_up
from fomas_verify.kernel.memory import step_response
from fomas_verify.region.model import Condition
from fomas_verify.spectrum.loop import Loop, sigma_at
from fomas_verify.spectrum.margins import BITS, MuMargin

MOST_TERMS, KEPT_BITS = 4000, 64


def peak_bound(loop: Loop, condition: Condition, strip: MuMargin) -> Fraction | None:
    """``c >= sup_k norm Phi_k`` for every mu of ``strip.inner``; None where none was found. Rigorous.

    It is 1 on the repaired strips (the repaired Theorem 1); on (0, 1/D) and (0, mu*) there is none, as the peak grows
    without bound where mu tends to 0.
    """
    if condition in (Condition.REPAIRED, Condition.CLOSED_FORM):
        return Fraction(1)
    if condition is not Condition.AS_STATED:
        return None
    shrink = max(sigma_at(loop.laplacian, mu, BITS).upper for mu in strip.inner)  # sigma is convex in mu
    alpha, power, most = loop.design.alpha, Fraction(1), Fraction(1)
    here = step_response(alpha, 0, BITS)
    for n in range(1, MOST_TERMS):
        before, here = here, step_response(alpha, n, BITS)
        if shrink * before.upper <= here.lower:
            return round_up(most, KEPT_BITS)
        power = round_up(power * shrink, BITS)
        most = max(most, power / here.lower)
    return None
