"""The design's digraph in integers: Laplacian, Assumption 1, and the matrices of the claims on 1perp.

d is the weights' common denominator, V = [I; -1^T] the basis of 1perp. Symmetric matrices are lower triangles.
Source: docs/certificate-format.md, section 2.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import isqrt, lcm
from operator import mul

from fomas_verify.checker.designs import Setting
from fomas_verify.checker.field import Element, Root
from fomas_verify.checker.ruling import Undecided

MAX_DENOMINATOR_BITS = 2**16
MAX_ENTRY_BITS = 2**21
MAX_MATRIX_BITS = 2**30

Rows = list[list[int]]


def common_denominator(numbers: Sequence[Fraction], size: int) -> int:
    """A common denominator of the entries of a matrix of `size` rows.

    Raises
    ------
    Undecided
        If it is, or the matrix would be, beyond the work allowed.
    """
    result = 1
    for denominator in {number.denominator for number in numbers}:
        if max(denominator.bit_length(), result.bit_length()) > MAX_DENOMINATOR_BITS:
            raise Undecided(f"a common denominator of more than {MAX_DENOMINATOR_BITS} bits is beyond the work allowed")
        result = lcm(result, denominator)
    limit_size(max(abs(number.numerator).bit_length() for number in numbers) + result.bit_length(), size)
    return result


def _scale(weights: Sequence[Fraction], size: int) -> int:
    """A positive integer that takes a few weights to integers, for a matrix of `size` rows."""
    result = lcm(*(weight.denominator for weight in weights))
    limit_size(max(abs(weight.numerator).bit_length() for weight in weights) + result.bit_length(), size)
    return result


def limit_size(bits: int, size: int) -> None:
    """Raise `Undecided` if a matrix of `size` rows with entries of `bits` bits is beyond the work allowed."""
    if bits > MAX_ENTRY_BITS or bits * size * size > MAX_MATRIX_BITS:
        raise Undecided(f"a matrix of {size} rows with entries of {bits} bits is beyond the work allowed")


@dataclass(frozen=True)
class Graph:
    """The digraph of a design."""

    design: Setting

    @property
    def agents(self) -> int:
        """N."""
        return self.design.agents

    @cached_property
    def denominator(self) -> int:
        """d."""
        return common_denominator([Fraction(1), *(weight for _, _, weight in self.design.edges)], self.agents)

    @cached_property
    def laplacian(self) -> Rows:
        """d L, all rows in full."""
        rows = [[0] * self.agents for _ in range(self.agents)]
        for source, target, weight in self.design.edges:
            scaled = int(weight * self.denominator)
            rows[target - 1][source - 1] -= scaled
            rows[target - 1][target - 1] += scaled
        return rows

    def heard(self, agent: int) -> Fraction:
        """sum_j a_ij for i = agent."""
        return Fraction(self.laplacian[agent - 1][agent - 1], self.denominator)

    def spoken(self, agent: int) -> Fraction:
        """sum_j a_ji for i = agent."""
        column = (row[agent - 1] for i, row in enumerate(self.laplacian) if i != agent - 1)
        return Fraction(-sum(column), self.denominator)

    @cached_property
    def degree_max(self) -> Fraction:
        """D = max_i sum_j a_ij."""
        return max(self.heard(agent) for agent in range(1, self.agents + 1))

    @cached_property
    def frobenius(self) -> Fraction:
        """An upper bound of the Frobenius norm of L."""
        square = sum(entry**2 for row in self.laplacian for entry in row)
        return Fraction(isqrt(square << 64) + 1, self.denominator << 32)

    @property
    def size(self) -> Fraction:
        """An upper bound of norm L, under Assumption 1: norm L^2 <= norm_1 norm_oo <= (2 D)^2."""
        return min(self.frobenius, 2 * self.degree_max)

    def reachable(self, start: int) -> set[int]:
        """The agents to which a directed path leads from `start`, itself included."""
        listeners: list[list[int]] = [[] for _ in range(self.agents + 1)]
        for source, target, _ in self.design.edges:
            listeners[source].append(target)
        found = {start}
        waiting = [start]
        while waiting:
            for agent in listeners[waiting.pop()]:
                if agent not in found:
                    found.add(agent)
                    waiting.append(agent)
        return found

    @cached_property
    def satisfies_assumption(self) -> bool:
        """Assumption 1: strongly connected and balanced.

        On a balanced graph it is enough that agent 1 reaches all: no edge leads from outside into the set B of those
        that reach agent 1, so by balance none leads out, and all that agent 1, in B, reaches is in B.
        """
        agents = range(1, self.agents + 1)
        return all(self.heard(agent) == self.spoken(agent) for agent in agents) and self.reachable(1) == set(agents)

    @cached_property
    def is_symmetric(self) -> bool:
        """A = A^T."""
        weights = {(source, target): weight for source, target, weight in self.design.edges}
        return all(weights.get((target, source)) == weight for (source, target), weight in weights.items())

    @cached_property
    def on_differences(self) -> Rows:
        """d Lc, (N-1) x (N-1): entries L_ij - L_Nj."""
        last = self.laplacian[-1]
        return [[entry - last[j] for j, entry in enumerate(row[:-1])] for row in self.laplacian[:-1]]

    @cached_property
    def _gram(self) -> Rows:
        """V^T V."""
        return [[1] * i + [2] for i in range(self.agents - 1)]

    @cached_property
    def _symmetric_part(self) -> Rows:
        """V^T d (L + L^T) V."""
        rows = self.laplacian
        return _on_1perp([[entry + rows[j][i] for j, entry in enumerate(row[: i + 1])] for i, row in enumerate(rows)])

    @cached_property
    def _square(self) -> Rows:
        """V^T d^2 L^T L V."""
        total = [[0] * (i + 1) for i in range(self.agents)]
        for row in self.laplacian:
            entries = [(j, entry) for j, entry in enumerate(row) if entry]
            for i, left in entries:
                for j, right in entries:
                    if j > i:
                        break
                    total[i][j] += left * right
        return _on_1perp(total)

    def quotients(self, e: Sequence[Fraction]) -> tuple[Fraction, Fraction]:
        """e^T L_s e / norm(e)^2 and norm(L e)^2 / norm(e)^2, for e != 0."""
        common = common_denominator(e, 1)
        vector = [int(entry * common) for entry in e]
        image = [sum(map(mul, row, vector)) for row in self.laplacian]
        norm = sum(map(mul, vector, vector)) * self.denominator
        return Fraction(sum(map(mul, vector, image)), norm), Fraction(
            sum(map(mul, image, image)), norm * self.denominator
        )

    def form(self, gram: Fraction, symmetric: Fraction, square: Fraction) -> Rows:
        """A positive multiple of gram V^T V + symmetric V^T (L + L^T) V + square V^T L^T L V."""
        d = self.denominator
        weights = [gram, symmetric / d, square / d**2]
        common = _scale(weights, self.agents)
        a, b, c = (int(weight * common) for weight in weights)
        return [
            [a * x + b * y + c * z for x, y, z in zip(*lines, strict=True)]
            for lines in zip(self._gram, self._symmetric_part, self._square, strict=True)
        ]

    def form_over(
        self, root: Root, gram: Sequence[Fraction], symmetric: Fraction, square: Fraction
    ) -> list[list[Element]]:
        """The same with the polynomial `gram` at theta in place of a rational, over Q(theta)."""
        d = self.denominator
        constants = [symmetric / d, square / d**2]
        common = lcm(root.integer_scale(gram), _scale(constants, self.agents))
        return [
            [
                root.element([gram[0] * x + constants[0] * y + constants[1] * z, *(g * x for g in gram[1:])], common)
                for x, y, z in zip(*lines, strict=True)
            ]
            for lines in zip(self._gram, self._symmetric_part, self._square, strict=True)
        ]


def _on_1perp(rows: Rows) -> Rows:
    """V^T X V of a symmetric X."""
    last = rows[-1]
    return [[entry - last[i] - last[j] + last[-1] for j, entry in enumerate(row)] for i, row in enumerate(rows[:-1])]
