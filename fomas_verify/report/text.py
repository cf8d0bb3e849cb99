"""What was found about a design, for a terminal."""

from __future__ import annotations

import textwrap
from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction

from fomas_verify.claims.registry import CLAIMS
from fomas_verify.claims.verdict import Decision, Verdict
from fomas_verify.design import Design, LargeDesign
from fomas_verify.enclosure.digits import decimal, exact_decimal, rounded_down, rounded_up
from fomas_verify.enclosure.interval import Interval
from fomas_verify.enclosure.roots import Root, root_of
from fomas_verify.exact.rational import format_rational
from fomas_verify.kernel.horizon import Horizon
from fomas_verify.prover import Proof, UncertainProof
from fomas_verify.prover.sizes import Sizes
from fomas_verify.report.margin_view import binding, margin_lines
from fomas_verify.spectrum.stability import Side, stability

WIDTH = 120
DIGITS = 30
SHOWN_EIGENVALUES = 24
SHOWN_ENTRIES = 12
NAME_WIDTH = max(len(claim.ID) for claim in CLAIMS)

NAMES = {
    "mu": "mu = gamma h^alpha / Gamma(alpha+1)",
    "beta": "beta = 1 - mu lambda2",
    "sigma": "sigma = norm of P on 1perp",
    "lambda2": "lambda2(L_s)",
    "threshold": "2^alpha - 1",
    "degree_max": "Delta_max",
}


def proof_text(proof: Proof) -> str:
    """The verdict table, the values, the spectrum, what a refutation means, and how it ends."""
    parts = [
        heading(proof.design),
        verdict_table(proof.decisions, proof.design.require),
        _values(proof),
        _spectrum(proof),
    ]
    if proof.sizes.rate is not None:
        parts.append(_sizes(proof.sizes))
    if proof.margins:
        parts.append(_margins(proof))
    if proof.horizon is not None:
        parts.append(horizon_text(proof.horizon))
    parts += [refutation_text(name, x) for name, x in proof.decisions.items() if x.verdict is Verdict.REFUTED]
    parts.append(ending(proof.decisions, proof.design.require))
    return "\n".join(parts)


def uncertain_text(proof: UncertainProof) -> str:
    """The same of an uncertain design: the values are the ranges over its members."""
    design = proof.design
    given = {key: design.range_of(key) for key in ("alpha", "gamma", "mu", "h")}
    shown = ", ".join(f"{key} = {_range(x)}" for key, x in given.items() if x is not None)
    graph = design.least.graph
    heading = f"{design.least.name}: {shown}; {graph.agents} agents, {len(graph.edges)} edges"
    width = max(map(len, NAMES.values()))
    ranges = [f"  {NAMES.get(name, name):{width}}  {_range(x)}" for name, x in proof.values.items()]
    parts = ["\n".join([heading, *(f"note: {note}" for note in design.least.notes)]) + "\n"]
    parts += [verdict_table(proof.decisions, design.least.require), "\n".join(ranges) + "\n"]
    parts += [refutation_text(name, x) for name, x in proof.decisions.items() if x.verdict is Verdict.REFUTED]
    parts.append(ending(proof.decisions, design.least.require))
    return "\n".join(parts)


def _range(x: Interval) -> str:
    return decimal(x, 20) if x.is_exact else f"[{_end(x.lower, rounded_down)}, {_end(x.upper, rounded_up)}]"


def _end(x: Fraction, rounded: Callable[[Fraction, int], str]) -> str:
    """An end of a range: exactly where that is short, else rounded outward."""
    for exact in (exact_decimal(x, 12), format_rational(x)):
        if exact is not None and len(exact) <= 20:
            return exact
    return rounded(x, 12)


def heading(design: Design | LargeDesign) -> str:
    """The design in a line, and the notes on its reading."""
    numbers = [("alpha", design.alpha), ("gamma", design.gamma), ("mu", design.mu), ("h", design.h)]
    given = ", ".join(f"{name} = {decimal(Interval.exactly(x), 20)}" for name, x in numbers if x is not None)
    edges = design.graph.edge_count if isinstance(design, LargeDesign) else len(design.graph.edges)
    lines = [f"{design.name}: {given}; {design.graph.agents} agents, {edges} edges"]
    return "\n".join(lines + [f"note: {note}" for note in design.notes]) + "\n"


