"""The power laws of the benchmarks, on points that lie on one."""

import math

import pytest

from benchmarks.measure import Cost
from benchmarks.model import SECONDS, Point, Power, Series, fit
from benchmarks.page import Results, _growth, page, rounded
from benchmarks.topics import TOPICS, Method, Topic

METHOD = Method("x", "some way", (1, 2))


def series(*points: tuple[int, float, float]) -> Series:
    return Series(METHOD, tuple(Point(*p) for p in points))


def test_a_power_law_is_found_again() -> None:
    found = fit([(n, 3e-5 * n**1.7) for n in (10, 40, 300)])
    assert found is not None
    assert (found.factor, found.exponent) == (pytest.approx(3e-5), pytest.approx(1.7))
    assert found.size_for(found.at(12345)) == pytest.approx(12345)


def test_the_line_is_that_of_least_squares() -> None:
    """Through logarithms (0, 0), (1, 1), (2, 1): slope 1/2, mean 2/3 at 1."""
    found = fit([(math.exp(x), math.exp(y)) for x, y in ((0, 0), (1, 1), (2, 1))])
    assert found is not None
    assert found.exponent == pytest.approx(0.5)
    assert math.log(found.factor) == pytest.approx(2 / 3 - 0.5)


@pytest.mark.parametrize("pairs", [[], [(5, 1.0)], [(5, 1.0), (5, 2.0)]])
def test_no_law_through_one_size(pairs: list[tuple[float, float]]) -> None:
    assert fit(pairs) is None


def test_start_up_is_no_part_of_a_law() -> None:
    found = series((10, 0.005, 50), (100, 0.0051, 50), (1000, 0.1, 50), (2000, 0.4, 50)).time
    assert found is not None
    assert found.exponent == pytest.approx(2)


def test_what_ends_a_method_is_told() -> None:
    by_time = series((1000, 1, 50), (2000, 4, 55)).usable
    assert by_time is not None
    assert by_time[1] == "time"
    assert by_time[0] == pytest.approx(1000 * math.sqrt(SECONDS))


def test_memory_ends_a_method_that_is_fast() -> None:
    found = series((10, 0.1, 90), (100, 0.1, 190), (1000, 0.1, 1190)).usable
    assert found is not None
    assert found[1] == "memory"
    size, _ = found
    assert 4000 < size < 10_000


def test_what_does_not_grow_never_ends() -> None:
    assert math.isinf(Power(2.0, 0.0).size_for(60.0))


def test_between_two_sizes_the_law_of_both_holds() -> None:
    found = series((10, 0.1, 50), (100, 0.1, 50), (1000, 10, 50))
    assert found.between(300) == pytest.approx(0.1 * 3**2)
    assert found.between(5) is None
    assert found.between(2000) is None


@pytest.mark.parametrize(
    ("points", "words"),
    [
        (((1, 1, 50), (2, 2, 54)), "flat"),
        (((1, 1, 50), (2, 2, 54), (4, 4, 90)), "grows at the largest size only"),
        (((1, 1, 50), (2, 2, 60), (4, 4, 70)), "5 MB n^1.00"),
    ],
)
def test_how_memory_grows(points: tuple[tuple[int, float, float], ...], words: str) -> None:
    assert _growth(series(*points)) == words


@pytest.mark.parametrize(("x", "text"), [(5.2, "5"), (61, "61"), (6149, "6,100"), (12_345_678, "12,000,000")])
def test_two_digits(x: float, text: str) -> None:
    assert rounded(x) == text


def test_ratios_are_at_the_same_size_or_marked() -> None:
    ours = Series(TOPICS[0].methods[0], (Point(100, 0.1, 20), Point(1000, 1.0, 20)))
    other = Series(METHOD, (Point(50, 1.0, 20), Point(100, 3.0, 20), Point(500, 5.0, 20)))
    topic = Topic("A topic", "samples", "Words.", (ours.method, METHOD))
    cost = Cost(1.0, 1.0, 30.0)
    found = Results(["machine: m"], [(topic, [ours, other])], {"`x`": cost}, {5: (cost, cost)}, ["fodeint"], ["a goal"])
    text = page(found, "benchmarks.svg")
    assert "|  | 100 | 3 s | 30 | 20 MB |" in text
    assert "|  | 500 | 5 s | about 10 | 20 MB |" in text
    assert "| some way | 50 | 1 s |  | 20 MB |" in text
    assert "Left out, because not installed: fodeint." in text
    assert "a goal" in text
    assert "more than 50,000 samples" not in text


def test_a_model_is_not_followed_far() -> None:
    ours = Series(TOPICS[0].methods[0], (Point(100, 1e-3, 20), Point(1000, 2e-3, 20)))
    topic = Topic("A topic", "samples", "Words.", (ours.method,))
    text = page(Results([], [(topic, [ours])], {"`x`": Cost(1.0, 1.0, 30.0)}, {}, [], []), "x.svg")
    assert "| more than 100,000 samples |" in text
