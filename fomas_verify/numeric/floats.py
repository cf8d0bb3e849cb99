"""The matrices of a network in doubles, with a bound of what that changed in each row.

Notation: d the weights' denominator, u = 2^-53. Entries are those of d L divided by a power of two, so that none is far
from 1; `unit` times an eigenvalue of a matrix here is one of the matrix meant.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import TYPE_CHECKING, Any, Protocol

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

U = 2.0**-53
SLACK = 1 + 2.0**-20
"""Covers the rounding in a bound: sums and products of nonnegative doubles, fewer than 2^26 one after another."""


class Network(Protocol):
    """A digraph as arrays: agent `targets[e]`, from 0, hears `sources[e]` with weight `weights[e]` / `denominator`."""

    @property
    def agents(self) -> int:
        """N."""

    @property
    def sources(self) -> Any:
        """From where each edge leads."""

    @property
    def targets(self) -> Any:
        """Where to."""

    @property
    def weights(self) -> Sequence[int]:
        """Positive integers."""

    @property
    def denominator(self) -> int:
        """What the weights are divided by."""


@dataclass(frozen=True, eq=False)
class Symmetric:
    """The matrix of the upper triangle `upper` (csc, diagonal stored) and its mirror image.

    Row i differs from that of the exact matrix by at most `error[i]` in the sum of absolute values.
    """

    upper: Any
    error: NDArray[Any]

    @property
    def is_whole(self) -> bool:
        """Whether every diagonal entry is stored, and every entry is finite: a sum may have left one out."""
        import numpy as np

        last = self.upper.indptr[1:] - 1
        stored = bool((np.diff(self.upper.indptr) > 0).all())
        return stored and bool(
            (self.upper.indices[last] == np.arange(len(last))).all() and np.isfinite(self.upper.data).all()
        )

    def full(self) -> Any:
        """The matrix, csr."""
        from scipy.sparse import csr_array, triu

        return csr_array(self.upper + triu(self.upper, k=1).T)

    def shifted(self, scale: float, shift: float) -> Symmetric:
        """scale times this (scale = 1 or -1), plus shift on the diagonal."""
        upper = self.upper * scale
        places = upper.indptr[1:] - 1
        diagonal = upper.data[places] + shift
        upper.data[places] = diagonal
        return Symmetric(upper, (self.error + 2 * U * (abs(diagonal) + abs(shift))) * SLACK)


@dataclass(frozen=True, eq=False)
class Floats:
    """A network's matrices."""

    network: Network

    @cached_property
    def unit(self) -> Fraction:
        """The number by which d L / d is divided."""
        longest = max(self.network.weights).bit_length()
        return Fraction(1 << longest, self.network.denominator)

    @cached_property
    def laplacian(self) -> Any:
        """L / unit as a csr_array; each entry with a relative error of at most (most + 4) u, see `_share`."""
        import numpy as np
        from scipy.sparse import coo_array

        network = self.network
        sources, targets = (np.asarray(ends, dtype=np.int64) for ends in (network.sources, network.targets))
        scale = 1 << max(network.weights).bit_length()
        values = np.array([weight / scale for weight in network.weights])
        degrees = np.bincount(targets, weights=values, minlength=network.agents)
        here = np.arange(network.agents)
        entries = np.concatenate([degrees, -values])
        places = np.concatenate([here, targets]), np.concatenate([here, sources])
        return coo_array((entries, places), shape=(network.agents, network.agents)).tocsr()

    @cached_property
    def _share(self) -> float:
        """A bound of the relative error of every entry of the Laplacian: one rounding a weight, then a sum of them."""
        import numpy as np

        return float((int(np.diff(self.laplacian.indptr).max()) + 4) * U)

    @cached_property
    def twice_symmetric_part(self) -> Symmetric:
        """(L + L^T) / unit."""
        from scipy.sparse import triu

        both = self.laplacian + self.laplacian.T
        rows = abs(self.laplacian) + abs(self.laplacian.T)
        error = (self._share + 2 * U) * rows.sum(axis=1) * SLACK
        return Symmetric(_sorted(triu(both, format="csc")), error)

    def deviation(self, gain: float) -> Symmetric:
        """g (L + L^T) - g^2 L^T L over unit, g = `gain` exactly: I - P^T P for mu = g / unit."""
        import numpy as np
        from scipy.sparse import triu

        matrix, symmetric = self.laplacian, self.twice_symmetric_part
        square = matrix.T @ matrix
        upper = _sorted(triu(symmetric.upper * gain - square * gain**2, format="csc"))
        sizes = abs(matrix)
        ones = np.ones(self.network.agents)
        spread = sizes.T @ (sizes @ ones)
        most = int(np.diff(self.laplacian.tocsc().indptr).max())
        share = 2 * self._share + (most + 8) * U
        linear = abs(gain) * (symmetric.error + 4 * U * (sizes @ ones + sizes.T @ ones))
        return Symmetric(upper, (linear + gain**2 * share * spread * (1 + share)) * SLACK)


def _sorted(upper: Any) -> Any:
    upper.sort_indices()
    return upper
