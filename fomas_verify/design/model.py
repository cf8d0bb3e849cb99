"""A design: what is to be decided about, in exact numbers."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from fractions import Fraction
from typing import Any, Final, TypeAlias, overload

from fomas_verify.design.errors import DesignError
from fomas_verify.design.fields import shown
from fomas_verify.design.limits import NO_LIMITS, Limits
from fomas_verify.enclosure.interval import Interval
from fomas_verify.network import Digraph
from fomas_verify.network.large import LargeGraph

MOST_AGENTS_EXACTLY: Final = 100
"""Agents up to which a design is decided from exact matrices: seconds, which grow with the fourth power."""
MAX_LISTED_AGENTS: Final = 10_000
"""Agents up to which a graph is held with one Python object an edge."""
MAX_LISTED_EDGES: Final = 1 << 22
MAX_FAMILY_EDGES: Final = 1 << 20
"""Three lines of a design must not ask for a hundred million edges."""

State: TypeAlias = tuple[tuple[Fraction, ...], ...]


@dataclass(frozen=True, kw_only=True)
class Given:
    """What a design gives besides its graph, valid, every number exact.

    Attributes
    ----------
    name : str
        1 to 200 printable characters.
    alpha : Fraction
        Order of the Caputo derivative, 0 < alpha < 1, numerator and denominator below 2^64.
    gamma, mu : Fraction or None
        Control gain and integrated gain `mu = gamma h^alpha / Gamma(alpha + 1)`, > 0; at most one of them is given.
    h : Fraction or None
        Sampling period in seconds, > 0.
    x0 : tuple of tuples of Fraction or None
        Initial state: for each agent its n >= 1 numbers, n the same for every agent.
    horizon : int or None
        Last sample k up to which (14) is also checked sample by sample.
    settle_to : Fraction or None
        Share of the disagreement at which the agents count as settled, between 0 and 1.
    require : tuple of str
        Ids of the claims that must be proved, at least one, none twice.
    source : str
        The file it was read from, for messages.
    notes : tuple of str
        What the user must know about the reading of the numbers.
    limits : Limits
        What gamma and h have to keep to, for `region` and `synthesize`; no verdict depends on it.
    """

    name: str
    alpha: Fraction
    gamma: Fraction | None
    mu: Fraction | None
    h: Fraction | None
    x0: State | None
    horizon: int | None
    settle_to: Fraction | None
    require: tuple[str, ...]
    source: str
    notes: tuple[str, ...] = ()
    limits: Limits = NO_LIMITS

    @property
    def components(self) -> State | None:
        """x_0 by its components: n rows of N numbers."""
        return None if self.x0 is None else tuple(zip(*self.x0, strict=True))

    def needs(self, key: str, *, command: str) -> None:
        """Make sure that the design gives what a command needs.

        Parameters
        ----------
        key : str
            `"mu"`: mu, or gamma and h; or one of `"gamma"`, `"h"`, `"x0"`, `"horizon"`.
        command : str
            Name of the command, for the message.

        Raises
        ------
        DesignError
            It does not; the message names the missing key and the command.
        """
        if key == "mu":
            if self.mu is None and (self.gamma is None or self.h is None):
                missing = "h" if self.gamma is not None else "gamma" if self.h is not None else "mu"
                raise DesignError(f"{self.source}: {missing}: {command} needs mu, or gamma and h; got no {missing}")
        elif {"gamma": self.gamma, "h": self.h, "x0": self.x0, "horizon": self.horizon}[key] is None:
            raise DesignError(f"{self.source}: {key}: {command} needs {key}; got no {key}")


@dataclass(frozen=True, kw_only=True)
class Design(Given):
    """A valid design, every number exact.

    Attributes
    ----------
    graph : Digraph
        a_ij: agent i hears agent j.
    """

    graph: Digraph


@dataclass(frozen=True, kw_only=True)
class LargeDesign(Given):
    """A valid design, every number exact, with more agents than are decided from matrices.

    Attributes
    ----------
    graph : LargeGraph
        a_ij: agent i hears agent j.
    """

    graph: LargeGraph

    @classmethod
    def of(cls, design: Design) -> LargeDesign:
        """The same design, to be decided from bounds whatever its size."""
        return cls(**_given(design), graph=LargeGraph(listed=design.graph))

    def listed(self, *, most: int = MAX_LISTED_AGENTS) -> Design:
        """The same with one Python object an edge, for what needs that; raises `DesignError` beyond `most` agents."""
        agents, edges = self.graph.agents, self.graph.edge_count
        if agents > most or edges > (MAX_LISTED_EDGES if self.graph.family is None else MAX_FAMILY_EDGES):
            what = f"{shown(agents)} agents, more than {most}," if agents > most else f"{edges} edges"
            others = "prove, check, gate and kernel take them"
            raise DesignError(f"{self.source}: graph: {what} are not supported yet here; {others}")
        return Design(**_given(self), graph=self.graph.digraph())


def _given(design: Given) -> dict[str, Any]:
    return {field.name: getattr(design, field.name) for field in fields(Given)}


@dataclass(frozen=True)
class UncertainDesign:
    """A design of which some numbers lie anywhere in an interval; plant and controller share the alpha of each member.

    Attributes
    ----------
    least : Design
        The member with the lower end of every interval; whatever is not an interval is common to all members.
    ranges : mapping of str to Interval
        The intervals, at least one, under `"alpha"`, `"gamma"`, `"mu"`, `"h"`.
    """

    least: Design
    ranges: Mapping[str, Interval]

    def range_of(self, key: str) -> Interval | None:
        """The interval of `"alpha"`, `"gamma"`, `"mu"` or `"h"`, of one number where it is certain, None where it is
        absent.
        """
        if key in self.ranges:
            return self.ranges[key]
        x = {"alpha": self.least.alpha, "gamma": self.least.gamma, "mu": self.least.mu, "h": self.least.h}[key]
        return None if x is None else Interval.exactly(x)

    def member(self, alpha: Fraction, share: Fraction) -> Design:
        """The member with this alpha and with gamma, mu and h at this share of the way through their intervals."""
        gamma, mu, h = (
            None if x is None else x.lower + share * x.width for x in map(self.range_of, ("gamma", "mu", "h"))
        )
        return replace(self.least, alpha=alpha, gamma=gamma, mu=mu, h=h)


@dataclass(frozen=True)
class SwitchedDesign:
    """A design with digraphs to switch among: at each sample one of them, or a convex combination, holds.

    Attributes
    ----------
    first : Design
        With the first digraph, and the least mu where mu is an interval.
    graphs : tuple of Digraph
        1 to 64 of them, on the same agents, the first included.
    mu : Interval or None
        mu where the file gives it, an interval of one number where that is certain.
    """

    first: Design
    graphs: tuple[Digraph, ...]
    mu: Interval | None

    def with_graph(self, i: int) -> Design:
        """The design that keeps to one digraph."""
        return replace(self.first, graph=self.graphs[i])


AnyDesign: TypeAlias = Design | LargeDesign | UncertainDesign | SwitchedDesign
"""Whatever a design file may hold."""


@overload
def plain(named: Design | UncertainDesign | SwitchedDesign) -> Design: ...
@overload
def plain(named: AnyDesign) -> Design | LargeDesign: ...
def plain(named: AnyDesign) -> Design | LargeDesign:
    """What the members of an uncertain design have in common, and where each interval begins; the first graph."""
    if isinstance(named, SwitchedDesign):
        return named.first
    return named.least if isinstance(named, UncertainDesign) else named
