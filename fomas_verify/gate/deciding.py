"""One design: read, decided, its certificate checked, and compared with a baseline.

A design passes only if the checker, in this run, accepted a certificate of it in which every required claim is proved.
Whatever goes wrong with one design is an answer about that design and keeps no other from its own.
"""

from __future__ import annotations

import json
import os
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from pathlib import Path
from typing import Final

from fomas_verify.certificate.document import design_object
from fomas_verify.checker import Malformed, Report, check
from fomas_verify.checker.large import Numeric
from fomas_verify.claims.verdict import Decision
from fomas_verify.design import (
    SWITCHED_CLAIM_IDS,
    AnyDesign,
    DesignError,
    LargeDesign,
    SwitchedDesign,
    UncertainDesign,
    plain,
    read_named,
)
from fomas_verify.design.document import format_of, read_text
from fomas_verify.exact.errors import FomasError, source_name
from fomas_verify.exact.memory import raise_beyond_memory
from fomas_verify.gate.answer import differences, held
from fomas_verify.gate.baseline import shrunk_margins
from fomas_verify.gate.cache import cache_key, certificate_file, recall
from fomas_verify.gate.model import (
    BROKEN,
    INTERNAL,
    LIMIT,
    NEW,
    UNDECIDED,
    UNREADABLE,
    WRONG_INPUT,
    Finding,
    Position,
    Result,
)
from fomas_verify.gate.positions import position_of, position_of_error
from fomas_verify.prover import prove, prove_large, prove_uncertain

OWN: Final = "design"
"""Stands among required claims for those that the design itself requires."""

_ABOUT_THE_GRAPH = ("graph-assumption", "beta-contraction")


class DisagreementError(FomasError):
    """The checker does not accept what the prover wrote: two computations that must agree do not."""

    exit_status = INTERNAL


@dataclass(frozen=True)
class Options:
    """How every design is decided.

    Attributes
    ----------
    require : tuple of str
        Claim ids that must be proved, in place of the design's own; `design` stands for these.
    margins : bool
        Whether the certificates are to hold every claim, size and margin, not only what is required.
    cache : Path or None
        A folder of former certificates.
    baseline : Path or None
        A folder with a certificate for each design, named after it.
    loss : Fraction
        The share of a baseline's margin that may be lost.
    new_ok : bool
        Whether a design passes of which the baseline holds no certificate.
    allow_outside : bool
        Whether a graph file may lie outside the folder of its design.
    numeric : Numeric or None
        What redoes bounds of a large graph that take a factor; without it they stay undecided.
    """

    require: tuple[str, ...] = (OWN,)
    margins: bool = False
    cache: Path | None = None
    baseline: Path | None = None
    loss: Fraction = Fraction(0)
    new_ok: bool = False
    allow_outside: bool = False
    numeric: Numeric | None = None


def decide(path: Path, options: Options) -> Result:
    """Decide one design.

    Parameters
    ----------
    path : Path
        The design's file.
    options : Options
        How.

    Returns
    -------
    Result
        Rigorous. Every error is told in it; nothing is raised but what interrupts or ends the program, as memory
        beyond what is allowed does.
    """
    source = source_name(path)
    answer = Result(source, str(path))
    try:
        named = _requiring(read_named(path, allow_outside=options.allow_outside), options.require)
        design = plain(named)
        answer = replace(answer, name=design.name, required=design.require, note="; ".join(design.notes))
        return _decided(named, answer, options)
    except FomasError as error:
        raise_beyond_memory(error)
        message, status = str(error), error.exit_status
        rule = {INTERNAL: BROKEN, UNDECIDED: LIMIT}.get(status, UNREADABLE)
        place = refusal_position(path, message) if rule == UNREADABLE else Position()
        finding = Finding(rule, "", status, message.removeprefix(f"{source}: "), "", place)
        return replace(answer, required=(), findings=(finding,))
    except Exception as error:
        raise_beyond_memory(error)
        words = " ".join(f"{type(error).__name__}: {error}".split())
        return replace(answer, required=(), findings=(Finding(BROKEN, "", INTERNAL, words),))


def _requiring(named: AnyDesign, require: tuple[str, ...]) -> AnyDesign:
    design = plain(named)
    names = dict.fromkeys(name for word in require for name in (design.require if word == OWN else (word,)))
    if "trajectory-norm-bound" in names:
        design.needs("x0", command="trajectory-norm-bound")
    wanted = tuple(names)
    if isinstance(named, SwitchedDesign):
        for name in names:
            if name not in SWITCHED_CLAIM_IDS:
                raise DesignError(f"{design.source}: graphs: {name} is no claim about [[graphs]]")
        return replace(named, first=replace(named.first, require=wanted))
    if isinstance(named, UncertainDesign):
        return replace(named, least=replace(named.least, require=wanted))
    return replace(named, require=wanted)


