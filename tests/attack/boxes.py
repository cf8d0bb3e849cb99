"""Whether a witness shows its claim for every alpha and mu of a box, as section 7 of docs/certificate-format.md asks.

The tests at the ends of a box are exact. Those on the norms of P^n and Phi_k are tried on a grid in floats: a violation
beyond 1e-9 refutes; what stays clear of the bound by more than the slope changes between neighbours is taken for
shown; the rest is not known.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction
from functools import lru_cache
from typing import Any

import numpy as np
from mpmath import mp

from . import oracle, ties
from .bounds import is_symmetric, memory_at_0
from .form_witness import Claim, Witness
from .gain import Truth, both
from .model import Design, laplacian, x0_columns
from .norm_witness import control_shown, trajectory_shown
from .response import error_columns
from .spectral_witness import leaves

Ends = tuple[Fraction, Fraction]
GUARD = 1e-9
ROOM = 0.3
GRIDS = (5, 17, 33)
MOST_SAMPLES = 400


def at(design: Design, alpha: Fraction, gain: Fraction) -> Design:
    """The design with this alpha and mu."""
    return replace(design, alpha=alpha, mu=gain, gamma=None)


def memory_at_1(design: Design) -> Truth:
    """beta >= -sqrt(3^alpha - 2^alpha)."""

    def margin(dps: int) -> Any:
        with mp.workdps(dps + 10):
            alpha = oracle.real(design.alpha)
            return oracle.beta(design, dps + 10) + mp.sqrt(mp.mpf(3) ** alpha - mp.mpf(2) ** alpha)

    return oracle.settle(design, margin).truth


@lru_cache(maxsize=64)
def _on_1perp(design: Design) -> Any:
    """L on an orthonormal basis of 1perp, in floats, and that basis."""
    basis = np.array(oracle._orthonormal_basis(design.agents).tolist(), dtype=float)
    return basis.T @ np.array([[float(x) for x in row] for row in laplacian(design)]) @ basis, basis


@dataclass(frozen=True)
class Start:
    """The columns S that P^n and Phi_k act on: the unit matrix (spectral norm), L x_0 (over all entries), or none."""

    columns: Any
    order: Any


def start_of(design: Design, x0: tuple[tuple[Fraction, ...], ...] | None) -> Start:
    """All of 1perp, or L x_0 divided by its norm."""
    lap, basis = _on_1perp(design)
    if x0 is None:
        return Start(np.eye(len(lap)), 2)
    errors = error_columns(design, x0)
    size = max((abs(x) for column in errors for x in column), default=Fraction(0))
    if not size:
        return Start(None, "fro")
    columns = basis.T @ np.array([[float(x / size) for x in column] for column in errors]).T
    return Start(columns / np.linalg.norm(columns), "fro")


def _norms(blocks: list[Any], order: Any) -> list[float]:
    """The norms of matrices in floats; infinite where they have outgrown them."""
    stack = np.array(blocks)
    finite = np.isfinite(stack).all(axis=(1, 2))
    norms = np.full(len(stack), np.inf)
    norms[finite] = np.linalg.norm(stack[finite], order, axis=(1, 2))
    return norms.tolist()


class Loop:
    """c_n, norm P^n, norm(P^n S) and norm(Phi_k S) at one alpha and mu, in floats."""

    def __init__(self, design: Design, start: Start, alpha: float, gain: float, samples: int, last: int) -> None:
        lap, _ = _on_1perp(design)
        p = np.eye(len(lap)) - gain * lap
        n = np.arange(last + 2, dtype=float)
        self.c = (n + 1) ** alpha - n**alpha
        falls, r = self.c[:-1] - self.c[1:], [1.0]
        powers, moved, controls = [np.eye(len(lap))], [start.columns], [start.columns]
        for k in range(1, last + 1):
            powers.append(p @ powers[-1])
            if start.columns is None:
                continue
            moved.append(p @ moved[-1])
            if k <= samples:
                r.append(float(np.dot(falls[:k], r[::-1])))
                controls.append(p @ controls[-1] + r[k] * start.columns)
        self.powers = _norms(powers, 2)
        self.moved, self.controls = (
            [1.0] if start.columns is None else _norms(blocks, start.order) for blocks in (moved, controls)
        )


def _margins(design: Design, witness: Witness, start: Start, alpha: float, gain: float, least: float) -> Any:
    """The margins of the witness's inequalities at one point; c_n at `least`, the least alpha of the box."""
    if "k" in witness:
        loop = Loop(design, start, alpha, gain, witness["k"], witness["k"])
        return np.array([loop.controls[witness["k"]] - 1])
    samples, m = witness["samples"], witness["powers"]
    loop = Loop(design, start, alpha, gain, samples, samples + m + 1)
    n = np.arange(samples + m + 2, dtype=float)
    c = (n + 1) ** least - n**least
    first = [] if start.columns is None else [1 - x for x in loop.controls[1 : samples + 1]]
    then = [] if start.columns is None else [1 - loop.moved[j] / c[j] for j in range(samples + 1, samples + m + 1)]
    tail = 1 - loop.powers[m] * loop.c[samples + 1] / loop.c[samples + 1 + m]
    return np.array([*first, *then, tail])


