"""From a large design to its verdicts, values and certificate. Meaning of each: docs/semantics.md, "Large networks"."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, replace
from math import lcm
from pathlib import Path
from typing import Any

from fomas_verify.certificate.large_document import edge_list_name, graph_entry, large_certificate_text
from fomas_verify.claims.verdict import Decision
from fomas_verify.design import DesignError, LargeDesign
from fomas_verify.enclosure.interval import Interval
from fomas_verify.enclosure.real import square_root
from fomas_verify.exact.memory import memory_for_factors
from fomas_verify.kernel.horizon import Horizon, check_horizon
from fomas_verify.network.large import TooManyEdgesError, graph_facts, need_scale
from fomas_verify.network.quotients import image, quotients
from fomas_verify.prover.large_claims import Start, decide_all, first_failure
from fomas_verify.prover.large_matrices import decided_by_matrices
from fomas_verify.prover.prove import (
    DEFAULT_DIGITS,
    compare_with_closed_form,
    compare_with_mpmath,
    exit_status_of,
    value_bits,
)
from fomas_verify.spectrum.large import LargeBounds, large_bounds
from fomas_verify.spectrum.large_loop import LargeLoop, enclosed_gain

SOLVER = "scipy"
NO_SETTLING = "settle_to: settling is not measured of more than 100 agents yet"
MOST_BITS = 900
"""Of a value in the certificate: the checker's enclosures have 1024."""
MOST_VECTOR_TEXT = 40 << 20
"""Characters of all vectors in the certificate, which has at most 64 MiB."""
MOST_STATE_BITS = 2**30
"""Of an initial state over one denominator."""

_GAIN_BITS = 128


@dataclass(frozen=True, eq=False)
class LargeProof:
    """All that was found about a large design."""

    design: LargeDesign
    loop: LargeLoop
    values: Mapping[str, Interval]
    decisions: Mapping[str, Decision]
    horizon: Horizon | None

    @property
    def exit_status(self) -> int:
        """As of :class:`~fomas_verify.prover.Proof`."""
        return exit_status_of(self.design.require, self.decisions)

    @property
    def notes(self) -> tuple[str, ...]:
        """What was not affordable, and what is not measured of a large network; a line each."""
        reason = () if self.loop.bounds.reason is None else (self.loop.bounds.reason,)
        settling = () if self.design.settle_to is None else (NO_SETTLING,)
        return reason + settling

    @property
    def edge_list(self) -> bytes | None:
        """What lies beside the certificate; None for a family's graph, which needs nothing."""
        return None if self.loop.family is not None else self.design.graph.edge_list

    def certificate(self, file: str) -> str:
        """The certificate's text where that is written to a file of this name; its edge list is named after it."""
        from importlib.metadata import version

        values = {name: {"lower": x.lower, "upper": x.upper} for name, x in self.values.items()}
        return large_certificate_text(
            self.design,
            graph_entry(self.design.graph, file),
            _spectrum(self.loop.bounds),
            values,
            self.decisions,
            version("fomas_verify"),
        )

    def files(self, certificate: Path) -> dict[Path, bytes]:
        """What to write: the edge list, where there is one, and then the certificate."""
        edges = self.edge_list
        content = {certificate: self.certificate(certificate.name).encode()}
        if edges is None or certificate.is_dir():  # which whoever writes refuses
            return content
        if certificate.absolute().parts[1:2] == ("dev",) or (certificate.exists() and not certificate.is_file()):
            raise DesignError(f"{certificate}: expected a file for the certificate, since an edge list lies beside it")
        return {certificate.with_name(edge_list_name(certificate.name, self.design.graph.digest)): edges, **content}


