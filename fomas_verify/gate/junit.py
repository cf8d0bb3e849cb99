"""The gate's answer as JUnit XML (the xunit2 form of Jenkins): a suite for each design, a case for each required claim.

The numbers stand in the failure's body, since some viewers drop attributes. No time and no host, so that the same
designs give the same bytes.
"""

from __future__ import annotations

import re
from typing import Final
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from fomas_verify.gate.model import FALSE, UNDECIDED, Answer, Finding, Result

_FAILURES: Final = (FALSE, UNDECIDED)
_ILLEGAL: Final = re.compile("[^\\t\\n\\x20-\\ud7ff\\ue000-\\ufffd\\U00010000-\\U0010ffff]")


def junit_xml(answer: Answer) -> bytes:
    """The whole answer."""
    root = Element("testsuites", name="verify-design gate")
    for result in answer.results:
        _suite(root, result)
    for entry in answer.skipped:
        suite = _counted(SubElement(root, "testsuite", name=_legal(entry.source)), tests=1, skipped=1)
        case = SubElement(suite, "testcase", classname=_legal(entry.source), name="design-file")
        SubElement(case, "skipped", message=_legal(entry.reason))
    indent(root)
    text: bytes = tostring(root, encoding="utf-8", xml_declaration=True)
    return text + b"\n"


def _suite(root: Element, result: Result) -> None:
    found: dict[str, list[Finding]] = {}
    for finding in result.findings:
        found.setdefault(finding.rule, []).append(finding)
    names = [*result.required, *(rule for rule in found if rule not in result.required)]
    failures = sum(name in found and found[name][0].status in _FAILURES for name in names)
    errors = sum(name in found for name in names) - failures
    suite = _counted(SubElement(root, "testsuite", name=_legal(result.source)), len(names), failures, errors)
    for name in names:
        case = SubElement(suite, "testcase", classname=_legal(result.name or result.source), name=name)
        if name in found:
            findings = found[name]
            kind = "failure" if findings[0].status in _FAILURES else "error"
            about = f"{name} {findings[0].outcome}".rstrip()
            body = SubElement(case, kind, type=findings[0].outcome or name, message=_legal(about))
            body.text = _legal("\n".join(f"{result.source}:{x.position.line}: {x.text}" for x in findings))


def _counted(suite: Element, tests: int, failures: int = 0, errors: int = 0, skipped: int = 0) -> Element:
    counts = {"tests": tests, "failures": failures, "errors": errors, "skipped": skipped}
    suite.attrib |= {name: str(count) for name, count in counts.items()}
    return suite


def _legal(text: str) -> str:
    """The text without the characters that XML 1.0 cannot hold."""
    return _ILLEGAL.sub("?", text)
