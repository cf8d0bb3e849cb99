"""Controllers: what each agent applies during a sampling interval.

A linear law is a response q: ``u_k = -gamma sum_{j<=k} q_{k-j} e_j`` with ``e = L x``.

* `PROPOSED`, the paper's (labels equ0i, equki): ``u_k + sum_{l=1}^{k} f(l) u_{k-l} = -gamma e_k``, so
  ``q = r = 1/F``; it cancels the plant's memory, which leaves ``x_{k+1} = P x_k``.
* `MEMORYLESS`, the law of Yu et al. (2017) as the paper describes it: ``u_k = -gamma e_k``.
* `truncated(M)`: of the paper's sum only the last M inputs are kept, as every implementation must. Its series
  ``F_M`` has ``F_M(1) = c_M`` in place of 0, so the loop behaves in the end like the memoryless one with the gain
  ``gamma / c_M``: ``x - mean ~ (c_M / gamma) L^+ (x_0 - mean) t^(-alpha) / Gamma(1 - alpha)``, no longer geometric.

Source: theory, sections 1, 2 and 6.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from fomas_verify.simulate.memory import Array, approx_memory_series, approx_step_response
from fomas_verify.simulate.series import approx_inverse_series

Control: TypeAlias = Callable[[int, Array, Array], Array]
"""A controller of a user's own: from k, the states x_0 .. x_k (time first: k+1, N, n) and the inputs u_0 .. u_{k-1}
(k, N, n), both read-only, to u_k (N, n).
"""


@dataclass(frozen=True)
class Law:
    """A linear law.

    Attributes
    ----------
    name : str
        As it stands in tables and files.
    memory : int or None
        How many of its own last inputs the paper's sum keeps: None for all of them, 0 for none.
    """

    name: str
    memory: int | None

    def response(self, alpha: float, count: int) -> Array:
        """``q_0 .. q_{count-1}`` of a controller tuned for the order alpha; approximate."""
        if self.memory == 0:
            found = np.zeros(count)
            found[0] = 1.0
            return found
        series = approx_memory_series(alpha, count)
        if self.memory is not None:
            series[self.memory + 1 :] = 0.0
        return approx_inverse_series(series)


PROPOSED = Law("proposed", None)
MEMORYLESS = Law("memoryless", 0)


def truncated(memory: int) -> Law:
    """The paper's law with only its last ``memory >= 0`` inputs kept."""
    return Law("truncated", memory)


def approx_remaining_memory(alpha: float, memory: int) -> float:
    """``c_M``: what the truncated law leaves uncancelled."""
    return float(approx_step_response(alpha, memory + 1)[-1])
