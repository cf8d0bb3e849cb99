"""What a report says, computed: the templates only place it."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from importlib.metadata import version
from pathlib import Path

from fomas_verify.claims.verdict import Verdict
from fomas_verify.design import Design
from fomas_verify.enclosure.interval import Interval
from fomas_verify.kernel.memory import second_difference, step_response
from fomas_verify.kernel.table import Row, kernel_rows
from fomas_verify.network import is_symmetric
from fomas_verify.network.matrices import adjacency
from fomas_verify.prover import Proof
from fomas_verify.report.checked import Checked
from fomas_verify.report.claim_view import Change, ClaimView, changes, claim_views
from fomas_verify.report.closed_forms import ClosedForm, closed_forms
from fomas_verify.report.graph_drawing import draw_graph, one_weight, shows_weights
from fomas_verify.report.latex_text import Tex
from fomas_verify.report.margin_view import binding, margin_lines
from fomas_verify.report.math_text import rational, sentence
from fomas_verify.report.memory_figure import MemoryFigure, memory_figure
from fomas_verify.report.picture import Picture
from fomas_verify.report.plot import Plot, Table
from fomas_verify.report.region_view import RegionView, region_view
from fomas_verify.report.simulation_view import SimulationView, simulation_view
from fomas_verify.report.spectrum_view import Spectrum, spectrum_view
from fomas_verify.spectrum.loop import Loop
from fomas_verify.spectrum.stability import mu_star

BITS = 128
LARGEST_MATRIX = 10
KERNEL_ROWS, KERNEL_DIGITS = (1, 2, 3, 4, 5, 10, 20, 50, 100, 1000), 12
_RELATIONS = {-1: "<", 0: "=", 1: ">"}
UNKNOWN = r"\overset{?}{=}"
_PAIRS = {
    "gain": ("mu", "inverse_degree", "gain-bound", "<", r"\ge"),
    "stability": ("mu", "mu_star", "perron-eigenvalues", "<", r"\ge"),
    "memory": ("beta", "threshold", "memory-inequality", r"\le", ">"),
    "repaired": ("sigma", "threshold", "repaired-condition", r"\le", ">"),
    "step": ("sigma", "beta", "beta-contraction", "=", ">"),  # sigma >= abs beta always
}
"""Relation -> left, right, the claim that decides, and the relation it proves or refutes."""


@dataclass(frozen=True)
class GraphView:
    """The graph's numbers and its picture; None where it is too large for one."""

    agents: int
    edges: int
    weight: Fraction | None
    shows_weights: bool
    symmetric: bool
    picture: Picture | None


@dataclass(frozen=True)
class Reproduction:
    """What another needs to see the same; no ``design_digest`` where the design came from no file."""

    command: str
    version: str
    flint: str
    sympy: str
    design_file: str
    design_digest: str | None
    certificate_digest: str
    checked: Checked


@dataclass(frozen=True)
class ReportModel:
    """All that the templates read."""

    design: Design
    values: Mapping[str, Interval]
    numbers: Mapping[str, Interval]
    relations: Mapping[str, Tex]
    graph: GraphView
    assumption1: bool
    claims: tuple[ClaimView, ...]
    changes: tuple[Change, ...]
    spectrum: Spectrum
    memory: MemoryFigure | None
    kernel: tuple[Row, ...]
    closed_forms: tuple[ClosedForm, ...]
    region: RegionView
    simulation: SimulationView | None
    margins: tuple[tuple[str, Tex], ...]
    binding: Tex
    adjacency: Tex | None
    proof: Proof
    reproduction: Reproduction

    @property
    def tables(self) -> tuple[Table, ...]:
        """The data of the figures."""
        memory = () if self.memory is None else (self.memory.table(),)
        return memory + (() if self.simulation is None else self.simulation.tables)

    @property
    def figures(self) -> dict[str, Picture | Plot]:
        """Every figure by name."""
        found: dict[str, Picture | Plot | None] = {"graph": self.graph.picture, "spectrum": self.spectrum.picture}
        if self.memory is not None:
            found["memory"], found["slack"] = self.memory.plots()
        found["region"] = self.region.plot
        if (seen := self.simulation) is not None:
            found |= {"states": seen.states, "distance": seen.distance, "control": seen.control}
        return {name: figure for name, figure in found.items() if figure is not None}

    @property
    def sizes(self) -> dict[str, Interval]:
        """The numbers that a comparison shows; what does not exist for the design is absent."""
        found, sizes = dict(self.numbers), self.proof.sizes
        if sizes.peak is not None:
            found["peak"] = sizes.peak.value
        if sizes.rate is not None:
            found |= {"kappa": Interval.exactly(sizes.rate.kappa), "rho": Interval.exactly(sizes.rate.rho)}
        return found

    @property
    def required(self) -> tuple[ClaimView, ...]:
        """The claims that the design requires."""
        return tuple(claim for claim in self.claims if claim.required)

    @property
    def unmet(self) -> tuple[ClaimView, ...]:
        """Those of them that are not proved."""
        return tuple(claim for claim in self.required if claim.verdict != Verdict.PROVED)


