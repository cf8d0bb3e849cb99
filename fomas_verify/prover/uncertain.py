"""Uncertain designs: what holds for every member, and the member for which it does not.

What depends on mu alone is decided at the largest mu; the rest over boxes of (alpha, mu), halved until each is
decided. A box proves and never refutes: a refutation is a member that fails. Source: docs/certificate-format.md,
section 7; docs/theory.md, section 9.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from fractions import Fraction

from fomas_verify.certificate import certificate_text
from fomas_verify.claims import trajectory_norm_bound
from fomas_verify.claims.graph_assumption import ID as GRAPH_ASSUMPTION
from fomas_verify.claims.registry import CLAIMS, ON_ANY_GRAPH, Claim
from fomas_verify.claims.verdict import Decision, Verdict, inapplicable, undecided
from fomas_verify.design import UncertainDesign
from fomas_verify.enclosure.interval import Interval, short_dyadic
from fomas_verify.kernel.memory import threshold
from fomas_verify.prover.boxes import OVER_BOXES, over_boxes
from fomas_verify.prover.members import BITS, alpha_of, mu_of_every_member, refuting_member
from fomas_verify.prover.prove import exit_status_of
from fomas_verify.spectrum.loop import Loop, sigma_at


@dataclass(frozen=True)
class UncertainProof:
    """All that was found about an uncertain design."""

    design: UncertainDesign
    values: Mapping[str, Interval]
    decisions: Mapping[str, Decision]

    @property
    def exit_status(self) -> int:
        """As of :class:`~fomas_verify.prover.Proof`."""
        return exit_status_of(self.design.least.require, self.decisions)

    def certificate(self) -> str:
        """The certificate's canonical text."""
        from importlib.metadata import version

        values = {name: {"lower": x.lower, "upper": x.upper} for name, x in self.values.items()}
        return certificate_text(self.design, values, self.decisions, version("fomas_verify"))


def prove_uncertain(design: UncertainDesign) -> UncertainProof:
    """Decide every claim about every member of an uncertain design.

    Returns
    -------
    UncertainProof
        ``proved``: true for every member; ``refuted``: false for the member in the witness. Enclosures of the values
        that hold for every member. Rigorous.
    """
    design.least.needs("mu", command="prove")
    loop = Loop(design.least)
    mu = mu_of_every_member(design)
    decisions: dict[str, Decision] = {}
    for claim in CLAIMS:
        if claim is trajectory_norm_bound and design.least.x0 is None:
            continue
        decisions[claim.ID] = _decide(design, loop, claim, mu) if _applies(loop, claim) else inapplicable()
    return UncertainProof(design, _values(design, loop, mu, decisions), decisions)


def _applies(loop: Loop, claim: Claim) -> bool:
    return loop.assumption1 or claim.ID in ON_ANY_GRAPH


def _decide(design: UncertainDesign, loop: Loop, claim: Claim, mu: Interval) -> Decision:
    if claim.ID == GRAPH_ASSUMPTION:
        return claim.decide(loop)
    if claim.ID in OVER_BOXES:
        return over_boxes(design, loop, claim)
    return _at_the_largest_mu(design, claim, mu)


def _at_the_largest_mu(design: UncertainDesign, claim: Claim, mu: Interval) -> Decision:
    """A claim that holds for every smaller mu where it holds for one."""
    for largest in [mu.upper] if mu.is_exact or "mu" in design.ranges else _above(mu.upper, alpha_of(design).width):
        decision = claim.decide(Loop(replace(design.least, gamma=None, mu=largest, h=None)))
        if decision.verdict is Verdict.PROVED:
            return replace(decision, reason=_for_every_member(decision.reason))
    found = refuting_member(design, claim, alpha_of(design))
    return found or undecided(BITS, "true for some members, and not decided for those with the largest mu")


def _for_every_member(reason: str) -> str:
    """The reason at a bound of the largest mu, in words that are true of each mu."""
    if reason.startswith("sigma = beta"):
        return "for every member: sigma = beta"
    return f"for every member: {reason.replace('mu = ', 'mu <= ', 1)}"


def _above(mu: Fraction, width: Fraction) -> list[Fraction]:
    """Short numbers above mu: at a distance that alpha's uncertainty makes easy to check, and nearer."""
    least = Fraction(1, 1 << 40)
    return [short_dyadic(mu * (1 + x / 2), mu * (1 + x)) for x in (max(width / 64, least), least)]


def _values(
    design: UncertainDesign, loop: Loop, mu: Interval, decisions: Mapping[str, Decision]
) -> dict[str, Interval]:
    """Enclosures that hold for every member."""
    alpha = alpha_of(design)
    mu = mu if "mu" in design.ranges else mu.rounded(BITS)
    values = {"mu": mu}
    if loop.assumption1:
        lambda2 = loop.lambda2(BITS).rounded(BITS)
        values["beta"] = (1 - mu * lambda2).rounded(BITS)
        ends = [sigma_at(loop.laplacian, x, BITS) for x in (mu.lower, mu.upper)]
        least = ends[0].lower - 4 * loop.degree_max * mu.width
        if least > 0:
            values["sigma"] = Interval(least, max(x.upper for x in ends)).rounded(64)
        values["lambda2"] = lambda2
    values["threshold"] = Interval(threshold(alpha.lower, BITS).lower, threshold(alpha.upper, BITS).upper).rounded(BITS)
    values["degree_max"] = Interval.exactly(loop.degree_max)
    components = design.least.components
    if components and len(components) == 1 and decisions["average-consensus"].verdict is Verdict.PROVED:
        values["limit"] = Interval.exactly(sum(components[0], Fraction(0)) / loop.design.graph.agents)
    return values
