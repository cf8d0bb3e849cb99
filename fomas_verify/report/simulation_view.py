"""The closed loop from the design's own x_0, enclosed, against what is certified of it.

At the samples ``x_(k+1) = P x_k`` and ``u_k = -gamma sum_(j<=k) r_(k-j) L x_j``; between them
``x(t_k + s) = x_0 + m sum_(j<=k) w_(k-j) u_j`` with ``w_0 = (s/h)^alpha``,
``w_n = (n + s/h)^alpha - (n - 1 + s/h)^alpha``.
Every point is the middle of an enclosure narrower than a line, the same on every machine; no floats are used.
Source: theory, sections 1 and 3.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

from fomas_verify.enclosure.interval import Interval
from fomas_verify.enclosure.real import Ball, power, square_root, to_ball, to_interval, working_precision
from fomas_verify.enclosure.trajectory import product_of
from fomas_verify.exact import matrix as exact
from fomas_verify.kernel.memory import one_step_weight, resolvent
from fomas_verify.prover import Proof
from fomas_verify.report.latex_text import Tex
from fomas_verify.report.plot import Column, Curve, Plot, Table, decades, with_room
from fomas_verify.spectrum.loop import Loop

LAST = 50
BETWEEN = 3
MOST_CURVES = 10
STATES_FILE, SIZES_FILE = "states.csv", "sizes.csv"
_BITS = 512
_DIVERGED = 1000
"""A loop that is not stable is drawn until a number passes so many times the largest of x_0."""

States = list[list[Interval]]
"""For each number an agent has: the agents' values."""


@dataclass(frozen=True)
class SimulationView:
    """The figures; ``tables`` are their data. ``at_start`` is norm u_0 and ``largest`` the largest norm u_k shown."""

    last: int
    states: Plot
    distance: Plot | None
    control: Plot | None
    tables: tuple[Table, ...]
    largest: Interval | None
    largest_at: int
    at_start: Interval | None
    curves: int
    numbers: int


def simulation_view(proof: Proof) -> SimulationView | None:
    """The trajectory of a design with an initial state; None without one. Rigorous up to drawing."""
    design, loop = proof.design, proof.loop
    if design.components is None:
        return None
    states = _samples(loop, [list(row) for row in design.components])
    inputs = _inputs(loop, states)
    dense, times = _dense(loop, states, inputs)
    states_plot, states_table = _states(design.h, dense, times)
    sizes, distance, control = _sizes(proof, states, inputs)
    norms = [] if inputs is None else [_norm(u) for u in inputs]
    at = max(range(len(norms)), key=lambda k: norms[k].mid) if norms else 0
    return SimulationView(
        len(states) - 1, states_plot, distance, control, (states_table, sizes), norms[at] if norms else None, at,
        norms[0] if norms else None, len(states_plot.curves), sum(map(len, states[0])),
    )  # fmt: skip


def _samples(loop: Loop, rows: list[list[Fraction]]) -> list[States]:
    """``x_0, x_1, ...``."""
    mu, laplacian = loop.mu(_BITS).shortened(_BITS), exact.to_rows(loop.laplacian)
    heard = [[(j, a) for j, a in enumerate(row) if a] for row in laplacian]
    found: list[States] = [[[Interval.exactly(x).shortened(_BITS) for x in row] for row in rows]]
    most = max(abs(x) for row in rows for x in row) * _DIVERGED
    for _ in range(LAST):
        x = found[-1]
        e = [_applied(heard, row) for row in x]
        following = [
            [(a - mu * b).shortened(_BITS) for a, b in zip(old, error, strict=True)]
            for old, error in zip(x, e, strict=True)
        ]
        if max(abs(y.mid) for row in following for y in row) > most:
            break
        found.append(following)
    return found


def _applied(rows: list[list[tuple[int, Fraction]]], x: list[Interval]) -> list[Interval]:
    return [sum((x[j] * a for j, a in row), Interval.exactly(0)) for row in rows]


def _inputs(loop: Loop, states: list[States]) -> list[States] | None:
    """``u_0, u_1, ...``; None where the design gives no gamma."""
    gamma, count = loop.design.gamma, len(states)
    if gamma is None:
        return None
    rows = [[(j, a) for j, a in enumerate(row) if a] for row in exact.to_rows(loop.laplacian)]
    errors = [[_applied(rows, row) for row in x] for x in states]
    with working_precision(_BITS):
        r = [to_ball(x) for x in resolvent(loop.design.alpha, count, _BITS)]
    return _convolved(r, errors, -gamma)


def _convolved(kernel: Sequence[Ball], series: list[States], factor: Interval | Fraction) -> list[States]:
    """``factor sum_j kernel_(k-j) series_j`` for every k and every number."""
    count, found = len(series), [[list(row) for row in x] for x in series]
    for d, row in enumerate(series[0]):
        for i in range(len(row)):
            with working_precision(_BITS):
                values = product_of([to_ball(x[d][i]) for x in series], list(kernel)[:count], _BITS)
                for k in range(count):
                    found[k][d][i] = (to_interval(values[k]) * factor).rounded(_BITS)
    return found


