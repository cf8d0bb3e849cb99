"""The closed loop at the samples, in binary floats.

With ``u = -gamma (q * e)`` and ``g = c * q`` the plant gives ``x_{k+1} = x_0 - mu sum_j g_{k-j} e_j``: one past sum a
sample, whatever the law, made block after block, or all at once by the loop's modes where that is accurate. Where the
paper's law is tuned for the plant's own alpha, g is 1 and ``e_k = P^k e_0``.
Approximate. Source: theory, section 1.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from fomas_verify.simulate.convolution import BLOCK, Finish, Progress, approx_product, march
from fomas_verify.simulate.errors import SimulationError
from fomas_verify.simulate.laws import Control, Law
from fomas_verify.simulate.memory import Array, approx_step_response, largest
from fomas_verify.simulate.modes import approx_by_modes
from fomas_verify.simulate.plant import DENSE_AGENTS, Plant
from fomas_verify.simulate.trajectory import Trajectory

LARGEST = 1e100
"""A loop whose numbers pass this is stopped."""

BLOCK_ORDER = 200
"""A block of samples is solved at once where agents times samples stay below this."""


def simulate(
    plant: Plant, law: Law, samples: int, *, alpha_controller: float | None = None, progress: Progress | None = None
) -> Trajectory:
    """The closed loop with a linear law.

    Parameters
    ----------
    plant : Plant
        The agents.
    law : Law
        `PROPOSED`, `MEMORYLESS` or `truncated(M)`.
    samples : int
        The last sample K >= 1.
    alpha_controller : float, optional
        The order that the controller is tuned for; the plant's own by default.
    progress : function, optional
        Told the samples done.

    Returns
    -------
    Trajectory
        k = 0..K, fewer where the loop outgrows 1e100; approximate: in float arithmetic, about 1e-13 of the largest
        entry for a loop that does not grow.
    """
    count = samples + 1
    tuned = plant.alpha if alpha_controller is None else alpha_controller
    response = law.response(tuned, count)
    with np.errstate(over="ignore", invalid="ignore"):
        if law.memory is None and tuned == plant.alpha:
            errors = _powers(plant, count, progress)
            marched = errors.shape[-1]
            _some(marched)
            states = np.empty_like(errors)
            states[..., 0] = plant.x0
            states[..., 1:] = plant.x0[:, :, None] - plant.mu * np.cumsum(errors[..., :-1], axis=-1)
        else:
            kernel = approx_step_response(plant.alpha, count)
            if law.memory != 0:
                kernel = approx_product(kernel, response)
            found = approx_by_modes(plant, kernel, progress)
            if found is None or not largest(found[0]) < LARGEST:
                found = _marched(plant, kernel, progress)
            states, errors = found
            marched = states.shape[-1]
        inputs = errors if law.memory == 0 else approx_product(response, errors)
        inputs *= -plant.gamma
    return Trajectory(law.name, plant.h, states, inputs, stopped=marched < count)


def _marched(plant: Plant, kernel: Array, progress: Progress | None) -> tuple[Array, Array]:
    states = np.repeat(plant.x0[:, :, None], len(kernel), axis=-1)
    marched = solve(plant, kernel, states, progress)
    _some(marched)
    return states[..., :marched], plant.error(states[..., :marched])


def _some(marched: int) -> None:
    if marched < 2:
        raise SimulationError("simulate: the loop's numbers pass 1e100 before its second sample: nothing to show")


def simulate_own(
    plant: Plant, name: str, control: Control, samples: int, *, progress: Progress | None = None
) -> Trajectory:
    """The closed loop with a controller of your own, any function of the past; as `simulate` otherwise.

    Examples
    --------
    >>> import numpy as np
    >>> from fomas_verify.design import design_from_mapping
    >>> from fomas_verify.simulate import plant_of, simulate_own
    >>> pair = {"family": "path", "agents": 2}
    >>> plant = plant_of(design_from_mapping({"alpha": "1/2", "gamma": "1/4", "h": 1, "x0": [0, 1], "graph": pair}))
    >>> def saturated(k, states, inputs):
    ...     return np.clip(-plant.gamma * plant.error(states[k]), -0.1, 0.1)
    >>> run = simulate_own(plant, "saturated", saturated, 100)
    >>> bool(abs(run.inputs).max() <= 0.1), round(float(run.states[..., -1].mean()), 9)
    (True, 0.5)
    """
    count = samples + 1
    shape = plant.x0.shape
    states, inputs = np.zeros((count, *shape)), np.zeros((count, *shape))
    kernel = approx_step_response(plant.alpha, count)

    def step(k: int, state: Array) -> Array | None:
        states[k] = state
        if not np.max(np.abs(state)) < LARGEST:
            return None
        seen, past = states[: k + 1], inputs[:k]
        seen.flags.writeable = past.flags.writeable = False
        inputs[k] = control(k, seen, past)
        driven: Array = plant.weight * inputs[k]
        return driven

    sums = np.repeat(plant.x0[:, :, None], count, axis=-1)
    with np.errstate(over="ignore", invalid="ignore"):
        marched = march(kernel, sums, _by_steps(kernel, step), progress=progress)
    by_time = [np.moveaxis(x[:marched], 0, -1).copy() for x in (states, inputs)]
    return Trajectory(name, plant.h, by_time[0], by_time[1], stopped=marched < count)


def solve(plant: Plant, kernel: Array, forcing: Array, progress: Progress | None = None) -> int:
    """Solve ``x_k = b_k - mu sum_{j<k} g_{k-1-j} L x_j`` in place of b; returns the samples before x outgrows 1e100.

    Kernel g and forcing b, shape (N, columns, samples), are free: with b constant it is a trajectory.
    """
    agents = len(forcing)
    order = BLOCK_ORDER // agents
    block = min(BLOCK, 1 << order.bit_length() - 1) if order >= 16 else BLOCK
    finish = _at_once(plant, kernel, block) if order >= 16 else _by_steps(kernel, _linear_step(plant))
    return march(kernel, forcing, finish, block=block, progress=progress)


def _linear_step(plant: Plant) -> Callable[[int, Array], Array | None]:
    def step(_: int, state: Array) -> Array | None:
        return -plant.mu * plant.error(state) if np.max(np.abs(state)) < LARGEST else None

    return step


def _by_steps(kernel: Array, step: Callable[[int, Array], Array | None]) -> Finish:
    """A block sample by sample: ``step`` gives v_k from y_k, or None to end."""

    def finish(start: int, sums: Array) -> Array:
        length = sums.shape[-1]
        wanted = np.moveaxis(sums, -1, 0).reshape(length, -1).copy()
        made = np.empty_like(wanted)
        for i in range(length):
            if i:
                wanted[i] += kernel[i - 1 :: -1][:i] @ made[:i]
            v = step(start + i, wanted[i].reshape(sums.shape[:-1]))
            if v is None:
                length = i
                break
            made[i] = v.reshape(-1)
        sums[...] = np.moveaxis(wanted.reshape(sums.shape[-1], *sums.shape[:-1]), 0, -1)
        return np.moveaxis(made[:length].reshape(length, *sums.shape[:-1]), 0, -1)

    return finish


def _at_once(plant: Plant, kernel: Array, block: int) -> Finish:
    """A block by the loop's response to a unit impulse at each agent, as one matrix over agents and samples."""
    agents = len(plant.x0)
    impulse = np.zeros((agents, agents, block))
    impulse[..., 0] = np.eye(agents)
    padded = np.zeros(block)
    padded[: min(block, len(kernel))] = kernel[:block]
    _by_steps(padded, lambda _, state: -plant.mu * plant.error(state))(0, impulse)
    lag = np.arange(block)[:, None] - np.arange(block)[None, :]
    blocks = np.where(lag >= 0, impulse[:, :, lag], 0.0)
    matrix = blocks.transpose(0, 2, 1, 3).reshape(agents * block, agents * block)

    def finish(_: int, sums: Array) -> Array:
        length = sums.shape[-1]
        padded_sums = np.zeros((*sums.shape[:-1], block))
        padded_sums[..., :length] = sums
        columns = padded_sums.transpose(0, 2, 1).reshape(agents * block, -1)
        solved = (matrix @ columns).reshape(agents, block, -1).transpose(0, 2, 1)
        sums[...] = solved[..., :length]
        fine = np.max(np.abs(sums), axis=(0, 1)) < LARGEST
        kept = length if fine.all() else int(np.argmin(fine))
        return -plant.mu * plant.error(sums[..., :kept])

    return finish


