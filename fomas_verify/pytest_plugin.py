"""pytest: ``@pytest.mark.design("plant.toml", require=[...])`` fails a test whose design the gate would not pass.

The path is relative to the test's own file; without `require` the design's own claims are required, and with
`allow_outside=True` its graph file may lie outside its folder.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

import pytest

MARKER: Final = (
    "design(path, require=None, allow_outside=False): the design at this path, relative to the test file, must pass "
    "`verify-design gate`; require: claim ids, in place of the design's own; allow_outside: its graph file may lie "
    "outside its folder"
)


def pytest_configure(config: pytest.Config) -> None:
    """Make the marker known."""
    config.addinivalue_line("markers", MARKER)


@pytest.hookimpl(tryfirst=True)
def pytest_runtest_call(item: pytest.Item) -> None:
    """Decide each design that marks the test, before the test itself runs."""
    lines = [line for mark in item.iter_markers("design") for line in _shortfalls(item, mark)]
    if lines:
        pytest.fail("\n".join(lines), pytrace=False)


def _shortfalls(item: pytest.Item, mark: pytest.Mark) -> Iterator[str]:
    from fomas_verify.gate.deciding import Options, decide
    from fomas_verify.gate.lines import result_line

    complaint = _complaint(mark)
    if complaint:
        yield f"pytest.mark.design: {complaint}"
        return
    required, outside = mark.kwargs.get("require"), mark.kwargs.get("allow_outside", False)
    claims = Options().require if required is None else tuple(dict.fromkeys(required))
    options = Options(require=claims, allow_outside=outside)
    result = decide(item.path.parent / mark.args[0], options)
    if result.findings:
        yield result_line(result)


def _complaint(mark: pytest.Mark) -> str:
    """What is wrong with the marker's arguments; empty where nothing is."""
    from fomas_verify.design.claim_ids import CLAIM_IDS
    from fomas_verify.gate.deciding import OWN

    required = mark.kwargs.get("require")
    if len(mark.args) != 1 or set(mark.kwargs) - {"require", "allow_outside"}:
        return "expected one path and perhaps require=[...] and allow_outside=True"
    if required is None:
        return ""
    if not isinstance(required, list | tuple) or not required:
        return f"require: expected a list of claim ids, got {required!r}"
    unknown = [name for name in required if name not in (*CLAIM_IDS, OWN)]
    return f"require: expected claim ids, got {unknown[0]!r}" if unknown else ""
