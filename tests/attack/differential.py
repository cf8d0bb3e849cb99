"""Prover, checker and oracle on one design: what they disagree on.

The prover must give the oracle's verdict for each claim, values that hold the oracle's numbers within the widths
promised, the design it was given, and the exit status that the six required claims call for; its certificate must be
true and accepted.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

from mpmath import mp

from . import oracle
from .adapter import check_status, prove
from .form import Document, read
from .handmade import INFORMATION
from .margin_faults import margin_faults
from .model import Design, Start, Uncertain, assumption_1
from .sizes import SIZES, peak, radius, settling, size_holds
from .truth import GRAPH_VALUES, bound_holds, judge

WIDTHS = {"mu": 30, "beta": 30, "threshold": 30, "lambda2": 30, "sigma": 12}
REQUIRED = tuple(claim for claim in oracle.CLAIMS if claim not in INFORMATION)


@dataclass(frozen=True)
class Comparison:
    """What was wrong on one design, and how many of its claims were left undecided."""

    name: str
    design: Design | Uncertain
    faults: tuple[str, ...]
    undecided: int
    certificate: bytes
    verdicts: tuple[tuple[str, str], ...] = ()


def verdict_faults(document: Document, expected: Callable[[str], str | None], names: set[str]) -> tuple[list[str], int]:
    """Claims that are not those of the contract, or not decided as the oracle does; how many are undecided."""
    given = {claim.id: claim.verdict for claim in document.claims}
    faults = [f"{claim}: present or absent against the contract" for claim in names ^ given.keys()]
    undecided = 0
    for claim, word in given.items():
        truth = expected(claim)
        if word == "undecided":
            undecided += 1
        elif truth is not None and word != truth:
            faults.append(f"{claim}: prover {word}, oracle {truth}")
    return faults, undecided


def _value_faults(document: Document, design: Design) -> list[str]:
    expected = {"mu", "threshold", "degree_max"} | (set(GRAPH_VALUES) if assumption_1(design) else set())
    given = document.values.keys() - {*SIZES, "margins"}
    faults = [f"{key}: present or absent against the contract" for key in expected ^ given]
    for key, entry in document.values.items():
        if key == "margins":
            faults += margin_faults(design, entry)
            continue
        if key in SIZES:
            faults += _size_faults(design, key, entry)
            continue
        lower, upper = entry["lower"], entry["upper"]
        if key in GRAPH_VALUES and not assumption_1(design):
            continue
        if bound_holds(design, key, lower, False) is False or bound_holds(design, key, upper, True) is False:
            faults.append(f"{key}: the oracle's number lies outside")
        if upper - lower >= Fraction(1, 10 ** WIDTHS.get(key, 400)) and upper != lower:
            faults.append(f"{key}: wider than 1e-{WIDTHS.get(key)}")
    return faults


def _size_faults(design: Design, key: str, entry: dict[str, Any]) -> list[str]:
    """A size that does not exist, does not hold the oracle's number, or says less than it should."""
    if size_holds(design, key, entry) is False:
        return [f"{key}: {entry} is false"]
    if key == "rate":
        with mp.workdps(60 + oracle.scale(design)):
            room = 1 - oracle.real(entry["rho"]) - mp.mpf(99) / 100 * (1 - radius(design))
            return [] if room >= 0 else [f"rate: rho {entry['rho']} is {mp.nstr(-room, 5)} too large"]
    if key.startswith("settling") and settling(design, entry["settle_to"]) is None:
        return []
    wide = {"peak_control": Fraction(1, 10**12), "actuator_reach": entry.get("upper", 0) / 10**12}.get(key, Fraction(0))
    if key in ("peak_control", "actuator_reach") and not peak(design).closed:
        return []
    return [] if entry["upper"] - entry["lower"] <= wide else [f"{key}: wider than {float(wide)}"]


def _status_fault(document: Document, status: int) -> list[str]:
    words = {claim.verdict for claim in document.claims if claim.id in REQUIRED}
    expected = 1 if words & {"refuted", "inapplicable"} else 3 if "undecided" in words else 0
    return [] if status == expected else [f"prove exited {status}, expected {expected}"]


def plain(x0: Start | None) -> Start | None:
    """x_0 as plain numbers where every agent has one state."""
    if x0 is None or any(not isinstance(entry, tuple) or len(entry) != 1 for entry in x0):
        return x0
    return tuple(entry[0] for entry in x0 if isinstance(entry, tuple))


def compare(name: str, design: Design) -> Comparison:
    """Run one design through prover, checker and oracle."""
    return compared(name, design, oracle.verdict, _value_faults)


def compared(
    name: str,
    source: Any,
    verdict: Callable[[Any, str], str | None],
    further: Callable[[Document, Any], list[str]],
) -> Comparison:
    """The faults of prover and checker on a design, given the oracle's verdicts and what else to hold against it.

    A certificate writes states of one number each as plain numbers.
    """
    proof, design = prove(source.mapping(name)), replace(source, x0=plain(source.x0))
    if not proof.certificate:
        return Comparison(name, design, (f"prove exited {proof.status}: {proof.errors.strip()}",), 0, b"")
    document = read(proof.certificate)
    names = {claim for claim in oracle.CLAIMS if claim != "trajectory-norm-bound" or design.x0 is not None}
    faults, undecided = verdict_faults(document, lambda claim: verdict(design, claim), names)
    faults += further(document, design) + _status_fault(document, proof.status)
    if document.design != design:
        faults.append(f"the certificate is about another design: {document.design}")
    verdicts = tuple((claim.id, claim.verdict) for claim in document.claims)
    judgement = judge(proof.certificate)
    if judgement.word not in ("true", "unknown"):
        faults.append(f"the certificate is {judgement.word}: {judgement.reason}")
    if (status := check_status(proof.certificate)) != 0:
        faults.append(f"check exited {status}")
    return Comparison(name, design, tuple(faults), undecided, proof.certificate, verdicts)
