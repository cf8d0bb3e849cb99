"""What redoes the bounds of a large certificate that take a sparse factor, for the commands that use it."""

from __future__ import annotations

from typing import TYPE_CHECKING, cast

from fomas_verify.exact.memory import memory_for_factors
from fomas_verify.gate.answer import CertificateError

if TYPE_CHECKING:
    from fomas_verify.checker.large import Numeric


def needed_redo() -> Numeric:
    """It, in half of the memory; raises `CertificateError` where the extra `scale` is missing."""
    missing = _missing()
    if missing:
        raise CertificateError(f"--numeric needs {', '.join(missing)}: pip install 'fomas_verify[scale]'")
    return _redo(1)


def redo_if_installed(processes: int) -> Numeric | None:
    """It, in its share of half of the memory for each process; None where the extra `scale` is missing."""
    return None if _missing() else _redo(processes)


def _missing() -> list[str]:
    from importlib.util import find_spec

    from fomas_verify.numeric import SCALE

    return [name for name in SCALE if find_spec(name) is None]


def _redo(processes: int) -> Numeric:
    from fomas_verify.numeric import Redo

    return cast("Numeric", Redo(memory_for_factors() // processes))
