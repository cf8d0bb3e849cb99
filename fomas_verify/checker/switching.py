"""Graphs to switch among: one quadratic form for all of them, or the proof that there is none.

Source: docs/certificate-format.md, section 10; docs/theory.md, section 11.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import lcm
from operator import mul
from typing import cast

from fomas_verify.checker.claims import require_shown
from fomas_verify.checker.definite import least_sign
from fomas_verify.checker.facts import Facts
from fomas_verify.checker.graph import Graph, Rows, common_denominator, limit_size
from fomas_verify.checker.ruling import Undecided, need, need_that
from fomas_verify.checker.stability import MAX_PRODUCT_WORK, differences_step, power_trace_beyond, require_decrease
from fomas_verify.checker.statements import SWITCHED_CONDITIONS, SWITCHED_STATEMENTS
from fomas_verify.checker.switching_form import (
    Dual,
    OfGraph,
    SwitchedClaim,
    SwitchedCondition,
    SwitchedDesign,
    SwitchedRate,
    Word,
)
from fomas_verify.checker.value_form import Bounds, Value
from fomas_verify.checker.witness import Lyapunov

_ANY_GRAPH = ("graph-assumption", "gain-bound")


@dataclass(frozen=True)
class Switched:
    """A design with a set of digraphs, and the facts about it."""

    design: SwitchedDesign

    @cached_property
    def graphs(self) -> tuple[Graph, ...]:
        """The digraphs, in order."""
        return tuple(Graph(setting) for setting in self.design.graphs)

    @cached_property
    def degree_max(self) -> Fraction:
        """D, the largest degree of all."""
        return max(graph.degree_max for graph in self.graphs)

    @cached_property
    def satisfies_assumption(self) -> bool:
        """Assumption 1 for every digraph."""
        return all(graph.satisfies_assumption for graph in self.graphs)

    def facts(self, end: int, graph: int = 1) -> Facts:
        """With the least (0) or greatest (1) mu, and one of the digraphs."""
        return Facts(self.design.end(end), self.graphs[graph - 1])


def require_switched_claim(switched: Switched, claim: SwitchedClaim) -> str:
    """Return the reason why a claim is accepted; raise `Refused` or `Undecided` if it is not."""
    need_that(claim.statement == SWITCHED_STATEMENTS[claim.id], "the statement is the one of this claim, to the letter")
    applicable = claim.id in _ANY_GRAPH or switched.satisfies_assumption
    if claim.verdict == "inapplicable":
        need_that(not applicable, "Assumption 1 fails, and the claim presupposes it")
        return "Assumption 1 fails"
    need_that(applicable, "the claim is applicable (Assumption 1 fails)")
    witness = claim.witness
    if isinstance(witness, Dual):
        need(switched.facts(1).compare_mu(witness.mu), (0, 1), "witness.mu <= mu")
        _require_no_form(switched, witness)
        return "asserts nothing of the claim; no form decreases under every digraph, as the witness shows"
    if claim.verdict == "undecided":
        return "asserts nothing"
    if isinstance(witness, OfGraph):
        require_shown(switched.facts(1, witness.graph), claim.id, "refuted", witness.witness)
        return f"true, and the witness shows it of digraph {witness.graph}"
    if isinstance(witness, Word):
        _require_growth(switched, witness)
        return f"true, and the witness shows it of the digraphs {list(witness.graphs)} in turn"
    if isinstance(witness, Lyapunov):
        need(switched.facts(1).compare_mu(witness.mu), (-1, 0), "mu <= witness.mu")
        _require_form(switched, witness)
        return "true, and the witness shows it"
    _SIMPLE[claim.id, claim.verdict](switched)
    return "true"


def _require_assumption(switched: Switched) -> None:
    need_that(switched.satisfies_assumption, "every digraph is strongly connected and balanced")


def _require_gain_below(switched: Switched) -> None:
    need(_compare_gain(switched), (-1,), "mu < 1/Delta_max")


def _require_gain_not_below(switched: Switched) -> None:
    need(_compare_gain(switched), (0, 1), "mu >= 1/Delta_max")


_SIMPLE: dict[tuple[str, str], Callable[[Switched], None]] = {
    ("graph-assumption", "proved"): _require_assumption,
    ("gain-bound", "proved"): _require_gain_below,
    ("gain-bound", "refuted"): _require_gain_not_below,
}


def _compare_gain(switched: Switched) -> int | None:
    """The sign of the greatest mu minus 1/D, where 1/0 is infinity."""
    degree = switched.degree_max
    return -1 if degree == 0 else switched.facts(1).compare_mu(1 / degree)


def _require_form(switched: Switched, proof: Lyapunov) -> None:
    """Return if Q > 0 and Q - Pc_i(t)^T Q Pc_i(t) > 0 for every i."""
    steps = [differences_step(graph, proof.mu) for graph in switched.graphs]
    _limit_products(steps, _whole_rows(proof.rows)[0])
    for graph in switched.graphs:
        require_decrease(graph, proof.mu, proof.rows)


def _require_growth(switched: Switched, word: Word) -> None:
    """Return if mu is a number of the design and abs trace of a power of Pc_(i_k)(mu) ... Pc_(i_1)(mu) > N - 1."""
    least, greatest = switched.design.end(0).mu, switched.design.end(1).mu
    inside = least is not None and greatest is not None and least <= word.mu <= greatest
    need_that(inside, "witness.mu is the mu of the design, given as a number, or one of its interval")
    size = switched.design.agents - 1
    product, denominator = [[int(i == j) for j in range(size)] for i in range(size)], 1
    left = MAX_PRODUCT_WORK
    for letter in word.graphs:
        step, f = differences_step(switched.graphs[letter - 1], word.mu)
        left -= size**3 * _bits(product) * _bits(step)
        if left < 0:
            raise Undecided(f"a product of {len(word.graphs)} matrices of {size} rows is beyond the work allowed")
        limit_size(_bits(product) + _bits(step) + size.bit_length(), size)
        columns = list(zip(*product, strict=True))
        product = [[sum(map(mul, row, column)) for column in columns] for row in step]
        denominator *= f
    sign = power_trace_beyond(product, denominator, word.power)
    need(sign, (1,), "abs trace((Pc_(i_k)(mu) ... Pc_(i_1)(mu))^power) > N - 1")


def _require_no_form(switched: Switched, dual: Dual) -> None:
    """Return if Z_i >= 0, not all 0, and sum_i (Pc_i(t) Z_i Pc_i(t)^T - Z_i) >= 0."""
    need_that(dual.mu > 0, "0 < witness.mu")
    size = len(dual.matrices[0])
    flat, _ = _whole_rows([row for rows in dual.matrices for row in rows], size)
    matrices = [flat[i : i + size] for i in range(0, len(flat), size)]
    need_that(any(entry != 0 for row in flat for entry in row), "not all Z are 0")
    steps = [differences_step(graph, dual.mu) for graph in switched.graphs]
    _limit_products(steps, flat)
    scale = lcm(*(f for _, f in steps))
    limit_size(scale.bit_length(), size)
    total = [[0] * (i + 1) for i in range(size)]
    for i, ((step, f), rows) in enumerate(zip(steps, matrices, strict=True), 1):
        need(least_sign(rows), (0, 1), f"Z_{i} >= 0")
        change = _congruence_change(step, f, rows)
        factor = (scale // f) ** 2
        total = [[x + factor * y for x, y in zip(*lines, strict=True)] for lines in zip(total, change, strict=True)]
    need(least_sign(total), (0, 1), "sum_i (Pc_i(t) Z_i Pc_i(t)^T - Z_i) >= 0")


def _congruence_change(step: Rows, f: int, lower: Rows) -> Rows:
    """The lower triangle of F X F^T - f^2 X for the symmetric X with this lower triangle."""
    n = len(lower)
    full = [[lower[max(i, j)][min(i, j)] for j in range(n)] for i in range(n)]
    # Column j of X F^T is the image under X of row j of F.
    images = [[sum(map(mul, row, line)) for row in full] for line in step]
    return [
        [sum(map(mul, step[i], images[j])) - f * f * entry for j, entry in enumerate(row)]
        for i, row in enumerate(lower)
    ]


def _limit_products(steps: Sequence[tuple[Rows, int]], lower: Rows) -> None:
    """Raise `Undecided` if F X F^T for every step F, X with entries as large as these, is beyond the work allowed."""
    n = len(steps[0][0])
    bits = max(max(_bits(step), f.bit_length()) for step, f in steps) + n.bit_length() + max(_bits(lower), 1)
    if len(steps) * n**3 * bits**2 > MAX_PRODUCT_WORK:
        raise Undecided(
            f"{len(steps)} products of matrices of {n} rows with entries of {bits} bits are beyond the work allowed"
        )


def _whole_rows(rows: Sequence[Sequence[Fraction]], size: int = 0) -> tuple[Rows, int]:
    """(X, q), X of integers, with these rows X / q; `size` where they are those of several matrices."""
    common = common_denominator([entry for row in rows for entry in row], size or len(rows))
    return [[int(entry * common) for entry in row] for row in rows], common


def _bits(rows: Sequence[Sequence[int]]) -> int:
    return max(abs(entry) for row in rows for entry in row).bit_length()


def require_switched_value(switched: Switched, value: Value) -> str:
    """Return the reason why a value is accepted; raise `Refused` or `Undecided` if it is not."""
    if isinstance(value, SwitchedRate):
        _require_rate(switched, value)
        return "holds for every switching"
    bounds = cast(Bounds, value)
    if bounds.name == "mu":
        need(switched.facts(0).compare_mu(bounds.lower), (0, 1), "lower <= mu")
        need(switched.facts(1).compare_mu(bounds.upper), (-1, 0), "mu <= upper")
    else:
        need_that(bounds.lower <= switched.degree_max <= bounds.upper, "lower <= Delta_max <= upper")
    return "lower <= value <= upper"


def _require_rate(switched: Switched, rate: SwitchedRate) -> None:
    need_that(switched.satisfies_assumption, "the value exists (Assumption 1 fails)")
    need_that(rate.kappa >= 1 and 0 < rate.rho < 1, "kappa >= 1 and 0 < rho < 1")
    (a, b), rows = rate.ends, rate.rows
    need(switched.facts(0).compare_mu(a), (0, 1), "mu[0] <= mu")
    need(switched.facts(1).compare_mu(b), (-1, 0), "mu <= mu[1]")
    form, common = _whole_rows(rows)
    n = switched.design.agents
    norm = [[common * (n * (i == j) - 1) for j in range(i + 1)] for i in range(n - 1)]
    need(least_sign(_weighted(form, norm, 1, -1)), (0, 1), "Q - W >= 0")
    top, below = rate.kappa.numerator**2, rate.kappa.denominator**2
    need(least_sign(_weighted(norm, form, top, -below)), (0, 1), "kappa^2 W - Q >= 0")
    ends = [(i, t) for i in range(len(switched.graphs)) for t in dict.fromkeys((a, b))]
    steps = [differences_step(switched.graphs[i], t) for i, t in ends]
    _limit_products(steps, form)
    for (i, _), (step, f) in zip(ends, steps, strict=True):
        sign = _decay_sign(step, f, rate.rho, form)
        need(sign, (0, 1), f"rho^2 Q - Pc_{i + 1}(t)^T Q Pc_{i + 1}(t) >= 0")


def _decay_sign(step: Rows, f: int, rho: Fraction, form: Rows) -> int:
    """The sign of the least eigenvalue of rho^2 Q - Pc^T Q Pc, Pc = F / f."""
    change = _congruence_change([list(column) for column in zip(*step, strict=True)], f, form)
    # f^2 (P^T Q P - Q) <= (rho^2 - 1) f^2 Q.
    p, q = rho.numerator**2, rho.denominator**2
    return least_sign(_weighted(form, change, (p - q) * f * f, -q))


def _weighted(one: Rows, other: Rows, a: int, b: int) -> Rows:
    return [[a * x + b * y for x, y in zip(*lines, strict=True)] for lines in zip(one, other, strict=True)]


def require_switched_condition(switched: Switched, condition: SwitchedCondition) -> str:
    """Return the reason why a condition on mu is accepted; raise `Refused` or `Undecided` if it is not."""
    name = condition.id
    need_that(condition.statement == SWITCHED_CONDITIONS[name], "the statement is the one of this id, to the letter")
    if condition.inner is None or condition.outer is None:
        fails = name == "common-form" and not switched.satisfies_assumption
        need_that(fails, f"no mu satisfies the condition {name}")
        return "Assumption 1 fails"
    (a, b), (c, d) = condition.inner, condition.outer
    need_that(c == 0 and 0 < a <= b <= d, "0 = outer[0] < inner[0] <= inner[1] <= outer[1]")
    if name == "gain-bound":
        need_that(b * switched.degree_max < 1, "inner[1] < 1/Delta_max")
        need_that(d * switched.degree_max >= 1, "1/Delta_max <= outer[1]")
        return "true for every mu of inner, false for every mu outside outer"
    need_that(switched.satisfies_assumption, "some mu satisfies the condition (Assumption 1 fails)")
    _require_form(switched, cast(Lyapunov, condition.proof))
    if isinstance(condition.end, Dual):
        _require_no_form(switched, condition.end)
    else:
        end = cast(OfGraph, condition.end)
        graph = switched.graphs[end.graph - 1]
        facts = Facts(graph.design.at(switched.design.alpha, d), graph)
        require_shown(facts, "perron-eigenvalues", "refuted", end.witness)
    return "true for every mu of inner, false for every mu outside outer"
