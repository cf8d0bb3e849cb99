"""How far mu and alpha may move before a claim changes its truth.

Source: docs/certificate-format.md, section 3, `margins`; theory, sections 2 to 5: each of the first four claims is true
on an interval of mu.
"""

from collections.abc import Callable
from dataclasses import replace
from typing import cast

from fomas_verify.checker.box import Box, require_over
from fomas_verify.checker.corners import first_sign, second_sign, sigma_sign
from fomas_verify.checker.facts import BITS, Facts
from fomas_verify.checker.gain import gain_of
from fomas_verify.checker.parts import MAX_PARTS, Curve, Shown, throughout
from fomas_verify.checker.ruling import Undecided, need, need_that
from fomas_verify.checker.stability import require_decrease, require_persistence, trace_beyond
from fomas_verify.checker.statements import ANY_GRAPH
from fomas_verify.checker.thresholds import beta_below_first, beta_below_second, sigma_below_first
from fomas_verify.checker.value_form import GainMargin, NormMargin, OrderMargin
from fomas_verify.checker.witness import Lyapunov, Persistence, Power


def require_gain_margin(facts: Facts, margin: GainMargin) -> str:
    """Return the reason why a margin in mu is accepted; raise `Refused` or `Undecided` if it is not."""
    _require_applicable(facts, margin.claim)
    (a, b), (c, d) = margin.inner, margin.outer
    need_that(0 <= c <= a < b <= d, "0 <= outer[0] <= inner[0] < inner[1] <= outer[1]")
    _GAIN_TESTS[margin.claim](facts, margin)
    return "true for every mu inside inner, false for every mu outside outer"


def _require_applicable(facts: Facts, claim: str) -> None:
    applicable = claim in ANY_GRAPH or facts.graph.satisfies_assumption
    need_that(applicable, f"the margin of {claim} exists (Assumption 1 fails)")


def _require_gain_bound(facts: Facts, margin: GainMargin) -> None:
    degree = facts.graph.degree_max
    need_that(margin.outer[0] == 0, "outer[0] = 0")
    need_that(margin.inner[1] * degree <= 1, "inner[1] <= 1/Delta_max")
    need_that(margin.outer[1] * degree >= 1, "1/Delta_max <= outer[1]")


def _require_memory(facts: Facts, margin: GainMargin) -> None:
    alpha, graph = facts.design.alpha, facts.graph
    (a, b), (c, d) = margin.inner, margin.outer
    # At mu = 0, beta = 1 > 2^alpha - 1.
    need_that(a > 0, "beta <= 2^alpha - 1 at mu = inner[0]")
    need(first_sign(graph, alpha, a), (0, 1), "beta <= 2^alpha - 1 at mu = inner[0]")
    need(second_sign(graph, alpha, b), (-1, 0), "beta >= -sqrt(3^alpha - 2^alpha) at mu = inner[1]")
    if c > 0:
        need(first_sign(graph, alpha, c), (-1, 0), "beta >= 2^alpha - 1 at mu = outer[0]")
    need(second_sign(graph, alpha, d), (0, 1), "beta <= -sqrt(3^alpha - 2^alpha) at mu = outer[1]")


def require_stable(facts: Facts, margin: GainMargin) -> None:
    """Return if the witnesses at the upper ends of a margin in mu show it for `perron-eigenvalues`."""
    need_that(margin.outer[0] == 0, "outer[0] = 0")
    proof = cast(Lyapunov, margin.proof)
    require_decrease(facts.graph, proof.mu, proof.rows)
    refutation = margin.refutation
    if isinstance(refutation, Persistence):
        require_persistence(facts.graph, refutation.mu, refutation.rows)
    else:
        power = cast(Power, refutation)
        sign = trace_beyond(facts.graph, power.mu, power.power)
        need(sign, (1,), "abs trace(Pc(outer[1])^power) > N - 1")


def _require_contraction(facts: Facts, margin: GainMargin) -> None:
    alpha, graph = facts.design.alpha, facts.graph
    # At mu = 0, sigma = 1 > 2^alpha - 1.
    need_that(margin.inner[0] > 0, "sigma <= 2^alpha - 1 at mu = inner[0]")
    for i, mu in enumerate(margin.inner):
        need(sigma_sign(graph, alpha, mu), (0, 1), f"sigma <= 2^alpha - 1 at mu = inner[{i}]")
    for i, mu in enumerate(margin.outer):
        if mu > 0:
            need(sigma_sign(graph, alpha, mu), (-1,), f"sigma > 2^alpha - 1 at mu = outer[{i}]")