def verdict_table(decisions: Mapping[str, Decision], require: Sequence[str]) -> str:
    """A paragraph for each claim: whether it is required, its verdict, the numbers that decide."""
    lines = []
    for name, decision in decisions.items():
        mark = "*" if name in require else " "
        head = f"{mark} {name:{NAME_WIDTH}}  {decision.verdict.value:<14}"
        lines += textwrap.wrap(head + decision.reason, WIDTH, subsequent_indent=" " * len(head))
    return "\n".join([*lines, "(* required)"]) + "\n"


def _values(proof: Proof) -> str:
    width = max(map(len, NAMES.values()))
    return "\n".join(f"  {NAMES[name]:{width}}  {decimal(x, DIGITS)}" for name, x in proof.values.items()) + "\n"


def _spectrum(proof: Proof) -> str:
    """The eigenvalues, and the enclosures of those of P other than 1: Gershgorin's disc, the numerical range, sigma."""
    loop, bits = proof.loop, 128
    mu, d = loop.mu(bits), loop.degree_max
    roots = loop.disagreement_eigenvalues(bits)
    center, radius = decimal(1 - mu * d, 12), decimal(mu * d, 12)
    lines = [f"  eigenvalues of L: {listed(zero_and(roots))}"]
    lines += [f"  eigenvalues of P other than 1: {listed(of_perron(roots, mu))}"]
    shifted = f"z + {center[1:]}" if center.startswith("-") else f"z - {center}"
    bounds = [f"abs({shifted}) <= {radius} (Gershgorin)"]
    if "sigma" in proof.values:
        bounds += [f"Re z <= beta = {decimal(proof.values['beta'], 12)} (numerical range)"]
        bounds += [f"abs z <= sigma = {decimal(proof.values['sigma'], 12)}"]
    lines += [f"  each of these z: {'; '.join(bounds)}"]
    found = stability(loop)
    star = "0 (never)" if found.mu_star is None and found.side is Side.BOUNDARY else "(not enclosed)"
    star = star if found.mu_star is None else decimal(found.mu_star, 20)
    lines += [f"  they lie in the open unit disc iff 0 < mu < mu* = {star}"]
    return (
        "\n".join("\n".join(textwrap.wrap(x, WIDTH, initial_indent="  ", subsequent_indent="    ")) for x in lines)
        + "\n"
    )


def zero_and(roots: list[Root]) -> list[Root]:
    """The eigenvalues of L: 0, of the vector 1, and the others."""
    return [root_of(Interval.exactly(0), Interval.exactly(0), 1), *roots]


def of_perron(roots: list[Root], mu: Interval) -> list[Root]:
    """``1 - mu lambda`` for each."""
    return [root_of(1 - mu * root.real, -(mu * root.imag), root.multiplicity) for root in roots]


def listed(roots: list[Root]) -> str:
    """Eigenvalues in a line, conjugate pairs as one: ``0, 2, 2 +- i, 3``."""
    shown = [text for root in roots if (text := _eigenvalue(root))]
    if len(shown) <= SHOWN_EIGENVALUES:
        return ", ".join(shown)
    return ", ".join(shown[:SHOWN_EIGENVALUES]) + f", ... ({sum(root.multiplicity for root in roots)} in all)"


def _eigenvalue(root: Root) -> str:
    times = f" ({root.multiplicity} times)" if root.multiplicity > 1 else ""
    real = decimal(root.real, 12)
    if root.imag == Interval.exactly(0):
        return real + times
    if root.imag.mid < 0:
        return ""
    size = decimal(root.imag, 12)
    return f"{real} +- {'' if size == '1' else size + ' '}i{times}"


def _sizes(sizes: Sizes) -> str:
    """How large the control gets and how fast the agents agree."""
    lines = []
    if sizes.peak is not None:
        peak = decimal(sizes.peak.value, 18)
        lines.append(f"peak of norm u_k / norm u_0 over every k and x_0: {peak}, at k = {sizes.peak.at}")
    if sizes.rate is not None:
        kappa, rho = (decimal(Interval.exactly(x), 12) for x in (sizes.rate.kappa, sizes.rate.rho))
        lines.append(
            f"norm(x_k - mean) <= kappa rho^k norm(x_0 - mean): kappa = {kappa}, rho = {rho}; also 1 and sigma"
        )
    if sizes.settling is not None and sizes.settle_to is not None:
        time = "" if sizes.settling_time is None else f", t = {decimal(Interval.exactly(sizes.settling_time), 12)}"
        lines.append(
            f"norm(x_k - mean) <= {format_rational(sizes.settle_to)} norm(x_0 - mean) from k = {sizes.settling}{time}"
        )
    if sizes.reach is not None:
        lines.append(f"norm u_k <= peak gamma norm(L x_0) = {decimal(sizes.reach, 12)} for the given x_0")
    if sizes.overshoot is not None:
        lines.append(f"norm(x(t) - x(t_k)) <= {decimal(sizes.overshoot, 12)} inside each sampling interval")
    if sizes.limit is not None:
        means = ", ".join(decimal(Interval.exactly(x), 20) for x in sizes.limit)
        lines.append(f"every x_i(t) tends to {means if len(sizes.limit) == 1 else f'({means})'}")
    return "\n".join(f"  {line}" for line in lines) + "\n"


