"""A design's certificate as a Coq file, which ends in a theorem about that design.

It restates what was decided, with integers and a factor that ``vm_compute`` checks and enclosures that ``interval``
proves; nothing is decided here. A claim without such a proof is named in a comment as not restated. Source of each
lemma: proofs/Design.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from fomas_verify.certificate.coq_chapter import Step
from fomas_verify.certificate.coq_enclosures import Enclosures
from fomas_verify.certificate.coq_steps import steps
from fomas_verify.claims.verdict import Decision, Verdict
from fomas_verify.design.claim_ids import CLAIM_IDS
from fomas_verify.exact.errors import FomasError
from fomas_verify.spectrum.loop import Loop

MOST_AGENTS = 12
PRECISIONS = ((20, 40), (20, 72), (40, 140), (80, 280))
"""Significant digits of mu and bits of lambda2, tried in this order until every claim is restated; the first two need
no hypothesis."""
KEYWORDS = re.compile(
    "Axiom|CoFixpoint|Definition|Export|Fixpoint|Hypothesis|Import|Parameter|S?Prop|Set|Theorem|Type|Variable"
)
"""Words with a capital that Coq 8.16 does not take for the name of a module in ``Require``."""
HYPOTHESIS = (
    "the enclosure of Gamma(alpha + 1) is the only hypothesis: the margin is finer than Coq encloses Gamma here"
)


class CoqLimitError(FomasError):
    """The design has more agents than a Coq file of seconds can hold."""


@dataclass(frozen=True)
class CoqFile:
    """A Coq file: its module's name and text, the claims it leaves out, and whether it assumes Gamma's enclosure."""

    module: str
    text: str
    omitted: tuple[str, ...]
    assumes_gamma: bool

    def remarks(self) -> tuple[str, ...]:
        """What its reader must know, a line each: claims left out, and a hypothesis."""
        left_out = (f"not restated: {', '.join(self.omitted)}",) if self.omitted else ()
        return left_out + ((HYPOTHESIS,) if self.assumes_gamma else ())


def coq_file(loop: Loop, decisions: Mapping[str, Decision]) -> CoqFile:
    """Restate a proof for Coq.

    Parameters
    ----------
    loop : Loop
        The closed loop of a design of at most `MOST_AGENTS` agents.
    decisions : mapping
        What was decided, by claim id.

    Returns
    -------
    CoqFile
        The same text for the same design on every machine.

    Raises
    ------
    CoqLimitError
        The design has more agents, or nothing of what was decided can be restated.
    """
    design = loop.design
    if design.graph.agents > MOST_AGENTS:
        raise CoqLimitError(
            f"{design.source}: a Coq file is written for at most {MOST_AGENTS} agents, got {design.graph.agents}"
        )
    found: list[tuple[Enclosures, list[Step]]] = []
    for digits, bits in PRECISIONS:
        enclosures = Enclosures.of(loop, digits, bits)
        found.append((enclosures, steps(loop, decisions, enclosures)))
        if not _omitted(decisions, found[-1][1]):
            break
    enclosures, chosen = min(found, key=lambda item: len(_omitted(decisions, item[1])))
    omitted = _omitted(decisions, chosen)
    if not any(step.claim for step in chosen):
        raise CoqLimitError(f"{design.source}: no verdict on this design can be restated for Coq")
    file = CoqFile(module_name(design.name), "", omitted, enclosures.assumes_gamma)
    return replace(file, text=_text(_header(file.module, file.remarks()), loop, enclosures, chosen))


def module_name(name: str) -> str:
    """The design's name as the name of a Coq module: letters, digits and underscores, a capital first, no keyword."""
    plain = re.sub(r"[^A-Za-z0-9]+", "_", name).strip("_")
    capital = plain[:1].upper() + plain[1:]
    if capital[:1].isalpha() and not KEYWORDS.fullmatch(capital):
        return capital
    return f"Design_{capital}".rstrip("_")


def _omitted(decisions: Mapping[str, Decision], chosen: Sequence[Step]) -> tuple[str, ...]:
    restated = {step.claim for step in chosen}
    return tuple(
        f"{claim} ({decision.verdict.value})"
        for claim, decision in decisions.items()
        if claim not in restated and decision.verdict in (Verdict.PROVED, Verdict.REFUTED)
    )


def _text(header: str, loop: Loop, enclosures: Enclosures, chosen: Sequence[Step]) -> str:
    conclusions = sorted((step for step in chosen if step.claim), key=lambda step: CLAIM_IDS.index(step.claim))
    lines = [f"  (* {step.claim}: {step.verdict} *)\n  ({step.statement})" for step in conclusions]
    parts = [header, enclosures.definitions(loop), *(step.lemma for step in chosen)]
    parts.append("Definition conclusion : Prop :=\n" + " /\\\n".join(lines) + ".")
    parts.append(
        f"Theorem certified : conclusion.\nProof.\n  exact {_conjunction([s.name for s in conclusions])}.\nQed."
    )
    if enclosures.assumes_gamma:
        parts.append("End Design.")
    return "\n\n".join(parts) + "\n"


def _conjunction(names: Sequence[str]) -> str:
    return names[0] if len(names) == 1 else f"(conj {names[0]} {_conjunction(names[1:])})"


def _header(module: str, remarks: Sequence[str]) -> str:
    lines = "".join(f"\n    {line[0].upper()}{line[1:]}." for line in remarks)
    return (
        "(** The certificate of one design, decided by coqc; PROOFS is the compiled folder proofs/ of fomas_verify:\n"
        f"    coqc -R PROOFS Fomas -w -ambiguous-paths {module}.v{lines} *)\n"
        "From Interval Require Import Tactic.\n"
        "From Fomas Require Import Design.Claims Design.Forms Design.Directions Design.Gain.\n"
        "From Fomas Require Import Design.Spectrum Design.Step Design.Samples Design.Tail Design.Trajectory.\n"
        "Import ListNotations.\n"
        "Open Scope R_scope."
    )