def _dense(loop: Loop, states: list[States], inputs: list[States] | None) -> tuple[list[States], list[Fraction]]:
    """The states at the samples and, where h and gamma are given, at three points between; times in periods."""
    times = [Fraction(k) for k in range(len(states))]
    design = loop.design
    if inputs is None or design.h is None or len(states) == 1:
        return states, times
    weight, count = one_step_weight(design.alpha, design.h, _BITS), len(states) - 1
    points: dict[Fraction, States] = dict(zip(times, states, strict=True))
    for share in (Fraction(i, BETWEEN + 1) for i in range(1, BETWEEN + 1)):
        powers = [power(n + share, design.alpha, _BITS) for n in range(count)]
        with working_precision(_BITS):
            w = [to_ball(x) for x in (powers[0], *(b - a for a, b in pairwise(powers)))]
        for k, moved in enumerate(_convolved(w, inputs[:count], weight)):
            start = states[0]
            points[k + share] = [[a + b for a, b in zip(x, y, strict=True)] for x, y in zip(start, moved, strict=True)]
    return [points[t] for t in sorted(points)], sorted(points)


def _states(h: Fraction | None, dense: list[States], times: list[Fraction]) -> tuple[Plot, Table]:
    names = [(d, i) for d, row in enumerate(dense[0]) for i in range(len(row))]
    step = -(-len(names) // MOST_CURVES)
    shown, several = names[::step], len(dense[0]) > 1
    columns: dict[str, Column] = {"t" if h else "k": [t * (h or 1) for t in times]}
    curves = []
    for color, (d, i) in enumerate(shown):
        column = f"x{i + 1}_{d + 1}" if several else f"x{i + 1}"
        columns[column] = [x[d][i].mid for x in dense]
        label = rf"$x_{{{i + 1},{d + 1}}}$" if several else rf"$x_{{{i + 1}}}$"
        curves.append(Curve(column, "line", color, Tex(label)))
    values = [y for column, ys in columns.items() if column not in "tk" for y in ys if y is not None]
    table, x = Table(STATES_FILE, columns), "t" if h else "k"
    plot = Plot(
        Tex("states"), "t [s]" if h else "k", (Fraction(0), times[-1] * (h or 1) or Fraction(1)),
        with_room(min(values), max(values)), table, x, tuple(curves),
    )  # fmt: skip
    return plot, table


def _norm(x: States) -> Interval:
    return square_root(sum((y * y for row in x for y in row), Interval.exactly(0)), 256)


def _sizes(proof: Proof, states: list[States], inputs: list[States] | None) -> tuple[Table, Plot | None, Plot | None]:
    """Distance from agreement and size of the control at the samples, each with its certified bound."""
    count = len(states)
    columns: dict[str, Column] = {"k": [Fraction(k) for k in range(count)]}
    distance_curves, control_curves = [], []
    if proof.loop.assumption1:
        distance_curves = _distance_columns(proof, states, columns)
    if inputs is not None:
        norms = [_norm(u).mid for u in inputs]
        columns["control"] = norms
        control_curves.append(Curve("control", "dots", 0, Tex(r"$\lVert u_k\rVert$")))
        columns["control_start"] = [norms[0]] * count
        control_curves.append(Curve("control_start", "guide", 0, Tex(r"$\lVert u_0\rVert$")))
        if proof.sizes.peak is not None:
            columns["control_peak"] = [norms[0] * proof.sizes.peak.value.upper] * count
            control_curves.append(Curve("control_peak", "guide", 1, Tex(r"$\mathit{peak}\,\lVert u_0\rVert$")))
    table = Table(SIZES_FILE, columns, small=True)
    distance = _against_k("distance from agreement", table, distance_curves, log=True)
    return table, distance, _against_k("control", table, control_curves, log=False)


def _distance_columns(proof: Proof, states: list[States], columns: dict[str, Column]) -> list[Curve]:
    """``norm(x_k - mean)`` with ``sigma^k`` and ``kappa rho^k`` times its start."""
    means = [sum((y.mid for y in row), Fraction(0)) / len(row) for row in states[0]]
    away = [_norm([[y - mean for y in row] for row, mean in zip(x, means, strict=True)]).mid for x in states]
    if not away[0]:
        return []
    columns["distance"] = [x if x > away[0] / 10**60 else None for x in away]
    curves = [Curve("distance", "dots", 0, Tex(r"$\lVert x_k-\bar x\rVert$"))]
    envelopes = [("by_sigma", Tex(r"$\sigma^k\lVert x_0-\bar x\rVert$"), Fraction(1), proof.values["sigma"].upper)]
    if (rate := proof.sizes.rate) is not None:
        envelopes.append(("by_rate", Tex(r"$\kappa\rho^k\lVert x_0-\bar x\rVert$"), rate.kappa, rate.rho))
    for color, (column, label, factor, base) in enumerate(envelopes):
        if base <= 1:
            columns[column] = [away[0] * factor * Fraction(base) ** k for k in range(len(states))]
            curves.append(Curve(column, "guide", color, label))
    return curves


def _against_k(title: str, table: Table, curves: list[Curve], *, log: bool) -> Plot | None:
    values = [y for curve in curves for y in table.columns[curve.column] if y is not None and (y > 0 or not log)]
    if not values or (log and max(values) <= 0):
        return None
    y_range = decades(values) if log else with_room(Fraction(0), max(values))
    last = Fraction(len(table.columns["k"]))
    return Plot(Tex(title), "k", (Fraction(-1), last), y_range, table, "k", tuple(curves), y_log=log)