def prove_large(
    design: LargeDesign,
    *,
    horizon: int | None = None,
    digits: int = DEFAULT_DIGITS,
    only: Collection[str] | None = None,
    memory: int | None = None,
) -> LargeProof:
    """Decide every claim about a large design, or only some.

    Parameters
    ----------
    design : LargeDesign
        With mu, or gamma and h; of any size.
    horizon : int, optional
        Check (14) also at the samples k = 0..horizon, term by term; the design's own horizon by default.
    digits : int
        Significant decimal digits of the values that are known so well, at least 20.
    only : collection of str, optional
        Ids of the claims to decide. A horizon is checked with memory-inequality only.
    memory : int, optional
        Bytes that a factor may take; half of what there is by default. Without a factor there are weaker bounds.

    Returns
    -------
    LargeProof
        Verdicts and enclosures; rigorous. Where bounds decide a claim neither way it is undecided, even if it is true;
        of at most 200 agents matrices decide consensus where bounds do not.

    Raises
    ------
    TooManyEdgesError
        The graph, or of a family what x_0 asks for, has more edges than are built.
    MissingExtraError
        numpy, scipy or qdldl is not installed; of a family's graph only x_0 needs them.
    DisagreementError
        Two computations that must agree do not.
    """
    design.needs("mu", command="prove")
    loop = _loop(design, memory_for_factors() if memory is None else memory)
    start = _start(design) if loop.assumption1 and design.x0 is not None else Start()
    decisions = decide_all(loop, start, lambda name: only is None or name in only)
    decisions = decided_by_matrices(design, decisions)
    bits = min(value_bits(digits, loop.mu(64).upper, loop.degree_max), MOST_BITS)
    values = _values(loop, bits)
    compare_with_mpmath(design, values, min(digits, DEFAULT_DIGITS))
    samples = design.horizon if horizon is None else horizon
    seen = None
    if samples is not None and loop.assumption1 and "memory-inequality" in decisions:
        seen = check_horizon(design.alpha, loop.beta(bits), samples, digits)
        decision = decisions["memory-inequality"]
        compare_with_closed_form(seen, replace(decision, witness={"k": first_failure(loop, decision)}))
    return LargeProof(design, loop, values, decisions, seen)


def _loop(design: LargeDesign, memory: int) -> LargeLoop:
    family = design.graph.known_family
    facts = graph_facts(design.graph)
    if family is not None or not facts.assumption1:
        return LargeLoop(design, facts, family)
    need_scale(design.graph.agents, "numpy", "scipy", "qdldl")
    graph = design.graph.sparse
    found = large_bounds(graph, enclosed_gain(design, _GAIN_BITS).ends, memory=memory)
    found = replace(found, vectors=tuple(_that_fit(found.vectors)))
    return LargeLoop(design, facts, None, found, tuple(quotients(graph, [vector]) for vector in found.vectors))


def _that_fit(vectors: Iterable[tuple[int, ...]]) -> Iterable[tuple[int, ...]]:
    """The first vectors, as long as the certificate has room for their text."""
    used = 0
    for vector in vectors:
        used += sum(map(len, map(str, vector))) + 2 * len(vector)
        if used > MOST_VECTOR_TEXT:
            return
        yield vector


def _start(design: LargeDesign) -> Start:
    """What L x_0 says; nothing where that is beyond the work allowed."""
    rows = design.components or ()
    entries = [x for row in rows for x in row]
    common, longest = 1, max(abs(x.numerator).bit_length() for x in entries)
    for denominator in {x.denominator for x in entries}:
        common = lcm(common, denominator)
        if (common.bit_length() + longest) * len(entries) > MOST_STATE_BITS:
            return Start()
    try:
        graph = design.graph.sparse
    except TooManyEdgesError:
        return Start()
    columns = [image(graph, [int(x * common) for x in row]) for row in rows]
    return Start(False, quotients(graph, columns)) if any(map(any, columns)) else Start(True)


def _values(loop: LargeLoop, bits: int) -> dict[str, Interval]:
    found = {"mu": loop.mu(bits)}
    if loop.assumption1:
        sigma = square_root(loop.sigma_square(bits), bits)
        found |= {"beta": loop.beta(bits), "sigma": sigma, "lambda2": loop.lambda2(bits)}
    found |= {"threshold": loop.threshold(bits), "degree_max": Interval.exactly(loop.degree_max)}
    return {name: x.rounded(120 if name == "sigma" else bits - 16) for name, x in found.items()}


def _spectrum(bounds: LargeBounds) -> dict[str, Any]:
    given = {
        "vectors": [list(vector) for vector in bounds.vectors] or None,
        "lambda2_lower": bounds.lambda2_lower,
        "lambda_max_upper": bounds.lambda_max_upper,
        "sigma_upper": bounds.sigma_upper,
    }
    found = {key: value for key, value in given.items() if value is not None}
    return found | ({"solver": SOLVER} if found else {})