def _smooth(grid: Any, axis: int) -> bool:
    """Whether every point is further above zero than the slope changes there and at its neighbours."""
    if grid.shape[axis] == 1:
        return True
    bends = np.abs(np.diff(grid, 2, axis=axis))
    edge = [(0, 0)] * grid.ndim
    edge[axis] = (2, 2)
    padded = np.pad(bends, edge, mode="edge")
    around = [np.take(padded, range(k, k + grid.shape[axis]), axis=axis) for k in range(3)]
    return bool((grid > np.maximum.reduce(around)).all())


def on_a_grid(design: Design, witness: Witness, start: Start, alphas: Ends, gains: Ends) -> Truth:
    """The inequalities on grids of more and more points.

    True only where they hold with `ROOM` times what the box moves them, which enclosures too can show.
    """
    size = witness["k"] if "k" in witness else witness["samples"] + witness["powers"]
    if size > MOST_SAMPLES:
        return None
    for count in GRIDS:
        points = [np.linspace(float(x), float(y), 1 if x == y else count) for x, y in (alphas, gains)]
        grid = np.array(
            [[_margins(design, witness, start, alpha, gain, points[0][0]) for gain in points[1]] for alpha in points[0]]
        )
        least = grid.min(axis=(0, 1))
        if not np.isfinite(grid).all() or least.min() < -GUARD:
            return False if least.min() < -GUARD else None
        if least.min() > GUARD and all(_smooth(grid, axis) for axis in (0, 1)):
            spread = (grid.max(axis=(0, 1)) - least).max()
            return True if least.min() > ROOM * spread else None
    return None


def over_box(design: Design, claim: str, verdict: str, witness: Witness, alphas: Ends, gains: Ends) -> Truth:
    """Whether the witness shows the claim for every alpha and mu of the box, both ends included."""
    low, high = at(design, alphas[0], gains[0]), at(design, alphas[0], gains[1])
    if claim == "memory-inequality":
        return both(memory_at_0(low).truth, memory_at_1(high))
    if not witness:
        if claim == "trajectory-norm-bound" and not any(map(any, error_columns(design, x0_columns(design)))):
            return True
        return both(*(oracle.decide(end, "repaired-condition").truth for end in (low, high)))
    if "lambda_max_upper" in witness:
        t, r = witness["mu"], witness["lambda_max_upper"]
        if not is_symmetric(design) or t * r > 2 or gains[1] > t or not ties.eigenvalues_at_most(design, r):
            return False
        return memory_at_0(low).truth
    if "power" in witness:
        return 0 < witness["mu"] <= gains[0] and leaves(design, witness["mu"], witness)
    return _sampled(design, claim, verdict, witness, alphas, gains)


def _sampled(design: Design, claim: str, verdict: str, witness: Witness, alphas: Ends, gains: Ends) -> Truth:
    if alphas[0] == alphas[1] and gains[0] == gains[1]:
        shown = control_shown if claim == "control-norm-bound" else trajectory_shown
        return shown(at(design, alphas[0], gains[0]), Claim(claim, verdict, "", witness))
    own = (tuple(witness["x0"]),) if "x0" in witness else None
    columns = x0_columns(design) if claim == "trajectory-norm-bound" else own
    start = start_of(design, columns)
    if start.columns is None and verdict == "refuted":
        return False
    return on_a_grid(design, witness, start, alphas, gains)
