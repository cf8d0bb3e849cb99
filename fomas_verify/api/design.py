"""A design, as a user of Python writes it."""

from __future__ import annotations

import logging
from collections.abc import Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

from fomas_verify.api.graphs import graph_table
from fomas_verify.api.values import plain
from fomas_verify.design import AnyDesign, DesignError, LargeDesign, SwitchedDesign, UncertainDesign, read_named
from fomas_verify.design import Design as ExactDesign
from fomas_verify.design import plain as plain_design
from fomas_verify.design.model import Given
from fomas_verify.design.reading import named_from_mapping
from fomas_verify.network.large import LargeGraph

if TYPE_CHECKING:
    from control import StateSpace

Exact: TypeAlias = AnyDesign
Number: TypeAlias = int | float | str | Fraction
"""A float is its shortest decimal; a text is a decimal or a fraction such as "9/10"."""

LOG = logging.getLogger("fomas_verify")


class Design:
    """What is to be decided about: the order, the gain and the period of a sampled-data consensus law, and its graph.

    Every number is exact: 0.9 is 9/10. What must be known about the reading stands in `notes`.

    Parameters
    ----------
    alpha : number or pair of numbers
        Order of the Caputo derivative, between 0 and 1; a pair is an interval, as for `gamma`, `mu` and `h`.
    graph : object
        A networkx graph; a square matrix of numpy, scipy or pandas, with `orientation`; rows ``a_ij`` (agent i hears
        j); edges ``(from, to)`` or ``(from, to, weight)`` with `agents`; the name of a family with `agents` or
        `shape`; or a `pathlib.Path` of a graph file.
    graphs : sequence, optional
        In place of `graph`: graphs on the same agents, to switch among.
    gamma, mu : number or pair of numbers, optional
        Control gain, or the integrated gain ``mu = gamma h^alpha / Gamma(alpha + 1)`` in place of it, > 0.
    h : number or pair of numbers, optional
        Sampling period in seconds, > 0.
    x0 : sequence or array, optional
        Initial state: N numbers, or N lists of n numbers.
    name : str, optional
        For reports.
    settle_to : number, optional
        Share of the disagreement at which the agents count as settled.
    horizon : int, optional
        Also check (14) sample by sample, k = 0..horizon.
    require : sequence of str, optional
        Ids of the claims that must be proved.
    limits : mapping, optional
        For `region` and `synthesize`: ``h`` and ``gamma`` as pairs, ``u_max``, ``settle_within``.
    orientation : {"hears", "from-to"}, optional
        Of the entry (i, j) of a matrix: i hears j, or j hears i. A matrix does not say it, so that it must be given.
    agents, shape : int, pair of int, optional
        With edges and with a family.

    Raises
    ------
    FomasError
        With one line that names the key and what was expected.

    Examples
    --------
    >>> design = Design(alpha=0.9, mu="1/10", graph="directed-cycle", agents=3)
    >>> design.alpha, design.agents
    (Fraction(9, 10), 3)
    >>> design.notes
    ('alpha: binary floats are read as their shortest decimals (0.1 is 1/10)',)
    """

    exact: Exact
    """The design with exact numbers, as the package's rooms know it."""

    def __init__(
        self,
        *,
        alpha: Any,
        graph: Any = None,
        graphs: Sequence[Any] | None = None,
        gamma: Any = None,
        mu: Any = None,
        h: Any = None,
        x0: Any = None,
        name: str | None = None,
        settle_to: Number | None = None,
        horizon: int | None = None,
        require: Sequence[str] | None = None,
        limits: Mapping[str, Any] | None = None,
        orientation: str | None = None,
        agents: int | None = None,
        shape: Sequence[int] | None = None,
    ) -> None:
        given = {
            "name": name, "alpha": alpha, "gamma": gamma, "mu": mu, "h": h, "x0": x0, "horizon": horizon,
            "settle_to": settle_to, "limits": limits, "gate": None if require is None else {"require": require},
        }  # fmt: skip
        top = {key: plain(value) for key, value in given.items() if value is not None}
        remarks: list[str] = []
        if graph is not None:
            top["graph"], found = graph_table(graph, orientation, agents, shape)
            remarks += found
        if graphs is not None:
            tables = [graph_table(each, orientation, agents, shape) for each in graphs]
            top["graphs"] = [table for table, _ in tables]
            remarks += dict.fromkeys(remark for _, found in tables for remark in found)
        self.exact = _with_notes(named_from_mapping(top), remarks)
        _log_notes(self)

    @classmethod
    def read(cls, path: str | PathLike[str], *, allow_outside: bool = False) -> Design:
        """Read a design file, TOML or JSON; its graph file lies in its folder, or anywhere if `allow_outside`."""
        return cls.of(read_named(path, allow_outside=allow_outside))

    @classmethod
    def of(cls, exact: Exact) -> Design:
        """The design with these exact numbers."""
        design = cls.__new__(cls)
        design.exact = exact
        _log_notes(design)
        return design

    @property
    def name(self) -> str:
        """Its name."""
        return plain_design(self.exact).name

    @property
    def notes(self) -> tuple[str, ...]:
        """What must be known about the reading of its numbers and its graph."""
        return plain_design(self.exact).notes

    @property
    def agents(self) -> int:
        """The number N of agents."""
        return plain_design(self.exact).graph.agents

    @property
    def edges(self) -> tuple[tuple[int, int, Fraction], ...]:
        """``(from, to, weight)``: agent `to` hears `from`; of several graphs those of the first."""
        graph = plain_design(self.exact).graph
        return graph.digraph().edges if isinstance(graph, LargeGraph) else graph.edges

    @property
    def alpha(self) -> Fraction | tuple[Fraction, Fraction]:
        """The order, or its interval."""
        found = self._number("alpha")
        if found is None:
            raise TypeError("a design without an order")
        return found

    @property
    def gamma(self) -> Fraction | tuple[Fraction, Fraction] | None:
        """The gain, or its interval; None where it is not given."""
        return self._number("gamma")

    @property
    def mu(self) -> Fraction | tuple[Fraction, Fraction] | None:
        """The integrated gain, or its interval; None where gamma is given in place of it."""
        return self._number("mu")

    @property
    def h(self) -> Fraction | tuple[Fraction, Fraction] | None:
        """The sampling period in seconds, or its interval; None where it is not given."""
        return self._number("h")

    def _number(self, key: str) -> Fraction | tuple[Fraction, Fraction] | None:
        exact = self.exact
        found = exact.ranges.get(key) if isinstance(exact, UncertainDesign) else None
        if isinstance(exact, SwitchedDesign) and key == "mu":
            found = exact.mu
        if found is not None and not found.is_exact:
            return found.lower, found.upper
        number: Fraction | None = getattr(plain_design(exact), key)
        return number

    def certain(self, what: str) -> ExactDesign:
        """The exact design for what takes one graph, of at most 10,000 agents, and no interval; raises `DesignError`
        for any other.
        """
        if isinstance(self.exact, LargeDesign):
            return self.exact.listed()
        if not isinstance(self.exact, ExactDesign):
            kind = "one graph" if isinstance(self.exact, SwitchedDesign) else "numbers, got an interval"
            raise DesignError(f"{plain_design(self.exact).source}: {what}: expected a design with {kind}")
        return self.exact

    def save(self, path: str | PathLike[str]) -> None:
        """Write it as a design file, TOML, every number exact; whole or not at all."""
        from fomas_verify.region.design_file import design_text
        from fomas_verify.report.files import write_whole

        write_whole(Path(path), design_text(self.certain("save"), "written by fomas_verify").encode())

    def to_control(self) -> StateSpace:
        """The sampled closed loop ``x_{k+1} = P x_k``, ``P = I - mu L``, for python-control; in binary floats.

        Returns
        -------
        control.StateSpace
            N states (each component of x has its own copy), no input, the states as outputs, ``dt = h``. It is the
            loop at the samples, in which the memory of the plant and that of the controller cancel; it says nothing of
            the control u, nor of what lies between the samples.

        Raises
        ------
        DesignError
            The design has no h, or neither gamma nor mu, an interval or several graphs.
        MissingExtraError
            python-control is not installed: the extra `control`.
        """
        from fomas_verify.api.controlling import sampled_loop

        return sampled_loop(self.certain("to_control"))

    def __repr__(self) -> str:
        numbers = ((key, self._number(key)) for key in ("alpha", "gamma", "mu", "h"))
        given = ", ".join(f"{key}={_shown(x)}" for key, x in numbers if x is not None)
        return f"<Design {self.name!r}: {given}, {self.agents} agents>"


def exact_design(design: Design | Exact | str | PathLike[str]) -> Exact:
    """The exact design of what `prove` and its like are given: a `Design`, or the path of a design file."""
    if isinstance(design, Design):
        return design.exact
    if isinstance(design, str | PathLike):
        return Design.read(design).exact
    return design


def _shown(x: Fraction | tuple[Fraction, Fraction]) -> str:
    return f"[{x[0]}, {x[1]}]" if isinstance(x, tuple) else str(x)


def _with_notes(exact: Exact, remarks: Sequence[str]) -> Exact:
    def noted(design: Given) -> dict[str, Any]:
        return {"notes": (*design.notes, *remarks)}

    match exact:
        case UncertainDesign():
            return replace(exact, least=replace(exact.least, **noted(exact.least)))
        case SwitchedDesign():
            return replace(exact, first=replace(exact.first, **noted(exact.first)))
        case _:
            return replace(exact, **noted(exact))


def _log_notes(design: Design) -> None:
    for note in design.notes:
        LOG.info("%s: %s", design.name, note)
