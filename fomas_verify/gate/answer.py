"""One certificate: what the checker says of it, whether it is about a design, and whether it proves what is required.

Imports the checker alone, so that checking starts at once; the design's rooms only where a design is named.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict, dataclass
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from fomas_verify.checker import Malformed, Report, beside, check
from fomas_verify.exact.errors import FomasError, source_name

if TYPE_CHECKING:
    from fomas_verify.checker.edge_list import Opener
    from fomas_verify.checker.large import Numeric
    from fomas_verify.checker.report import Shortfall
    from fomas_verify.design import AnyDesign, Design, LargeDesign

OWN: Final = "design"
"""Stands among required claims for those that the certificate's design itself requires."""

LARGEST: Final = 64 << 20
FALSE, UNDECIDED = 1, 3
ENDINGS = {0: "Accepted.", FALSE: "Refused.", UNDECIDED: "Not decided within the work allowed."}


class CertificateError(FomasError):
    """The file cannot be read as a certificate."""


def read_certificate(path: Path) -> bytes:
    """The file's bytes; raises `CertificateError` where it cannot be read."""
    try:
        with path.open("rb") as file:
            return file.read(LARGEST + 1)
    except OSError as error:
        raise CertificateError(f"{source_name(path)}: expected a certificate, got {error.strerror}") from None


def answer_to(
    certificate: bytes,
    name: str,
    meant: AnyDesign | None,
    require: tuple[str, ...],
    path: Path | None = None,
    numeric: Numeric | None = None,
    edge_list: bytes | None = None,
) -> Answer:
    """Check a certificate, which messages call `name`; raises `CertificateError` where it is none.

    A large network's edge list is the one given, or lies beside `path`; `numeric` redoes what takes a sparse factor.
    """
    try:
        report = check(certificate, opener=_opener(path, edge_list), numeric=numeric)
    except Malformed as error:
        raise CertificateError(f"{name}: {error}") from None
    return Answer(report, meant, tuple(dict.fromkeys(_expanded(require, report))))


def _opener(path: Path | None, edge_list: bytes | None) -> Opener | None:
    if edge_list is not None:
        return held(edge_list)
    return None if path is None else beside(path)


def held(edge_list: bytes) -> Opener:
    """What opens an edge list that is in memory, whatever its name."""
    return lambda _: BytesIO(edge_list)


def _expanded(require: tuple[str, ...], report: Report) -> Iterator[str]:
    for name in require:
        yield from report.design.require if name == OWN else (name,)


@dataclass(frozen=True)
class Answer:
    """The checker's report, the design that the certificate must be about, and the claims that must be proved."""

    report: Report
    meant: AnyDesign | None
    required: tuple[str, ...]

    @property
    def different(self) -> list[str]:
        """The keys in which the certificate's design is not the one meant."""
        return [] if self.meant is None else differences(self.report, self.meant)

    @property
    def shortfalls(self) -> tuple[Shortfall, ...]:
        """The required claims that are not proved."""
        return self.report.shortfalls(self.required)

    @property
    def status(self) -> int:
        """1 if anything is false, another design's or a required claim not true; else 3 if anything is undecided."""
        found = {self.report.exit_status, FALSE if self.different else 0, *(x.exit_status for x in self.shortfalls)}
        return FALSE if FALSE in found else UNDECIDED if UNDECIDED in found else 0

    def lines(self) -> Iterator[str]:
        """For a reader."""
        for outcome in self.report.outcomes:
            verdict = f" {outcome.verdict}" if outcome.verdict else ""
            yield f"{outcome.status:<10} {outcome.id}{verdict}: {outcome.reason}"
        if self.meant is not None and self.different:
            differ = f"{', '.join(self.different)} differ"
            yield f"refused    design: not the design of {_plain(self.meant).source}: {differ}"
        elif self.meant is not None:
            yield f"accepted   design: the design of {_plain(self.meant).source}"
        for shortfall in self.shortfalls:
            yield f"required   {shortfall.id}: {shortfall.reason}"
        if self.required and not self.shortfalls:
            yield f"required   all {len(self.required)} claims are proved"
        yield ENDINGS[self.status]

    def record(self) -> dict[str, object]:
        """For other programs."""
        return {
            "status": self.status,
            "outcomes": [asdict(outcome) for outcome in self.report.outcomes],
            "differences": None if self.meant is None else self.different,
            "required": list(self.required),
            "shortfalls": [asdict(shortfall) for shortfall in self.shortfalls],
        }


def differences(report: Report, meant: AnyDesign) -> list[str]:
    """The keys in which the certificate's design and the user's are not the same, as exact numbers and intervals."""
    from fomas_verify.design import SwitchedDesign, UncertainDesign

    named, design = report.design, _plain(meant)
    numbers = {"alpha": design.alpha, "gamma": design.gamma, "mu": design.mu, "h": design.h}
    ranges = meant.ranges if isinstance(meant, UncertainDesign) else {}
    if isinstance(meant, SwitchedDesign) and meant.mu is not None and not meant.mu.is_exact:
        ranges = {"mu": meant.mu}
    ours = numbers | {key: (x.lower, x.upper) for key, x in ranges.items()}
    pairs = {key: (getattr(named, key), number) for key, number in ours.items()} | {
        "agents": (named.agents, design.graph.agents),
        **_edges(named, meant),
        "x0": (named.x0, design.x0),
        "require": (set(named.require), set(design.require)),
    }
    if report.limits is not None:
        given, limits = report.limits, design.limits
        theirs = (given.h, given.gamma, given.u_max, given.within)
        pairs["limits"] = (theirs, (limits.h, limits.gamma, limits.u_max, limits.settle_within))
        if given.settle_to is not None and design.settle_to is not None:
            pairs["settle_to"] = (given.settle_to, design.settle_to)
    return [key for key, (theirs, ours) in pairs.items() if theirs != ours]


def _edges(named: Any, meant: AnyDesign) -> dict[str, tuple[object, object]]:
    """Whether the edges of both are the same, of several digraphs in their order; under the key of the user's."""
    from fomas_verify.checker.large_form import LargeDesign
    from fomas_verify.checker.switching_form import SwitchedDesign as Switched
    from fomas_verify.design import SwitchedDesign
    from fomas_verify.gate.same_graph import are_edges_of, is_graph_of

    if isinstance(named, LargeDesign):
        same = not isinstance(meant, SwitchedDesign) and is_graph_of(named, _plain(meant).graph)
        return {"graph": (same, True)}
    theirs = named.graphs if isinstance(named, Switched) else (named,)
    ours = meant.graphs if isinstance(meant, SwitchedDesign) else (_plain(meant).graph,)
    same = isinstance(named, Switched) == isinstance(meant, SwitchedDesign) and len(theirs) == len(ours)
    same = same and all(are_edges_of(a.edges, named.agents, b) for a, b in zip(theirs, ours, strict=True))
    return {"graphs" if isinstance(meant, SwitchedDesign) else "edges": (same, True)}


def _plain(meant: AnyDesign) -> Design | LargeDesign:
    from fomas_verify.design import plain

    return plain(meant)
