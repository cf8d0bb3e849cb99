"""What was found about digraphs to switch among, for a terminal."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

from fomas_verify.claims.verdict import Verdict
from fomas_verify.design import SwitchedDesign
from fomas_verify.enclosure.digits import decimal, rounded_down, rounded_up
from fomas_verify.enclosure.interval import Interval
from fomas_verify.kernel.memory import one_step_weight
from fomas_verify.region.switching import SwitchedProof
from fomas_verify.region.switching_region import SwitchedRegion
from fomas_verify.report.text import closing_line, refutation_text, verdict_table
from fomas_verify.spectrum.margins import BITS

DIGITS = 12


def switched_proof_text(proof: SwitchedProof) -> str:
    """The verdict table, the rate, what a refutation means, and how it ends."""
    require, decisions = proof.design.first.require, proof.decisions
    parts = ["\n".join(_heading(proof.design)) + "\n", verdict_table(decisions, require)]
    if proof.rate is not None:
        kappa, rho = (decimal(Interval.exactly(x), DIGITS) for x in (proof.rate.kappa, proof.rate.rho))
        bound = "norm(x_k - mean) <= kappa rho^k norm(x_0 - mean)"
        parts.append(f"  under every switching {bound}: kappa = {kappa}, rho = {rho}\n")
    parts += [refutation_text(name, x) for name, x in decisions.items() if x.verdict is Verdict.REFUTED]
    return "\n".join([*parts, closing_line(decisions, require)])


def switched_region_text(region: SwitchedRegion) -> str:
    """The mu of both conditions, inside their ends, and the gamma that go with the design's h."""
    first = region.design.first
    lines = [*_heading(region.design), "", "condition    mu"]
    for strip in region.strips:
        if strip.inner is None:
            lines.append(f"{strip.condition:<11}  empty: Assumption 1 fails for one of the graphs")
            continue
        low, high = rounded_down(strip.inner[1], DIGITS), rounded_up(strip.outer, DIGITS)
        lines.append(f"{strip.condition:<11}  (0, {low}] certified, none above {high}")
        if first.h is not None:
            weight = one_step_weight(first.alpha, first.h, BITS)
            gamma = rounded_down(strip.inner[1] / weight.upper, DIGITS)
            lines.append(f"{'':<11}  gamma up to {gamma} at h = {decimal(Interval.exactly(first.h), DIGITS)}")
    lines += [
        "",
        "common-form: one quadratic form decreases under every graph, so that they may be switched in any order;",
    ]
    lines.append("  above its end no form does, which does not exclude consensus unless a graph fails alone")
    return "\n".join(lines)


def _heading(design: SwitchedDesign) -> Iterator[str]:
    first = design.first
    numbers: list[tuple[str, Fraction | None]] = [("alpha", first.alpha), ("gamma", first.gamma), ("h", first.h)]
    given = [f"{name} = {decimal(Interval.exactly(x), 20)}" for name, x in numbers if x is not None]
    if design.mu is not None:
        ends = [decimal(Interval.exactly(x), 20) for x in dict.fromkeys(design.mu.ends)]
        given.append(f"mu = {ends[0] if len(ends) == 1 else f'[{ends[0]}, {ends[1]}]'}")
    count = len(design.graphs)
    graphs = "1 graph" if count == 1 else f"{count} graphs to switch among"
    yield f"{first.name}: {', '.join(given)}; {first.graph.agents} agents, {graphs}"
    yield from (f"note: {note}" for note in first.notes)
