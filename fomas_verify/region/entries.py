"""The region for other programs: the list of conditions, and the certificate. Source: docs/certificate-format.md,
section 8.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from fomas_verify.certificate.document import plain
from fomas_verify.certificate.region_document import region_certificate_text
from fomas_verify.claims.verdict import Verdict
from fomas_verify.enclosure.interval import Interval
from fomas_verify.region.model import Condition, Region, Strip

if TYPE_CHECKING:
    from fomas_verify.region.polygon import Room

KEPT_BITS = 96
"""The bits of a vertex."""

STATEMENTS: Mapping[Condition, str] = {
    Condition.AS_STATED: (
        "some mu > 0 satisfies mu < 1/Delta_max and -sqrt(3^alpha - 2^alpha) <= beta <= 2^alpha - 1, "
        "under Assumption 1 ((15) and (14))"
    ),
    Condition.CLOSED_FORM: (
        "some mu > 0 satisfies mu < 1/Delta_max and 1 - 2 mu lambda2 (1 - mu Delta_max) <= (2^alpha - 1)^2, "
        "under Assumption 1"
    ),
    Condition.REPAIRED: "some mu > 0 satisfies mu < 1/Delta_max and sigma <= 2^alpha - 1, under Assumption 1",
    Condition.GAIN_BOUND: "some mu > 0 satisfies mu < 1/Delta_max",
    Condition.CONSENSUS: "for some mu > 0 every x_i(t) tends to the mean of x_0, for every x_0, under Assumption 1",
}


def record(region: Region, left: Sequence[Room] = ()) -> dict[str, Any]:
    """What ``region --json`` prints; with what the limits leave of each condition, where there are limits."""
    entries = [_condition(strip) for strip in region.strips]
    for entry, room in zip(entries, left, strict=False):
        entry["limits"] = _room(room)
    return {"conditions": entries}


def _room(room: Room) -> dict[str, Any]:
    pieces = [
        {
            "samples": piece.samples,
            "unbounded": piece.unbounded,
            "vertices": [{"gamma": _ends(v.gamma), "h": _ends(v.h)} for v in piece.vertices],
        }
        for piece in room.pieces
    ]
    empty = None if not pieces and room.clash is None else not pieces
    found = {"empty": empty, "clash": room.clash, "polyhedra": pieces, "more": room.more, "peak_bound": room.peak_bound}
    plain_found: dict[str, Any] = plain(found)
    return plain_found


def _ends(x: Interval) -> dict[str, Any]:
    outer = x.rounded(KEPT_BITS)
    return {"lower": outer.lower, "upper": outer.upper}


def certificate(region: Region) -> str:
    """The certificate's canonical text."""
    from importlib.metadata import version

    return region_certificate_text(region.loop.design, map(condition_claim, region.strips), version("fomas_verify"))


def _condition(strip: Strip) -> dict[str, Any]:
    mu, opening = strip.mu, strip.opening
    found: dict[str, Any] = {"id": strip.condition.value, "empty": mu is None}
    if mu is not None:
        found["mu"] = {"inner": plain(mu.inner), "outer": plain(mu.outer)}
    alpha = None if opening is None else {"lower": plain(opening.alpha.lower), "upper": plain(opening.alpha.upper)}
    return found | {"alpha_opens": alpha}


def condition_claim(strip: Strip) -> dict[str, Any]:
    """A condition as a certificate claims it."""
    mu, opening = strip.mu, strip.opening
    witness: dict[str, Any] = dict(strip.empty)
    if mu is not None:
        witness["mu"] = {"inner": mu.inner, "outer": mu.outer, **mu.witness}
    if opening is not None:
        witness["alpha_opens"] = {"lower": opening.alpha.lower, "upper": opening.alpha.upper, **opening.witness}
    return {
        "id": strip.condition.value,
        "verdict": (Verdict.REFUTED if mu is None else Verdict.PROVED).value,
        "statement": STATEMENTS[strip.condition],
        "witness": witness,
    }
