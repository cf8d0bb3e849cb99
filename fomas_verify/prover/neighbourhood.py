"""A stretch of mu, and one of alpha, on which relation eqL3 is as true, or as false, as at the design.

Samples are tried on a wider box first, so that whoever tests them over the stretch has room for wider enclosures.
Source: docs/certificate-format.md, section 3, "margins", and section 7.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from fomas_verify.claims import control_norm_bound
from fomas_verify.claims.verdict import Decision, Verdict
from fomas_verify.enclosure.interval import Interval, round_up, short_dyadic
from fomas_verify.enclosure.norms import ball_columns, ball_identity, perron_matrix, plus_multiple, squared_image
from fomas_verify.enclosure.real import square_root, working_precision
from fomas_verify.exact.matrix import apply, norm_squared
from fomas_verify.kernel.memory import resolvent_over
from fomas_verify.spectrum.alpha_margins import may_be_written
from fomas_verify.spectrum.loop import Loop
from fomas_verify.spectrum.samples import Box
from fomas_verify.spectrum.slabs import chords_of, contracts_over, mu_over

BITS = 128
WIDEST, NARROWEST = 1, 14
"""Radii of ``2^-1`` down to ``2^-14`` of the number, or of what it may move at all."""

GROWTHS = 4
"""Each side is then moved out this often, to twice its distance."""

SAMPLE_WORK = 2_000_000
"""Bound on ``N^3 (K + m)`` for samples over boxes."""

ROOM = {"k": Fraction(3, 2), "samples": Fraction(3)}
"""Times as wide is a box on which a witness with this key is tried."""

Shown = Callable[[Box], Mapping[str, Any] | None]


@dataclass(frozen=True)
class Line:
    """A number, how far it may fall and rise at all (None: without end), and the box of what it moves over."""

    center: Interval
    below: Fraction
    above: Fraction | None
    box: Callable[[Interval], Box]

    def stretch(self, falls: Fraction, rises: Fraction) -> Interval:
        """Around the number by these shares, of the number itself where it may rise without end."""
        above = self.center.upper if self.above is None else self.above
        return Interval(self.center.lower - falls * self.below, self.center.upper + rises * above)

    def widened(self, falls: Fraction, rises: Fraction, times: Fraction) -> tuple[Fraction, Fraction]:
        """Shares this many times as large, where they are small; those of a side that ends stay below 1."""
        fall, rise = (times * share / (1 + (times - 1) * share) for share in (falls, rises))
        return fall, times * rises if self.above is None else rise

    def further(self, falls: Fraction, rises: Fraction) -> Iterator[tuple[Fraction, Fraction]]:
        """The shares with one side moved out."""
        yield (1 + falls) / 2, rises
        yield falls, 2 * rises if self.above is None else (1 + rises) / 2


@dataclass(frozen=True)
class Neighbourhood:
    """The verdict of control-norm-bound all over ``inner``, and what shows it there."""

    inner: tuple[Fraction, Fraction]
    verdict: Verdict
    witness: Mapping[str, Any]

    def entry(self) -> dict[str, Any]:
        """As the certificate writes it."""
        return {"inner": [*self.inner], "witness": {"verdict": self.verdict.value, "witness": self.witness}}


def neighbourhoods(loop: Loop, decision: Decision) -> dict[str, Neighbourhood]:
    """What was found, under ``"mu"`` and ``"alpha"``; rigorous."""
    alpha, mu = loop.design.alpha, loop.mu(BITS).outward(BITS)
    lines = {
        "mu": Line(mu, mu.lower, None, lambda x: Box(Interval.exactly(alpha), x)),
        "alpha": Line(Interval.exactly(alpha), alpha, 1 - alpha, lambda x: Box(x, mu_over(loop, x))),
    }
    shown = _shown(loop, decision)
    room = max((times for key, times in ROOM.items() if key in decision.witness), default=Fraction(1))
    found = {name: _widest(line, shown, room) for name, line in lines.items()}
    return {
        name: Neighbourhood(_ends(x, alpha if name == "alpha" else None), decision.verdict, witness)
        for name, pair in found.items()
        if pair is not None
        for x, witness in [pair]
    }


def _ends(x: Interval, alpha: Fraction | None) -> tuple[Fraction, Fraction]:
    """As written: of orders only those that a certificate may hold, the design's own in place of others."""
    lower, upper = (end if alpha is None or may_be_written(end) else alpha for end in (x.lower, x.upper))
    return lower, upper


