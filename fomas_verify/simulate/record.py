"""A simulation for programs: what the table shows, as JSON. Floats, except the design's own numbers and the limit."""

from __future__ import annotations

import json
from collections.abc import Sequence
from fractions import Fraction

import numpy as np

from fomas_verify.design import Design
from fomas_verify.simulate.memory import Array
from fomas_verify.simulate.summary import EARLY
from fomas_verify.simulate.trajectory import Trajectory


def simulation_json(
    design: Design, runs: Sequence[Trajectory], limit: Sequence[Fraction] | None, remarks: Sequence[str]
) -> str:
    """The loops of one design as a JSON object.

    Parameters
    ----------
    design : Design
        What was simulated.
    runs : sequence of Trajectory
        A loop for each controller.
    limit : sequence of Fraction or None
        What every agent tends to under the paper's controller, a number for each state; None where there is no such.
    remarks : sequence of str
        What the comparison with the certified bounds gave, and whatever else is to be known.

    Returns
    -------
    str
        One object; a controller's `mean_absolute_error` has samples k for keys, and is null where there is no limit.
    """
    numbers = {"alpha": design.alpha, "gamma": design.gamma, "mu": design.mu, "h": design.h}
    document = {
        "name": design.name,
        "agents": design.graph.agents,
        **{name: str(x) for name, x in numbers.items() if x is not None},
        "limit": None if limit is None else [str(x) for x in limit],
        "controllers": [_loop(run, None if limit is None else np.array([float(x) for x in limit])) for run in runs],
        "remarks": [*design.notes, *remarks],
    }
    return json.dumps(document, indent=2)


def _loop(run: Trajectory, limit: Array | None) -> dict[str, object]:
    norms = run.input_norms
    errors = None if limit is None else run.mean_absolute_error(limit)
    samples = sorted({min(EARLY, run.last), run.last})
    return {
        "controller": run.controller,
        "samples": run.last,
        "stopped": run.stopped,
        "mean_absolute_error": None if errors is None else {str(k): float(errors[k]) for k in samples},
        "largest_norm_u": float(norms.max()),
        "at": int(norms.argmax()),
    }
