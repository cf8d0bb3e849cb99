"""The conditions of a region: on which mu > 0 each holds, that none satisfies it, and which alpha open it.

Source: docs/certificate-format.md, section 8; theory, section 5.
"""

from collections.abc import Callable
from fractions import Fraction
from operator import mul

from fomas_verify.checker.corners import first_sign, lambda2, second_sign, sigma_sign
from fomas_verify.checker.facts import Facts, compare
from fomas_verify.checker.graph import Graph, common_denominator
from fomas_verify.checker.margins import require_stable
from fomas_verify.checker.packed import largest
from fomas_verify.checker.powers import Enclosure, first_threshold, point, quotient
from fomas_verify.checker.region_form import Condition, Opening, Pairs
from fomas_verify.checker.ruling import Undecided, need, need_that
from fomas_verify.checker.statements import CONDITIONS
from fomas_verify.checker.value_form import GainMargin

MAX_PAIRS_WORK = 2**42


def require_condition(facts: Facts, condition: Condition) -> str:
    """Return the reason why what is said of a condition is accepted; raise `Refused` or `Undecided` if it is not."""
    need_that(condition.statement == CONDITIONS[condition.id], "the statement is the one of this id, to the letter")
    if condition.id != "gain-bound" and not facts.graph.satisfies_assumption:
        need_that(condition.verdict == "refuted", "some mu satisfies the condition (Assumption 1 fails)")
        need_that(not condition.pairs and condition.opening is None, "the witness is empty, as Assumption 1 fails")
        return "Assumption 1 fails"
    if condition.strip is None:
        _EMPTY[condition.id](facts, condition)
        reason = "true of no mu"
    else:
        _require_strip(facts, condition.id, condition.strip)
        reason = "true for every mu of inner, false for every mu outside outer"
    if condition.opening is not None:
        _require_opening(facts.graph, condition.id, condition.opening)
        reason += "; opens with alpha as said"
    return reason


def _require_strip(facts: Facts, name: str, strip: GainMargin) -> None:
    (a, b), (c, d) = strip.inner, strip.outer
    need_that(0 <= c <= a <= b <= d and a > 0, "0 <= outer[0] <= inner[0] <= inner[1] <= outer[1], 0 < inner[0]")
    if name == "consensus":
        require_stable(facts, strip)
        return
    degree = facts.graph.degree_max
    need_that(b * degree < 1, "inner[1] < 1/Delta_max")
    _STRIPS[name](facts, strip)


def _require_gain_bound(facts: Facts, strip: GainMargin) -> None:
    need_that(strip.outer[0] == 0, "outer[0] = 0")
    need_that(_beyond(facts, strip), "1/Delta_max <= outer[1]")


def _beyond(facts: Facts, strip: GainMargin) -> bool:
    return strip.outer[1] * facts.graph.degree_max >= 1


def _require_as_stated(facts: Facts, strip: GainMargin) -> None:
    graph, alpha = facts.graph, facts.design.alpha
    (a, b), (c, d) = strip.inner, strip.outer
    need(first_sign(graph, alpha, a), (0, 1), "beta <= 2^alpha - 1 at mu = inner[0]")
    need(second_sign(graph, alpha, b), (-1, 0), "beta >= -sqrt(3^alpha - 2^alpha) at mu = inner[1]")
    if c > 0:
        need(first_sign(graph, alpha, c), (-1, 0), "beta >= 2^alpha - 1 at mu = outer[0]")
    if not _beyond(facts, strip):
        need(second_sign(graph, alpha, d), (0, 1), "beta <= -sqrt(3^alpha - 2^alpha) at mu = outer[1]")


def _require_closed_form(facts: Facts, strip: GainMargin) -> None:
    _require_convex(facts, strip, _closed_form_sign, "1 - 2 mu lambda2 (1 - mu Delta_max) - (2^alpha - 1)^2")


def _require_repaired(facts: Facts, strip: GainMargin) -> None:
    _require_convex(facts, strip, sigma_sign, "sigma - (2^alpha - 1)")


def _require_convex(
    facts: Facts, strip: GainMargin, sign: Callable[[Graph, Fraction, Fraction], int | None], excess: str
) -> None:
    """Return if `excess`, convex in mu, is <= 0 on inner and > 0 below 1/D outside outer."""
    for i, mu in enumerate(strip.inner):
        need(sign(facts.graph, facts.design.alpha, mu), (0, 1), f"{excess} <= 0 at mu = inner[{i}]")
    for i, mu in enumerate(strip.outer):
        if 0 < mu * facts.graph.degree_max < 1:
            need(sign(facts.graph, facts.design.alpha, mu), (-1,), f"{excess} > 0 at mu = outer[{i}]")


