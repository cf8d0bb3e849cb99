"""The gate's answer as SARIF 2.1.0: a result for each finding, at the line and column of the offending key.

Rules are the claims' ids and those of `RULES`; ids are never renamed or used again for something else.
"""

from __future__ import annotations

import hashlib
import json
import os
from pathlib import Path
from typing import Any, Final
from urllib.parse import quote

from fomas_verify.checker import STATEMENTS
from fomas_verify.gate.model import INTERNAL, RULES, Answer, Finding, Result, Skipped

SCHEMA: Final = "https://json.schemastore.org/sarif-2.1.0.json"
RULE_TEXTS: Final = {**STATEMENTS, **RULES}
_IDS: Final = tuple(RULE_TEXTS)


def sarif_json(answer: Answer) -> bytes:
    """The whole answer."""
    from importlib.metadata import version

    driver = {
        "name": "verify-design",
        "semanticVersion": version("fomas_verify"),
        "rules": [{"id": rule, "shortDescription": {"text": text}} for rule, text in RULE_TEXTS.items()],
    }
    run = {
        "tool": {"driver": driver},
        "columnKind": "unicodeCodePoints",
        "invocations": [
            {
                "executionSuccessful": answer.status != INTERNAL,
                "exitCode": answer.status,
                "toolExecutionNotifications": [_notification(entry) for entry in answer.skipped],
            }
        ],
        "results": [_result(result, finding) for result in answer.results for finding in result.findings],
    }
    return json.dumps({"$schema": SCHEMA, "version": "2.1.0", "runs": [run]}, indent=2).encode() + b"\n"


def _result(result: Result, finding: Finding) -> dict[str, Any]:
    uri = _uri(result.path)
    region = {"startLine": finding.position.line, "startColumn": finding.position.column}
    digest = hashlib.sha256(f"{uri}\n{finding.rule}".encode()).hexdigest()
    return {
        "ruleId": finding.rule,
        "ruleIndex": _IDS.index(finding.rule),
        "level": "error",
        "message": {"text": f"{result.name or result.source}: {finding.text}"},
        "locations": [{"physicalLocation": {"artifactLocation": {"uri": uri}, "region": region}}],
        "partialFingerprints": {"fileAndRule/v1": digest},
    }


def _notification(entry: Skipped) -> dict[str, Any]:
    return {"level": "note", "message": {"text": f"skipped: {entry.source}: {entry.reason}"}}


def _uri(path: str) -> str:
    """Relative to the current folder where the file lies below it, absolute otherwise."""
    relative = Path(os.path.relpath(path))
    if ".." in relative.parts:
        return Path(os.path.normpath(Path(path).absolute())).as_uri()
    return quote(os.fsencode(relative.as_posix()))
