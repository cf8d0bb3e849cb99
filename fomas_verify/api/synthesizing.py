"""The best (gamma, h), proved, with its design file and certificate: what the command and the API both give."""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction
from typing import TYPE_CHECKING

from fomas_verify.certificate.document import plain as in_json
from fomas_verify.certificate.synthesis_document import synthesis_certificate_text
from fomas_verify.checker import check
from fomas_verify.design import Design, parse_design
from fomas_verify.enclosure.reference import DisagreementError
from fomas_verify.exact.rational import format_rational, shortened
from fomas_verify.prover import Proof, prove
from fomas_verify.region import find_region
from fomas_verify.region.clash import clash
from fomas_verify.region.common_form import SOLVER
from fomas_verify.region.design_file import design_text
from fomas_verify.region.errors import UndecidedRegionError
from fomas_verify.region.model import Condition
from fomas_verify.region.program import Opinion, is_installed, opinion
from fomas_verify.region.synthesize import Answer, synthesize
from fomas_verify.region.task import DEFAULT_SETTLE_TO, Objective, pose
from fomas_verify.region.task_entries import limits_entry, task_entry
from fomas_verify.region.weighted_design import weighted_design, weights_record

if TYPE_CHECKING:
    from fomas_verify.region.task import Task
    from fomas_verify.region.weights import BestWeights

NONE_EXISTS = 1


@dataclass(frozen=True)
class Synthesized:
    """A synthesis that the checker accepted.

    Attributes
    ----------
    answer : Answer
        The point, or that there is none.
    proof : Proof or None
        What is proved of the design found; None where none exists.
    clash : str or None
        Where none exists, what clashes.
    second : Opinion or None
        What the geometric program says, where it was asked.
    chosen : BestWeights or None
        The weights, where they were chosen too.
    certificate : bytes
        Of the synthesis.
    design_file : bytes
        The design found, as a design file; empty where none exists.
    """

    answer: Answer
    proof: Proof | None
    clash: str | None
    second: Opinion | None
    chosen: BestWeights | None
    certificate: bytes
    design_file: bytes

    @property
    def exit_status(self) -> int:
        """0, or 1 where it is proved that no gamma and h satisfy condition and limits."""
        return NONE_EXISTS if self.proof is None else 0

    def text(self) -> str:
        """For a reader."""
        from fomas_verify.report.synthesis import found_lines, heading

        if self.proof is None:
            reason = self.clash or "proved"
            return f"{heading(self.answer.task)}\n\nNo gamma and h satisfy condition and limits.\n  {reason}"
        return "\n".join(found_lines(self.answer, self.proof, _former(self.answer.task, self.proof), self.second))

    def record(self) -> dict[str, object]:
        """For other programs."""
        return _record(self.answer, self.proof, self.second, self.clash, self.chosen)


def find(
    named: Design, objective: Objective, condition: Condition, *, weights: bool, symmetric: bool, second: bool
) -> Synthesized:
    """Find the best gamma and h under a design's limits. Rigorous.

    Parameters
    ----------
    named : Design
        With or without gamma and h.
    objective, condition
        What is best, and the strip in which to search.
    weights, symmetric : bool
        Whether the weights of its edges are chosen before, and the same both ways.
    second : bool
        Whether cvxpy is asked for a second opinion, where it is installed.

    Raises
    ------
    UndecidedRegionError
        Nothing was decided within the work allowed.
    DisagreementError
        The checker refuses what was found.
    """
    chosen = _weights(named, symmetric=symmetric) if weights else None
    region = find_region(named if chosen is None else weighted_design(named, chosen))
    task = pose(region, condition, objective)
    answer = synthesize(task)
    if answer.point is None:
        return Synthesized(answer, None, clash(task), None, chosen, _certificate(answer, None, chosen), b"")
    told = None
    if answer.piece is not None and second and is_installed():
        told = opinion(answer.piece.piece, task.objective)
    proof = _proved(answer)
    file = _design_file(proof.design, task, chosen)
    return Synthesized(answer, proof, None, told, chosen, _certificate(answer, proof, chosen), file)


