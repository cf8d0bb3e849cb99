"""The form of witnesses: section 4 of docs/certificate-format.md, typed."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from .fields import Unclear, integer, items, members, power_of_trace, rational, triangle, vector
from .strict_json import Malformed, Obj

Witness = dict[str, Any]
SPECTRAL = ("perron-eigenvalues", "control-bounded", "average-consensus")
BOXED = ("memory-inequality", "repaired-condition", "control-norm-bound", "trajectory-norm-bound")
MOST_BOXES = 4096
NORM_BOUNDS = {
    ("control-norm-bound", "proved"): ((), ("mu", "lambda_max_upper"), ("samples", "powers")),
    ("control-norm-bound", "refuted"): (("x0", "k"), ("mu", "power")),
    ("trajectory-norm-bound", "proved"): ((), ("mu", "lambda_max_upper"), ("samples", "powers")),
    ("trajectory-norm-bound", "refuted"): (("k",),),
}


@dataclass(frozen=True)
class Claim:
    """A claim as it stands in the certificate, its witness typed."""

    id: str
    verdict: str
    statement: str
    witness: dict[str, Any]


def _polynomial(item: Any) -> dict[str, Any]:
    found = members(item, ("polynomial", "lower", "upper"))
    coefficients = tuple(rational(c) for c in items(found["polynomial"], 2))
    return {"polynomial": coefficients, "lower": rational(found["lower"]), "upper": rational(found["upper"])}


def _imbalance(item: Any) -> dict[str, Any]:
    found = members(item, ("agent", "in", "out"))
    return {"agent": integer(found["agent"], 1), "in": rational(found["in"]), "out": rational(found["out"])}


def _pair(item: Any) -> list[int]:
    pair = [integer(x, 1) for x in items(item)]
    if len(pair) != 2:
        raise Malformed("expected two agents")
    return pair


def _shapes(claim: str, verdict: str) -> tuple[tuple[tuple[str, ...], ...], bool]:
    """The key sets a witness may have, and whether any non-empty part of the first will do."""
    if verdict == "undecided":
        return (("bits",),), False
    if (claim, verdict) in NORM_BOUNDS:
        return NORM_BOUNDS[claim, verdict], False
    if claim in SPECTRAL and verdict in ("proved", "refuted"):
        return ((("mu", "Q"),) if verdict == "proved" else (("mu", "power"), ("mu", "Y"))), False
    if claim == "beta-contraction" and verdict == "proved":
        return (("mu", "lambda2"), ("mu", "lambda2_upper", "lambda_max_upper")), False
    if verdict == "refuted" and claim != "gain-bound":
        keys: dict[str, tuple[str, ...]] = {
            "graph-assumption": ("unreachable", "imbalance"),
            "memory-inequality": ("k",),
        }
        return (keys.get(claim, ("e",)),), claim == "graph-assumption"
    return ((),), False


def witness(item: Any, claim: str, verdict: str, agents: int) -> dict[str, Any]:
    """The witness of a claim about one design, typed."""
    if not isinstance(item, Obj):
        raise Malformed("expected an object")
    shapes, partial = _shapes(claim, verdict)
    keys = set(item.keys())
    if not (any(keys == set(shape) for shape in shapes) or (partial and keys and keys <= set(shapes[0]))):
        raise Malformed("witness of another shape")
    readers: dict[str, Callable[[Any], Any]] = {
        "bits": lambda x: integer(x, 1),
        "Q": lambda x: triangle(x, agents - 1),
        "Y": lambda x: triangle(x, agents - 1),
        "power": power_of_trace,
        "lambda2": _polynomial,
        "unreachable": _pair,
        "imbalance": _imbalance,
        "k": lambda x: integer(x, 1 if (claim, verdict) in NORM_BOUNDS else 0),
        "samples": lambda x: integer(x, 0),
        "powers": lambda x: integer(x, 1),
        "x0": lambda x: vector(x, agents),
        "e": lambda x: vector(x, agents),
    }
    return {key: readers.get(key, rational)(value) for key, value in item.pairs}


def pair(item: Any, nullable: bool = False) -> tuple[Any, Any]:
    """Two rationals, or nulls where these are allowed."""
    if len(items(item)) != 2:
        raise Malformed("expected two ends")
    first, second = (None if nullable and end is None else rational(end) for end in item)
    return first, second


def alphas(item: Any, nullable: bool = False) -> tuple[Any, Any]:
    """Two numbers for alpha; whether one beyond the digits of section 2 may stand there is not said."""
    ends = pair(item, nullable)
    if any(end is not None and max(abs(end.numerator), end.denominator) >= 2**64 for end in ends):
        raise Unclear("an alpha of more than 64 bits")
    return ends


def _box(item: Any, claim: str, agents: int) -> dict[str, Any]:
    found = members(item, ("alpha", "mu", "witness"))
    inner = witness(found["witness"], claim, "proved", agents)
    return {"alpha": alphas(found["alpha"]), "mu": pair(found["mu"]), "witness": inner}


def family_witness(item: Any, claim: str, verdict: str, agents: int, keys: tuple[str, ...]) -> dict[str, Any]:
    """The witness of a claim about an uncertain design (section 7), typed; `keys` are those of its members."""
    if claim == "graph-assumption" or verdict in ("undecided", "inapplicable"):
        return witness(item, claim, verdict, agents)
    if verdict == "refuted":
        found = members(item, ("member", "witness"))
        member = {key: rational(x) for key, x in members(found["member"], keys).items()}
        alphas([found["member"]["alpha"]] * 2)
        return {"member": member, "witness": witness(found["witness"], claim, verdict, agents)}
    if claim not in BOXED:
        return witness(item, claim, verdict, agents)
    boxes = items(members(item, ("boxes",))["boxes"], 1)
    if len(boxes) > MOST_BOXES:
        raise Malformed("more than 4096 boxes")
    return {"boxes": [_box(box, claim, agents) for box in boxes]}
