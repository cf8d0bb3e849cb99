"""Witnesses that the powers of Pc(t) tend to 0, or do not.

Pc(t) = I - t Lc acts on the differences from agent N; its eigenvalues are those of I - t L, one eigenvalue 1 left out.
Source: docs/certificate-format.md, section 4, `perron-eigenvalues`.
"""

from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from operator import mul

from fomas_verify.checker.definite import least_sign
from fomas_verify.checker.facts import settle
from fomas_verify.checker.graph import Graph, Rows, common_denominator, limit_size
from fomas_verify.checker.packed import combinations
from fomas_verify.checker.ruling import Undecided, need, need_that
from fomas_verify.checker.witness import Triangle

MAX_PRODUCT_WORK = 2**46
MAX_POWER_WORK = 2**34
MAX_EXACT_POWER_BITS = 2**12


def differences_step(graph: Graph, t: Fraction) -> tuple[Rows, int]:
    """(F, f), f > 0, with Pc(t) = F / f."""
    f = graph.denominator * t.denominator
    limit_size(f.bit_length() + abs(t.numerator).bit_length(), graph.design.agents)
    rows = [[-t.numerator * entry for entry in row] for row in graph.on_differences]
    for i, row in enumerate(rows):
        row[i] += f
    return rows, f


def _step(graph: Graph, t: Fraction) -> Rows:
    """f (I - t L), with the f of `differences_step`."""
    rows = [[-t.numerator * entry for entry in row] for row in graph.laplacian]
    for i, row in enumerate(rows):
        row[i] += graph.denominator * t.denominator
    return rows


@lru_cache(maxsize=4)
def require_decrease(graph: Graph, t: Fraction, rows: Triangle) -> None:
    """Return if Q > 0 and Q - Pc(t)^T Q Pc(t) > 0 for the symmetric Q with these rows."""
    matrix, change = _change(graph, t, rows)
    need(least_sign(matrix), (1,), "Q > 0")
    need(least_sign([[-entry for entry in row] for row in change]), (1,), "Q - Pc(t)^T Q Pc(t) > 0")


@lru_cache(maxsize=4)
def require_persistence(graph: Graph, t: Fraction, rows: Triangle) -> None:
    """Return if Y >= 0, Y != 0 and Pc(t)^T Y Pc(t) - Y >= 0 for the symmetric Y with these rows."""
    matrix, change = _change(graph, t, rows)
    need_that(any(entry != 0 for row in matrix for entry in row), "Y != 0")
    need(least_sign(matrix), (0, 1), "Y >= 0")
    need(least_sign(change), (0, 1), "Pc(t)^T Y Pc(t) - Y >= 0")


def _change(graph: Graph, t: Fraction, rows: Triangle) -> tuple[Rows, Rows]:
    """Positive multiples of X and of Pc(t)^T X Pc(t) - X, lower triangles."""
    step, f = differences_step(graph, t)
    n = len(rows)
    common = common_denominator([entry for row in rows for entry in row], n)
    matrix = [[int(entry * common) for entry in row] for row in rows]
    bits = max(_bits(step) + n.bit_length(), f.bit_length()) + max(_bits(matrix), 1)
    if n**3 * bits**2 > MAX_PRODUCT_WORK:
        raise Undecided(f"a product of matrices of {n} rows with entries of {bits} bits is beyond the work allowed")
    full = [[matrix[max(i, j)][min(i, j)] for j in range(n)] for i in range(n)]
    columns = list(zip(*step, strict=True))
    # Row j of (X F)^T is the image under X of column j of F.
    images = [[sum(map(mul, row, column)) for row in full] for column in columns]
    change = [
        [sum(map(mul, columns[i], images[j])) - f * f * entry for j, entry in enumerate(row)]
        for i, row in enumerate(matrix)
    ]
    return matrix, change


def _bits(rows: Rows) -> int:
    return max(abs(entry) for row in rows for entry in row).bit_length()


