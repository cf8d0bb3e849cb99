"""What is true of the conditions on mu that a region's certificate states, by the oracle's own lambda2 and sigma.

A condition's margin at mu is positive where mu satisfies it. Each condition holds on an interval of mu, so its ends
decide. The least sigma is sought in floats; `None`: within 1e-9 of an equality there, or beyond what is affordable.
Source: docs/certificate-format.md, section 8.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from typing import Any

import numpy as np
from mpmath import mp
from scipy.optimize import brentq, minimize_scalar

from . import oracle
from .gain import Truth, both
from .model import Design, assumption_1, degree_max, laplacian

DPS = 60
TINY = mp.mpf(10) ** -35
NEAR = 1e-9
CONDITIONS = ("as-stated", "repaired-closed-form", "repaired", "gain-bound", "consensus")

Pair = tuple[Fraction, Fraction]


def at_least(x: Any, tiny: Any = TINY) -> Truth:
    """Whether x >= 0; None within `tiny` of 0."""
    return None if abs(x) <= tiny else bool(x > 0)


@dataclass(frozen=True)
class Conditions:
    """The conditions on one graph at one alpha; the design's own gain plays no part."""

    design: Design

    def at(self, mu: Fraction) -> Design:
        """The design with this mu."""
        return replace(self.design, mu=mu, gamma=None, h=None, x0=None)

    @cached_property
    def top(self) -> Fraction:
        """1/D."""
        return 1 / degree_max(self.design)

    def threshold(self, alpha: Fraction) -> Any:
        """2^alpha - 1."""
        return mp.mpf(2) ** oracle.real(alpha) - 1

    def margin(self, name: str, mu: Fraction, alpha: Fraction | None = None) -> Any:
        """Positive where mu satisfies the condition at alpha (the design's own), (15) left out; section 8."""
        with mp.workdps(DPS):
            alpha = self.design.alpha if alpha is None else alpha
            if name == "consensus":
                return oracle.spectral_margin(self.at(mu), DPS)
            t, top = self.threshold(alpha), oracle.real(self.top)
            if name == "gain-bound":
                return top - oracle.real(mu)
            lambda2, x = oracle.lambda2(self.design, DPS), oracle.real(mu)
            if name == "as-stated":
                c2 = mp.mpf(3) ** oracle.real(alpha) - mp.mpf(2) ** oracle.real(alpha)
                return min(t - 1 + x * lambda2, 1 - x * lambda2 + mp.sqrt(c2))
            if name == "repaired-closed-form":
                return t**2 - 1 + 2 * x * lambda2 * (1 - x / top)
            return t - oracle.sigma(self.at(mu), DPS)

    @cached_property
    def _floats(self) -> tuple[np.ndarray, np.ndarray]:
        n = self.design.agents
        basis = np.linalg.qr(np.eye(n)[:, :-1] - 1 / n)[0]
        el = np.array([[float(x) for x in row] for row in laplacian(self.design)])
        return np.eye(n - 1), basis.T @ el @ basis

    def sigma(self, mu: float) -> float:
        """sigma in floats."""
        unit, el = self._floats
        return float(np.linalg.norm(unit - mu * el, 2))

    @cached_property
    def best(self) -> float:
        """The mu <= 1/D with the least sigma, in floats."""
        top = float(self.top)
        found = minimize_scalar(self.sigma, bounds=(0, top), method="bounded", options={"xatol": 1e-13 * top})
        return min([float(found.x), top], key=self.sigma)

    def empty_below(self, name: str, alpha: Fraction) -> Truth:
        """Whether no mu up to 1/D satisfies the condition at alpha; at the alpha that opens it both answers count."""
        with mp.workdps(DPS):
            if name == "repaired":
                room = self.sigma(self.best) - float(self.threshold(alpha))
                return at_least(room, NEAR)
            mu = self.top if name == "as-stated" else self.top / 2
            return at_least(-self.margin(name, mu, alpha))

    def ends(self, name: str, level: float | None = None) -> tuple[float, float] | None:
        """Where the condition holds, in floats; `level` in place of 2^alpha - 1 for `repaired`. None for nowhere."""
        top, t = float(self.top), float(self.threshold(self.design.alpha))
        if name == "gain-bound":
            return 0.0, top
        if name == "consensus":
            values = np.linalg.eigvals(self._floats[1])
            return 0.0, float(min(2 * values.real / abs(values) ** 2))
        lambda2 = float(oracle.lambda2(self.design, DPS))
        if name == "as-stated":
            alpha = float(self.design.alpha)
            low, high = (1 - t) / lambda2, min(top, (1 + (3**alpha - 2**alpha) ** 0.5) / lambda2)
            return (low, high) if low < high else None
        if name == "repaired-closed-form":
            room = 1 - 2 * (1 - t * t) / (top * lambda2)
            return None if room < 0 else (top * (1 - room**0.5) / 2, top * (1 + room**0.5) / 2)
        t = t if level is None else level
        if self.sigma(self.best) > t:
            return None
        low = float(brentq(lambda mu: self.sigma(mu) - t, 0.0, self.best, xtol=1e-15, rtol=1e-14))
        if self.sigma(top) <= t:
            return low, top
        return low, float(brentq(lambda mu: self.sigma(mu) - t, self.best, top, xtol=1e-15, rtol=1e-14))


def strip_holds(conditions: Conditions, name: str, inner: Pair, outer: Pair) -> Truth:
    """Whether every mu of `inner` satisfies the condition and none outside of `outer` does."""
    (a, b), (c, d), top = inner, outer, conditions.top
    if not 0 <= c <= a <= b <= d or a <= 0:
        return False
    if name == "gain-bound":
        return c == 0 and b < top <= d
    if name == "consensus":
        within = at_least(conditions.margin(name, b))
        beyond = at_least(conditions.margin(name, d))
        return both(c == 0, within, None if beyond is None else not beyond)
    inside = [at_least(conditions.margin(name, x)) for x in (a, b)]
    low = True if c == 0 else at_least(-conditions.margin(name, c))
    high = True if d >= top else at_least(-conditions.margin(name, d))
    return both(b < top, *inside, low, high)


def opening_holds(conditions: Conditions, name: str, lower: Fraction, upper: Fraction) -> Truth:
    """Whether the condition holds for no mu at any alpha below `lower`, and for some at each above `upper`."""
    if not 0 <= lower <= upper <= 1:
        return False
    shut = True if lower == 0 else conditions.empty_below(name, lower)
    kept = conditions.empty_below(name, upper) if upper < 1 else False
    return both(shut, None if kept is None else not kept)


def condition_holds(conditions: Conditions, name: str, verdict: str, witness: dict[str, Any]) -> Truth:
    """Whether what a condition's entry says is so."""
    applies = assumption_1(conditions.design)
    if verdict == "refuted":
        if not applies:
            return name != "gain-bound"
        if name in ("gain-bound", "consensus"):
            return False
        parts = [conditions.empty_below(name, conditions.design.alpha)]
    else:
        if not applies and name != "gain-bound":
            return False
        mu = witness["mu"]
        parts = [strip_holds(conditions, name, _pair(mu["inner"]), _pair(mu["outer"]))]
    if "alpha_opens" in witness:
        opens = witness["alpha_opens"]
        parts.append(opening_holds(conditions, name, Fraction(opens["lower"]), Fraction(opens["upper"])))
    return both(*parts)


def _pair(item: list[str]) -> Pair:
    return Fraction(item[0]), Fraction(item[1])
