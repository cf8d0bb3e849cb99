"""The data of the figures: the paper's six for its design, and two more that the theory asks for.

States, ``u^T u``, left side of (14) [eqT2] over k, states and ``u^T u`` under the other controllers, mean absolute
error r; then r(t) also between the samples, where it decays like ``t^(-1-alpha)`` although it is geometric at them,
and ``norm u_k`` against what is certified of it. Source: the paper's section on simulation; theory, sections 3 and 6.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from fomas_verify.simulate.against import Bounds
from fomas_verify.simulate.memory import Array, approx_step_response
from fomas_verify.simulate.trajectory import Trajectory, mean_distance

MOST_POINTS = 4000
"""Points of a curve; more are thinned out."""

MOST_CURVES = 24
"""Agents' numbers drawn in one figure, evenly chosen where there are more."""

ROUNDING = 1e-13
"""Share of the largest x_0 below which a float result is rounding only and is not drawn on a logarithmic axis."""


@dataclass(frozen=True)
class Curve:
    """``y`` over ``x``; style: ``line``, ``steps`` (held until the next x), ``points`` or ``guide`` (dashed). Equal
    colors belong together.
    """

    label: str
    x: Array
    y: Array
    style: str = "line"
    color: int | None = None


@dataclass(frozen=True)
class Panel:
    """One figure; its name is that of its file. ``legend``: beside the axes, below them, or inside where room is."""

    name: str
    title: str
    x_label: str
    y_label: str
    curves: tuple[Curve, ...]
    logarithmic: bool = False
    legend: Literal["inside", "beside", "below"] = "inside"


def panels(
    runs: Sequence[Trajectory], alpha: float, limit: Array | None, beta: float | None, bounds: Bounds | None
) -> Iterator[Panel]:
    """Every figure whose data exists.

    Parameters
    ----------
    runs : sequence of Trajectory
        With states between the samples.
    alpha : float
        The plant's order.
    limit : array or None
        What every agent tends to, for the mean absolute error.
    beta : float or None
        ``1 - mu lambda2``, for (14).
    bounds : Bounds or None
        Certified of the paper's law.
    """
    for run in runs:
        yield _states(run)
        yield _energy(run)
    if beta is not None and abs(beta) <= 1:
        yield _memory_inequality(alpha, beta, min(run.last for run in runs))
    if limit is not None:
        yield _errors(runs, limit)
        yield _between_samples(runs, limit, alpha, guided=bounds is not None)
    for run in runs:
        if run.controller == "proposed" and bounds is not None and bounds.peak is not None:
            yield _control(run, bounds)


def _times(run: Trajectory) -> Array:
    found: Array = np.arange(run.last + 1, dtype=np.float64) * run.h
    return found


def _dense(run: Trajectory) -> tuple[Array, Array]:
    """Times and states (N, n, times), at the samples and between them in order."""
    points = len(run.between)
    states = np.concatenate([run.states[None, ..., :-1], run.between]) if points else run.states[None, ..., :-1]
    shares = np.arange(points + 1)[:, None] / (points + 1)
    times = (np.arange(run.last)[None, :] + shares) * run.h
    ordered = np.moveaxis(states, 0, -1).reshape(*run.states.shape[:-1], -1)
    return np.append(times.T.reshape(-1), run.last * run.h), np.concatenate([ordered, run.states[..., -1:]], axis=-1)


def _thinned(count: int, *, logarithmic: bool = False) -> np.ndarray:
    if count <= MOST_POINTS:
        return np.arange(count)
    spread = np.geomspace(1, count, MOST_POINTS) - 1 if logarithmic else np.linspace(0, count - 1, MOST_POINTS)
    return np.unique(spread.astype(int))


def _states(run: Trajectory) -> Panel:
    times, states = _dense(run)
    chosen, (agents, numbers) = _thinned(len(times)), states.shape[:2]
    shown = np.unique(np.linspace(0, agents * numbers - 1, min(agents * numbers, MOST_CURVES)).astype(int))
    curves = []
    for i in shown:
        agent, number = divmod(int(i), numbers)
        label = f"$x_{{{agent + 1}}}$" if numbers == 1 else f"$x_{{{agent + 1},{number + 1}}}$"
        curves.append(Curve(label, times[chosen], states[agent, number, chosen]))
    title = f"States under the {run.controller} controller"
    return Panel(f"states-{run.controller}", title, "$t$ [s]", "$x_i(t)$", tuple(curves), legend="beside")


