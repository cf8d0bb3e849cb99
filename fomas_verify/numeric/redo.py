"""Bounds of lambda2, lambda_max and sigma of a network: shown, shown to be false, or neither.

Source: docs/theory.md, section 14.
"""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from typing import cast

from fomas_verify.numeric.floats import Floats, Network, Symmetric
from fomas_verify.numeric.ways import Way, way_for

SCALE = ("numpy", "scipy", "qdldl")
"""What this room needs: the extra `scale`."""

_TRIES = 3
_MORE = 1.1
_BEYOND = 2**60
_MOST_BITS = 500
_MOST_GAIN = 2**60
"""Of mu in the matrices' unit: its square is a double."""


class Redo:
    """Bounds of eigenvalues, each from a factor of its own.

    Parameters
    ----------
    memory : int
        Bytes that a factor may take; beyond, the answer is None.
    """

    def __init__(self, memory: int) -> None:
        self.memory = memory
        self._floats: Floats | None = None

    def lambda2_at_least(self, network: Network, bound: Fraction) -> bool | None:
        """Whether lambda2 >= bound, of a strongly connected, balanced network. Rigorous."""
        floats = self._of(network)
        return None if floats is None else self._decide(floats.twice_symmetric_part, 2 * bound / floats.unit, up=True)

    def lambda_max_at_most(self, network: Network, bound: Fraction) -> bool | None:
        """Whether the largest eigenvalue of L_s is <= bound, of a balanced network. Rigorous."""
        floats = self._of(network)
        return None if floats is None else self._decide(floats.twice_symmetric_part, 2 * bound / floats.unit, up=False)

    def sigma_at_most(self, network: Network, mu: tuple[Fraction, Fraction], bound: Fraction) -> bool | None:
        """Whether sigma <= bound for every mu between two, of a strongly connected, balanced network. Rigorous.

        sigma changes by at most norm L <= 2 D times the change of mu. ``I - P^T P`` has the eigenvalue 0 at the vector
        1, and the least of its others is ``1 - sigma^2``.
        """
        floats = self._of(network)
        if floats is None or mu[1] * floats.unit > _MOST_GAIN:
            return None
        gain = float((mu[0] + mu[1]) / 2 * floats.unit)
        middle = Fraction(gain) / floats.unit
        apart = max(abs(middle - end) for end in mu)
        moved = 2 * _degree(network) * apart
        near, far = bound - moved, bound + moved
        if near <= 0:
            return None
        matrix = floats.deviation(gain)
        found = self._decide(matrix, 1 - near**2, up=True)
        if found is False and moved > 0:
            # sigma at the middle is beyond `near`; the bound is false only if it is beyond `far`.
            found = False if self._decide(matrix, 1 - far**2, up=True) is False else None
        return found

    def _of(self, network: Network) -> Floats | None:
        """The matrices; None where a weight is so small beside another that a double does not hold it."""
        if max(network.weights, default=1).bit_length() > _MOST_BITS or not network.weights:
            return None
        if self._floats is None or self._floats.network is not network:
            self._floats = Floats(network)
        return self._floats

    def _decide(self, matrix: Symmetric, target: Fraction, *, up: bool) -> bool | None:
        """Whether the second smallest eigenvalue is at least (`up`), or the largest at most, the target.

        Where it is the second smallest, the smallest is 0, at the vector 1, and only a target > 0 is decided.
        """
        if (up and target <= 0) or abs(target) >= _BEYOND or not matrix.is_whole:
            return None
        way = way_for(matrix, self.memory, on_perp=up)
        if way is None:
            return None
        return _decide(way, target) if up else _decide(replace(way, sign=-1.0), -target)


def _decide(way: Way, target: Fraction) -> bool | None:
    """Whether the eigenvalue that the way bounds is at least the target.

    A bound is asked for at a distance on the safe side of the target, the room, which is made as small or large as the
    error that was met; then on the other side, for a bound that shows the opposite.
    """
    room, tries = way.first_room(), _TRIES
    while tries:
        found = way.near(float(target) + room)
        if found is None:
            return None
        if found.lower is not None and found.lower >= target:
            return True
        if found.upper is not None and found.upper < target:
            return False
        if found.lower is None and (found.error is None or found.error * _MORE > room / 2):
            break
        room, tries = cast(float, found.error) * _MORE, tries - 1
    for _ in range(_TRIES):
        found = way.near(float(target) - room)
        if found is None or found.lower is not None:
            return None
        if found.upper is not None and found.upper < target:
            return False
        if found.error is None or found.error <= room:
            return None
        room = found.error * _MORE
    return None


def _degree(network: Network) -> Fraction:
    """D."""
    heard = [0] * network.agents
    for target, weight in zip(network.targets, network.weights, strict=True):
        heard[target] += weight
    return Fraction(max(heard), network.denominator)
