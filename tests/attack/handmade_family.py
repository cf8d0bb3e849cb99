"""Certificates of uncertain designs made by the oracle and by search, without the prover.

Boxes are halved, in alpha and in mu, until `boxes` finds a witness that shows the claim over each.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from itertools import chain, islice
from typing import Any

from mpmath import mp

from . import family_truth, oracle
from .alpha_range import DPS
from .boxes import at, over_box
from .family import decide, least_gain, most_gain, verdict
from .form import STATEMENTS
from .form_witness import BOXED, Claim
from .handmade import candidates, certificate_of, claim_tree, outward, tree_of
from .model import Design, Ends, Uncertain, assumption_1, degree_max
from .strict_json import Obj

SLABS = (1, 4)
DEPTH = 2
MOST_TRIED = 3


def _witness(design: Design, claim: str, alphas: Ends, gains: Ends) -> dict[str, Any] | None:
    for end in gains[::-1]:
        found = candidates(at(design, alphas[0], end), claim, "proved")
        for given in chain([{}], islice(found, MOST_TRIED)):
            if over_box(design, claim, "proved", given, alphas, gains):
                return given
    return None


def _stack(design: Design, claim: str, alphas: Ends, gains: Ends, depth: int = 0) -> list[dict[str, Any]] | None:
    """Boxes over a slab from the lowest mu to the highest."""
    if (given := _witness(design, claim, alphas, gains)) is not None:
        return [{"alpha": alphas, "mu": gains, "witness": given}]
    if depth == DEPTH:
        return None
    middle = (gains[0] + gains[1]) / 2
    lower = _stack(design, claim, alphas, (gains[0], middle), depth + 1)
    upper = _stack(design, claim, alphas, (middle, gains[1]), depth + 1) if lower else None
    return [*lower, *upper] if lower and upper else None


def boxes(family: Uncertain, claim: str) -> list[dict[str, Any]] | None:
    """Boxes that show the claim for every member, or None where they were not found."""
    for count in SLABS:
        step = (family.alpha[1] - family.alpha[0]) / count
        found: list[dict[str, Any]] = []
        for k in range(count if step else 1):
            slab = family.alpha[0] + k * step, family.alpha[0] + (k + 1) * step
            stack = _stack(family.member({}), claim, slab, family_truth.room(family, slab)[1])
            if stack is None:
                break
            found += stack
        else:
            return found
    return None


def _proofs(family: Uncertain, claim: str) -> Iterator[dict[str, Any]]:
    if claim in BOXED:
        if found := boxes(family, claim):
            yield {"boxes": found}
        return
    member = most_gain(family)
    for given in candidates(member, claim, "proved"):
        yield {**given, **({"mu": given["mu"] * (1 + Fraction(1, 10**30))} if "mu" in given else {})}


def _claim_tree(family: Uncertain, claim: str) -> Obj | None:
    word, design = verdict(family, claim), family.member({})
    if word in (None, "inapplicable") or claim == "graph-assumption":
        return claim_tree(design, claim) if word else None
    given: Iterator[dict[str, Any]] = _proofs(family, claim)
    if word == "refuted":
        member = decide(family, claim)[1]
        if member is None:
            return None
        numbers = {key: getattr(member, key) for key in family.ends()}
        given = ({"member": numbers, "witness": inner} for inner in candidates(member, claim, word))
    for witness in given:
        made = Claim(claim, word, STATEMENTS[claim], witness)
        if family_truth.claim_of_all(family, made):
            named = {"id": claim, "verdict": word, "statement": STATEMENTS[claim], "witness": witness}
            return tree_of(named)
    return None


def _values(family: Uncertain) -> dict[str, Any]:
    """The hulls of the values at the members of least and largest mu and at the ends of alpha."""
    out = {}
    low, high = least_gain(family), most_gain(family)
    hair = Fraction(1, 10**30)
    with mp.workdps(DPS):
        out["mu"] = outward(oracle.mu(low, DPS))[0] - hair, outward(oracle.mu(high, DPS))[1] + hair
        ends = [outward(oracle.threshold(family.member({"alpha": alpha}), DPS)) for alpha in family.alpha]
    out["threshold"] = ends[0][0], ends[1][1]
    out["degree_max"] = degree_max(low), degree_max(low)
    if assumption_1(low):
        lam = outward(oracle.lambda2(low, DPS))
        out["lambda2"] = lam
        out["beta"] = 1 - out["mu"][1] * lam[1], 1 - out["mu"][0] * lam[0]
        sizes = [outward(oracle.sigma(end, DPS)) for end in (low, high)]
        out["sigma"] = min(x for x, _ in sizes) / 2, max(x for _, x in sizes) + hair
    return {key: {"lower": lower, "upper": upper} for key, (lower, upper) in out.items()}


def certificate(family: Uncertain) -> bytes:
    """A true certificate of an uncertain design with every claim for which a witness was found."""
    names = oracle.claims_of(family.member({}))
    claims = [tree for claim in names if (tree := _claim_tree(family, claim)) is not None]
    return certificate_of(family, _values(family), claims)
