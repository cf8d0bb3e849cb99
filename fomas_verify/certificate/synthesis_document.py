"""The canonical JSON of a synthesis' certificate. Format: docs/certificate-format.md, section 9."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from fomas_verify.certificate.document import FORMAT, TOOL, claim_entries, design_object, dump, plain
from fomas_verify.claims.verdict import Decision
from fomas_verify.design import Design


def synthesis_certificate_text(
    design: Design,
    task: Mapping[str, Any],
    values: Mapping[str, Any],
    decisions: Mapping[str, Decision],
    version: str,
) -> str:
    """The certificate of a task and of the design that was found for it, without values and claims where none was."""
    document = {
        "format": FORMAT,
        "kind": "synthesis",
        "design": design_object(design),
        "values": plain(values),
        "claims": claim_entries(decisions),
        "tool": {"name": TOOL, "version": version},
        "task": plain(task),
    }
    return dump(document) + "\n"
