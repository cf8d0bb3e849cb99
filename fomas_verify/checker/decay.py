"""How fast the powers of P shrink on 1perp: the first whose norm is small enough, and bounds kappa rho^k of all norms.

D = P - J. Source: docs/certificate-format.md, section 3; theory, section 7 (rate).
"""

from fractions import Fraction
from functools import lru_cache
from math import ceil

from fomas_verify.checker.ball import Ball, deviation, exact_deviation, power, product
from fomas_verify.checker.definite import least_sign
from fomas_verify.checker.facts import BITS, Facts, settle
from fomas_verify.checker.graph import limit_size
from fomas_verify.checker.norms import compare_norm_with, measured, norm_lower, norm_upper
from fomas_verify.checker.powers import point
from fomas_verify.checker.ruling import Undecided, need, need_that

MAX_POWER = 2**64
MAX_EXACT_BITS = 2**15
MAX_PRODUCT_WORK = 2**35
SCAN_BITS = 256
ROUGH_BITS = 64
BASES = (4, 32, 512, 8192)


class Budget:
    """Products of matrices that may still be formed, counted in entries times bits."""

    def __init__(self, agents: int) -> None:
        self.size = agents**3
        self.left = MAX_PRODUCT_WORK

    def spend(self, products: int, bits: int) -> None:
        """Take off some products, or raise `Undecided`."""
        self.left -= products * self.size * bits
        if self.left < 0:
            raise Undecided("as many products of matrices are beyond the work allowed")


@lru_cache(maxsize=64)
def norm_sign(facts: Facts, n: int, s: Fraction) -> int | None:
    """The sign of s - norm P^n on 1perp, n >= 1, s > 0; exactly where mu is rational and n small."""
    budget = Budget(facts.design.agents)

    def test(bits: int) -> int | None:
        budget.spend(2 * n.bit_length(), bits)
        return compare_norm_with(power(deviation(facts, bits), n, bits), s, 2 * bits)

    mu = facts.design.mu
    if mu is None:
        return settle(test)
    columns, q = exact_deviation(facts, mu)
    if n * q.bit_length() > MAX_EXACT_BITS:
        return settle(test)

    def exact() -> int:
        gram = power(Ball(columns, 0, 0), n, None).gram
        square, scale = s.numerator**2 * q ** (2 * n), s.denominator**2
        limit_size(square.bit_length() + scale.bit_length(), len(gram))
        return least_sign([[square * (i == j) - scale * x for j, x in enumerate(row)] for i, row in enumerate(gram)])

    return settle(test, exact)


def require_settling(facts: Facts, name: str, ends: tuple[Fraction, Fraction], settle_to: Fraction) -> None:
    """Return if the smallest k with norm P^k <= settle_to lies between the ends; P is Schur on 1perp."""
    need_that(0 < settle_to < 1, "0 < settle_to < 1")
    first, last = ceil(ends[0]), ends[1] // 1
    above, below = f"lower <= {name}", f"{name} <= upper"
    need_that(last >= 1, below)
    if facts.compare_sigma(lambda _: point(Fraction(1))) not in (0, 1):
        found = _first_settled(facts, settle_to, last)
        need_that(found is not None, below)
        need_that(found is not None and found >= first, above)
        return
    # sigma <= 1: norm P^k does not increase.
    if first > 1:
        sign = norm_sign(facts, min(first - 1, MAX_POWER), settle_to)
        need(None if first > MAX_POWER and sign == -1 else sign, (-1,), above)
    sign = norm_sign(facts, min(last, MAX_POWER), settle_to)
    need(None if last > MAX_POWER and sign == -1 else sign, (0, 1), below)


@lru_cache(maxsize=4)
def _first_settled(facts: Facts, settle_to: Fraction, last: int) -> int | None:
    """The smallest k <= last with norm P^k <= settle_to, or None if there is none."""
    budget = Budget(facts.design.agents)
    step = ball = measured(deviation(facts, SCAN_BITS))
    for k in range(1, last + 1):
        sign = compare_norm_with(ball, settle_to, SCAN_BITS)
        if sign is None:
            sign = norm_sign(facts, k, settle_to)
        if sign is None:
            raise Undecided(f"not decided within the work allowed: norm(P^{k}) <= settle_to")
        if sign != -1:
            return k
        budget.spend(1, SCAN_BITS)
        ball = product(ball, step, SCAN_BITS)
    return None


