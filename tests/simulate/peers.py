"""The same trajectory by pycaputo and by fodeint, steppers for any fractional equation.

Both hold the right side over a step, so their explicit Euler methods are the sampled plant exactly; a law with memory
is a right side that remembers its own past.
"""

from collections.abc import Callable
from fractions import Fraction
from typing import Any

import numpy as np

RightSide = Callable[[float, np.ndarray], np.ndarray]


def right_side(design: dict[str, Any], samples: int, memory: int | None) -> RightSide:
    """``u`` at time t and state x, its own past inputs kept by sample."""
    agents = design["graph"]["agents"]
    laplacian = np.zeros((agents, agents))
    for source, to, weight in design["graph"]["edges"]:
        laplacian[to - 1, source - 1] -= float(weight)
        laplacian[to - 1, to - 1] += float(weight)
    alpha, gamma, h = (float(Fraction(design[key])) for key in ("alpha", "gamma", "h"))
    gain = -gamma * laplacian
    if memory == 0:
        return lambda t, x: gain @ x
    j = np.arange(1, samples + 1, dtype=float)
    f = (j + 1) ** alpha - 2 * j**alpha + (j - 1) ** alpha
    inputs = np.zeros((samples + 1, agents))

    def u(t: float, x: np.ndarray) -> np.ndarray:
        k = round(t / h)
        kept = k if memory is None else min(k, memory)
        inputs[k] = gain @ x
        if kept:
            inputs[k] -= f[:kept] @ inputs[k - kept : k][::-1]
        return inputs[k]

    return u


def by_fodeint(design: dict[str, Any], samples: int, memory: int | None) -> np.ndarray:
    """States (agents, samples + 1)."""
    from fodeint import caputoEuler

    alpha, h = float(Fraction(design["alpha"])), float(Fraction(design["h"]))
    u = right_side(design, samples, memory)
    times = np.arange(samples + 1) * h
    return caputoEuler(alpha, lambda x, t: u(t, x).copy(), np.array([float(x) for x in design["x0"]]), times).T


def by_pycaputo(design: dict[str, Any], samples: int, memory: int | None) -> np.ndarray:
    """States (agents, samples + 1); the step is fixed only by ``dtinit``."""
    from pycaputo.controller import make_fixed_controller
    from pycaputo.derivatives import CaputoDerivative
    from pycaputo.events import StepCompleted
    from pycaputo.fode.caputo import ForwardEuler
    from pycaputo.stepping import evolve

    alpha, h = float(Fraction(design["alpha"])), float(Fraction(design["h"]))
    u = right_side(design, samples + 1, memory)
    x0 = np.array([float(x) for x in design["x0"]])
    method = ForwardEuler(
        ds=tuple(CaputoDerivative(alpha) for _ in x0),
        control=make_fixed_controller(h, tstart=0.0, nsteps=samples),
        source=lambda t, x: u(t, x).copy(),
        y0=(x0,),
    )
    return np.array([event.y for event in evolve(method, dtinit=h) if isinstance(event, StepCompleted)]).T
