"""The checker's answer to a certificate: an outcome for each value and claim, and an exit status.

Source: docs/certificate-format.md, sections 6 and 8 to 11.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from typing import Literal, TypeVar, cast

from fomas_verify.checker.claims import require_claim
from fomas_verify.checker.designs import Design, UncertainDesign
from fomas_verify.checker.document import Claim, Document, read_document
from fomas_verify.checker.edge_list import Opener
from fomas_verify.checker.facts import Facts
from fomas_verify.checker.graph import Graph
from fomas_verify.checker.large import (
    Numeric,
    quotients_of,
    read_graph,
    require_by_factor,
    require_large_claim,
    require_large_value,
    require_vector,
)
from fomas_verify.checker.large_bounds import Known, LargeGraph
from fomas_verify.checker.large_form import LargeClaim, LargeDesign, Spectrum
from fomas_verify.checker.member_values import require_value_of_all
from fomas_verify.checker.members import Members, require_claim_of_all
from fomas_verify.checker.region_form import Condition
from fomas_verify.checker.regions import require_condition
from fomas_verify.checker.ruling import Refused, Undecided
from fomas_verify.checker.switching import (
    Switched,
    require_switched_claim,
    require_switched_condition,
    require_switched_value,
)
from fomas_verify.checker.switching_form import SwitchedClaim, SwitchedCondition, SwitchedDesign
from fomas_verify.checker.task_form import Limits, Task
from fomas_verify.checker.tasks import require_task_claim
from fomas_verify.checker.value_form import Bounds, Value
from fomas_verify.checker.values import require_value

MAX_AGENTS = 2000

Kind = Literal["value", "claim", "condition", "task"]
Status = Literal["accepted", "refused", "undecided"]
Stated = Claim | Condition | SwitchedClaim | SwitchedCondition | LargeClaim
Named = Design | UncertainDesign | SwitchedDesign | LargeDesign
Said = TypeVar("Said")


@dataclass(frozen=True)
class Outcome:
    """What the checker says of one value, claim, condition or claim about a task.

    Attributes
    ----------
    kind : which of the four it is; a condition of a region is no claim about the design, though `gain-bound` is an id
        of both, and neither is a claim about the task of a synthesis
    id : the value's key (a margin's keys, with points between) or the id of the claim, or condition
    verdict : the certificate's verdict on a claim or condition, None for a value
    status : `accepted` if it is true and seen to be, `refused` if it is false or not shown by its witness, `undecided`
        if that took more than the work allowed
    reason : in words
    """

    kind: Kind
    id: str
    verdict: str | None
    status: Status
    reason: str


@dataclass(frozen=True)
class Shortfall:
    """A required claim that the certificate does not prove, why, and the exit status (1 or 3) that this calls for."""

    id: str
    reason: str
    exit_status: int


@dataclass(frozen=True)
class Report:
    """What the checker says of a certificate.

    Attributes
    ----------
    design : the design that the certificate is about, in exact rationals and sorted edges
    outcomes : one for each value and each claim, in the file's order
    limits : those of a synthesis, None of another certificate
    """

    design: Named
    outcomes: tuple[Outcome, ...]
    limits: Limits | None = None

    @property
    def exit_status(self) -> int:
        """1 if anything was refused, else 3 if anything was undecided, else 0."""
        found = {outcome.status for outcome in self.outcomes}
        return 1 if "refused" in found else 3 if "undecided" in found else 0

    @property
    def verdicts(self) -> dict[str, str]:
        """The verdicts of the accepted claims."""
        return {
            outcome.id: outcome.verdict
            for outcome in self.outcomes
            if outcome.verdict is not None and outcome.kind == "claim" and outcome.status == "accepted"
        }

    def shortfalls(self, required: Iterable[str]) -> tuple[Shortfall, ...]:
        """Those of the required claims that are not accepted as proved."""
        claims = {outcome.id: outcome for outcome in self.outcomes if outcome.kind == "claim"}
        return tuple(
            shortfall
            for shortfall in (_shortfall(name, claims.get(name)) for name in required)
            if shortfall is not None
        )


def _shortfall(name: str, outcome: Outcome | None) -> Shortfall | None:
    if outcome is None:
        return Shortfall(name, "absent from the certificate", 1)
    if outcome.status != "accepted":
        return Shortfall(name, f"{outcome.status} by the checker", 1 if outcome.status == "refused" else 3)
    if outcome.verdict == "proved":
        return None
    return Shortfall(name, f"{outcome.verdict}", 3 if outcome.verdict == "undecided" else 1)


def check(document_bytes: bytes, *, opener: Opener | None = None, numeric: Numeric | None = None) -> Report:
    """Decide whether a certificate is true.

    Everything in it is decided anew, in exact or outward-rounded integer arithmetic; rigorous.

    Parameters
    ----------
    document_bytes : the certificate as it stands in its file
    opener : opens the edge list that a certificate about a large network names, in the certificate's folder
    numeric : redoes the bounds of such a certificate that take a sparse factor; without it they are undecided

    Returns
    -------
    Report
        An outcome for each value and claim.

    Raises
    ------
    Malformed
        If the bytes are not a certificate of this format.
    """
    document = read_document(document_bytes)
    limits = None if document.task is None else document.task.limits
    return Report(document.design, tuple(_outcomes(document, opener, numeric)), limits)


def _outcomes(document: Document, opener: Opener | None, numeric: Numeric | None) -> Iterable[Outcome]:
    design = document.design
    if isinstance(design, LargeDesign):
        yield from _large_outcomes(document, read_graph(design, opener), numeric)
        return
    value_test, claim_test = _tests(design)
    beyond = f"more than {MAX_AGENTS} agents are beyond this checker" if design.agents > MAX_AGENTS else ""
    for value in document.values:
        status, reason = _ruled(beyond, value_test, value)
        yield Outcome("value", value.name, None, status, reason)
    for claim in document.claims:
        status, reason = _ruled(beyond, claim_test, claim)
        kind: Kind = "condition" if isinstance(claim, Condition | SwitchedCondition) else "claim"
        yield Outcome(kind, claim.id, claim.verdict, status, reason)
    if document.task is not None:
        yield from _task_outcomes(cast(Design, design), document.task, beyond)


def _large_outcomes(document: Document, graph: LargeGraph, numeric: Numeric | None) -> Iterable[Outcome]:
    """Those of vectors and bounds, and those of the values and claims that rest on what was accepted of them."""
    design, spectrum = cast(LargeDesign, document.design), cast(Spectrum, document.spectrum)
    accepted: list[tuple[int, ...]] = []
    for index, vector in enumerate(spectrum.vectors):
        status, reason = _ruled("", require_vector, vector)
        accepted += [vector] if status == "accepted" else []
        yield Outcome("value", f"spectrum.vectors[{index}]", None, status, reason)
    known = Known(design, graph, quotients_of(graph, accepted))
    shown: list[tuple[str, Fraction]] = []
    for bound in spectrum.by_factor:
        status, reason = _ruled("", partial(require_by_factor, known, numeric), bound)
        shown += [bound] if status == "accepted" else []
        yield Outcome("value", f"spectrum.{bound[0]}", None, status, reason)
    known = Known(design, graph, known.quotients, tuple(shown))
    for value in document.values:
        status, reason = _ruled("", partial(require_large_value, known), cast(Bounds, value))
        yield Outcome("value", value.name, None, status, reason)
    for claim in cast(tuple[LargeClaim, ...], document.claims):
        status, reason = _ruled("", partial(require_large_claim, known), claim)
        yield Outcome("claim", claim.id, claim.verdict, status, reason)


def _task_outcomes(design: Design, task: Task, beyond: str) -> Iterable[Outcome]:
    """The condition's, and those of the task's claims, which rest on it."""
    facts, condition = Facts(design, Graph(design)), task.condition
    met, why = _ruled(beyond, partial(require_condition, facts), condition)
    yield Outcome("condition", condition.id, condition.verdict, met, why)
    for claim in task.claims:
        status, reason = met, f"the condition {condition.id}, on which it rests, is {met}"
        if met == "accepted":
            status, reason = _ruled(beyond, partial(require_task_claim, facts, task), claim)
        yield Outcome("task", claim.id, claim.verdict, status, reason)


def _tests(
    design: Design | UncertainDesign | SwitchedDesign,
) -> tuple[Callable[[Value], str], Callable[[Stated], str]]:
    if isinstance(design, SwitchedDesign):
        return _switched_tests(Switched(design))
    if isinstance(design, UncertainDesign):
        members = Members(design, Graph(design))
        return partial(require_value_of_all, members), lambda claim: require_claim_of_all(members, cast(Claim, claim))
    facts = Facts(design, Graph(design))

    def test(claim: Stated) -> str:
        if isinstance(claim, Condition):
            return require_condition(facts, claim)
        return require_claim(facts, cast(Claim, claim))

    return partial(require_value, facts), test


def _switched_tests(switched: Switched) -> tuple[Callable[[Value], str], Callable[[Stated], str]]:
    def test(claim: Stated) -> str:
        if isinstance(claim, SwitchedCondition):
            return require_switched_condition(switched, claim)
        return require_switched_claim(switched, cast(SwitchedClaim, claim))

    return partial(require_switched_value, switched), test


def _ruled(beyond: str, test: Callable[[Said], str], said: Said) -> tuple[Status, str]:
    if beyond:
        return "undecided", beyond
    try:
        return "accepted", test(said)
    except Refused as refusal:
        return "refused", str(refusal)
    except Undecided as limit:
        return "undecided", str(limit)
