"""The claims about a design whose digraph is switched, decided. Source: docs/certificate-format.md, section 10; theory,
section 11.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

from fomas_verify.certificate.switching_document import switched_text
from fomas_verify.claims import graph_assumption
from fomas_verify.claims.verdict import Decision, Verdict, inapplicable, undecided
from fomas_verify.design import SWITCHED_CLAIM_IDS, SwitchedDesign
from fomas_verify.enclosure.digits import decimal
from fomas_verify.enclosure.interval import Interval, is_dyadic, short_dyadic
from fomas_verify.region.common_form import SOLVER, Form, Rate, norm_form, rate
from fomas_verify.region.common_search import MOST_AGENTS as MOST_SOLVED
from fomas_verify.region.common_search import Search, installed
from fomas_verify.region.errors import UndecidedRegionError
from fomas_verify.region.words import growing_word
from fomas_verify.spectrum.loop import Loop
from fomas_verify.spectrum.precision import PRECISIONS
from fomas_verify.spectrum.stability import Side, lower_triangle, stability

MOST_AGENTS = 60
BITS = 192
NEAR = Fraction(1, 1 << 30)
"""A form is sought at a short number at most this share above mu."""

MEANING = "To keep to one graph is a switching, and with that graph alone the agents do not agree."
WORD_MEANING = "Each graph alone may be fine; switched in this order they drive the agents apart."
REMEDY = "lower mu (gamma, or h): region shows how far"

Searcher = Callable[[Sequence[Loop]], Search]


@dataclass(frozen=True)
class SwitchedProof:
    """All that was found about a design with digraphs to switch among."""

    design: SwitchedDesign
    mu: Interval
    degree_max: Fraction
    decisions: Mapping[str, Decision]
    rate: Rate | None

    @property
    def exit_status(self) -> int:
        """0 every required claim is proved, 1 one is refuted or inapplicable, 3 one is undecided."""
        verdicts = [self.decisions[name].verdict for name in self.design.first.require]
        if any(v in (Verdict.REFUTED, Verdict.INAPPLICABLE) for v in verdicts):
            return 1
        return 3 if Verdict.UNDECIDED in verdicts else 0

    def certificate(self) -> str:
        """The certificate's canonical text."""
        from importlib.metadata import version

        values: dict[str, Any] = {"mu": {"lower": self.mu.lower, "upper": self.mu.upper}}
        values["degree_max"] = {"lower": self.degree_max, "upper": self.degree_max}
        if self.rate is not None:
            values["rate"] = self.rate.entry
        return switched_text(self.design, values, self.decisions, version("fomas_verify"))


def prove_switched(design: SwitchedDesign, searcher: Searcher = Search.of) -> SwitchedProof:
    """Decide the claims about every switching among the digraphs and their convex combinations.

    Parameters
    ----------
    design : SwitchedDesign
        With mu, or gamma and h.
    searcher : callable
        From the loops to the search for a common form; what it finds is tested exactly.

    Returns
    -------
    SwitchedProof
        Rigorous.

    Raises
    ------
    UndecidedRegionError
        More agents than the work allows.
    """
    design.first.needs("mu", command="prove")
    if design.first.graph.agents > MOST_AGENTS:
        raise UndecidedRegionError(
            f"{design.first.source}: more than {MOST_AGENTS} agents are beyond [[graphs]] for now: undecided"
        )
    loops = loops_of(design)
    degree = max(loop.degree_max for loop in loops)
    decisions = {"graph-assumption": _assumption(loops), "gain-bound": _gain_bound(loops[0], degree)}
    form = None
    if all(loop.assumption1 for loop in loops):
        consensus, form = _consensus(loops, searcher(loops))
    else:
        consensus = inapplicable()
    decisions |= dict.fromkeys(("control-bounded", "average-consensus"), consensus)
    mu = design.mu or loops[0].mu(BITS).rounded(BITS)
    ordered = {name: decisions[name] for name in SWITCHED_CLAIM_IDS}
    return SwitchedProof(design, mu, degree, ordered, None if form is None else _rate(loops, mu, form))


def loops_of(design: SwitchedDesign) -> list[Loop]:
    """The loop of each digraph alone, at the greatest mu where mu is an interval."""
    greatest = None if design.mu is None else design.mu.upper
    return [Loop(replace(design.with_graph(i), mu=greatest)) for i in range(len(design.graphs))]


