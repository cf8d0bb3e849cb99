"""The numbers of a design in a Coq file: definitions, and the enclosures of Gamma and mu that Coq proves.

Notation: ``mu`` between ``low / unit`` and ``high / unit``; every number an integer or a quotient of two.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import lcm

from fomas_verify.enclosure.interval import Interval
from fomas_verify.enclosure.real import gamma_function, power
from fomas_verify.network import adjacency
from fomas_verify.spectrum.loop import Loop

GAMMA_DIGITS = 24
"""Significant digits to which proofs/Design/Gain.v encloses Gamma."""


@dataclass(frozen=True)
class Enclosures:
    """mu and Gamma(alpha + 1) as the file has them.

    ``bits`` is the precision for lambda2, sigma and thresholds, ``gamma`` the ends of Gamma(alpha + 1) where mu is not
    given, and ``assumes_gamma`` whether they are a hypothesis.
    """

    low: int
    high: int
    unit: int
    bits: int
    gamma: tuple[Fraction, Fraction] | None
    assumes_gamma: bool

    @classmethod
    def of(cls, loop: Loop, digits: int, bits: int) -> Enclosures:
        """mu to so many significant digits."""
        design = loop.design
        if design.mu is not None:
            return cls(design.mu.numerator, design.mu.numerator, design.mu.denominator, bits, None, False)
        if design.gamma is None or design.h is None:
            raise TypeError("a closed loop needs mu, or gamma and h")
        working = 8 * digits
        places = digits + GAMMA_DIGITS - 20
        gamma = _decimal_ends(gamma_function(design.alpha + 1, working), places)
        input_size = power(design.h, design.alpha, working) * design.gamma
        low, high = _decimal_ends(Interval(input_size.lower / gamma[1], input_size.upper / gamma[0]), digits)
        unit = lcm(low.denominator, high.denominator)
        return cls(int(low * unit), int(high * unit), unit, bits, gamma, places > GAMMA_DIGITS)

    @property
    def mu(self) -> Interval:
        """The enclosure of mu."""
        return Interval(Fraction(self.low, self.unit), Fraction(self.high, self.unit))

    @property
    def by_interval(self) -> str:
        """The tactic that proves an inequality between closed terms."""
        return f"interval with (i_prec {100 + 2 * self.bits})"

    def definitions(self, loop: Loop) -> str:
        """The graph, the numbers of the design and the bounds of mu."""
        rows = adjacency(loop.design.graph)
        denominator = lcm(*(x.denominator for row in rows for x in row))
        lines = [
            f"Definition agents : nat := {loop.design.graph.agents}.",
            f"Definition weights : zmat := {table([[int(x * denominator) for x in row] for row in rows])}.",
            f"Definition denominator : Z := {denominator}.",
            "Definition graph : mat := weighted weights denominator.",
            f"Definition alpha : R := {quotient(loop.design.alpha)}.",
        ]
        bounds = f"{self.low} / {self.unit} <= mu <= {self.high} / {self.unit}"
        if self.gamma is None:
            lines += [f"Definition mu : R := {self.low} / {self.unit}.", ""]
            lines += [f"Lemma mu_bounds : {bounds}.", "Proof. split; apply Rle_refl. Qed."]
        else:
            lines += self._from_gamma(loop, bounds)
        lines += ["", "Lemma positive : (0 < denominator)%Z.", "Proof. check. Qed."]
        return "\n".join(lines)

    def _from_gamma(self, loop: Loop, bounds: str) -> list[str]:
        design = loop.design
        if self.gamma is None or design.gamma is None or design.h is None:
            raise TypeError("no gamma and h to compute mu from")
        at = design.alpha + 1
        enclosed = f"gamma_bounds : {quotient(self.gamma[0])} <= Gamma (alpha + 1) <= {quotient(self.gamma[1])}."
        proof = (
            f"Proof. replace (alpha + 1) with ({quotient(at)}) by (unfold alpha; lra). "
            f"enclose_gamma {at.numerator}%Z {at.denominator}%Z. Qed."
        )
        return [
            f"Definition gamma : R := {quotient(design.gamma)}.",
            f"Definition h : R := {quotient(design.h)}.",
            "Definition mu : R := mu_of alpha gamma h.",
            "",
            *(["Section Design.", f"Hypothesis {enclosed}"] if self.assumes_gamma else [f"Lemma {enclosed}", proof]),
            "",
            f"Lemma mu_bounds : {bounds}.",
            "Proof.",
            "  refine (mu_enclosed alpha gamma h _ _ _ _ _ _ _ _ gamma_bounds _ _); unfold alpha, gamma, h;",
            f"    first [lra | {self.by_interval}].",
            "Qed.",
            "",
            "Lemma range : design alpha gamma h.",
            "Proof. unfold design, alpha, gamma, h. lra. Qed.",
        ]


def quotient(x: Fraction) -> str:
    """A rational as a quotient of integers."""
    return f"{x.numerator} / {x.denominator}" if x >= 0 else f"({x.numerator}) / {x.denominator}"


def table(rows: Sequence[Sequence[int]]) -> str:
    """An integer matrix."""
    return "[" + ";\n  ".join(f"[{'; '.join(map(str, row))}]" for row in rows) + "]%Z"


def _decimal_ends(x: Interval, digits: int) -> tuple[Fraction, Fraction]:
    """Decimals around x > 0, the last of so many digits moved outward by one."""
    unit = Fraction(1)
    while x.lower * unit < 10 ** (digits - 1):
        unit *= 10
    while x.lower * unit >= 10**digits:
        unit /= 10
    low, high = x.lower * unit, x.upper * unit
    return (low.numerator // low.denominator - 1) / unit, (high.numerator // high.denominator + 2) / unit
