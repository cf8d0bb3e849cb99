"""Certificates about large networks: each value, bound and claim decided from what is known of the design.

Source: docs/certificate-format.md, section 11; why each claim follows: docs/theory.md, section 14.
"""

from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import Protocol, cast

from fomas_verify.checker.claims import require_shown
from fomas_verify.checker.edge_list import Opener, read_edge_list
from fomas_verify.checker.families import Family
from fomas_verify.checker.large_bounds import Known, LargeGraph, square_of
from fomas_verify.checker.large_form import LargeClaim, LargeDesign
from fomas_verify.checker.network import Network, Quotients
from fomas_verify.checker.powers import Enclosure, point
from fomas_verify.checker.ruling import Refused, Undecided, need, need_that
from fomas_verify.checker.statements import ANY_GRAPH, STATEMENTS
from fomas_verify.checker.value_form import Bounds
from fomas_verify.checker.witness import GraphDefect, Nothing

PRECISIONS = (128, 256, 512, 1024)
_UNDER_ASSUMPTION = frozenset({"lambda2", "beta", "sigma"})


class Numeric(Protocol):
    """What redoes the bounds that take a factor, outside this room: True shown, False shown to be false, else None."""

    def lambda2_at_least(self, network: Network, bound: Fraction) -> bool | None:
        """Of lambda2 >= bound."""

    def lambda_max_at_most(self, network: Network, bound: Fraction) -> bool | None:
        """Of lambda_max <= bound."""

    def sigma_at_most(self, network: Network, mu: tuple[Fraction, Fraction], bound: Fraction) -> bool | None:
        """Of sigma <= bound for every mu between these."""


def read_graph(design: LargeDesign, opener: Opener | None) -> LargeGraph:
    """The graph of a design; raises `Malformed` where the edge list is not the one it names."""
    graph = design.graph
    if isinstance(graph, Family):
        return LargeGraph(graph, None)
    path = "$.design.graph.file"
    return LargeGraph(None, read_edge_list(opener, graph.name, graph.sha256, graph.edges, design.agents, path))


def require_vector(vector: tuple[int, ...]) -> str:
    """Return if a vector sums to 0 and is not 0."""
    need_that(sum(vector) == 0, "the vector sums to 0")
    need_that(any(vector), "the vector is not 0")
    return "sums to 0 and is not 0"


def quotients_of(graph: LargeGraph, vectors: Sequence[tuple[int, ...]]) -> tuple[Quotients, ...]:
    """The quotients of vectors that sum to 0 and are not 0; none where the graph has too many edges to be built."""
    try:
        return tuple(graph.network.quotients([vector]) for vector in vectors)
    except Undecided:
        return ()


def require_by_factor(known: Known, numeric: Numeric | None, said: tuple[str, Fraction]) -> str:
    """Return if a bound that takes a factor is true; `known` holds what was seen without one."""
    key, bound = said
    name, relation = key.rsplit("_", 1)
    statement = f"{name} is at {'least' if relation == 'lower' else 'most'} the bound"
    need_that(known.graph.satisfies_assumption, f"{name} exists (Assumption 1 fails)")
    truth = decided(lambda bits: _bound_holds(known, key, bound, bits))
    if truth is None and numeric is None:
        raise Undecided(f"that {statement} takes a sparse factor: `verify-design check --numeric` computes one")
    _rule(_redone(known, key, bound, cast(Numeric, numeric)) if truth is None else truth, statement)
    return statement


def _bound_holds(known: Known, key: str, bound: Fraction, bits: int) -> bool | None:
    if key == "lambda2_lower":
        return at_most(point(bound), known.lambda2(bits))
    return (
        at_most(known.lambda_max(bits), point(bound))
        if key == "lambda_max_upper"
        else _sigma_at_most(known, bound, bits)
    )


