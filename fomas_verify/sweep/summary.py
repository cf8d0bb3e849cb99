"""What a finished sweep found: how many rows of each status and verdict, counted on disk."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from fomas_verify.sweep.plan import Plan
from fomas_verify.sweep.store import part_name
from fomas_verify.sweep.table import columns_of

STATUSES: Mapping[int, str] = {
    0: "every required claim proved",
    1: "a required claim refuted or inapplicable",
    2: "no valid design",
    3: "undecided within the work allowed",
    4: "internal error",
}
VERDICTS = ("proved", "refuted", "undecided", "inapplicable")


@dataclass(frozen=True)
class Summary:
    """Counts of rows: by status, and for each claim by verdict."""

    rows: int
    statuses: Mapping[int, int]
    verdicts: Mapping[str, Mapping[str, int]]

    @property
    def exit_status(self) -> int:
        """4 where a row ended with an internal error, 2 where no row has a valid design, 0 otherwise."""
        if self.statuses.get(4):
            return 4
        return 2 if self.statuses.get(2) == self.rows else 0


def summarize(plan: Plan, folder: Path) -> Summary:
    """Count the rows of all parts, which are there."""
    names = {f"verdict_{claim}": claim for claim in plan.claims}
    statuses: Counter[int] = Counter()
    verdicts: dict[str, Counter[str]] = {claim: Counter() for claim in plan.claims}
    rows = 0
    for part in range(plan.parts):
        table = columns_of(folder / part_name(part), ["status", *names])
        rows += table.num_rows
        statuses.update(_counts(table["status"]))
        for name, claim in names.items():
            verdicts[claim].update(_counts(table[name]))
    return Summary(rows, statuses, verdicts)


def _counts(column: Any) -> dict[Any, int]:
    return {x["values"]: x["counts"] for x in column.value_counts().to_pylist() if x["values"] is not None}


def summary_text(plan: Plan, found: Summary) -> str:
    """The summary as a table."""
    swept = ", ".join(plan.grid.names)
    lines = [f"{found.rows} designs over {swept}", ""]
    lines += [f"{found.statuses[x]:>12}  {words}" for x, words in STATUSES.items() if found.statuses.get(x)]
    width = max(map(len, plan.claims))
    lines += ["", " " * width + "".join(f"{verdict:>14}" for verdict in VERDICTS)]
    for claim, counts in found.verdicts.items():
        lines.append(f"{claim:<{width}}" + "".join(f"{counts.get(verdict, 0):>14}" for verdict in VERDICTS))
    return "\n".join(lines)
