"""Chosen weights as a design: its exact numbers, its file, and what it is worth, for a reader."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction

from fomas_verify.design import Design
from fomas_verify.enclosure.digits import decimal, exact_decimal, rounded_down
from fomas_verify.exact.rational import format_rational
from fomas_verify.kernel.memory import one_step_weight
from fomas_verify.region.weights import BestWeights
from fomas_verify.spectrum.margins import BITS

DIGITS, GAIN_DIGITS, PLACES = 12, 6, 40


def weighted_design(design: Design, found: BestWeights) -> Design:
    """The design with these weights: mu = 1, or, where it gives h, the gain that makes mu nearly 1 and not more."""
    weighted = replace(design, graph=found.graph, gamma=None, mu=Fraction(1))
    if design.h is None:
        return weighted
    weight = one_step_weight(design.alpha, design.h, BITS)
    return replace(weighted, gamma=Fraction(rounded_down(1 / weight.upper, GAIN_DIGITS)), mu=None)


def weighted_file(design: Design) -> str:
    """A design with chosen weights as TOML."""
    lines = ["# The weights were proposed by a numerical solver: another machine may find others, as good."]
    lines += [f"name = {_quoted(design.name)}", f"alpha = {_number(design.alpha)}"]
    numbers = {"gamma": design.gamma, "mu": design.mu, "h": design.h}
    lines += [f"{key} = {_number(x)}" for key, x in numbers.items() if x is not None]
    if design.x0 is not None:
        rows = [[_number(x) for x in row] for row in design.x0]
        shown = [row[0] if len(row) == 1 else f"[{', '.join(row)}]" for row in rows]
        lines.append(f"x0 = [{', '.join(shown)}]")
    lines += [f"horizon = {design.horizon}"] if design.horizon is not None else []
    lines += [f"settle_to = {_number(design.settle_to)}"] if design.settle_to is not None else []
    lines += ["", "[graph]", f"agents = {design.graph.agents}", "edges = ["]
    lines += [f"  [{source}, {target}, {_number(w)}]," for source, target, w in design.graph.edges]
    require = ", ".join(map(_quoted, design.require))
    return "\n".join([*lines, "]", "", "[gate]", f"require = [{require}]", ""])


def _quoted(text: str) -> str:
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    return f'"{escaped}"'


def number_text(x: Fraction) -> str:
    """The number exactly: as a decimal where it has a short one, else as p/q."""
    return exact_decimal(x, PLACES) or format_rational(x)


def _number(x: Fraction) -> str:
    text = number_text(x)
    return f'"{text}"' if "/" in text else text


def weights_text(design: Design, found: BestWeights, weighted: Design) -> str:
    """What was chosen, and what it is worth against the weights that were given."""
    return "\n".join(_lines(design, found, weighted))


def _lines(design: Design, found: BestWeights, weighted: Design) -> Iterator[str]:
    yield f"{design.name}: {design.graph.agents} agents, {len(design.graph.edges)} edges"
    yield f"  sigma with the chosen weights    {decimal(found.sigma, DIGITS)}, certified"
    if found.before is None:
        yield "  sigma as given                   none: Assumption 1 fails"
    else:
        yield f"  sigma as given, at the best mu   {decimal(found.before, DIGITS)}"
    if found.least > 0:
        yield f"  every choice of weights has      at least {rounded_down(found.least, DIGITS)}"
    gain = weighted.gamma
    yield f"  for mu = 1{'' if gain is None else f': gamma = {number_text(gain)} at the h of the design'}"
    yield ""
    yield "from  to  weight"
    yield from (f"{i:>4}  {j:>2}  {number_text(w)}" for i, j, w in found.graph.edges)
    yield from (f"{i:>4}  {j:>2}  0: the edge is left out" for i, j in found.dropped)
