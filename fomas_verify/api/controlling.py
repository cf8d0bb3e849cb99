"""The sampled closed loop for python-control. Approximate: binary floats."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING

from fomas_verify.design import Design
from fomas_verify.exact.errors import MissingExtraError
from fomas_verify.network import laplacian
from fomas_verify.spectrum.loop import Loop

if TYPE_CHECKING:
    from control import StateSpace

BITS = 128


def sampled_loop(design: Design) -> StateSpace:
    """``x_{k+1} = P x_k`` with ``dt = h``; each entry of P is the float nearest to it. See `Design.to_control`."""
    design.needs("h", command="to_control")
    design.needs("mu", command="to_control")
    try:
        import control
        import numpy as np
    except ImportError as error:
        raise MissingExtraError(
            f"to_control needs {error.name}, which the extra `control` brings: pip install 'fomas_verify[control]'"
        ) from None
    mu = Loop(design).mu(BITS).mid
    rows = [
        [float(Fraction(int(i == j)) - mu * entry) for j, entry in enumerate(row)]
        for i, row in enumerate(laplacian(design.graph))
    ]
    size = design.graph.agents
    nothing = np.zeros((size, 0))
    return control.StateSpace(np.array(rows), nothing, np.eye(size), nothing, float(design.h or 0))
