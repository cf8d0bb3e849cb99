"""Polynomials with integer coefficients, lowest first, no zero at the top: gcd, exact quotient, real roots counted.

Source: Sturm's theorem, for a square-free polynomial and a half-open interval (a, b].
"""

from collections.abc import Iterable
from fractions import Fraction
from itertools import pairwise
from math import gcd, lcm

Poly = tuple[int, ...]


def primitive(coefficients: Iterable[int]) -> Poly:
    """Without zeros at the top, divided by the (positive) gcd of the coefficients."""
    entries = list(coefficients)
    while entries and entries[-1] == 0:
        entries.pop()
    content = gcd(*entries) or 1
    return tuple(entry // content for entry in entries)


def cleared(coefficients: Iterable[Fraction]) -> Poly:
    """A positive multiple of a polynomial with rational coefficients, primitive."""
    entries = list(coefficients)
    common = lcm(*(entry.denominator for entry in entries))
    return primitive(int(entry * common) for entry in entries)


def divided(a: Poly, b: Poly) -> tuple[Poly, Poly]:
    """Positive multiples of quotient and remainder of a by b, each primitive; b != 0."""
    rest = list(a)
    quotient = [0] * max(len(a) - len(b) + 1, 0)
    lead = abs(b[-1])
    for shift in range(len(a) - len(b), -1, -1):
        factor = rest[-1] if b[-1] > 0 else -rest[-1]
        rest = [lead * entry for entry in rest]
        quotient = [lead * entry for entry in quotient]
        quotient[shift] = factor
        for i, entry in enumerate(b):
            rest[shift + i] -= factor * entry
        rest.pop()
    return primitive(quotient), primitive(rest)


def common_divisor(a: Poly, b: Poly) -> Poly:
    """The greatest common divisor, primitive, with a positive coefficient at the top; a != 0."""
    while b:
        a, b = b, divided(a, b)[1]
    a = primitive(a)
    return a if a[-1] > 0 else tuple(-entry for entry in a)


def derivative(a: Poly) -> Poly:
    """The derivative, up to a positive factor."""
    return primitive(i * entry for i, entry in enumerate(a) if i > 0)


def scaled_value(a: Poly, x: Fraction) -> int:
    """a(x) times the denominator of x to the power of the degree of a."""
    total, scale = 0, 1
    for entry in reversed(a):
        total = total * x.numerator + entry * scale
        scale *= x.denominator
    return total


def sign_at(a: Poly, x: Fraction) -> int:
    """The sign of a(x)."""
    value = scaled_value(a, x)
    return (value > 0) - (value < 0)


def roots_between(a: Poly, lower: Fraction, upper: Fraction) -> int:
    """The number of real roots in (lower, upper] of a square-free polynomial of degree >= 1; lower < upper."""
    chain = [a, derivative(a)]
    while len(chain[-1]) > 1:
        chain.append(tuple(-entry for entry in divided(chain[-2], chain[-1])[1]))
    return _variations(chain, lower) - _variations(chain, upper)


def _variations(chain: list[Poly], x: Fraction) -> int:
    signs = [sign for sign in (sign_at(a, x) for a in chain) if sign != 0]
    return sum(1 for left, right in pairwise(signs) if left != right)
