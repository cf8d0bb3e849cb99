"""The certificate as data: its schema, read from parsed JSON with the path of every defect.

Source: docs/certificate-format.md, sections 1 to 4 and 7 to 11.
"""

from dataclasses import dataclass

from fomas_verify.checker.claim_form import read_claims
from fomas_verify.checker.designs import Design, UncertainDesign, read_design, read_family
from fomas_verify.checker.large_form import (
    LargeClaim,
    LargeDesign,
    Spectrum,
    is_large,
    read_large_claims,
    read_large_design,
    read_large_values,
    read_spectrum,
)
from fomas_verify.checker.member_form import MemberWitness, read_member_witness
from fomas_verify.checker.region_form import Condition, read_conditions
from fomas_verify.checker.switching_form import (
    SwitchedClaim,
    SwitchedCondition,
    SwitchedDesign,
    is_switched,
    read_switched,
    read_switched_claims,
    read_switched_conditions,
    read_switched_values,
)
from fomas_verify.checker.task_form import Task, read_task
from fomas_verify.checker.text import Malformed, array, expected, fields, parse, string
from fomas_verify.checker.value_form import Value, read_values
from fomas_verify.checker.witness import read_witness

FORMAT = "fomas-certificate/1"


@dataclass(frozen=True)
class Claim:
    """What the certificate says of one claim."""

    id: str
    verdict: str
    statement: str
    witness: MemberWitness


@dataclass(frozen=True)
class Document:
    """A certificate of which only the form has been checked."""

    design: Design | UncertainDesign | SwitchedDesign | LargeDesign
    values: tuple[Value, ...]
    claims: tuple[Claim | Condition | SwitchedClaim | SwitchedCondition | LargeClaim, ...]
    task: Task | None = None
    spectrum: Spectrum | None = None


def read_document(data: bytes) -> Document:
    """Parse the bytes of a certificate.

    Raises
    ------
    Malformed
        On every defect of form.
    """
    whole = parse(data)
    if isinstance(whole, dict) and "format" in whole:
        # Of another format other keys are expected.
        _literal(whole["format"], "$.format", FORMAT)
    more = ("scale", "spectrum") if is_large(whole) else ("task",)
    top = fields(whole, "$", ("format", "kind", "design", "values", "claims", "tool"), more)
    kind = top["kind"]
    if "scale" in top:
        _literal(top["scale"], "$.scale", "large")
        _literal(kind, "$.kind", "design")
    if kind not in ("design", "region", "synthesis"):
        raise expected("$.kind", '"design", "region" or "synthesis"', kind)
    if ("task" in top) != (kind == "synthesis"):
        raise Malformed("$", 'expected a key "task" in a synthesis, and only there')
    tool = fields(top["tool"], "$.tool", ("name", "version"))
    _literal(tool["name"], "$.tool.name", "fomas_verify")
    if len(string(tool["version"], "$.tool.version")) > 64:
        raise expected("$.tool.version", "at most 64 characters", tool["version"])
    if "scale" in top:
        return _large(top)
    if is_switched(top["design"]) and kind in ("design", "region"):
        return _switched(top, of_region=kind == "region")
    if kind == "region":
        family = read_family(top["design"], "$.design")
        fields(top["values"], "$.values", ())
        return Document(family, (), read_conditions(top["claims"], "$.claims", family.agents))
    if kind == "synthesis":
        return _synthesis(top)
    design = read_design(top["design"], "$.design")
    values = read_values(top["values"], "$.values", design.agents)
    return Document(design, values, _claims(top["claims"], "$.claims", design))


def _switched(top: dict[str, object], of_region: bool) -> Document:
    design = read_switched(top["design"], "$.design", of_region)
    if of_region:
        fields(top["values"], "$.values", ())
        return Document(design, (), read_switched_conditions(top["claims"], "$.claims", design))
    values = read_switched_values(top["values"], "$.values", design.agents)
    return Document(design, values, read_switched_claims(top["claims"], "$.claims", design))


def _large(top: dict[str, object]) -> Document:
    design = read_large_design(top["design"], "$.design")
    spectrum = read_spectrum(top.get("spectrum", {}), "$.spectrum", design.agents)
    values = read_large_values(top["values"], "$.values")
    return Document(design, values, read_large_claims(top["claims"], "$.claims", design.agents), None, spectrum)


def _synthesis(top: dict[str, object]) -> Document:
    """A certificate of a synthesis: what is said of the design that was found, and of the task."""
    design = read_family(top["design"], "$.design")
    task = read_task(top["task"], "$.task", design.agents)
    if design.mu is None and (design.gamma is None or design.h is None):
        fields(top["values"], "$.values", ())
        array(top["claims"], "$.claims", "an empty array, as the design has no mu", 0)
        return Document(design, (), (), task)
    claims = _claims(top["claims"], "$.claims", design) if top["claims"] != [] else ()
    return Document(design, read_values(top["values"], "$.values", design.agents), claims, task)


def _literal(value: object, path: str, text: str) -> None:
    if value != text:
        raise expected(path, f'"{text}"', value)


def _claims(value: object, path: str, design: Design | UncertainDesign) -> tuple[Claim, ...]:
    def read(name: str, verdict: str, witness: object, here: str) -> MemberWitness:
        if isinstance(design, UncertainDesign):
            return read_member_witness(name, verdict, witness, here, design)
        return read_witness(name, verdict, witness, here, design.agents)

    return tuple(Claim(*claim) for claim in read_claims(value, path, read))
