"""From a design to its verdicts, values and certificate. Meaning of each: docs/semantics.md."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from fomas_verify.certificate import certificate_text
from fomas_verify.claims import trajectory_norm_bound
from fomas_verify.claims.registry import CLAIMS, ON_ANY_GRAPH
from fomas_verify.claims.verdict import Decision, Verdict, inapplicable
from fomas_verify.design import Design
from fomas_verify.design.model import MOST_AGENTS_EXACTLY, Given
from fomas_verify.enclosure.interval import Interval
from fomas_verify.enclosure.reference import DisagreementError, approx_gain_and_threshold, must_agree
from fomas_verify.exact.errors import FomasError
from fomas_verify.kernel.horizon import Horizon, check_horizon
from fomas_verify.prover.margins import Margins, entries, margins
from fomas_verify.prover.sizes import Sizes, measure
from fomas_verify.spectrum.loop import Loop
from fomas_verify.spectrum.stability import Side, stability

DEFAULT_DIGITS = 50


class WorkLimitError(FomasError):
    """The design is larger than the work allowed."""

    exit_status = 3


@dataclass(frozen=True)
class Proof:
    """All that was found about a design."""

    design: Design
    loop: Loop
    values: Mapping[str, Interval]
    sizes: Sizes
    margins: Margins
    decisions: Mapping[str, Decision]
    horizon: Horizon | None
    digits: int

    @property
    def exit_status(self) -> int:
        """0 every required claim is proved, 1 one is refuted or inapplicable, 3 one is undecided."""
        return exit_status_of(self.design.require, self.decisions)

    def certificate(self) -> str:
        """The certificate's canonical text."""
        from importlib.metadata import version

        return certificate_text(self.design, self.value_entries(), self.decisions, version("fomas_verify"))

    def value_entries(self) -> dict[str, dict[str, Any]]:
        """The values as the certificate writes them, in its order."""
        found = {name: {"lower": x.lower, "upper": x.upper} for name, x in self.values.items()} | self.sizes.entries()
        return found | ({"margins": room} if (room := entries(self.margins)) else {})


def exit_status_of(require: Sequence[str], decisions: Mapping[str, Decision]) -> int:
    """0 every required claim is proved, 1 one is refuted or inapplicable, 3 one is undecided."""
    verdicts = [decisions[name].verdict for name in require]
    if any(v in (Verdict.REFUTED, Verdict.INAPPLICABLE) for v in verdicts):
        return 1
    return 3 if Verdict.UNDECIDED in verdicts else 0


def prove(
    design: Design,
    *,
    horizon: int | None = None,
    digits: int = DEFAULT_DIGITS,
    only: Collection[str] | None = None,
    like: Loop | None = None,
) -> Proof:
    """Decide every claim about a design, or only some.

    Parameters
    ----------
    design : Design
        With mu, or gamma and h.
    horizon : int, optional
        Check (14) also at the samples k = 0..horizon, term by term; the design's own horizon by default.
    digits : int
        Significant decimal digits of the values, at least 20.
    only : collection of str, optional
        Ids of the claims to decide; then no sizes and no margins are measured. A horizon is checked with
        memory-inequality only.
    like : Loop, optional
        That of a design on the same digraph: what was computed of the digraph is not computed again. It changes no
        answer.

    Returns
    -------
    Proof
        Verdicts and enclosures; rigorous.

    Raises
    ------
    DisagreementError
        Two computations that must agree do not.
    """
    design.needs("mu", command="prove")
    if design.graph.agents > MOST_AGENTS_EXACTLY:
        what = f"more than {MOST_AGENTS_EXACTLY} agents are beyond what takes matrices"
        raise WorkLimitError(f"{design.source}: {what}; prove, check and gate decide them by bounds: undecided")
    loop = Loop(design) if like is None else like.on_same_graph(design)
    values = enclose_values(loop, digits)
    compare_with_mpmath(design, values, digits)
    measured = Sizes() if only is not None else measure(loop, decided_stable=stability(loop).side is Side.INSIDE)
    decisions = {
        claim.ID: claim.decide(loop) if loop.assumption1 or claim.ID in ON_ANY_GRAPH else inapplicable()
        for claim in CLAIMS
        if (only is None or claim.ID in only) and (claim is not trajectory_norm_bound or design.x0 is not None)
    }
    samples = design.horizon if horizon is None else horizon
    seen = None
    if samples is not None and loop.assumption1 and "memory-inequality" in decisions:
        seen = check_horizon(design.alpha, loop.beta(_bits(digits)), samples, digits)
        compare_with_closed_form(seen, decisions["memory-inequality"])
    room = {} if only is not None else margins(loop, decisions)
    return Proof(design, loop, values, measured, room, decisions, seen, digits)


def _bits(digits: int) -> int:
    return int(digits * 3.33) + 32


def value_bits(digits: int, *sizes: Fraction) -> int:
    """The working precision for so many digits of a difference of products of these."""
    return _bits(digits) + sum(max(0, x.numerator.bit_length() - x.denominator.bit_length()) for x in sizes)


def enclose_values(loop: Loop, digits: int) -> dict[str, Interval]:
    """The values that exist for the design, to about so many digits; sigma, which costs most, to 35 at most."""
    bits = value_bits(digits, loop.mu(64).upper, loop.degree_max)
    values = {"mu": loop.mu(bits)}
    if loop.assumption1:
        values |= {"beta": loop.beta(bits), "sigma": loop.sigma(128), "lambda2": loop.lambda2(bits)}
    values |= {"threshold": loop.threshold(bits), "degree_max": Interval.exactly(loop.degree_max)}
    return {name: x.rounded(120 if name == "sigma" else bits - 16) for name, x in values.items()}


def compare_with_mpmath(design: Given, values: Mapping[str, Interval], digits: int) -> None:
    """Raise :class:`DisagreementError` where mpmath's numbers lie outside of the enclosures."""
    for name, x in approx_gain_and_threshold(design.alpha, design.h, design.gamma, digits).items():
        must_agree(name, values[name], x, digits)
        if name == "mu" and "beta" in values:
            lambda2 = values["lambda2"].mid
            slack = values["lambda2"].width * x
            beta = Interval(values["beta"].lower - slack, values["beta"].upper + slack)
            must_agree("beta", beta, Fraction(1) - x * lambda2, digits)


def compare_with_closed_form(seen: Horizon, decision: Decision) -> None:
    """Raise :class:`DisagreementError` where the samples and the closed form contradict each other."""
    if decision.verdict is Verdict.UNDECIDED:
        return
    expected = decision.witness.get("k") if decision.verdict is Verdict.REFUTED else None
    if expected is not None and (expected > seen.last or (expected in seen.not_decided and seen.first_failure is None)):
        expected = None
    if seen.first_failure != expected:
        raise DisagreementError(
            f"memory-inequality: sample by sample it first fails at k = {seen.first_failure}, "
            f"by the closed form at k = {expected}"
        )
