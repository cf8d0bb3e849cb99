"""The canonical JSON of certificates about graphs to switch among. Format: docs/certificate-format.md, section 10."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from fomas_verify.certificate.document import FORMAT, TOOL, design_object, dump, plain
from fomas_verify.claims.verdict import Decision
from fomas_verify.design import SwitchedDesign

STATEMENTS: Mapping[str, str] = {
    "graph-assumption": "every digraph of the set is strongly connected and balanced (Assumption 1)",
    "gain-bound": "0 < mu < 1/Delta_max for every digraph of the set (gain bound (15) [eqh])",
    "control-bounded": (
        "for every x_0 and every switching among the digraphs of the set and their convex combinations, "
        "norm u_k is bounded over k and u_k tends to 0"
    ),
    "average-consensus": (
        "for every x_0, every i and every switching among the digraphs of the set and their convex combinations, "
        "x_i(t) tends to the mean of x_0 as t tends to infinity"
    ),
}
CONDITIONS: Mapping[str, str] = {
    "gain-bound": "some mu > 0 satisfies mu < 1/Delta_max for every digraph of the set",
    "common-form": (
        "for some mu > 0 one quadratic form decreases under every digraph of the set, "
        "so that the agents agree on the mean of x_0 under every switching, under Assumption 1"
    ),
}


def switched_text(
    design: SwitchedDesign, values: Mapping[str, Any], decisions: Mapping[str, Decision], version: str
) -> str:
    """The certificate of a design; the same bytes on every machine where no solver is named in it."""
    claims = [
        {
            "id": name,
            "verdict": decision.verdict.value,
            "statement": STATEMENTS[name],
            "witness": plain(decision.witness),
        }
        for name, decision in decisions.items()
    ]
    return _text("design", design, plain(values), claims, version)


def switched_region_text(design: SwitchedDesign, claims: Iterable[Mapping[str, Any]], version: str) -> str:
    """The certificate of a region; as above."""
    return _text("region", design, {}, [plain(claim) for claim in claims], version)


def _text(kind: str, design: SwitchedDesign, values: Any, claims: list[Any], version: str) -> str:
    document = {
        "format": FORMAT,
        "kind": kind,
        "design": design_object(design),
        "values": values,
        "claims": claims,
        "tool": {"name": TOOL, "version": version},
    }
    return dump(document) + "\n"