def _redone(known: Known, key: str, bound: Fraction, numeric: Numeric) -> bool | None:
    network = known.graph.network
    if key == "lambda2_lower":
        return numeric.lambda2_at_least(network, bound)
    if key == "lambda_max_upper":
        return numeric.lambda_max_at_most(network, bound)
    mu = known.mu(PRECISIONS[0])
    return numeric.sigma_at_most(network, (mu.lower, mu.upper), bound)


def require_large_value(known: Known, value: Bounds) -> str:
    """Return the reason why what is said of a value is accepted; raise `Refused` or `Undecided`."""
    name = value.name
    if name in _UNDER_ASSUMPTION:
        need_that(known.graph.satisfies_assumption, f"{name} exists (Assumption 1 fails)")
    if name == "sigma":
        _rule(decided(lambda bits: _sigma_at_least(known, value.lower, bits)), "lower <= sigma")
        _rule(decided(lambda bits: _sigma_at_most(known, value.upper, bits)), "sigma <= upper")
        return "lower <= sigma <= upper"
    enclosed: dict[str, Callable[[int], Enclosure]] = {
        "mu": known.mu,
        "threshold": known.threshold,
        "degree_max": lambda _: point(known.graph.degree_max),
        "lambda2": known.lambda2,
        "beta": known.beta,
    }
    x = enclosed[name]
    _rule(decided(lambda bits: at_most(point(value.lower), x(bits))), f"lower <= {name}")
    _rule(decided(lambda bits: at_most(x(bits), point(value.upper))), f"{name} <= upper")
    return f"lower <= {name} <= upper"


def require_large_claim(known: Known, claim: LargeClaim) -> str:
    """Return the reason why a claim is accepted; raise `Refused` or `Undecided`."""
    need_that(claim.statement == STATEMENTS[claim.id], "the statement is the one of this claim, to the letter")
    need_that(claim.id != "trajectory-norm-bound" or known.design.x0 is not None, "the design has x0")
    holds = known.graph.satisfies_assumption
    applicable = claim.id in ANY_GRAPH or holds
    if claim.verdict == "inapplicable":
        need_that(not applicable, "Assumption 1 fails, and the claim presupposes it")
        return "Assumption 1 fails"
    need_that(applicable, "the claim is applicable (Assumption 1 fails)")
    if claim.verdict == "undecided":
        return "asserts nothing"
    if claim.id == "graph-assumption":
        need_that(holds == (claim.verdict == "proved"), claim.statement)
        if isinstance(claim.witness, GraphDefect):
            _require_defect(known.graph.network, claim.witness)
        return "true"
    if not isinstance(claim.witness, Nothing):
        require_shown(known.facts, claim.id, claim.verdict, claim.witness)
        return "true, and the witness shows it"
    test = _TRUTHS[claim.id] if holds else _UNBALANCED[claim.id]
    truth = decided(lambda bits: test(known, bits))
    if truth is None:
        raise Undecided("not decided by the bounds that were seen to hold")
    if truth != (claim.verdict == "proved"):
        raise Refused(f"the claim is {'true' if truth else 'false'}")
    return "decided by the bounds of mu, lambda2, lambda_max and sigma"


def _require_defect(network: Network, witness: GraphDefect) -> None:
    if witness.unreachable is not None:
        start, end = witness.unreachable
        need_that(not network.reached(start)[end - 1], f"no directed path leads from agent {start} to agent {end}")
    if witness.imbalance is not None:
        agent, heard, spoken = witness.imbalance
        need_that(heard == network.heard(agent), f'"in" is the sum of the weights that agent {agent} hears')
        need_that(spoken == network.spoken(agent), f'"out" is the sum of the weights with which agent {agent} is heard')
        need_that(heard != spoken, '"in" and "out" differ')


def decided(test: Callable[[int], bool | None]) -> bool | None:
    """The first answer as the precision doubles; None if there is none."""
    return next((truth for bits in PRECISIONS if (truth := test(bits)) is not None), None)


