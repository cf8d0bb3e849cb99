"""Trajectories against the loop by its definition, the paper's numbers, and theory's asymptotics."""

import doctest
from dataclasses import replace
from fractions import Fraction
from math import gamma
from typing import Any

import numpy as np
import pytest
from mpmath import mp

from fomas_verify.design import Design, design_from_mapping
from fomas_verify.network import family
from fomas_verify.simulate import MEMORYLESS, PROPOSED, Law, Plant, loop, plant_of, simulate, simulate_own, truncated
from fomas_verify.simulate.errors import SimulationError
from fomas_verify.simulate.loop import LARGEST, with_between
from tests.simulate.designs import PAPER, random_design
from tests.simulate.direct import Direct

LIMIT = np.array([3.2])
LAWS = [PROPOSED, MEMORYLESS, truncated(7)]


def apart(found: np.ndarray, true: list[list[Any]]) -> float:
    """The largest difference, as a share of the largest entry."""
    expected = np.array([[float(x) for x in row] for row in true]).T
    return float(np.max(np.abs(found[:, 0] - expected)) / np.max(np.abs(expected)))


@pytest.mark.parametrize("law", LAWS, ids=lambda law: law.name)
@pytest.mark.parametrize("seed", range(6))
def test_the_loop_by_its_definition(law: Law, seed: int) -> None:
    design = random_design(seed)
    run = simulate(plant_of(design_from_mapping(design)), law, 150)
    with mp.workdps(40):
        true = Direct(design, 150, memory=law.memory)
    assert apart(run.states, true.states) <= 1e-12
    assert apart(run.inputs, true.inputs) <= 1e-12
    assert not run.stopped


@pytest.mark.parametrize("law", LAWS, ids=lambda law: law.name)
def test_a_controller_tuned_for_another_order(plant: Plant, law: Law) -> None:
    run = simulate(plant, law, 120, alpha_controller=0.75)
    with mp.workdps(40):
        true = Direct(PAPER, 120, memory=law.memory, tuned="3/4")
    assert apart(run.states, true.states) <= 1e-12
    assert apart(run.inputs, true.inputs) <= 1e-12


def test_tuned_for_another_order_is_another_loop(plant: Plant) -> None:
    other, same = (simulate(plant, PROPOSED, 50, alpha_controller=x) for x in (0.89, 0.9))
    assert np.abs(other.states - same.states).max() > 1e-3


@pytest.mark.parametrize("law", LAWS, ids=lambda law: law.name)
def test_between_the_samples(plant: Plant, law: Law) -> None:
    run = with_between(plant, simulate(plant, law, 40), 3)
    assert run.between.shape == (3, 5, 1, 40)
    with mp.workdps(40):
        true = Direct(PAPER, 40, memory=law.memory)
        for i in (1, 2, 3):
            for k in (0, 1, 17, 39):
                expected = [float(x) for x in true.between(k, Fraction(i, 4))]
                assert np.abs(run.between[i - 1, :, 0, k] - expected).max() <= 1e-12


def test_all_states_tend_to_the_mean(plant: Plant) -> None:
    assert np.abs(simulate(plant, PROPOSED, 200).states[..., -1] - 3.2).max() < 1e-12


def test_the_contraction_along_the_papers_trajectory(plant: Plant) -> None:
    """``norm e_5 / norm e_4 = 0.87602228...``, above beta = 0.8652...."""
    run = simulate(plant, PROPOSED, 5)
    e = np.linalg.norm(plant.error(run.states), axis=(0, 1))
    assert 0.87602228 <= e[5] / e[4] < 0.87602229


def test_the_control_decays_as_theory_says(plant: Plant) -> None:
    """``u_k t_k^alpha Gamma(1 - alpha) -> mean - x_0``."""
    u = simulate(plant, PROPOSED, 4000).inputs[:, 0, -1]
    ratio = u * (4000 * 0.85) ** 0.9 * gamma(0.1) / (3.2 - plant.x0[:, 0])
    assert np.abs(ratio - 1).max() < 0.002


