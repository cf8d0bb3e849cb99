"""A refuted norm bound as an example to replay by hand: a vector e that sums to 0, and by how much P stretches it.

``norm(P e)^2 / norm(e)^2 = 1 - 2 mu (e.L e)/norm(e)^2 + mu^2 norm(L e)^2/norm(e)^2``; all but mu is an exact rational.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from fomas_verify.enclosure.interval import Interval
from fomas_verify.exact import matrix as exact
from fomas_verify.spectrum.contraction import squared_stretch
from fomas_verify.spectrum.loop import Loop

BITS = 128
LONGEST_PRINTED = 12
LARGEST_PRINTED = 10**6


@dataclass(frozen=True)
class Counterexample:
    """The vector and what is computed from it."""

    e: tuple[Fraction, ...]
    image: tuple[Fraction, ...]
    norm_squared: Fraction
    inner: Fraction
    image_norm_squared: Fraction
    stretch_squared: Interval
    bound: Interval

    @property
    def bound_squared(self) -> Interval:
        """The square of the factor that the claim allows."""
        return self.bound * self.bound

    @property
    def is_short(self) -> bool:
        """Whether e and L e fit on a page."""
        return len(self.e) <= LONGEST_PRINTED and all(
            max(abs(x.numerator), x.denominator) <= LARGEST_PRINTED for x in (*self.e, *self.image)
        )


def counterexample(loop: Loop, e: Sequence[Fraction], bound: Interval) -> Counterexample:
    """What refutes ``norm(P e) <= bound norm(e)``; rigorous."""
    image = exact.apply(loop.laplacian, e)
    inner = sum((x * y for x, y in zip(e, image, strict=True)), Fraction(0))
    stretch = squared_stretch(loop, list(e), loop.mu(BITS))
    return Counterexample(
        tuple(e), tuple(image), exact.norm_squared(e), inner, exact.norm_squared(image), stretch, bound
    )
