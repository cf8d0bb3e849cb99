"""The same numbers by mpmath, to the digits asked: a second computation that must fall into the first one's enclosures.

Not rigorous: mpmath's last digits carry no bound, so ten more than asked are computed and the last five are not
trusted.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from fomas_verify.enclosure.interval import Interval
from fomas_verify.exact.errors import FomasError

GUARD, UNTRUSTED = 10, 5


class DisagreementError(FomasError):
    """Two computations that must agree do not."""

    exit_status = 4


def approx_gain_and_threshold(
    alpha: Fraction, h: Fraction | None, gamma: Fraction | None, digits: int
) -> dict[str, Fraction]:
    """``2^alpha - 1`` and, where h and gamma are given, ``mu = gamma h^alpha / Gamma(alpha + 1)``; approximate."""
    import mpmath

    with mpmath.workdps(digits + GUARD + _cancelled(alpha)):
        a = mpmath.mpf(alpha.numerator) / alpha.denominator
        found = {"threshold": mpmath.mpf(2) ** a - 1}
        if h is not None and gamma is not None:
            weight = (mpmath.mpf(h.numerator) / h.denominator) ** a / mpmath.gamma(a + 1)
            found["mu"] = weight * gamma.numerator / gamma.denominator
        return {name: _to_fraction(x) for name, x in found.items()}


def _cancelled(alpha: Fraction) -> int:
    """Digits lost near alpha = 0 and alpha = 1, where differences of powers are small."""
    return 2 * len(str(alpha.denominator))


def approx_memory(alpha: Fraction, j: int, digits: int) -> tuple[Fraction, Fraction]:
    """``f(j)`` and ``c_j`` for j >= 1; approximate."""
    import mpmath

    with mpmath.workdps(digits + GUARD + 2 * len(str(j)) + 5 + _cancelled(alpha)):
        a = mpmath.mpf(alpha.numerator) / alpha.denominator
        ahead, here, behind = (mpmath.mpf(n) ** a for n in (j + 1, j, j - 1))
        return _to_fraction(ahead - 2 * here + behind), _to_fraction(ahead - here)


def _to_fraction(x: Any) -> Fraction:
    """The number of mpmath, which has no types."""
    import mpmath

    p, q = mpmath.libmp.to_rational(x._mpf_)
    return Fraction(int(p), int(q))


def must_agree(name: str, enclosure: Interval, approximation: Fraction, digits: int) -> None:
    """Raise :class:`DisagreementError` where the approximation lies outside of the enclosure by more than its own
    last digits.
    """
    slack = max(abs(approximation), Fraction(1, 10**digits)) / 10 ** (digits + GUARD - UNTRUSTED)
    if not enclosure.lower - slack <= approximation <= enclosure.upper + slack:
        raise DisagreementError(f"{name}: the enclosure and mpmath disagree at {digits} digits")