def test_the_mean_absolute_errors(plant: Plant) -> None:
    proposed, memoryless = (simulate(plant, law, 200).mean_absolute_error(LIMIT) for law in (PROPOSED, MEMORYLESS))
    assert 0.01018416 <= proposed[20] < 0.01018417
    assert 0.20473793 <= memoryless[20] < 0.20473794
    assert 0.01211783 <= memoryless[200] < 0.01211784


def test_the_memoryless_law_decays_as_theory_says(plant: Plant) -> None:
    """``x - mean ~ (1/gamma) L^+ (x_0 - mean) t^(-alpha) / Gamma(1 - alpha)``, and c_M times that when truncated."""
    shape = np.linalg.pinv(plant.laplacian) @ (plant.x0[:, 0] - 3.2) / (0.15 * gamma(0.1) * (0.85 * 60_000) ** 0.9)
    for law, share in ((MEMORYLESS, 1.0), (truncated(20), 21**0.9 - 20**0.9)):
        ratio = (simulate(plant, law, 60_000).states[:, 0, -1] - 3.2) / (share * shape)
        assert np.abs(ratio - 1).max() < 0.02


def test_between_the_samples_the_error_decays_slowly(plant: Plant) -> None:
    """Like ``t^(-1-alpha)``, although it is geometric at the samples."""
    run = with_between(plant, simulate(plant, PROPOSED, 2001), 1)
    r = np.abs(run.between[0, :, 0] - 3.2).mean(axis=0)
    assert r[1000] > 1e4 * np.abs(run.states[:, 0, 1000] - 3.2).mean()
    assert abs(np.log2(r[1000] / r[2000]) - 1.9) < 0.01


def test_the_two_ends_of_truncation(plant: Plant) -> None:
    whole, none = simulate(plant, truncated(300), 300), simulate(plant, truncated(0), 300)
    for run, same in ((whole, PROPOSED), (none, MEMORYLESS)):
        expected = simulate(plant, same, 300)
        assert np.abs(run.states - expected.states).max() <= 1e-12
        assert np.abs(run.inputs - expected.inputs).max() <= 1e-12


def test_a_transposed_graph_is_caught(plant: Plant) -> None:
    """On a balanced graph every spectral verdict is the same for both; the trajectory is not."""
    graph = PAPER["graph"]
    turned = {**graph, "edges": [[to, source, a] for source, to, a in graph["edges"]]}
    run = simulate(plant_of(design_from_mapping({**PAPER, "graph": turned})), PROPOSED, 20)
    with mp.workdps(30):
        true = Direct(PAPER, 20)
    assert apart(run.states, true.states) > 0.1
    assert apart(simulate(plant, PROPOSED, 20).states, true.states) < 1e-13


@pytest.mark.parametrize("law", LAWS, ids=lambda law: law.name)
def test_agents_with_several_numbers(law: Law) -> None:
    """Remark 1: each component is a loop of its own."""
    x0 = [["4.5", 1], [5, 0], [6, -3], ["1.5", "0.25"], [-1, 7]]
    run = simulate(plant_of(design_from_mapping({**PAPER, "x0": x0})), law, 300)
    assert run.states.shape == (5, 2, 301)
    for d in range(2):
        alone = simulate(plant_of(design_from_mapping({**PAPER, "x0": [row[d] for row in x0]})), law, 300)
        assert np.abs(run.states[:, d] - alone.states[:, 0]).max() <= 1e-12


@pytest.mark.parametrize("law", LAWS, ids=lambda law: law.name)
@pytest.mark.parametrize("agents", [9, 20, 66])
def test_more_agents_by_other_ways(law: Law, agents: int) -> None:
    """Shorter blocks, sample by sample, and a sparse Laplacian, against the definition."""
    edges = [[i, i % agents + 1, 1] for i in range(1, agents + 1)]
    x0 = [Fraction(i * i % 17 - 5, 3) for i in range(agents)]
    design = {**PAPER, "gamma": "1/2", "x0": x0, "graph": {"agents": agents, "edges": edges}}
    run = simulate(plant_of(design_from_mapping(design)), law, 70)
    with mp.workdps(30):
        true = Direct(design, 70, memory=law.memory)
    assert apart(run.states, true.states) <= 1e-12
    assert apart(run.inputs, true.inputs) <= 1e-12