def _weights(design: Design, *, symmetric: bool) -> BestWeights:
    """The weights, by a solver; raises `MissingExtraError` where it is not installed."""
    from fomas_verify.region.lmi import need_solver
    from fomas_verify.region.weights import best_weights

    need_solver()
    return best_weights(design, symmetric=symmetric)


def _proved(answer: Answer) -> Proof:
    """The design that was found, all that it requires proved; raises `UndecidedRegionError` where that is not so."""
    task, point = answer.task, answer.point
    if point is None:
        raise TypeError("no design was found")
    name = f"{task.design.name[:150]}, {task.objective}"
    settle_to = task.design.settle_to or DEFAULT_SETTLE_TO
    found = replace(task.design, name=name, gamma=point.gamma, mu=None, h=point.h, settle_to=settle_to)
    proof = prove(found)
    if proof.exit_status:
        failing = [x for x in found.require if proof.decisions[x].verdict.value != "proved"]
        gamma, h = (shortened(format_rational(x)) for x in (point.gamma, point.h))
        raise UndecidedRegionError(
            f"{task.design.source}: the best point, gamma = {gamma} and h = {h}, does not satisfy "
            f"{', '.join(failing)}, which the design requires; whether another does is not decided"
        )
    return proof


def _former(task: Task, proof: Proof) -> Proof | None:
    """The user's own design, where it gives gamma and h or mu, measured as the new one is."""
    design = task.design
    if design.mu is None and (design.gamma is None or design.h is None):
        return None
    return prove(replace(design, settle_to=proof.design.settle_to))


def _certificate(answer: Answer, proof: Proof | None, chosen: BestWeights | None) -> bytes:
    """The certificate, accepted by the checker; raises `DisagreementError` where it is not."""
    from importlib.metadata import version

    design = replace(answer.task.design, gamma=None, mu=None, h=None) if proof is None else proof.design
    values, decisions = ({}, {}) if proof is None else (proof.value_entries(), proof.decisions)
    entry = task_entry(answer) | ({} if chosen is None else {"solver": SOLVER})
    text = synthesis_certificate_text(design, entry, values, decisions, version("fomas_verify")).encode()
    report = check(text)
    refused = [x for x in report.outcomes if x.status == "refused"]
    if refused:
        raise DisagreementError(f"the checker refuses {refused[0].id} of the synthesis: {refused[0].reason}")
    if report.exit_status:
        raise UndecidedRegionError(f"{answer.task.design.source}: the checker did not decide the certificate")
    return text


def _design_file(design: Design, task: Task, chosen: BestWeights | None) -> bytes:
    """The design file, which reads as the design that was proved."""
    weights = "" if chosen is None else f" --weights; {SOLVER} proposed the weights, on another machine perhaps others"
    text = design_text(design, f"found by: verify-design synthesize --objective {task.objective}{weights}")
    same = parse_design(text, "toml", design.source)
    if replace(same, notes=design.notes) != design:
        raise DisagreementError("the design file that was written reads as another design")
    return text.encode()


def _record(
    answer: Answer, proof: Proof | None, second: Opinion | None, why: str | None, chosen: BestWeights | None
) -> dict[str, object]:
    """What ``--json`` prints."""
    task, point = answer.task, answer.point
    found: dict[str, Fraction | int | None] | None = None
    if point is not None:
        found = {"gamma": point.gamma, "h": point.h, "samples": point.samples}
    record = {
        "objective": task.objective.value,
        "condition": task.condition.value,
        "limits": limits_entry(task),
        "found": found,
        "bound": answer.bound,
        "clash": why,
        "values": None if proof is None else proof.value_entries(),
        "geometric_program": None if second is None else {"agrees": second.agrees, "reason": second.reason},
    }
    plain: dict[str, object] = in_json(record)
    return plain | ({} if chosen is None else {"weights": weights_record(chosen)})
