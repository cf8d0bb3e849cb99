"""The loop by its modes against the direct O(K^2) sum, the first entries included, and where it declines."""

from typing import Any

import numpy as np
import pytest

from fomas_verify.design import design_from_mapping
from fomas_verify.simulate import MEMORYLESS, Plant, modes, plant_of, simulate, truncated
from fomas_verify.simulate.memory import approx_step_response
from fomas_verify.simulate.modes import approx_by_modes
from fomas_verify.simulate.series import approx_resolvents
from tests.simulate.designs import PAPER, random_design

SIZES = [1, 2, 3, 62, 63, 64, 65, 127, 128, 129, 500, 1025]
COUNT = 1500

CYCLE = {**PAPER, "graph": {"family": "directed-cycle", "agents": 5}}
COMPLETE = {**PAPER, "gamma": "1/20", "graph": {"family": "complete", "agents": 5}}
APART = {**PAPER, "graph": {"agents": 5, "edges": [[1, 2], [2, 1], [3, 4], [4, 5], [5, 3]]}}
CHAIN = {**PAPER, "graph": {"agents": 5, "edges": [[i, i + 1] for i in range(1, 5)]}}  # defective: one Jordan block
NEARLY = {**PAPER, "graph": {"agents": 5, "edges": [[i, i + 1, f"1.{i:05d}"] for i in range(1, 5)]}}


def plant(design: dict[str, Any]) -> Plant:
    return plant_of(design_from_mapping(design))


def summed(of: Plant, count: int) -> np.ndarray:
    """``x_{k+1} = x_0 - mu sum_j c_{k-j} L x_j``, term by term with longer floats than the package's."""
    c = approx_step_response(of.alpha, count).astype(np.longdouble)
    states, errors = (np.empty((count, len(of.x0)), np.longdouble) for _ in range(2))
    for k in range(count):
        states[k] = of.x0[:, 0] - np.longdouble(of.mu) * (c[:k][::-1] @ errors[:k])
        errors[k] = of.laplacian @ states[k]
    return states.T


def apart(found: np.ndarray, true: np.ndarray) -> float:
    """The worst entry, as a share of the largest up to its own sample."""
    largest = np.maximum.accumulate(np.max(np.abs(true), axis=0))
    return float(np.max(np.abs(found[:, 0] - true) / largest))


@pytest.mark.parametrize("count", SIZES)
@pytest.mark.parametrize("pairs", [0, 1, 3])
def test_resolvents(count: int, pairs: int) -> None:
    """Of real and complex factors: ``g_n = -factor sum_{j<n} g_j kernel_{n-1-j}``."""
    source = np.random.default_rng(count)
    factors = np.concatenate([source.uniform(0, 1, 3), source.uniform(0, 1, pairs) + 0.5j])
    kernel = approx_step_response(0.8, count)
    true = np.ones((len(factors), count + 1), dtype=complex)
    for n in range(1, count + 1):
        true[:, n] = -factors * (true[:, :n] @ kernel[:n][::-1])
    turns = np.stack([factors[3:].real, factors[3:].imag], axis=-1).reshape(-1)
    found = approx_resolvents(kernel, np.concatenate([factors[:3].real, turns]), pairs)
    assert found.shape == (3 + 2 * pairs, count + 1)
    assert np.abs(found[:3] - true[:3]).max() <= 2e-15 * max(3, np.abs(true).max())
    assert np.abs(found[3::2] + 1j * found[4::2] - true[3:]).max(initial=0.0) <= 1e-14


def test_many_resolvents_are_each_alone() -> None:
    kernel, factors = approx_step_response(0.5, 5000), np.linspace(0.1, 0.9, 9)
    together = approx_resolvents(kernel, factors, 2)
    assert np.abs(together[:5] - approx_resolvents(kernel, factors[:5])).max() <= 1e-14
    assert np.abs(together[7:] - approx_resolvents(kernel, factors[7:], 1)).max() <= 1e-14


