"""Truth of the ten claims and the numbers of a design, from their definitions, at 60 digits and more.

Margins are positive where a claim is true. A margin that 300 digits do not separate from zero is decided by the exact
tests of `ties`, or not at all. Notation as in docs/certificate-format.md; sources: docs/certificate-format.md, and for
each decision the definition it states. Nothing here is shared with prover or checker.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from math import ceil
from typing import Any

from mpmath import mp

from . import ties
from .exact import charpoly, distinct_roots
from .model import Design, assumption_1, degree_max, in_and_out, laplacian, strongly_connected, symmetric_part

DIGITS = (60, 120, 300)
CLAIMS = (
    "graph-assumption",
    "gain-bound",
    "memory-inequality",
    "perron-eigenvalues",
    "beta-contraction",
    "repaired-condition",
    "control-norm-bound",
    "trajectory-norm-bound",
    "control-bounded",
    "average-consensus",
)
# what exact signs and mpmath raise where their digits or iterations do not suffice
UNDECIDED = (ArithmeticError, mp.NoConvergence, RuntimeError)
ANY_GRAPH = ("graph-assumption", "gain-bound", "perron-eigenvalues")


@dataclass(frozen=True)
class Answer:
    """Truth of a claim (None: not decided), and the margin seen (None where truth is combinatorial)."""

    truth: bool | None
    margin: Any = None


def real(x: Fraction) -> Any:
    """A rational at the working precision."""
    return mp.mpf(x.numerator) / x.denominator


@lru_cache(maxsize=4096)
def mu(design: Design, dps: int) -> Any:
    """mu = gamma h^alpha / Gamma(alpha + 1), or the one given."""
    with mp.workdps(dps):
        if design.mu is not None:
            return real(design.mu)
        assert design.gamma is not None
        assert design.h is not None
        alpha = real(design.alpha)
        return real(design.gamma) * real(design.h) ** alpha / mp.gamma(alpha + 1)


def threshold(design: Design, dps: int) -> Any:
    """2^alpha - 1."""
    with mp.workdps(dps):
        return mp.mpf(2) ** real(design.alpha) - 1


def _orthonormal_basis(n: int) -> Any:
    """Helmert's basis of 1perp, as the columns of an n x (n-1) matrix."""
    v = mp.zeros(n, n - 1)
    for j in range(1, n):
        for i in range(j):
            v[i, j - 1] = 1 / mp.sqrt(j * (j + 1))
        v[j, j - 1] = -j / mp.sqrt(j * (j + 1))
    return v


def _real_matrix(rows: list[list[Fraction]]) -> Any:
    return mp.matrix([[real(x) for x in row] for row in rows])


@lru_cache(maxsize=4096)
def lambda2(design: Design, dps: int) -> Any:
    """The smallest eigenvalue of L_s on 1perp, by Jacobi on an orthonormal basis."""
    with mp.workdps(dps + 10):
        v = _orthonormal_basis(design.agents)
        form = v.T * _real_matrix(symmetric_part(laplacian(design))) * v
        return min(mp.eigsy((form + form.T) / 2, eigvals_only=True))


def largest_singular_value(a: Any) -> Any:
    """The 2-norm of a matrix at the working precision; by `a^T a` with twice the digits where mpmath's QR iteration
    does not converge.
    """
    try:
        return max(mp.svd(a, compute_uv=False))
    except RuntimeError:
        with mp.workdps(2 * mp.dps + 10):
            return mp.sqrt(max(mp.eigsy(a.T * a, eigvals_only=True)))


@lru_cache(maxsize=4096)
def sigma(design: Design, dps: int) -> Any:
    """The largest singular value of P on 1perp."""
    with mp.workdps(dps + 10):
        v = _orthonormal_basis(design.agents)
        p = v - mu(design, dps + 10) * (_real_matrix(laplacian(design)) * v)
        return largest_singular_value(p)


def beta(design: Design, dps: int) -> Any:
    """1 - mu lambda2."""
    with mp.workdps(dps):
        return 1 - mu(design, dps) * lambda2(design, dps)


@lru_cache(maxsize=4096)
def scale(design: Design) -> int:
    """Decimal digits that P's size takes before the point: an absolute error needs that many more."""
    with mp.workdps(30):
        return max(0, ceil(mp.log10((1 + mu(design, 30)) * (1 + real(degree_max(design))))))


