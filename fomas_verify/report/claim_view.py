"""One claim as a report shows it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import groupby

from fomas_verify.claims.registry import CLAIMS, Claim
from fomas_verify.claims.verdict import Verdict
from fomas_verify.prover import Proof
from fomas_verify.report.counterexample import BITS, Counterexample, counterexample
from fomas_verify.report.latex_text import Tex
from fomas_verify.report.math_text import sentence
from fomas_verify.report.witness_view import witness_text


@dataclass(frozen=True)
class ClaimView:
    """A claim, its verdict and what stands behind it, typeset; ``coq`` is a theorem's name or empty."""

    id: str
    verdict: str
    required: bool
    statement: Tex
    reason: Tex
    meaning: Tex
    remedy: Tex
    source: Tex
    coq: str
    witness: Tex
    witness_kind: str
    counterexample: Counterexample | None


@dataclass(frozen=True)
class Change:
    """What to change, and the claims that it would mend."""

    claims: tuple[ClaimView, ...]
    remedy: Tex


def claim_views(proof: Proof) -> tuple[ClaimView, ...]:
    """Every claim that was decided, in the order of the contract."""
    return tuple(_view(proof, claim) for claim in CLAIMS if claim.ID in proof.decisions)


def changes(claims: tuple[ClaimView, ...]) -> Iterator[Change]:
    """The remedies of what is refuted, each once, those of required claims first."""
    refuted = [claim for claim in claims if claim.verdict == Verdict.REFUTED]
    order = {claim.remedy: index for index, claim in reversed(list(enumerate(refuted)))}
    refuted.sort(
        key=lambda claim: (not any(c.required for c in refuted if c.remedy == claim.remedy), order[claim.remedy])
    )
    for remedy, group in groupby(refuted, key=lambda claim: claim.remedy):
        yield Change(tuple(group), remedy)


def _view(proof: Proof, claim: Claim) -> ClaimView:
    decision = proof.decisions[claim.ID]
    return ClaimView(
        id=claim.ID,
        verdict=decision.verdict.value,
        required=claim.ID in proof.design.require,
        statement=sentence(claim.STATEMENT),
        reason=sentence(decision.reason),
        meaning=sentence(decision.meaning),
        remedy=sentence(decision.remedy),
        source=sentence(claim.SOURCE),
        coq=claim.COQ,
        witness=_witness(proof, claim.ID),
        witness_kind=next((key for key in ("Q", "power", "Y", "k", "e") if key in decision.witness), ""),
        counterexample=_counterexample(proof, claim.ID),
    )


def _witness(proof: Proof, name: str) -> Tex:
    """The witness in print; one that serves several claims is printed with the first of them."""
    witness = proof.decisions[name].witness
    first = next(claim for claim, decision in proof.decisions.items() if decision.witness == witness)
    if witness and first != name and "e" not in witness:
        return Tex(rf"the one of \claimid{{{first}}}, Section~\ref{{claim:{first}}}")
    return witness_text(witness, proof.loop)


def _counterexample(proof: Proof, name: str) -> Counterexample | None:
    e = proof.decisions[name].witness.get("e")
    if e is None:
        return None
    bound = proof.loop.beta(BITS) if name == "beta-contraction" else proof.loop.threshold(BITS)
    return counterexample(proof.loop, e, bound)
