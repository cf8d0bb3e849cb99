"""The steps of a design's Coq file on beta-contraction and repaired-condition: how much P shrinks the disagreement."""

from __future__ import annotations

from fractions import Fraction

from fomas_verify.certificate.coq_chapter import GRAPH, Chapter, Step, ends, factor_text, mu_range, vector, with_lambda2
from fomas_verify.certificate.coq_enclosures import quotient
from fomas_verify.certificate.coq_factor import factor, identity, stein
from fomas_verify.certificate.coq_figures import Direction
from fomas_verify.claims.verdict import Verdict
from fomas_verify.enclosure.interval import round_down, round_up, short_dyadic
from fomas_verify.spectrum.loop import sigma_at


def beta_contraction(chapter: Chapter) -> list[Step]:
    """A vector that P shrinks by less than beta; a proof of the claim is not restated."""
    claim, found = "beta-contraction", with_lambda2(chapter)
    if found is None or not chapter.decided(claim, Verdict.REFUTED):
        return []
    product, numbers = found
    direction = chapter.figures.direction(chapter.decisions[claim].witness["e"])
    bound = max(Fraction(0), round_up(1 - product.lower, chapter.numbers.bits))
    if not chapter.figures.stretched(direction, bound**2):
        return []
    proof = _stretch(chapter, direction, bound) + (
        f"  refine (beta_refuted agents graph mu {numbers} mu_bounds _ _ lambda2_above lambda2_below\n"
        f"    _ _ zero _ longer); lra."
    )
    return [Step("beta_step_false", "beta_contraction_refuted agents graph mu", proof, claim, "refuted")]


def _stretch(chapter: Chapter, found: Direction, bound: Fraction) -> str:
    return (
        f"destruct (stretch_sound {GRAPH} {vector(found.e)} {mu_range(chapter)} {ends(bound)} mu\n"
        "    ltac:(check) mu_bounds) as [zero longer].\n"
    )


def repaired(chapter: Chapter) -> list[Step]:
    """A contraction factor at both ends of mu, or a vector that P shrinks by less than 2^alpha - 1."""
    claim, bits = "repaired-condition", chapter.numbers.bits
    threshold = chapter.loop.threshold(2 * bits)
    if chapter.decided(claim, Verdict.REFUTED):
        direction = chapter.figures.direction(chapter.decisions[claim].witness["e"])
        bound = round_up(threshold.upper, bits)
        if not chapter.figures.stretched(direction, bound**2):
            return []
        proof = _stretch(chapter, direction, bound) + (
            f"  refine (repaired_false _ _ _ _ _ _ zero _ longer). unfold alpha. {chapter.numbers.by_interval}."
        )
        return [Step("not_repaired", "repaired_refuted agents graph alpha mu", proof, claim, "refuted")]
    if not chapter.decided(claim, Verdict.PROVED):
        return []
    mu = chapter.numbers.mu
    ends = (mu.lower, mu.upper) if mu.is_exact else (round_down(mu.lower, bits), round_up(mu.upper, bits))
    largest = max(sigma_at(chapter.loop.laplacian, t, 2 * bits).upper for t in ends)
    if largest >= threshold.lower:
        return []
    room = threshold.lower - largest
    s = short_dyadic(largest + room / 4, threshold.lower - room / 4)
    shown = [_contraction(chapter, t, s) for t in ends]
    if None in shown:
        return []
    proof = (
        f"refine (repaired_sound _ _ _ _ _ _ ({quotient(s)}) _ contracts_low contracts_high _).\n"
        f"  - assert (B := mu_bounds). lra.\n  - unfold alpha. {chapter.numbers.by_interval}."
    )
    names = ("contracts_low", "contracts_high")
    helpers = [
        Step(name, f"contracts agents graph ({quotient(t)}) ({quotient(s)})", text or "")
        for name, t, text in zip(names, ends, shown, strict=True)
    ]
    return [*helpers, Step("repaired", "repaired_condition agents graph alpha mu", proof, claim, "proved")]


def _contraction(chapter: Chapter, t: Fraction, s: Fraction) -> str | None:
    figures = chapter.figures
    one = identity(len(figures.laplacian))
    unit = t.denominator * figures.denominator
    form = stein(one, figures.perron(t), s.numerator**2 * unit**2, s.denominator**2, 0)
    if (shown := factor(form)) is None:
        return None
    return f"exact (contracts_sound {GRAPH} {ends(t)} {ends(s)} {factor_text(shown)} ltac:(check) ltac:(check))."
