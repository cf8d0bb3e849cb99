"""The steps of a design's Coq file on perron-eigenvalues and on the claims that fall with it.

A power of Pc whose trace is too great, or a form that Pc does not lower, refutes them; on a graph that is not balanced
a Lyapunov form proves perron-eigenvalues. Source: proofs/Design/Spectrum.v.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from math import lcm
from typing import Any

from fomas_verify.certificate.coq_chapter import Chapter, Step, about_loops, ends, factor_text, squares_text
from fomas_verify.certificate.coq_enclosures import quotient, table
from fomas_verify.certificate.coq_factor import Table, factor, identity, squares, stein
from fomas_verify.claims.verdict import Verdict
from fomas_verify.enclosure.interval import short_dyadic
from fomas_verify.spectrum.stability import large_trace_power

CLAIM = "perron-eigenvalues"
BITS = 128
TWO = "ltac:(unfold agents; lia)"
MOST_TRACE_WORK = 1 << 32
"""N^3 times the squared bits of Pc^n: beyond it coqc would take longer than seconds."""


def spectrum(chapter: Chapter) -> list[Step]:
    """The verdict on perron-eigenvalues, where it does not follow from the decay on 1perp."""
    decision = chapter.decisions[CLAIM]
    if decision.verdict is Verdict.REFUTED:
        if decision.witness["mu"] > chapter.numbers.mu.lower:
            return []
        proof = (
            _trace(chapter, decision.witness) if "power" in decision.witness else _persistent(chapter, decision.witness)
        )
        return [Step("no_spectrum", "~ perron_spectrum agents graph mu", proof, CLAIM, "refuted")] if proof else []
    if decision.verdict is not Verdict.PROVED or "decay" in chapter.known:
        return []
    if decision.witness["mu"] < chapter.numbers.mu.upper or not (proof := _falling(chapter, decision.witness)):
        return []
    return [Step("spectrum", "perron_spectrum agents graph mu", proof, CLAIM, "proved")]


def falls_with_it(chapter: Chapter) -> list[Step]:
    """control-bounded, average-consensus and control-norm-bound, refuted with perron-eigenvalues."""
    if not {"no_spectrum", "graph_assumption"} <= chapter.known:
        return []
    found = []
    for claim, predicate, lemma in (
        ("control-bounded", "control_bounded", "no_spectrum_control"),
        ("average-consensus", "average_consensus", "no_spectrum_consensus"),
    ):
        if chapter.decided(claim, Verdict.REFUTED):
            use = f"refine ({lemma} agents graph alpha gamma h {TWO} graph_assumption range _)."
            statement = f"~ {predicate} agents graph alpha gamma h"
            found.append(about_loops(chapter, f"{lemma}_holds", statement, use, "no_spectrum", claim, "refuted"))
    return found


def norm_bound_outside(chapter: Chapter) -> list[Step]:
    """control-norm-bound refuted by an eigenvalue outside the closed unit disc, at a smaller gain than the design's."""
    claim = "control-norm-bound"
    if "graph_assumption" not in chapter.known or not chapter.decided(claim, Verdict.REFUTED):
        return []
    witness = _smaller_gain(chapter)
    if witness is None or not (proof := _trace_at(chapter, witness)):
        return []
    t = f"({quotient(witness['mu'])})"
    outside = Step("outside", f"~ perron_spectrum agents graph {t}", proof)
    given = chapter.numbers.gamma is None
    proof = (
        f"{'intros gamma h range given. ' if given else ''}"
        f"refine (no_spectrum_norm_bound agents graph alpha gamma h {t} {TWO} graph_assumption range _ outside).\n"
        f"  assert (B := mu_bounds). {'rewrite given' if given else 'unfold mu in B'}. lra."
    )
    statement = "~ control_norm_bound agents graph alpha gamma h"
    if given:
        statement = f"forall gamma h, design alpha gamma h -> mu_of alpha gamma h = mu ->\n    {statement}"
    return [outside, Step("no_norm_bound", statement, proof, claim, "refuted")]


def _smaller_gain(chapter: Chapter) -> Mapping[str, Any] | None:
    """A gain between mu* and the design's, with a power of Pc there whose trace is too great."""
    star, mu = chapter.loop.mu_star(BITS), chapter.numbers.mu
    if star is None or star.upper >= mu.lower:
        return None
    gap = mu.lower - star.upper
    t = short_dyadic(mu.lower - gap / 2, mu.lower - gap / 8)
    power = large_trace_power(chapter.loop, t, BITS)
    return None if power is None else {"mu": t, "power": power}


def _differences(chapter: Chapter) -> int:
    return len(chapter.figures.laplacian) - 1


def _trace_checked(chapter: Chapter, witness: Mapping[str, Any]) -> str | None:
    """The lemma's numbers, where the power is small enough for coqc and its trace is indeed too great."""
    t, power, n = witness["mu"], witness["power"], _differences(chapter)
    bits = power * (t.denominator * chapter.figures.denominator).bit_length()
    if n**3 * bits**2 > MOST_TRACE_WORK:
        return None
    return f"{n} weights denominator positive {ends(t)} {power}"


def _trace(chapter: Chapter, witness: Mapping[str, Any]) -> str | None:
    numbers = _trace_checked(chapter, witness)
    return numbers and f"refine (trace_sound {numbers} mu ltac:(check) _).\n  assert (B := mu_bounds). lra."


def _trace_at(chapter: Chapter, witness: Mapping[str, Any]) -> str | None:
    numbers = _trace_checked(chapter, witness)
    return numbers and f"refine (trace_sound {numbers} _ ltac:(check) _). lra."


def _persistent(chapter: Chapter, witness: Mapping[str, Any]) -> str | None:
    t, n = witness["mu"], _differences(chapter)
    y = _symmetric(witness["Y"])
    unit = t.denominator * chapter.figures.denominator
    first, second = squares(y), squares(stein(y, chapter.figures.step(t), -unit * unit, -1, 0))
    place = next(((i, j) for i, row in enumerate(y) for j, x in enumerate(row) if x), None)
    if first is None or second is None or place is None:
        return None
    return (
        f"refine (persistence_sound {n} weights denominator positive {table(y)} {ends(t)} {place[0]} {place[1]}\n"
        f"    {squares_text(first)}\n    {squares_text(second)} mu\n"
        "    ltac:(check) ltac:(check) ltac:(check) _).\n  assert (B := mu_bounds). lra."
    )


def _falling(chapter: Chapter, witness: Mapping[str, Any]) -> str | None:
    t, n = witness["mu"], _differences(chapter)
    unit = t.denominator * chapter.figures.denominator
    for shift in (0, 8, 16, 32, 64):
        q = [[x << shift for x in row] for row in _symmetric(witness["Q"])]
        above = factor(stein(q, identity(n), 1, 0, 1), 0)
        below = factor(stein(q, chapter.figures.step(t), unit * unit, 1, 1), 0)
        if above is not None and below is not None:
            parts = " ".join(f"1 {factor_text(x).partition(chr(10))[2]}" for x in (above, below))
            return (
                f"refine (falling_sound {n} weights denominator positive {table(q)} {ends(t)} {parts} mu\n"
                "    ltac:(check) ltac:(check) ltac:(check) _).\n  assert (B := mu_bounds). lra."
            )
    return None


def _symmetric(rows: list[list[Fraction]]) -> Table:
    """The matrix with this lower triangle, in integers."""
    unit = lcm(*(x.denominator for row in rows for x in row))
    n = len(rows)
    return [[int(rows[max(i, j)][min(i, j)] * unit) for j in range(n)] for i in range(n)]
