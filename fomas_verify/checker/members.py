"""An uncertain design: what is true of every member, and what fails for one.

mu runs over an interval [least, greatest] of members; where its ends are irrational they are enclosed.
Source: docs/certificate-format.md, section 7; theory, section 6.
"""

from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import groupby, pairwise
from typing import cast

from fomas_verify.checker.box import Box, require_over
from fomas_verify.checker.claims import presupposed, require_shown
from fomas_verify.checker.designs import Interval, UncertainDesign
from fomas_verify.checker.document import Claim
from fomas_verify.checker.facts import BITS, Facts
from fomas_verify.checker.gain import Gain, gain_of
from fomas_verify.checker.graph import Graph
from fomas_verify.checker.member_form import OfBoxes, OfMember, Part
from fomas_verify.checker.powers import Enclosure
from fomas_verify.checker.ruling import Undecided, need, need_that
from fomas_verify.checker.samples import MAX_SAMPLE_WORK
from fomas_verify.checker.witness import Lemma, Lyapunov, RootOf, SymmetricBounds

MAX_SIGN_WORK = 2**31
MAX_END_BITS = 2**12


@dataclass(frozen=True)
class Members:
    """An uncertain design and its graph."""

    design: UncertainDesign
    graph: Graph

    @cached_property
    def alpha(self) -> Interval:
        """The orders of the members."""
        return cast(Interval, self.design.interval("alpha"))

    @cached_property
    def gain(self) -> Gain:
        """mu of the members."""
        return gain_of(self.design)

    @cached_property
    def least(self) -> Enclosure:
        """The least mu of a member."""
        return self.gain.least(*self.alpha)

    @cached_property
    def greatest(self) -> Enclosure:
        """The greatest mu of a member."""
        return self.gain.greatest(*self.alpha)

    def at(self, mu: Fraction) -> Facts:
        """The design with this mu, at the least alpha."""
        return Facts(self.design.at(self.alpha[0], mu), self.graph)


def require_claim_of_all(members: Members, claim: Claim) -> str:
    """Return the reason why a claim about every member is accepted; raise `Refused` or `Undecided` if it is not."""
    reason = presupposed(members.graph, claim)
    if reason is not None:
        return reason
    witness = claim.witness
    if isinstance(witness, OfMember):
        require_shown(_member(members, witness), claim.id, "refuted", witness.witness)
        return "true, the claim fails for the member"
    if isinstance(witness, OfBoxes):
        _require_boxes(members, claim.id, witness.boxes)
        return f"true, and {len(witness.boxes)} boxes show it"
    if claim.id == "graph-assumption":
        require_shown(members.at(Fraction(1)), claim.id, claim.verdict, witness)
    elif claim.id == "gain-bound":
        degree = members.graph.degree_max
        if degree > 0:
            need(_below(members.greatest, 1 / degree), (1,), "mu < 1/Delta_max for every member")
    else:
        t = cast(Lyapunov | RootOf | SymmetricBounds, witness).mu
        need(_below(members.greatest, t), (0, 1), "mu <= witness.mu for every member")
        # What such a witness shows at t it shows at every smaller mu.
        require_shown(members.at(t), claim.id, claim.verdict, witness)
    return "true of every member"


def _below(x: Enclosure, t: Fraction) -> int | None:
    """The sign of t - x."""
    if x.lower == x.upper == t:
        return 0
    return 1 if x.upper < t else -1 if x.lower > t else None


def _member(members: Members, witness: OfMember) -> Facts:
    for key, number in witness.numbers:
        lower, upper = cast(Interval, members.design.interval(key))
        need_that(lower <= number <= upper, f"{key} of the member lies in its interval")
    return Facts(members.design.member(dict(witness.numbers)), members.graph)


def _require_boxes(members: Members, claim: str, parts: tuple[Part, ...]) -> None:
    _limit(members.graph, parts)
    _require_cover(members, parts)
    for part in parts:
        require_over(Box(members.graph, part.alpha, part.mu), claim, "proved", part.witness)


def _limit(graph: Graph, parts: tuple[Part, ...]) -> None:
    """Bound the work of all boxes together."""
    ends = max(max(mu.numerator, mu.denominator) for part in parts for mu in part.mu)
    if ends.bit_length() > MAX_END_BITS:
        raise Undecided(f"boxes with ends of more than {MAX_END_BITS} bits are beyond the work allowed")
    samples = sum(w.samples + w.powers for w in (part.witness for part in parts) if isinstance(w, Lemma))
    if len(parts) * graph.agents**3 > MAX_SIGN_WORK or samples * graph.agents**3 * BITS[0] > MAX_SAMPLE_WORK:
        raise Undecided("as many boxes and samples are beyond the work allowed")


def _require_cover(members: Members, parts: tuple[Part, ...]) -> None:
    """Return if the (alpha, mu) of every member lies in a box."""
    for part in parts:
        (a, b), (c, d) = part.alpha, part.mu
        need_that(a <= b and c <= d, "the ends of a box are in order")
    slabs = [(alpha, list(boxes)) for alpha, boxes in groupby(parts, key=lambda part: part.alpha)]
    first, last = members.alpha
    need_that(slabs[0][0][0] <= first, "the first slab begins at or below the least alpha")
    need_that(slabs[-1][0][1] >= last, "the last slab ends at or above the greatest alpha")
    for (before, _), (after, _) in pairwise(slabs):
        need_that(after[0] <= before[1] < after[1], "each slab begins in the one before and ends after it")
    for (a, b), boxes in slabs:
        low, high = max(a, first), min(b, last)
        if low <= high:
            _require_slab(members.gain.over_slab(low, high, BITS[0]), [box.mu for box in boxes])


def _require_slab(mu: Enclosure, boxes: list[Interval]) -> None:
    need_that(boxes[0][0] <= mu.lower, "the first box of a slab begins at or below every member's mu")
    need_that(boxes[-1][1] >= mu.upper, "the last box of a slab ends at or above every member's mu")
    for before, after in pairwise(boxes):
        need_that(after[0] <= before[1], "each box of a slab begins at or below the end of the one before")
