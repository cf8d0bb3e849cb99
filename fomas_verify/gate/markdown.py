"""The gate's answer as GitHub-flavoured Markdown, for a job summary or a pull-request comment."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Final

from fomas_verify.gate.lines import passed_words, summary
from fomas_verify.gate.model import Answer, Result

_SPECIAL: Final = re.compile(r"([\\`*_\[\]<>#|~&$])")


def markdown_text(answer: Answer) -> bytes:
    """The whole answer: what does not pass first, what passes folded away, what was skipped."""
    head, *skipped = summary(answer)
    missed = [result for result in answer.results if result.findings]
    passed = [result for result in answer.results if not result.findings]
    lines = [f"### verify-design gate: {head}", ""]
    if missed:
        lines += [
            "| answer | design | file | why |",
            "|---|---|---|---|",
            *(row for r in missed for row in _rows(r)),
            "",
        ]
    if passed:
        lines += [f"<details><summary>{len(passed)} pass</summary>", ""]
        lines += ["| design | file | |", "|---|---|---|"]
        lines += [f"| {_plain(r.name)} | {_plain(r.source)} | {passed_words(r)} |" for r in passed]
        lines += ["", "</details>", ""]
    lines += [f"* {_plain(line)}" for line in skipped]
    return ("\n".join(lines).rstrip() + "\n").encode(errors="replace")


def _rows(result: Result) -> Iterator[str]:
    for finding in result.findings:
        where = f"{result.source}:{finding.position.line}"
        yield f"| {result.word} | {_plain(result.name)} | {_plain(where)} | {_plain(finding.text)} |"


def _plain(text: str) -> str:
    """The text with nothing left that Markdown or HTML would read as more than text."""
    return _SPECIAL.sub(r"\\\1", " ".join(text.split())).replace("@", "@<!-- -->")
