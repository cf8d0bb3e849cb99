"""The closed loop of a large design: what its graph and bounds of eigenvalues say, enclosed.

Notation: D, mu, P = I - mu L, lambda2, beta, sigma as in `loop`; lambda_max the largest eigenvalue of L_s. No matrix is
formed. Where little is known an enclosure is wide. Source: theory, section 14.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from fomas_verify.design import LargeDesign
from fomas_verify.enclosure.interval import Interval
from fomas_verify.enclosure.real import square_root
from fomas_verify.kernel.memory import one_step_weight, step_response
from fomas_verify.kernel.memory import threshold as kernel_threshold
from fomas_verify.network.family_facts import Family
from fomas_verify.network.large import GraphFacts
from fomas_verify.network.quotients import Quotients
from fomas_verify.spectrum.family_eigenvalues import extreme_eigenvalues
from fomas_verify.spectrum.large import LargeBounds

NO_BOUNDS = LargeBounds((), None, None, None, None)


@dataclass(frozen=True, eq=False)
class LargeLoop:
    """The closed loop of one large design.

    Attributes
    ----------
    facts : GraphFacts
        Of its graph.
    family : Family or None
        Where the graph is a family's, whose eigenvalues are known.
    bounds : LargeBounds
        Otherwise, under Assumption 1.
    quotients : tuple of Quotients
        Of each vector of the bounds.
    """

    design: LargeDesign
    facts: GraphFacts
    family: Family | None = None
    bounds: LargeBounds = NO_BOUNDS
    quotients: tuple[Quotients, ...] = ()

    @property
    def degree_max(self) -> Fraction:
        """D."""
        return self.facts.degree_max

    @property
    def assumption1(self) -> bool:
        """Whether the digraph is strongly connected and balanced; exact."""
        return self.facts.assumption1

    def mu(self, bits: int) -> Interval:
        """The integrated gain; exact where the design gives it."""
        return enclosed_gain(self.design, bits)

    def threshold(self, bits: int) -> Interval:
        """``2^alpha - 1``."""
        return kernel_threshold(self.design.alpha, bits)

    def lower_threshold(self, bits: int) -> Interval:
        """``-sqrt(3^alpha - 2^alpha)``."""
        return -square_root(step_response(self.design.alpha, 2, bits), bits)

    def lambda2(self, bits: int) -> Interval:
        """The smallest eigenvalue of L_s on 1perp: at most each q and 2 D."""
        if self.family is not None:
            return extreme_eigenvalues(self.family, bits)[0]
        lower = self.bounds.lambda2_lower or Fraction(0)
        return Interval(max(lower, Fraction(0)), min([2 * self.degree_max, *(q for q, _ in self.quotients)]))

    def lambda_max(self, bits: int) -> Interval:
        """The largest eigenvalue of L_s: at least each q and D, at most 2 D."""
        if self.family is not None:
            return extreme_eigenvalues(self.family, bits)[1]
        upper = 2 * self.degree_max
        if self.bounds.lambda_max_upper is not None:
            upper = min(upper, self.bounds.lambda_max_upper)
        return Interval(max([self.degree_max, *(q for q, _ in self.quotients)]), upper)

    def beta(self, bits: int) -> Interval:
        """``1 - mu lambda2``."""
        return 1 - self.mu(bits) * self.lambda2(bits)

    def reach(self, bits: int) -> Interval:
        """``mu lambda_max``."""
        return self.mu(bits) * self.lambda_max(bits)

    def sigma_square(self, bits: int) -> Interval:
        """``sigma^2``: between the largest lower bound and the least upper one of those that hold."""
        mu = self.mu(bits)
        lower = [square(self.beta(bits)).lower, *((1 - mu * (2 * q) + square(mu) * s).lower for q, s in self.quotients)]
        # norm(P e) <= norm(e) + mu norm(L e), and norm L <= 2 D.
        upper = [square(mu * (2 * self.degree_max) + 1).upper]
        if self.bounds.sigma_upper is not None:
            upper.append(self.bounds.sigma_upper**2)
        if mu.upper * self.degree_max <= 1:
            upper.append((1 - mu * 2 * self.lambda2(bits) * (1 - mu * self.degree_max)).upper)
        if (known := self._known_square(bits)) is not None:
            lower.append(known.lower)
            upper.append(known.upper)
        return Interval(max(lower), min(upper))

    def _known_square(self, bits: int) -> Interval | None:
        """sigma^2 where both ends of the spectrum give it: on a symmetric graph the larger of ``(1 - mu lambda)^2``, on
        a directed cycle of ``1 - 2 mu (1 - mu) lambda``, at lambda2 and lambda_max.
        """
        mu, ends = self.mu(bits), (self.lambda2(bits), self.lambda_max(bits))
        if self.facts.is_symmetric:
            return larger(*(square(1 - mu * end) for end in ends))
        if self.facts.is_directed_cycle:
            return larger(*(1 - mu * (1 - mu) * 2 * end for end in ends))
        return None

    def first_sample_square(self, pair: Quotients, bits: int) -> Interval:
        """``norm(Phi_1 e)^2 / norm(e)^2`` of a vector with these quotients; ``Phi_1 = (3 - 2^alpha) I - mu L``."""
        q, s = pair
        mu, whole = self.mu(bits), 2 - self.threshold(bits)
        return square(whole) - mu * whole * (2 * q) + square(mu) * s


def enclosed_gain(design: LargeDesign, bits: int) -> Interval:
    """mu; exact where the design gives it."""
    if design.mu is not None:
        return Interval.exactly(design.mu)
    if design.gamma is None or design.h is None:
        raise TypeError("a closed loop needs mu, or gamma and h")
    return one_step_weight(design.alpha, design.h, bits) * design.gamma


def square(x: Interval) -> Interval:
    """``x^2``."""
    ends = x.lower**2, x.upper**2
    return Interval(Fraction(0) if x.lower < 0 < x.upper else min(ends), max(ends))


def larger(x: Interval, y: Interval) -> Interval:
    """The larger of two numbers."""
    return Interval(max(x.lower, y.lower), max(x.upper, y.upper))
