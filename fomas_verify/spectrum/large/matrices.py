"""The symmetric matrices of a network in doubles, and a bound of how far they are from those meant.

Notation: d the weights' denominator, ``unit = 2^k / d`` with k so that no degree exceeds `unit`. The vector 1 is a null
vector of every matrix meant. Source: docs/theory.md, section 14.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from fomas_verify.network.sparse import SparseDigraph
from fomas_verify.network.sparse_facts import sparse_in_sums
from fomas_verify.spectrum.large.rounding import SLACK, U, gamma

if TYPE_CHECKING:
    from numpy.typing import NDArray

MOST_BITS = 500
"""Weights of more bits are left alone: beside them a double may not hold another weight, not even as 0 < w."""


@dataclass(frozen=True, eq=False)
class Near:
    """A symmetric matrix that is known nearly.

    Attributes
    ----------
    matrix : csc_array of doubles, shape (N, N)
        Exactly symmetric, sorted, every diagonal entry stored.
    error : float
        The matrix meant is at most that far away, in the 2-norm.
    """

    matrix: Any
    error: float

    @property
    def largest(self) -> float:
        """The largest absolute value of an entry."""
        return float(abs(self.matrix.data).max())


@dataclass(frozen=True, eq=False)
class Scaled:
    """A balanced network's matrices, divided by `unit`.

    Attributes
    ----------
    laplacian : csc_array of doubles, every entry within 2 u (relatively) of that of L / unit
    degree : float, at least D / unit, at most 1
    """

    laplacian: Any
    degree: float
    unit: Fraction

    def symmetric_part(self) -> Near:
        """L_s / unit.

        An entry off the diagonal is half a sum of two, each of relative error 2 u: relative error below 4 u. The sum of
        absolute values of a row of L_s is 2 D at most.
        """
        half = self.laplacian * 0.5
        return Near(_sorted(half + half.T), 9 * U * self.degree * SLACK)

    def decrease(self, gain: float) -> Near:
        """``(I - P^T P) / g = (L + L^T) / unit - g L^T L / unit^2`` for mu = g / unit, g = `gain` > 0 exactly.

        Rounding: 2 u an entry; a sum of at most m products; the factor g; the two sums. Rows and columns of abs L sum
        to 2 D at most, so rows of ``abs L^T abs L`` to 4 D^2 and those of abs L + abs L^T to 4 D.
        """
        import numpy as np

        matrix = self.laplacian
        most = int(np.diff(matrix.indptr).max())
        linear, square = matrix + matrix.T, (matrix.T @ matrix) * gain
        error = (6 * U) * 4 * self.degree + gamma(most + 8) * gain * 4 * self.degree**2
        # Both triangles of the product hold the same sums, perhaps added in another order.
        return Near(_sorted(_mirrored(linear - square)), error * SLACK**2)

    def decrease_terms(self) -> int:
        """How many products L^T L takes: at least its number of entries."""
        import numpy as np

        rows = np.bincount(self.laplacian.indices, minlength=self.laplacian.shape[0])
        return int((rows.astype(np.int64) ** 2).sum())


def scaled(graph: SparseDigraph) -> Scaled | None:
    """The matrices of a balanced network with edges; None where its weights are not for doubles."""
    import numpy as np
    from scipy.sparse import coo_array

    sums = sparse_in_sums(graph)
    bits = int(sums.max()).bit_length()
    if bits > MOST_BITS:
        return None
    values, degrees = _doubles(graph.weights, bits), _doubles(sums, bits)
    here = np.arange(graph.agents)
    places = np.concatenate([here, graph.targets]), np.concatenate([here, graph.sources])
    entries = np.concatenate([degrees, -values])
    laplacian = coo_array((entries, places), shape=(graph.agents, graph.agents)).tocsc()
    return Scaled(_sorted(laplacian), float(degrees.max()) * SLACK, Fraction(1 << bits, graph.denominator))


def _doubles(integers: NDArray[Any], bits: int) -> NDArray[Any]:
    """``integers / 2^bits``, each correctly rounded."""
    import numpy as np

    if integers.dtype == object:
        return np.array([value / (1 << bits) for value in integers.tolist()])
    return integers.astype(np.float64) * 2.0**-bits


def _mirrored(matrix: Any) -> Any:
    from scipy.sparse import tril

    lower = tril(matrix, format="csc")
    return lower + tril(lower, k=-1, format="csc").T


def _sorted(matrix: Any) -> Any:
    """As csc, rows ascending in each column, every diagonal entry stored."""
    from scipy.sparse import eye_array

    matrix = matrix.tocsc()
    if (matrix.diagonal() == 0).any():
        # An explicit zero survives a sum where the other side cancels it.
        ones = eye_array(matrix.shape[0], format="csc")
        matrix = _stored(matrix, ones)
    matrix.sort_indices()
    return matrix


def _stored(matrix: Any, pattern: Any) -> Any:
    import numpy as np
    from scipy.sparse import coo_array

    entries, more = matrix.tocoo(), pattern.tocoo()
    rows, columns = (np.concatenate([one, two]) for one, two in zip(entries.coords, more.coords, strict=True))
    values = np.concatenate([entries.data, np.zeros(len(more.data))])
    return coo_array((values, (rows, columns)), shape=matrix.shape).tocsc()
