"""Certificates of former runs, each under a digest of what it depends on: design, options and version.

A certificate from here is checked like a new one: a digest proves nothing.
"""

from __future__ import annotations

import hashlib
import json
from pathlib import Path
from typing import Any, Final
from urllib.parse import quote

from fomas_verify.certificate.document import FORMAT, design_object
from fomas_verify.certificate.large_document import graph_entry, large_design_object
from fomas_verify.design import AnyDesign, LargeDesign

LARGEST: Final = 64 * 2**20
_LONGEST_NAME: Final = 200


def cache_key(design: AnyDesign, horizon: int | None, *, margins: bool) -> str:
    """What the certificate of a design depends on, in 64 hexadecimal digits."""
    from importlib.metadata import version

    parts = {
        "format": FORMAT,
        "version": version("fomas_verify"),
        "design": _described(design),
        "horizon": horizon,
        "margins": margins,
    }
    return hashlib.sha256(json.dumps(parts, sort_keys=True).encode()).hexdigest()


def _described(design: AnyDesign) -> dict[str, Any]:
    if not isinstance(design, LargeDesign):
        return design_object(design)
    return large_design_object(design, graph_entry(design.graph, ""))


def cache_file(folder: Path, key: str) -> Path:
    """Where a cache keeps the certificate with this key."""
    return folder / f"{key}.json"


def certificate_file(folder: Path, name: str) -> Path:
    """Where a folder of certificates keeps that of the design with this name."""
    quoted = quote(name, safe=" ")
    if len(quoted) > _LONGEST_NAME:
        quoted = f"{quoted[: _LONGEST_NAME - 17]}-{hashlib.sha256(name.encode()).hexdigest()[:16]}"
    return folder / f"{quoted}.json"


def recall(folder: Path, key: str) -> str:
    """The text kept under a key; empty where there is none that can be read."""
    try:
        with cache_file(folder, key).open("rb") as file:
            return file.read(LARGEST).decode()
    except (OSError, UnicodeDecodeError):
        return ""
