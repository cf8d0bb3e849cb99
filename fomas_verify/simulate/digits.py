"""The trajectory to many digits, by mpmath."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from fomas_verify.design import Design
from fomas_verify.enclosure.approx_trajectory import LoopNumbers, Texts, approx_trajectory
from fomas_verify.simulate.convolution import Progress
from fomas_verify.simulate.errors import SimulationError
from fomas_verify.simulate.laws import Law

MOST_WORK = 10**9
"""Bound on agents' numbers times the square of the samples: about half an hour."""


@dataclass(frozen=True)
class LongTrajectory:
    """Decimals of so many digits by agents, their numbers and samples; ``between`` as in `Trajectory`."""

    controller: str
    h: Fraction
    states: Texts
    inputs: Texts
    between: list[Texts]


def simulate_to(
    design: Design,
    law: Law,
    samples: int,
    digits: int,
    *,
    alpha_controller: Fraction | None = None,
    between: int = 0,
    progress: Progress | None = None,
) -> LongTrajectory:
    """The loop of a linear law to ``digits`` digits, by its definition; approximate, and quadratic in the samples.

    Raises
    ------
    SimulationError
        There is more to do than the work allowed.
    """
    if design.x0 is None or design.h is None:
        raise TypeError("a trajectory needs x0 and h")
    edges = tuple((target - 1, source - 1, weight) for source, target, weight in design.graph.edges)
    if samples**2 * len(design.x0) * len(design.x0[0]) > MOST_WORK:
        raise SimulationError(
            f"{design.source}: {samples} samples of {design.graph.agents} agents are too many for mpmath: "
            f"agents times the square of the samples may be {MOST_WORK} at most"
        )
    tuned = design.alpha if alpha_controller is None else alpha_controller
    loop = LoopNumbers(
        design.alpha, tuned, design.h, design.gamma, design.mu, edges, design.x0, law.memory
    )  # fmt: skip
    shares = [Fraction(i, between + 1) for i in range(1, between + 1)]
    return LongTrajectory(
        law.name, design.h, *approx_trajectory(loop, samples, digits, shares=shares, progress=progress)
    )
