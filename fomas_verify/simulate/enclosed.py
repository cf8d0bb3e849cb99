"""The trajectory as a tube that contains the true one: floats propose, ball arithmetic bounds what they leave.

Rigorous for the design's exact numbers, whatever the floats were; source: `fomas_verify.enclosure.trajectory`.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from fomas_verify.design import Design
from fomas_verify.enclosure.interval import Interval
from fomas_verify.enclosure.trajectory import (
    Enclosure,
    LinearLoop,
    law_response,
    one,
    product_of,
    step_responses,
)
from fomas_verify.kernel.memory import one_step_weight
from fomas_verify.simulate.convolution import Progress
from fomas_verify.simulate.errors import NoEnclosureError
from fomas_verify.simulate.laws import Law
from fomas_verify.simulate.loop import solve
from fomas_verify.simulate.memory import Array
from fomas_verify.simulate.plant import Plant, plant_of

DIGITS = 40
LOG10_2 = 0.301
MOST_ROUNDS = 64

MOST_WORK = 10_000_000
"""Bound on samples times agents squared: minutes."""

Numbers = list[list[list[Interval]]]


@dataclass(frozen=True)
class Tube:
    """Enclosures of a trajectory: ``states`` and ``inputs`` by agents, their numbers and samples k = 0..K.

    ``between``: for each of M shares the same for ``x(t_k + i h / (M + 1))``, k = 0..K-1.
    """

    controller: str
    h: Fraction
    states: Numbers
    inputs: Numbers
    between: list[Numbers]

    @property
    def widest(self) -> Fraction:
        """The largest width among states and inputs, between the samples included."""
        parts = [self.states, self.inputs, *self.between]
        return max(x.width for part in parts for row in part for xs in row for x in xs)


def enclose(
    design: Design,
    law: Law,
    samples: int,
    *,
    alpha_controller: Fraction | None = None,
    between: int = 0,
    digits: int = DIGITS,
    progress: Progress | None = None,
) -> Tube:
    """Enclose the trajectory of a linear law at the samples k = 0..K, and at M points between.

    Parameters
    ----------
    design, law, samples, alpha_controller : as in `simulate`
        Exact: the tube is about the design itself, not about its nearest floats.
    between : int
        Points inside each sampling interval.
    digits : int
        The states' error is brought below ``10^-digits`` of the largest entry of x_0.
    progress : function, optional
        Told the digits that are right.

    Returns
    -------
    Tube
        Rigorous.

    Raises
    ------
    NoEnclosureError
        The loop grows too fast over so many samples, or there is more to do than the work allowed.
    """
    plant = plant_of(design)
    if design.graph.agents**2 * (samples + 1) > MOST_WORK:
        raise NoEnclosureError(
            f"{design.source}: no enclosure of {samples} samples of {design.graph.agents} agents: "
            f"samples times agents squared may be {MOST_WORK} at most"
        )
    bits = int(3.33 * digits) + 2 * samples.bit_length() + 64
    loop = _linear_loop(design, law, samples, design.alpha if alpha_controller is None else alpha_controller, bits)
    kernel = np.array([float(x) for x in loop.kernel])
    enclosure = Enclosure(loop, bits)
    largest = max(abs(x) for row in loop.x0 for x in row)
    inverted = enclosure.bound_inverse(_impulse(plant, kernel, samples + 1))
    if not (inverted and _refined(enclosure, plant, kernel, largest, digits, progress)):
        raise NoEnclosureError(
            f"{design.source}: {law.name}: no enclosure found over {samples} samples: the loop grows"
        )
    shares = [Fraction(i, between + 1) for i in range(1, between + 1)]
    inside = [enclosure.between(step_responses(design.alpha, samples, bits, share)) for share in shares]
    cut = [[[xs[:samples] for xs in row] for row in part] for part in inside]
    return Tube(law.name, design.h or Fraction(0), enclosure.states(), enclosure.inputs(), cut)


def _refined(
    enclosure: Enclosure, plant: Plant, kernel: Array, largest: Fraction, digits: int, progress: Progress | None
) -> bool:
    """Correct until the error is below so many digits of the largest; False where it stops shrinking before."""
    target = largest / 10**digits
    for _ in range(MOST_ROUNDS):
        before = enclosure.radius
        correction = np.array(enclosure.defects())
        solve(plant, kernel, correction)
        if not np.isfinite(correction).all():
            return False
        enclosure.correct(correction.tolist())
        after = enclosure.radius
        if progress is not None and after:
            progress(min(digits, int(LOG10_2 * int(largest / after).bit_length())))
        if before is None or after is None or after <= target:
            return after is not None
        if after > before / 2:
            return False
    return False


def _impulse(plant: Plant, kernel: Array, count: int) -> list[list[list[float]]]:
    """The loop's response to an impulse at each agent, approximately: ``[i][j]`` over the samples."""
    agents = len(plant.x0)
    response = np.zeros((agents, agents, count))
    response[..., 0] = np.eye(agents)
    solve(plant, kernel, response)
    found: list[list[list[float]]] = response.tolist()
    return found


def _linear_loop(design: Design, law: Law, samples: int, tuned: Fraction, bits: int) -> LinearLoop:
    if design.x0 is None or design.h is None:
        raise TypeError("a trajectory needs x0 and h")
    count, weight = samples + 1, one_step_weight(design.alpha, design.h, bits)
    mu = weight * design.gamma if design.gamma is not None else Interval.exactly(design.mu or 0)
    gamma = Interval.exactly(design.gamma) if design.gamma is not None else mu / weight
    response = law_response(step_responses(tuned, count, bits), law.memory, bits)
    if law.memory is None and tuned == design.alpha:
        kernel = one(count)
    else:
        kernel = product_of(step_responses(design.alpha, count, bits), response, bits)
    edges = tuple((target - 1, source - 1, weight) for source, target, weight in design.graph.edges)
    return LinearLoop(edges, design.x0, mu, gamma, weight, kernel, response)
