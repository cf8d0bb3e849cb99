"""The canonical JSON of a certificate. Format: docs/certificate-format.md, sections 1 to 4."""

from __future__ import annotations

import json
from collections.abc import Mapping
from fractions import Fraction
from typing import Any

from fomas_verify.claims.registry import CLAIMS
from fomas_verify.claims.verdict import Decision
from fomas_verify.design import Design, SwitchedDesign, UncertainDesign
from fomas_verify.design.model import Given
from fomas_verify.exact.rational import format_rational

FORMAT = "fomas-certificate/1"
TOOL = "fomas_verify"


def certificate_text(
    design: Design | UncertainDesign,
    values: Mapping[str, Mapping[str, Any]],
    decisions: Mapping[str, Decision],
    version: str,
) -> str:
    """The certificate of a design, the same bytes on every machine for the same design, options and version."""
    document = {
        "format": FORMAT,
        "kind": "design",
        "design": design_object(design),
        "values": plain(values),
        "claims": claim_entries(decisions),
        "tool": {"name": TOOL, "version": version},
    }
    return dump(document) + "\n"


def claim_entries(decisions: Mapping[str, Decision]) -> list[dict[str, Any]]:
    """What is claimed of a design, in the order of the claims."""
    return [
        {
            "id": claim.ID,
            "verdict": decisions[claim.ID].verdict.value,
            "statement": claim.STATEMENT,
            "witness": plain(decisions[claim.ID].witness),
        }
        for claim in CLAIMS
        if claim.ID in decisions
    ]


def design_object(named: Design | UncertainDesign | SwitchedDesign) -> dict[str, Any]:
    """The design as the certificate names it: what the statements are about, without name, file or options."""
    if isinstance(named, SwitchedDesign):
        return _switched_object(named)
    design, ranges = (named.least, named.ranges) if isinstance(named, UncertainDesign) else (named, {})
    graph = design.graph
    parts: dict[str, Any] = {"alpha": design.alpha, "gamma": design.gamma, "mu": design.mu, "h": design.h}
    parts |= {"agents": graph.agents, "edges": [[*edge] for edge in sorted(graph.edges)], "x0": state_entry(design)}
    parts |= {"require": list(design.require)}
    parts |= {key: [x.lower, x.upper] for key, x in ranges.items()}
    return {key: plain(value) for key, value in parts.items() if value is not None}


def _switched_object(named: SwitchedDesign) -> dict[str, Any]:
    """The digraphs in place of the edges, and mu perhaps an interval."""
    edges = [[[*edge] for edge in sorted(graph.edges)] for graph in named.graphs]
    mu = None if named.mu is None else named.mu.lower if named.mu.is_exact else [*named.mu.ends]
    found = {"graphs" if key == "edges" else key: part for key, part in design_object(named.first).items()}
    return found | {"graphs": plain(edges)} | ({} if mu is None else {"mu": plain(mu)})


def state_entry(design: Given) -> list[Any] | None:
    """x_0: a number for each agent, or a list where it has several."""
    if design.x0 is None:
        return None
    return [row[0] if len(row) == 1 else [*row] for row in design.x0]


def plain(value: Any) -> Any:
    """The value in JSON's types: fractions as ``p/q`` in strings."""
    if isinstance(value, Fraction):
        return format_rational(value)
    if isinstance(value, Mapping):
        return {key: plain(part) for key, part in value.items()}
    if isinstance(value, list | tuple):
        return [plain(part) for part in value]
    return value


def dump(value: Any, indent: str = "") -> str:
    """JSON with two-space indent and each array of numbers and strings on a line of its own."""
    inner = indent + "  "
    if isinstance(value, dict) and value:
        lines = [f"{inner}{json.dumps(key)}: {dump(part, inner)}" for key, part in value.items()]
        return "{\n" + ",\n".join(lines) + "\n" + indent + "}"
    if isinstance(value, list) and any(isinstance(part, dict | list) for part in value):
        return "[\n" + ",\n".join(inner + dump(part, inner) for part in value) + "\n" + indent + "]"
    return json.dumps(value)
