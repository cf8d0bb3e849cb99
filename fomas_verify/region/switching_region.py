"""For which mu a set of digraphs can be switched among, as far as one quadratic form shows it: an interval (0, t*).

Source: docs/certificate-format.md, section 10; theory, section 11.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any

from fomas_verify.certificate.document import plain
from fomas_verify.certificate.switching_document import CONDITIONS, switched_region_text
from fomas_verify.claims.verdict import Verdict
from fomas_verify.design import DesignError, SwitchedDesign
from fomas_verify.enclosure.interval import short_dyadic
from fomas_verify.region.common_form import SOLVER
from fomas_verify.region.common_search import Search
from fomas_verify.region.errors import UndecidedRegionError
from fomas_verify.region.find import STABILITY_GAPS
from fomas_verify.region.switching import MOST_AGENTS, Searcher
from fomas_verify.spectrum import margins
from fomas_verify.spectrum.loop import Loop
from fomas_verify.spectrum.margins import FINE, above, below
from fomas_verify.spectrum.stability import lower_triangle

GAPS = (36, 32, 28, 24, 20, 16, 12, 8)
"""Either side of the solver's t* is passed by 2^-g to 2^(1-g) of it, the first for which an exact test passes."""


@dataclass(frozen=True)
class SwitchedStrip:
    """The mu > 0 of one condition: every mu of ``inner``, none above ``outer``; or empty."""

    condition: str
    inner: tuple[Fraction, Fraction] | None
    outer: Fraction = Fraction(0)
    witness: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class SwitchedRegion:
    """The two strips of a design."""

    design: SwitchedDesign
    strips: tuple[SwitchedStrip, ...]

    def record(self) -> dict[str, Any]:
        """What ``region --json`` prints."""
        return {"conditions": [_record(strip) for strip in self.strips]}

    def certificate(self) -> str:
        """The certificate's canonical text."""
        from importlib.metadata import version

        return switched_region_text(self.design, map(_claim, self.strips), version("fomas_verify"))


def find_switched_region(design: SwitchedDesign, searcher: Searcher = Search.of) -> SwitchedRegion:
    """The mu for which one form decreases under every digraph, and those of (15).

    Raises
    ------
    DesignError
        No graph has an edge, or mu is an interval.
    UndecidedRegionError
        More agents than the work allows, or nothing was found near the end of the interval.
    """
    source = design.first.source
    if design.mu is not None and not design.mu.is_exact:
        raise DesignError(
            f"{source}: mu: expected a number, got an interval: of [[graphs]] only prove and check take one"
        )
    if design.first.graph.agents > MOST_AGENTS:
        raise UndecidedRegionError(f"{source}: more than {MOST_AGENTS} agents are beyond [[graphs]] for now: undecided")
    loops = [Loop(design.with_graph(i)) for i in range(len(design.graphs))]
    degree = max(loop.degree_max for loop in loops)
    if degree == 0:
        raise DesignError(f"{source}: graphs: region needs at least one edge; got none")
    gain = below(1 / degree, FINE)
    strips = [SwitchedStrip("gain-bound", (_tiny(gain), gain), 1 / degree, {})]
    together = all(loop.assumption1 for loop in loops)
    strips.append(_common_form(source, searcher(loops)) if together else SwitchedStrip("common-form", None))
    return SwitchedRegion(design, tuple(strips))


def _tiny(end: Fraction) -> Fraction:
    return short_dyadic(end / (1 << FINE), end / (1 << FINE - 1))


def _common_form(source: str, search: Search) -> SwitchedStrip:
    alone = [margins.perron_eigenvalues(loop, STABILITY_GAPS) for loop in search.loops]
    ends = [(found.outer[1], i, found) for i, found in enumerate(alone, 1) if found is not None]
    if len(ends) != len(alone):
        raise UndecidedRegionError(f"{source}: mu* of a graph was not decided within the work allowed")
    most, first, single = min(ends, key=lambda end: end[0])
    low, high = search.limit(single.upper.lower)
    # Below 1/D the norm decreases, whatever a solver says.
    starts = low, 1 / max(loop.degree_max for loop in search.loops)
    tried = (search.form(below(start, gap)) for start in starts for gap in GAPS)
    form = next((form for form in tried if form is not None), None)
    if form is None:
        raise UndecidedRegionError(f"{source}: common-form: not decided within the work allowed")
    outer, shown = most, {"graph": first} | {key: x for key, x in single.witness.items() if key in ("power", "Y")}
    for gap in GAPS:
        t = above(high, gap)
        if t < most and (dual := search.dual(t)) is not None:
            outer, shown = t, {"Z": [lower_triangle(z) for z in dual], "solver": SOLVER}
            break
    return SwitchedStrip("common-form", (_tiny(form.t), form.t), outer, dict(form.witness) | shown)


def _record(strip: SwitchedStrip) -> dict[str, Any]:
    found: dict[str, Any] = {"id": strip.condition, "empty": strip.inner is None}
    if strip.inner is not None:
        found["mu"] = {"inner": plain(strip.inner), "outer": plain([Fraction(0), strip.outer])}
    return found | {"alpha_opens": None}


def _claim(strip: SwitchedStrip) -> dict[str, Any]:
    witness: dict[str, Any] = {}
    if strip.inner is not None:
        witness["mu"] = {"inner": strip.inner, "outer": [Fraction(0), strip.outer], **strip.witness}
    return {
        "id": strip.condition,
        "verdict": (Verdict.REFUTED if strip.inner is None else Verdict.PROVED).value,
        "statement": CONDITIONS[strip.condition],
        "witness": witness,
    }
