"""One form for several digraphs as a semidefinite program, in cvxpy and solved by clarabel: proposals, no proofs.

Notation: U an orthonormal basis of 1perp, ``M_i = U^T L_i U / D``, ``s = t D``. A form S > 0 decreases under every
digraph at t iff ``S M_i + M_i^T S - s M_i^T S M_i > 0``. The program maximises the margin eps of these over S >= 0 of
trace n; a negative margin comes with Z_i >= 0 in its dual, which show that there is no form. Source: theory, section
11.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from fomas_verify.exact import matrix as exact
from fomas_verify.region.lmi import orthonormal_basis, solved
from fomas_verify.spectrum.loop import Loop

TOLERANCES = (1e-10, 1e-8)

Rows = list[list[float]]


@dataclass(frozen=True)
class Margin:
    """The solver's best eps at one t, the form, and the dual's matrices, in differences from the last agent;
    approximate, and perhaps nonsense.
    """

    eps: float
    form: Rows
    dual: tuple[Rows, ...]


Margins = Callable[[Fraction, int], Margin | None]
"""A number t and which attempt this is; None where the solver fails."""


def margins_by_clarabel(loops: Sequence[Loop]) -> Margins:
    """The program for these digraphs, built once; approximate, different from machine to machine."""
    import cvxpy as cp
    import numpy as np

    degree = max(loop.degree_max for loop in loops)
    basis = orthonormal_basis(loops[0].design.graph.agents)
    n = basis.shape[1]
    steps = [basis.T @ (_floats(loop) / float(degree)) @ basis for loop in loops]
    share, eps, form = cp.Parameter(nonneg=True), cp.Variable(), cp.Variable((n, n), symmetric=True)
    inequalities = [_symmetric(form @ m + m.T @ form - share * (m.T @ form @ m)) >> eps * np.eye(n) for m in steps]
    problem = cp.Problem(cp.Maximize(eps), [*inequalities, form >> 0, cp.trace(form) == n])
    into, back = _coordinates(basis)

    def margin(t: Fraction, attempt: int) -> Margin | None:
        share.value = float(t * degree)
        if not solved(problem, TOLERANCES[min(attempt, 1)]):
            return None
        duals = tuple((into @ x.dual_value @ into.T).tolist() for x in inequalities if x.dual_value is not None)
        return Margin(float(eps.value), (back.T @ form.value @ back).tolist(), duals)

    return margin


def _floats(loop: Loop) -> Any:
    import numpy as np

    return np.array([[float(x) for x in row] for row in exact.to_rows(loop.laplacian)])


def _symmetric(x: Any) -> Any:
    return (x + x.T) / 2


def _coordinates(basis: Any) -> tuple[Any, Any]:
    """From the basis to the differences from the last agent, and back."""
    import numpy as np

    into = basis[:-1] - basis[-1]
    return into, np.linalg.inv(into)
