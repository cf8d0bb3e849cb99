"""Truth of `control-norm-bound` and `trajectory-norm-bound`, and the peak of norm Phi_k.

Finitely many norms decide once the rest is known to be no larger. The tail is closed here by the peak lemma, written
out again: from `F Phi = (P^k)`, `Phi_k = P^k + sum_{l=1}^{k} abs f(l) Phi_{k-l}` with `sum_{l<=k} abs f(l) = 1 - c_k`;
so if `norm Phi_k <= M` for k <= K and `norm P^n <= M c_n` for n > K, then `norm Phi_k <= M` for every k. As
`c_{n+m}/c_n` does not decrease in n, `norm P^n <= M c_n` for K < n <= K + m and `norm P^m <= c_{K+1+m}/c_{K+1}` give
the second hypothesis. Symmetric graphs are decided by their closed form instead (docs/theory, section 7), and gains at
which P has an eigenvalue outside the unit disc by `P^k = sum_l f(l) Phi_{k-l}`, which cannot grow if Phi does not.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from typing import Any

from mpmath import mp

from . import oracle, ties
from .model import Design, adjacency, laplacian, symmetric_part, x0_columns
from .oracle import Answer
from .response import GUARD, NEAR, Response, digits, error_columns, on_1perp, trajectory

START = 16


@dataclass(frozen=True)
class Peak:
    """The largest norm Phi_k for k <= samples, to 14 digits; `closed` tells that no later one is larger."""

    size: Any
    at: int
    samples: int
    closed: bool


def _tail_is_below(controls: Response, powers: Response, size: Any, samples: int) -> bool:
    """The hypotheses of the peak lemma with M = size and some K + m <= samples, with a margin of `NEAR`."""
    c, room = controls.kernel.c, 1 - mp.mpf(NEAR)
    last = 0
    for n in range(samples, 0, -1):
        if controls.power_norm(n) > size * c(n) * room:
            last = n
            break
    return any(powers.power_norm(m) * c(last + 1) <= c(last + 1 + m) * room for m in range(1, samples - last + 1))


def highest(controls: Response, powers: Response) -> Peak:
    """The peak of a response whose powers die out, over twice as many samples until its tail is closed."""
    samples, most = START, min(controls.limit, powers.limit)
    while True:
        samples = min(2 * samples, most)
        norms = [controls.control_norm(k) for k in range(samples + 1)]
        at = max(range(samples + 1), key=norms.__getitem__)
        if _tail_is_below(controls, powers, norms[at], samples):
            return Peak(norms[at], at, samples, True)
        if samples == most:
            return Peak(norms[at], at, samples, False)


def _never_above_one(controls: Response, powers: Response) -> Answer:
    """norm Phi_k <= 1 for every k, by samples and tail."""
    samples, most, checked = START, min(controls.limit, powers.limit), 0
    unknown = False
    while True:
        samples = min(2 * samples, most)
        for k in range(checked + 1, samples + 1):
            truth = controls.control_at_most(k, mp.mpf(1))
            if truth is False:
                return Answer(False, 1 - controls.exact_control_norm(k))
            unknown = unknown or truth is None
        checked = samples
        if _tail_is_below(controls, powers, mp.mpf(1), samples):
            return Answer(None if unknown else True, 1 - max(controls.control_norm(k) for k in range(1, samples + 1)))
        if samples == most:
            return Answer(None)


def is_symmetric(design: Design) -> bool:
    """Whether A = A^T."""
    a = adjacency(design)
    return a == [list(column) for column in zip(*a, strict=True)]


def largest_eigenvalue(design: Design, dps: int) -> Any:
    """The largest eigenvalue of L_s."""
    with mp.workdps(dps + 10):
        form = mp.matrix([[oracle.real(x) for x in row] for row in symmetric_part(laplacian(design))])
        return max(mp.eigsy(form, eigvals_only=True))


def not_past_two(design: Design) -> Answer:
    """mu lambda_N <= 2, lambda_N the largest eigenvalue of L_s."""

    def exact() -> bool | None:
        return None if design.mu is None else ties.eigenvalues_at_most(design, 2 / design.mu)

    def margin(dps: int) -> Any:
        with mp.workdps(dps + 10):
            return 2 - oracle.mu(design, dps + 10) * largest_eigenvalue(design, dps + 10)

    return oracle.settle(design, margin, exact)


def memory_at_0(design: Design) -> Answer:
    """beta <= 2^alpha - 1."""
    return oracle.settle(
        design, lambda dps: oracle.threshold(design, dps) - oracle.beta(design, dps), lambda: ties.memory_at_0(design)
    )


def closed_form(design: Design) -> Answer:
    """eqL3 on a symmetric graph: beta <= 2^alpha - 1 and mu lambda_N <= 2."""
    answers = (memory_at_0(design), not_past_two(design))
    false = [answer for answer in answers if answer.truth is False]
    if false:
        return false[0]
    return min(answers, key=lambda answer: answer.truth is not None)


def by_samples(design: Design) -> Answer:
    """eqL3 on any graph, by the norms of Phi_k alone."""
    outside = oracle.decide(design, "perron-eigenvalues")
    if outside.truth is False and outside.margin is not None and outside.margin < -(mp.mpf(10) ** -40):
        return outside
    return _never_above_one(on_1perp(design), on_1perp(design))


def control_norm_bound(design: Design) -> Answer:
    """norm u_k <= norm u_0 for every k and every x_0."""
    return closed_form(design) if is_symmetric(design) else by_samples(design)


def trajectory_norm_bound(design: Design) -> Answer:
    """norm u_k <= norm u_0 for every k and the design's x_0."""
    controls = trajectory(design)
    if controls is None:
        return Answer(True)
    stable = oracle.decide(design, "perron-eigenvalues").truth
    answer = _never_above_one(controls, on_1perp(design) if stable else _on_its_own_space(design))
    if answer.truth is None and oracle.decide(design, "control-norm-bound").truth is True:
        return Answer(True)
    if answer.truth is None and _grows(design):
        return Answer(False)
    return answer


