"""A real number between two rationals. Terms as in IEEE 1788."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction


@dataclass(frozen=True)
class Interval:
    """The reals x with ``lower <= x <= upper``; the number meant is one of them."""

    lower: Fraction
    upper: Fraction

    def __post_init__(self) -> None:
        """Refuse ends in the wrong order, which no enclosure has."""
        if self.lower > self.upper:
            raise ArithmeticError("an enclosure with lower > upper")

    @classmethod
    def exactly(cls, x: Fraction | int) -> Interval:
        """The one number x."""
        return cls(Fraction(x), Fraction(x))

    @property
    def is_exact(self) -> bool:
        """Whether the enclosure is a single number."""
        return self.lower == self.upper

    @property
    def ends(self) -> tuple[Fraction, Fraction]:
        """Both ends."""
        return self.lower, self.upper

    @property
    def mid(self) -> Fraction:
        """The middle."""
        return (self.lower + self.upper) / 2

    @property
    def width(self) -> Fraction:
        """``upper - lower``."""
        return self.upper - self.lower

    def contains(self, x: Fraction) -> bool:
        """Whether x lies inside."""
        return self.lower <= x <= self.upper

    def overlaps(self, other: Interval) -> bool:
        """Whether the two have a point in common."""
        return self.lower <= other.upper and other.lower <= self.upper

    def compare(self, other: Interval) -> int | None:
        """-1, 0 or 1 for certainly less, equal or greater; None for don't know."""
        if self.upper < other.lower:
            return -1
        if self.lower > other.upper:
            return 1
        return 0 if self.is_exact and other.is_exact else None

    def __neg__(self) -> Interval:
        """``-x``."""
        return Interval(-self.upper, -self.lower)

    def __add__(self, other: Interval | Fraction | int) -> Interval:
        """``x + y``."""
        if not isinstance(other, Interval):
            return Interval(self.lower + other, self.upper + other)
        return Interval(self.lower + other.lower, self.upper + other.upper)

    def __sub__(self, other: Interval | Fraction | int) -> Interval:
        """``x - y``."""
        return self + (-other)

    def __rsub__(self, other: Fraction | int) -> Interval:
        """``y - x``."""
        return -self + other

    def __mul__(self, other: Interval | Fraction | int) -> Interval:
        """``x y``."""
        if not isinstance(other, Interval):
            first, last = self.ends if other >= 0 else self.ends[::-1]
            return Interval(first * other, last * other)
        if self.lower >= 0 and other.lower >= 0:
            return Interval(self.lower * other.lower, self.upper * other.upper)
        ends = [a * b for a in self.ends for b in other.ends]
        return Interval(min(ends), max(ends))

    def __truediv__(self, other: Interval | Fraction | int) -> Interval:
        """``x / y``, where y is certainly not 0."""
        right = other if isinstance(other, Interval) else Interval.exactly(other)
        if right.lower <= 0 <= right.upper:
            raise ZeroDivisionError("division by an enclosure of 0")
        return self * Interval(1 / right.upper, 1 / right.lower)

    def rounded(self, bits: int) -> Interval:
        """The least enclosure of this one with ends in ``2^-e Z``: e = bits, more for numbers below 1.

        An exact number stays exact.
        """
        return self if self.is_exact else self.outward(bits)

    def shortened(self, bits: int) -> Interval:
        """The same, but an exact number stays exact only where its denominator has at most so many bits."""
        return self if self.is_exact and self.lower.denominator.bit_length() <= bits else self.outward(bits)

    def outward(self, bits: int) -> Interval:
        """As `rounded`, an exact number included."""
        size = max(abs(self.lower), abs(self.upper))
        shift = bits + max(0, size.denominator.bit_length() - size.numerator.bit_length())
        return Interval(round_down(self.lower, shift), round_up(self.upper, shift))


def round_down(x: Fraction, shift: int) -> Fraction:
    """The largest multiple of ``2^-shift`` that is at most x."""
    return Fraction((x.numerator << shift) // x.denominator, 1 << shift)


def round_up(x: Fraction, shift: int) -> Fraction:
    """The smallest multiple of ``2^-shift`` that is at least x."""
    return -round_down(-x, shift)


def short_dyadic(lower: Fraction, upper: Fraction) -> Fraction:
    """The dyadic number of fewest bits after the point in ``[lower, upper]``, the smallest of these; lower < upper,
    or lower dyadic.
    """
    shift = 0
    while (x := round_up(lower, shift)) > upper:
        shift += 1
    return x


def is_dyadic(x: Fraction) -> bool:
    """Whether the denominator is a power of two."""
    return x.denominator & (x.denominator - 1) == 0
