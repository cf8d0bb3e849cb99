"""How much one step shrinks the disagreement: directions that show a large factor, and proofs that no direction does.

Notation: sigma = norm of P on 1perp; a direction e sums to 0. Source: theory, sections 3 and 5.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction

from fomas_verify.enclosure.interval import Interval, short_dyadic
from fomas_verify.enclosure.linear import approx_eigenvector
from fomas_verify.enclosure.real import square_root
from fomas_verify.enclosure.roots import real_roots
from fomas_verify.exact import matrix as exact
from fomas_verify.exact.numberfield import RealField, is_semidefinite, quadratic_in_theta
from fomas_verify.exact.polynomial import Polynomial, irreducible_factors, scaled_roots
from fomas_verify.spectrum.loop import Loop, decrease, least_decrease
from fomas_verify.spectrum.remembered import of_graph, of_loop

FIELD_WORK = 1_000_000
"""Bound on ``degree^2 N^3`` for elimination over Q(lambda2)."""

ROUGH_END, SETTLED_END = 16, 90
"""Bits to which an end of the interval of contraction is known, at first and when no more is asked."""


def directions(loop: Loop, mu: Fraction, bits: int) -> Iterator[list[Fraction]]:
    """Integer vectors that sum to 0, ever nearer to the one that P(mu) shrinks least."""
    approximation = _approx_direction(loop, mu, bits)
    scale = 1
    while scale <= bits:
        e = [Fraction(round(x * (1 << scale))) for x in approximation]
        largest = max(range(len(e)), key=lambda i: abs(e[i]))
        e[largest] -= sum(e)
        if any(e):
            yield e
        scale += 1 + scale // 2


@of_loop
def _approx_direction(loop: Loop, mu: Fraction, bits: int) -> list[Fraction]:
    """A vector near the one that P(mu) shrinks least; two claims ask for it at the same mu."""
    shift = least_decrease(loop.laplacian, mu, bits).lower
    return approx_eigenvector(decrease(loop.laplacian, mu), shift, bits)


def squared_stretch(loop: Loop, e: list[Fraction], mu: Interval) -> Interval:
    """``norm(P e)^2 / norm(e)^2`` for e != 0; rigorous."""
    le = exact.apply(loop.laplacian, e)
    size = exact.norm_squared(e)
    cross = sum((x * y for x, y in zip(e, le, strict=True)), Fraction(0)) / size
    value = mu * mu * (exact.norm_squared(le) / size) - mu * (2 * cross) + 1
    return Interval(max(Fraction(0), value.lower), value.upper)


def direction_above(loop: Loop, bound: Interval, bits: int) -> list[Fraction] | None:
    """A direction e with ``norm(P e) > bound norm(e)``, tested rigorously; None where none was found at this
    precision.
    """
    mu = loop.mu(bits)
    for e in directions(loop, mu.mid, bits):
        if bound.upper < 0 or squared_stretch(loop, e, mu).lower > bound.upper**2:
            return e
    return None


@dataclass(frozen=True)
class Lambda2Root:
    """lambda2 as the one root of an irreducible integer polynomial in ``(lower, upper]``."""

    polynomial: Polynomial
    lower: Fraction
    upper: Fraction


@of_graph
def lambda2_root(loop: Loop, bits: int) -> Lambda2Root | None:
    """lambda2 exactly; None where the precision does not tell its irreducible factor."""
    target = loop.lambda2(bits)
    scale = Fraction(1, loop.symmetric_scale)
    hits: list[tuple[Polynomial, Interval]] = []
    for factor in irreducible_factors(loop.symmetric_characteristic):
        roots = [root for root, _ in real_roots(factor, bits) if (root * scale).overlaps(target)]
        hits += [(factor, root * scale) for root in roots]
    if len(hits) != 1:
        return None
    factor, root = hits[0]
    lower = root.lower - (Fraction(1, 1 << bits) if root.is_exact else 0)
    return Lambda2Root(scaled_roots(factor, scale), lower, root.upper)


def field_is_small(loop: Loop, root: Lambda2Root) -> bool:
    """Whether exact algebra over Q(lambda2) stays within the work allowed."""
    return bool(root.polynomial.degree() ** 2 * loop.laplacian.nrows() ** 3 <= FIELD_WORK)


def is_normal_on_fiedler_space(loop: Loop, root: Lambda2Root) -> bool:
    """Whether the skew part of L vanishes on the eigenspace of lambda2; exact, through its rational hull."""
    hull = exact.kernel(exact.evaluate(root.polynomial, loop.symmetric_part))
    skew = loop.laplacian - loop.laplacian.transpose()
    return not any(x for row in (skew * hull).tolist() for x in row)


def beta_contracts_at(loop: Loop, root: Lambda2Root, t: Fraction) -> bool:
    """Whether ``t lambda2 <= 1`` and ``2 (L_s - lambda2 I) - t (L^T L - lambda2^2 I) >= 0`` on 1perp; exact, over
    Q(lambda2).
    """
    field = RealField(root.polynomial, root.lower, root.upper)
    if field.sign(field.affine(Fraction(1), -t)) < 0:
        return False
    el = loop.laplacian
    one = exact.on_sum_zero(exact.identity(el.nrows()))
    constant = exact.on_sum_zero(exact.scaled(loop.symmetric_part, 2) - exact.scaled(el.transpose() * el, t))
    return is_semidefinite(field, quadratic_in_theta(field, constant, exact.scaled(one, -2), exact.scaled(one, t)))


def beta_contraction_witness(loop: Loop, bits: int) -> dict[str, object] | None:
    """What proves ``norm(P e) <= beta norm(e)`` on 1perp, or None where this precision gives no proof."""
    if loop.laplacian == loop.laplacian.transpose() and (found := _symmetric_witness(loop, bits)) is not None:
        return found
    root = lambda2_root(loop, bits)
    if root is None or not field_is_small(loop, root):
        return None
    if not is_normal_on_fiedler_space(loop, root):
        return None
    for t in _just_above(loop.mu(bits), bits):
        if beta_contracts_at(loop, root, t):
            polynomial = [Fraction(int(c)) for c in root.polynomial.coeffs()]
            return {"mu": t, "lambda2": {"polynomial": polynomial, "lower": root.lower, "upper": root.upper}}
    return None


def _symmetric_witness(loop: Loop, bits: int) -> dict[str, object] | None:
    """On a symmetric graph the step holds iff ``mu (lambda2 + lambda_N) <= 2``; short numbers that show it strictly."""
    mu, smallest, largest = loop.mu(bits).upper, loop.lambda2(bits).upper, loop.lambda_max(bits).upper
    room = (2 / (mu * (smallest + largest)) - 1) / 3
    if room <= 0:
        return None

    def above(x: Fraction) -> Fraction:
        return short_dyadic(x, x * (1 + min(room, Fraction(1))))

    return {"mu": above(mu), "lambda2_upper": above(smallest), "lambda_max_upper": above(largest)}


def _just_above(mu: Interval, bits: int) -> list[Fraction]:
    """Rationals at or above mu, from short ones to the nearest."""
    if mu.is_exact:
        return [mu.lower]
    slacks = [mu.upper / (1 << shift) for shift in (4, 10, 24, bits // 2)]
    return [short_dyadic(mu.upper, mu.upper + slack) for slack in slacks]


def contraction_interval(loop: Loop, factor: Interval, *, cuts: int = 48) -> Interval | None:
    """An interval outside of which no mu has ``sigma(mu) <= factor``; None where no mu has it. Rigorous.

    abs(1 - mu lambda2) <= sigma gives the first ends. A direction e cuts off every mu with ``norm(P(mu) e) > factor
    norm(e)``: all but a closed interval, since the square is a convex parabola in mu. From outside these are Newton's
    steps, so the ends come within about 2^-90 of themselves of the true ones, unless these two nearly meet.
    """
    slowest, digits = loop.lambda2(64), [ROUGH_END, ROUGH_END]
    region = Interval((1 - factor.upper) / slowest.upper, (1 + factor.upper) / slowest.lower)
    for cut in range(cuts):
        side = cut % 2 if digits[cut % 2] < SETTLED_END else 1 - cut % 2
        if digits[side] >= SETTLED_END:
            break
        end = region.upper if side else region.lower
        near = short_dyadic(end * (1 - Fraction(1, 1 << digits[side])), end)
        allowed = _parabola_interval(loop, last(directions(loop, near, 64)), factor.upper)
        if allowed is None or not allowed.overlaps(region):
            return None
        region = Interval(max(region.lower, allowed.lower), min(region.upper, allowed.upper))
        moved = abs((region.upper if side else region.lower) - end) / end
        digits[side] = max(digits[side], 2 * _leading_zeros(moved) + 8)
    return region


def _leading_zeros(x: Fraction) -> int:
    """The j with x near ``2^-j``, at most as many as settle an end."""
    return SETTLED_END if x == 0 else min(SETTLED_END, max(0, x.denominator.bit_length() - x.numerator.bit_length()))


def last(items: Iterator[list[Fraction]]) -> list[Fraction]:
    """The last of them."""
    found: list[Fraction] = []
    for item in items:
        found = item
    return found


def _parabola_interval(loop: Loop, e: list[Fraction], factor: Fraction) -> Interval | None:
    """The mu with ``norm(e - mu L e)^2 <= factor^2 norm(e)^2``, rounded outward."""
    le = exact.apply(loop.laplacian, e)
    a, c = exact.norm_squared(le), exact.norm_squared(e) * (1 - factor**2)
    b = sum((x * y for x, y in zip(e, le, strict=True)), Fraction(0))
    discriminant = b * b - a * c
    if discriminant < 0 or a == 0:
        return None
    root = square_root(Interval.exactly(discriminant), 192)
    return Interval(((b - root.upper) / a), ((b + root.upper) / a)).rounded(128)
