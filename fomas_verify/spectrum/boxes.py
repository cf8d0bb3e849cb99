"""The samples of every loop in a box of (alpha, mu) at once.

Notation as in ``spectrum.samples``. Everything is rigorous and says nothing where the box is too large to tell.
Source: docs/certificate-format.md, section 7.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import TypeAlias

from fomas_verify.enclosure.interval import Interval
from fomas_verify.enclosure.norms import BallMatrix, ball_columns, squared_image
from fomas_verify.enclosure.real import square_root, working_precision
from fomas_verify.exact import matrix as exact
from fomas_verify.kernel.memory import threshold
from fomas_verify.spectrum.loop import Loop, sigma_at
from fomas_verify.spectrum.samples import MIDDLE, ROOM, ROOM_ALONG, ROUGH, Box, Samples, Tail, TailTest, submultiplied

Size: TypeAlias = Callable[[BallMatrix], Fraction]

MOST_SAMPLES = 200
"""Samples examined over a box; a smaller box needs fewer."""


def beta_over(loop: Loop, box: Box, bits: int) -> Interval:
    """Every ``beta = 1 - mu lambda2`` of the box."""
    return 1 - box.mu * loop.lambda2(bits)


def beta_at_most_threshold(loop: Loop, box: Box, bits: int) -> bool:
    """Whether beta is certainly at most 2^alpha - 1 all over the box."""
    return beta_over(loop, box, bits).upper <= threshold(box.alpha.lower, bits).lower


def sigma_at_most_threshold(loop: Loop, box: Box, bits: int) -> bool:
    """Whether sigma is certainly at most 2^alpha - 1 all over the box: sigma is convex in mu."""
    bound = threshold(box.alpha.lower, bits).lower
    return all(sigma_at(loop.laplacian, mu, bits).upper <= bound for mu in (box.mu.lower, box.mu.upper))


def tail_over(loop: Loop, box: Box, bits: int, components: Sequence[Sequence[Fraction]] | None = None) -> Tail | None:
    """K and m that show ``norm u_k <= norm u_0`` for every k all over the box: for every x_0, or for the one whose
    components are given, where ``L x_0 != 0``; None where nothing was shown.
    """
    if (star := loop.mu_star(bits)) is None or box.mu.upper >= star.upper:
        return None
    with working_precision(bits):
        run = Samples(loop, bits, box, room=ROOM if components is None else ROOM_ALONG)
        powers = {0: Fraction(1)}
        size = _size_on_sum_zero(run) if components is None else _size_along(loop, components, bits)
        test, unseen = TailTest(box.alpha, bits), []
        for sample in run.all(MOST_SAMPLES):
            powers[sample.k] = run.norm(sample.power, ROUGH).upper
            unseen.append(sample.phi)
            if not test.add(size(sample.power), Fraction(1)):
                if any(size(phi) > 1 for phi in unseen):
                    return None
                unseen.clear()
            elif (tail := test.tail(submultiplied(powers, test.streak))) is not None:
                return tail
    return None


def _size_on_sum_zero(run: Samples) -> Size:
    """The norm on 1perp, from above."""
    return lambda a: run.norm(a, MIDDLE).upper


def _size_along(loop: Loop, components: Sequence[Sequence[Fraction]], bits: int) -> Size:
    """``norm(A e_0) / norm(e_0)``, e_0 = L x_0, from above."""
    e0 = [exact.apply(loop.laplacian, x) for x in components]
    square, start = sum((exact.norm_squared(e) for e in e0), Fraction(0)), ball_columns(e0)
    return lambda a: square_root(squared_image(a, start) / square, bits).upper
