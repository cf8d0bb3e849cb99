"""Witnesses for the paper's step norm P e <= beta norm e, and against it.

Source: docs/certificate-format.md, section 4; theory, "Deciding the step exactly":
beta^2 I - P^T P = mu [2 (L_s - lambda2 I) - mu (L^T L - lambda2^2 I)].
"""

from fractions import Fraction

from fomas_verify.checker.facts import Facts, compare
from fomas_verify.checker.field import isolate
from fomas_verify.checker.powers import Enclosure, point, quotient, square_root
from fomas_verify.checker.ruling import Refused, Undecided, need, need_that
from fomas_verify.checker.thresholds import sqrt_root
from fomas_verify.checker.witness import RootOf, SymmetricBounds, Vector

MAX_POLYNOMIAL_WORK = 2**26


def require_root_of(facts: Facts, witness: RootOf) -> None:
    """Return if the form 2 (L_s - theta I) - t (L^T L - theta^2 I) shows the step at t >= mu, theta = lambda2."""
    t = witness.mu
    need(facts.compare_mu(t), (-1, 0), "mu <= witness.mu")
    need_that(witness.polynomial[-1] != 0, "the highest coefficient is not 0")
    _limit_polynomial(witness)
    root = isolate(witness.polynomial, witness.lower, witness.upper)
    if root is None:
        raise Refused("not true: the polynomial has exactly one real root in (lower, upper]")
    need(facts.gap_sign_over(root, (Fraction(0), Fraction(1))), (0,), "the root is lambda2")
    scale = root.integer_scale((Fraction(1), -t))
    need(root.element((Fraction(1), -t), scale).sign(), (0, 1), "witness.mu lambda2 <= 1")
    gram = (Fraction(0), Fraction(-2), t)
    need(facts.sign_over(root, gram, Fraction(1), -t), (0, 1), "2 (L_s - lambda2 I) - mu (L^T L - lambda2^2 I) >= 0")


def _limit_polynomial(witness: RootOf) -> None:
    digits = sum(max(c.numerator.bit_length(), c.denominator.bit_length()) for c in witness.polynomial)
    ends = sum(max(x.numerator.bit_length(), x.denominator.bit_length()) for x in (witness.lower, witness.upper))
    if len(witness.polynomial) ** 3 * (digits + ends) > MAX_POLYNOMIAL_WORK:
        raise Undecided("the polynomial is beyond the work allowed")


def require_symmetric_bounds(facts: Facts, witness: SymmetricBounds) -> None:
    """Return if, on a symmetric graph, abs(1 - mu lambda) <= beta for every eigenvalue lambda of L but the first."""
    t, s, r = witness.mu, witness.lambda2_upper, witness.lambda_max_upper
    need_that(facts.graph.is_symmetric, "the graph is symmetric")
    need(facts.compare_mu(t), (-1, 0), "mu <= witness.mu")
    need(facts.compare_lambda2_with(s), (-1, 0), "lambda2 <= witness.lambda2_upper")
    need(facts.compare_largest(r), (-1, 0), "every eigenvalue of L_s is <= witness.lambda_max_upper")
    need_that(t * s <= 1, "witness.mu witness.lambda2_upper <= 1")
    need_that(t * (s + r) <= 2, "witness.mu (witness.lambda2_upper + witness.lambda_max_upper) <= 2")


def require_vector(witness: Vector) -> None:
    """Return if e != 0 sums to 0."""
    need_that(any(entry != 0 for entry in witness.e), "e is not 0")
    need_that(sum(witness.e) == 0, "e sums to 0")


def require_beyond_beta(facts: Facts, witness: Vector) -> None:
    """Return if norm(P e) > beta norm(e): lambda2 > g(mu), g(t) = (1 - norm(P(t) e)/norm(e)) / t.

    g decreases in t, as norm(P(t) e) is convex in t. Where L e = s e, norm(P e) = abs(1 - mu s) norm(e) and
    s >= lambda2, so that the inequality is lambda2 > 2/mu - s, and a tie at an irrational mu is seen.
    """
    require_vector(witness)
    symmetric, square = facts.graph.quotients(witness.e)
    what = "norm(P e) > beta norm(e)"
    if symmetric**2 == square:

        def reflected(bits: int) -> Enclosure:
            box = quotient(point(Fraction(2)), facts.mu(bits))
            return Enclosure(box.lower - symmetric, box.upper - symmetric)

        need(facts.compare_lambda2(reflected), (1,), what)
        return

    def rate(bits: int) -> Enclosure:
        mu = facts.mu(bits)
        first, last = (square_root(point(_stretch(t, symmetric, square)), bits) for t in (mu.lower, mu.upper))
        return Enclosure(
            quotient(point(1 - last.upper), point(mu.upper)).lower,
            quotient(point(1 - first.lower), point(mu.lower)).upper,
        )

    mu = facts.design.mu
    if mu is None:
        need(facts.compare_lambda2(rate), (1,), what)
        return
    root = sqrt_root(_stretch(mu, symmetric, square))
    need(facts.compare_lambda2(rate, lambda: facts.gap_sign_over(root, (1 / mu, -1 / mu))), (1,), what)


def _stretch(t: Fraction, symmetric: Fraction, square: Fraction) -> Fraction:
    """norm(P(t) e)^2 / norm(e)^2."""
    return 1 - 2 * t * symmetric + t**2 * square


def require_beyond_threshold(facts: Facts, witness: Vector) -> None:
    """Return if norm(P e) > (2^alpha - 1) norm(e)."""
    require_vector(witness)
    symmetric, square = facts.graph.quotients(witness.e)

    def excess(bits: int) -> Enclosure:
        mu, threshold = facts.mu(bits), facts.threshold(bits)
        return Enclosure(
            1 - 2 * mu.upper * symmetric + mu.lower**2 * square - threshold.upper**2,
            1 - 2 * mu.lower * symmetric + mu.upper**2 * square - threshold.lower**2,
        )

    need(compare(excess, Fraction(0)), (1,), "norm(P e) > (2^alpha - 1) norm(e)")