def _decided(named: AnyDesign, answer: Result, options: Options) -> Result:
    former = ""
    if options.cache is not None:
        answer = replace(answer, key=cache_key(named, plain(named).horizon, margins=options.margins))
        former = recall(options.cache, answer.key)
    if former and _proves_all(former, named, answer.required, options.numeric):
        answer = replace(answer, certificate=former, cached=True)
        findings: list[Finding] = []
    else:
        text, decisions, note = _proved(named, options)
        answer = replace(answer, certificate=text, note="; ".join(filter(None, (note, answer.note))))
        findings = list(_findings(_checked(text, named, options.numeric), answer.required, decisions))
    if options.margins and isinstance(named, LargeDesign) and named.graph.known_family is None:
        answer = replace(answer, edge_list=named.graph.edge_list)
    if options.baseline is not None:
        former_file = certificate_file(options.baseline, answer.name)
        if os.path.lexists(former_file):
            findings += shrunk_margins(former_file, answer.required, answer.certificate, options.loss, options.numeric)
        elif options.new_ok:
            answer = replace(answer, note="; ".join(filter(None, ("new: no baseline", answer.note))))
        else:
            reason = f"no certificate of {answer.name!r} in the baseline: a new design needs --new-ok, or {former_file}"
            findings.append(Finding(NEW, "", WRONG_INPUT, reason))
    return replace(answer, findings=tuple(_placed(Path(answer.path), named, findings)))


def _proved(named: AnyDesign, options: Options) -> tuple[str, Mapping[str, Decision], str]:
    """The certificate, the decisions, and what else must be known."""
    only = None if options.margins else plain(named).require
    if isinstance(named, LargeDesign):
        large = prove_large(named, only=only)
        return large.certificate(certificate_file(Path(), named.name).name), large.decisions, "; ".join(large.notes)
    if isinstance(named, UncertainDesign):
        uncertain = prove_uncertain(named)
        return uncertain.certificate(), uncertain.decisions, ""
    if isinstance(named, SwitchedDesign):
        from fomas_verify.region.switching import prove_switched

        switched = prove_switched(named)
        return switched.certificate(), switched.decisions, ""
    proof = prove(named, only=only)
    return proof.certificate(), proof.decisions, ""


def _proves_all(certificate: str, named: AnyDesign, required: tuple[str, ...], numeric: Numeric | None) -> bool:
    """Whether a former certificate is about this design, true, and proves what is required; checked anew."""
    try:
        report = _checked(certificate, named, numeric)
    except DisagreementError:
        return False
    return report.exit_status == 0 and not report.shortfalls(required)


def _checked(certificate: str, named: AnyDesign, numeric: Numeric | None) -> Report:
    """The checker's report; the edge list of a large graph is that of the design, whatever lies in a folder."""
    large = isinstance(named, LargeDesign) and named.graph.known_family is None
    opener = held(named.graph.edge_list) if isinstance(named, LargeDesign) and large else None
    try:
        report = check(certificate.encode(), opener=opener, numeric=numeric)
    except Malformed as error:
        raise DisagreementError(f"the checker cannot read the certificate: {error}") from None
    for outcome in report.outcomes:
        if outcome.status == "refused":
            raise DisagreementError(f"the checker refuses the certificate: {outcome.id}: {outcome.reason}")
    if not _is_about(json.loads(certificate)["design"], named, report):
        raise DisagreementError("the certificate is about another design")
    return report


def _is_about(design: object, named: AnyDesign, report: Report) -> bool:
    return not differences(report, named) if isinstance(named, LargeDesign) else design == design_object(named)


def _findings(report: Report, required: tuple[str, ...], decisions: Mapping[str, Decision]) -> Iterator[Finding]:
    shortfalls = report.shortfalls(required)
    for shortfall in shortfalls:
        decision = decisions[shortfall.id]
        yield Finding(shortfall.id, shortfall.reason, shortfall.exit_status, decision.reason, decision.remedy)
    told = {shortfall.id for shortfall in shortfalls}
    for outcome in report.outcomes:
        if outcome.status == "undecided" and outcome.id not in told:
            yield Finding(LIMIT, "undecided", UNDECIDED, f"{outcome.id}: {outcome.reason}")


def _placed(path: Path, named: AnyDesign, findings: list[Finding]) -> Iterator[Finding]:
    """Each finding at the key to change: the graph, the gain, or the name."""
    if not findings:
        return
    text = _text(path)
    gain = "mu" if plain(named).mu is not None else "gamma"
    graphs = "graphs" if isinstance(named, SwitchedDesign) else "graph"
    for finding in findings:
        graph = finding.rule in _ABOUT_THE_GRAPH or finding.outcome == "inapplicable"
        key = "name" if finding.rule == NEW else graphs if graph else gain
        yield replace(finding, position=position_of(text, format_of(path, text), (key,)))


def refusal_position(path: Path, message: str) -> Position:
    """Where in a design's file the refusal of it points."""
    text = _text(path)
    return position_of_error(message, source_name(path), text, format_of(path, text))


def _text(path: Path) -> str:
    try:
        return read_text(path)
    except DesignError:
        return ""
