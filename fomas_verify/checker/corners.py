"""beta and sigma against the thresholds at one alpha of [0, 1] and one rational mu > 0, many times on the same graph.

lambda2 is enclosed once; what that leaves open is for `exact` tests, which cost a factorisation each.
Each function returns the sign of a threshold minus the value, or None where it was not decided.
"""

from fractions import Fraction
from functools import lru_cache

from fomas_verify.checker.definite import least_sign, quick_sign
from fomas_verify.checker.facts import BITS, Facts
from fomas_verify.checker.graph import Graph
from fomas_verify.checker.iteration import iterated, squared
from fomas_verify.checker.powers import Enclosure, first_threshold, outward, point, quotient, second_threshold
from fomas_verify.checker.ruling import Undecided
from fomas_verify.checker.thresholds import beta_below_first, beta_below_second, sigma_below_first

MAX_SIGN_WORK = 2**30
_RELATIVE = 2**60
_SQUARINGS = 10
_SIMPLE = 2**8
_BITS = BITS[0]


@lru_cache(maxsize=4)
def lambda2(graph: Graph) -> Enclosure:
    """lambda2 under Assumption 1: to 2^-60 of it, or to what the work allowed gives. Rigorous.

    On a balanced graph every eigenvalue of L_s is at most 2 D (Gershgorin).
    """
    facts = Facts(graph.design.at(Fraction(1, 2), Fraction(1)), graph)
    steps = MAX_SIGN_WORK // graph.agents**3
    lower, upper = Fraction(0), 2 * graph.degree_max
    if steps > _SQUARINGS:
        upper = _lambda2_above(graph)
        near = upper - upper / (2 * _RELATIVE)
        if quick_sign(facts.gap_form(near), _BITS, (1,)) == 1:
            simple = (upper / graph.degree_max).limit_denominator(_SIMPLE) * graph.degree_max
            return point(simple) if near < simple <= upper and _is_tie(facts, simple) else Enclosure(near, upper)
    for _ in range(steps):
        if upper - lower <= lower / _RELATIVE:
            break
        middle = (lower + upper) / 2 if 2 * lower >= upper else upper / 4 if lower == 0 else 2 * lower
        sign = quick_sign(facts.gap_form(middle), _BITS)
        if sign is None:
            sign = least_sign(facts.gap_form(middle))
        if sign == 0:
            return point(middle)
        lower, upper = (middle, upper) if sign > 0 else (lower, middle)
    return Enclosure(lower, upper)


def _is_tie(facts: Facts, x: Fraction) -> bool:
    """Whether lambda2 = x is seen; where that takes too much work, an enclosure is as good."""
    try:
        return least_sign(facts.gap_form(x)) == 0
    except Undecided:
        return False


def _lambda2_above(graph: Graph) -> Fraction:
    """The Rayleigh quotient of where power iteration leads on 1perp, rounded up: near lambda2 but in rare cases.

    With S = d (L + L^T) and c = 4 d D, N (c I - S) - c 1 1^T is >= 0, and 0 on the vector 1.
    """
    n, rows = graph.agents, graph.laplacian
    c = int(4 * graph.denominator * graph.degree_max)
    gap = [[n * (c * (i == j) - rows[i][j] - rows[j][i]) - c for j in range(n)] for i in range(n)]
    vector = [(37 * i + 11) % 101 - 50 for i in range(n)]
    vector = iterated(squared(gap, _SQUARINGS), vector)
    total = sum(vector)
    centred = [Fraction(n * entry - total) for entry in vector]
    quotient = graph.quotients(centred if any(centred) else [Fraction(1), Fraction(-1), *[Fraction(0)] * (n - 2)])[0]
    return outward(quotient, quotient, _BITS).upper


def first_sign(graph: Graph, alpha: Fraction, mu: Fraction, exact: bool = True) -> int | None:
    """The sign of (2^alpha - 1) - beta: of lambda2 - (2 - 2^alpha) / mu."""
    box = first_threshold(alpha, _BITS)
    gap = quotient(Enclosure(1 - box.upper, 1 - box.lower), point(mu))
    sign = _compare(lambda2(graph), gap)
    if sign is not None or not exact:
        return sign
    facts = _corner(graph, alpha, mu)
    return beta_below_first(facts) if 0 < alpha < 1 else facts.compare_lambda2_with(gap.lower)


def second_sign(graph: Graph, alpha: Fraction, mu: Fraction, exact: bool = True) -> int | None:
    """The sign of -sqrt(3^alpha - 2^alpha) - beta: of lambda2 - (1 + sqrt(3^alpha - 2^alpha)) / mu."""
    box = second_threshold(alpha, _BITS)
    gap = quotient(Enclosure(1 + box.lower, 1 + box.upper), point(mu))
    sign = _compare(lambda2(graph), gap)
    if sign is not None or not exact:
        return sign
    facts = _corner(graph, alpha, mu)
    return beta_below_second(facts) if 0 < alpha < 1 else facts.compare_lambda2_with(gap.lower)


def sigma_is_below(graph: Graph, alpha: Fraction, mu: Fraction) -> bool:
    """Whether sigma < 2^alpha - 1 is seen."""
    facts = _corner(graph, alpha, mu)
    return quick_sign(facts.sigma_form(first_threshold(alpha, _BITS).lower ** 2, mu), _BITS, (1,)) == 1


def sigma_sign(graph: Graph, alpha: Fraction, mu: Fraction, exact: bool = True) -> int | None:
    """The sign of (2^alpha - 1) - sigma."""
    facts = _corner(graph, alpha, mu)
    box = first_threshold(alpha, _BITS)
    if quick_sign(facts.sigma_form(box.lower**2, mu), _BITS, (1,)) == 1:
        return 1
    if quick_sign(facts.sigma_form(box.upper**2, mu), _BITS) == -1:
        return -1
    if not exact:
        return None
    return sigma_below_first(facts) if 0 < alpha < 1 else least_sign(facts.sigma_form(box.lower**2, mu))


def _corner(graph: Graph, alpha: Fraction, mu: Fraction) -> Facts:
    return Facts(graph.design.at(alpha, mu), graph)


def _compare(x: Enclosure, y: Enclosure) -> int | None:
    """The sign of x - y, where their enclosures show it."""
    return 1 if x.lower > y.upper else -1 if x.upper < y.lower else None
