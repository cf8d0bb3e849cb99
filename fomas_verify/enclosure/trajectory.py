"""A trajectory of a linear loop with memory, enclosed: an approximate solution and a rigorous bound of its error.

With X(z) the states as a power series the loop is ``A X = b``, ``A = I + mu z g(z) L``, ``b = x_0 / (1 - z)``, all
modulo ``z^(K+1)``. Let R be any approximation of 1/A, ``Delta = I - A R``, and X any approximate solution with defect
``D = b - A X``. In the norm ``max_i sum_j sum_k abs(a_ij,k)`` of such matrices, which is submultiplicative,
``norm Delta < 1`` gives ``norm(1/A) <= norm R / (1 - norm Delta)``, and then each state up to sample k is within
``norm(1/A) max_(l<=k) abs D_l`` of the true one. Solving for D with floats and adding the result refines X.
Every number is a ball (Arb) or an exact float; nothing depends on how X and R were found.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction

from flint import arb, arb_poly

from fomas_verify.enclosure.interval import Interval
from fomas_verify.enclosure.real import Ball, to_ball, to_fmpq, to_interval, working_precision
from fomas_verify.enclosure.series import inverse_series

RESOLVENT_BITS = 96


@dataclass(frozen=True)
class LinearLoop:
    """What defines the loop, exactly or enclosed.

    ``edges``: (i, j, a_ij) counted from 0, agent i hears agent j. ``kernel`` and ``response``: ``g_0..`` of the loop
    and ``q_0..`` of the law ``u = -gamma (q * L x)``, samples + 1 entries each. ``x0``: for each agent its numbers.
    """

    edges: tuple[tuple[int, int, Fraction], ...]
    x0: tuple[tuple[Fraction, ...], ...]
    mu: Interval
    gamma: Interval
    weight: Interval
    kernel: Sequence[Ball]
    response: Sequence[Ball]


class Enclosure:
    """The states and inputs of one loop as balls, refined by corrections from outside."""

    def __init__(self, loop: LinearLoop, bits: int) -> None:
        """Before the first correction the approximate solution is 0, and its defect b."""
        self.loop, self.bits, self.count = loop, bits, len(loop.kernel)
        with working_precision(bits):
            self._kernel = arb_poly(list(loop.kernel))
            self._states = [[arb_poly([0]) for _ in row] for row in loop.x0]
            self._forcing = [[arb_poly([arb(to_fmpq(x))] * self.count) for x in row] for row in loop.x0]
        self._inverse: arb | None = None
        self._radii: list[arb] = []
        self._refresh()

    def bound_inverse(self, approximation: Sequence[Sequence[Sequence[float]]]) -> bool:
        """Bound ``norm(1/A)`` from approximate entries ``[i][j]``, floats over the samples; whether it succeeded."""
        agents = range(len(approximation))
        with working_precision(RESOLVENT_BITS):
            sizes = [arb(0) for _ in agents]
            defects = [arb(0) for _ in agents]
            for j in agents:
                column = [arb_poly([arb(x) for x in approximation[i][j]]) for i in agents]
                image = self._operator(column)
                for i in agents:
                    sizes[i] += _l1(column[i])
                    defects[i] += _l1(arb_poly([int(i == j)]) - image[i])
            size, defect = _largest(sizes), _largest(defects)
            if not (defect < 1 and size.is_finite()):
                return False
            self._inverse = (size / (1 - defect)).abs_upper()
        self._refresh()
        return True

    def defects(self) -> list[list[list[float]]]:
        """The defect's midpoints as floats: agents, their numbers, samples."""
        with working_precision(self.bits):
            return [[[float(x.mid()) for x in _entries(d, self.count)] for d in row] for row in self._defects]

    def correct(self, corrections: Sequence[Sequence[Sequence[float]]]) -> None:
        """Add corrections of the same shape to the approximate solution."""
        with working_precision(self.bits):
            self._states = [
                [_midpoints(x + arb_poly([arb(y) for y in ys]), self.count) for x, ys in zip(row, rows, strict=True)]
                for row, rows in zip(self._states, corrections, strict=True)
            ]
        self._refresh()

    @property
    def radius(self) -> Fraction | None:
        """A bound of every state's error; None before ``norm(1/A)`` is bounded, or where none is finite."""
        return to_interval(self._radii[-1]).upper if self._radii and self._radii[-1].is_finite() else None

    def states(self) -> list[list[list[Interval]]]:
        """Enclosures of ``x_k``: agents, their numbers, samples. Rigorous."""
        with working_precision(self.bits):
            return [[_intervals(x, self.count) for x in row] for row in self._tube()]

    def inputs(self) -> list[list[list[Interval]]]:
        """Enclosures of ``u_k``. Rigorous."""
        with working_precision(self.bits):
            return [[_intervals(u, self.count) for u in row] for row in self._inputs()]

    def between(self, response: Sequence[Ball]) -> list[list[list[Interval]]]:
        """Enclosures of ``x_0 + m sum_{j<=k} w_{k-j} u_j`` for the plant's response w, for k = 0..K. Rigorous."""
        with working_precision(self.bits):
            weight = to_ball(self.loop.weight)
            memory = arb_poly(list(response)) * weight
            return [
                [_intervals(b + (memory * u).truncate(self.count), self.count) for b, u in zip(bs, us, strict=True)]
                for bs, us in zip(self._forcing, self._inputs(), strict=True)
            ]

    def _refresh(self) -> None:
        """Recompute the defect of the approximate solution, and the error bound sample by sample."""
        with working_precision(self.bits):
            columns = range(len(self._states[0]))
            images = [self._operator([row[d] for row in self._states]) for d in columns]
            self._defects = [[b - images[d][i] for d, b in enumerate(row)] for i, row in enumerate(self._forcing)]
            if self._inverse is not None:
                entries = [[x.abs_upper() for x in _entries(p, self.count)] for row in self._defects for p in row]
                largest, self._radii = arb(0), []
                for k in range(self.count):
                    largest = _largest([largest, *(row[k] for row in entries)])
                    self._radii.append((largest * self._inverse).abs_upper())

    def _operator(self, column: Sequence[arb_poly]) -> list[arb_poly]:
        """``A`` applied to a vector of series."""
        mu = to_ball(self.loop.mu)
        return [
            x + ((self._kernel * e).truncate(self.count) * mu).left_shift(1).truncate(self.count)
            for x, e in zip(column, self._error(column), strict=True)
        ]

    def _error(self, column: Sequence[arb_poly]) -> list[arb_poly]:
        """``L`` applied to a vector of series."""
        found = [arb_poly([0]) for _ in column]
        for i, j, weight in self.loop.edges:
            found[i] += (column[i] - column[j]) * arb(to_fmpq(weight))
        return found

    def _tube(self) -> list[list[arb_poly]]:
        if not self._radii:
            raise ValueError("the inverse is not bounded yet")
        errors = arb_poly([arb(0, radius) for radius in self._radii])
        return [[x + errors for x in row] for row in self._states]

    def _inputs(self) -> list[list[arb_poly]]:
        gain = -to_ball(self.loop.gamma)
        response = arb_poly(list(self.loop.response)) * gain
        tube = self._tube()
        errors = [self._error([row[d] for row in tube]) for d in range(len(tube[0]))]
        return [[(response * e[i]).truncate(self.count) for e in errors] for i in range(len(tube))]