def _closed_form_sign(graph: Graph, alpha: Fraction, mu: Fraction) -> int | None:
    """The sign of lambda2 - s(mu), 0 < mu < 1/D: of (2^alpha - 1)^2 - (1 - 2 mu lambda2 (1 - mu D))."""
    below = point(2 * mu * (1 - mu * graph.degree_max))

    def least(bits: int) -> Enclosure:
        t = first_threshold(alpha, bits)
        return quotient(Enclosure(1 - t.upper**2, 1 - t.lower**2), below)

    gap, known = least(256), lambda2(graph)
    if known.lower > gap.upper or known.upper < gap.lower:
        return 1 if known.lower > gap.upper else -1
    return Facts(graph.design.at(alpha, mu), graph).compare_lambda2(least)


def _never(_: Facts, condition: Condition) -> None:
    need_that(False, f"no mu satisfies the condition {condition.id}")


def _require_as_stated_empty(facts: Facts, _: Condition) -> None:
    sign = first_sign(facts.graph, facts.design.alpha, 1 / facts.graph.degree_max)
    need(sign, (-1, 0), "beta >= 2^alpha - 1 at mu = 1/Delta_max")


def _require_closed_form_empty(facts: Facts, _: Condition) -> None:
    sign = _closed_form_sign(facts.graph, facts.design.alpha, 1 / (2 * facts.graph.degree_max))
    need(sign, (-1,), "1 - lambda2 / (2 Delta_max) > (2^alpha - 1)^2")


def _require_repaired_empty(facts: Facts, condition: Condition) -> None:
    sign = _pairs_sign(facts.graph, facts.design.alpha, condition.pairs)
    need(sign, (-1,), "the pairs show that sigma > 2^alpha - 1 on [0, 1/Delta_max]")


def _pairs_sign(graph: Graph, alpha: Fraction, pairs: Pairs) -> int | None:
    """The sign of (2^alpha - 1) minus the lower bound of sigma that the pairs give on [0, 1/Delta_max]."""
    a, b, n = pairs_line(graph, pairs)
    return compare(lambda bits: first_threshold(alpha, bits), min(a, a - b / graph.degree_max) / n)


def pairs_line(graph: Graph, pairs: Pairs, shares: int = 1) -> tuple[Fraction, Fraction, Fraction]:
    """(a, b, n), n > 0, with sigma(mu) >= (a - mu b)/n for every mu; raises `Refused` where the pairs give none.

    The work allowed is one of `shares` parts.
    """
    need_that(len(pairs) > 0, "there are pairs of vectors")
    need_that(all(sum(x) == 0 for pair in pairs for x in pair), "every vector of the pairs sums to 0")
    common = common_denominator([entry for pair in pairs for x in pair for entry in x], graph.agents)
    whole = [[[int(entry * common) for entry in x] for x in pair] for pair in pairs]
    if shares * _pairs_work(graph, whole) > MAX_PAIRS_WORK:
        raise Undecided("as many pairs of vectors are beyond the work allowed")
    a = b = n = 0
    for u, v in whole:
        a += sum(map(mul, u, v))
        b += sum(map(mul, u, (sum(map(mul, row, v)) for row in graph.laplacian)))
        n += sum(map(mul, u, u)) + sum(map(mul, v, v))
    need_that(n > 0, "not all vectors of the pairs are 0")
    return Fraction(2 * a), Fraction(2 * b, graph.denominator), Fraction(n)


def _pairs_work(graph: Graph, whole: list[list[list[int]]]) -> int:
    """What the images of so many vectors take: entries times bits of both factors, no factor below a machine word's."""
    bits = max(largest(pair) for pair in whole).bit_length()
    return len(whole) * graph.agents**2 * (bits + 64) * (largest(graph.laplacian).bit_length() + 64)


def _require_opening(graph: Graph, name: str, opening: Opening) -> None:
    need_that(opening.lower <= opening.upper, "alpha_opens.lower <= alpha_opens.upper")
    top = 1 / graph.degree_max

    def sign(alpha: Fraction) -> int | None:
        return first_sign(graph, alpha, top) if name == "as-stated" else _closed_form_sign(graph, alpha, top / 2)

    if opening.lower > 0:
        shut = _pairs_sign(graph, opening.lower, opening.pairs) if name == "repaired" else sign(opening.lower)
        need(shut, (-1, 0), "no mu will do for any alpha below alpha_opens.lower")
    if opening.upper < 1:
        if opening.mu is not None:
            need_that(0 < opening.mu <= top, "0 < alpha_opens.mu <= 1/Delta_max")
        reached = sign(opening.upper) if opening.mu is None else sigma_sign(graph, opening.upper, opening.mu)
        need(reached, (0, 1), "some mu will do for every alpha above alpha_opens.upper")


_STRIPS: dict[str, Callable[[Facts, GainMargin], None]] = {
    "as-stated": _require_as_stated,
    "repaired-closed-form": _require_closed_form,
    "repaired": _require_repaired,
    "gain-bound": _require_gain_bound,
}

_EMPTY: dict[str, Callable[[Facts, Condition], None]] = {
    "as-stated": _require_as_stated_empty,
    "repaired-closed-form": _require_closed_form_empty,
    "repaired": _require_repaired_empty,
    "gain-bound": _never,
    "consensus": _never,
}
