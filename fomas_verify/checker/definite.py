"""The sign of the least eigenvalue of a symmetric matrix of integers: positive definite, singular, or indefinite.

A matrix is its lower triangle: row i has i + 1 entries. Two ways, both exact in what they say: a fixed-point
LDL^T, which decides all but nearly singular matrices, and fraction-free elimination.
Source: docs/certificate-format.md, section 5.
"""

from collections.abc import Callable, Sequence
from operator import mul
from typing import TypeVar

from fomas_verify.checker.field import Element
from fomas_verify.checker.ruling import Undecided

Matrix = Sequence[Sequence[int]]
Ring = TypeVar("Ring", int, Element)

QUICK_BITS = (256, 1024)
MAX_QUICK_WORK = 2**43
MAX_EXACT_WORK = 2**36
MAX_WIDE_WORK = 2**47


def least_sign(rows: Matrix) -> int:
    """The sign (-1, 0 or 1) of the least eigenvalue.

    Raises
    ------
    Undecided
        If fixed point does not decide and elimination would take more than the work allowed.
    """
    for bits in QUICK_BITS:
        sign = quick_sign(rows, bits)
        if sign is not None:
            return sign
    limit_elimination(len(rows), max(max(abs(entry) for entry in row) for row in rows).bit_length(), 1)
    return exact_sign(rows, 1, lambda entry: (entry > 0) - (entry < 0))


def limit_elimination(n: int, size: int, products: int) -> None:
    """Raise `Undecided` if `exact_sign` of n rows is beyond the work allowed.

    `size` is of the entries, in bits; a product of two entries takes `products` of integers. The minors have n times as
    many bits; where these are many, a product or a quotient of two takes their square.
    """
    if products * n**4 * size > MAX_EXACT_WORK or products * n**5 * size**2 > MAX_WIDE_WORK:
        raise Undecided("a singular or nearly singular matrix is beyond the work allowed")


def quick_sign(rows: Matrix, bits: int, signs: tuple[int, ...] = (1, -1)) -> int | None:
    """1 or -1 if the least eigenvalue is certainly positive or negative, else None; only `signs` are looked for.

    None also where that is beyond the work allowed.

    With B the matrix scaled to diagonal entries in [1, 4) (a congruence: signs stay) and c > 0:
    if B - cI = L D L^T + E with D > 0 and norm E <= c, then B >= L D L^T > 0. If a leading block of B + cI is
    L D L^T + E with a negative entry in D and norm E <= c, then x^T B x < 0 for x = L^-T e_k.
    E is exactly what the divisions of the factorisation leave, together with the rounding of B.
    """
    if len(rows) ** 3 * bits**2 > MAX_QUICK_WORK:
        return None
    diagonal = [row[-1] for row in rows]
    if min(diagonal) <= 0:
        return -1 if min(diagonal) < 0 else None
    scaled = _scaled(rows, [(entry.bit_length() - 1) // 2 for entry in diagonal], bits)
    return next((sign for sign in signs if _shows(scaled, sign, bits)), None)


def _scaled(rows: Matrix, halves: list[int], bits: int) -> list[list[int]]:
    """Entry (i, j) times 2^(bits - halves_i - halves_j), rounded down: off by less than 1."""
    return [
        [_shifted(entry, bits - halves[i] - halves[j]) for j, entry in enumerate(row)] for i, row in enumerate(rows)
    ]


def _shifted(entry: int, places: int) -> int:
    return entry << places if places >= 0 else entry >> -places


def _shows(rows: list[list[int]], sign: int, bits: int) -> bool:
    """Whether fixed-point LDL^T of the scaled matrix, shifted by c = 6n units, shows the least eigenvalue's sign.

    L, D are integers at scale 2^bits, DL at 2^(2 bits), sums and remainders at 2^(3 bits). A remainder is less than
    2^bits D_j < 5 * 4^bits, so c is enough for n of them and for the n roundings of a row of B.
    """
    n = len(rows)
    shift = 6 * n
    unit = 1 << 2 * bits
    factors: list[list[int]] = []
    pivots: list[int] = []
    worst = 0
    for row in rows:
        line: list[int] = []
        weighted: list[int] = []
        for j, pivot in enumerate(pivots):
            entry, rest = divmod((row[j] << 2 * bits) - sum(map(mul, line, factors[j])), pivot << bits)
            line.append(entry)
            weighted.append(entry * pivot)
            worst = max(worst, rest)
        pivot, rest = divmod(((row[-1] - sign * shift) << 2 * bits) - sum(map(mul, line, weighted)), unit)
        worst = max(worst, rest)
        if pivot <= 0:
            return sign < 0 and pivot < 0 and n * (worst + unit) <= shift * unit
        factors.append(weighted)
        pivots.append(pivot)
    return sign > 0 and n * (worst + unit) <= shift * unit


def exact_sign(rows: Sequence[Sequence[Ring]], one: Ring, sign: Callable[[Ring], int]) -> int:
    """The sign of the least eigenvalue by fraction-free LDL^T, over the integers or a number field.

    Each step takes a diagonal entry that is not zero for its pivot. The entries are minors of the matrix (Bareiss),
    so the divisions are exact; while the pivots are positive they have the signs of the Schur complement's.
    """
    left = [list(row) for row in rows]
    previous = one
    while left:
        signs = ((k, sign(row[-1])) for k, row in enumerate(left))
        k, pivot_sign = next(((k, s) for k, s in signs if s != 0), (-1, 0))
        if pivot_sign < 0:
            return -1
        if pivot_sign == 0:
            # A zero diagonal: semidefinite only if all else is zero too.
            return -1 if any(sign(entry) != 0 for row in left for entry in row) else 0
        pivot = left[k][-1]
        column = left[k][:k] + [row[k] for row in left[k + 1 :]]
        others = [row[:k] + row[k + 1 :] if i > k else row for i, row in enumerate(left) if i != k]
        left = [
            [(pivot * entry - column[i] * column[j]) // previous for j, entry in enumerate(row)]
            for i, row in enumerate(others)
        ]
        previous = pivot
    return 1
