"""Witnesses for and against norm u_k <= norm u_0: for every x_0 (relation eqL3), and for the x_0 of the design.

Source: docs/certificate-format.md, section 4; theory, sections 3 (peak control) and 7 (eqL3 on a symmetric graph).
"""

from collections.abc import Callable, Iterable
from fractions import Fraction
from functools import lru_cache
from typing import cast

from fomas_verify.checker.designs import State
from fomas_verify.checker.facts import Facts, settle
from fomas_verify.checker.graph import Graph
from fomas_verify.checker.loop import Loop
from fomas_verify.checker.operators import operators
from fomas_verify.checker.resolvent import MAX_SAMPLES
from fomas_verify.checker.ruling import Undecided, need, need_that
from fomas_verify.checker.thresholds import beta_below_first
from fomas_verify.checker.trajectory import error_columns, trajectory
from fomas_verify.checker.witness import Excess, ExcessAt, LargestBound, Lemma

_EXCEEDS = "norm(Phi_k L x_0) > norm(L x_0)"
_SAMPLES = "norm Phi_k <= 1 for k = 1..K"
_POWERS = "norm(P^n) <= c_n for n = K+1..K+m"
_DECAY = "norm(P^m) c_{K+1} <= c_{K+1+m}"
_SAMPLES_OF = "norm(Phi_k e) <= norm(e) for k = 1..K"
_POWERS_OF = "norm(P^n e) <= c_n norm(e) for n = K+1..K+m"


def require_excess(loop: Loop, witness: Excess) -> None:
    """Return if x_0 and k show norm u_k > norm u_0."""
    _require_excess(loop, tuple((entry,) for entry in witness.x0), witness.k)


def require_excess_at(loop: Loop, witness: ExcessAt) -> None:
    """Return if k shows norm u_k > norm u_0 for the design's x_0."""
    _require_excess(loop, cast(State, loop.graph.design.x0), witness.k)


def moves(graph: Graph) -> bool:
    """Whether L x_0 != 0 for the design's x_0."""
    return _moves(graph, cast(State, graph.design.x0))


def require_lemma(loop: Loop, witness: Lemma) -> None:
    """Return if K samples and m powers show norm Phi_k <= 1 for every k."""
    _limit(witness)
    start, m = witness.samples, witness.powers
    samples = _ask(loop, lambda bits: _all(operators(loop, bits).sample_sign_of_one, range(1, start + 1)))
    need(samples, (1,), _SAMPLES)
    powers = _ask(loop, lambda bits: _all(operators(loop, bits).power_sign_of_memory, range(start + 1, start + m + 1)))
    need(powers, (1,), _POWERS)
    _require_decay(loop, witness)


def require_lemma_of(loop: Loop, witness: Lemma) -> None:
    """Return if K samples and m powers show norm u_k <= norm u_0 for every k and the design's x_0."""
    _limit(witness)
    x0 = cast(State, loop.graph.design.x0)
    if _moves(loop.graph, x0):
        start, m = witness.samples, witness.powers
        samples = _ask(loop, lambda bits: _all(trajectory(loop, x0, bits).sample_sign, range(1, start + 1)))
        need(samples, (1,), _SAMPLES_OF)
        powers = _ask(loop, lambda bits: _all(trajectory(loop, x0, bits).power_sign, range(start + 1, start + m + 1)))
        need(powers, (1,), _POWERS_OF)
    _require_decay(loop, witness)


def require_largest_bound(facts: Facts, witness: LargestBound) -> None:
    """Return if, on a symmetric graph, beta <= 2^alpha - 1 and mu lambda <= 2 for every eigenvalue lambda of L."""
    require_reflection(facts.graph, witness)
    need(facts.compare_mu(witness.mu), (-1, 0), "mu <= witness.mu")
    need(beta_below_first(facts), (0, 1), "beta <= 2^alpha - 1")


@lru_cache(maxsize=4)
def require_reflection(graph: Graph, witness: LargestBound) -> None:
    """Return if the graph is symmetric, and t lambda <= 2 for every eigenvalue lambda of L, t the witness's mu."""
    t, r = witness.mu, witness.lambda_max_upper
    need_that(graph.is_symmetric, "the graph is symmetric")
    # The largest eigenvalue does not depend on the numbers of the design.
    largest = Facts(graph.design.at(Fraction(1, 2), Fraction(1)), graph).compare_largest(r)
    need(largest, (-1, 0), "every eigenvalue of L_s is <= witness.lambda_max_upper")
    need_that(t * r <= 2, "witness.mu witness.lambda_max_upper <= 2")


def _require_excess(loop: Loop, x0: State, k: int) -> None:
    need_that(_moves(loop.graph, x0), "L x_0 != 0")
    need(_ask(loop, lambda bits: trajectory(loop, x0, bits).sample_sign(k)), (-1,), _EXCEEDS)


def _moves(graph: Graph, x0: State) -> bool:
    return any(entry != 0 for column in error_columns(graph, x0)[0] for entry in column)


def _limit(witness: Lemma) -> None:
    if witness.samples + witness.powers > MAX_SAMPLES:
        raise Undecided(f"more than {MAX_SAMPLES} samples are beyond the work allowed")


def _require_decay(loop: Loop, witness: Lemma) -> None:
    need(_ask(loop, lambda bits: operators(loop, bits).decays(witness.samples, witness.powers)), (1,), _DECAY)


def _ask(loop: Loop, test: Callable[[int], int | None]) -> int | None:
    return settle(test, precisions=loop.precisions)


def _all(sign: Callable[[int], int | None], numbers: Iterable[int]) -> int | None:
    """1 if the sign is 1 of all of them, else the first that is not."""
    return next((found for found in map(sign, numbers) if found != 1), 1)
