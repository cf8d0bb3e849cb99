"""The same best point by a geometric program (cvxpy, clarabel): an opinion, compared with what was found directly.

For a fixed number of samples a piece is a geometric program in gamma and h: every limit is a monomial. What the solver
says decides nothing and stands in no certificate. Source: theory, section 5.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from importlib.util import find_spec

from fomas_verify.exact.errors import FomasError
from fomas_verify.region.task import Objective
from fomas_verify.region.tradeoff import Piece

TOLERANCE = 1e-6
"""How far, in logarithms, the solver's point may lie outside its piece and its cost from the least."""

MOST_STEPS = 200
MOST_LOG = 700.0

Solver = Callable[[Piece, Objective], tuple[float, float]]
"""From a piece to log gamma and log h of its best point; raises `NoAnswerError` where there is no answer."""


class NoAnswerError(FomasError):
    """The solver gave no answer; the message says why."""


@dataclass(frozen=True)
class Opinion:
    """Whether the solver agrees with the direct search; otherwise why its answer was set aside."""

    agrees: bool
    reason: str = ""


def is_installed() -> bool:
    """Whether the extra `region` is there."""
    return all(find_spec(name) is not None for name in ("cvxpy", "clarabel"))


def opinion(piece: Piece, objective: Objective, solver: Solver | None = None) -> Opinion:
    """What the solver thinks of the best point of a piece; approximate, and never an error."""
    try:
        g, y = (solver or geometric_program)(piece, objective)
    except NoAnswerError as error:
        return Opinion(False, str(error))
    if not all(map(math.isfinite, (g, y))):
        return Opinion(False, "it is not a number")
    m, (g0, g1), (y0, y1) = g + piece.alpha * y, piece.gamma, piece.h
    outside = max(piece.low - m, m - piece.high, g0 - g, g - g1, y0 - y, y - y1)
    if outside > TOLERANCE:
        return Opinion(False, f"it violates a constraint, by {outside:.2g} in logarithms")
    missed = _cost(piece, objective, g, y) - piece.cost(objective)
    if abs(missed) > TOLERANCE:
        return Opinion(False, f"it is not the best point, by {abs(missed):.2g} in logarithms")
    return Opinion(True)


def _cost(piece: Piece, objective: Objective, g: float, y: float) -> float:
    match objective:
        case Objective.SLOWEST:
            return -y
        case Objective.GENTLEST:
            return g
        case Objective.FASTEST:
            return math.log(piece.first) + y
        case Objective.ROBUST:
            return -_room_at(piece, g, y)


def _room_at(piece: Piece, g: float, y: float) -> float:
    """How far gamma and h, where they move, may be off from a point of the piece."""
    (moves_g, moves_h), m = piece.moves, g + piece.alpha * y
    both = moves_g + piece.alpha * moves_h
    rooms = [x / both for x in (m - piece.low, piece.high - m)] if both else [0.0]
    rooms += [g - piece.gamma[0], piece.gamma[1] - g] if moves_g else []
    rooms += [y - piece.h[0], piece.h[1] - y] if moves_h else []
    return min(rooms)


def geometric_program(piece: Piece, objective: Objective) -> tuple[float, float]:
    """The answer of cvxpy and clarabel; approximate."""
    import warnings

    import cvxpy as cp

    ends = (piece.low, piece.high), piece.gamma, piece.h
    if any(low >= MOST_LOG or high <= -MOST_LOG for low, high in ends):
        raise NoAnswerError("a limit is beyond doubles")
    gamma, h, factor = (cp.Variable(pos=True) for _ in range(3))
    m = gamma * h**piece.alpha
    robust = objective is Objective.ROBUST
    both = piece.moves[0] + piece.alpha * piece.moves[1] if robust else 0
    ranges = zip((m, gamma, h), ends, (both, *piece.moves), strict=True)
    constraints = [factor >= 1]
    for x, (low, high), moves in ranges:
        room = factor**moves if robust and moves else 1
        constraints += [x >= math.exp(low) * room] if low > -MOST_LOG else []
        constraints += [x * room <= math.exp(high)] if high < MOST_LOG else []
    best = {
        Objective.SLOWEST: cp.Maximize(h),
        Objective.GENTLEST: cp.Minimize(gamma),
        Objective.FASTEST: cp.Minimize(h),
        Objective.ROBUST: cp.Maximize(factor),
    }
    problem = cp.Problem(best[objective], constraints)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            problem.solve(gp=True, solver=cp.CLARABEL, max_iter=MOST_STEPS)
    except Exception as error:  # whatever a solver dies of, it only has no answer
        raise NoAnswerError(f"the solver failed: {' '.join(str(error).split())[:120]}") from None
    if problem.status != cp.OPTIMAL or gamma.value is None or h.value is None:
        raise NoAnswerError(f"the solver says {problem.status}")
    found = float(gamma.value), float(h.value)
    return (math.nan, math.nan) if min(found) <= 0 else (math.log(found[0]), math.log(found[1]))
