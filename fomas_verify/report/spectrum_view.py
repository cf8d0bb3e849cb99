"""The Perron spectrum for the report: each eigenvalue enclosed, and the discs that must contain it.

Notation: lambda an eigenvalue of L other than the one 0 of the vector 1; ``1 - mu lambda`` the one of P.
Source: theory, section 4.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction

from fomas_verify.enclosure.digits import decimal
from fomas_verify.enclosure.interval import Interval
from fomas_verify.enclosure.real import square_root
from fomas_verify.enclosure.roots import root_of
from fomas_verify.report.latex_text import Tex
from fomas_verify.report.math_text import math_number
from fomas_verify.report.picture import Dot, Picture, Point, Ring, Segment, Shape
from fomas_verify.spectrum.loop import Loop

BITS = 128
ROWS = 12
_FIGURE_RADIUS = Fraction(24, 10)
_DIGITS = 8


@dataclass(frozen=True)
class Eigenvalue:
    """One eigenvalue of L, or a conjugate pair, with the one of P and its modulus."""

    of_laplacian: tuple[Interval, Interval]
    of_perron: tuple[Interval, Interval]
    modulus: Interval
    multiplicity: int
    is_pair: bool

    @property
    def laplacian_text(self) -> Tex:
        """``2 \\pm i``, for math mode."""
        return complex_text(*self.of_laplacian, pair=self.is_pair, sign=r"\pm")

    @property
    def perron_text(self) -> Tex:
        """The eigenvalue of P, signs in the order of the one of L."""
        return complex_text(*self.of_perron, pair=self.is_pair, sign=r"\mp")


@dataclass(frozen=True)
class Spectrum:
    """The eigenvalues, the largest modulus first, and a picture."""

    eigenvalues: tuple[Eigenvalue, ...]
    radius: Interval
    picture: Picture

    @property
    def shown(self) -> tuple[Eigenvalue, ...]:
        """Those in the table."""
        return self.eigenvalues[:ROWS]


def spectrum_view(loop: Loop) -> Spectrum:
    """All eigenvalues of P on the disagreement, enclosed; rigorous."""
    found = sorted(_eigenvalues(loop), key=lambda e: (-e.modulus.mid, e.of_laplacian[0].mid, e.of_laplacian[1].mid))
    radius = Interval(max(e.modulus.lower for e in found), max(e.modulus.upper for e in found))
    return Spectrum(tuple(found), radius, _picture(loop, found))


def complex_text(real: Interval, imag: Interval, *, pair: bool, sign: str) -> Tex:
    """A complex number to certified digits; of a pair, the imaginary part without its sign."""
    if imag.is_exact and imag.lower == 0:
        return math_number(decimal(real, _DIGITS))
    if imag.upper < 0:
        imag, sign = -imag, sign if pair else "-"
    elif not pair:
        sign = "+"
    size = "" if imag.is_exact and imag.lower == 1 else _part(imag) + r"\,"
    return Tex(f"{_part(real)} {sign} {size}" + r"\mathrm i")


def _part(x: Interval) -> str:
    text = math_number(decimal(x, _DIGITS))
    return rf"({text})" if r"\pm" in text else text


def _eigenvalues(loop: Loop) -> Iterator[Eigenvalue]:
    mu = loop.mu(BITS)
    for root in loop.disagreement_eigenvalues(BITS):
        if root.imag.upper < 0:
            continue
        real, imag = 1 - mu * root.real, -(mu * root.imag)
        modulus = square_root(root_of(real, imag, 1).square, BITS)
        yield Eigenvalue((root.real, root.imag), (real, imag), modulus, root.multiplicity, root.imag.lower > 0)


def _picture(loop: Loop, eigenvalues: list[Eigenvalue]) -> Picture:
    """Unit circle, Gershgorin disc, the circle of radius sigma, the line Re = beta, and the eigenvalues."""
    reach, zero, one = loop.mu(BITS).mid * loop.degree_max, Fraction(0), Fraction(1)
    extent = max([one, 2 * reach - 1, *(e.modulus.mid for e in eigenvalues)])
    unit = _FIGURE_RADIUS / extent

    def at(x: Fraction, y: Fraction = zero) -> Point:
        return x * unit, y * unit

    edge = extent * Fraction(23, 20)
    shapes: list[Shape] = [Segment("axis", at(-edge), at(edge)), Segment("axis", at(zero, -edge), at(zero, edge))]
    shapes += [Ring("unit circle", at(zero), unit), Ring("gershgorin", at(1 - reach), reach * unit)]
    if loop.assumption1:
        beta = loop.beta(BITS).mid
        shapes.append(Ring("sigma circle", at(zero), loop.sigma(BITS).mid * unit))
        shapes.append(Segment("beta line", at(beta, -extent), at(beta, extent)))
    for e in eigenvalues:
        x, y = (part.mid for part in e.of_perron)
        shapes += [Dot(at(x, v)) for v in ([y, -y] if e.is_pair else [y])]
    shapes.append(Dot(at(one), hollow=True))
    return Picture("the eigenvalues of P in the complex plane", "fomas spectrum", tuple(shapes))
