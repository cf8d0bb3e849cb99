"""The fastest averaging weights as a semidefinite program, in cvxpy and solved by clarabel: a proposal, no proof.

Notation: as `weights`; U an orthonormal basis of 1perp, ``M(w) = U^T (I - L(w)) U``; ``norm M(w) <= s`` iff
``[[s I, M^T], [M, s I]] >= 0``.
"""

from __future__ import annotations

from fomas_verify.network import Digraph
from fomas_verify.region.lmi import orthonormal_basis, singular_pairs, solved
from fomas_verify.region.weights import ROOM, WeightProposal

TOLERANCES = (1e-10, 1e-8)


def weights_by_clarabel(graph: Digraph, symmetric: bool, attempt: int) -> WeightProposal | None:
    """Ask clarabel; approximate, different from machine to machine. None where it fails."""
    import cvxpy as cp
    import numpy as np

    ends = [edge[:2] for edge in graph.edges]
    targets, sources = np.zeros((len(ends), graph.agents)), np.zeros((len(ends), graph.agents))
    for row, (source, target) in enumerate(ends):
        targets[row, target - 1] = sources[row, source - 1] = 1
    basis = orthonormal_basis(graph.agents)
    weights, sigma = cp.Variable(len(ends)), cp.Variable()
    one = np.eye(graph.agents - 1)
    step = one - (targets @ basis).T @ cp.diag(weights) @ ((targets - sources) @ basis)
    inequality = cp.bmat([[sigma * one, step.T], [step, sigma * one]]) >> 0
    balance = (targets - sources).T @ weights == 0
    diagonal = targets.T @ weights <= 1 - float(ROOM)
    limits = [balance, weights >= 0, diagonal]
    if symmetric:
        limits += [
            weights[row] == weights[ends.index(pair[::-1])] for row, pair in enumerate(ends) if pair[0] < pair[1]
        ]
    if not solved(cp.Problem(cp.Minimize(sigma), [inequality, *limits]), TOLERANCES[min(attempt, 1)]):
        return None
    pairs = singular_pairs(basis, inequality.dual_value)
    # On symmetric weights the balance says nothing: half of the diagonal's multipliers take the potentials' place.
    multipliers = diagonal.dual_value / 2 if symmetric else balance.dual_value
    potentials = () if multipliers is None else tuple(map(float, multipliers))
    return WeightProposal(
        dict(zip(ends, map(float, weights.value), strict=True)), float(sigma.value), pairs, potentials
    )
