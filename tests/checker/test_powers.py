"""The enclosures against mpmath at more than twice the precision."""

import random
from fractions import Fraction

import mpmath
import pytest

from fomas_verify.checker import powers
from fomas_verify.checker.powers import Enclosure, gamma_one_plus, outward, point, power, quotient, square_root

TINY = Fraction(1, 2**64 - 1)
EDGE_EXPONENTS = [Fraction(1, 2), TINY, 1 - TINY, Fraction(1, 3), Fraction(2**63, 2**64 - 1), Fraction(9, 10)]
EDGE_BASES = [Fraction(1), Fraction(2), Fraction(3), Fraction(1, 2), Fraction(4), Fraction(17, 20),
              Fraction(10**300), Fraction(1, 10**300), 1 + Fraction(1, 10**40), 1 - Fraction(1, 10**40),
              Fraction(2**200 - 1), Fraction(2**200 + 1)]  # fmt: skip


def real(x: Fraction) -> mpmath.mpf:
    return mpmath.mpf(x.numerator) / x.denominator


def exponents(seed: int, count: int) -> list[Fraction]:
    choose = random.Random(seed)
    below = [choose.choice([choose.randint(2, 30), choose.randint(2, 2**64 - 1)]) for _ in range(count)]
    return [Fraction(choose.randint(1, q - 1), q) for q in below]


def bases(seed: int, count: int) -> list[Fraction]:
    choose = random.Random(seed)
    return [
        Fraction(choose.randint(1, 10 ** choose.randint(1, 60)), choose.randint(1, 10 ** choose.randint(1, 60)))
        for _ in range(count)
    ]


def holds(box: Enclosure, exact: mpmath.mpf, bits: int) -> bool:
    """Encloses the number, and is as narrow as promised."""
    return real(box.lower) <= exact <= real(box.upper) and (box.upper - box.lower) * 2**bits <= box.lower


@pytest.mark.parametrize("bits", [128, 256, 512])
def test_power_encloses(bits: int) -> None:
    with mpmath.workprec(2 * bits + 400):
        points = [(b, e) for b in EDGE_BASES for e in EDGE_EXPONENTS]
        points += list(zip(bases(bits, 700), exponents(bits + 1, 700), strict=True))
        bad = [(b, e) for b, e in points if not holds(power(b, e, bits), real(b) ** real(e), bits)]
        assert bad == []


@pytest.mark.parametrize("bits", [128, 256, 512])
def test_gamma_encloses(bits: int) -> None:
    with mpmath.workprec(2 * bits + 400):
        points = EDGE_EXPONENTS + exponents(bits + 2, 500)
        bad = [a for a in points if not holds(gamma_one_plus(a, bits), mpmath.gamma(1 + real(a)), bits)]
        assert bad == []


def test_at_the_highest_precision() -> None:
    with mpmath.workprec(4400):
        half = Fraction(1, 2)
        assert holds(gamma_one_plus(half, 4096), mpmath.sqrt(mpmath.pi) / 2, 4096)
        assert holds(power(Fraction(17, 20), half, 4096), mpmath.sqrt(real(Fraction(17, 20))), 4096)


@pytest.mark.parametrize("base", [Fraction(10**99_000), Fraction(1, 10**99_000)])
def test_huge_and_tiny_bases(base: Fraction) -> None:
    with mpmath.workprec(2000):
        assert holds(power(base, Fraction(9, 10), 256), real(base) ** real(Fraction(9, 10)), 256)


def test_a_power_that_is_rational_is_inside() -> None:
    box = power(Fraction(4), Fraction(1, 2), 128)
    assert box.lower <= 2 <= box.upper
    assert power(Fraction(1), Fraction(1, 2), 128) == Enclosure(Fraction(1), Fraction(1))


def test_square_root_encloses() -> None:
    for x in [Fraction(0), Fraction(1, 4), Fraction(2), Fraction(10**50), *bases(5, 500)]:
        box = square_root(point(x), 128)
        assert box.lower**2 <= x <= box.upper**2
        assert box.upper - box.lower == Fraction(1, 2**128)
    assert square_root(Enclosure(Fraction(-1), Fraction(1)), 128).lower == 0


def test_quotient_encloses_every_quotient() -> None:
    choose = random.Random(7)
    for _ in range(500):
        a, b = sorted(Fraction(choose.randint(-50, 50), choose.randint(1, 9)) for _ in range(2))
        c, d = sorted(Fraction(choose.randint(1, 50), choose.randint(1, 9)) for _ in range(2))
        box = quotient(Enclosure(a, b), Enclosure(c, d))
        corners = [x / y for x in (a, b) for y in (c, d)]
        assert (box.lower, box.upper) == (min(corners), max(corners))


def test_outward_widens_only() -> None:
    for x in bases(11, 300):
        box = outward(x, x, 64)
        assert box.lower <= x <= box.upper
        assert (box.upper - box.lower) * 2**64 < x


COARSE = range(6, 40)


@pytest.mark.parametrize("w", COARSE)
def test_each_series_at_few_bits(w: int) -> None:
    """At 6 to 40 bits the terms left out and the roundings are as large as they ever get beside the result."""
    choose = random.Random(w)
    unit = mpmath.mpf(2) ** w
    for _ in range(40):
        z = Fraction(choose.randint(0, 1000), 3000)
        exact = mpmath.atanh(real(z)) * unit
        assert powers._atanh(z, w, False) <= exact <= powers._atanh(z, w, True)
        x = Fraction(choose.randint(1, 10**6), choose.randint(1, 10**6))
        lower, upper = powers._log(x, w)
        assert lower <= mpmath.log(real(x)) * unit <= upper
        y = choose.randint(-(20 << w), 20 << w)
        assert real(powers._exp(y, w, False)) <= mpmath.exp(y / unit) <= real(powers._exp(y, w, True))
        q = choose.randint(2, 50)
        p = choose.randint(1, q - 1)
        t = choose.randint(1, 12)
        exponent = 1 + mpmath.mpf(p) / q
        exact = mpmath.gammainc(exponent, 0, t) * mpmath.exp(t) / mpmath.mpf(t) ** exponent * unit
        assert powers._incomplete_series(p, q, t, w, False) <= exact <= powers._incomplete_series(p, q, t, w, True)


@pytest.mark.parametrize("bits", COARSE)
def test_enclosures_without_guard_bits(bits: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(powers, "_GUARD", 0)
    for a in exponents(bits, 60):
        box = gamma_one_plus.__wrapped__(a, bits)
        assert real(box.lower) <= mpmath.gamma(1 + real(a)) <= real(box.upper)
        box = power.__wrapped__(Fraction(17, 3), a, bits)
        assert real(box.lower) <= real(Fraction(17, 3)) ** real(a) <= real(box.upper)


@pytest.mark.parametrize("t", range(1, 12))
def test_gamma_cut_off_early(t: int) -> None:
    """However early the integral is cut off, what is left of it is inside."""
    for a in EDGE_EXPONENTS + exponents(t, 40):
        lower, upper = powers._gamma_ends(a, t, 64)
        assert real(lower) <= mpmath.gamma(1 + real(a)) <= real(upper)
