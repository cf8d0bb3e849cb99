"""A claim about every member of an uncertain design, over boxes of (alpha, mu) that hold them all.

A slab is a part of the interval of alpha; over it stand boxes, each with a part of the range of mu. Format:
docs/certificate-format.md, section 7.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, TypeAlias

from fomas_verify.claims import control_norm_bound, memory_inequality, repaired_condition, trajectory_norm_bound
from fomas_verify.claims.registry import Claim
from fomas_verify.claims.verdict import Decision, Verdict, undecided
from fomas_verify.design import UncertainDesign
from fomas_verify.enclosure.interval import Interval
from fomas_verify.prover.members import BITS, alpha_of, halves, is_cut, mu_over, refuting_member
from fomas_verify.spectrum.loop import Loop
from fomas_verify.spectrum.samples import Box

HoldsOver: TypeAlias = Callable[[Loop, Box, int], dict[str, Any] | None]

SAMPLED = (control_norm_bound.ID, trajectory_norm_bound.ID)
"""The claims that a smaller part of mu may settle; the others are decided at the corners of a box."""

OVER_BOXES: Mapping[str, HoldsOver] = {
    claim.ID: claim.holds_over
    for claim in (memory_inequality, repaired_condition, control_norm_bound, trajectory_norm_bound)
}
MOST_MEMBERS = 12
"""Looks for a refuting member, of a claim about samples: each may take seconds."""

MOST_BOXES, FEWEST_BOXES, BOX_WORK = 256, 64, 1_000_000
"""Boxes tried a claim, beyond which it is undecided: the third over N^3, between the first two."""


def over_boxes(design: UncertainDesign, loop: Loop, claim: Claim) -> Decision:
    """Decide a claim about (alpha, mu) for every member: slabs in order, halved until each is covered. Rigorous."""
    most = max(FEWEST_BOXES, min(MOST_BOXES, BOX_WORK // design.least.graph.agents**3))
    cover = _Cover(design, loop, claim, most)
    slabs, boxes = [alpha_of(design)], []
    while slabs:
        slab = slabs.pop()
        found = cover.of(slab)
        if found is not None:
            boxes += found
        elif cover.refuted is not None:
            return cover.refuted
        elif cover.left == 0 or not is_cut(slab):
            return undecided(BITS, f"{most - cover.left} boxes of (alpha, mu) do not tell")
        else:
            slabs += reversed(halves(slab))
    held = "a box of (alpha, mu) that holds" if len(boxes) == 1 else f"{len(boxes)} boxes of (alpha, mu) that hold"
    return Decision(Verdict.PROVED, {"boxes": boxes}, f"for every member: all over {held} them")


@dataclass
class _Cover:
    """The search for boxes: how many may still be tried, the refutation where one was met, and the looks for one."""

    design: UncertainDesign
    loop: Loop
    claim: Claim
    left: int
    refuted: Decision | None = None
    examined: int = 0

    def of(self, slab: Interval) -> list[dict[str, Any]] | None:
        """Boxes over a slab; None where one stays open and alpha is to be halved, or is refuted.

        A part of mu is halved while it blurs ``Phi_1 = P + abs f(1) I`` more than the slab does.
        """
        parts, boxes = [_with_room(self.design, slab)], []
        while parts:
            if self.left == 0:
                return None
            self.left -= 1
            part = parts.pop()
            witness = OVER_BOXES[self.claim.ID](self.loop, Box(slab, part), BITS)
            if witness is not None:
                boxes.append({"alpha": [*slab.ends], "mu": [*part.ends], "witness": witness})
                continue
            self._examine(slab, part)
            narrow = 2 * self.loop.degree_max * part.width <= slab.width
            if self.refuted is not None or narrow or self.claim.ID not in SAMPLED:
                return None
            parts += reversed(halves(part))
        return boxes

    def _examine(self, slab: Interval, part: Interval) -> None:
        """Look for a refutation: at the corners of the first box that fails, and in the middle of the others."""
        if self.examined < MOST_MEMBERS or self.claim.ID not in SAMPLED:
            self.refuted = refuting_member(self.design, self.claim, slab, part if self.examined else None)
            self.examined += 1


def _with_room(design: UncertainDesign, slab: Interval) -> Interval:
    """The range of mu over a slab, with the room that the checker's own range may take."""
    mu, h = mu_over(design, slab), design.range_of("h")
    if "mu" in design.ranges or mu.is_exact or h is None:
        return mu
    size = max(abs(x.numerator.bit_length() - x.denominator.bit_length()) for x in h.ends) + 1
    room = slab.width * (size + 1) / 4
    return Interval(max(mu.lower * (1 - room), mu.lower / 2), mu.upper * (1 + room)).rounded(64)
