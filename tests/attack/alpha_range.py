"""The truth of a claim over an interval of alpha, gamma and h (or mu) as given, by halving.

Over a part [x, y] every ingredient has an exact range: 2^alpha and 3^alpha - 2^alpha increase, mu(alpha) =
gamma h^alpha / Gamma(alpha + 1) is log-concave (its logarithm has the second derivative -psi'(alpha + 1)), so that it
is least at an end and largest where psi(alpha + 1) = ln h or at an end, and sigma is convex in mu. Margins as in
`oracle`: positive where the claim is true.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from functools import lru_cache
from typing import Any

import numpy as np
from mpmath import mp

from . import oracle
from .bounds import largest_eigenvalue
from .exact import charpoly, distinct_roots
from .gain import Truth
from .model import Design, degree_max, laplacian

DPS = 60
TINY = Fraction(1, 10**40)
FINE = 1e-7
LARGEST = 1e150
MOST_PARTS = 3000
Span = tuple[Any, Any]


@lru_cache(maxsize=1024)
def turning_point(h: Fraction) -> Any:
    """The alpha in [0, 1] at which h^alpha / Gamma(alpha + 1) is largest."""
    with mp.workdps(DPS):
        aim, low, high = mp.log(oracle.real(h)), mp.mpf(0), mp.mpf(1)
        for end in (low, high):
            if (mp.digamma(1 + end) >= aim) == (end == 0):
                return end
        for _ in range(4 * DPS):
            middle = (low + high) / 2
            low, high = (middle, high) if mp.digamma(1 + middle) < aim else (low, middle)
        return low


def gain_at(design: Design, alpha: Any) -> Any:
    """mu at another alpha, an mpf."""
    if design.mu is not None:
        return oracle.real(design.mu)
    assert design.gamma is not None
    assert design.h is not None
    return oracle.real(design.gamma) * oracle.real(design.h) ** alpha / mp.gamma(alpha + 1)


def gain_span(design: Design, x: Any, y: Any) -> Span:
    """The range of mu over [x, y]."""
    ends = gain_at(design, x), gain_at(design, y)
    if design.mu is not None:
        return ends
    assert design.h is not None
    return min(ends), gain_at(design, min(max(turning_point(design.h), x), y))


def excess(h: Fraction, slab: tuple[Fraction, Fraction]) -> Fraction:
    """The relative room that section 7 asks for around the range of mu over a slab, and a hair."""
    with mp.workdps(30):
        slope = Fraction(float(abs(mp.log(oracle.real(h))) + 1))
    return (slab[1] - slab[0]) * slope / 8 + Fraction(1, 10**30)


def rounded(x: Any) -> Fraction:
    """An mpf as a rational, to 400 bits after the point."""
    return Fraction(int(mp.nint(x * mp.mpf(2) ** 400)), 2**400)


def _memory(design: Design, x: Any, y: Any, gains: Span) -> Span:
    lam, (low, high) = oracle.lambda2(design, DPS + oracle.scale(design)), gains
    first = mp.mpf(2) ** x - 2 + lam * low, mp.mpf(2) ** y - 2 + lam * high
    second = tuple(1 + mp.sqrt(mp.mpf(3) ** z - mp.mpf(2) ** z) - lam * gain for z, gain in ((x, high), (y, low)))
    return min(first[0], second[0]), min(first[1], second[1])


def _gain_bound(design: Design, x: Any, y: Any, gains: Span) -> Span:
    low, high = gains
    d = oracle.real(degree_max(design))
    return 1 - d * high, 1 - d * low


@lru_cache(maxsize=256)
def last_stable_gain(design: Design) -> Any:
    """min 2 Re(lambda)/abs(lambda)^2 over the eigenvalues lambda of L but one zero; 0 where another one is 0."""
    roots = distinct_roots(charpoly(laplacian(design))[1:], DPS)
    with mp.workdps(DPS):
        tiny = mp.mpf(10) ** (-DPS // 2)
        return min(mp.mpf(0) if abs(z) < tiny else 2 * mp.re(z) / abs(z) ** 2 for z, _ in roots)


def _perron(design: Design, x: Any, y: Any, gains: Span) -> Span:
    low, high = gains
    return last_stable_gain(design) - high, last_stable_gain(design) - low


@lru_cache(maxsize=64)
def _real_laplacian(design: Design) -> list[list[Any]]:
    with mp.workdps(DPS):
        return [[oracle.real(x) for x in row] for row in laplacian(design)]


def _sigma(design: Design, gain: Any, in_digits: bool) -> Span:
    """sigma at a gain, to the working precision, or in floats with a guard against rounding; then any number where P
    has outgrown them.
    """
    if in_digits:
        basis = oracle._orthonormal_basis(design.agents)
        p = basis - gain * (mp.matrix([[oracle.real(x) for x in row] for row in laplacian(design)]) * basis)
        size = oracle.largest_singular_value(p)
        return size, size
    if gain * oracle.real(degree_max(design)) > LARGEST:
        return mp.ninf, mp.inf
    step = np.array([[float(gain * x) for x in row] for row in _real_laplacian(design)])
    centre = np.eye(design.agents) - 1 / design.agents
    size = mp.mpf(float(np.linalg.norm(centre - step @ centre, 2)))
    guard = mp.mpf("1e-12") * (1 + 2 * gain * oracle.real(degree_max(design)))
    return size - guard, size + guard


def _repaired(design: Design, x: Any, y: Any, gains: Span) -> Span:
    span = _repaired_by(design, x, y, gains, in_digits=False)
    if span[0] > 0 or span[1] < 0 or y - x >= FINE:
        return span
    return _repaired_by(design, x, y, gains, in_digits=True)


def _repaired_by(design: Design, x: Any, y: Any, gains: Span, *, in_digits: bool) -> Span:
    low, high = gains
    sizes = [_sigma(design, gain, in_digits) for gain in {low, high}]
    steepest = oracle.real(2 * degree_max(design))  # norm L <= 2 D on a balanced graph
    below = max(size[0] for size in sizes) - steepest * (high - low)
    return mp.mpf(2) ** x - 1 - max(size[1] for size in sizes), mp.mpf(2) ** y - 1 - below


def _symmetric_norms(design: Design, x: Any, y: Any, gains: Span) -> Span:
    """eqL3 on a symmetric graph: mu lambda2 >= 2 - 2^alpha and mu lambda_N <= 2."""
    lam, most = oracle.lambda2(design, DPS), largest_eigenvalue(design, DPS)
    low, high = gains
    lower = min(mp.mpf(2) ** x - 2 + lam * low, 2 - most * high)
    return lower, min(mp.mpf(2) ** y - 2 + lam * high, 2 - most * low)


SPANS: dict[str, Callable[[Design, Any, Any, Span], Span]] = {
    "gain-bound": _gain_bound,
    "memory-inequality": _memory,
    "perron-eigenvalues": _perron,
    "repaired-condition": _repaired,
    "control-norm-bound": _symmetric_norms,
}


def halved(span: Callable[[Any, Any], Span], lower: Fraction, upper: Fraction, dps: int) -> tuple[Truth, Fraction]:
    """Whether the lower end of `span`, a range over a part of [lower, upper], is positive; if not, a point where not.

    None where 40 digits do not tell.
    """
    with mp.workdps(dps):
        tiny, open_at = oracle.real(TINY), None
        waiting, parts = [(lower, upper), (lower, lower), (upper, upper)], 0
        while waiting:
            x, y = waiting.pop()
            parts += 1
            low = span(oracle.real(x), oracle.real(y))[0]
            if low > tiny:
                continue
            if x == y and low < -tiny:
                return False, x
            if y - x <= TINY or parts > MOST_PARTS:
                open_at = x
                continue
            middle = (x + y) / 2
            waiting += [(x, middle), (middle, y), (middle, middle)]
        return (True, lower) if open_at is None else (None, open_at)


def truth_over(design: Design, claim: str, truth: bool, lower: Fraction, upper: Fraction) -> Truth:
    """Whether the claim has this truth at every alpha of [lower, upper]."""

    def span(x: Any, y: Any) -> Span:
        low, high = SPANS[claim](design, x, y, gain_span(design, x, y))
        return (low, high) if truth else (-high, -low)

    return halved(span, lower, upper, DPS + 10 + oracle.scale(design))[0]
