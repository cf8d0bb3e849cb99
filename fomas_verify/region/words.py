"""Orders of the digraphs, taken over and over, along which the disagreement grows: found in floats, shown exactly.

Source: theory, section 11, "Refuting the claim".
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from importlib.util import find_spec
from typing import Any

from fomas_verify.exact import matrix as exact
from fomas_verify.spectrum.loop import Loop
from fomas_verify.spectrum.stability import at

MOST_PRODUCTS, MOST_LETTERS = 4096, 12
MOST_POWER, MOST_BITS = 4096, 1 << 17
TRIED = 8
GROWTH = 1e-6
"""By how much a spectral radius must exceed 1 in floats to be looked at."""

Word = tuple[int, ...]


def growing_word(loops: Sequence[Loop], mu: Fraction) -> dict[str, Any] | None:
    """An order, from 1, and a power of its product whose trace is too large; exact. None where none was found.

    Without numpy nothing is sought.
    """
    if find_spec("numpy") is None:
        return None
    for word, power in _candidates(loops, mu):
        if _is_beyond(loops, mu, word, power):
            return {"word": [i + 1 for i in word], "mu": mu, "power": power}
    return None


def _candidates(loops: Sequence[Loop], mu: Fraction) -> Iterator[tuple[Word, int]]:
    """Short orders of the greatest growth a sample, with a power; approximate."""
    import numpy as np

    steps = [np.array([[float(x) for x in row] for row in exact.to_rows(at(loop, mu))]) for loop in loops]
    products: list[tuple[Word, Any]] = [((), np.eye(len(steps[0])))]
    found: list[tuple[float, Word, Any]] = []
    for length in range(1, MOST_LETTERS + 1):
        if len(products) * len(steps) > MOST_PRODUCTS:
            break
        products = [((*word, i), step @ product) for word, product in products for i, step in enumerate(steps)]
        for word, product in products:
            eigenvalues = np.linalg.eigvals(product)
            radius = float(max(abs(eigenvalues)))
            if radius > 1 + GROWTH:
                found.append((-(radius ** (1 / length)), word, eigenvalues))
    for _, word, eigenvalues in sorted(found, key=lambda entry: (round(entry[0], 9), len(entry[1])))[:TRIED]:
        power = _power(eigenvalues)
        if power is not None:
            yield word, power


def _power(eigenvalues: Any) -> int | None:
    n = 1
    while n <= MOST_POWER:
        if abs(sum(eigenvalues**n)) > len(eigenvalues) + 0.5:
            return n
        n += 1 + n // 16
    return None


def _is_beyond(loops: Sequence[Loop], mu: Fraction, word: Word, power: int) -> bool:
    """Whether ``abs trace`` of that power of the product is more than N - 1; exact."""
    product = exact.identity(loops[0].design.graph.agents - 1)
    for i in word:
        product = at(loops[i], mu) * product
    _, denominator = product.numer_denom()
    if power * int(denominator).bit_length() > MOST_BITS:
        return False
    result = product
    for bit in bin(power)[3:]:
        result = result * result * product if bit == "1" else result * result
    trace = sum((exact.to_rows(result)[i][i] for i in range(result.nrows())), Fraction(0))
    return abs(trace) > result.nrows()
