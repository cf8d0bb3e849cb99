"""Bounds of lambda2, lambda_max and sigma of a network: shown, shown to be false, or neither.

Source: docs/theory.md, section 14.
"""

from __future__ import annotations

from fractions import Fraction

from fomas_verify.numeric.floats import Floats, Network, Symmetric
from fomas_verify.numeric.inertia import inertia

SCALE = ("numpy", "scipy", "qdldl")
"""What this room needs: the extra `scale`."""

_FIRST = 2.0**-40
_TRIES = 3
_MOST_BITS = 500


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
        if floats is None:
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
        if (up and target <= 0) or not matrix.is_whole:
            return None
        largest = float(abs(matrix.upper).max())
        room = _FIRST * largest
        for _ in range(_TRIES):
            found = self._beyond(matrix, target, room, up=up)
            if found is None:
                return None
            holds, error = found
            if holds is None and error > room:
                room = error * 1.1
                continue
            if holds:
                return True
            refuted = self._beyond(matrix, target, -max(room, error * 1.1), up=up)
            return False if refuted is not None and refuted[0] is False else None
        return None

    def _beyond(
        self, matrix: Symmetric, target: Fraction, room: float, *, up: bool
    ) -> tuple[bool | None, float] | None:
        """What a factor at the target moved by `room` into the safe side shows, and its error."""
        shift = float(target) + room if up else float(target) - room
        moved = matrix.shifted(1.0, -shift) if up else matrix.shifted(-1.0, shift)
        found = inertia(moved, self.memory)
        if found is None:
            return None
        negative, error = found
        expected = 1 if up else 0
        below = Fraction(error)
        # Safe: K - shift I (or its opposite) has at most the expected eigenvalues at or below -error.
        if negative <= expected and (Fraction(shift) - below >= target if up else Fraction(shift) + below <= target):
            return True, error
        if negative > expected and (Fraction(shift) + below < target if up else Fraction(shift) - below > target):
            return False, error
        return None, error


def _degree(network: Network) -> Fraction:
    """D."""
    heard = [0] * network.agents
    for target, weight in zip(network.targets, network.weights, strict=True):
        heard[target] += weight
    return Fraction(max(heard), network.denominator)
