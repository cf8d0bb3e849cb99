"""Comparisons of beta and sigma with rationals and with the thresholds of the paper, ties included.

Each function returns the sign of a threshold minus the value, or None where it was not decided.
Source: theory, "(14) in closed form"; docs/theory.md, section 7: a tie with 2^alpha is possible at alpha = 1/2 only,
with a rational mu, and is decided over Q(sqrt 2); a tie with -sqrt(3^alpha - 2^alpha) is not possible then.
"""

from fractions import Fraction

from fomas_verify.checker.facts import Facts
from fomas_verify.checker.field import Root
from fomas_verify.checker.powers import Enclosure, point, quotient, second_threshold


def sqrt_root(r: Fraction) -> Root:
    """The field Q(sqrt r), r > 0."""
    s = r.numerator * r.denominator
    return Root((-s, 0, 1), r.denominator, Fraction(0), Fraction(s + 1))


def beta_below(facts: Facts, x: Fraction) -> int | None:
    """The sign of x - beta: of lambda2 - (1 - x) / mu."""
    return facts.compare_lambda2(lambda bits: quotient(point(1 - x), facts.mu(bits)))


def beta_below_first(facts: Facts) -> int | None:
    """The sign of (2^alpha - 1) - beta: of lambda2 - (2 - 2^alpha) / mu."""

    def gap(bits: int) -> Enclosure:
        threshold = facts.threshold(bits)
        return quotient(Enclosure(1 - threshold.upper, 1 - threshold.lower), facts.mu(bits))

    mu = facts.tied_mu
    if mu is None:
        return facts.compare_lambda2(gap)
    return facts.compare_lambda2(gap, lambda: facts.gap_sign_over(sqrt_root(Fraction(2)), (2 / mu, -1 / mu)))


def beta_below_second(facts: Facts) -> int | None:
    """The sign of -sqrt(3^alpha - 2^alpha) - beta: of lambda2 - (1 + sqrt(3^alpha - 2^alpha)) / mu."""

    def gap(bits: int) -> Enclosure:
        root = second_threshold(facts.design.alpha, bits)
        return quotient(Enclosure(1 + root.lower, 1 + root.upper), facts.mu(bits))

    return facts.compare_lambda2(gap)


def sigma_below(facts: Facts, x: Fraction) -> int | None:
    """The sign of x - sigma."""
    return facts.compare_sigma(lambda _: point(x))


def sigma_below_first(facts: Facts) -> int | None:
    """The sign of (2^alpha - 1) - sigma.

    No tie at a rational mu: the conjugate (1 + sqrt 2)^2 of (sqrt 2 - 1)^2 would be a larger eigenvalue of P^T P
    on 1perp.
    """
    return facts.compare_sigma(facts.threshold)
