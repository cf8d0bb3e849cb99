"""One row a design: its swept parameters, the verdicts, the values as floats rounded outward, its status."""

from __future__ import annotations

import math
import sys
from collections.abc import Iterator, Mapping
from fractions import Fraction
from typing import Any

from fomas_verify.claims.verdict import Decision
from fomas_verify.design import Design, DesignError
from fomas_verify.enclosure.interval import Interval
from fomas_verify.exact.errors import FomasError
from fomas_verify.exact.memory import raise_beyond_memory
from fomas_verify.exact.rational import format_rational
from fomas_verify.prover import Proof, prove
from fomas_verify.spectrum.loop import Loop
from fomas_verify.sweep.grid import at_row
from fomas_verify.sweep.plan import Plan

VALUES = ("mu", "beta", "sigma", "lambda2", "threshold", "degree_max")
DIGITS = 20
"""More than a float holds."""
INTERNAL = 4

Row = dict[str, Any]


def decide_rows(plan: Plan, rows: range) -> Iterator[Row]:
    """Decide the designs of some rows.

    Verdicts are those of `prove`. Where a design is wrong, too large, or ends with an internal error, the row says so
    by ``status`` and ``message`` and has no verdict.

    Yields
    ------
    Row
        By the names of the columns, in the order of the rows.
    """
    each = plan.grid.rows_of_a_graph
    like: Loop | None = None
    graph, design = -1, None
    for row in rows:
        if row // each != graph:
            graph, like = row // each, None
            design = _design_or_refusal(plan, graph)
        numbers = plan.grid.numbers(row % each)
        found = design if isinstance(design, dict) else None
        if isinstance(design, Design):
            proof = _proof_or_refusal(plan, at_row(design, numbers), like)
            found = proof if isinstance(proof, dict) else _of_proof(proof)
            like = like if isinstance(proof, dict) else proof.loop
        yield {"row": row, **_parameters(plan, graph, numbers), **(found or {})}


def outward(x: Interval) -> tuple[float, float]:
    """The floats next to an enclosure on both sides, or its ends where these are floats."""
    return _at_most(x.lower), -_at_most(-x.upper)


def nearest(x: Fraction) -> float:
    """The float nearest to a number > 0."""
    try:
        return float(x)
    except OverflowError:
        return math.inf


def _at_most(x: Fraction) -> float:
    try:
        near = float(x)
    except OverflowError:
        return sys.float_info.max if x > 0 else -math.inf
    return near if Fraction(near) <= x else math.nextafter(near, -math.inf)


def _parameters(plan: Plan, graph: int, numbers: Mapping[str, Fraction]) -> Row:
    found: Row = {name: plan.grid.graph_value(graph, name) for name in plan.grid.graph_axes}
    for name, x in numbers.items():
        found |= {name: nearest(x), f"{name}_exact": format_rational(x)}
    return found


def _design_or_refusal(plan: Plan, graph: int) -> Design | Row:
    try:
        return plan.required(plan.grid.design_on(graph))
    except DesignError as error:
        return _refused(error, error.exit_status)


def _proof_or_refusal(plan: Plan, design: Design, like: Loop | None) -> Proof | Row:
    try:
        return prove(design, digits=DIGITS, only=plan.claims, like=like)
    except FomasError as error:
        raise_beyond_memory(error)
        return _refused(error, error.exit_status)
    except Exception as error:  # one design must not end the others
        raise_beyond_memory(error)
        return _refused(f"{type(error).__name__}: {error}", INTERNAL)


def _refused(reason: object, status: int) -> Row:
    return {"status": status, "message": " ".join(str(reason).split())}


def _of_proof(proof: Proof) -> Row:
    found: Row = {"status": _status(proof.design, proof.decisions)}
    found |= {f"verdict_{claim}": decision.verdict.value for claim, decision in proof.decisions.items()}
    for name, x in proof.values.items():
        found[f"{name}_lower"], found[f"{name}_upper"] = outward(x)
    return found


def _status(design: Design, decisions: Mapping[str, Decision]) -> int:
    from fomas_verify.prover.prove import exit_status_of

    return exit_status_of([claim for claim in design.require if claim in decisions], decisions)
