"""Diagrams without a format: curves from the columns of a table, bands, points; `plot_latex` and `plot_svg` draw."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction

from fomas_verify.enclosure.digits import rounded_down, rounded_up
from fomas_verify.report.latex_text import Tex

DECIMALS, SIGNIFICANT = 12, 10
Column = Sequence[Fraction | None]


@dataclass(frozen=True)
class Table:
    """The data of figures: a file's name and its columns, None where there is nothing to draw.

    Numbers have 12 decimals; ten significant digits where ``small`` says that they span many powers of ten.
    """

    file: str
    columns: Mapping[str, Column]
    small: bool = False

    def csv(self) -> bytes:
        """The file: a header and a row for each place."""
        show = significant if self.small else plain
        rows = [
            ",".join(
                "nan" if x is None else str(x) if x.denominator == 1 and i == 0 else show(x) for i, x in enumerate(row)
            )
            for row in zip(*self.columns.values(), strict=True)
        ]
        return "\n".join([",".join(self.columns), *rows, ""]).encode()


@dataclass(frozen=True)
class Curve:
    """A column drawn: ``look`` is dots, squares, line or guide (dashed, grey); colors are counted from 0."""

    column: str
    look: str
    color: int
    label: Tex | None = None


@dataclass(frozen=True)
class Band:
    """What lies between two lines, each given by its y at both ends of the x axis."""

    lower: tuple[Fraction, Fraction]
    upper: tuple[Fraction, Fraction]
    shade: int
    label: Tex


@dataclass(frozen=True)
class Plot:
    """One diagram. ``x_label`` is printed as it stands; ``marked`` is a point with its label."""

    title: Tex
    x_label: str
    x_range: tuple[Fraction, Fraction]
    y_range: tuple[Fraction, Fraction]
    table: Table | None = None
    x: str = ""
    curves: tuple[Curve, ...] = ()
    bands: tuple[Band, ...] = ()
    marked: tuple[Fraction, Fraction, Tex] | None = None
    x_log: bool = False
    y_log: bool = False
    y_label: str = ""
    wide: bool = False
    levels: tuple[Fraction, ...] = field(default=())


def plain(x: Fraction) -> str:
    """x as a decimal with 12 digits after the point, rounded to nearest."""
    scaled = round(x * 10**DECIMALS)
    whole, rest = divmod(abs(scaled), 10**DECIMALS)
    return f"{'-' if scaled < 0 else ''}{whole}.{rest:0{DECIMALS}d}"


def significant(x: Fraction) -> str:
    """x to ten significant digits, truncated towards 0."""
    return (rounded_down(x, SIGNIFICANT) if x >= 0 else rounded_up(x, SIGNIFICANT)).replace("e+", "e")


def decades(values: Sequence[Fraction]) -> tuple[Fraction, Fraction]:
    """The powers of ten around positive numbers."""
    low, high = Fraction(1), Fraction(1)
    least, most = min(values), max(values)
    while low > least:
        low /= 10
    while low * 10 <= least:
        low *= 10
    while high < most:
        high *= 10
    while high / 10 >= most:
        high /= 10
    return (low, high) if low < high else (low, low * 10)


def with_room(low: Fraction, high: Fraction) -> tuple[Fraction, Fraction]:
    """A range a little wider than the numbers drawn, its ends short decimals."""
    pad = (high - low or Fraction(1)) / 20
    return Fraction(rounded_down(low - pad, 3)), Fraction(rounded_up(high + pad, 3))
