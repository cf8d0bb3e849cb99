"""What is true of a design: the signs of mu - t, lambda2 - s and u - sigma, which decide every value and claim.

A sign is -1, 0, 1, or None where 4096 bits did not decide. s and u may be irrational: then they come as functions
from a precision to an enclosure, with the exact comparison for where a tie is possible.
Source: docs/certificate-format.md, section 5; docs/theory.md, section 7.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import cast

from fomas_verify.checker.definite import exact_sign, least_sign, limit_elimination, quick_sign
from fomas_verify.checker.designs import Design
from fomas_verify.checker.field import Root
from fomas_verify.checker.gain import mu_at
from fomas_verify.checker.graph import Graph, Rows
from fomas_verify.checker.powers import Enclosure, first_threshold, point
from fomas_verify.checker.resolvent import Kernel, kernel
from fomas_verify.checker.ruling import Undecided

BITS = (128, 256, 512, 1024, 2048, 4096)
MAX_FIELD_WORK = 2**22
MAX_SCALE = 2**14

Approximation = Callable[[int], Enclosure]
Exact = Callable[[], int]


def settle(
    test: Callable[[int], int | None], exact: Exact | None = None, precisions: tuple[int, ...] = ()
) -> int | None:
    """The first sign that `test` finds as the precision doubles; `exact` takes over after two tries, where given."""
    for bits in precisions or (BITS if exact is None else BITS[:2]):
        sign = test(bits)
        if sign is not None:
            return sign
    return None if exact is None else exact()


@dataclass(frozen=True)
class Facts:
    """A design and its graph, and the comparisons that decide about them."""

    design: Design
    graph: Graph

    @property
    def precisions(self) -> tuple[int, ...]:
        """All of them."""
        return BITS

    @property
    def tied_mu(self) -> Fraction | None:
        """mu if it is rational and alpha = 1/2: where a tie with 2^alpha is possible; else None."""
        return self.design.mu if self.design.alpha == Fraction(1, 2) else None

    def limit_scale(self) -> None:
        """Raise `Undecided` where gamma, mu or h is so far from 1 that many samples or parts take too long."""
        for x in (self.design.gamma, self.design.mu, self.design.h):
            if x is not None and abs(x.numerator.bit_length() - x.denominator.bit_length()) > MAX_SCALE:
                raise Undecided("at a gamma, mu or h so far from 1 this is beyond the work allowed")

    def mu(self, bits: int) -> Enclosure:
        """mu = gamma h^alpha / Gamma(alpha + 1)."""
        design = self.design
        if design.gamma is None or design.h is None:
            return point(cast(Fraction, design.mu))
        return mu_at(design.gamma, design.h, design.alpha, bits)

    def kernel(self, scale: int) -> Kernel:
        """The memory of the design."""
        return kernel(self.design.alpha, scale)

    def threshold(self, bits: int) -> Enclosure:
        """2^alpha - 1, both ends >= 0."""
        return first_threshold(self.design.alpha, bits)

    def compare_mu(self, t: Fraction) -> int | None:
        """The sign of mu - t."""
        return compare(self.mu, t)

    def compare_lambda2(self, s: Approximation, exact: Exact | None = None) -> int | None:
        """The sign of lambda2 - s, under Assumption 1."""

        def test(bits: int) -> int | None:
            box = s(bits)
            if box.lower == box.upper:
                return least_sign(self.gap_form(box.lower))
            if quick_sign(self.gap_form(box.upper), 2 * bits) == 1:
                return 1
            return -1 if quick_sign(self.gap_form(box.lower), 2 * bits) == -1 else None

        return settle(test, exact)

    def compare_lambda2_with(self, x: Fraction) -> int:
        """The sign of lambda2 - x, under Assumption 1."""
        return least_sign(self.gap_form(x))

    def compare_largest(self, r: Fraction) -> int:
        """The sign of lambda_max - r, lambda_max the largest eigenvalue of L_s on 1perp."""
        return -least_sign(self.graph.form(2 * r, Fraction(-1), Fraction(0)))

    def compare_sigma(self, u: Approximation) -> int | None:
        """The sign of u - sigma, under Assumption 1.

        sigma is convex in mu, and changes by at most norm L <= 2 D times the change of mu (norm L^2 <= norm_1 norm_oo).
        """

        def test(bits: int) -> int | None:
            box, mu = u(bits), self.mu(bits)
            if box.upper < 0:
                return -1
            if box.lower == box.upper and mu.lower == mu.upper:
                return least_sign(self.sigma_form(box.upper**2, mu.upper))
            ends = {mu.lower, mu.upper}
            if box.lower >= 0 and all(quick_sign(self.sigma_form(box.lower**2, t), 2 * bits) == 1 for t in ends):
                return 1
            above = box.upper + 2 * self.graph.degree_max * (mu.upper - mu.lower)
            return -1 if quick_sign(self.sigma_form(above**2, mu.lower), 2 * bits) == -1 else None

        return settle(test)

    def gap_form(self, s: Fraction) -> Rows:
        """2 (L_s - s I) on 1perp, its least eigenvalue of the sign of lambda2 - s."""
        return self.graph.form(-2 * s, Fraction(1), Fraction(0))

    def sigma_form(self, square: Fraction, mu: Fraction) -> Rows:
        """square I - P^T P on 1perp."""
        return self.graph.form(square - 1, mu, -(mu**2))

    def gap_sign_over(self, root: Root, s: Sequence[Fraction]) -> int:
        """The sign of lambda2 - s for s a polynomial at a root, exactly."""
        return self.sign_over(root, [-2 * c for c in s], Fraction(1), Fraction(0))

    def sign_over(self, root: Root, gram: Sequence[Fraction], symmetric: Fraction, square: Fraction) -> int:
        """The sign of the least eigenvalue of a form over Q(theta), exactly."""
        if root.degree**2 * self.design.agents**3 > MAX_FIELD_WORK:
            raise Undecided("elimination over the number field is beyond the work allowed")
        rows = self.graph.form_over(root, gram, symmetric, square)
        size = max(max(map(abs, root.modulus)).bit_length(), *(entry.bits for row in rows for entry in row))
        limit_elimination(self.design.agents, size, root.degree**2)
        return exact_sign(rows, root.element([Fraction(1)], 1), lambda entry: entry.sign())


def compare(x: Approximation, t: Fraction) -> int | None:
    """The sign of x - t for a real number x and a rational t."""

    def test(bits: int) -> int | None:
        box = x(bits)
        if box.lower == t == box.upper:
            return 0
        return 1 if box.lower > t else -1 if box.upper < t else None

    return settle(test)
