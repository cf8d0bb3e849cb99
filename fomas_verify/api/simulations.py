"""`simulate`: the closed loop, in arrays of floats."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from fractions import Fraction
from importlib import import_module
from os import PathLike
from typing import TYPE_CHECKING, Any

from fomas_verify.api.design import LOG, Design, Exact, Number, exact_design
from fomas_verify.api.results import Cells, Result
from fomas_verify.api.values import plain
from fomas_verify.design import DesignError
from fomas_verify.design.fields import Place, number
from fomas_verify.exact.errors import MissingExtraError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from fomas_verify.simulate import Law

CONTROLLERS = ("proposed", "memoryless", "truncated")
LONG = 20_000_000
"""Samples times agents from which on a terminal shows progress."""


@dataclass(frozen=True, eq=False, repr=False)
class Simulation(Result):
    """A closed loop at the samples k = 0..K; approximate, in binary floats.

    Attributes
    ----------
    name, controller : str
        Of the design, and of the law.
    t : array, shape (K + 1,)
        Seconds.
    x, u : array, shape (K + 1, N), or (K + 1, N, n) where agents have n numbers
        The states at t, and the inputs held from there on.
    between : array, shape (K, M, N), or (K, M, N, n)
        The states at the M points inside each interval, where they were asked for.
    stopped : bool
        Whether it ends early, because its numbers outgrew 1e100.
    """

    name: str
    controller: str
    t: NDArray[Any]
    x: NDArray[Any]
    u: NDArray[Any]
    between: NDArray[Any]
    stopped: bool

    @property
    def exit_status(self) -> int:
        """0: the work is done."""
        return 0

    def __repr__(self) -> str:
        last = len(self.t) - 1
        return f"<Simulation of {self.name!r}, {self.controller}: k = 0..{last}, t = 0..{self.t[-1]:.8g} s>"

    def _table(self) -> tuple[str, Cells]:
        spread = [float((x.max(axis=0) - x.min(axis=0)).max()) for x in (self.x[0], self.x[-1])]
        rows = [("0", f"{spread[0]:.6g}"), (f"{self.t[-1]:.8g}", f"{spread[1]:.6g}")]
        return f"{self.name}, {self.controller}", [("t in seconds", "largest disagreement"), *rows]


def simulate(
    design: Design | Exact | str | PathLike[str],
    samples: int = 200,
    *,
    controller: str = "proposed",
    memory: int | None = None,
    between: int = 0,
    alpha_controller: Number | None = None,
) -> Simulation:
    """Simulate the closed loop: the exact sampled plant, its memory included. Approximate, in binary floats.

    Parameters
    ----------
    design : Design or path
        With x0, h, and gamma or mu.
    samples : int
        The last sample K >= 1.
    controller : {"proposed", "memoryless", "truncated"}
        The paper's law, that of Yu et al. (2017), or the paper's with its last `memory` inputs only.
    memory : int, optional
        With "truncated": how many inputs are kept.
    between : int
        M points inside each interval, up to 10,000.
    alpha_controller : number, optional
        The order that the controller is tuned for; the plant's by default.

    Raises
    ------
    FomasError
        The design lacks a number, the call does not go together, or it would not fit into memory.

    Examples
    --------
    >>> pair = Design(alpha="1/2", mu="1/4", h=1, graph="complete", agents=2, x0=[0, 1])
    >>> simulate(pair, 2).x.round(3).tolist()
    [[0.0, 1.0], [0.25, 0.75], [0.375, 0.625]]
    """
    exact = Design.of(exact_design(design)).certain("simulate")
    _must_be_called(samples, controller, memory, between)
    _need_extra()
    from numpy import arange, moveaxis

    from fomas_verify.simulate import plant_of, with_between
    from fomas_verify.simulate import simulate as run
    from fomas_verify.simulate.need import available_bytes, must_fit, needed_bytes

    plant = plant_of(exact)
    needed = needed_bytes(plant.x0.size, samples, controllers=1, between=between, table=False)
    must_fit(needed, available_bytes(), samples)
    tuned = None if alpha_controller is None else float(_order(alpha_controller))
    with _progress(controller, samples + 1, shown=samples * plant.x0.size >= LONG) as told:
        found = run(plant, _law(controller, memory), samples, alpha_controller=tuned, progress=told)
    found = with_between(plant, found, between)
    one = slice(None) if plant.x0.shape[1] > 1 else 0
    x, u = (moveaxis(each, -1, 0)[:, :, one] for each in (found.states, found.inputs))
    inside = moveaxis(found.between, -1, 0)[..., one] if between else found.between
    answer = Simulation(exact.name, controller, found.h * arange(len(x)), x, u, inside, found.stopped)
    LOG.info("%r", answer)
    return answer


def _must_be_called(samples: int, controller: str, memory: int | None, between: int) -> None:
    if controller not in CONTROLLERS:
        expected = ", ".join(CONTROLLERS)
        raise DesignError(f"simulate: controller: expected one of {expected}, got {str(controller)[:60]!r}")
    if (controller == "truncated") != (memory is not None):
        raise DesignError("simulate: memory: expected with the controller truncated, and only with it")
    counts = {"samples": (samples, 1, None), "between": (between, 0, 10_000), "memory": (memory, 0, None)}
    for name, (count, low, high) in counts.items():
        if count is not None and (type(count) is not int or count < low or (high is not None and count > high)):
            bound = "" if high is None else f" and <= {high}"
            raise DesignError(f"simulate: {name}: expected an integer >= {low}{bound}, got {str(count)[:60]}")


def _need_extra() -> None:
    for name in ("numpy", "scipy"):
        try:
            import_module(name)
        except ImportError:
            raise MissingExtraError(
                f"simulate needs {name}, which the extra `simulate` brings: pip install 'fomas_verify[simulate]'"
            ) from None


def _order(value: Number) -> Fraction:
    place = Place("simulate", "alpha_controller")
    found = number(plain(value), place)
    if not 0 < found < 1:
        raise place.expected("a number between 0 and 1", value)
    return found


def _law(name: str, memory: int | None) -> Law:
    from fomas_verify.simulate import MEMORYLESS, PROPOSED, truncated

    if memory is not None:
        return truncated(memory)
    return PROPOSED if name == "proposed" else MEMORYLESS


@contextmanager
def _progress(label: str, length: int, *, shown: bool) -> Iterator[Callable[[int], None]]:
    """A bar of rich on a terminal, where rich is installed; gives the function to be told what is done."""
    try:
        from rich.console import Console
        from rich.progress import Progress
    except ImportError:
        shown = False
    if not shown:
        yield lambda _: None
        return
    console = Console(stderr=True)
    with Progress(console=console, transient=True, disable=not console.is_terminal) as bar:
        task = bar.add_task(label, total=length)
        yield lambda done: bar.update(task, completed=done)
