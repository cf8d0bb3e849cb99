"""A trajectory is compared with what is certified: true bounds pass, false ones are found, and a wrong plant."""

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

from fomas_verify.cli.certified import certified_of
from fomas_verify.design import Design
from fomas_verify.enclosure.interval import Interval
from fomas_verify.enclosure.reference import DisagreementError
from fomas_verify.simulate import MEMORYLESS, PROPOSED, Plant, Trajectory, simulate, truncated, with_between
from fomas_verify.simulate.against import Bounds, check_against, check_driven


@pytest.fixture(scope="module")
def bounds(paper: Design) -> Bounds:
    found = certified_of(replace(paper, settle_to=Fraction(1, 100))).bounds
    assert found is not None
    return found


@pytest.fixture(scope="module")
def run(plant: Plant) -> Trajectory:
    return with_between(plant, simulate(plant, PROPOSED, 300), 4)


def test_everything_certified_is_compared_and_holds(run: Trajectory, bounds: Bounds) -> None:
    found = check_against(run, bounds)
    assert len(found) == 6
    assert all(x.holds for x in found)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"limit": (Fraction(33, 10),)}, "mean(x_k) - limit"),
        ({"kappa": Fraction(1, 2)}, "norm(x_k - limit)"),
        ({"rho": Fraction(7, 10)}, "norm(x_k - limit)"),
        ({"settling": 15}, "settled"),
        ({"settle_to": Fraction(1, 10**8)}, "settled"),
        ({"peak": Interval.exactly(Fraction(99, 100))}, "by peak"),
        ({"reach": Interval.exactly(Fraction(9, 5))}, "by reach"),
        ({"overshoot": Interval.exactly(Fraction(1, 2))}, "norm(x(t) - x_k)"),
    ],
)
def test_a_wrong_certificate_is_found(run: Trajectory, bounds: Bounds, change: dict[str, object], words: str) -> None:
    with pytest.raises(DisagreementError, match="certified is at most") as caught:
        check_against(run, replace(bounds, **change))
    assert words in str(caught.value)
    assert caught.value.exit_status == 4


@pytest.mark.parametrize(
    "change",
    [{"gamma": 0.3}, {"x0": np.array([[4.5], [5.0], [6.0], [1.5], [-2.0]])}, {"weight": 0.3}],
    ids=["gamma", "x0", "weight"],
)
def test_another_plants_trajectory_is_found(plant: Plant, bounds: Bounds, change: dict[str, object]) -> None:
    with pytest.raises(DisagreementError):
        check_against(simulate(replace(plant, **change), PROPOSED, 300), bounds)


def test_the_memoryless_law_does_not_keep_what_is_certified_of_the_papers(plant: Plant, bounds: Bounds) -> None:
    with pytest.raises(DisagreementError, match=r"norm\(x_k - limit\)"):
        check_against(simulate(plant, MEMORYLESS, 300), bounds)


@pytest.mark.parametrize("law", [PROPOSED, MEMORYLESS, truncated(5)], ids=lambda law: law.name)
def test_the_plant_goes_where_the_loop_says(plant: Plant, law: object) -> None:
    check_driven(plant, simulate(plant, law, 500))
    check_driven(replace(plant, gamma=40.0), simulate(replace(plant, gamma=40.0), law, 500))


@pytest.mark.parametrize(
    "change", [{"alpha": 0.9000001}, {"weight": 0.898}, {"x0": np.ones((5, 1))}], ids=["alpha", "weight", "x0"]
)
def test_a_wrong_plant_is_found(plant: Plant, change: dict[str, object]) -> None:
    run = simulate(plant, MEMORYLESS, 300)
    with pytest.raises(DisagreementError, match="memoryless: the closed loop and the plant driven by its inputs"):
        check_driven(replace(plant, **change), run)


def test_a_state_that_is_no_number_is_found(plant: Plant) -> None:
    run = simulate(plant, PROPOSED, 30)
    states = run.states.copy()
    states[2, 0, 7] = np.nan
    with pytest.raises(DisagreementError, match="at k = 7"):
        check_driven(plant, replace(run, states=states))


def test_nothing_is_certified_where_consensus_is_not_proved(paper: Design) -> None:
    unstable = certified_of(replace(paper, gamma=Fraction(2)))
    assert unstable.bounds is None
    assert unstable.limit == (Fraction(16, 5),)
    assert unstable.reason == "consensus is not proved of this design"
