"""What every step of a design's Coq file has in common: the lemma's form, and how integers are written.

A builder gives no step where these numbers do not show its claim; then the claim is left out. What is compared here
only spares coqc a proof that would fail.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction

from fomas_verify.certificate.coq_enclosures import Enclosures, quotient, table
from fomas_verify.certificate.coq_factor import Factor, Squares
from fomas_verify.certificate.coq_figures import Figures
from fomas_verify.claims.verdict import Decision, Verdict
from fomas_verify.enclosure.interval import Interval
from fomas_verify.spectrum.loop import Loop

GRAPH = "agents weights denominator positive"
BALANCED = "(proj2 (proj2 graph_assumption))"


@dataclass(frozen=True)
class Step:
    """A lemma; where it is the conclusion on a claim, that claim. Without a statement the proof is a definition."""

    name: str
    statement: str
    proof: str
    claim: str = ""
    verdict: str = ""

    @property
    def lemma(self) -> str:
        """Its text."""
        if not self.statement:
            return self.proof
        return f"Lemma {self.name} : {self.statement}.\nProof.\n  {self.proof}\nQed."


@dataclass(frozen=True)
class Chapter:
    """What a builder has to go by: the figures, the decisions, and the names of the lemmas already there."""

    figures: Figures
    decisions: Mapping[str, Decision]
    known: frozenset[str] = frozenset()

    @property
    def loop(self) -> Loop:
        """The closed loop."""
        return self.figures.loop

    @property
    def numbers(self) -> Enclosures:
        """mu as the file has it."""
        return self.figures.enclosures

    def decided(self, claim: str, verdict: Verdict) -> bool:
        """Whether this is the verdict on the claim."""
        return claim in self.decisions and self.decisions[claim].verdict is verdict


def with_lambda2(chapter: Chapter) -> tuple[Interval, str] | None:
    """The enclosure of mu lambda2, and the arguments that give it to a lemma."""
    lower, upper = chapter.figures.lambda2_lower, chapter.figures.lambda2_upper
    if "lambda2_above" not in chapter.known or lower is None or upper is None:
        return None
    mu = chapter.numbers
    product = Interval(mu.mu.lower * lower[0], mu.mu.upper * upper[0])
    numbers = f"({mu.low} / {mu.unit}) ({mu.high} / {mu.unit}) ({quotient(lower[0])}) ({quotient(upper[0])})"
    return product, numbers


def about_loops(
    chapter: Chapter, name: str, statement: str, use: str, exact: str, claim: str, verdict: str = "proved"
) -> Step:
    """A step about gamma and h; where the design gives mu alone, about every gamma and h that give it."""
    if chapter.numbers.gamma is not None:
        return Step(name, statement, f"{use}\n  exact {exact}.", claim, verdict)
    given = "forall gamma h, design alpha gamma h -> mu_of alpha gamma h = mu ->\n    "
    proof = f"intros gamma h range given. {use}\n  rewrite given. exact {exact}."
    return Step(name, given + statement, proof, claim, verdict)


def ends(x: Fraction) -> str:
    """A rational as two integers, numerator first."""
    return f"{_integer(x.numerator)} {x.denominator}"


def _integer(n: int) -> str:
    return str(n) if n >= 0 else f"({n})"


def mu_range(chapter: Chapter) -> str:
    """The enclosure of mu as three integers, the common denominator last."""
    return f"{chapter.numbers.low} {chapter.numbers.high} {chapter.numbers.unit}"


def vector(e: list[int]) -> str:
    """An integer vector."""
    return f"[{'; '.join(map(str, e))}]%Z"


def factor_text(shown: Factor) -> str:
    """Weight, factor, scale and bound of the residual."""
    return f"{shown.weight}\n    {table(shown.rows)}\n    {shown.scale} {shown.eps}"


def squares_text(shown: Squares) -> str:
    """Rows, weights and scale."""
    return f"{table(shown.rows)}\n    {vector(shown.weights)} {shown.scale}"
