"""The closed loop by its definition, sum by sum in mpmath: the oracle, which shares no code with the package.

The plant by eqxik_1, the paper's controller by equki with its sum over its own past inputs.
"""

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

from mpmath import mp


def number(x: Any) -> Any:
    x = Fraction(x)
    return mp.mpf(x.numerator) / x.denominator


def step_response(alpha: Any, n: int, share: Any = 1) -> Any:
    """What an input held for one period adds, a share of a period after the n-th sample from its start."""
    return (n + share) ** alpha - (n - 1 + share) ** alpha if n else mp.mpf(share) ** alpha


def error(weights: Mapping[tuple[int, int], Any], x: Sequence[Any]) -> list[Any]:
    """``sum_j a_ij (x_i - x_j)`` for every i; ``weights[i, j] = a_ij``, counted from 1."""
    found = [mp.mpf(0)] * len(x)
    for (i, j), a in weights.items():
        found[i - 1] += a * (x[i - 1] - x[j - 1])
    return found


class Direct:
    """Every x_k and u_k for k = 0..samples, one number an agent; the caller holds mp.dps."""

    def __init__(
        self,
        design: Mapping[str, Any],
        samples: int,
        *,
        memory: int | None = None,
        tuned: Any = None,
    ) -> None:
        alpha, gamma, h = (number(design[key]) for key in ("alpha", "gamma", "h"))
        self.alpha, self.h = alpha, h
        self.weight = h**alpha / mp.gamma(alpha + 1)
        agents = design["graph"]
        weights = {(to, source): number(a) for source, to, a in agents["edges"]}
        c = [step_response(alpha, n) for n in range(samples + 1)]
        order = alpha if tuned is None else number(tuned)
        own = [step_response(order, n) for n in range(samples + 1)]
        f = [mp.mpf(1)] + [own[j] - own[j - 1] for j in range(1, samples + 1)]
        self.x0 = [number(x) for x in design["x0"]]
        self.states, self.inputs = [self.x0], []
        for k in range(samples + 1):
            kept = k if memory is None else min(k, memory)
            e = error(weights, self.states[k])
            past = [sum((f[i] * self.inputs[k - i][a] for i in range(1, kept + 1)), mp.mpf(0)) for a in range(len(e))]
            self.inputs.append([-gamma * e[a] - past[a] for a in range(len(e))])
            if k < samples:
                self.states.append(self._driven(c, k))

    def _driven(self, response: Sequence[Any], k: int) -> list[Any]:
        return [
            x + self.weight * mp.fdot((response[k - j], self.inputs[j][a]) for j in range(k + 1))
            for a, x in enumerate(self.x0)
        ]

    def between(self, k: int, share: Fraction) -> list[Any]:
        """``x(t_k + share h)``."""
        theta = number(share)
        return self._driven([step_response(self.alpha, n, theta) for n in range(k + 1)], k)