def _margins(proof: Proof) -> str:
    """How much room is left, gamma, h and alpha moved one at a time."""
    lines = ["  margins, each number moved alone:"]
    for name, words in margin_lines(proof):
        head = f"    {name:{NAME_WIDTH}}  "
        lines += textwrap.wrap(head + words, WIDTH, subsequent_indent=" " * len(head), break_on_hyphens=False)
    if words := binding(proof):
        lines += textwrap.wrap(f"  as required: {words}", WIDTH, subsequent_indent="    ", break_on_hyphens=False)
    return "\n".join(lines) + "\n"


def horizon_text(seen: Horizon) -> str:
    """What the samples of a horizon showed, with their least slack."""
    lines = [f"  (14) term by term at k = 0..{seen.last}: {held(seen)}"]
    smallest = decimal(seen.least_slack, 12)
    lines += [f"  relative slack 1 - beta^(k+1)/c_(k+1): smallest {smallest} at k = {seen.least_slack_at}"]
    lines += ["  (the absolute slack c_(k+1) - beta^(k+1) tends to 0 for every design: it says nothing of safety)"]
    return "\n".join(lines) + "\n"


def held(seen: Horizon) -> str:
    """What the samples of a horizon showed."""
    if seen.not_decided:
        undecided = ", ".join(map(str, seen.not_decided))
        rest = (
            "holds at each other"
            if seen.first_failure is None
            else f"first certain failure at k = {seen.first_failure}"
        )
        return f"k = {undecided} too near to equality for these digits (the closed form decides it); {rest}"
    if seen.first_failure is None:
        return "holds at each of them"
    return f"first fails at k = {seen.first_failure}"


def refutation_text(name: str, decision: Decision) -> str:
    """What the refutation of a claim means, the counterexample and the remedy."""
    lines = [f"{name} is refuted: {decision.meaning}"]
    lines += [f"counterexample: {text}" for text in [_counterexample(decision)] if text]
    lines += [f"remedy: {decision.remedy}"]
    return (
        "\n".join("\n".join(textwrap.wrap(x, WIDTH, subsequent_indent="  ", break_on_hyphens=False)) for x in lines)
        + "\n"
    )


def _counterexample(decision: Decision) -> str:
    witness = decision.witness
    if "e" in witness and len(witness["e"]) <= SHOWN_ENTRIES:
        return f"e = ({', '.join(map(_entry, witness['e']))})"
    if "unreachable" in witness:
        source, target = witness["unreachable"]
        return f"no directed path leads from agent {source} to agent {target}"
    return ""


def _entry(x: Fraction) -> str:
    return format_rational(x)


def ending(decisions: Mapping[str, Decision], require: Sequence[str]) -> str:
    """The theorems behind the verdicts, and whether all that is required is proved."""
    decided = {name for name, x in decisions.items() if x.verdict in (Verdict.PROVED, Verdict.REFUTED)}
    rests = [f"{claim.ID} ({claim.COQ})" for claim in CLAIMS if claim.COQ and claim.ID in decided]
    lines = textwrap.wrap(
        f"Coq theorems behind them: {', '.join(rests)}", WIDTH, subsequent_indent="  ", break_on_hyphens=False
    )
    return "\n".join([*lines, "", closing_line(decisions, require)])


def closing_line(decisions: Mapping[str, Decision], require: Sequence[str]) -> str:
    """Whether all that is required is proved."""
    required = {name: decisions[name].verdict for name in require}
    if all(verdict is Verdict.PROVED for verdict in required.values()):
        return f"All {len(required)} required claims are proved."
    missed = ", ".join(f"{name} {verdict.value}" for name, verdict in required.items() if verdict is not Verdict.PROVED)
    return f"Not every required claim is proved: {missed}."
