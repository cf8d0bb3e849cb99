"""Chosen weights in place of a design's own, and what they are worth, for a reader and for a program."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

from fomas_verify.certificate.document import plain
from fomas_verify.design import Design
from fomas_verify.enclosure.digits import decimal, exact_decimal, rounded_down
from fomas_verify.exact.rational import format_rational
from fomas_verify.region.weights import BestWeights

DIGITS, PLACES = 12, 40


def weighted_design(design: Design, found: BestWeights) -> Design:
    """The design with these weights, gamma and h left free: sigma is least at mu = 1."""
    return replace(design, graph=found.graph, gamma=None, mu=None, h=None)


def weights_text(design: Design, found: BestWeights) -> str:
    """What was chosen, and what it is worth against the weights that were given."""
    return "\n".join(_lines(design, found))


def _lines(design: Design, found: BestWeights) -> Iterator[str]:
    yield f"{design.name}: weights for {design.graph.agents} agents and {len(design.graph.edges)} edges"
    yield f"  sigma with the chosen weights    {decimal(found.sigma, DIGITS)}, at mu = 1"
    if found.before is None:
        yield "  sigma as given                   none: Assumption 1 fails"
    else:
        yield f"  sigma as given, at the best mu   {decimal(found.before, DIGITS)}"
    if found.least > 0:
        yield f"  every choice of weights has      at least {rounded_down(found.least, DIGITS)}"
    yield ""
    yield "from  to  weight"
    for i, j, w in found.graph.edges:
        yield f"{i:>4}  {j:>2}  {exact_decimal(w, PLACES) or format_rational(w)}"
    yield from (f"{i:>4}  {j:>2}  0: the edge is left out" for i, j in found.dropped)


def weights_record(found: BestWeights) -> dict[str, Any]:
    """The same for a program; every number exact."""
    before = None if found.before is None else {"lower": found.before.lower, "upper": found.before.upper}
    record = {
        "edges": [[*edge] for edge in found.graph.edges],
        "left_out": [list(pair) for pair in found.dropped],
        "sigma": {"lower": found.sigma.lower, "upper": found.sigma.upper},
        "sigma_as_given": before,
        "least_sigma": found.least,
    }
    shown: dict[str, Any] = plain(record)
    return shown
