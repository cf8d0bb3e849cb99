"""Vectors of integers packed into one integer each, so that one multiplication scales a whole vector.

Entry j of a vector stands at bit j w, w the width: packed x is sum_j x_j 2^(j w), entries of either sign. Sums and
integer multiples of packed vectors are those of the vectors; they are exact as long as every entry of the result is
below 2^(w - 1) in absolute value, whatever happens on the way and whatever multiple of 2^(n w) is added.
"""

from collections.abc import Callable, Sequence
from functools import lru_cache
from operator import mul

FEW = 12
"""Below so many vectors packing costs more than it saves."""

Vector = Sequence[int]


def width_of(bits: int) -> int:
    """The least width for entries of so many bits, in whole bytes."""
    return (bits + 1 + 7) // 8 * 8


def packed(vector: Vector, width: int) -> int:
    """The vector as one integer."""
    half, size = 1 << width - 1, width // 8
    return int.from_bytes(b"".join([(x + half).to_bytes(size, "little") for x in vector]), "little") - _halves(
        len(vector), width
    )


def unpacked(number: int, count: int, width: int) -> list[int]:
    """The first `count` entries of what was packed."""
    half, size = 1 << width - 1, width // 8
    total = count * size
    data = (number + _halves(count, width) & (1 << 8 * total) - 1).to_bytes(total, "little")
    return [int.from_bytes(data[i : i + size], "little") - half for i in range(0, total, size)]


def combination(vectors: Sequence[Vector], bits: int) -> Callable[[Vector], list[int]]:
    """x -> sum_k x_k vectors_k, for coefficients x_k of at most so many bits; exact."""
    if len(vectors) < FEW:
        places = list(zip(*vectors, strict=True))
        return lambda x: [sum(map(mul, place, x)) for place in places]
    width = width_of(bits + largest(vectors).bit_length() + len(vectors).bit_length())
    numbers, count = [packed(vector, width) for vector in vectors], len(vectors[0])
    return lambda x: unpacked(sum(map(mul, numbers, x)), count, width)


def combinations(vectors: Sequence[Vector], coefficients: Sequence[Vector]) -> list[list[int]]:
    """sum_k x_k vectors_k for each x of `coefficients`; exact."""
    return [*map(combination(vectors, largest(coefficients).bit_length()), coefficients)]


def largest(vectors: Sequence[Vector]) -> int:
    """The largest absolute value among the entries."""
    return max(abs(entry) for vector in vectors for entry in vector)


@lru_cache(maxsize=256)
def _halves(count: int, width: int) -> int:
    """2^(w - 1) at each of so many places."""
    return int.from_bytes((bytes(width // 8 - 1) + b"\x80") * count, "little")
