"""What a sweep does, to the last choice: the same plan gives the same parts, whoever computes them."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from importlib.metadata import version
from typing import Any, Final

from fomas_verify.design import CLAIM_IDS, Design, DesignError
from fomas_verify.design.document import Number
from fomas_verify.sweep.errors import SweepError
from fomas_verify.sweep.grid import MOST_ROWS, Grid

PARTS: Final = 200
FEWEST, MOST = 10, 10_000
"""By default a sweep has about so many parts, each of at least and at most so many rows."""

LARGEST_PART: Final = 1_000_000


@dataclass(frozen=True)
class Plan:
    """A grid, the claims to decide (None: all, and those required by the design), the rows of a part, the version of
    this package.
    """

    grid: Grid
    only: tuple[str, ...] | None
    part_rows: int
    version: str

    @property
    def parts(self) -> int:
        """The number of parts."""
        return -(-self.grid.rows // self.part_rows)

    def rows_of(self, part: int) -> range:
        """The rows of a part."""
        return range(part * self.part_rows, min((part + 1) * self.part_rows, self.grid.rows))

    @cached_property
    def claims(self) -> tuple[str, ...]:
        """The claims that are decided, in the order of the contract."""
        with_x0 = "x0" in self.grid.base
        return tuple(x for x in CLAIM_IDS if (x in self.only if self.only else with_x0 or not x.startswith("traj")))

    def required(self, design: Design) -> Design:
        """The design, which requires the claims asked for where there are such."""
        return replace(design, require=self.claims) if self.only else design

    @cached_property
    def content(self) -> dict[str, Any]:
        """The plan as JSON has it."""
        grid = self.grid
        return {
            "base": _plain(grid.base),
            "graphs": [_plain(graph) for graph in grid.graphs],
            "axes": {axis.name: _plain(axis.values) for axis in grid.axes},
            "claims": list(self.claims) if self.only else None,
            "rows": grid.rows,
            "part_rows": self.part_rows,
            "version": self.version,
        }

    @cached_property
    def digest(self) -> str:
        """SHA-256 of the content."""
        return hashlib.sha256(json.dumps(self.content, sort_keys=True).encode()).hexdigest()


def make_plan(
    grid: Grid, *, only: tuple[str, ...] | None = None, part_rows: int | None = None, most_rows: int = MOST_ROWS
) -> Plan:
    """Decide how a grid is worked through.

    Raises
    ------
    SweepError, DesignError
        The grid has more than ``most_rows`` rows, or a claim is asked for that its design cannot have.
    """
    if grid.rows > most_rows:
        factors = [f"{len(grid.graphs)} graphs"] if grid.graph_axes else []
        factors += [f"{len(axis.values)} {axis.name}" for axis in grid.axes]
        product = " x ".join(factors)
        raise SweepError(
            f"{grid.source}: grid: expected at most {most_rows} rows, got {grid.rows} ({product}); "
            "--max-rows allows more"
        )
    if only and "trajectory-norm-bound" in only and "x0" not in grid.base:
        raise DesignError(f"{grid.source}: x0: trajectory-norm-bound is about x0; got no x0")
    rows = part_rows or min(max(-(-grid.rows // PARTS), FEWEST), MOST)
    return Plan(grid, only, rows, version("fomas_verify"))


def _plain(value: Any) -> Any:
    match value:
        case Mapping():
            return {str(key): _plain(x) for key, x in value.items()}
        case list() | tuple():
            return [_plain(x) for x in value]
        case Number(text):
            return text
        case str() | bool() | int():
            return value
        case _:
            return repr(value)
