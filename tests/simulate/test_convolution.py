"""Fast sums over the past against the direct O(K^2) sum, the first entries included."""

import numpy as np
import pytest

from fomas_verify.simulate.convolution import approx_product, march
from fomas_verify.simulate.memory import approx_step_response

SIZES = [1, 2, 3, 63, 64, 65, 127, 128, 129, 191, 192, 193, 511, 513, 1500]


def direct(kernel: np.ndarray, values: np.ndarray) -> np.ndarray:
    count = values.shape[-1]
    return np.array([[np.dot(kernel[: k + 1][::-1], row[: k + 1]) for k in range(count)] for row in values])


@pytest.mark.parametrize("count", SIZES)
@pytest.mark.parametrize("growth", [0.97, 1.0, 1.05, 1.4])
def test_product(count: int, growth: float) -> None:
    source = np.random.default_rng(count)
    kernel = approx_step_response(0.8, count + 3)
    with np.errstate(over="ignore"):
        values = source.normal(size=(3, count)) * growth ** np.arange(count)
    true, found = direct(kernel, values), approx_product(kernel, values)
    assert found.shape == true.shape
    before = np.maximum.accumulate(np.max(np.abs(values), axis=0)) if growth > 1 else np.max(np.abs(values))
    assert (np.abs(found - true) <= 1e-12 * before).all()
    first = slice(0, min(count, 5))
    assert np.abs(found - true)[:, first].max() <= 1e-12 * np.abs(values).max()


def test_a_circular_product_would_be_seen() -> None:
    """The test above tells a padded transform from an unpadded one."""
    values = np.random.default_rng(1).normal(size=(1, 512))
    kernel = approx_step_response(0.8, 512)
    wrapped = np.fft.irfft(np.fft.rfft(values) * np.fft.rfft(kernel), 512)
    assert np.abs(wrapped - direct(kernel, values))[:, :5].max() > 0.1


@pytest.mark.parametrize("count", SIZES)
@pytest.mark.parametrize("block", [8, 64])
def test_march(count: int, block: int) -> None:
    """``y_k = b_k + sum_{j<k} g_{k-1-j} v_j`` with ``v = -y/4``, done block after block."""
    kernel = approx_step_response(0.6, count)
    forcing = np.random.default_rng(count).normal(size=(2, count))
    true = forcing.copy()
    for k in range(1, count):
        true[:, k] -= true[:, :k] @ kernel[k - 1 :: -1][:k] / 4
    seen = []

    def finish(start: int, sums: np.ndarray) -> np.ndarray:
        seen.append(start)
        for i in range(1, sums.shape[-1]):
            sums[:, i] -= sums[:, :i] @ kernel[i - 1 :: -1][:i] / 4
        return -sums / 4

    done: list[int] = []
    assert march(kernel, forcing, finish, block=block, progress=done.append) == count
    assert np.abs(forcing - true).max() <= 1e-12 * np.abs(true).max()
    assert seen == list(range(0, count, block))
    assert done[-1] == count


def test_a_march_ends_where_it_is_told() -> None:
    def finish(start: int, sums: np.ndarray) -> np.ndarray:
        return sums[..., :5] if start == 64 else sums

    assert march(np.ones(300), np.ones((1, 300)), finish) == 69