def _krylov(design: Design) -> list[list[Fraction]]:
    """Independent vectors that span the least L-invariant space with the columns of L x_0, orthogonal, exactly."""
    found: list[list[Fraction]] = []
    waiting = error_columns(design, x0_columns(design))
    while waiting:
        v = waiting.pop()
        for w in found:
            factor = Fraction(sum(x * y for x, y in zip(v, w, strict=True))) / sum(x * x for x in w)
            v = [x - factor * y for x, y in zip(v, w, strict=True)]
        if any(v):
            found.append(v)
            waiting += error_columns(design, [v])
    return found


@lru_cache(maxsize=16)
def _on_its_own_space(design: Design) -> Response:
    """P^k on the space that the trajectory spans, where P may be stable though it is not on 1perp."""
    dps, space = digits(design), _krylov(design)
    with mp.workdps(dps + GUARD):
        gain = oracle.mu(design, dps + GUARD)
        unit = [[oracle.real(x) / mp.sqrt(oracle.real(Fraction(sum(x * x for x in v)))) for x in v] for v in space]
        lap = [[oracle.real(x) for x in row] for row in laplacian(design)]
        images = [[x - gain * mp.fdot(row, v) for x, row in zip(v, lap, strict=True)] for v in unit]
        p = [[mp.fdot(u, image) for image in images] for u in unit]
        start = [[mp.mpf(i == j) for j in range(len(unit))] for i in range(len(unit))]
    return Response(p, start, design.alpha, dps, spectral=True)


def _grows(design: Design) -> bool:
    """P has an eigenvalue outside the unit disc on the trajectory's space, so that P^k e, and with it u_k, grows."""
    response = _on_its_own_space(design)
    with mp.workdps(response.dps):
        roots = mp.eig(mp.matrix(response.p), left=False, right=False) if len(response.p) > 1 else [response.p[0][0]]
        return bool(max(abs(z) for z in roots) > 1 + mp.mpf(10) ** -20)