@lru_cache(maxsize=4)
def trace_beyond(graph: Graph, t: Fraction, n: int) -> int | None:
    """1 if abs trace(Pc(t)^n) > N - 1, -1 if not, None if not decided."""
    _, f = differences_step(graph, t)
    return power_trace_beyond(_step(graph, t), f, n, 1)


def power_trace_beyond(rows: Rows, f: int, n: int, ones: int = 0) -> int | None:
    """1 if abs(trace((F / f)^n) - ones) > size - ones for F with `size` rows, -1 if not, None if not decided.

    `ones` of the eigenvalues are known to be 1: the others are as many as the right side says.
    """
    size = len(rows)
    bits = max(_bits(rows), f.bit_length()) + size.bit_length()
    if bits * n <= MAX_EXACT_POWER_BITS:
        trace = sum(row[i] for i, row in enumerate(_exact_power(rows, n)))
        return 1 if abs(trace - ones * f**n) > (size - ones) * f**n else -1

    def test(width: int) -> int | None:
        if size**3 * n.bit_length() * width > MAX_POWER_WORK:
            return None
        scaled = [[divmod(entry << width, f) for entry in row] for row in rows]
        inexact = any(rest for row in scaled for _, rest in row)
        base = _fitted([[entry for entry, _ in row] for row in scaled], -width, int(inexact), width)
        result = _power(base, n, width)
        if result is None:
            return None
        slack, exponent, low = size * result.error, result.exponent, size - 2 * ones
        if _exceeds(result.trace - slack, exponent, size) or _exceeds(-result.trace - slack, exponent, low):
            return 1
        below = _exceeds(result.trace + slack, exponent, size) or _exceeds(slack - result.trace, exponent, low)
        return None if below else -1

    return settle(test)


@dataclass(frozen=True)
class Scaled:
    """A real matrix within `error` of the integers `rows`, entry by entry, times 2^exponent."""

    rows: Rows
    exponent: int
    error: int

    @property
    def trace(self) -> int:
        """The trace of the integers."""
        return sum(row[i] for i, row in enumerate(self.rows))


def _exact_power(rows: Rows, n: int) -> Rows:
    """rows^n for n >= 1."""
    result = rows
    for _ in range(n - 1):
        result = _times(result, rows)
    return result


def _power(base: Scaled, n: int, width: int) -> Scaled | None:
    """base^n for n >= 1 with entries of `width` bits, or None when the error has outgrown them."""
    result = base
    for bit in bin(n)[3:]:
        result = _product(result, result, width)
        if bit == "1":
            result = _product(result, base, width)
        if result.error.bit_length() > width:
            return None
    return result


def _product(a: Scaled, b: Scaled, width: int) -> Scaled:
    """a b: (A + E)(B + F) - A B = A F + E B + E F, and one unit where bits are dropped."""
    rows = _times(a.rows, b.rows)
    norm_a = max(sum(map(abs, row)) for row in a.rows)
    norm_b = max(sum(map(abs, column)) for column in zip(*b.rows, strict=True))
    error = norm_a * b.error + a.error * norm_b + len(rows) * a.error * b.error
    return _fitted(rows, a.exponent + b.exponent, error, width)


def _fitted(rows: Rows, exponent: int, error: int, width: int) -> Scaled:
    """The same with entries of `width` bits, rounded down."""
    shift = max(_bits(rows) - width, 0)
    inexact = any(entry & ((1 << shift) - 1) for row in rows for entry in row)
    rounded = [[entry >> shift for entry in row] for row in rows]
    return Scaled(rounded, exponent + shift, -(-error >> shift) + inexact)


def _times(a: Rows, b: Rows) -> Rows:
    return combinations(b, a)


def _exceeds(x: int, exponent: int, bound: int) -> bool:
    """Whether x 2^exponent > bound >= 0; the exponent can be far too large to shift by."""
    if exponent >= 0:
        return x << min(exponent, bound.bit_length()) > bound
    return x > bound << min(-exponent, max(x.bit_length(), 1))