def _powers(plant: Plant, count: int, progress: Progress | None) -> Array:
    """``e_k = P^k e_0`` until it outgrows 1e100: by doubling for few agents, sample by sample for many."""
    errors = np.empty((*plant.x0.shape, count))
    errors[..., 0] = plant.error(plant.x0)
    if len(plant.x0) <= DENSE_AGENTS:
        power, known = np.eye(len(plant.x0)) - plant.mu * plant.laplacian, 1
        while known < count:
            wanted = min(2 * known, count)
            block = errors[..., : wanted - known].reshape(len(power), -1)
            errors[..., known:wanted] = (power @ block).reshape(*plant.x0.shape, -1)
            power, known = power @ power, wanted
    else:
        for k in range(1, count):
            errors[..., k] = errors[..., k - 1] - plant.mu * plant.error(errors[..., k - 1])
            if progress is not None and k % BLOCK == 0:
                progress(k)
    fine = np.max(np.abs(errors), axis=(0, 1)) < LARGEST
    return errors if fine.all() else errors[..., : int(np.argmin(fine))]


def with_between(plant: Plant, run: Trajectory, points: int) -> Trajectory:
    """The same with the state at ``points`` times inside each sampling interval; approximate."""
    shares = [i / (points + 1) for i in range(1, points + 1)]
    inside = [plant.driven_by(run.inputs[..., :-1], share) for share in shares]
    return replace(run, between=np.stack(inside)) if inside else run
