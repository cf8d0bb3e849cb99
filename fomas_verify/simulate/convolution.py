"""Sums over the whole past, fast: one FFT where the past is known, and block after block where it is being made.

The second is the divide-and-conquer ("relaxed") convolution: when block i is finished, its last s samples, s the
largest power of two times the block that divides i, add their part to the next s samples at once. A sample's rounding
error is relative to the largest entry before it, so growth does not drown what came earlier.
Arrays have time on their last axis.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

import numpy as np
from scipy import fft

from fomas_verify.simulate.memory import Array, largest
from fomas_verify.simulate.series import fast_length

Finish: TypeAlias = Callable[[int, Array], Array]
Progress: TypeAlias = Callable[[int], None]

BLOCK = 64
DIRECT_REACH = 256
"""Up to here a product with a Toeplitz matrix is faster than an FFT: measured, five agents."""

GROWING = 10.0
AT_ONCE = 1 << 13
"""Numbers that are transformed together: more leave the processor's cache."""


class PastSums:
    """``sum_j kernel_{i-j} v_j`` for the s samples i after s samples j, for s = block times a power of two."""

    def __init__(self, kernel: Array) -> None:
        """For the kernel ``g_0, g_1, ...``: sample j weighs ``g_{k-1-j}`` in sample k."""
        self._kernel = kernel
        self._matrices: dict[int, Array] = {}
        self._spectra: dict[int, np.ndarray] = {}

    def of(self, values: Array) -> Array:
        """The sums that the next s samples receive from these s."""
        reach = values.shape[-1]
        if reach <= DIRECT_REACH:
            return values @ self._matrix(reach)
        size = 2 * reach
        product: Array = fft.irfft(fft.rfft(values, size) * self._spectrum(reach), size)
        return product[..., reach - 1 : size - 1]

    def _entries(self, reach: int) -> Array:
        found = np.zeros(2 * reach - 1)
        known = self._kernel[: 2 * reach - 1]
        found[: len(known)] = known
        return found

    def _matrix(self, reach: int) -> Array:
        if reach not in self._matrices:
            shift = np.arange(reach)
            self._matrices[reach] = self._entries(reach)[reach - 1 + shift[None, :] - shift[:, None]]
        return self._matrices[reach]

    def _spectrum(self, reach: int) -> np.ndarray:
        if reach not in self._spectra:
            self._spectra[reach] = fft.rfft(self._entries(reach), 2 * reach)
        return self._spectra[reach]


def march(
    kernel: Array, forcing: Array, finish: Finish, *, block: int = BLOCK, progress: Progress | None = None
) -> int:
    """Run ``y_k = forcing_k + sum_{j<k} kernel_{k-1-j} v_j`` over all samples k, where v_k may depend on y_k.

    Parameters
    ----------
    kernel : array
        At least as many entries as samples, less one.
    forcing : array
        Time on its last axis; overwritten by the sums.
    finish : function of (first sample, sums)
        Receives a block's sums without the block's own past; completes them in place and returns its v, fewer where
        the march must end before the block's end.
    block : int
        Samples in a block, a power of two.
    progress : function, optional
        Told the samples done.

    Returns
    -------
    int
        The number of samples marched.
    """
    count: int = forcing.shape[-1]
    past = PastSums(kernel)
    values = np.empty_like(forcing)
    for start in range(0, count, block):
        end = min(start + block, count)
        made = finish(start, forcing[..., start:end])
        if made.shape[-1] < end - start:
            return start + int(made.shape[-1])
        values[..., start:end] = made
        if progress is not None:
            progress(end)
        if end < count:
            number = end // block
            reach = block * (number & -number)
            ahead = min(end + reach, count)
            forcing[..., end:ahead] += past.of(values[..., end - reach : end])[..., : ahead - end]
    return count


def approx_product(kernel: Array, values: Array) -> Array:
    """``sum_{j<=k} kernel_{k-j} v_j`` for every sample k, from a kernel of at least as many entries.

    By one FFT, padded so that nothing wraps around; block after block where v grows more than tenfold, or is short.
    """
    count = values.shape[-1]
    half = count // 2
    if count <= BLOCK or largest(values) > GROWING * largest(values[..., :half]):
        return _product_by_blocks(kernel, values)
    size, rows = fast_length(2 * count - 1), values.reshape(-1, count)
    spectrum, sums, some = fft.rfft(kernel[:count], size), np.empty_like(rows), max(1, AT_ONCE // size)
    for i in range(0, len(rows), some):
        sums[i : i + some] = fft.irfft(fft.rfft(rows[i : i + some], size) * spectrum, size)[:, :count]
    return sums.reshape(values.shape)


def _product_by_blocks(kernel: Array, values: Array) -> Array:
    sums = np.zeros_like(values)
    length = min(BLOCK, values.shape[-1])
    lag = np.arange(length)[None, :] - np.arange(length)[:, None]
    inside = np.where(lag > 0, kernel[lag], 0.0)

    def finish(start: int, block: Array) -> Array:
        v: Array = values[..., start : start + block.shape[-1]]
        block += v @ inside[: block.shape[-1], : block.shape[-1]]
        return v

    march(kernel[1:], sums, finish)
    sums += kernel[0] * values
    return sums
