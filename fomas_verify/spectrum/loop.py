"""The closed loop of a design, with every number of it enclosed to the precision asked for.

Notation: L, L_s, D, mu, P = I - mu L, lambda2, beta, sigma, the threshold 2^alpha - 1. Everything is rigorous and
computed once a precision.
Source: theory, sections 0 and 3.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from fractions import Fraction

from fomas_verify.design import Design
from fomas_verify.enclosure.interval import Interval
from fomas_verify.enclosure.real import square_root
from fomas_verify.enclosure.roots import Root, complex_roots, greatest_root, least_root, real_roots
from fomas_verify.exact import matrix as exact
from fomas_verify.exact.matrix import Matrix
from fomas_verify.exact.polynomial import Polynomial, integer_characteristic_polynomial, without_zero_root
from fomas_verify.kernel.memory import one_step_weight, step_response
from fomas_verify.kernel.memory import threshold as kernel_threshold
from fomas_verify.network import degree_max, imbalances, laplacian, unreachable_pair
from fomas_verify.spectrum.remembered import Remembered, of_graph, of_loop, of_order

MOST_SAMPLES = 20_000
"""The last sample examined of any design."""

LONGEST_ENTRY = 2048
"""Bits of the entries from which the least eigenvalue is sought first."""


@dataclass(frozen=True, eq=False)
class Loop:
    """The closed loop of one design, and how many of its samples may be examined."""

    design: Design
    most_samples: int = MOST_SAMPLES
    remembered: Remembered = field(default_factory=Remembered, repr=False)

    def on_same_graph(self, design: Design) -> Loop:
        """The loop of a design on this digraph: what is known of the digraph, and of alpha where it is the same, is
        known of it too.

        Raises
        ------
        ValueError
            The digraph is another.
        """
        if design.graph != self.design.graph:
            raise ValueError("expected a design on the same digraph")
        known = self.remembered
        of_order = known.of_order if design.alpha == self.design.alpha else {}
        return Loop(design, self.most_samples, Remembered(known.of_graph, of_order))

    @property
    @of_graph
    def laplacian(self) -> Matrix:
        """L; row i belongs to agent i, who hears agent j where ``a_ij > 0``."""
        return exact.matrix(laplacian(self.design.graph))

    @property
    @of_graph
    def symmetric_part(self) -> Matrix:
        """``L_s = (L + L^T)/2``."""
        return exact.scaled(self.laplacian + self.laplacian.transpose(), Fraction(1, 2))

    @property
    @of_graph
    def on_differences(self) -> Matrix:
        """L acting on the differences from the last agent."""
        return exact.on_differences(self.laplacian)

    @property
    @of_graph
    def degree_max(self) -> Fraction:
        """D."""
        return degree_max(self.design.graph)

    @property
    @of_graph
    def assumption1(self) -> bool:
        """Whether the digraph is strongly connected and balanced; exact."""
        return unreachable_pair(self.design.graph) is None and not imbalances(self.design.graph)

    @property
    @of_graph
    def agreement_weights(self) -> list[Fraction] | None:
        """The w >= 0 with ``w^T L = 0`` and ``sum w_i = 1``; None where no agent reaches every other. Exact."""
        null = exact.kernel(self.laplacian.transpose())
        if null.ncols() != 1:
            return None
        w = [int(x) for x in null.numer_denom()[0].entries()]
        total = sum(w)
        return [Fraction(x, total) for x in w]

    @of_loop
    def mu(self, bits: int) -> Interval:
        """The integrated gain; exact where the design gives it."""
        design = self.design
        if design.mu is not None:
            return Interval.exactly(design.mu)
        if design.gamma is None or design.h is None:
            raise TypeError("a closed loop needs mu, or gamma and h")
        return one_step_weight(design.alpha, design.h, bits) * design.gamma

    @of_order
    def threshold(self, bits: int) -> Interval:
        """``2^alpha - 1``."""
        return kernel_threshold(self.design.alpha, bits)

    @of_order
    def lower_threshold(self, bits: int) -> Interval:
        """``-sqrt(3^alpha - 2^alpha)``: beta below it breaks (14) at k = 1."""
        return -square_root(step_response(self.design.alpha, 2, bits), bits)

    @property
    @of_graph
    def _symmetric_characteristic(self) -> tuple[Polynomial, int]:
        """The characteristic polynomial of L_s on 1perp, its roots scaled by the integer that comes with it."""
        polynomial, scale = integer_characteristic_polynomial(self.symmetric_part)
        return without_zero_root(polynomial), scale

    @property
    def symmetric_characteristic(self) -> Polynomial:
        """As above without the scale: an integer polynomial whose roots are the eigenvalues of L_s on 1perp times
        :attr:`symmetric_scale`.
        """
        return self._symmetric_characteristic[0]

    @property
    def symmetric_scale(self) -> int:
        """The scale of :attr:`symmetric_characteristic`."""
        return self._symmetric_characteristic[1]

    @of_graph
    def symmetric_spectrum(self, bits: int) -> list[tuple[Interval, int]]:
        """The distinct eigenvalues of L_s on 1perp in increasing order, with multiplicities."""
        roots = real_roots(self.symmetric_characteristic, bits)
        return [(root / self.symmetric_scale, count) for root, count in roots]

    @of_graph
    def lambda2(self, bits: int) -> Interval:
        """The smallest eigenvalue of L_s on 1perp; exact where it is a multiple of 1/scale."""
        return least_root(self.symmetric_characteristic, bits) / self.symmetric_scale

    @of_graph
    def lambda_max(self, bits: int) -> Interval:
        """The largest eigenvalue of L_s on 1perp."""
        return greatest_root(self.symmetric_characteristic, bits) / self.symmetric_scale

    def beta(self, bits: int) -> Interval:
        """``1 - mu lambda2``."""
        return 1 - self.mu(bits) * self.lambda2(bits)

    @of_loop
    def sigma(self, bits: int) -> Interval:
        """The norm of P on 1perp, from the exact singular values at a rational mu inside the enclosure.

        ``abs(sigma(mu) - sigma(m)) <= abs(mu - m) norm(L) <= 2 D abs(mu - m)``.
        """
        mu = self.mu(bits)
        middle = mu.rounded(bits).mid
        slack = 2 * self.degree_max * max(mu.upper - middle, middle - mu.lower)
        sigma = sigma_at(self.laplacian, middle, 2 * bits)
        return Interval(max(Fraction(0), sigma.lower - slack), sigma.upper + slack)

    @of_graph
    def disagreement_eigenvalues(self, bits: int) -> list[Root]:
        """The eigenvalues of L other than the one 0 of the vector 1, distinct, with multiplicities."""
        polynomial, scale = integer_characteristic_polynomial(self.on_differences)
        return [root.over(scale) for root in complex_roots(polynomial, bits)]

    @of_graph
    def mu_star(self, bits: int) -> Interval | None:
        """``min 2 Re(lambda)/abs(lambda)^2`` over these eigenvalues: P is Schur on the differences iff 0 < mu < mu*.

        None where one of them may be 0 (then no mu will do).
        """
        bounds = []
        for root in self.disagreement_eigenvalues(bits):
            if root.square.lower <= 0:
                return None
            bounds.append(root.real * 2 / root.square)
        return Interval(min(b.lower for b in bounds), min(b.upper for b in bounds))


def decrease(laplacian: Matrix, mu: Fraction) -> Matrix:
    """``S = 2 L_s - mu L^T L``, so that ``norm(P x)^2 = norm(x)^2 - mu x^T S x``; a rational mu."""
    return laplacian + laplacian.transpose() - exact.scaled(laplacian.transpose() * laplacian, mu)


def least_decrease(laplacian: Matrix, mu: Fraction, bits: int) -> Interval:
    """The smallest eigenvalue nu of S on 1perp, for a balanced graph: ``sigma^2 = 1 - mu nu``. Rigorous.

    It comes from the leading bits of long entries where these give so many bits of nu, and then is not exact.
    """
    s = decrease(laplacian, mu)
    if bits < LONGEST_ENTRY < exact.longest_bits(s):
        short, scale, far = exact.leading_bits(s, LONGEST_ENTRY)
        root = least_root(without_zero_root(integer_characteristic_polynomial(short)[0]), bits)
        nu = Interval(root.lower - far, root.upper + far) * scale
        if nu.width * 2**bits <= max(nu.lower, -nu.upper):
            return nu
    polynomial, denominator = integer_characteristic_polynomial(s)
    return least_root(without_zero_root(polynomial), bits) / denominator


def sigma_at(laplacian: Matrix, mu: Fraction, bits: int) -> Interval:
    """sigma at a rational mu, for a balanced graph. Rigorous."""
    return square_root(1 - least_decrease(laplacian, mu, bits) * mu, bits)
