"""The control at the samples: ``u_k = Phi_k(P) u_0`` with ``Phi_k(P) = sum_j r_{k-j} P^j``, and when finitely many
samples suffice.

Notation: p_n = norm of P^n on 1perp, c_n the memory's step response. Lemma (theory, section 3): M >= 1, ``norm Phi_k
<= M`` for k <= K and ``p_n <= M c_n`` for every n > K give ``norm Phi_k <= M`` for every k; and the second needs
only K < n <= K + m and ``p_m <=
c_{K+1+m}/c_{K+1}``.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction

from fomas_verify.enclosure.interval import Interval
from fomas_verify.enclosure.norms import (
    BallMatrix,
    ball_identity,
    centered,
    perron_matrix,
    plus_multiple,
    spectral_norm,
)
from fomas_verify.enclosure.real import working_precision
from fomas_verify.kernel.memory import resolvent_over, step_response_over
from fomas_verify.spectrum.loop import Loop
from fomas_verify.spectrum.remembered import of_loop

COARSE, ROUGH, MIDDLE, FINE = 4, 7, 14, 52
"""Squarings of a norm on the way and of one that decides: relative widths of about 5 %, 1 %, 5e-5 and 1e-15."""

FEW_BITS = 64
"""The precision of norms that are known to some per cent only; their matrices keep the whole of it."""

SAMPLE_WORK, LARGER_SAMPLE_WORK, LARGER = 500_000_000, 150_000_000, 60
"""Bounds on ``K N^3``, K the last sample examined: the first up to so many agents, the second beyond."""

UNSTABLE_SAMPLES = 2_000
"""Bound on K where P is not Schur on 1perp, so that no tail will end the search."""


@dataclass(frozen=True)
class Box:
    """Every pair of an order alpha in [0, 1] and an integrated gain mu > 0 from two enclosures."""

    alpha: Interval
    mu: Interval


@dataclass(frozen=True)
class Sample:
    """Sample k >= 1: ``Phi_k(P)`` and ``P^k`` in balls."""

    k: int
    phi: BallMatrix
    power: BallMatrix


@dataclass(frozen=True)
class Tail:
    """``norm Phi_k <= M`` for every k follows from ``k <= last``: the lemma's K, and its m."""

    last: int
    powers: int


