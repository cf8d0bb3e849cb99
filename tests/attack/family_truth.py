"""What a certificate about an uncertain design deserves: section 7 of docs/certificate-format.md.

Values must hold for every member; a refutation for the member it names; boxes must hold every member, in their order,
and each box's witness must show the claim over all of it.
"""

from __future__ import annotations

from fractions import Fraction
from functools import lru_cache
from itertools import groupby, pairwise
from typing import Any

from mpmath import mp

from . import oracle
from .alpha_range import DPS, excess, rounded
from .boxes import over_box
from .family import SPECTRAL, decide, gains_over, least_gain, most_gain, verdict
from .form import STATEMENTS, Document
from .form_witness import BOXED, Claim
from .gain import Truth, both, mu_at_most
from .margins import at_gain
from .model import Ends, Uncertain, assumption_1, x0_columns
from .spectral_witness import stays
from .truth import GRAPH_VALUES, bound_holds, claim_holds, contraction_form_shown

EXIST = ("mu", "threshold", "degree_max", *GRAPH_VALUES, "limit")
HAIR = Fraction(1, 10**40)


def _gain_at_most(family: Uncertain, t: Fraction) -> Truth:
    """mu <= t for every member; None where that is closer than the alpha of the largest is known."""
    member = most_gain(family)
    if member.mu is not None or member.alpha in family.alpha:
        return mu_at_most(member, t)
    with mp.workdps(DPS):
        gap = oracle.real(t) - oracle.mu(member, DPS)
        return None if abs(gap) < oracle.real(HAIR) else bool(gap > 0)


@lru_cache(maxsize=64)
def _least_sigma(family: Uncertain) -> Any:
    """The least sigma over the members' mu, by golden section (sigma is convex)."""
    design = family.member({})

    def size(gain: Fraction) -> Any:
        return oracle.sigma(at_gain(design, gain), 40)

    with mp.workdps(2 * DPS):
        low, high = (rounded(oracle.mu(end(family), DPS)) for end in (least_gain, most_gain))
        left = high - (high - low) * rounded(mp.phi - 1)
        right = low + high - left
    sizes = [size(left), size(right)]
    for _ in range(102):  # to 10^-21 of the width, where 400 bits of phi suffice
        if sizes[0] > sizes[1]:
            low, left, right = left, right, left + high - right
            sizes = [sizes[1], size(right)]
        else:
            high, left, right = right, low + right - left, left
            sizes = [size(left), sizes[0]]
    return min(sizes)


def _bound(family: Uncertain, key: str, bound: Fraction, upper: bool) -> Truth:
    """One end of a value, for every member."""
    ends = {"least": least_gain(family), "most": most_gain(family)}
    if key in ("threshold", "degree_max", "lambda2"):
        return both(*(bound_holds(family.member({"alpha": alpha}), key, bound, upper) for alpha in family.alpha))
    if key == "sigma" and not upper:
        if both(*(bound_holds(end, key, bound, False) for end in ends.values())) is False:
            return False
        with mp.workdps(40):
            gap = _least_sigma(family) - oracle.real(bound)
            return None if abs(gap) < mp.mpf(10) ** -15 else bool(gap > 0)
    exact = ends["most"].mu is not None or ends["most"].alpha in family.alpha
    answers = [bound_holds(ends["least"], key, bound, upper), bound_holds(ends["most"], key, bound, upper)]
    return both(*answers) if exact or False in answers else _clear(ends["most"], key, bound, answers)


def _clear(member: Any, key: str, bound: Fraction, answers: list[Truth]) -> Truth:
    """The answers, unless the bound is within 10^-40 of the member's number, whose alpha is rounded."""
    numbers: dict[str, Any] = {"mu": oracle.mu, "beta": oracle.beta, "sigma": oracle.sigma}
    with mp.workdps(DPS):
        close = abs(numbers[key](member, DPS) - oracle.real(bound)) < oracle.real(HAIR)
    return None if close else both(*answers)


def _limit(family: Uncertain, entry: dict[str, Any]) -> Truth:
    plain = family.x0 is not None and not isinstance(family.x0[0], tuple)
    if not plain:
        return False
    mean = sum(x0_columns(family.member({}))[0], Fraction(0)) / family.agents
    return entry["lower"] <= mean <= entry["upper"] and decide(family, "average-consensus")[0]


def _value(family: Uncertain, key: str, entry: dict[str, Any]) -> Truth:
    graph = assumption_1(family.member({}))
    if key not in EXIST or (not graph and key in (*GRAPH_VALUES, "limit")):
        return False
    if key == "limit":
        return _limit(family, entry)
    return both(_bound(family, key, entry["lower"], False), _bound(family, key, entry["upper"], True))


