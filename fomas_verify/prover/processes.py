"""Processes that decide many designs, and end with the one that started them, however that ends.

Under a limit of memory each of them has an equal part, and the one that started them too.
"""

from __future__ import annotations

import os
import signal
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from multiprocessing import active_children, get_context, parent_process
from threading import Thread

from fomas_verify.exact.memory import allow_memory, allowed_memory

ONE_THREAD = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")


@contextmanager
def processes(count: int, *, fresh: bool = False) -> Iterator[ProcessPoolExecutor]:
    """A pool that ends, with all its processes, when this one is interrupted or killed.

    Parameters
    ----------
    count : int
        Processes, at least 1.
    fresh : bool
        Start each as a new interpreter, which inherits no open file and no lock.
    """
    before = set(active_children())
    context = get_context("spawn") if fresh else None
    memory = allowed_memory()
    share = None if memory is None else memory // (count + 1)
    pool = ProcessPoolExecutor(count, mp_context=context, initializer=_follow_the_parent, initargs=(share,))
    try:
        yield pool
    except BaseException:
        for process in set(active_children()) - before:
            process.terminate()
        # Waits, once: its thread must have ended before the interpreter does, which would wake it by a closed pipe.
        pool.shutdown(cancel_futures=True)
        raise
    pool.shutdown()


def _follow_the_parent(memory: int | None) -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    for name in ONE_THREAD:
        os.environ.setdefault(name, "1")
    Thread(target=_end_with_the_parent, daemon=True).start()
    if memory is not None:
        allow_memory(memory)


def _end_with_the_parent() -> None:
    if (parent := parent_process()) is not None:
        parent.join()
        os._exit(1)