def _shown(loop: Loop, decision: Decision) -> Shown:
    """What shows the verdict all over a box, if anything does."""
    witness = decision.witness
    if decision.verdict is Verdict.PROVED:
        return _holds_over(loop, witness)
    if decision.verdict is not Verdict.REFUTED:
        return lambda _: None
    if "power" in witness:
        return lambda box: witness if box.mu.lower >= witness["mu"] else None
    e0 = apply(loop.laplacian, witness["x0"])
    return lambda box: witness if _exceeds(loop, box, e0, witness["k"]) else None


def _holds_over(loop: Loop, witness: Mapping[str, Any]) -> Shown:
    """Of a proof, over boxes too, in its own form; none where its samples are too much work."""
    if "samples" not in witness:
        return lambda box: _closed_form(loop, box)
    if loop.design.graph.agents**3 * (witness["samples"] + witness["powers"]) <= SAMPLE_WORK:
        return lambda box: control_norm_bound.holds_over(loop, box, BITS)
    return lambda _: None


def _closed_form(loop: Loop, box: Box) -> Mapping[str, Any] | None:
    """``sigma <= 2^alpha - 1``, or the form for a symmetric graph."""
    return {} if contracts_over(loop, box) else control_norm_bound.symmetric_witness(loop, box, BITS)


def _exceeds(loop: Loop, box: Box, e0: list[Fraction], k: int) -> bool:
    """Whether ``norm(Phi_k e_0) > norm(e_0)`` all over the box, certainly.

    ``v_j = Phi_j e_0`` is followed at the middle of the box, and how far another may be from it by norms:
    ``norm(P) far + 2 D abs(mu - m) norm(v_j) + abs(r - r_m) norm(e_0)`` after one more sample.
    """
    steepest, widest = 2 * loop.degree_max, max(chords_of(loop).sigma(mu).upper for mu in (box.mu.lower, box.mu.upper))
    size, far = square_root(Interval.exactly(norm_squared(e0)), BITS).upper, Fraction(0)
    with working_precision(BITS):
        perron, identity = perron_matrix(loop.laplacian, Interval.exactly(box.mu.mid)), ball_identity(len(e0))
        phi, start = identity, ball_columns([e0])
        for r in resolvent_over(box.alpha, k + 1, BITS)[1:]:
            norm = square_root(squared_image(phi, start), BITS).upper
            far = round_up(widest * far + steepest * box.mu.width / 2 * norm + r.width / 2 * size, 2 * BITS)
            phi = plus_multiple(perron * phi, Interval.exactly(r.mid), identity)
        return square_root(squared_image(phi, start), BITS).lower > size + far


def _widest(line: Line, shown: Shown, room: Fraction) -> tuple[Interval, Mapping[str, Any]] | None:
    """The stretch, and its witness: the same share on both sides first, then each side as far as goes."""

    def tried(shares: tuple[Fraction, Fraction]) -> Mapping[str, Any] | None:
        return shown(line.box(line.stretch(*line.widened(*shares, room))))

    starts = ((Fraction(1, 1 << shift),) * 2 for shift in range(WIDEST, NARROWEST, 2))
    found = next(((shares, witness) for shares in starts if (witness := tried(shares)) is not None), None)
    if found is None:
        return None
    shares, witness = found
    for side in (0, 1):
        for _ in range(GROWTHS):
            further = list(line.further(*shares))[side]
            if (wider := tried(further)) is None:
                break
            shares, witness = further, wider
    return _shortened(line.stretch(*shares), line.center), witness


def _shortened(x: Interval, center: Interval) -> Interval:
    """The stretch with short ends, by at most an eighth of its sides narrower."""
    lower = short_dyadic(x.lower, x.lower + (center.lower - x.lower) / 8)
    return Interval(lower, short_dyadic(x.upper - (x.upper - center.upper) / 8, x.upper))
