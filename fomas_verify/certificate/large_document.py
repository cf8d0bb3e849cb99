"""The certificate of a large design. Format: docs/certificate-format.md, section 11."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any, Final

from fomas_verify.certificate.document import FORMAT, TOOL, claim_entries, dump, plain, state_entry
from fomas_verify.claims.verdict import Decision
from fomas_verify.design import LargeDesign
from fomas_verify.network.large import LargeGraph

EDGES: Final = ".edges"
"""How the name of an edge list ends."""

_NAME = re.compile(r"[^./\\:\x00-\x1f\x7f][^/\\:\x00-\x1f\x7f]*")
_LONGEST = 128


def large_certificate_text(
    design: LargeDesign,
    graph: Mapping[str, Any],
    spectrum: Mapping[str, Any],
    values: Mapping[str, Mapping[str, Any]],
    decisions: Mapping[str, Decision],
    version: str,
) -> str:
    """The certificate; of a graph that is no family's its bytes may differ between machines, and `solver` says so."""
    document: dict[str, Any] = {
        "format": FORMAT,
        "kind": "design",
        "scale": "large",
        "design": large_design_object(design, graph),
        "spectrum": plain(spectrum),
        "values": plain(values),
        "claims": claim_entries(decisions),
        "tool": {"name": TOOL, "version": version},
    }
    if not spectrum:
        del document["spectrum"]
    return dump(document) + "\n"


def large_design_object(design: LargeDesign, graph: Mapping[str, Any]) -> dict[str, Any]:
    """The design as the certificate names it."""
    parts: dict[str, Any] = {"alpha": design.alpha, "gamma": design.gamma, "mu": design.mu, "h": design.h}
    parts |= {"agents": design.graph.agents, "graph": graph, "x0": state_entry(design), "require": list(design.require)}
    return {key: plain(value) for key, value in parts.items() if value is not None}


def graph_entry(graph: LargeGraph, certificate: str) -> dict[str, Any]:
    """The graph: a family's by its name, another by the edge list beside the certificate's file of this name."""
    family = graph.known_family
    if family is not None:
        return {"family": family.name} | ({} if family.shape is None else {"shape": list(family.shape)})
    return {"file": edge_list_name(certificate, graph.digest), "sha256": graph.digest, "edges": graph.edge_count}


def edge_list_name(certificate: str, digest: str) -> str:
    """The name of the edge list beside a certificate's file: that file's own and the digest, where that can be one.

    No other edge list has it, so that none is ever replaced, and a former certificate keeps its own.
    """
    stem = certificate.rpartition(".")[0] or certificate
    name = f"{stem}-{digest[:16]}{EDGES}"
    return name if _NAME.fullmatch(name) and len(name) <= _LONGEST else f"network-{digest[:16]}{EDGES}"
