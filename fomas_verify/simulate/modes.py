"""The closed loop by its modes: one scalar power series for each eigenvalue of the Laplacian.

With ``L = V diag(lambda) V^-1`` the loop ``x_{k+1} = x_0 - mu sum_j g_{k-j} L x_j`` is ``X(z) = V diag(s(z)) V^-1 x_0``
with ``s = 1 / ((1 - z) (1 + mu lambda z G(z)))``: a few FFTs a mode in place of a sum at every sample. It serves where
the eigenvectors are well-conditioned and no mode grows, and says so where they are not. Approximate.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from fomas_verify.simulate.convolution import GROWING, Progress
from fomas_verify.simulate.memory import Array, largest
from fomas_verify.simulate.plant import DENSE_AGENTS, Plant
from fomas_verify.simulate.series import approx_resolvents

FEWEST = 250
"""Samples below which block after block is as fast: measured, five agents."""

WORST_CONDITION = 100.0
WORST_ERROR = 1e-14
AT_ONCE = 1 << 20
"""Modes times samples that are held at once."""


def approx_by_modes(plant: Plant, kernel: Array, progress: Progress | None = None) -> tuple[Array, Array] | None:
    """States and ``e = L x`` for as many samples as the kernel g has entries.

    Parameters
    ----------
    plant : Plant
        The agents.
    kernel : array
        ``g_0, g_1, ...``: the plant's step response times the law's.
    progress : function, optional
        Told the samples done, as a share of all modes.

    Returns
    -------
    tuple of arrays or None
        Shape (N, n, samples) each; approximate. None where this way would not be accurate or not faster: many agents,
        few samples, eigenvectors of a condition above 100, a mode that grows tenfold, or samples that do not satisfy
        the recursion.
    """
    count, agents = len(kernel), len(plant.x0)
    if agents > DENSE_AGENTS or count < FEWEST:
        return None
    eigenvalues, vectors = np.linalg.eig(plant.laplacian)
    if not np.linalg.cond(vectors) <= WORST_CONDITION:
        return None
    shares = np.linalg.inv(vectors) @ plant.x0
    still = np.abs(eigenvalues) <= agents * np.finfo(float).eps * np.abs(eigenvalues).max()
    states = np.zeros((*plant.x0.shape, count))
    real, paired = np.flatnonzero((eigenvalues.imag == 0) & ~still), np.flatnonzero((eigenvalues.imag > 0) & ~still)
    modes, some = np.concatenate([real, paired]), max(1, AT_ONCE // count)
    for i in range(0, len(modes), some):
        chosen = modes[i : i + some]
        rows = _Rows(eigenvalues[chosen], vectors[:, chosen], shares[chosen])
        with np.errstate(over="ignore", invalid="ignore"):
            responses = approx_resolvents(kernel[:-1], plant.mu * rows.factors, rows.pairs)
            np.cumsum(responses, axis=-1, out=responses)
        if not largest(responses) <= GROWING:
            return None
        added = (rows.weights @ responses).reshape(states.shape)
        states = np.add(states, added, out=added) if i else added
        if progress is not None:
            progress(count * min(i + some, len(modes)) // len(modes))
    states += (vectors[:, still] @ shares[still]).real[..., None]
    errors = plant.error(states)
    return (states, errors) if _satisfied(plant, kernel, states, errors) else None


class _Rows:
    """Modes, the real ones first and one of each conjugate pair, in real numbers: the order of `approx_resolvents`.

    ``weights``, agents times columns by rows: what each row adds to the states.
    """

    def __init__(self, eigenvalues: NDArray[Any], vectors: NDArray[Any], shares: NDArray[Any]) -> None:
        single = int(np.count_nonzero(eigenvalues.imag == 0))
        self.pairs = len(eigenvalues) - single
        weights = (vectors[:, None, :] * shares.T[None, :, :]).reshape(-1, len(eigenvalues))
        twice = 2 * np.conj(weights[:, single:])
        self.factors = np.concatenate([eigenvalues[:single].real, _by_turns(eigenvalues[single:])])
        self.weights = np.concatenate([weights[:, :single].real, _by_turns(twice)], axis=-1)


def _by_turns(x: NDArray[Any]) -> Array:
    """Real and imaginary parts by turns, along the last axis."""
    return np.stack([x.real, x.imag], axis=-1).reshape(*x.shape[:-1], -1)


def _satisfied(plant: Plant, kernel: Array, states: Array, errors: Array) -> bool:
    """Whether a few samples satisfy the recursion, within what an error of 1e-14 of the largest entry would leave."""
    size = largest(states)
    gain = plant.mu * np.abs(plant.laplacian).sum(axis=1).max()
    for k in (1, 2, len(kernel) // 3):
        past = kernel[:k][::-1].copy()
        made = plant.x0 - plant.mu * (errors.reshape(-1, len(kernel))[:, :k] @ past).reshape(plant.x0.shape)
        allowed = WORST_ERROR * size * (1 + gain * np.abs(past).sum())
        if not largest(states[..., k] - made) <= allowed:
            return False
    return True
