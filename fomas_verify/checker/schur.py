"""Whether the powers of P tend to 0 on 1perp, decided without a witness: what most sizes of section 3 presuppose.

D = P - J. Source: theory, section 3 (boundedness and consensus need less than (15)) and 4.
"""

from fractions import Fraction
from functools import lru_cache
from operator import mul

from fomas_verify.checker.ball import deviation, product
from fomas_verify.checker.facts import BITS, Facts
from fomas_verify.checker.graph import Rows
from fomas_verify.checker.polynomials import Poly, primitive
from fomas_verify.checker.stability import differences_step

MAX_SQUARING_WORK = 2**34
MAX_POLYNOMIAL_WORK = 2**34


@lru_cache(maxsize=4)
def schur_sign(facts: Facts) -> int | None:
    """1 if P is Schur on 1perp, -1 if not, None if that was not decided; under Assumption 1.

    mu < 1/D is enough. Else by norm D^n < 1 or abs trace D^n > N - 1 for n = 2^j, and where mu is rational exactly.
    """
    if facts.compare_mu(1 / facts.graph.degree_max) == -1:
        return 1
    for bits in BITS:
        sign = _by_squaring(facts, bits)
        if sign is not None:
            return sign
        if facts.design.mu is not None:
            return _exactly(facts, facts.design.mu)
    return None


def _by_squaring(facts: Facts, bits: int) -> int | None:
    size = facts.design.agents
    if size**3 * bits**2 > MAX_SQUARING_WORK:
        return None
    ball = deviation(facts, bits)
    # The error about doubles with each product, unless the powers shrink.
    while ball.error.bit_length() < bits:
        # One is 2^-exponent units.
        if ball.frobenius.bit_length() <= -ball.exponent:
            return 1
        trace = abs(sum(column[i] for i, column in enumerate(ball.columns))) - size * ball.error
        if trace > 0 and (trace.bit_length() - 1 + ball.exponent >= size.bit_length()):
            return -1
        ball = product(ball, ball, bits)
    return None


def _exactly(facts: Facts, mu: Fraction) -> int | None:
    rows, f = differences_step(facts.graph, mu)
    size = len(rows)
    if size**5 * (f.bit_length() + max(abs(entry) for row in rows for entry in row).bit_length()) > MAX_POLYNOMIAL_WORK:
        return None
    return 1 if _roots_inside(characteristic(rows, f)) else -1


def characteristic(rows: Rows, f: int) -> Poly:
    """A positive multiple of det(z - F / f), by Faddeev and LeVerrier: c_(n-k) = -trace(F M_k) / k."""
    n = len(rows)
    work = [[int(i == j) for j in range(n)] for i in range(n)]
    coefficients = [1]
    for k in range(1, n + 1):
        columns = list(zip(*work, strict=True))
        work = [[sum(map(mul, row, column)) for column in columns] for row in rows]
        coefficients.append(-sum(row[i] for i, row in enumerate(work)) // k)
        for i, row in enumerate(work):
            row[i] += coefficients[-1]
    # det(y - F) with y = f z.
    return primitive(c * f**i for i, c in enumerate(reversed(coefficients)))


def _roots_inside(a: Poly) -> bool:
    """Whether every root lies in the open unit disc (Schur and Cohn: a_0 is the smaller end at each step)."""
    while len(a) > 1:
        first, last = a[0], a[-1]
        if abs(first) >= abs(last):
            return False
        a = primitive(last * x - first * y for x, y in zip(a[1:], reversed(a[:-1]), strict=True))
    return True
