"""Power series in binary floats: the inverse of one, and of many that differ by a factor. Approximate.

Newton's iteration by FFT: from the first k coefficients g of ``1 / (1 + f z G(z))`` come the next k, those of
``-f g (g z G)`` cut to what is not yet known. A transform is cyclic of a length of at least the coefficients wanted;
what wraps around falls on entries that are not read.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import fft
from scipy.linalg import solve_triangular, toeplitz

from fomas_verify.simulate.memory import Array

DIRECT_TERMS = 64
"""Up to here a triangular system is faster than Newton's steps."""

NEAR = 1.1
AT_ONCE = 1 << 14
"""Numbers that are transformed together: more leave the processor's cache."""


def approx_inverse_series(a: Array) -> Array:
    """The coefficients of ``1 / sum a_n z^n`` to the same length, with a_0 = 1."""
    found: Array = approx_resolvents(a[1:], np.ones(1))[0]
    return found


def approx_resolvents(kernel: Array, factors: Array, pairs: int = 0) -> Array:
    """The coefficients of ``1 / (1 + factor z sum g_n z^n)``, one more than g has, for each factor.

    Parameters
    ----------
    kernel : array
        ``g_0, g_1, ...``.
    factors : array
        Real ones, then ``pairs`` complex ones, each as its real and its imaginary part.

    Returns
    -------
    array
        A row for each entry of factors, in the same order; approximate: by Newton's iteration with padded FFTs, which
        doubles the coefficients known. Its rounding error is relative to the largest coefficient.
    """
    lengths = [len(kernel) + 1]
    while lengths[-1] > DIRECT_TERMS:
        lengths.append(-(-lengths[-1] // 2))
    longest, known = fast_length(lengths[0]), lengths.pop()
    found = _first_terms(kernel, factors, pairs, known, longest)
    delayed = np.zeros(longest)
    delayed[1 : len(kernel) + 1] = kernel
    newton = _Newton(len(factors), longest)
    for wanted in reversed(lengths):
        size = fast_length(wanted)
        response = np.fft.rfft(delayed[:size])
        for rows, paired in _parts(len(factors), pairs, newton.room // size):
            newton.double(found[rows], -factors[rows, None], paired, response, known, wanted)
        known = wanted
    return found[:, : len(kernel) + 1]


def _first_terms(kernel: Array, factors: Array, pairs: int, known: int, room: int) -> Array:
    """The first coefficients by a triangular system each, in rows with room for more."""
    single = len(factors) - 2 * pairs
    every = np.concatenate([factors[:single], factors[single::2] + 1j * factors[single + 1 :: 2]])
    delayed, one = toeplitz(np.append(0.0, kernel[: known - 1]), np.zeros(known)), np.eye(known)
    terms = np.array([
        solve_triangular(one + factor * delayed, one[0], lower=True, check_finite=False) for factor in every
    ])  # fmt: skip
    found = np.zeros((len(factors), room))
    found[:single, :known] = terms[:single].real
    found[single::2, :known], found[single + 1 :: 2, :known] = terms[single:].real, terms[single:].imag
    return found


class _Newton:
    """Newton's step for ``1 / (1 + factor z G(z))``, with memory of its own: fresh pages cost as much as the FFTs."""

    def __init__(self, rows: int, longest: int) -> None:
        """For so many rows of at most ``longest`` numbers; ``room`` is how many numbers go into one step."""
        self.room = max(2, min(rows, AT_ONCE // longest)) * longest
        self._numbers = np.empty(self.room)
        self._spectra = np.empty((2, self.room // 2 + rows), dtype=complex)

    def double(self, rows: Array, negative: Array, pairs: int, response: NDArray[Any], known: int, wanted: int) -> None:
        """Find the coefficients from ``known`` to ``wanted`` of rows, given the transform of ``z G(z)``."""
        half = len(response)
        size = 2 * half - 2
        inverse, excess = (x[: len(rows) * half].reshape(-1, half) for x in self._spectra)
        numbers = self._numbers[: len(rows) * size].reshape(-1, size)
        np.fft.rfft(rows[:, :size], out=inverse)
        np.multiply(inverse, response, out=excess)
        np.fft.irfft(excess, size, out=numbers)
        numbers[:, :known] = numbers[:, wanted:] = 0.0
        np.fft.rfft(numbers, out=excess)
        _multiply(excess, inverse, pairs)
        np.fft.irfft(excess, size, out=numbers)
        rows[:, known:wanted] = numbers[:, known:wanted]
        _multiply(rows[:, known:wanted], negative, pairs)


def _parts(rows: int, pairs: int, some: int) -> list[tuple[slice, int]]:
    """All rows in parts of about so many, each real or complex unless it is of all; with the pairs in each."""
    single, some = rows - 2 * pairs, some - some % 2
    if rows <= some:
        return [(slice(None), pairs)]
    real = [(slice(i, min(i + some, single)), 0) for i in range(0, single, some)]
    return real + [(slice(i, i + some), (min(i + some, rows) - i) // 2) for i in range(single, rows, some)]


def _multiply(a: NDArray[Any], b: NDArray[Any], pairs: int) -> None:
    """Row by row in place; the last rows are the real and the imaginary parts of ``pairs`` complex ones by turns."""
    single = len(a) - 2 * pairs
    if pairs:
        real, imaginary = slice(single, None, 2), slice(single + 1, None, 2)
        outer, inner = a[imaginary] * b[imaginary], a[real] * b[imaginary]
        a[imaginary] *= b[real]
        a[imaginary] += inner
        a[real] *= b[real]
        a[real] -= outer
    a[:single] *= b[:single]


def fast_length(least: int) -> int:
    """An even length of at least so much whose FFT is fast: a power of two where one is near."""
    power = 1 << (least - 1).bit_length()
    return power if power <= NEAR * least else 2 * int(fft.next_fast_len(-(-least // 2), real=True))
