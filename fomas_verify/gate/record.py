"""The gate's answer for programs: JSON, and the lines that GitHub turns into annotations."""

from __future__ import annotations

import json
from collections.abc import Iterator

from fomas_verify.gate.model import Answer, Finding, Result


def gate_json(answer: Answer) -> str:
    """The whole answer as one JSON object."""
    document = {
        "status": answer.status,
        "designs": [_design(result) for result in answer.results],
        "skipped": [{"file": entry.source, "reason": entry.reason} for entry in answer.skipped],
        "unmatched_baselines": list(answer.unmatched),
    }
    return json.dumps(document, indent=2) + "\n"


def _design(result: Result) -> dict[str, object]:
    return {
        "file": result.source,
        "name": result.name,
        "status": result.status,
        "answer": result.word,
        "required": list(result.required),
        "note": result.note,
        "findings": [_finding(finding) for finding in result.findings],
    }


def _finding(finding: Finding) -> dict[str, object]:
    return {
        "rule": finding.rule,
        "outcome": finding.outcome,
        "status": finding.status,
        "reason": finding.reason,
        "remedy": finding.advice,
        "line": finding.position.line,
        "column": finding.position.column,
    }


def annotation_lines(answer: Answer) -> Iterator[str]:
    """GitHub's workflow commands: an error at its line for each finding."""
    for result in answer.results:
        for finding in result.findings:
            properties = {
                "file": result.source,
                "line": str(finding.position.line),
                "col": str(finding.position.column),
                "title": f"{result.name or result.source}: {finding.rule}",
            }
            listed = ",".join(f"{key}={_property(value)}" for key, value in properties.items())
            yield f"::error {listed}::{_data(finding.text)}"


def _data(text: str) -> str:
    return text.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A")


def _property(text: str) -> str:
    return _data(text).replace(":", "%3A").replace(",", "%2C")
