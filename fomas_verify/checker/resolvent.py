"""The memory kernel in fixed point: c_n = (n+1)^alpha - n^alpha, abs f(n) = c_{n-1} - c_n, and the resolvent r_n.

A number at scale w is a pair of integers (lower, upper) that stand for lower / 2^w and upper / 2^w.
Source: theory, section 2: r_0 = 1, r_n = sum_{j=1}^n abs f(j) r_{n-j}, every term positive.
"""

from fractions import Fraction
from functools import lru_cache
from operator import mul
from typing import Protocol

from fomas_verify.checker.packed import packed, unpacked, width_of
from fomas_verify.checker.powers import power
from fomas_verify.checker.ruling import Undecided

MAX_SAMPLES = 2**15
_GUARD = 32
_BLOCK = 256
"""So many products one by one cost less than packing them."""

Pair = tuple[int, int]


class Memory(Protocol):
    """The numbers of the memory at one scale, of one alpha or of every alpha between two."""

    def step_response(self, n: int) -> Pair:
        """Bounds of c_n, n >= 0."""

    def resolvent(self, n: int) -> Pair:
        """Bounds of r_n, n >= 0."""

    def decay(self, n: int, m: int) -> Pair:
        """Bounds of c_(n+m) / c_n, n >= 1."""


class Kernel:
    """The numbers of the memory at one alpha and one scale; the lists grow as they are asked for."""

    def __init__(self, alpha: Fraction, scale: int) -> None:
        self.alpha = alpha
        self.scale = scale
        self._primes: list[int] = []
        one = 1 << scale + _GUARD
        self._powers: list[Pair] = [(0, 0), (one, one)]
        self._resolvent = [1 << scale]
        self._weights: list[int] = []
        self._errors: list[int] = []
        self._missed = 1
        self._far = [0] * _BLOCK

    def step_response(self, n: int) -> Pair:
        """c_n, n >= 0. Rigorous."""
        (low, high), (next_low, next_high) = self._power(n), self._power(n + 1)
        return next_low - high >> _GUARD, -(-(next_high - low) >> _GUARD)

    def resolvent(self, n: int) -> Pair:
        """r_n, n >= 0. Rigorous.

        A sum with lower bounds of abs f, rounded down, is a lower bound. What it misses, sum df_j + 1 units at most at
        each n, goes through the same recursion: r_n <= 1 of it for each sample before.
        """
        while len(self._resolvent) <= n:
            k = len(self._resolvent)
            self._weigh(k)
            self._missed += self._errors[k - 1]
            start = k - k % _BLOCK
            if k == start:
                self._carry(k)
            near = sum(map(mul, self._weights, reversed(self._resolvent[start:])))
            self._resolvent.append(self._far[k] + near >> self.scale)
        return self._resolvent[n], self._resolvent[n] + n * self._missed

    def _carry(self, k: int) -> None:
        """Add what r_{k-m}, ..., r_{k-1} give to the sums of r_k, ..., r_{k+m-1}, m the largest power of 2 in k.

        Every pair of samples of two blocks meets in one such product: k is the middle of the least dyadic interval that
        holds both. Of packed integers it takes fewer steps than the products one by one; it is exact.
        """
        m = k & -k
        self._weigh(min(2 * m - 1, MAX_SAMPLES + 1))
        width = width_of(2 * self.scale + 2 * MAX_SAMPLES.bit_length())
        product = packed(self._resolvent[k - m : k], width) * packed(self._weights[: 2 * m - 1], width)
        self._far += [0] * (k + m - len(self._far))
        for i, entry in enumerate(unpacked(product, 2 * m - 1, width)[m - 1 :], k):
            self._far[i] += entry

    def _weigh(self, n: int) -> None:
        """Make the bounds of abs f(1), ..., abs f(n)."""
        while len(self._weights) < n:
            lower, upper = self._weight(len(self._weights) + 1)
            self._weights.append(lower)
            self._errors.append(upper - lower)

    def decay(self, n: int, m: int) -> Pair:
        """c_(n+m) / c_n. Rigorous."""
        # As alpha > 2^-64 and there are at most 2^15 samples, c_n > 2^-80: both lower bounds are positive.
        (first, first_up), (last, last_up) = self.step_response(n), self.step_response(n + m)
        return (last << self.scale) // first_up, -(-(last_up << self.scale) // first)

    def _weight(self, j: int) -> Pair:
        """abs f(j) = 2 j^alpha - (j+1)^alpha - (j-1)^alpha, both ends >= 0."""
        (a, a_up), (b, b_up), (c, c_up) = (self._power(i) for i in (j - 1, j, j + 1))
        return max(2 * b - a_up - c_up >> _GUARD, 0), -(-(2 * b_up - a - c) >> _GUARD)

    def _power(self, j: int) -> Pair:
        """j^alpha, at the scale and 32 bits more: of a prime by its logarithm, of a product by its factors."""
        if j > MAX_SAMPLES + 2:
            raise Undecided(f"more than {MAX_SAMPLES} samples are beyond the work allowed")
        width = self.scale + _GUARD
        while len(self._powers) <= j:
            n = len(self._powers)
            factor = next((p for p in self._primes if n % p == 0), None)
            if factor is None:
                self._primes.append(n)
                box = power(Fraction(n), self.alpha, width)
                scaled = (box.lower * 2**width, box.upper * 2**width)
                self._powers.append((int(scaled[0]), int(scaled[1]) + 1))
            else:
                (a, a_up), (b, b_up) = self._powers[factor], self._powers[n // factor]
                self._powers.append((a * b >> width, -(-a_up * b_up >> width)))
        return self._powers[j]


class KernelBetween:
    """The numbers of the memory for every alpha between two: their values at the ends.

    c_n = alpha int_n^(n+1) x^(alpha-1) dx for n >= 1: the derivative of log c_n by alpha is 1/alpha + a mean of log x
    over [n, n+1], which is positive and increases with n, so c_n and c_(n+1) / c_n do not decrease in alpha.
    r_n does not increase. For with C, R at one alpha and C', R' at a larger one, C / C' = 1 + sum q_n z^n has q_n <= 0
    (as in Kaluza's theorem, c'_n being log-convex and c_n / c'_n not increasing). So C R' = (C / C') / (1 - z) does not
    increase, G = 1/(1-z) - C R' does not decrease, and R - R' = G / C = G (1 - sum b_n z^n) >= 0, as sum b_n = 1.
    """

    def __init__(self, first: Kernel, last: Kernel) -> None:
        self.first, self.last = first, last

    def step_response(self, n: int) -> Pair:
        """c_n, n >= 0. Rigorous."""
        return self.first.step_response(n)[0], self.last.step_response(n)[1]

    def resolvent(self, n: int) -> Pair:
        """r_n, n >= 0. Rigorous."""
        return self.last.resolvent(n)[0], self.first.resolvent(n)[1]

    def decay(self, n: int, m: int) -> Pair:
        """c_(n+m) / c_n, n >= 1. Rigorous."""
        return self.first.decay(n, m)[0], self.last.decay(n, m)[1]


@lru_cache(maxsize=16)
def kernel(alpha: Fraction, scale: int) -> Kernel:
    """The kernel at a scale, one for all who ask."""
    return Kernel(alpha, scale)
