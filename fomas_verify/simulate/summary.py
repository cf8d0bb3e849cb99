"""A simulation in words: a column for each controller, and what its numbers mean."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from fractions import Fraction

import numpy as np

from fomas_verify.simulate.laws import approx_remaining_memory
from fomas_verify.simulate.memory import Array
from fomas_verify.simulate.trajectory import Trajectory

EARLY = 20
ROUNDING = 1e-12
"""Share of the largest number below which a float result is not shown: it may be rounding only."""


def table(runs: Sequence[Trajectory], limit: Array | None) -> Iterator[str]:
    """The lines: mean absolute error early and late, largest control and its sample."""
    rows = [("", [run.controller for run in runs])]
    if limit is not None:
        errors = [run.mean_absolute_error(limit) for run in runs]
        sizes = [float(np.max(np.abs(run.states[..., 0]))) for run in runs]
        shared = min(run.last for run in runs)
        for k in sorted({min(EARLY, shared), shared}):
            cells = [_shown(float(r[k]), size) for r, size in zip(errors, sizes, strict=True)]
            rows.append((f"mean absolute error r, k = {k}", cells))
    norms = [run.input_norms for run in runs]
    rows.append(("largest norm u_k", [_shown(float(u.max()), 0.0) for u in norms]))
    rows.append(("  at k", [str(int(u.argmax())) for u in norms]))
    first = max(len(name) for name, _ in rows)
    widths = [max(len(cells[i]) for _, cells in rows) for i in range(len(runs))]
    for name, cells in rows:
        columns = "  ".join(cell.ljust(width) for cell, width in zip(cells, widths, strict=True))
        yield f"  {name.ljust(first)}  {columns}".rstrip()


def stopped(run: Trajectory) -> str:
    """That a loop outgrew what is simulated."""
    t = (run.last + 1) * run.h
    return (
        f"{run.controller}: the loop is unstable: its numbers pass 1e100 at k = {run.last + 1} (t = {t:.6g} s); "
        f"simulated up to k = {run.last}"
    )


def truncation(alpha: float, memory: int) -> Iterator[str]:
    """What is lost by keeping M inputs only."""
    remaining = approx_remaining_memory(alpha, memory)
    yield f"truncated keeps M = {memory} inputs and leaves c_M = {remaining:.8g} of the plant's memory uncancelled, so"
    yield "  x - mean ~ (c_M / gamma) L^+ (x_0 - mean) t^-alpha / Gamma(1 - alpha): no longer geometric at the samples"


def limit_line(limit: Sequence[Fraction] | None) -> str:
    """What the agents tend to under the proposed and the memoryless law, where they do."""
    if limit is None:
        return "no common limit: no agent reaches every other"
    numbers = ", ".join(str(x) if x.denominator == 1 else f"{float(x):.12g}" for x in limit)
    return f"r is the distance from {numbers if len(limit) == 1 else f'({numbers})'}"


def _shown(x: float, size: float) -> str:
    """As many of eight digits as stand clear of rounding, which is a share of ``size``."""
    if x < ROUNDING * size or x == 0:
        return f"below {ROUNDING * size:.1g}" if size else "0"
    digits = 8 if size == 0 else max(1, min(8, int(math.log10(x / (ROUNDING * size))) + 1))
    return f"{x:.{digits}g}"
