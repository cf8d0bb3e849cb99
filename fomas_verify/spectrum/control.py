"""How large the control gets and how fast the agents agree: initial states that break eqL3, the trajectory's bound,
rate and settling.

Notation: ``u_k = -gamma s_k``, ``s_k = Phi_k(P) e_0``, ``e_0 = L x_0``; p_k = norm of P^k on 1perp. Source: theory,
sections 3 and 4.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction

from fomas_verify.enclosure.interval import Interval, round_up, short_dyadic
from fomas_verify.enclosure.norms import BallMatrix, approx_preimage_of_top, ball_columns, squared_image
from fomas_verify.enclosure.real import square_root, working_precision
from fomas_verify.exact import matrix as exact
from fomas_verify.spectrum.loop import Loop
from fomas_verify.spectrum.samples import COARSE, FINE, ROUGH, Samples, Tail, TailTest, phi_at, submultiplied

EXACT_POWER_WORK = 4_000
"""Bound on ``k`` times the bits of mu's denominator, for a norm of P^k decided exactly at a rational mu."""

RATE_BASE, COARSE_RATE_BASE, RATE_LEVELS, SMALL_NETWORK = 32, 4, 16, 20
"""kappa is sought among the powers up to base^levels, by fewer norms and less tightly where the network is not
small."""

KAPPA_ROOM = Fraction(101, 100)
"""kappa is rounded up by this to its square, so that it has few digits and few norms show it."""

EVERY_POWER = 64
"""norm P^k is computed for every k up to here, and at powers of two."""

LEAST_GAP, LEAST_BOUND = Fraction(1, 1 << 16), Fraction(1, 1 << 8192)
"""No rate is sought where 1 minus the spectral radius is below the first, nor beyond powers of rho below the second."""

EXACT_SIZE_BITS = 4096
"""The square of ``norm e_0`` is exact where its denominator has at most so many bits, so that ties are seen."""

DOUBLINGS = 64
"""The settling sample is sought below 2^64."""


def state_above(loop: Loop, k: int, bits: int) -> list[Fraction] | None:
    """An x_0 of few digits with ``norm u_k > norm u_0``, tested rigorously; None where none was found."""
    with working_precision(bits):
        phi = phi_at(loop, k, bits)
        approximation = approx_preimage_of_top(phi, loop.laplacian)
        scale = 0
        while approximation is not None and scale <= bits:
            x0 = [Fraction(round(x * (1 << scale))) for x in approximation]
            e0 = exact.apply(loop.laplacian, x0)
            if squared_image(phi, ball_columns([e0])).lower > exact.norm_squared(e0):
                return x0
            scale += 1 + scale // 2
    return None


@dataclass(frozen=True)
class Trajectory:
    """``norm u_k`` against ``norm u_0`` for one x_0.

    ``above`` is the first sample where it is certainly larger; otherwise ``tail`` proves that there is none, unless
    it is None. ``largest`` encloses the largest ratio at the samples 1 .. ``examined``, first attained at ``at``.
    """

    above: int | None
    tail: Tail | None
    largest: Interval
    at: int
    examined: int


def follow(loop: Loop, components: Sequence[Sequence[Fraction]], bits: int, limit: int | None = None) -> Trajectory:
    """Compare ``norm u_k`` with ``norm u_0`` along the trajectory from x_0, given by its components, where ``L x_0 !=
    0``. Rigorous.
    """
    e0 = [exact.apply(loop.laplacian, x) for x in components]
    size = Interval.exactly(sum((exact.norm_squared(e) for e in e0), Fraction(0))).shortened(EXACT_SIZE_BITS)
    with working_precision(bits):
        start = ball_columns(e0)
        run = Samples(loop, bits)
        test, powers = TailTest(run.alpha, bits), {0: Fraction(1)}
        largest, at = Interval.exactly(0), 0
        for sample in run.all(limit):
            k = sample.k
            ratio = square_root(squared_image(sample.phi, start) / size, bits)
            if ratio.lower > largest.lower:
                largest, at = ratio, k
            if ratio.lower > 1:
                return Trajectory(k, None, largest, at, k)
            if k <= EVERY_POWER or k & (k - 1) == 0:
                powers[k] = run.norm(sample.power, COARSE).upper
            shrunk = square_root(squared_image(sample.power, start) / size, bits).upper
            passed = test.add(shrunk if ratio.upper <= 1 else None, Fraction(1))
            if passed and (tail := test.tail(submultiplied(powers, test.streak))) is not None:
                return Trajectory(None, tail, largest, at, k)
    return Trajectory(None, None, largest, at, sample.k)


