"""The steps of a design's Coq file on beta-contraction and repaired-condition: how much P shrinks the disagreement."""

from __future__ import annotations

from fractions import Fraction

from fomas_verify.certificate.coq_chapter import (
    GRAPH,
    Chapter,
    Step,
    ends,
    factor_text,
    mu_range,
    squares_text,
    vector,
    with_lambda2,
)
from fomas_verify.certificate.coq_enclosures import quotient
from fomas_verify.certificate.coq_factor import Table, factor, identity, squares, stein
from fomas_verify.certificate.coq_figures import Direction
from fomas_verify.claims.verdict import Verdict
from fomas_verify.enclosure.interval import round_down, round_up, short_dyadic
from fomas_verify.spectrum.loop import sigma_at


def beta_contraction(chapter: Chapter) -> list[Step]:
    """A vector P shrinks by less than beta; lambda2 exactly and a factor; or the ends of a symmetric spectrum."""
    claim, found = "beta-contraction", with_lambda2(chapter)
    if chapter.decided(claim, Verdict.PROVED):
        return _exact_step(chapter) or _symmetric_step(chapter)
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


def _exact_step(chapter: Chapter) -> list[Step]:
    """``sigma(t) <= 1 - t lambda2`` for a rational lambda2, by squares: the form is singular at its eigenvectors."""
    figures, t = chapter.figures, chapter.decisions["beta-contraction"].witness["mu"]
    exactly = figures.lambda2_exactly
    if exactly is None or t < chapter.numbers.mu.upper or (s := 1 - t * exactly[0]) < 0:
        return []
    n, unit = len(figures.laplacian), t.denominator * figures.denominator
    scale = s.numerator**2 * unit**2
    form = stein(identity(n), figures.perron(t), scale, s.denominator**2, 0)
    weight = max(0, s.denominator**2 * unit**2 - scale)
    shown = squares([[x + weight for x in row] for row in form])
    if shown is None:
        return []
    theta = quotient(exactly[0])
    below = f"exact (lambda2_upper {GRAPH} {vector(exactly[1])} {ends(exactly[0])} lambda2 ltac:(check))."
    held = (
        f"refine (contracts_form {GRAPH} {ends(t)} {ends(s)} {weight} ltac:(check)\n"
        f"    (squares_sound _ _ {squares_text(shown)} _)). check."
    )
    proof = (
        f"refine (factor_step agents graph mu ({quotient(t)}) ({quotient(s)}) ({theta})\n"
        "    _ step_factor _ lambda2_exact).\n"
        "  - assert (B := mu_bounds). lra.\n  - lra."
    )
    given = "forall lambda2, is_lambda2 agents graph lambda2 ->"
    return [
        Step("lambda2_exact", f"{given} lambda2 <= {theta}", f"intros lambda2.\n  {below}"),
        Step("step_factor", f"contracts agents graph ({quotient(t)}) ({quotient(s)})", held),
        Step("beta_step", "beta_contraction agents graph mu", proof, "beta-contraction", "proved"),
    ]


def _symmetric_step(chapter: Chapter) -> list[Step]:
    """``t lambda2 <= 1`` and ``t (lambda2 + lambda_N) <= 2`` on a symmetric graph, where neither is a tie."""
    figures, witness = chapter.figures, chapter.decisions["beta-contraction"].witness
    upper = figures.lambda2_upper
    if "lambda_max_upper" not in witness or "lambda2_below" not in chapter.known or upper is None:
        return []
    t, r, s = witness["mu"], witness["lambda_max_upper"], upper[0]
    if t < chapter.numbers.mu.upper or t * s > 1 or t * (s + r) > 2:
        return []
    n, d = len(figures.laplacian), figures.denominator
    double = [
        [x + y for x, y in zip(*rows, strict=True)]
        for rows in zip(figures.laplacian, _turned(figures.laplacian), strict=True)
    ]
    shown = factor(stein(double, identity(n), -r.denominator, 0, -2 * d * r.numerator))
    if shown is None:
        return []
    above = (
        f"refine (form_upper {GRAPH} {ends(r)} {shown.weight} ltac:(check)\n"
        f"    (nonnegative_sound _ _ {factor_text(shown).partition(chr(10))[2]} _)). check."
    )
    proof = (
        f"refine (symmetric_step_sound agents weights denominator mu ({quotient(t)}) ({quotient(s)}) ({quotient(r)})\n"
        "    ltac:(unfold agents; lia) ltac:(check) _ form_below _ _ _ _); try lra.\n"
        "  - assert (B := mu_bounds). lra.\n"
        "  - intros l H. assert (X := lambda2_above l H). assert (Y := lambda2_below l H). lra."
    )
    bound = f"form agents (laplacian_sym agents graph) x <= {quotient(r)} * dot agents x x"
    return [
        Step("form_below", f"forall x, zero_sum agents x ->\n  {bound}", above),
        Step("beta_step", "beta_contraction agents graph mu", proof, "beta-contraction", "proved"),
    ]


def _turned(rows: Table) -> Table:
    return [list(column) for column in zip(*rows, strict=True)]


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