def settle(design: Design, margin: Callable[[int], Any], exact: Callable[[], bool | None] | None = None) -> Answer:
    """Sign of a margin: 60 digits after the point, then the exact test if there is one, then up to 300 digits."""
    value = None
    for digits in DIGITS:
        dps = digits + scale(design)
        with mp.workdps(dps):
            value = margin(dps)
            if abs(value) > mp.mpf(10) ** (-2 * digits // 3):
                return Answer(bool(value > 0), value)
        if exact is not None and (truth := exact()) is not None:
            return Answer(truth, value)
    return Answer(None, value)


def _graph_assumption(design: Design) -> Answer:
    return Answer(strongly_connected(design) and all(x == y for x, y in in_and_out(design)))


def _gain_bound(design: Design) -> Answer:
    d = degree_max(design)
    if d == 0:
        return Answer(True)
    if design.mu is not None:
        return Answer(design.mu * d < 1, real(1 - design.mu * d))
    return settle(design, lambda dps: 1 - mu(design, dps) * real(d))


def memory_slacks(design: Design, dps: int, samples: int) -> list[Any]:
    """1 - (beta^(k+1) + sum_{l<=k+1} abs f(l)) for k = 0..samples-1, term by term."""
    with mp.workdps(dps + 10):
        alpha, b = real(design.alpha), beta(design, dps + 10)
        total, slacks = mp.mpf(0), []
        for k in range(samples):
            j = k + 1
            before = mp.mpf(j - 1) ** alpha if j > 1 else mp.mpf(0)
            total += abs(mp.mpf(j + 1) ** alpha - 2 * mp.mpf(j) ** alpha + before)
            slacks.append(1 - b**j - total)
        return slacks


def first_failure(design: Design) -> tuple[int | None, Answer]:
    """The first k at which (14) fails (None: no k), with the margin: its slack, or the least of k = 0, 1.

    Terms are summed for k <= 50. Beyond, `abs(beta)^n <= c_n` is followed to the n from which the geometric side
    falls faster than `alpha (n+1)^(alpha-1) <= c_n` does.
    """
    for k in (0, 1):
        exact = (lambda: ties.memory_at_0(design)) if k == 0 else None
        answer = settle(design, lambda dps, k=k: memory_slacks(design, dps, k + 1)[k], exact)
        if answer.truth is None:
            return None, answer
        if not answer.truth:
            return k, answer
    digits = DIGITS[0] + scale(design)
    with mp.workdps(digits):
        slacks = memory_slacks(design, digits, 51)
        failing = [k for k, slack in enumerate(slacks) if k > 1 and slack < 0]
        if failing:
            return failing[0], Answer(False, slacks[failing[0]])
        if not _tail_holds(design, digits):
            return None, Answer(None, min(slacks))
        return None, Answer(True, min(slacks[:2]))


def _tail_holds(design: Design, digits: int) -> bool:
    alpha, size = real(design.alpha), abs(beta(design, digits))
    last = max(52, ceil(2 / (1 - size)))
    if last > 10**6:
        return False
    for n in range(52, last + 1):
        if size**n > mp.mpf(n + 1) ** alpha - mp.mpf(n) ** alpha:
            return False
    return bool(size**last <= alpha * mp.mpf(last + 1) ** (alpha - 1) and size <= mp.mpf(last) / (last + 1))


def spectral_margin(design: Design, dps: int) -> Any:
    """1 - max abs(1 - mu lambda) over the eigenvalues lambda of L but one of the zeros (roots of L's polynomial)."""
    roots = distinct_roots(charpoly(laplacian(design)), dps + 10)
    with mp.workdps(dps + 10):
        gain, tiny = mu(design, dps + 10), mp.mpf(10) ** (-dps // 2)
        zeros = sum(m for z, m in roots if abs(z) < tiny)
        sizes = [abs(1 - gain * z) for z, _ in roots if abs(z) >= tiny]
        return 1 - max([*sizes, *([mp.mpf(1)] if zeros > 1 else [])])


def _perron(design: Design) -> Answer:
    if charpoly(laplacian(design))[1] == 0:
        return Answer(False, mp.mpf(0))
    return settle(design, lambda dps: spectral_margin(design, dps), lambda: ties.unit_circle(design))


def _contraction(design: Design) -> Answer:
    def margin(dps: int) -> Any:
        return beta(design, dps) - sigma(design, dps)

    digits = DIGITS[0] + scale(design)
    with mp.workdps(digits):
        value = margin(digits)
        if value < -(mp.mpf(10) ** -40):
            return Answer(False, value)
    return Answer(ties.contraction(design, mu(design, digits + 20)), value)


def _repaired(design: Design) -> Answer:
    return settle(design, lambda dps: threshold(design, dps) - sigma(design, dps), lambda: ties.repaired(design))


def _control_norm_bound(design: Design) -> Answer:
    from .bounds import control_norm_bound

    return control_norm_bound(design)


def _trajectory_norm_bound(design: Design) -> Answer:
    from .bounds import trajectory_norm_bound

    return trajectory_norm_bound(design)


_DECIDE: dict[str, Callable[[Design], Answer]] = {
    "graph-assumption": _graph_assumption,
    "gain-bound": _gain_bound,
    "memory-inequality": lambda design: first_failure(design)[1],
    "perron-eigenvalues": _perron,
    "beta-contraction": _contraction,
    "repaired-condition": _repaired,
    "control-norm-bound": _control_norm_bound,
    "trajectory-norm-bound": _trajectory_norm_bound,
    "control-bounded": _perron,
    "average-consensus": _perron,
}


@lru_cache(maxsize=8192)
def decide(design: Design, claim: str) -> Answer:
    """Truth of a claim about a design; only for claims that apply to its graph."""
    try:
        return _DECIDE[claim](design)
    except UNDECIDED:
        return Answer(None)


def claims_of(design: Design) -> tuple[str, ...]:
    """The claims that can be made about a design: the one on its trajectory only where x0 is given."""
    return tuple(claim for claim in CLAIMS if claim != "trajectory-norm-bound" or design.x0 is not None)


def verdict(design: Design, claim: str) -> str | None:
    """`proved`, `refuted` or `inapplicable`; None where the oracle cannot tell."""
    if claim not in ANY_GRAPH and not assumption_1(design):
        return "inapplicable"
    truth = decide(design, claim).truth
    return None if truth is None else "proved" if truth else "refuted"
