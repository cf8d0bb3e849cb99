"""The form of a certificate: what section 1 to 4 of docs/certificate-format.md allow, as a typed document.

`read` raises `Malformed` for what `check` must answer with exit status 2. What the page leaves open raises `Unclear`.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from .fields import Unclear, integer, items, members, one_of, rational
from .form_margins import margins
from .form_witness import Claim, family_witness, witness
from .model import Design, Edge, Ends, Start, Uncertain
from .oracle import CLAIMS
from .strict_json import Malformed, loads

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


@dataclass(frozen=True)
class Document:
    """A certificate of good form."""

    design: Design | Uncertain
    values: dict[str, dict[str, Any]]
    claims: tuple[Claim, ...]


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


def _positive(item: Any) -> Fraction:
    number = rational(item)
    if number <= 0:
        raise Malformed("gamma, mu and h are positive")
    return number


def _ends(item: Any, number: Callable[[Any], Fraction]) -> Ends:
    if not isinstance(item, list):
        return number(item), number(item)
    if len(item) != 2:
        raise Malformed("an interval has two ends")
    low, high = number(item[0]), number(item[1])
    if low >= high:
        raise Malformed("an interval from the lower end to the upper")
    return low, high


def _design(item: Any) -> Design | Uncertain:
    found = members(item, ("alpha", "agents", "edges", "require"), ("gamma", "mu", "h", "x0"))
    if ("gamma" in found) == ("mu" in found) or ("gamma" in found and "h" not in found):
        raise Malformed("exactly one of gamma and mu; gamma needs h")
    agents = integer(found["agents"], 2)
    ends = {key: _ends(found[key], _positive) for key in ("gamma", "mu", "h") if key in found}
    edges = _edges(found["edges"], agents)
    x0 = _x0(found["x0"], agents) if "x0" in found else None
    wanted = [one_of(claim, CLAIMS) for claim in items(found["require"], 1)]
    if len(set(wanted)) != len(wanted):
        raise Malformed("repeated claim in require")
    family = Uncertain(_ends(found["alpha"], _alpha), agents, edges, x0=x0, **ends)
    uncertain = any(isinstance(found.get(key), list) for key in ("alpha", "gamma", "mu", "h"))
    return family if uncertain else family.member({})


def _value(key: str, item: Any, agents: int) -> dict[str, Any]:
    if key == "margins":
        return margins(item, agents)
    return {name: integer(x, 0) if name == "at" else rational(x) for name, x in members(item, VALUES[key]).items()}


def _claim(item: Any, design: Design | Uncertain) -> Claim:
    found = members(item, ("id", "verdict", "statement", "witness"))
    name, verdict = one_of(found["id"], CLAIMS), one_of(found["verdict"], VERDICTS)
    if not isinstance(found["statement"], str) or any(map(_is_surrogate, found["statement"])):
        raise Malformed("expected a string of characters")
    if isinstance(design, Uncertain):
        given = family_witness(found["witness"], name, verdict, design.agents, tuple(design.ends()))
    else:
        given = witness(found["witness"], name, verdict, design.agents)
    return Claim(name, verdict, found["statement"], given)


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
    given = members(found["values"], (), (*VALUES, "margins"))
    values = {key: _value(key, entry, design.agents) for key, entry in given.items()}
    claims = tuple(_claim(item, design) for item in items(found["claims"], 1))
    if len({claim.id for claim in claims}) != len(claims):
        raise Malformed("repeated claim")
    if design.agents > MOST_AGENTS:
        raise Unclear("more agents than the oracle affords")
    return Document(design, values, claims)