def sample_limit(loop: Loop) -> int:
    """The last sample that may be examined: a bound on work, the same on every machine."""
    agents = loop.design.graph.agents
    return min(loop.most_samples, (SAMPLE_WORK if agents <= LARGER else LARGER_SAMPLE_WORK) // agents**3)


ROOM, ROOM_ALONG = Fraction(2), Fraction(3)
"""Of samples as matrices, and along one initial state, where entries keep errors apart that a norm adds up."""


class Samples:
    """The samples of one loop at one precision; the caller holds the working precision."""

    def __init__(self, loop: Loop, bits: int, box: Box | None = None, *, room: Fraction = ROOM) -> None:
        """Enclose P and the first coefficients of the resolvent, over a box where one is given.

        P is enclosed over `room` times the box's part of mu: a checker that bounds errors by norms needs that.
        """
        reach = None if box is None else room / 2 * box.mu.width
        mu = loop.mu(bits) if box is None or reach is None else Interval(box.mu.mid - reach, box.mu.mid + reach)
        self.alpha, self._bits = Interval.exactly(loop.design.alpha) if box is None else box.alpha, bits
        self.limit = sample_limit(loop)
        self.perron = perron_matrix(loop.laplacian, mu)
        self.identity = ball_identity(self.perron.nrows())
        self._resolvent = resolvent_over(self.alpha, 64, bits)

    def resolvent(self, k: int) -> Interval:
        """r_k."""
        if k >= len(self._resolvent):
            self._resolvent = resolvent_over(self.alpha, min(4 * k, self.limit + 1), self._bits)
        return self._resolvent[k]

    def after(self, k: int, phi: BallMatrix) -> BallMatrix:
        """``Phi_k`` from ``Phi_{k-1}``."""
        return plus_multiple(self.perron * phi, self.resolvent(k), self.identity)

    def all(self, limit: int | None = None) -> Iterator[Sample]:
        """The samples k = 1, 2, ... to the limit."""
        phi = power = self.identity
        for k in range(1, min(self.limit, limit or self.limit) + 1):
            phi, power = self.after(k, phi), self.perron * power
            yield Sample(k, phi, power)

    def centered(self, a: BallMatrix) -> BallMatrix:
        """``(I - J) A``, the part of a matrix that keeps the vector 1 which acts on 1perp."""
        return centered(a)

    def norm(self, a: BallMatrix, squarings: int = COARSE) -> Interval:
        """The norm on 1perp of a matrix that keeps the vector 1."""
        square = centered(a)
        with working_precision(min(self._bits, FEW_BITS) if squarings <= ROUGH else self._bits):
            return spectral_norm(square, squarings)


class TailTest:
    """Watches ``size_n <= M c_n`` as n grows, until the lemma's m is found."""

    def __init__(self, alpha: Interval, bits: int) -> None:
        """For the memory of order alpha, or of every order in an enclosure."""
        self._alpha, self._bits = alpha, bits
        self._last_open = self._n = 0

    def add(self, size: Fraction | None, bound: Fraction) -> bool:
        """Sample n = 1, 2, ... with ``size`` an upper bound (None: not computed) and M >= ``bound``; whether it
        passed.
        """
        self._n += 1
        if size is None or size > bound * self._c(self._n).lower:
            self._last_open = self._n
            return False
        return True

    def tail(self, power_norm: Fraction) -> Tail | None:
        """The tail, where ``power_norm >= norm P^m`` with the m of the samples that passed in a row proves it."""
        start, m = self._last_open + 1, self.streak
        if m and power_norm * self._c(start).upper <= self._c(start + m).lower:
            return Tail(self._last_open, m)
        return None

    @property
    def streak(self) -> int:
        """How many samples have passed since the last that did not."""
        return self._n - self._last_open

    def _c(self, n: int) -> Interval:
        return step_response_over(self._alpha, n, self._bits)


@dataclass(frozen=True)
class Peak:
    """``sup_k norm Phi_k`` on 1perp: its enclosure, a sample that attains it, and the tail that bounds the rest.

    ``above`` is a sample k >= 1 with ``norm Phi_k > 1`` for certain; None and ``decided``: there is none.
    """

    value: Interval
    at: int
    tail: Tail
    above: int | None
    decided: bool


@dataclass(frozen=True)
class Checkpoint:
    """A sample whose norm was computed; up to ``until`` the norm stays below ``bound``."""

    k: int
    norm: Interval
    phi: BallMatrix
    until: int
    bound: Fraction


@dataclass(frozen=True)
class Search:
    """What the samples gave: the peak, None where the work bound came first, and a sample with ``norm Phi_k > 1``."""

    peak: Peak | None
    above: int | None


@of_loop
def search(loop: Loop, bits: int) -> Search:
    """Find the peak, for a P that is Schur on 1perp. Rigorous.

    Norms are computed at checkpoints only, where ``norm Phi_{k+1} <= norm P norm Phi_k + r_{k+1}`` bounds what lies
    between.
    """
    with working_precision(bits):
        run = Samples(loop, bits)
        powers = {0: Fraction(1)}
        slow = loop.sigma(128).upper <= 1
        test, checkpoints, next_power = TailTest(run.alpha, bits), [], 1
        least, above, skip_until = Fraction(1), None, 0
        for sample in run.all():
            k = sample.k
            if k > skip_until:
                norm = run.norm(sample.phi)
                least, above = max(least, norm.lower), k if above is None and norm.lower > 1 else above
                skip_until, bound = _reach(run, k, norm.upper) if slow else (k, norm.upper)
                checkpoints.append(Checkpoint(k, norm, sample.phi, skip_until, bound))
            if k >= next_power or not slow:
                powers[k] = run.norm(sample.power).upper
            passed = test.add(powers.get(k), least)
            if k in powers:
                next_power = k + 1 if passed or not slow else k + 1 + k // 16
            if passed and (tail := test.tail(powers.get(test.streak, submultiplied(powers, test.streak)))) is not None:
                peak = _refined(run, [c for c in checkpoints if c.k <= tail.last], tail, least, above)
                return Search(peak, peak.above)
    return Search(None, above)


def first_above(loop: Loop, bits: int) -> int | None:
    """The first sample seen to have ``norm Phi_k > 1``, for a P that need not be Schur; None within the work bound."""
    with working_precision(bits):
        run = Samples(loop, bits)
        return next((s.k for s in run.all(UNSTABLE_SAMPLES) if run.norm(s.phi, MIDDLE).lower > 1), None)


def phi_at(loop: Loop, k: int, bits: int) -> BallMatrix:
    """``Phi_k(P)``; the caller holds the working precision."""
    run = Samples(loop, bits)
    return next(s.phi for s in run.all() if s.k == k)


def _reach(run: Samples, k: int, norm: Fraction) -> tuple[int, Fraction]:
    """How far after k, at most twice as far, the norm certainly grows by no more than a fiftieth, and to what;
    ``norm P <= 1``.
    """
    bound, until = norm, k
    while until < min(run.limit, 2 * k) and (bound + run.resolvent(until + 1).upper) * 50 <= norm * 51:
        until += 1
        bound += run.resolvent(until).upper
    return until, bound


def submultiplied(powers: dict[int, Fraction], n: int) -> Fraction:
    """A bound of ``norm P^n`` from the norms of the powers known."""
    known = max(k for k in powers if k <= n)
    return powers[known] * (submultiplied(powers, n - known) if n > known else 1)


def _refined(run: Samples, checkpoints: list[Checkpoint], tail: Tail, least: Fraction, above: int | None) -> Peak:
    """The peak among the samples that may attain it, their norms computed ever more finely; k = 0 has the norm 1."""
    kept = [(run.norm(phi), k, phi) for k, phi in _between(run, checkpoints, tail, least)]
    least = max([least, *(norm.lower for norm, _, _ in kept)])
    for squarings in (ROUGH, MIDDLE, FINE):
        closer = []
        # The most promising come first: a higher norm leaves fewer to be looked at more closely.
        for norm, k, phi in sorted(kept, key=lambda found: (-found[0].lower, found[1])):
            if norm.upper >= least:
                closer.append((run.norm(phi, squarings), k, phi))
                least = max(least, closer[-1][0].lower)
        kept = [found for found in closer if found[0].upper >= least]
    fine = {0: Interval.exactly(1)} | {k: norm for norm, k, _ in kept}
    at = max(sorted(fine), key=lambda k: fine[k].lower)
    value = Interval(fine[at].lower, max(x.upper for x in fine.values()))
    first = min((k for k in fine if k and fine[k].lower > 1), default=None)
    decided = above is not None or first is not None or all(x.upper <= 1 for x in fine.values())
    return Peak(value, at, tail, first if above is None else min(above, first or above), decided)


def _between(
    run: Samples, checkpoints: list[Checkpoint], tail: Tail, least: Fraction
) -> Iterator[tuple[int, BallMatrix]]:
    """The samples up to the tail that the checkpoints' bounds leave open."""
    for point in checkpoints:
        if point.bound >= least:
            phi = point.phi
            yield point.k, phi
            for k in range(point.k + 1, min(point.until, tail.last) + 1):
                phi = run.after(k, phi)
                yield k, phi
