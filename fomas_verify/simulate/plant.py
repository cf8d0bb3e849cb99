"""The agents and their graph in binary floats: the plant that a controller drives.

Between two samples the control is held, so the Caputo equation's Volterra form is exact at every time (labels eqxik_1,
equki): ``x(t_k + s) = x_0 + m sum_{j<=k} w_{k-j} u_j`` with ``m = h^alpha / Gamma(alpha + 1)`` and w the response of
the memory a share s/h of a period after a sample; s = h gives ``x_{k+1}``. Source: theory, section 1.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np
from scipy import sparse

from fomas_verify.design import Design
from fomas_verify.kernel.memory import one_step_weight
from fomas_verify.simulate.convolution import approx_product
from fomas_verify.simulate.errors import SimulationError
from fomas_verify.simulate.memory import Array, approx_step_response

BITS = 128
DENSE_AGENTS = 64


@dataclass(frozen=True, eq=False)
class Plant:
    """A design's numbers as the nearest binary floats.

    Attributes
    ----------
    alpha, gamma, h, weight : float
        Order, gain, period in seconds, and ``m = h^alpha / Gamma(alpha + 1)``.
    laplacian : array or sparse array
        L, N x N: row i belongs to agent i, who hears agent j where ``a_ij > 0``; sparse beyond 64 agents.
    x0 : array
        N x n: for each agent its n numbers.
    """

    alpha: float
    gamma: float
    h: float
    weight: float
    laplacian: Any
    x0: Array

    @property
    def mu(self) -> float:
        """The integrated gain."""
        return self.gamma * self.weight

    def error(self, x: Array) -> Array:
        """``e = L x`` for states of shape (N, n) or (N, n, samples)."""
        found: Array = (self.laplacian @ x.reshape(len(x), -1)).reshape(x.shape)
        return found

    def driven_by(self, inputs: Array, share: float = 1.0) -> Array:
        """The state a share of a period, 0 < share <= 1, after each sample, for inputs of shape (N, n, samples)."""
        response = approx_step_response(self.alpha, inputs.shape[-1], share)
        return self.x0[:, :, None] + self.weight * approx_product(response, inputs)


def plant_of(design: Design) -> Plant:
    """The plant of a design.

    Raises
    ------
    DesignError
        The design gives no x0, no h, or neither gamma nor mu.
    SimulationError
        One of its numbers is beyond doubles.
    """
    design.needs("x0", command="simulate")
    design.needs("h", command="simulate")
    design.needs("mu", command="simulate")
    if design.x0 is None or design.h is None:
        raise TypeError("a plant needs x0 and h")
    weight = one_step_weight(design.alpha, design.h, BITS).mid
    gamma = design.gamma if design.gamma is not None else (design.mu or Fraction(0)) / weight
    try:
        x0 = np.array([[float(x) for x in row] for row in design.x0])
        laplacian = _laplacian(design)
        return Plant(float(design.alpha), float(gamma), float(design.h), float(weight), laplacian, x0)
    except OverflowError:
        raise SimulationError(
            f"{design.source}: simulate needs numbers below 1e308: one of x0, gamma, h, h^alpha and the weights is not"
        ) from None


def _laplacian(design: Design) -> Any:
    size = design.graph.agents
    degrees = [Fraction(0)] * size
    for _, target, weight in design.graph.edges:
        degrees[target - 1] += weight
    entries = [(target - 1, source - 1, -float(weight)) for source, target, weight in design.graph.edges]
    entries += [(i, i, float(degree)) for i, degree in enumerate(degrees)]
    rows, columns, values = zip(*entries, strict=True)
    found = sparse.csr_array((values, (rows, columns)), shape=(size, size))
    return found.toarray() if size <= DENSE_AGENTS else found
