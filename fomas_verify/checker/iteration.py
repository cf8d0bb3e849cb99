"""Power iteration with a symmetric matrix of integers: guesses; only a test or a Rayleigh quotient makes bounds."""

from operator import mul

from fomas_verify.checker.packed import combination, combinations, largest

_ITERATIONS = 30
_BITS = 56
_CLOSE_BITS = 32

Rows = list[list[int]]


def iterated(full: Rows, vector: list[int]) -> list[int]:
    """Where power iteration leads; integers of 56 bits."""
    times = combination(full, _BITS + 1)
    for _ in range(_ITERATIONS):
        image = times(vector)
        size = max(abs(entry) for entry in image).bit_length()
        vector = [entry << _BITS >> size for entry in image] if size else vector
    return vector


def is_kept(full: Rows, vector: list[int]) -> bool:
    """Whether the image has the direction of the vector, to about 2^-16."""
    image = combination(full, _BITS + 1)(vector)
    square, inner, size = (sum(map(mul, *pair)) for pair in ((image, image), (vector, image), (vector, vector)))
    return bool(square * size - inner**2 <= inner**2 >> _CLOSE_BITS)


def squared(full: Rows, times: int) -> Rows:
    """About a multiple of the matrix to the power 2^times; integers of 56 bits."""
    for _ in range(times):
        full = _short(full)
        full = combinations(full, full)
    return _short(full)


def _short(full: Rows) -> Rows:
    shift = max(largest(full).bit_length() - _BITS, 0)
    return [[entry >> shift for entry in row] for row in full]
