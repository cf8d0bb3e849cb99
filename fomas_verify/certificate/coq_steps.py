"""The steps of a Coq file in order: for each verdict the statement, and the lemma of proofs/Design behind it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from fractions import Fraction

from fomas_verify.certificate.coq_chapter import (
    BALANCED,
    GRAPH,
    Chapter,
    Step,
    about_loops,
    ends,
    factor_text,
    mu_range,
    vector,
    with_lambda2,
)
from fomas_verify.certificate.coq_contraction import beta_contraction, repaired
from fomas_verify.certificate.coq_enclosures import Enclosures, quotient, table
from fomas_verify.certificate.coq_factor import Table, factor, identity, stein
from fomas_verify.certificate.coq_figures import Figures
from fomas_verify.certificate.coq_samples import norm_bound_by_samples, norm_bound_exceeded
from fomas_verify.certificate.coq_stability import falls_with_it, norm_bound_outside, spectrum
from fomas_verify.certificate.coq_trajectory import trajectory_norm
from fomas_verify.claims.verdict import Decision, Verdict
from fomas_verify.enclosure.interval import round_down
from fomas_verify.exact.matrix import apply
from fomas_verify.network import adjacency
from fomas_verify.spectrum.loop import Loop

SHIFTS = (0, 8, 16, 32, 64)
"""Powers of two by which a Lyapunov matrix is scaled until it exceeds 1."""


def steps(loop: Loop, decisions: Mapping[str, Decision], enclosures: Enclosures) -> list[Step]:
    """The lemmas in the order in which they use one another."""
    found: list[Step] = []
    figures = Figures(loop, enclosures)
    for build in BUILDERS:
        found += build(Chapter(figures, decisions, frozenset(step.name for step in found)))
    return found


def _graph(chapter: Chapter) -> list[Step]:
    claim = "graph-assumption"
    if chapter.decided(claim, Verdict.PROVED):
        proof = "apply assumption1_sound; check."
        return [Step("graph_assumption", "assumption1 agents graph", proof, claim, "proved")]
    if not chapter.decided(claim, Verdict.REFUTED):
        return []
    witness = chapter.decisions[claim].witness
    if "imbalance" in witness:
        agent = witness["imbalance"]["agent"] - 1
        proof = f"exact (unbalanced_sound {GRAPH} {agent} ltac:(unfold agents; lia) ltac:(check))."
    else:
        i, j = (agent - 1 for agent in witness["unreachable"])
        members = "; ".join("true" if x else "false" for x in _reachable(chapter.loop, i))
        proof = f"exact (unreachable_sound {GRAPH} [{members}] {i} {j} ltac:(check))."
    return [Step("graph_assumption", "~ assumption1 agents graph", proof, claim, "refuted")]


def _reachable(loop: Loop, start: int) -> list[bool]:
    """The agents that a directed path from this one reaches."""
    rows = adjacency(loop.design.graph)
    seen, fresh = {start}, [start]
    while fresh:
        j = fresh.pop()
        new = [i for i, row in enumerate(rows) if row[j] and i not in seen]
        seen.update(new)
        fresh += new
    return [i in seen for i in range(len(rows))]


def _gain_bound(chapter: Chapter) -> list[Step]:
    claim, degree = "gain-bound", chapter.loop.degree_max
    if degree == 0:
        return []
    d = chapter.figures.denominator
    rows = adjacency(chapter.loop.design.graph)
    numerator = int(degree * d)
    check = f"exact (degree_sound {GRAPH} {numerator} ltac:(check))."
    known = Step("degree", f"degree_max agents graph = {numerator} / {d}", check)
    mu = chapter.numbers.mu
    if chapter.decided(claim, Verdict.PROVED) and mu.upper * degree < 1 and rows:
        proof = "exact (gain_bound_sound _ _ _ _ _ _ degree ltac:(lra) mu_bounds ltac:(lra) ltac:(lra))."
        return [known, Step("within_gain_bound", "gain_bound agents graph mu", proof, claim, "proved")]
    if chapter.decided(claim, Verdict.REFUTED) and mu.lower * degree >= 1:
        proof = "exact (gain_bound_false _ _ _ _ _ degree ltac:(lra) (proj1 mu_bounds) ltac:(lra))."
        return [known, Step("beyond_gain_bound", "~ gain_bound agents graph mu", proof, claim, "refuted")]
    return []


def _lambda2(chapter: Chapter) -> list[Step]:
    if not chapter.loop.assumption1:
        return []
    lower, upper = chapter.figures.lambda2_lower, chapter.figures.lambda2_upper
    if lower is None or upper is None:
        return []
    (low, shown), (high, e) = lower, upper
    above = f"exact (lambda2_lower {GRAPH} {ends(low)} {factor_text(shown)} lambda2 ltac:(check) ltac:(check))."
    below = f"exact (lambda2_upper {GRAPH} {vector(e)} {ends(high)} lambda2 ltac:(check))."
    given = "forall lambda2, is_lambda2 agents graph lambda2 ->"
    return [
        Step("lambda2_above", f"{given} {quotient(low)} <= lambda2", f"intros lambda2.\n  {above}"),
        Step("lambda2_below", f"{given} lambda2 <= {quotient(high)}", f"intros lambda2.\n  {below}"),
    ]


def _memory(chapter: Chapter) -> list[Step]:
    claim, found = "memory-inequality", with_lambda2(chapter)
    if found is None:
        return []
    (product, numbers), bits = found, chapter.numbers.bits
    first, second = 1 - chapter.loop.threshold(2 * bits), 1 - chapter.loop.lower_threshold(2 * bits)
    if chapter.decided(claim, Verdict.PROVED) and product.lower > first.upper and product.upper < second.lower:
        lemma, conclusion, goals, verdict = "memory_sound", "memory_claim", "_ _", "proved"
    elif chapter.decided(claim, Verdict.REFUTED) and product.upper < first.lower:
        lemma, conclusion, goals, verdict = "memory_false_first", "memory_refuted", "_", "refuted"
    elif chapter.decided(claim, Verdict.REFUTED) and product.lower > second.upper:
        lemma, conclusion, goals, verdict = "memory_false_second", "memory_refuted", "_", "refuted"
    else:
        return []
    proof = (
        f"refine ({lemma} agents graph alpha mu {numbers} _ mu_bounds _ _ lambda2_above lambda2_below {goals});\n"
        f"    unfold alpha; first [lra | {chapter.numbers.by_interval}]."
    )
    return [Step("memory", f"{conclusion} agents graph alpha mu", proof, claim, verdict)]


def _decay(chapter: Chapter) -> list[Step]:
    if "graph_assumption" not in chapter.known or not chapter.loop.assumption1:
        return []
    if "within_gain_bound" in chapter.known:
        proof = "exact (gain_decays _ _ _ graph_assumption within_gain_bound)."
        return [Step("decay", "decays agents graph mu", proof)]
    decision = chapter.decisions["perron-eigenvalues"]
    if decision.verdict is not Verdict.PROVED or decision.witness["mu"] < chapter.numbers.mu.upper:
        return []
    t = decision.witness["mu"]
    for shift in SHIFTS:
        q = _on_agents(decision.witness["Q"], shift)
        unit = (t.denominator * chapter.figures.denominator) ** 2
        positive = factor(stein(q, identity(len(q)), 1, 0, 1))
        falling = factor(stein(q, chapter.figures.perron(t), unit, 1, 1))
        if positive is not None and falling is not None:
            forms = f"1 {factor_text(positive)} 1 {factor_text(falling)}"
            proof = (
                f"refine (lyapunov_sound {GRAPH} {table(q)} {ends(t)} {forms} mu\n"
                f"    {BALANCED} ltac:(check) ltac:(check) ltac:(check) ltac:(check) _).\n"
                "  assert (B := mu_bounds). lra."
            )
            return [Step("decay", "decays agents graph mu", proof)]
    return []


def _on_agents(rows: list[list[Fraction]], shift: int) -> Table:
    """``C^T Q C`` in integers, times a power of two: the form of Q on the differences from the last agent."""
    n = len(rows)
    scale = Fraction(1 << shift)
    for row in rows:
        for x in row:
            scale *= (x * scale).denominator
    q = [[int(rows[max(i, j)][min(i, j)] * scale) for j in range(n)] for i in range(n)]
    sums = [-sum(row) for row in q]
    return [[*row, last] for row, last in zip(q, sums, strict=True)] + [[*sums, -sum(sums)]]


def _from_decay(chapter: Chapter) -> list[Step]:
    if "decay" not in chapter.known:
        return []
    found = []
    one = "ltac:(unfold agents; lia)"
    if chapter.decided("perron-eigenvalues", Verdict.PROVED):
        proof = f"exact (decays_spectrum agents graph mu {one} {BALANCED} decay)."
        found.append(
            Step("perron_eigenvalue_one", "perron_spectrum agents graph mu", proof, "perron-eigenvalues", "proved")
        )
    for claim, predicate, lemma in (
        ("control-bounded", "control_bounded", "decays_control"),
        ("average-consensus", "average_consensus", "decays_consensus"),
    ):
        if chapter.decided(claim, Verdict.PROVED):
            use = f"refine ({lemma} agents graph alpha gamma h {one} {BALANCED} range _)."
            found.append(
                about_loops(chapter, f"{lemma}_holds", f"{predicate} agents graph alpha gamma h", use, "decay", claim)
            )
    return found


def _control_norm(chapter: Chapter) -> list[Step]:
    claim = "control-norm-bound"
    statement = "control_norm_bound agents graph alpha gamma h"
    if chapter.decided(claim, Verdict.PROVED) and "repaired" in chapter.known:
        use = f"refine (repaired_norm_bound agents graph alpha gamma h {BALANCED} range _)."
        return [about_loops(chapter, "norm_bound", statement, use, "repaired", claim)]
    witness = chapter.decisions[claim].witness
    if "graph_assumption" not in chapter.known or "x0" not in witness or "no_norm_bound" in chapter.known:
        return []
    moved = apply(chapter.loop.laplacian, witness["x0"])
    direction = chapter.figures.direction(moved)
    r = round_down(1 - chapter.loop.threshold(2 * chapter.numbers.bits).upper, chapter.numbers.bits)
    if not chapter.figures.grown(direction, r):
        return []
    proof = (
        f"refine (growth_sound {GRAPH} {vector(direction.e)} {mu_range(chapter)} {ends(r)} alpha mu\n"
        f"    ltac:(check) _ mu_bounds _); unfold alpha; first [lra | {chapter.numbers.by_interval}]."
    )
    growth = Step("growth", "~ bounded_on_1perp agents (Phi alpha agents (perron agents graph mu) 1) 1", proof)
    use = "refine (norm_bound_false agents graph alpha gamma h ltac:(unfold agents; lia) graph_assumption range _)."
    return [growth, about_loops(chapter, "no_norm_bound", f"~ {statement}", use, "growth", claim, "refuted")]


BUILDERS: tuple[Callable[[Chapter], list[Step]], ...] = (
    _graph,
    _gain_bound,
    _lambda2,
    _memory,
    beta_contraction,
    repaired,
    _decay,
    _from_decay,
    spectrum,
    falls_with_it,
    norm_bound_outside,
    _control_norm,
    norm_bound_by_samples,
    norm_bound_exceeded,
    trajectory_norm,
)
