"""All designs on a graph with alpha in one interval and mu in another, and the tests of claims for all of them at once.

c_1 = 2^alpha - 1 and c_2 = 3^alpha - 2^alpha increase with alpha, sigma is convex in mu, and beta = 1 - mu lambda2
decreases: the corners at the least alpha are the worst.
Source: docs/certificate-format.md, section 7.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from fomas_verify.checker.corners import first_sign, second_sign, sigma_sign
from fomas_verify.checker.designs import Interval
from fomas_verify.checker.facts import BITS
from fomas_verify.checker.graph import Graph
from fomas_verify.checker.powers import Enclosure
from fomas_verify.checker.relation import (
    moves,
    require_excess,
    require_lemma,
    require_lemma_of,
    require_reflection,
)
from fomas_verify.checker.resolvent import KernelBetween, Memory, kernel
from fomas_verify.checker.ruling import need, need_that
from fomas_verify.checker.stability import trace_beyond
from fomas_verify.checker.witness import Excess, LargestBound, Lemma, Nothing, Power, Witness


@dataclass(frozen=True)
class Box:
    """Every alpha and every mu between two; a `Loop`."""

    graph: Graph
    alpha: Interval
    gain: Interval

    @property
    def precisions(self) -> tuple[int, ...]:
        """More bits do not make a box smaller."""
        return BITS[:2]

    def mu(self, bits: int) -> Enclosure:
        """The interval."""
        return Enclosure(*self.gain)

    def kernel(self, scale: int) -> Memory:
        """The memory of every alpha."""
        first, last = (kernel(alpha, scale) for alpha in self.alpha)
        return first if first is last else KernelBetween(first, last)


def require_over(box: Box, claim: str, verdict: str, witness: Witness) -> None:
    """Return if a witness shows a claim's verdict for every design of a box, under Assumption 1."""
    _TESTS[claim, verdict, type(witness)](box, witness)


def _memory_holds(box: Box, _: Nothing) -> None:
    graph, alpha = box.graph, box.alpha[0]
    need(first_sign(graph, alpha, box.gain[0]), (0, 1), "beta <= 2^alpha - 1")
    need(second_sign(graph, alpha, box.gain[1]), (-1, 0), "beta >= -sqrt(3^alpha - 2^alpha)")


def _sigma_within(box: Box, _: Nothing) -> None:
    for mu in dict.fromkeys(box.gain):
        need(sigma_sign(box.graph, box.alpha[0], mu), (0, 1), "sigma <= 2^alpha - 1")


def _agreed_or_within(box: Box, witness: Nothing) -> None:
    if moves(box.graph):
        _sigma_within(box, witness)


def _largest_bound(box: Box, witness: LargestBound) -> None:
    need_that(box.gain[1] <= witness.mu, "mu <= witness.mu")
    require_reflection(box.graph, witness)
    # beta is largest at the least mu.
    need(first_sign(box.graph, box.alpha[0], box.gain[0]), (0, 1), "beta <= 2^alpha - 1")


def _grows(box: Box, witness: Power) -> None:
    need_that(0 < witness.mu <= box.gain[0], "0 < witness.mu <= mu")
    need(trace_beyond(box.graph, witness.mu, witness.power), (1,), "abs trace(Pc(witness.mu)^power) > N - 1")


_TESTS: dict[tuple[str, str, type], Callable[[Box, Any], None]] = {
    ("memory-inequality", "proved", Nothing): _memory_holds,
    ("repaired-condition", "proved", Nothing): _sigma_within,
    ("control-norm-bound", "proved", Nothing): _sigma_within,
    ("control-norm-bound", "proved", Lemma): require_lemma,
    ("control-norm-bound", "proved", LargestBound): _largest_bound,
    ("control-norm-bound", "refuted", Power): _grows,
    ("control-norm-bound", "refuted", Excess): require_excess,
    ("trajectory-norm-bound", "proved", Nothing): _agreed_or_within,
    ("trajectory-norm-bound", "proved", Lemma): require_lemma_of,
    ("trajectory-norm-bound", "proved", LargestBound): _largest_bound,
}