def require_rate(facts: Facts, kappa: Fraction, rho: Fraction) -> None:
    """Return if norm P^k <= kappa rho^k for every k >= 0; P is Schur on 1perp."""
    need_that(kappa >= 1, "1 <= kappa")
    need_that(0 < rho < 1, "0 < rho < 1")
    need(_rate_sign(facts, kappa, rho), (1,), "norm(P^k) <= kappa rho^k for every k >= 0")


def _rate_sign(facts: Facts, kappa: Fraction, rho: Fraction) -> int | None:
    """1 if the bound holds for every k, -1 if it fails for one, None if that was not decided."""
    first = facts.compare_sigma(lambda _: point(rho))
    if first in (0, 1):
        return 1
    if kappa == 1:
        return first
    budget = Budget(facts.design.agents)
    sign = _by_levels(facts, ROUGH_BITS, BASES[0], kappa, rho, budget, precise=False)
    if sign is None and _exceeded(facts, kappa, rho, budget):
        return -1
    attempts = (_by_levels(facts, bits, base, kappa, rho, budget) for bits in BITS for base in BASES[1:])
    return sign if sign is not None else next((found for found in attempts if found is not None), None)


def _exceeded(facts: Facts, kappa: Fraction, rho: Fraction, budget: Budget) -> bool:
    """Whether norm P^n > kappa rho^n is seen at a power of two n, as it is where rho < the spectral radius."""
    bits = BITS[1]
    ball = deviation(facts, bits, 1 / rho)
    while ball.error.bit_length() < bits // 2 and ball.frobenius.bit_length() + ball.exponent > 0:
        if compare_norm_with(ball, kappa, bits) == -1:
            return True
        budget.spend(1, bits)
        ball = product(ball, ball, bits)
    return False


def _by_levels(
    facts: Facts, bits: int, base: int, kappa: Fraction, rho: Fraction, budget: Budget, *, precise: bool = True
) -> int | None:
    """By q_n = norm P^n / rho^n of the n = j base^i, and norm P^k / rho^k <= the product of those of the digits of k.

    Where a q_n <= 1, remainders below n are all that counts. Where the base exceeds that n, nothing is lost.
    """
    unit = ball = measured(deviation(facts, bits, 1 / rho), precise)
    levels = Fraction(1)
    digits = _Digits()
    j = 0
    while True:
        j += 1
        lower, upper = _ends(ball)
        for closer in (False, True):
            if lower <= 1 < upper or levels * upper > kappa:
                upper = norm_upper(ball, closer) * Fraction(2) ** ball.exponent
        if upper <= 1:
            return 1
        if levels * upper > kappa:
            if compare_norm_with(ball, kappa / levels, 2 * bits) != 1:
                return -1 if compare_norm_with(ball, kappa, 2 * bits) == -1 else None
            upper = kappa / levels
        digits.add(lower, upper, ball)
        budget.spend(1, bits)
        ball = product(ball, unit, bits)
        if j % (base - 1) == 0:
            unit, levels, digits = measured(ball, precise), levels * digits.largest(precise), _Digits()
            if levels > kappa:
                return None


def _ends(ball: Ball) -> tuple[Fraction, Fraction]:
    """Bounds of norm M that cost little."""
    size = Fraction(2) ** ball.exponent
    return norm_lower(ball) * size, ball.frobenius * size


class _Digits:
    """The matrices of one level that may have the largest norm; digit 0 is the identity."""

    def __init__(self) -> None:
        self.least = Fraction(1)
        self.rivals: list[tuple[Fraction, Ball]] = []

    def add(self, lower: Fraction, upper: Fraction, ball: Ball) -> None:
        """One more matrix, its norm between the bounds."""
        self.least = max(self.least, lower)
        self.rivals = [rival for rival in [*self.rivals, (upper, ball)] if rival[0] > self.least]

    def largest(self, precise: bool = True) -> Fraction:
        """An upper bound of all the norms, to 2^-30 or to the errors, less closely where not `precise`. Rigorous."""
        # A rival that was dropped is below the lower bound of one that stays.
        uppers = [norm_upper(ball, precise) * Fraction(2) ** ball.exponent for _, ball in self.rivals]
        return max([self.least, *uppers])
