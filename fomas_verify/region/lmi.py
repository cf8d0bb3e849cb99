"""The convex programs of the repaired condition, in cvxpy and solved by clarabel: proposals, which prove nothing.

Notation: U an orthonormal basis of 1perp, ``M = U^T L U / D``, ``s = mu D`` in [0, 1]. ``sigma(mu) <= rho`` iff
``[[rho I, (I - s M)^T], [I - s M, rho I]] >= 0``, linear in (s, rho). Source: theory, section 5, "LMI".
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum
from fractions import Fraction
from typing import Any

from fomas_verify.exact import matrix as exact
from fomas_verify.exact.errors import MissingExtraError
from fomas_verify.spectrum.loop import Loop

TOLERANCES = (1e-11, 1e-9)
"""Clarabel's tolerances of the first attempt, and of the second, whose program is scaled otherwise."""

NEGLIGIBLE = 1e-7
"""The share of the dual matrix's largest eigenvalue below which an eigenvector is left out."""

FloatPair = tuple[list[float], list[float]]


class Goal(StrEnum):
    """What is sought over ``0 <= mu <= 1/D``."""

    LEAST_SIGMA = "least sigma"
    LEAST_MU = "least mu"
    GREATEST_MU = "greatest mu"


@dataclass(frozen=True)
class Proposal:
    """A solver's answer: that sigma(mu) <= rho, and that no better is possible; approximate, and perhaps nonsense.

    Attributes
    ----------
    mu, rho : float
        The point.
    pairs : tuple of pairs of lists
        For the least sigma: vectors u, v of 1perp from the dual, of the inequality ``sigma(mu) >= (a - mu b) / n`` of
        theory, section 5, "Emptiness and outer ends".
    """

    mu: float
    rho: float
    pairs: tuple[FloatPair, ...] = ()


Propose = Callable[[Loop, Goal, Fraction, int], Proposal | None]
"""A loop, a goal, the bound of sigma where mu is sought, and which attempt this is; None where the solver fails."""


def need_solver() -> None:
    """Raise `MissingExtraError` where the extra `region` is not installed."""
    try:
        import clarabel  # noqa: F401
        import cvxpy  # noqa: F401
    except ImportError as error:
        raise MissingExtraError(
            f"an LMI needs {error.name}, which the extra `region` brings: pip install 'fomas_verify[region]'"
        ) from None


def by_clarabel(loop: Loop, goal: Goal, bound: Fraction, attempt: int) -> Proposal | None:
    """Ask clarabel; approximate, different from machine to machine.

    Parameters
    ----------
    loop : Loop
        Under Assumption 1; only its graph matters.
    goal : Goal
        What is sought.
    bound : Fraction
        The greatest sigma allowed where mu is sought.
    attempt : int
        From 0; each attempt has tolerances and a scale of its own.
    """
    import cvxpy as cp
    import numpy as np

    basis = orthonormal_basis(loop.design.graph.agents)
    degree = float(loop.degree_max)
    laplacian = np.array([[float(x) for x in row] for row in exact.to_rows(loop.laplacian)]) / degree
    scale = 1.0 + attempt
    share, rho = cp.Variable(), cp.Variable()
    n = basis.shape[1]
    one, step = np.eye(n), np.eye(n) - (share / scale) * (basis.T @ laplacian @ basis)
    inequality = cp.bmat([[rho * one, step.T], [step, rho * one]]) >> 0
    limits = [share >= 0, share <= scale]
    if goal is Goal.LEAST_SIGMA:
        problem = cp.Problem(cp.Minimize(rho), [inequality, *limits])
    else:
        sense = cp.Minimize(share) if goal is Goal.LEAST_MU else cp.Maximize(share)
        problem = cp.Problem(sense, [inequality, *limits, rho == float(bound)])
    if not solved(problem, TOLERANCES[min(attempt, 1)]):
        return None
    pairs = singular_pairs(basis, inequality.dual_value) if goal is Goal.LEAST_SIGMA else ()
    return Proposal(float(share.value) / scale / degree, float(rho.value), pairs)


def solved(problem: Any, tolerance: float) -> bool:
    """Run clarabel on a cvxpy problem; whether it left values, of whatever status."""
    import warnings

    import cvxpy as cp

    settings = dict.fromkeys(("tol_gap_abs", "tol_gap_rel", "tol_feas"), tolerance)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # what cvxpy says of an inaccurate answer; every answer is examined
        try:
            problem.solve(solver=cp.CLARABEL, **settings)
        except Exception:  # whatever a solver dies of, it only has no answer
            return False
    return all(variable.value is not None for variable in problem.variables())


def orthonormal_basis(agents: int) -> Any:
    """An orthonormal basis of 1perp, column by column (Helmert); approximate."""
    import numpy as np

    basis = np.zeros((agents, agents - 1))
    for j in range(agents - 1):
        basis[: j + 1, j] = 1
        basis[j + 1, j] = -(j + 1)
        basis[:, j] /= math.sqrt((j + 1) * (j + 2))
    return basis


def singular_pairs(basis: Any, dual: Any) -> tuple[FloatPair, ...]:
    """The vectors behind the dual matrix: with ``z = (p, q)`` an eigenvector, ``(-U q, U p)`` times the root of its
    eigenvalue.
    """
    import numpy as np

    if dual is None or not np.all(np.isfinite(dual)):
        return ()
    weights, vectors = np.linalg.eigh((dual + dual.T) / 2)
    n = basis.shape[1]
    kept = [i for i, weight in enumerate(weights) if weight > NEGLIGIBLE * weights[-1] > 0]
    found = []
    for i in reversed(kept):
        p, q = np.split(math.sqrt(weights[i]) * vectors[:, i], [n])
        found.append(((-basis @ q).tolist(), (basis @ p).tolist()))
    return tuple(found)
