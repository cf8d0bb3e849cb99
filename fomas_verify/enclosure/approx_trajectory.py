"""A trajectory by its definition in mpmath, to the digits asked: each sample by its sums over all inputs before it.

The plant by label eqxik_1, the law by label equki with its sum over its own past. Not rigorous: more digits are carried
than asked, but no bound is computed; the cost grows with the square of the samples.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

GUARD = 12


@dataclass(frozen=True)
class LoopNumbers:
    """A loop in exact numbers.

    ``tuned``: the order that the controller is tuned for. ``gamma`` or ``mu`` is given. ``edges``: (i, j, a_ij) counted
    from 0, agent i hears agent j. ``x0``: for each agent its numbers. ``memory``: how many of its own last inputs the
    law keeps, None for all.
    """

    alpha: Fraction
    tuned: Fraction
    h: Fraction
    gamma: Fraction | None
    mu: Fraction | None
    edges: tuple[tuple[int, int, Fraction], ...]
    x0: tuple[tuple[Fraction, ...], ...]
    memory: int | None


Texts = list[list[list[str]]]


def approx_trajectory(
    loop: LoopNumbers,
    samples: int,
    digits: int,
    *,
    shares: Sequence[Fraction] = (),
    progress: Callable[[int], None] | None = None,
) -> tuple[Texts, Texts, list[Texts]]:
    """States, inputs, and states a share of a period after each sample but the last; decimals by agents, their numbers
    and samples. Approximate.
    """
    import mpmath

    extra = GUARD + 3 * len(str(samples)) + 2 * max(len(str(x.denominator)) for x in (loop.alpha, loop.tuned))
    with mpmath.workdps(digits + extra):
        run = _Run(loop, samples)
        for k in range(samples + 1):
            run.step(k)
            if progress is not None:
                progress(k + 1)
        inside = [run.between(share) for share in shares]

        def texts(xs: Sequence[Sequence[Any]]) -> Texts:
            """From rows of samples to columns, in the shape of x0."""
            columns = [[mpmath.nstr(x, digits, strip_zeros=False) for x in column] for column in zip(*xs, strict=True)]
            width = len(loop.x0[0])
            return [columns[i : i + width] for i in range(0, len(columns), width)]

        return texts(run.states), texts(run.inputs), [texts(xs) for xs in inside]


class _Run:
    """The recursion; each sample is a flat row, agent by agent."""

    def __init__(self, loop: LoopNumbers, samples: int) -> None:
        from mpmath import mp

        self._mp, self._loop, self._samples = mp, loop, samples
        self._alpha, h = self._number(loop.alpha), self._number(loop.h)
        self._weight = h**self._alpha / mp.gamma(self._alpha + 1)
        given = loop.mu if loop.gamma is None else loop.gamma
        self._gamma = self._number(given or Fraction(0)) / (self._weight if loop.gamma is None else 1)
        self._edges = [(i, j, self._number(weight)) for i, j, weight in loop.edges]
        self._c = self._response(self._alpha, Fraction(1))
        own = self._c if loop.tuned == loop.alpha else self._response(self._number(loop.tuned), Fraction(1))
        self._f = [own[n] - own[n - 1] for n in range(1, len(own))]
        self._x0 = [self._number(x) for row in loop.x0 for x in row]
        self.states: list[list[Any]] = [self._x0]
        self.inputs: list[list[Any]] = []

    def step(self, k: int) -> None:
        """``u_k`` from ``x_k``, and then ``x_{k+1}``."""
        kept = k if self._loop.memory is None else min(k, self._loop.memory)
        error = self._error(self.states[k])
        past = list(zip(*self.inputs[k - kept : k], strict=True)) if kept else [()] * len(error)
        weights = self._f[kept - 1 :: -1] if kept else []
        self.inputs.append([-self._gamma * e - self._mp.fdot(weights, p) for e, p in zip(error, past, strict=True)])
        if k < self._samples:
            self.states.append(self._driven(self._c, k))

    def between(self, share: Fraction) -> list[list[Any]]:
        """The states a share of a period after the samples 0..K-1."""
        response = self._response(self._alpha, share)
        return [self._driven(response, k) for k in range(self._samples)]

    def _driven(self, response: Sequence[Any], k: int) -> list[Any]:
        weights = response[k::-1]
        columns = zip(*self.inputs[: k + 1], strict=True)
        return [x + self._weight * self._mp.fdot(weights, u) for x, u in zip(self._x0, columns, strict=True)]

    def _error(self, state: Sequence[Any]) -> list[Any]:
        """``L x``."""
        width = len(self._loop.x0[0])
        found = [self._mp.mpf(0)] * len(state)
        for i, j, weight in self._edges:
            for d in range(width):
                found[i * width + d] += weight * (state[i * width + d] - state[j * width + d])
        return found

    def _response(self, alpha: Any, share: Fraction) -> list[Any]:
        powers = [self._number(n + share) ** alpha for n in range(self._samples + 1)]
        return powers[:1] + [powers[n] - powers[n - 1] for n in range(1, len(powers))]

    def _number(self, x: Fraction) -> Any:
        return self._mp.mpf(x.numerator) / x.denominator