def _assumption(loops: Sequence[Loop]) -> Decision:
    for i, loop in enumerate(loops, 1):
        found = graph_assumption.decide(loop)
        if found.verdict is not Verdict.PROVED:
            meaning = "A switching may keep to that graph, which the paper's Theorem 1 does not speak about."
            witness = {"graph": i, **found.witness}
            return replace(found, witness=witness, reason=f"graph {i}: {found.reason}", meaning=meaning)
    return Decision(Verdict.PROVED, {}, f"each of the {len(loops)} is strongly connected and balanced")


def _gain_bound(loop: Loop, degree: Fraction) -> Decision:
    """The loop is at the greatest mu."""
    if degree == 0:
        return Decision(Verdict.PROVED, {}, "there is no edge")
    for bits in PRECISIONS:
        mu = loop.mu(bits)
        numbers = f"mu = {decimal(mu, 20)}", f"1/Delta_max = {decimal(Interval.exactly(1 / degree), 20)}"
        if mu.upper * degree < 1:
            return Decision(Verdict.PROVED, {}, " < ".join(numbers))
        if mu.lower * degree >= 1:
            meaning = "The paper's bound (15) fails for one of the graphs; consensus may hold all the same."
            return Decision(Verdict.REFUTED, {}, " >= ".join(numbers), meaning, "lower gamma or h")
    return undecided(PRECISIONS[-1], "mu and 1/Delta_max")


def _consensus(loops: Sequence[Loop], search: Search) -> tuple[Decision, Form | None]:
    """Both claims, and the form that shows them."""
    least = None
    for i, loop in enumerate(loops, 1):
        alone = stability(loop)
        if alone.side in (Side.BOUNDARY, Side.OUTSIDE):
            star = "0" if alone.mu_star is None else decimal(alone.mu_star, 20)
            reason = f"graph {i} alone: mu = {decimal(loop.mu(BITS), 20)} >= mu* = {star}"
            return Decision(Verdict.REFUTED, {"graph": i, **alone.witness}, reason, MEANING, REMEDY), None
        if alone.side is Side.UNKNOWN or alone.mu_star is None:
            return undecided(PRECISIONS[-1], f"graph {i} alone: mu and mu*"), None
        least = alone.mu_star.lower if least is None else min(least, alone.mu_star.lower)
    mu = loops[0].mu(BITS)
    above = min(mu.upper * (1 + NEAR), mu.upper if least is None else (mu.upper + least) / 2)
    t = mu.upper if mu.is_exact and is_dyadic(mu.upper) else short_dyadic(mu.upper, above)
    form = search.form(t)
    if form is not None:
        reason = f"one quadratic form decreases under {_each(len(loops))} and every mu up to {decimal(mu, 20)}"
        return Decision(Verdict.PROVED, {"mu": t, **form.witness}, reason), form
    if loops[0].design.mu is not None and (word := growing_word(loops, mu.upper)) is not None:
        order = ", ".join(map(str, word["word"]))
        reason = f"the graphs {order} in turn, over and over: at mu = {decimal(mu, 20)} the disagreement grows"
        return Decision(Verdict.REFUTED, word, reason, WORD_MEANING, REMEDY), None
    return _no_form(search, mu), None


def _each(graphs: int) -> str:
    return "the graph" if graphs == 1 else f"each of the {graphs} graphs, and their convex combinations,"


def _no_form(search: Search, mu: Interval) -> Decision:
    t = mu.lower if mu.is_exact and is_dyadic(mu.lower) else short_dyadic(mu.lower * (1 - NEAR), mu.lower)
    dual = search.dual(t)
    if dual is not None:
        witness = {"mu": t, "Z": [lower_triangle(z) for z in dual], "solver": SOLVER}
        reason = "no quadratic form decreases under every graph, as the dual shows: this method cannot decide it"
        return Decision(Verdict.UNDECIDED, witness, reason)
    found = undecided(PRECISIONS[0], "no quadratic form was found that decreases under every graph")
    if search.margins is not None:
        return found
    advice = f"at most {MOST_SOLVED} agents" if installed() else "pip install 'fomas_verify[region]'"
    return replace(found, reason=f"{found.reason}; a solver was not asked ({advice})")


def _rate(loops: Sequence[Loop], mu: Interval, form: Form) -> Rate | None:
    """By the norm itself where that contracts (kappa = 1), else by the form that was found."""
    ends = mu.rounded(64).ends
    by_norm = Form(ends[1], norm_form(loops[0].design.graph.agents))
    return rate(loops, ends, by_norm) or rate(loops, ends, form)
