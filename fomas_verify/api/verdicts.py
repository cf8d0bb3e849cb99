"""`prove`: the verdicts on a design."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias

from fomas_verify.api.design import LOG, Design, Exact, exact_design
from fomas_verify.api.results import Cells, Certified
from fomas_verify.claims.verdict import Decision, Verdict
from fomas_verify.design import DesignError, LargeDesign, SwitchedDesign, UncertainDesign
from fomas_verify.design import plain as plain_design
from fomas_verify.enclosure.interval import Interval
from fomas_verify.prover import LargeProof, UncertainProof
from fomas_verify.prover import Proof as ExactProof

if TYPE_CHECKING:
    from fomas_verify.region.switching import SwitchedProof

CERTIFICATE = "certificate.json"
"""The file in which the certificate of a large graph thinks itself as long as it has none."""

Found: TypeAlias = "ExactProof | LargeProof | UncertainProof | SwitchedProof"


@dataclass(frozen=True, eq=False, repr=False)
class Proof(Certified):
    """What was decided about a design.

    Attributes
    ----------
    design : Design
        The design.
    decisions : mapping of str to Decision
        Of each claim the verdict, the `reason` with the numbers that decide, and of a refuted one the `remedy`.
    """

    design: Design
    found: Found

    @property
    def decisions(self) -> Mapping[str, Decision]:
        """By the claims' ids."""
        return self.found.decisions

    @property
    def verdicts(self) -> dict[str, Verdict]:
        """By the claims' ids: `Verdict.PROVED` and so on, equal to "proved", "refuted", "undecided", "inapplicable"."""
        return {name: decision.verdict for name, decision in self.decisions.items()}

    @property
    def values(self) -> dict[str, tuple[Fraction, Fraction]]:
        """Rigorous lower and upper bounds of mu, beta, sigma, lambda2, threshold, degree_max where they exist."""
        values: Mapping[str, Interval] = getattr(self.found, "values", {})
        return {name: (x.lower, x.upper) for name, x in values.items()}

    @property
    def exit_status(self) -> int:
        """0 every required claim is proved, 1 one is refuted or inapplicable, 3 one is undecided."""
        return self.found.exit_status

    @cached_property
    def certificate(self) -> str:
        """The certificate's text, canonical but for what a solver proposed about a large graph."""
        return self.found.certificate(CERTIFICATE) if isinstance(self.found, LargeProof) else self.found.certificate()

    def save(self, path: str | PathLike[str]) -> None:
        """Write the certificate, whole or not at all, and before it a large graph's edge list, which it names."""
        from fomas_verify.report.files import write_all

        if isinstance(self.found, LargeProof):
            write_all(self.found.files(Path(path)))
        else:
            super().save(path)

    def __str__(self) -> str:
        from fomas_verify.report.text import proof_text, uncertain_text

        if isinstance(self.found, ExactProof):
            return proof_text(self.found)
        if isinstance(self.found, UncertainProof):
            return uncertain_text(self.found)
        if isinstance(self.found, LargeProof):
            from fomas_verify.report.large_text import large_proof_text

            return large_proof_text(self.found)
        from fomas_verify.report.switched_text import switched_proof_text

        return switched_proof_text(self.found)

    def __repr__(self) -> str:
        required = plain_design(self.design.exact).require
        proved = sum(self.decisions[name].verdict is Verdict.PROVED for name in required)
        return f"<Proof of {self.design.name!r}: {proved} of {len(required)} required claims proved>"

    def _table(self) -> tuple[str, Cells]:
        required = plain_design(self.design.exact).require
        rows = [
            (f"{name} (required)" if name in required else name, decision.verdict.value, decision.reason)
            for name, decision in self.decisions.items()
        ]
        return self.design.name, [("claim", "verdict", "because"), *rows]


def prove(design: Design | Exact | str | PathLike[str], *, horizon: int | None = None, digits: int = 50) -> Proof:
    """Decide every claim about a design. Rigorous.

    Parameters
    ----------
    design : Design or path
        With mu, or gamma and h; intervals and several graphs too.
    horizon : int, optional
        Also check (14) term by term, k = 0..horizon.
    digits : int
        Significant digits of the values, at least 20.

    Returns
    -------
    Proof
        Verdicts, values and the certificate.

    Raises
    ------
    FomasError
        The design lacks something (`exit_status` 2), or is larger than the work allowed (3).

    Examples
    --------
    >>> proof = prove(Design(alpha="9/10", mu="1/2", graph="complete", agents=2))
    >>> proof.verdicts["average-consensus"]
    <Verdict.PROVED: 'proved'>
    >>> proof.exit_status
    0
    """
    exact = exact_design(design)
    found = _decided(exact, horizon, digits)
    for note in found.notes if isinstance(found, LargeProof) else ():
        LOG.info("%s: %s", plain_design(exact).name, note)
    for name, decision in found.decisions.items():
        LOG.info("%s: %s: %s", plain_design(exact).name, name, decision.verdict.value)
    return Proof(design if isinstance(design, Design) else Design.of(exact), found)


def _decided(exact: Exact, horizon: int | None, digits: int) -> Found:
    from fomas_verify.prover import prove as prove_exactly
    from fomas_verify.prover import prove_large, prove_uncertain

    if isinstance(exact, LargeDesign):
        return prove_large(exact, horizon=horizon, digits=digits)
    if isinstance(exact, UncertainDesign | SwitchedDesign):
        if horizon is not None:
            what = "an interval" if isinstance(exact, UncertainDesign) else "several graphs"
            raise DesignError(f"{plain_design(exact).source}: horizon is not supported yet with {what}")
        if isinstance(exact, UncertainDesign):
            return prove_uncertain(exact)
        from fomas_verify.region.switching import prove_switched

        return prove_switched(exact)
    return prove_exactly(exact, horizon=horizon, digits=digits)