def _energy(run: Trajectory) -> Panel:
    chosen = _thinned(run.last + 1)
    curve = Curve("$u^T u$", _times(run)[chosen], run.input_norms[chosen] ** 2, "steps")
    title = f"$u^T u$ of the {run.controller} controller"
    return Panel(f"control-energy-{run.controller}", title, "$t$ [s]", "$u^T u$", (curve,))


def _memory_inequality(alpha: float, beta: float, last: int) -> Panel:
    k = np.arange(last + 1)[_thinned(last + 1)]
    left = beta ** (k + 1.0) + 1 - approx_step_response(alpha, last + 2)[k + 1]
    curves = (
        Curve(r"$\beta^{k+1} + \sum_{l=1}^{k+1} |f(l)|$", k.astype(float), left, "points"),
        Curve("1", k.astype(float), np.ones(len(k)), "guide"),
    )
    return Panel("memory-inequality", "Left side of inequality (14)", "$k$", "left side", curves)


def _errors(runs: Sequence[Trajectory], limit: Array) -> Panel:
    curves = []
    for run in runs:
        times, states = _dense(run)
        chosen = _thinned(len(times))
        curves.append(Curve(run.controller, times[chosen], mean_distance(states[..., chosen], limit)))
    return Panel("mean-absolute-error", "Mean absolute error", "$t$ [s]", "$r(t)$", tuple(curves))


def _between_samples(runs: Sequence[Trajectory], limit: Array, alpha: float, *, guided: bool) -> Panel:
    curves = []
    for color, run in enumerate(runs):
        floor = ROUNDING * float(np.max(np.abs(run.states[..., 0])))
        chosen = _thinned(run.last, logarithmic=True)
        at = run.mean_absolute_error(limit)[1:][chosen]
        times, label = (chosen + 1) * run.h, f"{run.controller}, at samples"
        curves.append(Curve(label, times, above(at, floor), "points", color))
        if len(run.between):
            inside = mean_distance(run.between, limit).max(axis=0)[chosen]
            label = f"{run.controller}, between"
            curves.append(Curve(label, (chosen + 0.5) * run.h, above(inside, floor), color=color))
        power = {"proposed": 1 + alpha, "memoryless": alpha}.get(run.controller)
        if power is not None and guided and curves[-1].style == "line" and curves[-1].y[-1] < curves[-1].y[0]:
            name = r"$t^{-1-\alpha}$" if power > 1 else r"$t^{-\alpha}$"
            curves.append(_guide(name, curves[-1], power, color))
    title = "Mean absolute error at the samples and between them"
    return Panel("between-samples", title, "$t$ [s]", "$r(t)$", tuple(curves), logarithmic=True, legend="below")


def above(y: Array, floor: float) -> Array:
    """The same without what is only rounding."""
    return np.where(y > floor, y, np.nan)


def _guide(label: str, curve: Curve, power: float, color: int) -> Curve:
    """A line of the slope that theory predicts, twice above the curve at its end."""
    shown = np.geomspace(max(curve.x[-1] / 4, curve.x[0]), curve.x[-1], 2)
    return Curve(label, shown, 2 * curve.y[-1] * (shown / shown[-1]) ** -power, "guide", color)


def _control(run: Trajectory, bounds: Bounds) -> Panel:
    chosen, norms = _thinned(run.last + 1), run.input_norms
    times = _times(run)[chosen]
    curves = [Curve(r"$\Vert u_k \Vert$", times, norms[chosen], "points")]
    if bounds.peak is not None:
        peak = float(bounds.peak.upper) * norms[0]
        curves.append(Curve(r"peak times $\Vert u_0 \Vert$, certified", times, np.full(len(times), peak), "guide"))
    return Panel("control-peak", "Control against its certified peak", "$t$ [s]", r"$\Vert u_k \Vert$", tuple(curves))
