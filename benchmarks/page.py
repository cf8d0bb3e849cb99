"""What was measured as a page: docs/benchmarks.md."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from benchmarks.measure import Cost
from benchmarks.model import MEMORY, SECONDS, Power, Series
from benchmarks.topics import Topic

Row = Sequence[str]

FAR = 100
"""So many times the largest size measured is as far as a model is followed."""


@dataclass(frozen=True)
class Results:
    """All that was measured: ``start`` by words, ``checked`` by agents as (prove, check), ``goals`` as lines."""

    machine: Sequence[str]
    topics: Sequence[tuple[Topic, Sequence[Series]]]
    start: dict[str, Cost]
    checked: dict[int, tuple[Cost, Cost]]
    missing: Sequence[str]
    goals: Sequence[str]


def page(found: Results, chart: str) -> str:
    """The page in Markdown."""
    return "\n".join(_lines(found, chart)) + "\n"


def _lines(found: Results, chart: str) -> Iterator[str]:
    yield "# Benchmarks"
    yield ""
    yield (
        "Everything on this page was measured in one run of `make bench` (`python -m benchmarks`), each line in "
        "processes of its own, one thread each. Times are CPU seconds without imports, medians; memory is the peak of "
        "the process. What is proved stands in a method's words: the ratios compare times, not results."
    )
    yield ""
    yield from (f"* {line}" for line in found.machine)
    yield ""
    yield f"![Time over size, both logarithmic]({chart})"
    for topic, series in found.topics:
        yield from _topic(topic, series)
    yield from _models(found.topics)
    yield from _start(found.start)
    yield from _checked(found.checked)
    if found.missing:
        yield f"\nLeft out, because not installed: {', '.join(found.missing)}."
    if found.goals:
        yield from ("", "## Goals", "", "```text", *found.goals, "```")


def _topic(topic: Topic, series: Sequence[Series]) -> Iterator[str]:
    yield from ("", f"## {topic.title}", "", topic.words, "")
    ours = series[0]
    head = ("method", topic.size, "CPU time", "of ours at that size", "memory")
    yield from table(
        head,
        [
            (
                one.method.words if i == 0 else "",
                f"{p.size:,}",
                seconds(p.seconds),
                _ratio(one, ours, p.size),
                mb(p.memory),
            )
            for one in series
            for i, p in enumerate(one.points)
        ],
    )


def _ratio(one: Series, ours: Series, size: int) -> str:
    """How many times our time; marked where ours was measured at smaller and larger sizes only."""
    theirs, own = one.at(size), ours.at(size)
    if one is ours or theirs is None:
        return "1" if one is ours else ""
    if own is not None:
        return _times(theirs / own)
    near = ours.between(size)
    return "" if near is None else f"about {_times(theirs / near, 2)}"


def _times(x: float, digits: int = 3) -> str:
    return f"{x:,.0f}" if x >= 100 else f"{x:.{digits}g}"


def _models(topics: Sequence[tuple[Topic, Sequence[Series]]]) -> Iterator[str]:
    yield from ("", "## Cost models", "")
    yield (
        "A power law through the measured times, by least squares in logarithms, and the size at which a method leaves "
        f"a budget of {SECONDS:.0f} s and {MEMORY / 1024:.0f} GB by it: beyond the measured sizes an extrapolation."
    )
    yield ""
    rows = []
    for topic, series in topics:
        for one in series:
            usable = one.usable
            end = "" if usable is None else _end(*usable, one.points[-1].size, topic.size)
            rows.append((topic.title, one.method.words, law(one.time, "s"), _growth(one), end))
    yield from table(("topic", "method", "time", "memory beyond start-up", "usable up to"), rows)


def _growth(one: Series) -> str:
    if not one.grows:
        return "flat"
    return "grows at the largest size only" if one.growth is None else law(one.growth, "MB")


def _end(size: float, what: str, largest: int, unit: str) -> str:
    """The size at which a method ends; a model says nothing far beyond what was measured."""
    if size > FAR * largest:
        return f"more than {rounded(FAR * largest)} {unit}"
    return f"{rounded(size)} {unit} ({what})"


def _start(start: dict[str, Cost]) -> Iterator[str]:
    yield from ("", "## Cold start", "", "Whole processes, imports included.", "")
    least = next(iter(start.values()))
    rows = [(name, seconds(x.cpu), f"{x.cpu / least.cpu:.3g}", mb(x.memory)) for name, x in start.items()]
    yield from table(("process", "CPU time", "of the first", "memory"), rows)


def _checked(checked: dict[int, tuple[Cost, Cost]]) -> Iterator[str]:
    yield from ("", "## Checker and prover", "")
    yield "Whole processes, on weighted balanced digraphs; the checker is the standard library alone."
    yield ""
    rows = [
        (
            f"{n}",
            seconds(prove.cpu),
            seconds(check.cpu),
            f"{check.cpu / prove.cpu:.2g}",
            mb(prove.memory),
            mb(check.memory),
        )
        for n, (prove, check) in checked.items()
    ]
    yield from table(("agents", "prove", "check", "check / prove", "memory of prove", "of check"), rows)


def table(head: Row, rows: Sequence[Row]) -> Iterator[str]:
    """A table in Markdown."""
    yield f"| {' | '.join(head)} |"
    yield "|" + "---|" * len(head)
    for row in rows:
        yield f"| {' | '.join(row)} |"


def seconds(x: float) -> str:
    return f"{x:.3g} s" if x >= 1 else f"{1000 * x:.3g} ms"


def mb(x: float) -> str:
    return f"{x:.0f} MB"


def law(power: Power | None, unit: str) -> str:
    return "" if power is None else f"{power.factor:.2g} {unit} n^{power.exponent:.2f}"


def rounded(x: float) -> str:
    """Two digits."""
    digits = max(0, math.floor(math.log10(x)) - 1)
    return f"{round(x / 10**digits) * 10**digits:,}"