def step_responses(alpha: Fraction, count: int, bits: int, share: Fraction = Fraction(1)) -> list[Ball]:
    """``(n + share)^alpha - (n - 1 + share)^alpha`` for n = 0..count-1, the term with a negative base left out; share 1
    gives c_n. To about so many bits; rigorous.
    """
    with working_precision(bits + 2 * count.bit_length() + alpha.denominator.bit_length() + 16):
        exponent = to_fmpq(alpha)
        powers = [arb(to_fmpq(n + share)) ** exponent for n in range(count)]
        return powers[:1] + [powers[n] - powers[n - 1] for n in range(1, count)]


def law_response(c: Sequence[Ball], memory: int | None, bits: int) -> list[Ball]:
    """``1 / (1 + sum_{l=1}^M f(l) z^l)`` from c_0, c_1, ..., to their number; M None for all of the sum. Rigorous."""
    kept = len(c) if memory is None else memory + 1
    with working_precision(2 * bits):
        series = [c[0]] + [c[n] - c[n - 1] if n < kept else arb(0) for n in range(1, len(c))]
        return [to_ball(x) for x in inverse_series(series, bits)]


def product_of(a: Sequence[Ball], b: Sequence[Ball], bits: int) -> list[Ball]:
    """The product of two series of one length, to that length. Rigorous."""
    with working_precision(bits):
        return _entries(arb_poly(list(a)) * arb_poly(list(b)), len(a))


def one(count: int) -> list[Ball]:
    """``1, 1, ...``."""
    return [arb(1)] * count


def _entries(p: arb_poly, count: int) -> list[arb]:
    found = p.coeffs()[:count]
    return found + [arb(0)] * (count - len(found))


def _midpoints(p: arb_poly, count: int) -> arb_poly:
    return arb_poly([x.mid() for x in _entries(p, count)])


def _intervals(p: arb_poly, count: int) -> list[Interval]:
    return [to_interval(x) for x in _entries(p, count)]


def _l1(p: arb_poly) -> arb:
    """An upper bound of the sum of the absolute entries."""
    return sum((x.abs_upper() for x in p.coeffs()), arb(0)).abs_upper()


def _largest(xs: Iterable[arb]) -> arb:
    """An upper bound of absolute values; infinite where one of them is no number, for comparisons with that are all
    false.
    """
    largest = arb(0)
    for x in xs:
        bound = x.abs_upper()
        if not bound.is_finite():
            return arb("inf")
        largest = largest if bound <= largest else bound
    return largest