def at_most(x: Enclosure, y: Enclosure) -> bool | None:
    """Whether x <= y, None where the enclosures do not tell."""
    return True if x.upper <= y.lower else False if x.lower > y.upper else None


def _rule(truth: bool | None, statement: str) -> None:
    need(None if truth is None else int(truth), (1,), statement)


def _sigma_at_most(known: Known, bound: Fraction, bits: int) -> bool | None:
    return False if bound < 0 else at_most(known.sigma_square(bits), point(bound**2))


def _sigma_at_least(known: Known, bound: Fraction, bits: int) -> bool | None:
    return True if bound <= 0 else at_most(point(bound**2), known.sigma_square(bits))


def _below(x: Enclosure, y: Fraction) -> bool | None:
    """Whether x < y."""
    return True if x.upper < y else False if x.lower >= y else None


def _all_of(*truths: bool | None) -> bool | None:
    return False if False in truths else None if None in truths else True


def _gain_bound(known: Known, bits: int) -> bool | None:
    degree = known.graph.degree_max
    return True if degree == 0 else _below(known.mu(bits), 1 / degree)


def _memory(known: Known, bits: int) -> bool | None:
    beta = known.beta(bits)
    return _all_of(at_most(beta, known.threshold(bits)), at_most(known.second_threshold(bits), beta))


def _consensus(known: Known, bits: int) -> bool | None:
    graph = known.graph
    below = _gain_bound(known, bits)
    if below or known.sigma_square(bits).upper < 1:
        return True
    if graph.is_symmetric:
        return _below(_reflection(known, bits), Fraction(2))
    return below if graph.is_directed_cycle else None


def _reflection(known: Known, bits: int) -> Enclosure:
    """mu lambda_max."""
    mu, largest = known.mu(bits), known.lambda_max(bits)
    return Enclosure(mu.lower * largest.lower, mu.upper * largest.upper)


def _contraction(known: Known, bits: int) -> bool | None:
    mu, low, high, beta = known.mu(bits), known.lambda2(bits), known.lambda_max(bits), known.beta(bits)
    if beta.upper < 0:
        return False
    if known.graph.is_symmetric and mu.upper * (low.upper + high.upper) <= 2:
        return True
    return False if known.sigma_square(bits).lower > square_of(beta).upper else None


def _repaired(known: Known, bits: int) -> bool | None:
    return at_most(known.sigma_square(bits), square_of(known.threshold(bits)))


def _norm_bound(known: Known, bits: int) -> bool | None:
    graph, within = known.graph, at_most(known.beta(bits), known.threshold(bits))
    if within is False or any(known.sample_square(pair, bits).lower > 1 for pair in known.quotients):
        return False
    truth = True if _repaired(known, bits) else None
    if graph.is_symmetric and truth is None:
        return _all_of(at_most(_reflection(known, bits), point(Fraction(2))), within)
    return False if graph.is_directed_cycle and known.mu(bits).lower > 1 else truth


def _trajectory(known: Known, bits: int) -> bool | None:
    quotients = known.error_quotients
    if quotients is None or _norm_bound(known, bits):
        return True
    return False if known.sample_square(quotients, bits).lower > 1 else None


def _rooted(known: Known, bits: int) -> bool | None:
    """perron-eigenvalues where Assumption 1 fails: 1 is simple iff some agent reaches every other."""
    return False if not known.graph.has_root else _gain_bound(known, bits) or None


_TRUTHS: dict[str, Callable[[Known, int], bool | None]] = {
    "gain-bound": _gain_bound,
    "memory-inequality": _memory,
    "perron-eigenvalues": _consensus,
    "beta-contraction": _contraction,
    "repaired-condition": _repaired,
    "control-norm-bound": _norm_bound,
    "trajectory-norm-bound": _trajectory,
    "control-bounded": _consensus,
    "average-consensus": _consensus,
}
_UNBALANCED: dict[str, Callable[[Known, int], bool | None]] = {
    "gain-bound": _gain_bound,
    "perron-eigenvalues": _rooted,
}
