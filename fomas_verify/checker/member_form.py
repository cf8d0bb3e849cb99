"""The witnesses of claims about an uncertain design, as data: of one member, or of boxes that hold every member.

Source: docs/certificate-format.md, section 7.
"""

from dataclasses import dataclass
from fractions import Fraction

from fomas_verify.checker.designs import NUMBERS, Interval, UncertainDesign, read_order, read_positive
from fomas_verify.checker.text import array, expected, fields
from fomas_verify.checker.witness import Witness, read_witness

MAX_BOXES = 4096
BOXED = frozenset({"memory-inequality", "repaired-condition", "control-norm-bound", "trajectory-norm-bound"})


@dataclass(frozen=True)
class OfMember:
    """A member of the design, by its numbers, and the witness that refutes the claim for it."""

    numbers: tuple[tuple[str, Fraction], ...]
    witness: Witness


@dataclass(frozen=True)
class Part:
    """A box of alpha and mu, and the witness that proves the claim all over it."""

    alpha: Interval
    mu: Interval
    witness: Witness


@dataclass(frozen=True)
class OfBoxes:
    """Boxes that hold every member, in order."""

    boxes: tuple[Part, ...]


MemberWitness = Witness | OfMember | OfBoxes


def read_member_witness(claim: str, verdict: str, value: object, path: str, design: UncertainDesign) -> MemberWitness:
    """The witness of a claim about an uncertain design, its form checked; raises `Malformed`."""
    if claim == "graph-assumption" or verdict not in ("proved", "refuted"):
        return read_witness(claim, verdict, value, path, design.agents)
    if verdict == "refuted":
        return _of_member(claim, value, path, design)
    if claim not in BOXED:
        return read_witness(claim, verdict, value, path, design.agents)
    boxes = array(fields(value, path, ("boxes",))["boxes"], f"{path}.boxes", "an array of boxes")
    if not 1 <= len(boxes) <= MAX_BOXES:
        raise expected(f"{path}.boxes", f"from 1 to {MAX_BOXES} boxes", boxes)
    return OfBoxes(tuple(_part(claim, box, f"{path}.boxes[{i}]", design.agents) for i, box in enumerate(boxes)))


def _of_member(claim: str, value: object, path: str, design: UncertainDesign) -> OfMember:
    given = fields(value, path, ("member", "witness"))
    keys = tuple(key for key in NUMBERS if design.interval(key) is not None)
    here = f"{path}.member"
    member = fields(given["member"], here, keys)
    readers = [read_order if key == "alpha" else read_positive for key in keys]
    numbers = tuple((key, read(member[key], f"{here}.{key}")) for key, read in zip(keys, readers, strict=True))
    return OfMember(numbers, read_witness(claim, "refuted", given["witness"], f"{path}.witness", design.agents))


def _part(claim: str, value: object, path: str, agents: int) -> Part:
    given = fields(value, path, ("alpha", "mu", "witness"))
    ends = array(given["alpha"], f"{path}.alpha", "an array of two rationals", 2)
    a, b = (read_order(end, f"{path}.alpha[{i}]") for i, end in enumerate(ends))
    ends = array(given["mu"], f"{path}.mu", "an array of two rationals", 2)
    c, d = (read_positive(end, f"{path}.mu[{i}]") for i, end in enumerate(ends))
    return Part((a, b), (c, d), read_witness(claim, "proved", given["witness"], f"{path}.witness", agents))
