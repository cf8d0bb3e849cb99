"""The extreme eigenvalues of a family's graph in closed form, enclosed to any precision at any size.

Cycle and path have the eigenvalues ``2 - 2 cos(2 pi k/N)`` and ``2 - 2 cos(pi k/N)``, k < N; torus and grid are
Cartesian products, whose eigenvalues are the sums; of the directed cycle L_s, the symmetric part, is half the cycle's.
Source: theory, section 14.
"""

from __future__ import annotations

from fractions import Fraction

from fomas_verify.enclosure.interval import Interval
from fomas_verify.enclosure.real import one_minus_cosine
from fomas_verify.network.family_facts import Family

Ends = tuple[Interval, Interval]


def extreme_eigenvalues(family: Family, bits: int) -> Ends:
    """lambda2 and the largest eigenvalue of L_s, with about ``bits`` correct bits; rigorous."""
    if family.shape is not None:
        sides = [_of_side(side, bits, closed=family.name == "torus") for side in sorted(family.shape) if side > 1]
        # The least sum other than 0 is the longer side's least eigenvalue alone.
        found = sides[-1][0], sides[0][1] if len(sides) == 1 else sides[0][1] + sides[1][1]
    else:
        found = _of_plain(family.name, family.agents, bits)
    return found[0] * family.weight, found[1] * family.weight


def _of_plain(name: str, n: int, bits: int) -> Ends:
    if n == 2:
        # One pair of agents, which hear each other: under every name the same graph.
        return _exactly(2, 2)
    match name:
        case "star":
            return _exactly(1, n)
        case "complete":
            return _exactly(n, n)
        case "hypercube":
            return _exactly(2, 2 * (n.bit_length() - 1))
        case "directed-cycle":
            low, high = _of_side(n, bits, closed=True)
            return low / 2, high / 2
        case _:
            return _of_side(n, bits, closed=name == "cycle")


def _of_side(n: int, bits: int, *, closed: bool) -> Ends:
    """Those of a cycle (closed, n >= 3) or path on n agents.

    The cycle's largest has k = n/2 or, where n is odd, (n - 1)/2: ``2 - 2 cos(pi - pi/n) = 4 - 2 (1 - cos(pi/n))``. The
    path's has k = n - 1, which gives the same.
    """
    below = one_minus_cosine(Fraction(1, n), bits) * 2
    if not closed:
        return below, 4 - below
    return one_minus_cosine(Fraction(2, n), bits) * 2, Interval.exactly(4) if n % 2 == 0 else 4 - below


def _exactly(low: int, high: int) -> Ends:
    return Interval.exactly(low), Interval.exactly(high)
