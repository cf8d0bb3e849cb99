"""norm P^n and norm Phi_k on 1perp: upper bounds that cost little, tests where those do not decide, and the peak.

Source: theory, section 3, peak control (the lemma); p_n = norm P^n on 1perp.
"""

from functools import lru_cache
from math import ceil, floor

from fomas_verify.checker.ball import Ball, rounding
from fomas_verify.checker.facts import Approximation, Facts, settle
from fomas_verify.checker.loop import Loop
from fomas_verify.checker.norms import compare_norm, norm_lower, norm_upper
from fomas_verify.checker.powers import Enclosure
from fomas_verify.checker.samples import GUARD, Samples


class Operators:
    """The norms at one precision. Bounds are integers at the scale of the samples, and get smaller as more is asked."""

    def __init__(self, loop: Loop, bits: int) -> None:
        self.bits = bits
        self.samples = Samples(loop, bits, _centring(loop.graph.agents, bits))
        self.kernel, self.scale = self.samples.kernel, self.samples.scale
        self.one = 1 << self.scale
        self._powers = [self.one]
        self._samples = [self.one]

    def power_upper(self, n: int) -> int:
        """An upper bound of p_n: from p_n <= p_a p_(n-a), and from the matrix at every power of two."""
        self.samples.limit(n)
        bounds = self._powers
        while len(bounds) <= n:
            k = len(bounds)
            top = 1 << k.bit_length() - 1
            if k == top:
                bounds.append(norm_upper(self.samples.power(k)))
            else:
                bounds.append(min(self._times(bounds[1], bounds[-1]), self._times(bounds[top], bounds[k - top])))
        return bounds[n]

    def power_sign(self, n: int, lower: int, upper: int) -> int | None:
        """1 if p_n < s, -1 if p_n > s, None if neither is seen, for s between the bounds at the scale."""
        if self.power_upper(n) < lower:
            return 1
        return self._sign(self.samples.power(n), self._powers, n, lower, upper)

    def sample_sign(self, n: int, lower: int, upper: int) -> int | None:
        """The same of norm Phi_n, from norm Phi_n <= sigma norm Phi_(n-1) + r_n or from the matrix."""
        self.samples.limit(n)
        bounds = self._samples
        while len(bounds) <= n:
            bounds.append(self._times(bounds[-1], self.power_upper(1)) + self.kernel.resolvent(len(bounds))[1])
        if bounds[n] < lower:
            return 1
        return self._sign(self.samples.sample(n), bounds, n, lower, upper)

    def sample_sign_of_one(self, k: int) -> int | None:
        """The sign of 1 - norm Phi_k, or None if it is not seen."""
        return self.sample_sign(k, self.one, self.one)

    def power_sign_of_memory(self, n: int) -> int | None:
        """The sign of c_n - p_n, or None if it is not seen."""
        return self.power_sign(n, *self.kernel.step_response(n))

    def peak_sign(self, u: Enclosure) -> int | None:
        """The sign of u - peak, peak = sup norm Phi_k, or None if it is not seen.

        Phi_0 = I: u < 1 is below. Else u >= peak is shown as soon as sigma u + r_(n+1) <= u, r not increasing, or
        by the lemma with K = `start`, m = n - `start`; as all is shown with <, only u = 1 = peak is equality.
        """
        if u.lower < 1:
            return -1 if u.upper < 1 else None
        lower, upper = floor(u.lower * self.one), ceil(u.upper * self.one)
        start = retry = 0
        n, shown = 0, False
        while not shown:
            n += 1
            sign = self.sample_sign(n, lower, upper)
            if sign != 1:
                return sign
            bound = lower * self.kernel.step_response(n)[0] >> self.scale
            if n < retry or self.power_sign(n, bound, bound + 1) != 1:
                # Each test costs a factorisation: after a failure the next waits for a sixteenth more samples.
                start, retry = n, retry if n < retry else n + 1 + n // 16
            shown = self._stays_below(lower, n) or (n > start and self._falls(start, n - start))
        return 1 if u.lower > 1 else 0 if u.upper == 1 else None

    def decays(self, start: int, m: int) -> int | None:
        """The sign of c_(K+1+m) / c_(K+1) - p_m, K = `start`, or None if it is not seen."""
        return self.power_sign(m, *self.kernel.decay(start + 1, m))

    def _stays_below(self, bound: int, n: int) -> bool:
        """Whether sigma u + r_(n+1) <= u."""
        return self._times(bound, self.power_upper(1)) + self.kernel.resolvent(n + 1)[1] <= bound

    def _falls(self, start: int, m: int) -> bool:
        """Whether p_m c_(K+1) < c_(K+1+m) is seen from the bounds already known, K = `start`."""
        first, last = self.kernel.step_response(start + 1)[1], self.kernel.step_response(start + 1 + m)[0]
        return self._times(self.power_upper(m), first) < last

    def _sign(self, ball: Ball, bounds: list[int], n: int, lower: int, upper: int) -> int | None:
        if norm_lower(ball) > upper:
            return -1
        bounds[n] = min(bounds[n], norm_upper(ball, precise=False))
        return 1 if bounds[n] < lower else compare_norm(ball, lower, upper, 2 * self.bits)

    def _times(self, a: int, b: int) -> int:
        return (a * b >> self.scale) + 1


def _centring(agents: int, bits: int) -> Ball:
    """I - J at the scale."""
    one = 1 << bits + GUARD
    columns = [[(one * (agents * (i == j) - 1)) // agents for i in range(agents)] for j in range(agents)]
    return Ball(columns, -bits - GUARD, rounding(columns), one)


@lru_cache(maxsize=4)
def operators(loop: Loop, bits: int) -> Operators:
    """The norms of a loop at a precision, one for all who ask."""
    return Operators(loop, bits)


def compare_peak(facts: Facts, u: Approximation) -> int | None:
    """The sign of u - peak where P is Schur on 1perp."""
    return settle(lambda bits: operators(facts, bits).peak_sign(u(bits)))
