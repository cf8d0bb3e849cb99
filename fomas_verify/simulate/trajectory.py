"""What a simulation gives: states and inputs at the samples, and states between them."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from fomas_verify.simulate.memory import Array


@dataclass(frozen=True, eq=False)
class Trajectory:
    """One controller's closed loop.

    Attributes
    ----------
    controller : str
        Its name.
    h : float
        Sampling period in seconds: sample k is at ``t = k h``.
    states, inputs : array
        Shape (N, n, samples): ``x_k`` and the ``u_k`` held from there on.
    between : array
        Shape (M, N, n, samples - 1): the state at the M points ``t = k h + i h / (M + 1)`` of each interval.
    stopped : bool
        Whether it ends early, before its numbers overflow.
    """

    controller: str
    h: float
    states: Array
    inputs: Array
    between: Array = field(default_factory=lambda: np.empty((0, 0, 0, 0)))
    stopped: bool = False

    @property
    def last(self) -> int:
        """The last sample k."""
        return int(self.states.shape[-1]) - 1

    @property
    def input_norms(self) -> Array:
        """``norm u_k`` for every k."""
        found: Array = np.sqrt(np.sum(self.inputs**2, axis=(0, 1)))
        return found

    def mean_absolute_error(self, limit: Array) -> Array:
        """``r_k = (1/N) sum_i abs(x_i - limit)`` at the samples; for n numbers an agent, the mean over these too."""
        return mean_distance(self.states, limit)


def mean_distance(states: Array, limit: Array) -> Array:
    """``mean abs(x_i - limit)`` over agents and their numbers, for states of shape (..., N, n, samples)."""
    found: Array = np.mean(np.abs(states - limit[None, :, None]), axis=(-3, -2))
    return found


def distance(states: Array, limit: Array) -> Array:
    """``norm(x_k - limit)`` for every k, states of shape (N, n, samples)."""
    found: Array = np.sqrt(np.sum((states - limit[None, :, None]) ** 2, axis=(0, 1)))
    return found