_GAIN_TESTS: dict[str, Callable[[Facts, GainMargin], None]] = {
    "gain-bound": _require_gain_bound,
    "memory-inequality": _require_memory,
    "perron-eigenvalues": require_stable,
    "repaired-condition": _require_contraction,
}


def require_order_margin(facts: Facts, margin: OrderMargin) -> str:
    """Return the reason why a margin in alpha is accepted; raise `Refused` or `Undecided` if it is not."""
    _require_applicable(facts, margin.claim)
    (a, b), (c, d) = margin.inner, margin.outer
    need_that(a <= facts.design.alpha <= b, "inner[0] <= alpha <= inner[1]")
    need_that((c is None or c < a) and (d is None or b < d), "outer[0] < inner[0] and inner[1] < outer[1]")
    if margin.gain is not None:
        require_gain_margin(facts, margin.gain)
    truth = _truth(facts, margin)
    said, other = ("true", "false") if truth else ("false", "true")
    if a < b:
        facts.limit_scale()
        curve = Curve(facts.graph, gain_of(facts.design))
        true, false = _seen(curve, margin)
        most = curve.most if margin.claim == "repaired-condition" else MAX_PARTS
        sign = throughout(a, b, true if truth else false, false if truth else true, most)
        need(sign, (1,), f"the claim is {said} for every alpha of inner")
    for i, end in enumerate(margin.outer):
        if end is not None:
            there = Facts(replace(facts.design, alpha=end), facts.graph)
            need_that(_truth(there, margin) != truth, f"the claim is {other} at alpha = outer[{i}]")
    return f"{said} for every alpha of inner, {other} at the ends of outer"


def _seen(curve: Curve, margin: OrderMargin) -> tuple[Shown, Shown]:
    """What is asked of a part for the claim to be true, and to be false."""
    if margin.claim == "memory-inequality":
        return curve.remembers, curve.forgets
    if margin.claim == "repaired-condition":
        return curve.contracts, curve.expands
    if margin.gain is not None:
        most, least = margin.gain.inner[1], margin.gain.outer[1]
        return (lambda p, q: curve.over(p, q).upper <= most), (lambda p, q: curve.over(p, q).lower >= least)
    degree = curve.graph.degree_max
    return (lambda p, q: curve.over(p, q).upper * degree < 1), (lambda p, q: curve.over(p, q).lower * degree >= 1)


def _truth(facts: Facts, margin: OrderMargin) -> bool:
    """Whether the claim is true of a design; raises `Undecided`."""
    if margin.claim == "memory-inequality":
        return _all((beta_below_first(facts), (0, 1)), (beta_below_second(facts), (-1, 0)))
    if margin.claim == "repaired-condition":
        return _all((sigma_below_first(facts), (0, 1)))
    if margin.gain is None:
        degree = facts.graph.degree_max
        return degree == 0 or _all((facts.compare_mu(1 / degree), (-1,)))
    if _all((facts.compare_mu(margin.gain.inner[1]), (-1, 0))):
        return True
    need(facts.compare_mu(margin.gain.outer[1]), (0, 1), "mu lies inside inner or outside outer of the margin in mu")
    return False


def _all(*signs: tuple[int | None, tuple[int, ...]]) -> bool:
    """Whether every sign is one of those allowed; raises `Undecided` where that is not known."""
    if any(sign is not None and sign not in allowed for sign, allowed in signs):
        return False
    if any(sign is None for sign, _ in signs):
        raise Undecided("not decided within the work allowed: the truth of the claim")
    return True


def require_norm_margin(facts: Facts, margin: NormMargin) -> str:
    """Return the reason why a margin of control-norm-bound is accepted; raise `Refused` or `Undecided` if it is not."""
    _require_applicable(facts, "control-norm-bound")
    (a, b), alpha = margin.inner, facts.design.alpha
    if margin.of_mu:
        need(facts.compare_mu(a), (0, 1), "inner[0] <= mu")
        need(facts.compare_mu(b), (-1, 0), "mu <= inner[1]")
        box = Box(facts.graph, (alpha, alpha), (a, b))
    else:
        need_that(a <= alpha <= b, "inner[0] <= alpha <= inner[1]")
        gain = gain_of(facts.design).over_slab(a, b, BITS[0])
        box = Box(facts.graph, (a, b), (gain.lower, gain.upper))
    facts.limit_scale()
    require_over(box, "control-norm-bound", margin.verdict, margin.witness)
    return f"{margin.verdict} for every {'mu' if margin.of_mu else 'alpha'} of inner, as the witness shows"
