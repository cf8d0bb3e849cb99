"""The canonical JSON of a region's certificate. Format: docs/certificate-format.md, section 8."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from fomas_verify.certificate.document import FORMAT, TOOL, design_object, dump, plain
from fomas_verify.design import Design


def region_certificate_text(design: Design, claims: Iterable[Mapping[str, Any]], version: str) -> str:
    """The certificate that these conditions hold for some mu, or for none; the same bytes on every machine."""
    document = {
        "format": FORMAT,
        "kind": "region",
        "design": design_object(design),
        "values": {},
        "claims": [plain(claim) for claim in claims],
        "tool": {"name": TOOL, "version": version},
    }
    return dump(document) + "\n"