def room(family: Uncertain, slab: Ends) -> tuple[Ends, Ends]:
    """The members' range of mu over a slab; and beyond it, over all of the slab, by the excess of section 7."""
    inside = max(slab[0], family.alpha[0]), min(slab[1], family.alpha[1])
    with mp.workdps(DPS):
        low, high = map(rounded, gains_over(family, *map(oracle.real, inside)))
        wide = tuple(map(rounded, gains_over(family, *map(oracle.real, slab))))
    if family.mu is not None:
        return family.mu, family.mu
    assert family.h is not None
    slack = max(excess(h, slab) for h in family.h)
    shrunk = low * (1 + HAIR), max(high * (1 - HAIR), low * (1 + HAIR))
    return shrunk, (wide[0] * (1 - slack), wide[1] * (1 + slack))


def covered(family: Uncertain, boxes: list[dict[str, Any]]) -> Truth:
    """Whether the boxes stand in order and hold every member."""
    slabs = [(alpha, list(group)) for alpha, group in groupby(boxes, key=lambda box: box["alpha"])]
    alphas = [alpha for alpha, _ in slabs]
    in_order = all(y[0] <= x[1] < y[1] for x, y in pairwise(alphas))
    if not in_order or alphas[0][0] > family.alpha[0] or alphas[-1][1] < family.alpha[1]:
        return False
    answers: list[Truth] = []
    for alpha, group in slabs:
        gains = [box["mu"] for box in group]
        if any(y[0] > x[1] for x, y in pairwise(gains)):
            return False
        empty = alpha[1] < family.alpha[0] or alpha[0] > family.alpha[1]
        needed, roomy = room(family, alpha) if not empty else (None, room(family, family.alpha)[1])
        first, last = gains[0][0], gains[-1][1]
        if needed is not None and (first > needed[0] or last < needed[1]):
            return False
        answers.append(True if first <= roomy[0] and last >= roomy[1] else None)
    return both(*answers)


def _boxed(family: Uncertain, claim: Claim) -> Truth:
    boxes, design = claim.witness["boxes"], family.member({})
    if not all(0 < box["alpha"][0] <= box["alpha"][1] < 1 and 0 < box["mu"][0] <= box["mu"][1] for box in boxes):
        return False
    answers = [covered(family, boxes)]
    for box in boxes:
        if answers[-1] is False:
            return False
        answers.append(over_box(design, claim.id, "proved", box["witness"], box["alpha"], box["mu"]))
    return both(*answers)


def _proved(family: Uncertain, claim: Claim) -> Truth:
    design, witness = family.member({}), claim.witness
    if claim.id in BOXED:
        return _boxed(family, claim)
    if claim.id in SPECTRAL:
        return both(_gain_at_most(family, witness["mu"]), stays(design, witness["mu"], witness["Q"]))
    if claim.id == "beta-contraction":
        return both(_gain_at_most(family, witness["mu"]), contraction_form_shown(design, witness))
    return decide(family, claim.id)[0]


def _refuted(family: Uncertain, claim: Claim) -> Truth:
    numbers, ends = claim.witness["member"], family.ends()
    if not all(ends[key][0] <= x <= ends[key][1] for key, x in numbers.items()):
        return False
    return claim_holds(family.member(numbers), Claim(claim.id, "refuted", claim.statement, claim.witness["witness"]))


def claim_of_all(family: Uncertain, claim: Claim) -> Truth:
    """Whether a claim about every member stands in a certificate truly, with a witness that shows it."""
    design = family.member({})
    if claim.statement != STATEMENTS[claim.id] or claim.id not in oracle.claims_of(design):
        return False
    if claim.id == "graph-assumption":
        return claim_holds(design, claim)
    applicable = claim.id in oracle.ANY_GRAPH or assumption_1(design)
    if not applicable or claim.verdict in ("inapplicable", "undecided"):
        return claim.verdict == "undecided" if applicable else claim.verdict == "inapplicable"
    truth = verdict(family, claim.id)
    if truth is not None and truth != claim.verdict:
        return False
    return (_proved if claim.verdict == "proved" else _refuted)(family, claim)


def parts(family: Uncertain, document: Document) -> list[tuple[str, Truth]]:
    """Every value and claim of a certificate with its truth."""
    values = [(key, _value(family, key, entry)) for key, entry in document.values.items()]
    return values + [(claim.id, claim_of_all(family, claim)) for claim in document.claims]
