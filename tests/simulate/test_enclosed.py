"""The tube contains the trajectory that its definition gives in 60 digits, and is narrow."""

from dataclasses import replace
from fractions import Fraction
from typing import Any

import mpmath
import pytest
from mpmath import mp

from fomas_verify.design import Design, design_from_mapping
from fomas_verify.enclosure.interval import Interval
from fomas_verify.simulate import MEMORYLESS, PROPOSED, Law, enclosed, truncated
from fomas_verify.simulate.digits import simulate_to
from fomas_verify.simulate.enclosed import Tube, enclose
from fomas_verify.simulate.errors import NoEnclosureError
from fomas_verify.simulate.loop import solve
from tests.simulate.designs import PAPER, random_design
from tests.simulate.direct import Direct

LAWS = [PROPOSED, MEMORYLESS, truncated(6)]
SAMPLES = 60


def exact(x: Any) -> Fraction:
    p, q = mpmath.libmp.to_rational(x._mpf_)
    return Fraction(int(p), int(q))


def outside(tube: list[list[list[Interval]]], true: list[list[Any]]) -> int:
    """How many entries lie outside of their enclosure by more than the oracle's own last digits."""
    slack = Fraction(1, 10**55)
    return sum(
        not x.lower - slack <= exact(true[k][i]) <= x.upper + slack
        for i, row in enumerate(tube)
        for k, x in enumerate(row[0])
    )


@pytest.mark.parametrize("seed", range(20))
def test_the_tube_contains_a_sixty_digit_trajectory(seed: int) -> None:
    """The three laws by turns, each on six or seven designs; the paper's on all."""
    design = random_design(seed)
    for law in {PROPOSED, LAWS[seed % 3]}:
        tube = enclose(design_from_mapping(design), law, SAMPLES)
        with mp.workdps(75):
            true = Direct(design, SAMPLES, memory=law.memory)
        assert outside(tube.states, true.states) == 0
        assert outside(tube.inputs, true.inputs) == 0
        assert tube.widest < Fraction(1, 10**30)


@pytest.mark.parametrize("law", LAWS, ids=lambda law: law.name)
def test_narrow_enough(law: Law, paper: Design) -> None:
    """Narrower than asked, 1e-20 at K = 200; the agents of the paper's law end at 3.2."""
    told: list[int] = []
    tube = enclose(paper, law, 200, progress=told.append)
    assert told == sorted(told)
    assert 0 < told[0] < told[-1] == 40
    assert tube.widest < Fraction(1, 10**20)
    assert all(len(row[0]) == 201 for row in tube.states + tube.inputs)
    if law is PROPOSED:
        assert all(abs(row[0][-1].mid - Fraction(16, 5)) < Fraction(1, 10**15) for row in tube.states)


@pytest.mark.slow
@pytest.mark.parametrize("law", LAWS, ids=lambda law: law.name)
def test_narrow_at_ten_thousand_samples(law: Law, paper: Design) -> None:
    assert enclose(paper, law, 10_000).widest < Fraction(1, 10**10)


def test_between_the_samples_and_another_order(paper: Design) -> None:
    tube = enclose(paper, PROPOSED, 30, alpha_controller=Fraction(3, 4), between=2)
    with mp.workdps(75):
        true = Direct(PAPER, 30, tuned="3/4")
        inside = [[true.between(k, Fraction(i, 3)) for k in range(30)] for i in (1, 2)]
    assert outside(tube.states, true.states) == 0
    assert [outside(part, xs) for part, xs in zip(tube.between, inside, strict=True)] == [0, 0]
    assert all(len(row[0]) == 30 for part in tube.between for row in part)


def test_another_trajectory_is_outside(paper: Design) -> None:
    """The test above can fail: one part in 10^30 of x0 or of gamma is seen."""
    tube = enclose(paper, MEMORYLESS, 20)
    for key, change in (("gamma", Fraction(15, 100) * (1 + Fraction(1, 10**30))), ("x0", None)):
        x0 = [Fraction(9, 2) + Fraction(1, 10**30), 5, 6, Fraction(3, 2), -1]
        with mp.workdps(75):
            true = Direct({**PAPER, key: change or x0}, 20, memory=0)
        assert outside(tube.states, true.states) > 0