def test_ten_thousand_agents(paper: Design) -> None:
    """On a torus: the mean is kept and every state stays between the least and the greatest x_0."""
    x0 = [(7 * i) % 11 - 5 for i in range(10_000)]
    state = tuple((Fraction(x),) for x in x0)
    half, torus = Fraction(1, 2), family("torus", shape=(100, 100))
    large = plant_of(replace(paper, gamma=Fraction(1, 5), h=half, x0=state, graph=torus))
    for law in (PROPOSED, MEMORYLESS):
        run = simulate(large, law, 70)
        assert np.abs(run.states.mean(axis=(0, 1)) - np.mean(x0)).max() < 1e-12
        assert run.states.min() >= -5
        assert run.states.max() <= 5
        assert run.states[..., -1].std() < run.states[..., 0].std() / 4


@pytest.mark.parametrize("law", LAWS, ids=lambda law: law.name)
@pytest.mark.parametrize("agents", [5, 30, 70])
def test_an_unstable_loop_is_stopped(law: Law, agents: int) -> None:
    edges = [[i, i % agents + 1, 1] for i in range(1, agents + 1)]
    x0 = [i * i % 17 for i in range(agents)]
    design = {**PAPER, "gamma": 40, "x0": x0, "graph": {"agents": agents, "edges": edges}}
    plant = plant_of(design_from_mapping(design))
    run = simulate(plant, law, 2000)
    assert run.stopped
    assert 10 < run.last < 200
    assert np.isfinite(run.states).all()
    assert np.isfinite(run.inputs).all()
    assert LARGEST * 1e-3 < np.abs(run.states[..., -1]).max() <= 100 * LARGEST
    with mp.workdps(130):
        true = Direct(design, 12, memory=law.memory)
    assert apart(run.inputs[..., :13], true.inputs) <= 1e-10
    assert not simulate(plant, law, 10).stopped


def test_a_controller_of_ones_own(plant: Plant) -> None:
    def mine(k: int, states: np.ndarray, inputs: np.ndarray) -> np.ndarray:
        assert states.shape == (k + 1, 5, 1)
        assert inputs.shape == (k, 5, 1)
        return -plant.gamma * plant.error(states[k])

    run, expected = simulate_own(plant, "mine", mine, 300), simulate(plant, MEMORYLESS, 300)
    assert run.controller == "mine"
    assert np.abs(run.states - expected.states).max() <= 1e-12
    assert np.abs(run.inputs - expected.inputs).max() <= 1e-12


def test_the_example_of_a_controller_of_ones_own() -> None:
    result = doctest.testmod(loop)
    assert (result.attempted > 5, result.failed) == (True, 0)


def test_a_controller_of_ones_own_may_not_rewrite_the_past(plant: Plant) -> None:
    def cheat(k: int, states: np.ndarray, inputs: np.ndarray) -> np.ndarray:
        states[0] = 0
        return states[k]

    with pytest.raises(ValueError, match="read-only"):
        simulate_own(plant, "cheat", cheat, 5)


def test_a_controller_of_ones_own_that_explodes_is_stopped(plant: Plant) -> None:
    run = simulate_own(plant, "wild", lambda k, states, inputs: 1e3 * states[k], 500)
    assert run.stopped
    assert np.isfinite(run.states).all()
    assert run.states.shape == run.inputs.shape


@pytest.mark.parametrize("numbers", [{"h": "1e1200"}, {"gamma": "1e1200"}, {"x0": [["1e1200"], [0]]}])
def test_a_number_beyond_doubles_is_refused(numbers: dict[str, Any]) -> None:
    given = {"alpha": "1/2", "gamma": 1, "h": 1, "x0": [0, 1], "graph": {"family": "path", "agents": 2}, **numbers}
    with pytest.raises(SimulationError, match=r"^design: simulate needs numbers below 1e308"):
        plant_of(design_from_mapping(given))
