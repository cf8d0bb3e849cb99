"""A task and its answer as a certificate writes them. Source: docs/certificate-format.md, section 9."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from fomas_verify.claims.verdict import Verdict
from fomas_verify.region.entries import condition_claim
from fomas_verify.region.synthesize import Answer
from fomas_verify.region.task import Task

STATEMENTS: Mapping[str, str] = {
    "feasible": "some gamma > 0 and h > 0 satisfy the condition and the limits",
    "best": "no gamma > 0 and h > 0 that satisfy the condition and the limits are as good as the bound",
}


def task_entry(answer: Answer) -> dict[str, Any]:
    """The key `task` of the certificate."""
    task = answer.task
    if answer.point is None:
        claims = [_claim("feasible", Verdict.REFUTED, {"blocks": answer.blocks})]
    else:
        claims = [_claim("feasible", Verdict.PROVED, {})]
        if answer.bound is not None:
            claims.append(_claim("best", Verdict.PROVED, {"bound": answer.bound, "blocks": answer.blocks}))
    return {
        "condition": condition_claim(task.region.strip(task.condition)),
        "limits": limits_entry(task),
        "objective": task.objective.value,
        "claims": claims,
    }


def limits_entry(task: Task) -> dict[str, Any]:
    """The limits, and to what the agents have to settle where that matters."""
    limits = task.limits
    found = {"h": limits.h, "gamma": limits.gamma, "u_max": limits.u_max, "settle_within": limits.settle_within}
    found["settle_to"] = task.settle_to
    return {key: x for key, x in found.items() if x is not None}


def _claim(name: str, verdict: Verdict, witness: Mapping[str, Any]) -> dict[str, Any]:
    return {"id": name, "verdict": verdict.value, "statement": STATEMENTS[name], "witness": witness}
