"""A trajectory against what is certified of the design, and against the plant itself.

For the paper's law tuned for the plant's alpha the certificate bounds every sample: limit (the mean, which the loop
keeps), envelope, settling, control and overshoot. A trajectory of any law must be the one that its own inputs drive the
plant along. Float arithmetic decides here, with a tolerance far above its own error, so this finds mistakes and proves
nothing.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from fomas_verify.enclosure.interval import Interval
from fomas_verify.enclosure.reference import DisagreementError
from fomas_verify.simulate.memory import Array
from fomas_verify.simulate.plant import Plant
from fomas_verify.simulate.trajectory import Trajectory, distance

TOLERANCE = 1e-9
"""Share of the largest number of its kind in the trajectory."""


@dataclass(frozen=True)
class Bounds:
    """Certified of a design; None where a thing does not exist or was not found.

    ``limit``: what every x_i tends to, a number for each component. ``kappa``, ``rho``: ``norm(x_k - limit) <= kappa
    rho^k norm(x_0 - limit)``. ``settling``: the sample from which on ``norm(x_k - limit) <= settle_to norm(x_0 -
    limit)``. ``peak``: of ``norm u_k / norm u_0``. ``reach``: of ``norm u_k``. ``overshoot``: of ``norm(x(t) - x_k)``
    inside an interval.
    """

    limit: tuple[Fraction, ...]
    kappa: Fraction | None = None
    rho: Fraction | None = None
    settle_to: Fraction | None = None
    settling: int | None = None
    peak: Interval | None = None
    reach: Interval | None = None
    overshoot: Interval | None = None

    @property
    def limit_floats(self) -> Array:
        """The limit in floats."""
        return np.array([float(x) for x in self.limit])


@dataclass(frozen=True)
class Comparison:
    """One thing compared: ``worst`` is the sample where ``measured`` stands highest against ``bound``."""

    name: str
    worst: int
    measured: float
    bound: float
    holds: bool


def check_against(run: Trajectory, bounds: Bounds) -> list[Comparison]:
    """Compare a trajectory of the paper's law with what is certified.

    Raises
    ------
    DisagreementError
        Something lies outside of its bound by more than 1e-9 of the largest number of its kind.
    """
    found = list(_comparisons(run, bounds))
    for x in found:
        if not x.holds:
            raise DisagreementError(
                f"{run.controller}: {x.name} is {x.measured:.12g} at k = {x.worst}, certified is at most {x.bound:.12g}"
            )
    return found


def check_driven(plant: Plant, run: Trajectory) -> None:
    """Raise `DisagreementError` where the plant, driven by the trajectory's inputs, goes elsewhere."""
    reached = plant.driven_by(run.inputs[..., :-1])
    with np.errstate(over="ignore", invalid="ignore"):
        apart = np.max(np.abs(reached - run.states[..., 1:]), axis=(0, 1))
        allowed = TOLERANCE * np.maximum.accumulate(np.max(np.abs(run.states), axis=(0, 1)))[1:]
    if not (apart <= allowed).all():
        k = int(np.argmin(apart <= allowed)) + 1
        raise DisagreementError(
            f"{run.controller}: the closed loop and the plant driven by its inputs are {apart[k - 1]:.3g} apart "
            f"at k = {k}"
        )


def check_same(run: Trajectory, states: Array, what: str) -> None:
    """Raise `DisagreementError` where the states (N, n, samples) of a second computation are others."""
    count = min(run.last + 1, states.shape[-1])
    apart = np.max(np.abs(run.states[..., :count] - states[..., :count]), axis=(0, 1))
    allowed = TOLERANCE * np.maximum.accumulate(np.max(np.abs(run.states[..., :count]), axis=(0, 1)))
    if not (apart <= allowed).all():
        k = int(np.argmin(apart <= allowed))
        raise DisagreementError(f"{run.controller}: floats and {what} are {apart[k]:.3g} apart at k = {k}")


def _comparisons(run: Trajectory, bounds: Bounds) -> Iterator[Comparison]:
    off, control = distance(run.states, bounds.limit_floats), run.input_norms
    samples, slack = np.arange(run.last + 1), TOLERANCE * float(np.max(np.abs(run.states)))
    mean = np.max(np.abs(run.states.mean(axis=0) - bounds.limit_floats[:, None]), axis=0)
    yield _compare("mean(x_k) - limit", mean, np.zeros_like(mean), slack)
    if bounds.kappa is not None and bounds.rho is not None:
        envelope = off[0] * np.minimum(float(bounds.kappa) * float(bounds.rho) ** samples, 1e300)
        yield _compare("norm(x_k - limit)", off, envelope, slack)
    if bounds.settling is not None and bounds.settle_to is not None and bounds.settling <= run.last:
        settled = np.full(run.last + 1, np.inf)
        settled[bounds.settling :] = float(bounds.settle_to) * off[0]
        yield _compare("norm(x_k - limit) once settled", off, settled, slack)
    for name, bound in (("by peak", bounds.peak), ("by reach", bounds.reach)):
        if bound is not None:
            most = float(bound.upper) * (control[0] if bound is bounds.peak else 1.0)
            yield _compare(f"norm u_k {name}", control, np.full_like(control, most), TOLERANCE * float(control.max()))
    if bounds.overshoot is not None and run.between.size:
        moved = np.sqrt(np.sum((run.between - run.states[None, ..., :-1]) ** 2, axis=(1, 2))).max(axis=0)
        yield _compare("norm(x(t) - x_k)", moved, np.full_like(moved, float(bounds.overshoot.upper)), slack)


def _compare(name: str, measured: Array, bound: Array, slack: float) -> Comparison:
    excess = measured - bound
    worst = int(np.argmax(np.where(np.isnan(excess), np.inf, excess)))
    return Comparison(name, worst, float(measured[worst]), float(bound[worst]), bool((excess <= slack).all()))
