"""The form of a certificate: what section 1 to 4 of docs/certificate-format.md allow, as a typed document.

`read` raises `Malformed` for what `check` must answer with exit status 2. What the page leaves open raises `Unclear`.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from .digits import to_int
from .model import Design, Edge, Start
from .oracle import CLAIMS
from .strict_json import Malformed, Num, Obj, loads

RATIONAL = re.compile(r"-?[0-9]+(?:/[0-9]+)?\Z")
INTEGER = re.compile(r"-?(?:0|[1-9][0-9]*)\Z")
STATEMENTS = dict(
    zip(
        CLAIMS,
        (
            "the digraph is strongly connected and balanced (Assumption 1)",
            "0 < mu < 1/Delta_max (gain bound (15) [eqh])",
            "beta^(k+1) + sum_{l=1}^{k+1} abs f(l) <= 1 for every k >= 0 (inequality (14) [eqT2])",
            "1 is a simple eigenvalue of P and every other eigenvalue of P lies in the open unit disc",
            "norm of P e <= beta norm of e for every e that sums to 0 (step of the proof of Theorem 1)",
            "norm of P e <= (2^alpha - 1) norm of e for every e that sums to 0 (sigma <= 2^alpha - 1)",
            "norm u_k <= norm u_0 for every k >= 0 and every x_0 (relation eqL3)",
            "norm u_k <= norm u_0 for every k >= 0, for the x_0 of the design",
            "for every x_0, norm u_k is bounded over k and u_k tends to 0",
            "for every x_0 and every i, x_i(t) tends to the mean of x_0 as t tends to infinity",
        ),
        strict=True,
    )
)
ENDS = ("lower", "upper")
SETTLING = (*ENDS, "settle_to")
VALUES: dict[str, tuple[str, ...]] = {
    **dict.fromkeys(("mu", "threshold", "degree_max", "lambda2", "beta", "sigma"), ENDS),
    "peak_control": (*ENDS, "at"),
    "settling_samples": SETTLING,
    "settling_time": SETTLING,
    "rate": ("kappa", "rho"),
    "actuator_reach": ENDS,
    "limit": ENDS,
}
VERDICTS = ("proved", "refuted", "undecided", "inapplicable")
MOST_AGENTS = 64
SPECTRAL = ("perron-eigenvalues", "control-bounded", "average-consensus")
NORM_BOUNDS = {
    ("control-norm-bound", "proved"): (("mu", "lambda_max_upper"), ("samples", "powers")),
    ("control-norm-bound", "refuted"): (("x0", "k"),),
    ("trajectory-norm-bound", "proved"): ((), ("mu", "lambda_max_upper"), ("samples", "powers")),
    ("trajectory-norm-bound", "refuted"): (("k",),),
}


class Unclear(Exception):
    """The format page does not say, or the document is beyond what the oracle affords."""


@dataclass(frozen=True)
class Claim:
    """A claim as it stands in the certificate, its witness typed."""

    id: str
    verdict: str
    statement: str
    witness: dict[str, Any]


@dataclass(frozen=True)
class Document:
    """A certificate of good form."""

    design: Design
    values: dict[str, dict[str, Any]]
    claims: tuple[Claim, ...]


def rational(item: Any) -> Fraction:
    """A rational in a string."""
    if not isinstance(item, str) or not RATIONAL.match(item):
        raise Malformed("expected a rational in a string")
    if sum(map(str.isdigit, item)) > 100_000:
        raise Malformed("more than 100000 digits")
    top, _, bottom = item.partition("/")
    if bottom and not bottom.strip("0"):
        raise Malformed("denominator zero")
    return Fraction(to_int(top), to_int(bottom or "1"))


def integer(item: Any, least: int) -> int:
    """A JSON integer, at least `least`."""
    if not isinstance(item, Num) or not INTEGER.match(item.text):
        raise Malformed("expected an integer")
    if item.text == "-0":
        raise Unclear("-0 for a count")
    if len(item.text) > 80:
        raise Malformed("more than 80 digits")
    number = to_int(item.text)
    if number < least:
        raise Malformed("integer out of range")
    return number


def items(item: Any, least: int = 0) -> list[Any]:
    """A JSON array of at least `least` entries."""
    if not isinstance(item, list) or len(item) < least:
        raise Malformed("expected an array")
    return item


def members(item: Any, required: tuple[str, ...], optional: tuple[str, ...] = ()) -> dict[str, Any]:
    """A JSON object with the required keys and none but the optional ones besides."""
    if not isinstance(item, Obj):
        raise Malformed("expected an object")
    keys = set(item.keys())
    if not set(required) <= keys or not keys <= {*required, *optional}:
        raise Malformed("keys missing or unknown")
    return dict(item.pairs)


def one_of(item: Any, allowed: tuple[str, ...]) -> str:
    """One of the strings allowed."""
    if not isinstance(item, str) or item not in allowed:
        raise Malformed("unknown word")
    return item


def _is_surrogate(char: str) -> bool:
    return 0xD800 <= ord(char) < 0xE000


def _edges(item: Any, agents: int) -> tuple[Edge, ...]:
    edges: list[Edge] = []
    for entry in items(item):
        if len(items(entry)) != 3:
            raise Malformed("an edge has three entries")
        source, target, weight = integer(entry[0], 1), integer(entry[1], 1), rational(entry[2])
        if source > agents or target > agents or source == target or weight <= 0:
            raise Malformed("impossible edge")
        edges.append((source, target, weight))
    if len({edge[:2] for edge in edges}) != len(edges):
        raise Malformed("repeated edge")
    return tuple(sorted(edges))


def _x0(item: Any, agents: int) -> Start:
    entries = items(item)
    if len(entries) != agents:
        raise Malformed("x0 of the wrong length")
    if any(isinstance(entry, list) for entry in entries):
        if len({len(items(entry, 1)) for entry in entries}) != 1:
            raise Malformed("x0 of unequal lengths")
        return tuple(tuple(map(rational, entry)) for entry in entries)
    return tuple(map(rational, entries))


def _alpha(item: Any) -> Fraction:
    alpha = rational(item)
    if not 0 < alpha < 1 or alpha.denominator >= 2**64:
        raise Malformed("alpha out of range")
    return alpha


def _design(item: Any) -> Design:
    found = members(item, ("alpha", "agents", "edges", "require"), ("gamma", "mu", "h", "x0"))
    if ("gamma" in found) == ("mu" in found) or ("gamma" in found and "h" not in found):
        raise Malformed("exactly one of gamma and mu; gamma needs h")
    alpha, agents = _alpha(found["alpha"]), integer(found["agents"], 2)
    positive = {key: rational(found[key]) for key in ("gamma", "mu", "h") if key in found}
    if any(x <= 0 for x in positive.values()):
        raise Malformed("gamma, mu and h are positive")
    edges = _edges(found["edges"], agents)
    x0 = _x0(found["x0"], agents) if "x0" in found else None
    wanted = [one_of(claim, CLAIMS) for claim in items(found["require"], 1)]
    if len(set(wanted)) != len(wanted):
        raise Malformed("repeated claim in require")
    return Design(alpha, agents, edges, positive.get("mu"), positive.get("gamma"), positive.get("h"), x0)


def triangle(item: Any, size: int) -> list[list[Fraction]]:
    """The symmetric matrix whose lower triangle is given row by row."""
    rows = items(item)
    if len(rows) != size or any(len(items(row)) != i for i, row in enumerate(rows, 1)):
        raise Malformed("not a lower triangle of the right size")
    lower = [[rational(x) for x in row] for row in rows]
    return [[lower[max(i, j)][min(i, j)] for j in range(size)] for i in range(size)]


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


def _vector(item: Any, agents: int) -> list[Fraction]:
    if len(items(item)) != agents:
        raise Malformed("expected one rational for each agent")
    return [rational(x) for x in item]


def _power(item: Any) -> int:
    power = integer(item, 1)
    if power > 2**256:
        raise Malformed("power beyond 2^256")
    return power


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


def _witness(item: Any, claim: str, verdict: str, agents: int) -> dict[str, Any]:
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
        "power": _power,
        "lambda2": _polynomial,
        "unreachable": _pair,
        "imbalance": _imbalance,
        "k": lambda x: integer(x, 1 if (claim, verdict) in NORM_BOUNDS else 0),
        "samples": lambda x: integer(x, 0),
        "powers": lambda x: integer(x, 1),
        "x0": lambda x: _vector(x, agents),
        "e": lambda x: _vector(x, agents),
    }
    return {key: readers.get(key, rational)(value) for key, value in item.pairs}


def _claim(item: Any, agents: int) -> Claim:
    found = members(item, ("id", "verdict", "statement", "witness"))
    name, verdict = one_of(found["id"], CLAIMS), one_of(found["verdict"], VERDICTS)
    if not isinstance(found["statement"], str) or any(map(_is_surrogate, found["statement"])):
        raise Malformed("expected a string of characters")
    return Claim(name, verdict, found["statement"], _witness(found["witness"], name, verdict, agents))


def read(data: bytes) -> Document:
    """The certificate in the bytes; `Malformed` where its form is wrong, `Unclear` where the page does not say."""
    if len(data) > 64 * 2**20:
        raise Malformed("longer than 64 MiB")
    found = members(loads(data), ("format", "kind", "design", "values", "claims", "tool"))
    one_of(found["format"], ("fomas-certificate/1",))
    one_of(found["kind"], ("design",))
    tool = members(found["tool"], ("name", "version"))
    one_of(tool["name"], ("fomas_verify",))
    if not isinstance(tool["version"], str) or len(tool["version"]) > 64:
        raise Malformed("version of at most 64 characters")
    if any(map(_is_surrogate, tool["version"])):
        raise Malformed("a lone surrogate is no character")
    design = _design(found["design"])
    values = {
        key: {name: integer(x, 0) if name == "at" else rational(x) for name, x in members(entry, VALUES[key]).items()}
        for key, entry in members(found["values"], (), tuple(VALUES)).items()
    }
    claims = tuple(_claim(item, design.agents) for item in items(found["claims"], 1))
    if len({claim.id for claim in claims}) != len(claims):
        raise Malformed("repeated claim")
    if design.agents > MOST_AGENTS:
        raise Unclear("more agents than the oracle affords")
    return Document(design, values, claims)
