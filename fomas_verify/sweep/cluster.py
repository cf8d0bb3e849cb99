"""A Dask cluster as the crew: a scheduler that answers, workers of the same version, parts that outlive a worker."""

from __future__ import annotations

import asyncio
import logging
import platform
from collections.abc import Callable, Iterable, Iterator, Mapping
from concurrent.futures import CancelledError
from contextlib import contextmanager
from importlib.metadata import PackageNotFoundError, version
from typing import Any, Final

from fomas_verify.sweep.crew import Computed, in_flight
from fomas_verify.sweep.errors import SweepError
from fomas_verify.sweep.plan import Plan
from fomas_verify.sweep.table import compute_part

REACHED_WITHIN: Final = 4
"""Seconds that a scheduler has to answer, and then a first worker to be there."""

AHEAD: Final = 3
"""Parts handed out for each worker."""

Say = Callable[[str], None]


def compute_there(plan: Plan, parts: Iterable[int], address: str, say: Say) -> Iterator[Computed]:
    """Compute parts on a cluster; each as soon as it is there, in any order.

    Raises
    ------
    SweepError
        The scheduler cannot be reached or has no worker within ten seconds, a worker has another version, or the
        scheduler is lost on the way.
    """
    with _client(address) as client:
        from distributed import KilledWorker

        _agree(client, plan, address)
        crew = _Crew(client, address, say)
        with _loss_told(address), client.get_executor(pure=False) as executor:
            handed_out = in_flight(
                lambda part: executor.submit(compute_on_worker, plan, part), iter(parts), crew.slots, crew.look
            )
            for part, future in handed_out:
                try:
                    yield part, future.result()
                except KilledWorker:
                    yield part, None


@contextmanager
def _loss_told(address: str) -> Iterator[None]:
    """Say that the scheduler was lost, in whatever way its client noticed: by what it raises, or else by asking."""
    try:
        yield
    except SweepError:
        raise
    except Exception as error:
        if not isinstance(error, OSError | CancelledError) and _answers(address):
            raise
        raise SweepError(f"{address}: the scheduler was lost") from None


def compute_on_worker(plan: Plan, part: int) -> bytes:
    """Compute a part on a worker, which may have joined after the versions were compared."""
    if refusal := different({"a worker that joined later": (version("fomas_verify"), platform.python_version())}, plan):
        raise SweepError(refusal)
    return compute_part(plan, part)


def different(found: Mapping[str, tuple[object, object]], plan: Plan) -> str:
    """Say which of some workers has other versions of fomas_verify or Python than this process; empty for none."""
    for worker, (package, python) in found.items():
        if isinstance(package, PackageNotFoundError):
            return f"{worker} has no fomas_verify; install {plan.version} there"
        for name, there, here in (
            ("fomas_verify", package, plan.version),
            ("Python", _minor(python), _minor(platform.python_version())),
        ):
            if there != here:
                return f"{worker} has {name} {there}, this process {here}: expected the same"
    return ""


def _minor(python: object) -> str:
    return ".".join(str(python).split(".")[:2])


@contextmanager
def _client(address: str) -> Iterator[Any]:
    try:
        import distributed
    except ImportError as error:
        raise SweepError(
            f"--scheduler needs {error.name}, which the extra `sweep` brings: pip install 'fomas_verify[sweep]'"
        ) from None
    for name in ("distributed", *logging.Logger.manager.loggerDict):
        if name.partition(".")[0] == "distributed":  # each has a level of its own
            logging.getLogger(name).setLevel(logging.CRITICAL + 1)
    # Asked first, apart from the client, which waits for an answer for long when it is given up.
    try:
        identity = asyncio.run(asyncio.wait_for(_identity(address), REACHED_WITHIN))
    except Exception as error:  # whatever answers there, or does not: an unknown host, another protocol, a silent port
        silent, reason = isinstance(error, OSError | TimeoutError), " ".join(str(error).split())[:160]
        reason = "nothing did" if silent else reason if isinstance(error, ValueError) else "what answers there is none"
        raise SweepError(
            f"--scheduler {address}: expected a Dask scheduler that answers within {REACHED_WITHIN} s: {reason}"
        ) from None
    if identity.get("type") != "Scheduler":
        raise SweepError(f"--scheduler {address}: expected a Dask scheduler, got a {identity.get('type')}")
    connect: Any = distributed.Client
    client = connect(address, timeout=REACHED_WITHIN, set_as_default=False)
    try:
        yield client
    finally:
        client.close(timeout=REACHED_WITHIN)


def _answers(address: str) -> bool:
    try:
        asyncio.run(asyncio.wait_for(_identity(address), REACHED_WITHIN))
    except Exception:  # whatever it is, nobody is there to go on with
        return False
    return True


async def _identity(address: str) -> Mapping[str, Any]:
    from distributed import core

    rpc: Any = core.rpc
    async with rpc(address, timeout=REACHED_WITHIN) as scheduler:
        found: Mapping[str, Any] = await scheduler.identity()
        return found


def _agree(client: Any, plan: Plan, address: str) -> None:
    try:
        client.wait_for_workers(1, timeout=REACHED_WITHIN - 1)
    except TimeoutError:
        raise SweepError(f"--scheduler {address}: expected at least one worker, got none") from None
    packages = client.run(version, "fomas_verify", on_error="return")
    pythons = client.run(platform.python_version, on_error="return")
    if refusal := different({worker: (packages[worker], pythons.get(worker)) for worker in packages}, plan):
        raise SweepError(f"--scheduler {address}: {refusal}")


class _Crew:
    """The workers as they come and go."""

    def __init__(self, client: Any, address: str, say: Say) -> None:
        self._client, self._address, self._say = client, address, say
        self._told = False

    def slots(self) -> int:
        """Parts that may be handed out."""
        return AHEAD * max(1, len(self._client.scheduler_info(n_workers=-1)["workers"]))

    def look(self) -> None:
        """Say once where nobody is left to compute."""
        if self._client.status != "running":
            raise SweepError(f"{self._address}: the scheduler was lost")
        alone = not self._client.scheduler_info(n_workers=-1)["workers"]
        if alone and not self._told:
            self._say("no worker is left: waiting for one")
        self._told = alone
