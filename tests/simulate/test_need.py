"""A run that does not fit in memory is refused before it starts, with what it would need."""

import pytest

from fomas_verify.simulate.errors import SimulationError
from fomas_verify.simulate.need import available_bytes, must_fit, needed_bytes


def need(samples: int, **changes: object) -> int:
    return needed_bytes(5, samples, **{"controllers": 2, "between": 0, "table": False, **changes})


def test_the_need_is_linear_in_samples() -> None:
    assert need(1_999_999) == 2 * need(999_999)
    assert need(999_999, table=True) > 2 * need(999_999)
    assert need(999_999, between=9) > need(999_999)


def test_what_fits_passes() -> None:
    must_fit(need(1000), available_bytes(), 1000)
    must_fit(10**20, None, 10**15)
    must_fit(100, 100, 1)


@pytest.mark.parametrize(("size", "words"), [(10**10, "10 GB"), (25 * 10**11, "2.5 TB")])
def test_what_does_not_fit_is_refused(size: int, words: str) -> None:
    with pytest.raises(SimulationError, match=f"77 samples would need about {words} of memory, 1 GB are free"):
        must_fit(size, 10**9, 77)
