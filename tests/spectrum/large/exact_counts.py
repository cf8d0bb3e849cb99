"""Signs of eigenvalues by fraction-free elimination, and random networks: no code of the package, no floats."""

import random
from fractions import Fraction
from math import lcm

Rows = list[list[Fraction]]
Edges = dict[tuple[int, int], Fraction]


def negative_eigenvalues(rows: Rows) -> int:
    """How many eigenvalues of a symmetric rational matrix are negative: sign changes of its leading minors.

    A minor that is 0 is no answer: AssertionError.
    """
    scale = lcm(*(x.denominator for row in rows for x in row))
    a = [[int(x * scale) for x in row] for row in rows]
    n, before, changes = len(a), 1, 0
    for k in range(n):
        pivot = a[k][k]
        assert pivot != 0
        changes += (pivot < 0) != (before < 0)
        for i in range(k + 1, n):
            for j in range(k + 1, n):
                a[i][j] = (a[i][j] * pivot - a[i][k] * a[k][j]) // before
        before = pivot
    return changes


def laplacian(n: int, edges: Edges) -> Rows:
    rows = [[Fraction(0)] * n for _ in range(n)]
    for (source, target), weight in edges.items():
        rows[target - 1][source - 1] -= weight
        rows[target - 1][target - 1] += weight
    return rows


def symmetric_part(rows: Rows) -> Rows:
    n = len(rows)
    return [[(rows[i][j] + rows[j][i]) / 2 for j in range(n)] for i in range(n)]


def shifted(rows: Rows, scale: Fraction | int, shift: Fraction) -> Rows:
    """scale times the matrix, plus shift times the identity."""
    return [[scale * x + (shift if i == j else 0) for j, x in enumerate(row)] for i, row in enumerate(rows)]


def gram(rows: Rows, mu: Fraction) -> Rows:
    """P^T P for P = I - mu L."""
    p = shifted(rows, -mu, Fraction(1))
    n = len(p)
    return [[sum((p[k][i] * p[k][j] for k in range(n)), Fraction(0)) for j in range(n)] for i in range(n)]


def quotient(rows: Rows, vector: tuple[int, ...]) -> Fraction:
    total = sum(x * sum(a * y for a, y in zip(row, vector, strict=True)) for x, row in zip(vector, rows, strict=True))
    return Fraction(total) / sum(x * x for x in vector)


def random_network(rng: random.Random, n: int, *, symmetric: bool, spread: int = 0) -> Edges:
    """Weighted cycles through random agents, one of them through all; weights over `spread` orders of magnitude."""
    edges: Edges = {}
    cycles = [rng.sample(range(1, n + 1), n)]
    cycles += [rng.sample(range(1, n + 1), rng.randint(2, n)) for _ in range(rng.randint(0, 4))]
    for cycle in cycles:
        weight = Fraction(rng.randint(1, 9), rng.choice([1, 2, 3, 7])) * 10 ** rng.randint(0, spread)
        for ends in zip(cycle, cycle[1:] + cycle[:1], strict=True):
            for edge in (ends, ends[::-1]) if symmetric else (ends,):
                edges[edge] = edges.get(edge, Fraction(0)) + weight
    return edges