def spectral_radius(loop: Loop, bits: int) -> Interval:
    """The largest modulus among the eigenvalues of P other than 1."""
    mu = loop.mu(bits)
    moduli = [
        square_root(1 - mu * (root.real * 2 - mu * root.square), bits) for root in loop.disagreement_eigenvalues(bits)
    ]
    return Interval(max(x.lower for x in moduli), max(x.upper for x in moduli))


@dataclass(frozen=True)
class Rate:
    """``norm P^k <= kappa rho^k`` on 1perp for every k; both are bounds, no enclosures."""

    kappa: Fraction
    rho: Fraction


def certified_rate(loop: Loop, bits: int) -> Rate | None:
    """A pair (kappa, rho) with ``1 - rho >= 0.99 (1 - r)``, r the spectral radius; None where r is too near to 1 or
    above it.

    Write k in base B. At level i let ``q_ij = norm(P^(j B^i)) rho^(-j B^i)``; where one of them is at most 1, k need
    go no further, and kappa is the product over the levels of ``max_j q_ij``.
    """
    gap = 1 - spectral_radius(loop, bits).upper
    if gap < LEAST_GAP:
        return None
    rho = short_dyadic(1 - gap * Fraction(995, 1000), 1 - gap * Fraction(991, 1000))
    kappa = Fraction(1)
    with working_precision(bits):
        run = Samples(loop, bits)
        base_size = RATE_BASE if loop.design.graph.agents <= SMALL_NETWORK else COARSE_RATE_BASE
        base, shrink = run.centered(run.perron), Interval.exactly(rho)
        for _ in range(RATE_LEVELS):
            power, bound, worst = base, shrink, Fraction(1)
            for _ in range(base_size - 1):
                ratio = (Interval.exactly(run.norm(power, ROUGH).upper) / bound).upper
                if ratio <= 1:
                    kappa = round_up(kappa * worst, bits)
                    room = kappa * KAPPA_ROOM
                    return Rate(short_dyadic(room, room * KAPPA_ROOM) if kappa > 1 else kappa, rho)
                if bound.upper < LEAST_BOUND:
                    return None
                worst = max(worst, ratio)
                power, bound = power * base, (bound * shrink).outward(2 * bits)
            kappa, base, shrink = round_up(kappa * worst, bits), power, bound
    return None


def settling_samples(loop: Loop, target: Fraction, bits: int) -> int | None:
    """The smallest k with ``p_k <= target`` for 0 < target < 1; None where it is not decided within the work
    allowed. Rigorous.
    """
    with working_precision(bits):
        run = Samples(loop, bits)
        if loop.sigma(bits).upper <= 1:
            return _bisected(run, lambda a, k: _at_most(loop, run, a, k, target))
        for sample in run.all():
            if (below := _at_most(loop, run, sample.power, sample.k, target)) is not False:
                return sample.k if below else None
    return None


def _at_most(loop: Loop, run: Samples, power: BallMatrix, k: int, target: Fraction) -> bool | None:
    """Whether ``norm P^k <= target`` on 1perp; exact where mu is rational and the power small; None for not decided."""
    for squarings in (COARSE, FINE):
        norm = run.norm(power, squarings)
        if norm.upper <= target:
            return True
        if norm.lower > target:
            return False
    mu = loop.mu(128)
    if (
        not mu.is_exact
        or k * (mu.lower.denominator.bit_length() + loop.symmetric_scale.bit_length()) > EXACT_POWER_WORK
    ):
        return None
    p = exact.identity(loop.laplacian.nrows()) - exact.scaled(loop.laplacian, mu.lower)
    form = exact.scaled(exact.identity(p.nrows()), target**2) - (p**k).transpose() * p**k
    return exact.is_positive_semidefinite(exact.on_sum_zero(form))


def _bisected(run: Samples, at_most: Callable[[BallMatrix, int], bool | None]) -> int | None:
    """The smallest k with the property, which holds from there on."""
    doubled = [run.perron]
    while (below := at_most(doubled[-1], 1 << (len(doubled) - 1))) is False and len(doubled) < DOUBLINGS:
        doubled.append(doubled[-1] * doubled[-1])
    if not below:
        return None
    k, power = 0, run.identity
    for i in range(len(doubled) - 2, -1, -1):
        candidate = power * doubled[i]
        below = at_most(candidate, k + (1 << i))
        if below is None:
            return None
        if not below:
            k, power = k + (1 << i), candidate
    return k + 1
