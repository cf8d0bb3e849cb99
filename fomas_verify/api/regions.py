"""`region`: on which mu, and so on which (gamma, h), each condition holds."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from os import PathLike
from typing import TYPE_CHECKING, Any, TypeAlias

from fomas_verify.api.design import LOG, Design, Exact, exact_design
from fomas_verify.api.results import Cells, Certified
from fomas_verify.design import DesignError, LargeDesign, Limits, SwitchedDesign, UncertainDesign
from fomas_verify.enclosure.digits import rounded_down, rounded_up
from fomas_verify.region import Region as ExactRegion
from fomas_verify.region import certificate, find_region, record, region_text

if TYPE_CHECKING:
    from fomas_verify.region.switching_region import SwitchedRegion

Found: TypeAlias = "ExactRegion | SwitchedRegion"
Span: TypeAlias = tuple[Fraction, Fraction]

_SHOWN = 12


@dataclass(frozen=True)
class Strip:
    """The mu of one condition.

    Attributes
    ----------
    inner, outer : pair of Fraction, or None
        Every mu of `inner` is certified feasible, every mu outside `outer` certified infeasible; None where none is.
    alpha_opens : pair of Fraction, or None
        Encloses the alpha at which the condition opens; None where every alpha does, or none.
    """

    id: str
    inner: Span | None
    outer: Span | None
    alpha_opens: Span | None = None


@dataclass(frozen=True, eq=False, repr=False)
class Region(Certified):
    """What was found about the mu of a design."""

    design: Design
    found: Found

    @property
    def exit_status(self) -> int:
        """0: the work is done."""
        return 0

    @cached_property
    def strips(self) -> dict[str, Strip]:
        """By the conditions' ids."""
        return {entry["id"]: _strip(entry) for entry in self.record["conditions"]}

    @cached_property
    def record(self) -> dict[str, Any]:
        """What ``verify-design region --json`` prints, the limits' polyhedra included."""
        return record(self.found, self._left) if isinstance(self.found, ExactRegion) else self.found.record()

    @cached_property
    def certificate(self) -> str:
        """The certificate's canonical text."""
        return certificate(self.found) if isinstance(self.found, ExactRegion) else self.found.certificate()

    @cached_property
    def _left(self) -> tuple[Any, ...]:
        if not isinstance(self.found, ExactRegion) or self.found.loop.design.limits == Limits():
            return ()
        from fomas_verify.region.polygon import rooms

        return rooms(self.found)

    def __str__(self) -> str:
        if isinstance(self.found, ExactRegion):
            return region_text(self.found, self._left)
        from fomas_verify.report.switched_text import switched_region_text

        return switched_region_text(self.found)

    def __repr__(self) -> str:
        return f"<Region of {self.design.name!r}: {', '.join(name for name, x in self.strips.items() if x.inner)}>"

    def _table(self) -> tuple[str, Cells]:
        rows = [(name, _ends(strip.inner)) for name, strip in self.strips.items()]
        return self.design.name, [("condition", "holds for mu"), *rows]


def region(design: Design | Exact | str | PathLike[str]) -> Region:
    """Find the certified feasible mu of every condition. Rigorous.

    Parameters
    ----------
    design : Design or path
        Gamma, mu and h are not needed; several graphs are taken, intervals are not.

    Returns
    -------
    Region
        The strips of mu and their certificate.

    Raises
    ------
    FomasError
        The graph has no edge, a number is an interval (`exit_status` 2), or it was not decided within the work allowed
        (3).

    Examples
    --------
    >>> found = region(Design(alpha="9/10", graph="directed-cycle", agents=3))
    >>> found.strips["gain-bound"].outer
    (Fraction(0, 1), Fraction(1, 1))
    """
    exact = exact_design(design)
    if isinstance(exact, UncertainDesign):
        where = next(iter(exact.ranges))
        raise DesignError(f"{exact.least.source}: {where}: expected a number, got an interval")
    if isinstance(exact, SwitchedDesign):
        from fomas_verify.region.switching_region import find_switched_region

        found: Found = find_switched_region(exact)
    else:
        found = find_region(exact.listed() if isinstance(exact, LargeDesign) else exact)
    answer = Region(design if isinstance(design, Design) else Design.of(exact), found)
    LOG.info("%r", answer)
    return answer


def _strip(entry: Mapping[str, Any]) -> Strip:
    mu, opens = entry.get("mu"), entry.get("alpha_opens")
    inner, outer = (None if mu is None else (Fraction(mu[key][0]), Fraction(mu[key][1])) for key in ("inner", "outer"))
    alpha = None if opens is None else (Fraction(opens["lower"]), Fraction(opens["upper"]))
    return Strip(entry["id"], inner, outer, alpha)


def _ends(span: Span | None) -> str:
    return "none" if span is None else f"{rounded_up(span[0], _SHOWN)} to {rounded_down(span[1], _SHOWN)}"
