"""The gate's answer for people: a line for each design, and the summary."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Final

from fomas_verify.gate.model import WORDS, Answer, Result, Skipped

_NAMED: Final = 3
_WIDTH: Final = max(map(len, WORDS.values()))


def result_line(result: Result) -> str:
    """The answer about one design."""
    words = "; ".join(finding.text for finding in result.findings) or passed_words(result)
    note = f" ({result.note})" if result.note else ""
    return f"{result.word:<{_WIDTH}}  {result.source}: {words}{note}"


def passed_words(result: Result) -> str:
    """What is proved of a design that passes."""
    count = len(result.required)
    return f"{count} required claim{' is' if count == 1 else 's are'} proved and checked"


def summary(answer: Answer) -> Iterator[str]:
    """How many designs got which answer, and what was skipped and why."""
    counts = ", ".join(f"{answer.count(word)} {word}" for word in WORDS.values() if answer.count(word))
    total = len(answer.results)
    yield f"{total} design{'' if total == 1 else 's'}: {counts}" if total else "no design found"
    for reason, names in by_reason(answer.skipped).items():
        yield f"skipped: {_first(names)}: {reason}"
    noted: dict[str, list[str]] = {}
    for result in answer.results:
        if result.note:
            noted.setdefault(result.note, []).append(result.name)
    yield from (f"{note}: {_first(names)}" for note, names in noted.items())
    if answer.unmatched:
        yield f"baseline of no design here: {_first(answer.unmatched)}"


def _first(names: Sequence[str]) -> str:
    """The first few of them, and how many more there are."""
    more = f" and {len(names) - _NAMED} more" if len(names) > _NAMED else ""
    return f"{', '.join(names[:_NAMED])}{more}"


def by_reason(skipped: tuple[Skipped, ...]) -> dict[str, list[str]]:
    """The names of what was skipped, by the reason why."""
    groups: dict[str, list[str]] = {}
    for entry in skipped:
        groups.setdefault(entry.reason, []).append(entry.source)
    return groups