def test_several_numbers_an_agent() -> None:
    x0 = [[1, 2], [3, 4], [5, 6], [7, 8], [9, "1/3"]]
    tube = enclose(design_from_mapping({**PAPER, "x0": x0}), MEMORYLESS, 20)
    for d in range(2):
        alone = enclose(design_from_mapping({**PAPER, "x0": [row[d] for row in x0]}), MEMORYLESS, 20)
        for i in range(5):
            assert all(x.overlaps(y) for x, y in zip(tube.states[i][d], alone.states[i][0], strict=True))
            assert all(x.overlaps(y) for x, y in zip(tube.inputs[i][d], alone.inputs[i][0], strict=True))


def test_mu_in_place_of_gamma(paper: Design) -> None:
    design = replace(paper, gamma=None, mu=Fraction(1, 7))
    tube = enclose(design, PROPOSED, 3)
    first_error = 2 * Fraction(9, 2) - Fraction(3, 2) - (-1)
    assert tube.states[0][0][1].contains(Fraction(9, 2) - first_error / 7)


def test_a_wrong_float_solver_only_widens_or_is_refused(paper: Design, monkeypatch: pytest.MonkeyPatch) -> None:
    """The enclosure trusts nothing that floats proposed."""
    true = enclose(paper, MEMORYLESS, 40)

    def nearly(plant: Any, kernel: Any, forcing: Any, progress: Any = None) -> int:
        marched = solve(plant, kernel, forcing, progress)
        forcing *= 1.0001
        return marched

    monkeypatch.setattr(enclosed, "solve", nearly)
    tube = enclose(paper, MEMORYLESS, 40)
    assert all(
        x.overlaps(y) for a, b in zip(tube.states, true.states, strict=True) for x, y in zip(a[0], b[0], strict=True)
    )
    monkeypatch.setattr(enclosed, "solve", lambda plant, kernel, forcing, progress=None: len(forcing))
    with pytest.raises(NoEnclosureError):
        enclose(paper, MEMORYLESS, 40)


def test_a_loop_that_grows_is_enclosed_or_refused(paper: Design) -> None:
    wild = replace(paper, gamma=Fraction(2))
    short = enclose(wild, MEMORYLESS, 12)
    with mp.workdps(75):
        true = Direct({**PAPER, "gamma": 2}, 12, memory=0)
    assert outside(short.states, true.states) == 0
    with pytest.raises(NoEnclosureError, match="no enclosure found over 600 samples") as caught:
        enclose(wild, MEMORYLESS, 600)
    assert caught.value.exit_status == 3


@pytest.mark.parametrize("law", LAWS, ids=lambda law: law.name)
def test_many_digits_by_mpmath(law: Law, paper: Design) -> None:
    """Every digit but the last, against the oracle; and inside the tube."""
    run = simulate_to(paper, law, 40, 50, between=1, alpha_controller=Fraction(4, 5))
    tube: Tube = enclose(paper, law, 40, between=1, alpha_controller=Fraction(4, 5))
    with mp.workdps(75):
        true = Direct(PAPER, 40, memory=law.memory, tuned="4/5")
        inside = [true.between(k, Fraction(1, 2)) for k in range(40)]
    for texts, values, bounds in (
        (run.states, true.states, tube.states),
        (run.inputs, true.inputs, tube.inputs),
        (run.between[0], inside, tube.between[0]),
    ):
        for i in range(5):
            for k, text in enumerate(texts[i][0]):
                x = exact(values[k][i])
                assert abs(Fraction(text) - x) <= abs(x) / 10**49
                assert (
                    bounds[i][0][k].lower - abs(x) / 10**49 <= Fraction(text) <= bounds[i][0][k].upper + abs(x) / 10**49
                )


def test_many_digits_of_several_numbers() -> None:
    x0 = [[1, 2], [3, 4], [5, 6], [7, 8], [9, 10]]
    run = simulate_to(design_from_mapping({**PAPER, "x0": x0}), PROPOSED, 6, 30)
    alone = simulate_to(design_from_mapping({**PAPER, "x0": [row[1] for row in x0]}), PROPOSED, 6, 30)
    assert [row[1] for row in run.states] == [row[0] for row in alone.states]
    assert [row[1] for row in run.inputs] == [row[0] for row in alone.inputs]