@pytest.mark.parametrize(
    "design", [PAPER, CYCLE, COMPLETE, APART], ids=["paper", "complex eigenvalues", "equal ones", "two networks"]
)
def test_the_modes_are_the_loop(design: dict[str, Any]) -> None:
    of = plant(design)
    found = approx_by_modes(of, approx_step_response(of.alpha, COUNT))
    assert found is not None
    assert apart(found[0], summed(of, COUNT)) <= 1e-13
    assert np.array_equal(found[1], of.error(found[0]))


@pytest.mark.parametrize("seed", range(12))
def test_random_designs(seed: int) -> None:
    """Some are unstable under this law, and end early."""
    of = plant(random_design(seed))
    run = simulate(of, MEMORYLESS, COUNT - 1)
    assert apart(run.states, summed(of, run.last + 1)) <= 1e-12


@pytest.mark.parametrize("design", [CHAIN, NEARLY], ids=["defective", "nearly defective"])
def test_without_well_conditioned_eigenvectors_it_declines(design: dict[str, Any]) -> None:
    of = plant(design)
    assert approx_by_modes(of, approx_step_response(of.alpha, COUNT)) is None
    assert apart(simulate(of, MEMORYLESS, COUNT - 1).states, summed(of, COUNT)) <= 1e-12


@pytest.mark.parametrize("gamma", ["0.75", "2"], ids=["slowly", "fast"])
def test_a_growing_loop_is_left_to_the_blocks(gamma: str) -> None:
    """So that what came before it grew keeps its digits."""
    of = plant({**PAPER, "gamma": gamma})
    assert approx_by_modes(of, approx_step_response(of.alpha, COUNT)) is None
    run = simulate(of, MEMORYLESS, COUNT - 1)
    count = min(run.last + 1, 150)
    assert apart(run.states[..., :count], summed(of, count)) <= 1e-12


def test_few_samples_and_many_agents_are_left_to_the_blocks() -> None:
    of = plant(PAPER)
    assert approx_by_modes(of, approx_step_response(of.alpha, 200)) is None
    wide = plant({**PAPER, "x0": [*range(65)], "graph": {"family": "cycle", "agents": 65}})
    assert approx_by_modes(wide, approx_step_response(0.9, 300)) is None


@pytest.mark.parametrize("error", [1e-9, np.nan])
def test_wrong_eigenvalues_are_noticed(monkeypatch: pytest.MonkeyPatch, error: float) -> None:
    true, of = np.linalg.eig, plant(PAPER)

    def wrong(matrix: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        values, vectors = true(matrix)
        return values + error * (np.abs(values) > 2.5), vectors

    monkeypatch.setattr(modes.np.linalg, "eig", wrong)
    assert approx_by_modes(of, approx_step_response(of.alpha, COUNT)) is None


def test_several_numbers_an_agent_and_progress() -> None:
    x0 = [["4.5", 1], [5, 0], [6, -3], ["1.5", "0.25"], [-1, 7]]
    of, told = plant({**PAPER, "x0": x0}), []
    run = simulate(of, truncated(8), 400, progress=told.append)
    assert told[-1] == 401
    for d in range(2):
        alone = simulate(plant({**PAPER, "x0": [row[d] for row in x0]}), truncated(8), 400)
        assert np.abs(run.states[:, d] - alone.states[:, 0]).max() <= 1e-13


def test_modes_one_by_one(monkeypatch: pytest.MonkeyPatch) -> None:
    """As where they would not fit in memory together."""
    of = plant(PAPER)
    kernel = approx_step_response(of.alpha, COUNT)
    together = approx_by_modes(of, kernel)
    monkeypatch.setattr(modes, "AT_ONCE", 1)
    alone = approx_by_modes(of, kernel)
    assert together is not None
    assert alone is not None
    assert np.abs(alone[0] - together[0]).max() <= 1e-14
