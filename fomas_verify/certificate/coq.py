"""A design's certificate as a Coq file, which ends in a theorem about that design.

It restates what was decided, with integers and a factor that ``vm_compute`` checks and enclosures that ``interval``
proves; nothing is decided here. A claim without such a proof is named in a comment as not restated. Source of each
lemma: proofs/Design.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from fomas_verify.certificate.coq_enclosures import Enclosures
from fomas_verify.certificate.coq_steps import Step, steps
from fomas_verify.claims.verdict import Decision
from fomas_verify.design.claim_ids import CLAIM_IDS
from fomas_verify.exact.errors import FomasError
from fomas_verify.spectrum.loop import Loop

MOST_AGENTS = 12
DIGITS = (20, 40, 80)
"""Significant digits of mu, tried in this order; Coq encloses Gamma to 25 itself, and takes it as a hypothesis beyond."""


class CoqLimitError(FomasError):
    """The design has more agents than a Coq file of seconds can hold."""


@dataclass(frozen=True)
class CoqFile:
    """A Coq file: its module's name, its text, the claims it leaves out and whether Gamma's enclosure is a hypothesis."""

    module: str
    text: str
    omitted: tuple[str, ...]
    assumes_gamma: bool


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
    for digits in DIGITS:
        enclosures = Enclosures.of(loop, digits)
        found.append((enclosures, steps(loop, decisions, enclosures)))
        if not _omitted(decisions, found[-1][1]):
            break
    enclosures, chosen = min(found, key=lambda item: len(_omitted(decisions, item[1])))
    omitted = _omitted(decisions, chosen)
    if not any(step.claim for step in chosen):
        raise CoqLimitError(f"{design.source}: no verdict on this design can be restated for Coq")
    module = module_name(design.name)
    text = _text(module, loop, enclosures, chosen, omitted)
    return CoqFile(module, text, omitted, enclosures.assumes_gamma)


def module_name(name: str) -> str:
    """The design's name as the name of a Coq module: letters, digits and underscores, a capital first."""
    plain = re.sub(r"[^A-Za-z0-9]+", "_", name).strip("_")
    return plain[:1].upper() + plain[1:] if plain[:1].isalpha() else f"Design_{plain}".rstrip("_")


def _omitted(decisions: Mapping[str, Decision], chosen: Sequence[Step]) -> tuple[str, ...]:
    restated = {step.claim for step in chosen}
    return tuple(f"{name}: {decision.verdict.value}" for name, decision in decisions.items() if name not in restated)


def _text(module: str, loop: Loop, enclosures: Enclosures, chosen: Sequence[Step], omitted: Sequence[str]) -> str:
    conclusions = sorted((step for step in chosen if step.claim), key=lambda step: CLAIM_IDS.index(step.claim))
    parts = [_header(module, omitted, assumes_gamma=enclosures.assumes_gamma), enclosures.definitions(loop)]
    parts += [step.lemma for step in chosen]
    parts.append(_conclusion(conclusions))
    names = " (conj ".join(step.name for step in conclusions[:-1])
    proof = f"{names} {conclusions[-1].name}" + ")" * (len(conclusions) - 2) if names else conclusions[-1].name
    proof = f"exact (conj {proof})" if names else f"exact {proof}"
    parts.append(f"Theorem certified : conclusion.\nProof. {proof}. Qed.")
    if enclosures.assumes_gamma:
        parts.append("End Design.")
    return "\n\n".join(parts) + "\n"


def _header(module: str, omitted: Sequence[str], *, assumes_gamma: bool) -> str:
    left_out = f"\n    Not restated here: {'; '.join(omitted)}." if omitted else ""
    hypothesis = (
        "\n    The only hypothesis of the theorem is the enclosure of Gamma: the margin of a claim is below what the"
        "\n    library encloses."
        if assumes_gamma
        else ""
    )
    return (
        f"(** The certificate of one design. With PROOFS the compiled folder proofs/ of fomas_verify:\n"
        f"    coqc -R PROOFS Fomas -w -ambiguous-paths {module}.v{left_out}{hypothesis} *)\n"
        "From Interval Require Import Tactic.\n"
        "From Fomas Require Import Design.Claims Design.Gain.\n"
        "Import ListNotations.\n"
        "Open Scope R_scope."
    )


def _conclusion(conclusions: Sequence[Step]) -> str:
    lines = [f"  (* {step.claim}: {step.verdict} *)\n  ({step.statement})" for step in conclusions]
    return "Definition conclusion : Prop :=\n" + " /\\\n".join(lines) + "."

