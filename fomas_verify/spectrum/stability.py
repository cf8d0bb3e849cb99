"""Whether P contracts the disagreement: all its other eigenvalues in the open unit disc, and what shows it.

``Pc(t) = I - t Lc`` is P acting on the differences from the last agent. It is Schur iff 0 < t < mu*. Witnesses: a
Lyapunov form Q, a power whose trace is too large, or, for eigenvalues of modulus exactly 1, an invariant form Y.
Source: theory, section 3;
docs/certificate-format.md, section 4.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from fractions import Fraction
from typing import Any

from fomas_verify.enclosure.interval import Interval, is_dyadic, short_dyadic
from fomas_verify.enclosure.linear import approx_lyapunov_sum, integer_lyapunov_form
from fomas_verify.enclosure.roots import complex_roots, is_on_unit_circle, power_sum
from fomas_verify.exact import matrix as exact
from fomas_verify.exact.matrix import Matrix
from fomas_verify.exact.polynomial import (
    Polynomial,
    irreducible_factors,
    is_self_reciprocal,
    power_sums,
    rational_characteristic_polynomial,
)
from fomas_verify.spectrum.loop import Loop
from fomas_verify.spectrum.precision import PRECISIONS
from fomas_verify.spectrum.remembered import of_graph, of_loop


class Side(StrEnum):
    """Where the spectral radius of P on the disagreement lies."""

    INSIDE = "below 1"
    BOUNDARY = "equal to 1"
    OUTSIDE = "above 1"
    UNKNOWN = "not decided"


@dataclass(frozen=True)
class Stability:
    """The side, the witness in the terms of the certificate, and mu* as it was seen (None: no mu is small enough)."""

    side: Side
    witness: Mapping[str, Any]
    mu_star: Interval | None


@of_loop
def stability(loop: Loop) -> Stability:
    """Decide mu < mu*, as to its truth; rigorous. A tie of a rational mu is decided exactly."""
    star = None
    for bits in PRECISIONS:
        mu = loop.mu(bits)
        if any(root.real.is_exact and root.real.lower == 0 for root in loop.disagreement_eigenvalues(bits)):
            t = short_dyadic(mu.lower * Fraction(3, 4), mu.lower)
            return Stability(Side.BOUNDARY, {"mu": t, "Y": invariant_form(loop, t, bits)}, None)
        star = mu_star(loop, bits)
        if star is None:
            continue
        if mu.upper < star.lower:
            t = short_dyadic(mu.upper, mu.upper + (star.lower - mu.upper) / 4)
            return Stability(Side.INSIDE, {"mu": t, "Q": lyapunov_form(at(loop, t))}, star)
        if mu.lower > star.upper:
            t = short_dyadic(mu.lower - (mu.lower - star.upper) / 4, mu.lower)
            power = large_trace_power(loop, t, bits)
            if power is not None:
                return Stability(Side.OUTSIDE, {"mu": t, "power": power}, star)
            if star.is_exact and is_dyadic(star.lower):
                form = invariant_form(loop, star.lower, bits)
                if form is not None:
                    return Stability(Side.OUTSIDE, {"mu": star.lower, "Y": form}, star)
        elif mu.is_exact and (form := invariant_form(loop, mu.lower, bits)) is not None:
            return Stability(Side.BOUNDARY, {"mu": mu.lower, "Y": form}, star)
    return Stability(Side.UNKNOWN, {"bits": PRECISIONS[-1]}, star)


@of_graph
def mu_star(loop: Loop, bits: int) -> Interval | None:
    """mu*, exactly 1/Delta_max where it is that number, as on a directed cycle; None as :meth:`Loop.mu_star`."""
    star = loop.mu_star(bits)
    if star is None or star.is_exact or not star.contains(bound := 1 / loop.degree_max):
        return star
    return star if invariant_form(loop, bound, bits) is None else Interval.exactly(bound)


def at(loop: Loop, t: Fraction) -> Matrix:
    """``Pc(t)``."""
    differences = loop.on_differences
    return exact.identity(differences.nrows()) - exact.scaled(differences, t)


def lyapunov_form(p: Matrix) -> list[list[Fraction]]:
    """The lower triangle of an integer Q > 0 with ``Q - P^T Q P > 0``, for a Schur matrix P; accepted by the exact
    test only.
    """
    for bits in PRECISIONS:
        if (form := lyapunov_form_within(p, bits)) is not None:
            return form
    raise ArithmeticError(
        f"no Lyapunov form found at {PRECISIONS[-1]} bits for a matrix whose eigenvalues lie in the open disc"
    )


def lyapunov_form_within(p: Matrix, bits: int) -> list[list[Fraction]] | None:
    """The same, sought at one precision: None where it shows none, for P that is not Schur too."""
    candidate = approx_lyapunov_sum(p, bits)
    if candidate is None:
        return None
    for scale in (8, 16, 32, 64, bits // 2, bits):
        q = integer_lyapunov_form(candidate, scale)
        if exact.is_positive_definite(q - p.transpose() * q * p) and exact.is_positive_definite(q):
            return lower_triangle(q)
    return None


def lower_triangle(a: Matrix) -> list[list[Fraction]]:
    """The rows of the lower triangle."""
    return [row[: i + 1] for i, row in enumerate(exact.to_rows(a))]


def large_trace_power(loop: Loop, t: Fraction, bits: int) -> int | None:
    """A power n with ``abs trace(Pc(t)^n) >= N - 1/2``: it is at most N - 1 where no eigenvalue lies outside the
    disc.
    """
    eigenvalues = loop.disagreement_eigenvalues(bits)
    n = 1
    while n.bit_length() <= min(bits // 2, 256):
        if power_sum(eigenvalues, t, n, bits).lower > loop.design.graph.agents - Fraction(1, 2):
            return n
        n += 1 + n // 8
    return None


def invariant_form(loop: Loop, t: Fraction, bits: int) -> list[list[Fraction]] | None:
    """The lower triangle of a rational Y >= 0, Y != 0 with ``Pc(t)^T Y Pc(t) = Y``, where eigenvalues of modulus 1
    allow one; exact.
    """
    transposed = at(loop, t).transpose()
    for factor in irreducible_factors(rational_characteristic_polynomial(transposed)):
        if is_self_reciprocal(factor) and all(is_on_unit_circle(complex_roots(factor, bits))):
            y = _invariant_on_factor(transposed, factor)
            if transposed * y * transposed.transpose() == y:
                return lower_triangle(y)
    return None


def _invariant_on_factor(a: Matrix, factor: Polynomial) -> Matrix:
    """``sum_k v_k v_k^*`` over the components v_k of one vector along the eigenvectors of the factor's roots.

    In the basis b, A b, ..., A^(d-1) b of that vector's cyclic space it is the inverse of the Toeplitz matrix of the
    roots' power sums.
    """
    vector = exact.kernel(exact.evaluate(factor, a))
    column = exact.column(vector, 0)
    degree = factor.degree()
    basis = [column]
    for _ in range(degree - 1):
        basis.append(a * basis[-1])
    krylov = exact.columns(basis)
    sums = power_sums(factor, degree)
    toeplitz = exact.matrix([[sums[abs(i - j)] for j in range(degree)] for i in range(degree)])
    y = krylov * toeplitz.inv() * krylov.transpose()
    return exact.scaled(y, int(y.numer_denom()[1]))
