"""The form of `values.margins`: section 3 of docs/certificate-format.md, typed."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import Any

from .fields import members, one_of, power_of_trace, triangle
from .form_witness import alphas, pair, witness
from .strict_json import Malformed

INTERVALS = ("gain-bound", "memory-inequality", "perron-eigenvalues", "repaired-condition")
MARGINS = (*INTERVALS, "control-norm-bound")


def _of_mu(item: Any, claim: str, agents: int) -> dict[str, Any]:
    if claim != "perron-eigenvalues":
        found = members(item, ("inner", "outer"))
        return {key: pair(ends) for key, ends in found.items()}
    found = members(item, ("inner", "outer", "Q"), ("power", "Y"))
    if ("power" in found) == ("Y" in found):
        raise Malformed("one of power and Y")
    out: dict[str, Any] = {"inner": pair(found["inner"]), "outer": pair(found["outer"])}
    out["Q"] = triangle(found["Q"], agents - 1)
    return out | (
        {"power": power_of_trace(found["power"])} if "power" in found else {"Y": triangle(found["Y"], agents - 1)}
    )


def _of_alpha(item: Any) -> dict[str, tuple[Fraction | None, Fraction | None]]:
    found = members(item, ("inner", "outer"))
    return {"inner": alphas(found["inner"]), "outer": alphas(found["outer"], nullable=True)}


def _neighbourhood(item: Any, agents: int, ends: Callable[[Any], tuple[Any, Any]]) -> dict[str, Any]:
    found = members(item, ("inner", "witness"))
    outer = members(found["witness"], ("verdict", "witness"))
    verdict = one_of(outer["verdict"], ("proved", "refuted"))
    inner = witness(outer["witness"], "control-norm-bound", verdict, agents)
    return {"inner": ends(found["inner"]), "verdict": verdict, "witness": inner}


def margins(item: Any, agents: int) -> dict[str, dict[str, Any]]:
    """How far mu and alpha may move, by claim and by "mu" and "alpha"."""
    found = members(item, (), MARGINS)
    if not found:
        raise Malformed("expected a margin")
    out: dict[str, dict[str, Any]] = {}
    for claim, entry in found.items():
        given = members(entry, (), ("mu", "alpha"))
        if not given:
            raise Malformed("expected mu or alpha")
        out[claim] = {}
        for key, ends in given.items():
            if claim == "control-norm-bound":
                out[claim][key] = _neighbourhood(ends, agents, pair if key == "mu" else alphas)
            else:
                out[claim][key] = _of_mu(ends, claim, agents) if key == "mu" else _of_alpha(ends)
    return out
