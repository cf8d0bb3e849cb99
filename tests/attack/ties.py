"""Exact decisions where a margin vanishes: rational mu, algebraic numbers, small graphs.

Each function answers True, False, or None where it does not apply. Notation as in docs/certificate-format.md. The
form behind each test is the definition squared: norm(P e) <= s norm(e) iff s >= 0 and `s^2 V^T V - V^T P^T P V` >= 0.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from mpmath import mp

from .exact import (
    Matrix,
    Poly,
    Root,
    approx_root,
    charpoly,
    combine,
    count_roots,
    distinct_roots,
    has_common_root,
    identity,
    is_psd,
    is_psd_at,
    matmul,
    sign_at,
    sympy_poly,
    transpose,
)
from .model import Design, laplacian, on_1perp, perron_on_differences, symmetric_part

HALF = Fraction(1, 2)
SQRT2 = Root((Fraction(-2), Fraction(0), Fraction(1)), Fraction(1), Fraction(2))
EXACT_AGENTS = 12


def contraction_form(design: Design, gain: Fraction, square: Fraction) -> Matrix:
    """`square V^T V - V^T P^T P V` with P = I - gain L."""
    n = design.agents
    p = combine(Fraction(1), identity(n), -gain, laplacian(design))
    return on_1perp(combine(square, identity(n), Fraction(-1), matmul(transpose(p), p)))


def memory_at_0(design: Design) -> bool | None:
    """beta <= 2^alpha - 1 at alpha = 1/2 and rational mu: `L_s - ((2 - sqrt 2)/mu) I >= 0` on 1perp."""
    if design.alpha != HALF or design.mu is None or design.agents > EXACT_AGENTS:
        return None
    gain, form = design.mu, symmetric_part(laplacian(design))

    def shifted(x: Fraction) -> Matrix:
        return on_1perp(combine(Fraction(1), form, -(2 - x) / gain, identity(design.agents)))

    return is_psd_at(shifted, 1, SQRT2)


def repaired(design: Design) -> bool | None:
    """sigma <= 2^alpha - 1 at alpha = 1/2 and rational mu, over Q(sqrt 2)."""
    if design.alpha != HALF or design.mu is None or design.agents > EXACT_AGENTS:
        return None
    gain = design.mu
    return is_psd_at(lambda x: contraction_form(design, gain, (x - 1) ** 2), 2, SQRT2)


def unit_circle(design: Design) -> bool | None:
    """False where P has, besides one eigenvalue 1, one on the unit circle or a pair z, 1/z; None otherwise."""
    if design.mu is None:
        return None
    p = charpoly(perron_on_differences(design, design.mu))
    shared = sympy_poly(p).gcd(sympy_poly(p[::-1]))
    return False if shared.degree() >= 1 else None


def lambda2_root(design: Design) -> Root | None:
    """lambda2 as a root of L_s's characteristic polynomial without one zero; None where its roots are too close."""
    form: Poly = charpoly(symmetric_part(laplacian(design)))[1:]
    roots = sorted(mp.re(z) for z, _ in distinct_roots(form, 80))
    if len(roots) == 1:
        return Root(form, Fraction(-1), _dyadic(roots[0]) + 1)
    if roots[1] - roots[0] < mp.mpf(10) ** -20:
        return None
    middle = _dyadic((roots[0] + roots[1]) / 2)
    return Root(form, Fraction(-1), middle) if count_roots(form, Fraction(-1), middle) == 1 else None


def _dyadic(x: Any, bits: int = 256) -> Fraction:
    with mp.workprec(4 * bits):
        return Fraction(int(mp.floor(x * mp.mpf(2) ** bits)), 2**bits)


def _contraction_at(design: Design, gain: Fraction, root: Root) -> bool:
    """norm(P e) <= (1 - gain theta) norm(e) on 1perp with P = I - gain L, exactly."""
    if sign_at((Fraction(1), -gain), root) < 0:
        return False
    return is_psd_at(lambda x: contraction_form(design, gain, (1 - gain * x) ** 2), 2, root)


def contraction(design: Design, gain: Any) -> bool | None:
    """The step of the proof of Theorem 1, exactly; `gain` is mu to 80 digits.

    The gains for which it holds are an interval that starts at 0, so an irrational mu is decided by its neighbours.
    """
    if design.agents > EXACT_AGENTS:
        return None
    root = lambda2_root(design)
    if root is None:
        return None
    if design.mu is not None:
        return _contraction_at(design, design.mu, root)
    middle = _dyadic(gain)
    slack = abs(middle) / 10**60
    if _contraction_at(design, middle + slack, root):
        return True
    return None if _contraction_at(design, middle - slack, root) else False


def is_lambda2(design: Design, root: Root) -> bool | None:
    """Whether the root is lambda2."""
    own = lambda2_root(design)
    if own is None:
        return None
    if not has_common_root(own.poly, root):
        return False
    with mp.workdps(60):
        return bool(abs(approx_root(own, 60) - approx_root(root, 60)) < mp.mpf(10) ** -25)


def lambda2_at_least(design: Design, s: Fraction) -> bool:
    """lambda2 >= s, exactly."""
    return is_psd(on_1perp(combine(Fraction(1), symmetric_part(laplacian(design)), -s, identity(design.agents))))


def eigenvalues_at_most(design: Design, r: Fraction) -> bool:
    """Every eigenvalue of L_s is <= r, exactly."""
    return is_psd(combine(r, identity(design.agents), Fraction(-1), symmetric_part(laplacian(design))))


def sigma_at_most(design: Design, s: Fraction) -> bool | None:
    """sigma <= s where mu is rational, exactly."""
    return None if design.mu is None else s >= 0 and is_psd(contraction_form(design, design.mu, s * s))
