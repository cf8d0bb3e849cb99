"""Which errors say that memory ran out."""

import errno

import pytest

from fomas_verify.exact.errors import FomasError, out_of_memory


def led_to(cause: BaseException, *, hidden: bool) -> BaseException:
    try:
        try:
            raise cause
        except BaseException:
            if hidden:
                raise FomasError("numpy is missing") from None
            raise FomasError("numpy is missing")  # noqa: B904  # how a chain without `from` looks is the question
    except FomasError as error:
        return error


BEYOND = [
    MemoryError(),
    OSError(errno.ENOMEM, "Cannot allocate memory"),
    RuntimeError("can't start new thread"),
    ImportError("libopenblas.so: failed to map segment from shared object"),
]
OTHER = [
    OSError(errno.ENOSPC, "No space left on device"),
    ImportError("No module named 'numpy'"),
    ValueError("memory"),
    FomasError("cannot allocate memory"),
]


@pytest.mark.parametrize("error", BEYOND, ids=repr)
def test_those_that_do(error: BaseException) -> None:
    assert out_of_memory(error)
    assert out_of_memory(led_to(error, hidden=False))
    assert out_of_memory(led_to(error, hidden=True))


@pytest.mark.parametrize("error", OTHER, ids=repr)
def test_those_that_do_not(error: BaseException) -> None:
    assert not out_of_memory(error)
    assert not out_of_memory(led_to(error, hidden=True))
