"""Bounds of lambda2, lambda_max and sigma of a large network, shown by a factor, and vectors whose quotients meet them.

Notation: mu an enclosure of the gain, P = I - mu L, D the largest degree. Source: docs/theory.md, section 14.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from math import isqrt
from typing import TYPE_CHECKING, Any

from fomas_verify.network.sparse import SparseDigraph
from fomas_verify.network.sparse_facts import sparse_degree_max, sparse_is_symmetric
from fomas_verify.spectrum.large.candidates import fastest, integer_vector, quotient, slowest, slowest_without_factor
from fomas_verify.spectrum.large.matrices import Near, Scaled, scaled
from fomas_verify.spectrum.large.ways import Way, way_for

if TYPE_CHECKING:
    from numpy.typing import NDArray

_NEAR = 1e-7
"""How far from a quotient a bound is tried first, relatively."""

_FARTHER = (_NEAR, 1e-5, 1e-3, 0.1, 0.5)

_WIDTH = 8e-7
"""How far from the quotient a bound is stated, relatively, at least: whoever redoes it needs room for his rounding."""

_ROOM = 2.0**-39
"""And at least by this share of the largest entry."""

_NEAR_ZERO = 2.0**-30
_SIGMA_BITS = 64
_MOST_GAIN = 2.0**20
_BYTES_A_TERM = 16

BEYOND_DOUBLES = "the weights are too large for doubles: no bound by a factor"
TOO_SMALL = "lambda2 is too small beside the degrees for a factor in doubles to show a bound"
NO_SIGMA = "no factor in doubles shows sigma < 1"


@dataclass(frozen=True)
class LargeBounds:
    """What a factor showed of a network, and vectors.

    Attributes
    ----------
    vectors : up to 8 tuples of N integers
        Each sums to 0, is not 0, and has entries of at most 2^62 in absolute value. The first is near an eigenvector of
        lambda2; others are near one of lambda_max, and near a direction that P shrinks least. Approximate.
    lambda2_lower : rigorous lower bound of lambda2, > 0; None where no factor was affordable or showed one
    lambda_max_upper : rigorous upper bound of the largest eigenvalue of L_s, below 2 D
        None also where 2 D decides as much: `mu (2 D + lambda2) <= 2`, and on digraphs, where nothing depends on it.
    sigma_upper : rigorous upper bound of sigma, for every mu of the enclosure, below 1
        None also on symmetric graphs, whose sigma follows from lambda2 and lambda_max.
    reason : why a bound is missing that a factor could have shown, in one line; None where none is
    """

    vectors: tuple[tuple[int, ...], ...]
    lambda2_lower: Fraction | None
    lambda_max_upper: Fraction | None
    sigma_upper: Fraction | None
    reason: str | None


def large_bounds(graph: SparseDigraph, mu: tuple[Fraction, Fraction], *, memory: int) -> LargeBounds:
    """Bound lambda2, lambda_max and sigma of a strongly connected, balanced digraph.

    Parameters
    ----------
    mu : (lower, upper)
        Encloses the gain; 0 < lower <= upper.
    memory : bytes that a factor may take
        Beyond, the bounds that need one are None, and `reason` says so, before the memory is taken.
    """
    network = scaled(graph)
    if network is None:
        return LargeBounds((), None, None, None, BEYOND_DOUBLES)
    part = network.symmetric_part()
    way, reason = way_for(part, memory)
    vectors = []
    fiedler, lower = _second(part, way)
    if fiedler is not None:
        vectors.append(fiedler)
    lambda2 = None if lower is None else Fraction(lower) * network.unit
    if way is not None and lower is None:
        reason = TOO_SMALL
    upper = sigma = None
    if sparse_is_symmetric(graph):
        if not _is_settled(graph, mu, fiedler, part, network.unit):
            fast, upper = _largest(part, way, network.unit, 2 * sparse_degree_max(graph))
            vectors.extend([] if fast is None else [fast])
    else:
        del part
        slow, sigma, more = _sigma(graph, network, mu, memory)
        vectors.extend([] if slow is None else [slow])
        reason = reason or more
    return LargeBounds(tuple(vectors), lambda2, upper, sigma, reason)


def _second(near: Near, way: Way | None) -> tuple[tuple[int, ...] | None, float | None]:
    """A vector near the eigenvector of the second smallest eigenvalue, and a lower bound of that, with room."""
    nearest = None
    for vector in _candidates(near, way):
        rounded = integer_vector(near, vector)
        if rounded is None:
            continue
        value = quotient(near, _floats(rounded))
        if nearest is None or value < nearest[0]:
            nearest = value, rounded
        if way is None or value <= 0:
            break
        bound = _shown(near, way, value)
        if bound is not None:
            return rounded, bound if bound > 0 else None
    return (None if nearest is None else nearest[1]), None


def _shown(near: Near, way: Way, value: float) -> float | None:
    """A lower bound of the second smallest eigenvalue, near `value` if that is near the eigenvalue."""
    for farther in _FARTHER:
        shown = way.second_at_least(near, value * (1 - farther) - way.expected_error(near))
        if shown is not None:
            # The eigenvalue is near `value` if a bound was shown there at once, and not known beyond `shown` otherwise.
            known = value if farther == _NEAR else shown
            return min(shown, known - _ROOM * near.largest, value * (1 - _WIDTH))
    return None


def _candidates(near: Near, way: Way | None) -> Iterator[NDArray[Any]]:
    """Vectors near the one looked for, the cheapest first."""
    found = slowest_without_factor(near) if way is None or way.prefers_no_factor else None
    if found is not None:
        yield found
    if way is not None:
        try:
            found = slowest(near, way.solve_near_zero(near, _NEAR_ZERO * near.largest))
        except RuntimeError:
            found = None
        if found is not None:
            yield found


def _is_settled(
    graph: SparseDigraph, mu: tuple[Fraction, Fraction], vector: tuple[int, ...] | None, part: Near, unit: Fraction
) -> bool:
    """Whether lambda_max <= 2 D decides all that lambda_max decides: ``mu (2 D + lambda2) <= 2``, clearly."""
    if vector is None:
        return False
    lambda2 = Fraction(quotient(part, _floats(vector))) * unit
    return mu[1] * (2 * sparse_degree_max(graph) + lambda2) * (1 + Fraction(1, 10**6)) <= 2


def _largest(
    near: Near, way: Way | None, unit: Fraction, most: Fraction
) -> tuple[tuple[int, ...] | None, Fraction | None]:
    """A vector near the eigenvector of the largest eigenvalue, and an upper bound below `most`, with room."""
    vector = fastest(near)
    rounded = None if vector is None else integer_vector(near, vector)
    if way is None or rounded is None:
        return rounded, None
    value = quotient(near, _floats(rounded))
    for farther in _FARTHER:
        shift = value * (1 + farther) + way.expected_error(near)
        if Fraction(shift + _ROOM * near.largest) * unit >= most:
            break
        shown = way.all_at_most(near, shift)
        if shown is not None:
            upper = Fraction(max(shown + _ROOM * near.largest, value * (1 + _WIDTH))) * unit
            return rounded, upper if upper < most else None
    return rounded, None


def _sigma(
    graph: SparseDigraph, network: Scaled, mu: tuple[Fraction, Fraction], memory: int
) -> tuple[tuple[int, ...] | None, Fraction | None, str | None]:
    """A direction that P shrinks least, nearly, an upper bound of sigma below 1, and why there is none.

    With g = `gain`, ``1 - sigma^2`` at mu = g / unit is g times the second smallest eigenvalue of the decrease; sigma
    changes by at most norm L <= 2 D times the change of mu.
    """
    gain = float(min((mu[0] + mu[1]) / 2 * network.unit, Fraction(_MOST_GAIN)))
    if not 0 < gain < _MOST_GAIN:
        return None, None, NO_SIGMA
    if network.decrease_terms() * _BYTES_A_TERM > memory:
        return (
            None,
            None,
            f"P^T P would take more than the {memory / 1e9:.1f} GB allowed: no bound of sigma by a factor",
        )
    near = network.decrease(gain)
    way, reason = way_for(near, memory)
    if mu[1] * sparse_degree_max(graph) > 1:
        # sigma may be 1 or more; a direction that shows it is cheaper than a factor that shows nothing.
        grown = slowest_without_factor(near)
        rounded = None if grown is None else integer_vector(near, grown)
        if rounded is not None and quotient(near, _floats(rounded)) <= 0:
            return rounded, None, None
    slow, lower = _second(near, way)
    if lower is None:
        return slow, None, reason or NO_SIGMA
    middle = Fraction(gain) / network.unit
    moved = 2 * sparse_degree_max(graph) * max(abs(end - middle) for end in mu)
    upper = _root_above(1 - Fraction(gain) * Fraction(lower)) + moved
    return slow, upper if upper < 1 else None, None if upper < 1 else NO_SIGMA


def _root_above(square: Fraction) -> Fraction:
    """A dyadic upper bound of the square root of a number >= 0; of 0 for what rounding made negative."""
    scaled_up = max(0, -(-square.numerator * (1 << 2 * _SIGMA_BITS) // square.denominator))
    return Fraction(isqrt(scaled_up) + 1, 1 << _SIGMA_BITS)


def _floats(vector: tuple[int, ...]) -> NDArray[Any]:
    import numpy as np

    return np.array(vector, dtype=np.float64)
