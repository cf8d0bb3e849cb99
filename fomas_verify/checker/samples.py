"""What happens at the samples: P^k E and Phi_k E = sum_{j<=k} r_{k-j} P^j E, as matrices of fixed-point numbers.

With E = I - J the norms are those of P^k and Phi_k on 1perp; with E = L x_0 they are the trajectory's. All numbers are
at one scale 2^-w. Source: theory, section 3 (peak control): Phi_{k+1} = P Phi_k + r_{k+1} I.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from math import ceil
from operator import itemgetter, mul

from fomas_verify.checker.ball import Ball, deviation, rounding
from fomas_verify.checker.loop import Loop
from fomas_verify.checker.norms import norm_upper
from fomas_verify.checker.resolvent import MAX_SAMPLES, Memory
from fomas_verify.checker.ruling import Undecided

MAX_SAMPLE_WORK = 2**36
MAX_SAMPLE_BITS = 5 * 2**19
"""20 480 samples at 128 bits, and fewer at more: the memory of n samples takes up to n^1.6 of its products."""

GUARD = 64


@dataclass(frozen=True)
class Step:
    """X -> P X for matrices whose columns sum to 0, at the scale 2^-w.

    Attributes
    ----------
    rows : of d L: the places of the entries that are not 0, as a getter, and the entries
    numerator, denominator : mu / d, about
    missed : how far mu may be from that, times a bound of norm L, at the scale, rounded up
    stretch : an upper bound of max(1, sigma) >= norm P, at the scale
    """

    rows: tuple[tuple[Callable[[Sequence[int]], tuple[int, ...]], tuple[int, ...]], ...]
    numerator: int
    denominator: int
    missed: int
    stretch: int
    scale: int

    def times(self, ball: Ball) -> Ball:
        """P X. Rigorous."""
        columns = []
        for column in ball.columns:
            image = (sum(map(mul, entries, places(column))) for places, entries in self.rows)
            columns.append([x - y * self.numerator // self.denominator for x, y in zip(column, image, strict=True)])
        error = self.stretch * ball.error + self.missed * (ball.size + ball.error)
        known = None if ball.known is None else -(-self.stretch * ball.known >> self.scale)
        return Ball(columns, ball.exponent, -(-error >> self.scale) + rounding(columns), known)


class Samples:
    """P^k E and Phi_k E for k = 0, 1, 2, ..., one after the other; to go back is to begin again."""

    def __init__(self, loop: Loop, bits: int, start: Ball) -> None:
        self.agents, self.bits = loop.graph.agents, bits
        self.start, self.scale = start, bits + GUARD
        self.kernel: Memory = loop.kernel(self.scale)
        self.step = _step(loop, bits)
        self._power = self._sample = (0, start)

    def power(self, n: int) -> Ball:
        """P^n E."""
        self.limit(n)
        k, ball = self._power if self._power[0] <= n else (0, self.start)
        for _ in range(k, n):
            ball = self.step.times(ball)
        self._power = (n, ball)
        return ball

    def sample(self, n: int) -> Ball:
        """Phi_n E."""
        self.limit(n)
        k, ball = self._sample if self._sample[0] <= n else (0, self.start)
        for j in range(k + 1, n + 1):
            ball = self._plus(self.step.times(ball), *self.kernel.resolvent(j))
        self._sample = (n, ball)
        return ball

    def limit(self, n: int) -> None:
        """Raise `Undecided` if n samples are beyond the work allowed."""
        if n * self.bits > MAX_SAMPLE_BITS:
            raise Undecided(f"{n} samples at {self.bits} bits are beyond the work allowed")
        if n > MAX_SAMPLES or n * self.agents**3 * self.bits > MAX_SAMPLE_WORK:
            raise Undecided(f"{n} samples of {self.agents} agents at {self.bits} bits are beyond the work allowed")

    def _plus(self, ball: Ball, lower: int, upper: int) -> Ball:
        """X + r E, for 0 <= r <= 1 between the bounds."""
        middle = lower + upper >> 1
        columns = [
            [x + (middle * y >> self.scale) for x, y in zip(*pair, strict=True)]
            for pair in zip(ball.columns, self.start.columns, strict=True)
        ]
        missed = -(-max(upper - middle, middle - lower) * (self.start.size + self.start.error) >> self.scale)
        known = None if ball.known is None else ball.known + self.start.size
        error = ball.error + self.start.error + missed + rounding(columns)
        return Ball(columns, ball.exponent, error, known)


@lru_cache(maxsize=4)
def _step(loop: Loop, bits: int) -> Step:
    scale = bits + GUARD
    graph, mu = loop.graph, loop.mu(scale + 16)
    first = deviation(loop, bits)
    stretch = max(ceil(norm_upper(first) * Fraction(2) ** (first.exponent + scale)), 1 << scale)
    missed = mu.radius * graph.size * 2**scale
    rows = []
    for row in graph.laplacian:
        places = [i for i, entry in enumerate(row) if entry]
        rows.append((itemgetter(*places), tuple(row[i] for i in places)))
    middle = mu.middle / graph.denominator
    return Step(tuple(rows), middle.numerator, middle.denominator, ceil(missed), stretch, scale)