def report_model(proof: Proof, certificate: str, answer: Checked, command: str) -> ReportModel:
    """Compute what the report says; rigorous where it shows digits."""
    design, loop = proof.design, proof.loop
    claims = claim_views(proof)
    return ReportModel(
        design=design,
        values=proof.values,
        numbers=_numbers(loop),
        relations=_relations(proof),
        graph=_graph(design),
        assumption1=loop.assumption1,
        claims=claims,
        changes=tuple(changes(claims)),
        spectrum=spectrum_view(loop),
        memory=memory_figure(loop),
        kernel=tuple(kernel_rows(design.alpha, KERNEL_ROWS, KERNEL_DIGITS)),
        closed_forms=closed_forms(loop),
        region=region_view(loop),
        simulation=simulation_view(proof),
        margins=tuple((name, sentence(words)) for name, words in margin_lines(proof)),
        binding=sentence(binding(proof)),
        adjacency=_adjacency(design),
        proof=proof,
        reproduction=_reproduction(design, certificate, answer, command),
    )


def _numbers(loop: Loop) -> dict[str, Interval]:
    """The numbers of the text by name; those that do not exist for the design are absent."""
    mu, d, alpha = loop.mu(BITS), loop.degree_max, loop.design.alpha
    found = {
        "mu": mu,
        "degree_max": Interval.exactly(d),
        "mu_degree": mu * d,
        "mu_percent": mu * d * 100,
        "disc_centre": 1 - mu * d,
        "threshold": loop.threshold(BITS),
    }
    found |= {"lower_threshold": loop.lower_threshold(BITS), "f1": -second_difference(alpha, 1, BITS)}
    found |= {"c2": step_response(alpha, 2, BITS)}
    if d > 0:
        found["inverse_degree"] = Interval.exactly(1 / d)
    if (star := mu_star(loop, BITS)) is not None:
        found["mu_star"] = star
    if loop.assumption1:
        beta = loop.beta(BITS)
        found |= {"lambda2": loop.lambda2(BITS), "beta": beta, "sigma": loop.sigma(BITS)}
        found |= {"gap": loop.threshold(256) - loop.beta(256), "sigma_gap": found["sigma"] - found["threshold"]}
        found |= {"left0": beta + found["f1"], "left1": beta * beta + (1 - found["c2"])}
    return found


def _adjacency(design: Design) -> Tex | None:
    """The rows of A for a matrix; None where it is too large to print."""
    if design.graph.agents > LARGEST_MATRIX:
        return None
    return Tex(r"\\".join("&".join(rational(x) for x in row) for row in adjacency(design.graph)))


def _relations(proof: Proof) -> dict[str, Tex]:
    """How pairs of numbers compare: by their enclosures, and where these overlap by what the prover decided."""
    numbers = _numbers(proof.loop)
    found = {}
    for name, (left, right, claim, if_proved, if_refuted) in _PAIRS.items():
        if left in numbers and right in numbers:
            order = numbers[left].compare(numbers[right])
            by_verdict = {Verdict.PROVED: if_proved, Verdict.REFUTED: if_refuted}
            verdict = proof.decisions[claim].verdict
            found[name] = Tex(by_verdict.get(verdict, UNKNOWN) if order is None else _RELATIONS[order])
    return found


def _graph(design: Design) -> GraphView:
    graph = design.graph
    return GraphView(
        agents=graph.agents,
        edges=len(graph.edges),
        weight=one_weight(graph),
        shows_weights=shows_weights(graph),
        symmetric=is_symmetric(graph),
        picture=draw_graph(graph),
    )


def _reproduction(design: Design, certificate: str, answer: Checked, command: str) -> Reproduction:
    source = Path(design.source)
    return Reproduction(
        command=command,
        version=version("fomas_verify"),
        flint=version("python-flint"),
        sympy=version("sympy"),
        design_file=source.name,
        design_digest=hashlib.sha256(source.read_bytes()).hexdigest() if source.is_file() else None,
        certificate_digest=hashlib.sha256(certificate.encode()).hexdigest(),
        checked=answer,
    )
